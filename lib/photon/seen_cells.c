/* seen_cells.c - a sorted list of the cells around gather points. */
#include "photon/seen_cells.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Cells along the largest extent; of the points of an axis, one in LEFT_OUT at either end. */
enum { CELLS = 64, LEFT_OUT = 50, NEIGHBOURS = 27 };

static const char what[] = "the cells that the camera sees";

static int compare_floats(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static int compare_keys(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* The cell of a coordinate, moved so that it is positive; far ones share the outermost. */
static int64_t cell_of(const rt_seen_cells *cells, float x, int axis)
{
    const double at = floor(((double)x - cells->lo[axis]) / cells->side);
    return (int64_t)fmin(fmax(at, -1e6), 1e6) + (1 << 20);
}

static uint64_t key_of(const int64_t cell[3])
{
    return (uint64_t)cell[0] << 42 | (uint64_t)cell[1] << 21 | (uint64_t)cell[2];
}

/* The extent of the points along an axis, of which the outermost are left out. */
static double measure(double *lo, float *sorted, const float (*points)[3], size_t count, int axis)
{
    for (size_t i = 0; i < count; i++)
        sorted[i] = points[i][axis];
    qsort(sorted, count, sizeof *sorted, compare_floats);
    *lo = sorted[count / LEFT_OUT];
    return (double)sorted[count - 1 - count / LEFT_OUT] - *lo;
}

/* Leaves each key once, in ascending order. */
static size_t sort_keys(uint64_t *keys, size_t count)
{
    size_t kept = 0;
    qsort(keys, count, sizeof *keys, compare_keys);
    for (size_t i = 0; i < count; i++)
        if (i == 0 || keys[i] != keys[i - 1])
            keys[kept++] = keys[i];
    return kept;
}

/* The cells of the points themselves. */
static size_t put_points(uint64_t *keys, const rt_seen_cells *cells, const float (*points)[3],
                         size_t count)
{
    for (size_t i = 0; i < count; i++) {
        int64_t at[3];
        for (int axis = 0; axis < 3; axis++)
            at[axis] = cell_of(cells, points[i][axis], axis);
        keys[i] = key_of(at);
    }
    return sort_keys(keys, count);
}

/* Each cell and those around it. */
static void put_neighbours(uint64_t *out, const uint64_t *keys, size_t count)
{
    for (size_t i = 0; i < count; i++)
        for (int n = 0; n < NEIGHBOURS; n++) {
            const int64_t at[3] = {(int64_t)(keys[i] >> 42) + n / 9 - 1,
                                   (int64_t)(keys[i] >> 21 & 0x1fffff) + n / 3 % 3 - 1,
                                   (int64_t)(keys[i] & 0x1fffff) + n % 3 - 1};
            out[i * NEIGHBOURS + (size_t)n] = key_of(at);
        }
}

static rt_status make(rt_seen_cells *out, uint64_t *own, const float (*points)[3], size_t count,
                      rt_memory *memory, rt_error *error)
{
    double extent = 0;
    for (int axis = 0; axis < 3; axis++)
        extent = fmax(extent, measure(out->lo + axis, (float *)own, points, count, axis));
    out->side = extent > 0 ? extent / CELLS : 1;
    const size_t cells = put_points(own, out, points, count);
    out->keys = rt_memory_alloc(memory, cells * NEIGHBOURS, sizeof *out->keys, what, error);
    if (!out->keys)
        return RT_ERROR_MEMORY;
    put_neighbours(out->keys, own, cells);
    out->count = sort_keys(out->keys, cells * NEIGHBOURS);
    return RT_OK;
}

rt_status rt_seen_cells_make(rt_seen_cells *out, const float (*points)[3], size_t count,
                             rt_memory *memory, rt_error *error)
{
    memset(out, 0, sizeof *out);
    out->side = 1;
    if (count == 0)
        return RT_OK;
    uint64_t *own = rt_memory_alloc(memory, count, sizeof *own, what, error);
    const rt_status status = own ? make(out, own, points, count, memory, error) : RT_ERROR_MEMORY;
    rt_memory_free(own);
    return status;
}

void rt_seen_cells_free(rt_seen_cells *cells)
{
    rt_memory_free(cells->keys);
    memset(cells, 0, sizeof *cells);
}

int rt_seen_cells_hold(const rt_seen_cells *cells, const float point[3])
{
    int64_t at[3];
    for (int axis = 0; axis < 3; axis++)
        at[axis] = cell_of(cells, point[axis], axis);
    const uint64_t key = key_of(at);
    return cells->count > 0 &&
           bsearch(&key, cells->keys, cells->count, sizeof key, compare_keys) != NULL;
}
