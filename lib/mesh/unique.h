/* unique.h - numbers distinct triples of 32-bit words in the order of their first occurrence. */
#ifndef RT_LIB_MESH_UNIQUE_H
#define RT_LIB_MESH_UNIQUE_H

#include <stdint.h>

#include "mesh/source.h"

/* All zero is empty. */
typedef struct rt_unique {
    uint32_t (*keys)[3]; /* [count], in the order of their numbers */
    uint32_t count;
    uint32_t *slots; /* [slot_count]: open addressing; number + 1, or 0 for a free slot */
    uint32_t slot_count, room;
} rt_unique;

/* The number of the key, a new one if it has not come yet. */
rt_status rt_unique_add(rt_unique *set, const rt_mesh_source *source, const uint32_t key[3],
                        uint32_t *number);
void rt_unique_free(rt_unique *set);

#endif
