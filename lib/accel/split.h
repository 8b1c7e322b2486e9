/*
 * split.h - divides a set of references in two.
 *
 * By the surface area heuristic over binned centres (Wald, "On fast Construction of SAH-based
 * Bounding Volume Hierarchies", IEEE Symposium on Interactive Ray Tracing, 2007), the cost of a
 * side being its area times the blocks of eight that it fills; or at the median, where depth must
 * be bounded.
 */
#ifndef RT_LIB_ACCEL_SPLIT_H
#define RT_LIB_ACCEL_SPLIT_H

#include <stdint.h>

#include "accel/refs.h"

typedef struct rt_set {
    rt_ref *refs;
    uint32_t count;
    box4 box;     /* of the references */
    box4 centres; /* of rt_ref_centre */
} rt_set;

/* The set of refs[0 .. count - 1] with its boxes. */
rt_set rt_set_make(rt_ref *refs, uint32_t count, uint32_t threads);

/*
 * Reorders the set, which has at least two references, and divides it into two that are not empty,
 * the same for any number of threads. scratch has room for count / RT_PARTITION_CHUNK + 1 numbers.
 */
void rt_split_sah(rt_set sides[2], const rt_set *set, uint32_t threads, uint32_t *scratch);
void rt_split_median(rt_set sides[2], const rt_set *set, uint32_t threads);

#endif
