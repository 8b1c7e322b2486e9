/*
 * point_order.h - points in the order of a space-filling curve.
 */
#ifndef RT_LIB_PHOTON_POINT_ORDER_H
#define RT_LIB_PHOTON_POINT_ORDER_H

#include <stddef.h>
#include <stdint.h>

#include "rt.h"
#include "types.h"

/*
 * Sorts `count` points, at most 2^28, along Hilbert's curve through their bounding box; `first` is
 * the position of the first, three finite numbers, and others follow each `stride` bytes later. The
 * order is written to `items` [count], an index in the low 28 bits of each. `spare` [count] is
 * scratch memory. The sort is stable, so the result does not depend on the number of threads. Fails
 * only for want of memory.
 */
rt_status rt_point_order(uint64_t *items, uint64_t *spare, const float *first, size_t stride,
                         size_t count, uint32_t threads, rt_error *error);

#define RT_POINT_ORDER_INDEX RT_INDEX_MASK

/* Photons that show where most are: at most so many, all but one in so many at either end. */
enum { RT_ORDER_SAMPLE = 2048, RT_ORDER_FAR_OUT = 20 };

/*
 * The curve as a table for the device: of each state and each pair of octants, their places, and
 * behind all of those the state that follows.
 */
enum { RT_CURVE_BYTES = 2 * RT_CURVE_STATES * 64 };
void rt_point_order_curve(unsigned char table[RT_CURVE_BYTES]);

#endif
