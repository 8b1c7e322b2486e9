/* partition.h - reorders references by the side of a plane. */
#ifndef RT_LIB_ACCEL_PARTITION_H
#define RT_LIB_ACCEL_PARTITION_H

#include <stdint.h>

#include "accel/refs.h"

/* References are partitioned by chunks of this length, then exchanged between chunks. */
#define RT_PARTITION_CHUNK 1024u

/* A plane between bins: left are the references whose bin along `axis` is below `bin`. */
typedef struct rt_plane_split {
    int axis;
    float origin, scale; /* bin = (centre - origin) scale, at most limit */
    float limit;
    int bin;
} rt_plane_split;

/*
 * Moves the left references before the others; returns their number. The order does not depend on
 * threads. scratch has room for count / RT_PARTITION_CHUNK + 1 numbers. centres, if not NULL,
 * become the boxes of rt_ref_centre on both sides; threads is 1 then.
 */
uint32_t rt_partition(rt_ref *refs, uint32_t count, const rt_plane_split *plane, uint32_t threads,
                      uint32_t *scratch, box4 centres[2]);

#endif
