/* names.c - a hash table from words to what they name. */
#include "dsl/names.h"

#include <stdlib.h>
#include <string.h>

/* ---- SipHash-1-3 --------------------------------------------------------------
 *
 * J.-P. Aumasson, D. J. Bernstein: "SipHash: a fast short-input PRF", 2012; with one round for each
 * word and three at the end. Whoever does not know the key, here where the slots are in memory,
 * cannot choose names that all belong into one slot.
 */

static uint64_t rotate(uint64_t x, int bits)
{
    return x << bits | x >> (64 - bits);
}

static void sip_round(uint64_t v[4])
{
    v[0] += v[1];
    v[2] += v[3];
    v[1] = rotate(v[1], 13) ^ v[0];
    v[3] = rotate(v[3], 16) ^ v[2];
    v[0] = rotate(v[0], 32);
    v[2] += v[1];
    v[0] += v[3];
    v[1] = rotate(v[1], 17) ^ v[2];
    v[3] = rotate(v[3], 21) ^ v[0];
    v[2] = rotate(v[2], 32);
}

static uint64_t hash_text(uint64_t key, rt_text text)
{
    uint64_t v[4] = {key ^ 0x736f6d6570736575u, 0x646f72616e646f6du, key ^ 0x6c7967656e657261u,
                     0x7465646279746573u};
    uint64_t word = 0;
    for (size_t i = 0; i <= text.length; i++) {
        const uint64_t byte = i < text.length ? (unsigned char)text.at[i] : 0;
        word |= byte << 8 * (i % 8);
        if (i < text.length && i % 8 < 7)
            continue;
        word |= i == text.length ? (uint64_t)text.length << 56 : 0;
        v[3] ^= word;
        sip_round(v);
        v[0] ^= word;
        word = 0;
    }
    v[2] ^= 0xff;
    for (int i = 0; i < 3; i++)
        sip_round(v);
    return v[0] ^ v[1] ^ v[2] ^ v[3];
}

/* ---- The table ---------------------------------------------------------------- */

/* The slot that holds this text, or the free one where it belongs. */
static size_t find_slot(const rt_names *names, rt_text text)
{
    size_t mask = names->slot_count - 1;
    size_t slot = (size_t)hash_text((uint64_t)(uintptr_t)names->slots, text) & mask;
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
