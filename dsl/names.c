/* names.c - a hash table from words to what they name. */
#include "dsl/names.h"

#include <stdlib.h>
#include <string.h>

/*
 * FNV-1a, 64 bits. It starts from the address of the slots: whoever writes a scene does not know
 * it, and cannot choose names that all belong into one slot.
 */
static uint64_t hash_text(const rt_names *names, rt_text text)
{
    uint64_t hash = (uint64_t)(uintptr_t)names->slots * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
    for (size_t i = 0; i < text.length; i++)
        hash = (hash ^ (unsigned char)text.at[i]) * 0x100000001b3u;
    return hash;
}

/* The slot that holds this text, or the free one where it belongs. */
static size_t find_slot(const rt_names *names, rt_text text)
{
    size_t mask = names->slot_count - 1;
    size_t slot = (size_t)hash_text(names, text) & mask;
    while (names->slots[slot]) {
        rt_text other = names->items[names->slots[slot] - 1].text;
        if (other.length == text.length && memcmp(other.at, text.at, text.length) == 0)
            break;
        slot = (slot + 1) & mask;
    }
    return slot;
}

size_t rt_names_find(const rt_names *names, rt_text text)
{
    if (names->slot_count == 0)
        return RT_NAME_NONE;
    size_t entry = names->slots[find_slot(names, text)];
    return entry ? entry - 1 : RT_NAME_NONE;
}

/* Doubles the room for names; the slots stay at most half full. */
static int grow(rt_names *names)
{
    size_t capacity = names->capacity ? 2 * names->capacity : 32;
    size_t slots_more = 2 * capacity - names->slot_count;
    uint64_t bytes = (uint64_t)(capacity - names->capacity) * sizeof *names->items +
                     (uint64_t)slots_more * sizeof *names->slots;
    if (!rt_budget_take(names->budget, bytes, "the table of names"))
        return 0;
    rt_name *items = realloc(names->items, capacity * sizeof *items);
    if (!items)
        return 0;
    names->items = items;
    size_t *slots = calloc(2 * capacity, sizeof *slots);
    if (!slots)
        return 0;
    free(names->slots);
    names->slots = slots;
    names->slot_count = 2 * capacity;
    names->capacity = capacity;
    for (size_t i = 0; i < names->count; i++)
        slots[find_slot(names, items[i].text)] = i + 1;
    return 1;
}

rt_name *rt_names_add(rt_names *names, rt_place place)
{
    if (names->count == names->capacity && !grow(names))
        return NULL;
    rt_name *name = &names->items[names->count];
    memset(name, 0, sizeof *name);
    name->text = rt_place_text(&place);
    name->place = place;
    names->slots[find_slot(names, name->text)] = ++names->count;
    return name;
}

/* The latest name is the last of its chain of slots, so to take it away breaks no other's. */
void rt_names_truncate(rt_names *names, size_t count)
{
    while (names->count > count) {
        names->slots[find_slot(names, names->items[names->count - 1].text)] = 0;
        names->count--;
    }
}

void rt_names_free(rt_names *names)
{
    free(names->items);
    free(names->slots);
    memset(names, 0, sizeof *names);
}
