/*
 * seen_cells.h - where the camera gathers: a set of cubes of space, those that hold gather points
 * and their neighbours.
 */
#ifndef RT_LIB_PHOTON_SEEN_CELLS_H
#define RT_LIB_PHOTON_SEEN_CELLS_H

#include "base/memory.h"
#include "rt.h"

typedef struct rt_seen_cells {
    uint64_t *keys; /* [count], ascending */
    size_t count;
    double lo[3], side; /* m */
} rt_seen_cells;

/*
 * The cells around points [count][3], finite. Their side is 1 / 64 of the largest extent of the
 * points, the outermost ones of each axis left out. No points make an empty set. Free with
 * rt_seen_cells_free.
 */
rt_status rt_seen_cells_make(rt_seen_cells *out, const float (*points)[3], size_t count,
                             rt_memory *memory, rt_error *error);
void rt_seen_cells_free(rt_seen_cells *cells);

/* Whether one of the cells holds the point. */
int rt_seen_cells_hold(const rt_seen_cells *cells, const float point[3]);

#endif
