/* unique.c - a hash table of keys with linear probing. */
#include "mesh/unique.h"

#include <stdlib.h>
#include <string.h>

#define COUNT_MAX 0x40000000u /* the table of slots, twice as long, still has 32-bit indices */

static uint64_t mix(uint64_t h)
{
    /*
     * The finaliser of MurmurHash3 (A. Appleby): every bit of the input reaches every bit of the
     * output.
     */
    h ^= h >> 33;
    h *= 0xff51afd7ed558ccdu;
    h ^= h >> 33;
    h *= 0xc4ceb9fe1a85ec53u;
    return h ^ h >> 33;
}

/*
 * The slot that holds the key, or the free one where it belongs. The address of the slots goes in:
 * whoever writes a file does not know it, and cannot choose keys that all belong into one slot.
 */
static uint32_t *find(const rt_unique *set, const uint32_t *key)
{
    const uint32_t mask = set->slot_count - 1;
    uint64_t hash = mix((uint64_t)(uintptr_t)set->slots);
    for (size_t word = 0; word < set->words; word++)
        hash = mix(hash ^ key[word]);
    uint32_t i = (uint32_t)hash & mask;
    while (set->slots[i] &&
           memcmp(rt_unique_key(set, set->slots[i] - 1), key, set->words * sizeof *key) != 0)
        i = (i + 1) & mask;
    return &set->slots[i];
}

const uint32_t *rt_unique_key(const rt_unique *set, uint32_t number)
{
    return set->keys + number * set->words;
}

/* Doubles the room; a quarter to a half of the slots are taken. */
static rt_status grow(rt_unique *set, const rt_mesh_source *source)
{
    uint32_t room = set->room ? 2 * set->room : 1024;
    void *slots = NULL;
    if (room > COUNT_MAX)
        return rt_mesh_fail(source, 0, "more than %u vertices that differ", COUNT_MAX);
    rt_status status =
        rt_mesh_resize(source, (void **)&set->keys, room, set->words * sizeof *set->keys);
    if (status == RT_OK)
        status = rt_mesh_zeroed(source, &slots, 2 * (uint64_t)room, sizeof *set->slots);
    if (status != RT_OK)
        return status;
    rt_memory_free(set->slots);
    set->slots = slots;
    set->slot_count = 2 * room;
    set->room = room;
    for (uint32_t i = 0; i < set->count; i++)
        *find(set, rt_unique_key(set, i)) = i + 1;
    return RT_OK;
}

rt_status rt_unique_add(rt_unique *set, const rt_mesh_source *source, const uint32_t *key,
                        uint32_t *number)
{
    rt_status status;
    if (set->count == set->room && (status = grow(set, source)) != RT_OK)
        return status;
    uint32_t *slot = find(set, key);
    if (*slot == 0) {
        memcpy(set->keys + set->count * set->words, key, set->words * sizeof *key);
        *slot = ++set->count;
    }
    *number = *slot - 1;
    return RT_OK;
}

void rt_unique_free(rt_unique *set)
{
    rt_memory_free(set->keys);
    rt_memory_free(set->slots);
    memset(set, 0, sizeof *set);
}
