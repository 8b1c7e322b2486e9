/* flann_index.c - FLANN behind the library's conventions. */
#include "photon/flann_index.h"

#include <assert.h>
#include <limits.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "photon/flann_shim.h"

/*
 * What FLANN allocates a point: its copy, its order, a pointer, and two nodes, as if each leaf held
 * one point. The tree may be deeper than that only by a few nodes.
 */
enum { BYTES_PER_POINT = 3 * sizeof(float) + sizeof(int) + sizeof(void *) + 2 * 48 };

static const char what[] = "the search tree of the photon map";

struct rt_flann_index {
    rt_memory *memory;
    uint64_t taken;   /* bytes of it, for FLANN */
    float *positions; /* FLANN keeps pointers into it */
    size_t count;
    rt_flann_tree *tree; /* NULL for an empty set */
};

/* Takes memory for the most that the tree may need, and gives back what it did not. */
static rt_status build(rt_flann_index *index, rt_error *error)
{
    char why[sizeof error->message];
    const uint64_t most = (uint64_t)index->count * BYTES_PER_POINT + (1 << 16);
    rt_status status = rt_memory_take(index->memory, most, what, error);
    if (status != RT_OK)
        return status;
    index->taken = most;
    if (rt_flann_build(&index->tree, index->positions, (int)index->count, why, sizeof why) != 0)
        return rt_fail(error, RT_ERROR_MEMORY,
                       "the search tree of %zu photons could not be built: %s", index->count, why);
    const uint64_t used = rt_flann_bytes(index->tree);
    if (used < most) {
        rt_memory_give(index->memory, most - used, what);
        index->taken = used;
    }
    return RT_OK;
}

rt_status rt_flann_index_create(rt_flann_index **out, const float *positions, size_t count,
                                rt_memory *memory, rt_error *error)
{
    if (count > INT_MAX)
        return rt_fail(error, RT_ERROR_MEMORY,
                       "%zu photons are more than the %d a search tree can hold", count, INT_MAX);
    rt_flann_index *index = rt_memory_zeroed(NULL, 1, sizeof *index, what, error);
    float *copy = index ? rt_memory_alloc(memory, count, 3 * sizeof *copy, what, error) : NULL;
    rt_status status = RT_OK;
    if (!copy) {
        rt_memory_free(index);
        return RT_ERROR_MEMORY;
    }
    index->memory = memory;
    index->positions = copy;
    index->count = count;
    if (count > 0) {
        memcpy(copy, positions, count * 3 * sizeof *copy);
        status = build(index, error);
    }
    if (status != RT_OK) {
        rt_flann_index_destroy(index);
        return status;
    }
    *out = index;
    return RT_OK;
}

void rt_flann_index_destroy(rt_flann_index *index)
{
    if (!index)
        return;
    rt_flann_free(index->tree);
    rt_memory_give(index->memory, index->taken, what);
    rt_memory_free(index->positions);
    rt_memory_free(index);
}

rt_status rt_flann_index_nearest(const rt_flann_index *index, const float *queries,
                                 size_t query_count, size_t k, int *indices, float *squared,
                                 rt_error *error)
{
    char why[sizeof error->message];

    assert(k >= 1 && k <= index->count);
    for (size_t i = 0; i < query_count * k; i++)
        squared[i] = HUGE_VALF;
    if (rt_flann_search(index->tree, queries, query_count, k, indices, squared, why, sizeof why))
        return rt_fail(error, RT_ERROR_MEMORY,
                       "the search for the %zu nearest photons of %zu points failed: %s", k,
                       query_count, why);
    return RT_OK;
}
