/* names.c - names with their numbers. */
#include "names.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

/*
 * FNV-1a, by Fowler, Noll and Vo. It starts from the address of the slots: whoever writes a file
 * does not know it, and cannot choose names that all belong into one slot.
 */
static uint64_t hash_of(const name_table *table, const char *name)
{
    uint64_t hash = (uint64_t)(uintptr_t)table->slots * UINT64_C(0x9e3779b97f4a7c15);
    hash ^= hash >> 32;
    for (; *name; name++)
        hash = (hash ^ (unsigned char)*name) * UINT64_C(0x100000001b3);
    return hash;
}

/* The slot of a name, or the empty one where it would be; there is an empty one. */
static size_t slot_of(const name_table *table, const char *name)
{
    size_t at = (size_t)hash_of(table, name) & (table->slot_count - 1);
    while (table->slots[at] && strcmp(table->names[table->slots[at] - 1], name) != 0)
        at = (at + 1) & (table->slot_count - 1);
    return at;
}

int name_table_find(const name_table *table, const char *name)
{
    return table->slot_count ? (int)table->slots[slot_of(table, name)] - 1 : -1;
}

/* Doubles the room, of which names take half at most. Returns 0 without memory. */
static int grow(name_table *table)
{
    const size_t slots = table->slot_count ? 2 * table->slot_count : 64;
    char **names = realloc(table->names, slots / 2 * sizeof *names);
    table->names = names ? names : table->names;
    uint32_t *made = names ? calloc(slots, sizeof *made) : NULL;
    if (!made)
        return 0;
    free(table->slots);
    table->slots = made;
    table->slot_count = slots;
    table->capacity = slots / 2;
    for (size_t i = 0; i < table->count; i++)
        table->slots[slot_of(table, table->names[i])] = (uint32_t)i + 1;
    return 1;
}

int name_table_add(name_table *table, const char *name)
{
    if (table->count == INT_MAX / 4 || (table->count == table->capacity && !grow(table)))
        return -1;
    char *copy = malloc(strlen(name) + 1);
    if (!copy)
        return -1;
    table->names[table->count] = strcpy(copy, name);
    table->slots[slot_of(table, name)] = (uint32_t)++table->count;
    return (int)table->count - 1;
}

void name_table_free(name_table *table)
{
    for (size_t i = 0; i < table->count; i++)
        free(table->names[i]);
    free(table->names);
    free(table->slots);
}
