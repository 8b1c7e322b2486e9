/* unique.h - numbers distinct rows of 32-bit words in the order of their first occurrence. */
#ifndef RT_LIB_MESH_UNIQUE_H
#define RT_LIB_MESH_UNIQUE_H

#include <stdint.h>

#include "mesh/source.h"

/* Empty where all but words is zero. */
typedef struct rt_unique {
    size_t words;   /* of a key */
    uint32_t *keys; /* [count][words], in the order of their numbers */
    uint32_t count;
    uint32_t *slots; /* [slot_count]: open addressing; number + 1, or 0 for a free slot */
    uint32_t slot_count, room;
} rt_unique;

/* The number of the key, a new one if it has not come yet. */
rt_status rt_unique_add(rt_unique *set, const rt_mesh_source *source, const uint32_t *key,
                        uint32_t *number);
const uint32_t *rt_unique_key(const rt_unique *set, uint32_t number);
void rt_unique_free(rt_unique *set);

#endif
