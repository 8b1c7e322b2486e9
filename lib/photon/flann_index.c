/*
 * flann_index.c - FLANN behind the library's conventions.
 *
 * Pitfalls of FLANN 1.9.2's C interface:
 *   - the distance type picks, at every call, the C++ type that an index pointer is cast to,
 *     so it must be the same at building, searching and freeing;
 *   - sorted = 0 is its default, and counts above k = 250, where the results come from a heap;
 *   - cores > 1 makes it share out queries by OpenMP, evenly, and gather the results on one thread;
 *     callers balance the work better, and use their results while these are in the cache;
 *   - it writes fewer than k results when there are fewer points, or distances that overflow;
 *   - it lets std::bad_alloc escape through C, so its memory is tried before each call;
 *   - a positive random_seed would seed the C library's generator.
 */
#include "photon/flann_index.h"

#include <flann/flann.h>
#include <assert.h>
#include <limits.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { LEAF_SIZE = 16 }; /* points a leaf: the fastest for k = 50 to 500 of 10^5 to 10^6 points */

/* Upper bound of what FLANN allocates a point: its copy, its order, a pointer, and tree nodes. */
enum { BYTES_PER_POINT = 3 * sizeof(float) + sizeof(int) + sizeof(void *) + 2 * 48 };

static const char what[] = "the search tree of the photon map";

struct rt_flann_index {
    rt_memory *memory;
    uint64_t taken;   /* bytes of it, for FLANN */
    float *positions; /* FLANN keeps pointers into it */
    size_t count;
    flann_index_t tree; /* NULL for an empty set */
};

/* FLANN's type of distance belongs to the process: set while calls are under way, then restored. */
static struct {
    pthread_mutex_t lock;
    int calls; /* under way */
    enum flann_distance_t before;
} shared = {PTHREAD_MUTEX_INITIALIZER, 0, FLANN_DIST_EUCLIDEAN};

static void enter(void)
{
    pthread_mutex_lock(&shared.lock);
    if (shared.calls++ == 0) {
        shared.before = flann_get_distance_type();
        flann_set_distance_type(FLANN_DIST_EUCLIDEAN, flann_get_distance_order());
    }
    pthread_mutex_unlock(&shared.lock);
}

static void leave(void)
{
    pthread_mutex_lock(&shared.lock);
    if (--shared.calls == 0)
        flann_set_distance_type(shared.before, flann_get_distance_order());
    pthread_mutex_unlock(&shared.lock);
}

static struct FLANNParameters parameters(void)
{
    struct FLANNParameters p = DEFAULT_FLANN_PARAMETERS;
    p.algorithm = FLANN_INDEX_KDTREE_SINGLE;
    p.checks = FLANN_CHECKS_UNLIMITED;
    p.eps = 0;
    p.sorted = 1;
    p.cores = 1;
    p.leaf_max_size = LEAF_SIZE;
    p.log_level = FLANN_LOG_NONE;
    p.random_seed = 0;
    return p;
}

/* Whether count * bytes of memory can be had. */
static int memory_is_there(size_t count, size_t bytes)
{
    if (count > SIZE_MAX / bytes)
        return 0;
    void *memory = malloc(count * bytes);
    free(memory);
    return memory != NULL;
}

static rt_status build(rt_flann_index *index, rt_error *error)
{
    struct FLANNParameters p = parameters();
    float speedup;

    if (!memory_is_there(index->count, BYTES_PER_POINT))
        return rt_fail(error, RT_ERROR_MEMORY, "no memory for the search tree of %zu photons",
                       index->count);
    enter();
    index->tree = flann_build_index_float(index->positions, (int)index->count, 3, &speedup, &p);
    leave();
    if (!index->tree)
        return rt_fail(error, RT_ERROR_MEMORY, "the search tree of %zu photons could not be built",
                       index->count);
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
    rt_status status = copy ? RT_OK : RT_ERROR_MEMORY;
    const uint64_t wanted = (uint64_t)count * BYTES_PER_POINT;
    if (status == RT_OK)
        status = rt_memory_take(memory, wanted, what, error);
    if (status != RT_OK) {
        rt_memory_free(index);
        rt_memory_free(copy);
        return status;
    }
    index->memory = memory;
    index->taken = wanted;
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
    if (index->tree) {
        struct FLANNParameters p = parameters();
        enter();
        flann_free_index_float(index->tree, &p);
        leave();
    }
    rt_memory_give(index->memory, index->taken);
    rt_memory_free(index->positions);
    rt_memory_free(index);
}

rt_status rt_flann_index_nearest(const rt_flann_index *index, const float *queries,
                                 size_t query_count, size_t k, int *indices, float *squared,
                                 rt_error *error)
{
    struct FLANNParameters p = parameters();

    assert(k >= 1 && k <= index->count);
    if (query_count == 0)
        return RT_OK;
    if (query_count > INT_MAX || !memory_is_there(query_count, k * sizeof(size_t)))
        return rt_fail(error, RT_ERROR_MEMORY,
                       "no memory for the %zu nearest photons of %zu points", k, query_count);
    for (size_t i = 0; i < query_count * k; i++)
        squared[i] = HUGE_VALF;
    enter();
    int failed = flann_find_nearest_neighbors_index_float(
        index->tree, (float *)queries, (int)query_count, indices, squared, (int)k, &p);
    leave();
    if (failed)
        return rt_fail(error, RT_ERROR_MEMORY, "the search for the %zu nearest photons failed", k);
    return RT_OK;
}
