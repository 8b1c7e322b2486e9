/* neighbour_search.c - finds candidates by FLANN and ranks them, on all threads. */
#include "photon/neighbour_search.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "bsdf/lobes.h"
#include "photon/flann_index.h"
#include "photon/photon_boxes.h"
#include "photon/point_order.h"

/* Neighbours that a thread finds at a time, 16 bytes each: few enough to stay in its cache. */
enum { NEIGHBOURS_A_JOB = 1 << 16 };

static const char what[] = "the search of the photon map";

struct rt_neighbour_search {
    rt_memory *memory;
    rt_flann_index *index;
    float (*normals)[3];    /* of the photons */
    rt_photon_boxes *boxes; /* NULL: empty discs are searched for as others are */
    size_t count;           /* photons */
    uint32_t k;
    float squared_limit; /* of the radius */
    uint32_t threads;
};

/* Positions alone, as the tree takes them, or normals alone, close together in memory. */
static float (*copy_vectors(const rt_photon_list *map, size_t member, rt_memory *memory,
                            rt_error *error))[3]
{
    float(*vectors)[3] = rt_memory_alloc(memory, map->count, sizeof *vectors, what, error);
    if (vectors)
        for (size_t i = 0; i < map->count; i++)
            memcpy(vectors[i], (const char *)(map->photons + i) + member, sizeof *vectors);
    return vectors;
}

static size_t smaller(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* The most candidates of one point. */
static size_t max_candidates(const rt_neighbour_search *search)
{
    return smaller(search->count, (size_t)RT_CANDIDATES_MAX * search->k);
}

rt_status rt_neighbour_search_create(rt_neighbour_search **out, const rt_photon_list *map,
                                     uint32_t k, float max_radius, int skip_empty, uint32_t threads,
                                     rt_memory *memory, rt_error *error)
{
    rt_neighbour_search *search = rt_memory_zeroed(NULL, 1, sizeof *search, what, error);
    if (!search)
        return RT_ERROR_MEMORY;
    float(*positions)[3] = copy_vectors(map, offsetof(rt_photon, position), memory, error);
    rt_status status = positions ? RT_OK : RT_ERROR_MEMORY;
    search->memory = memory;
    search->count = map->count;
    if (status == RT_OK)
        search->normals = copy_vectors(map, offsetof(rt_photon, normal), memory, error);
    search->k = k;
    search->squared_limit = max_radius * max_radius;
    search->threads = threads;
    if (!search->normals)
        status = RT_ERROR_MEMORY;
    if (status == RT_OK)
        status = rt_flann_index_create(&search->index, positions[0], map->count, memory, error);
    if (status == RT_OK && skip_empty && map->count > 0 && map->count <= RT_POINT_ORDER_INDEX)
        status = rt_photon_boxes_create(&search->boxes, map, max_candidates(search), threads,
                                        memory, error);
    rt_memory_free(positions);
    if (status == RT_OK)
        *out = search;
    else
        rt_neighbour_search_destroy(search);
    return status;
}

void rt_neighbour_search_destroy(rt_neighbour_search *search)
{
    if (!search)
        return;
    rt_flann_index_destroy(search->index);
    rt_photon_boxes_destroy(search->boxes);
    rt_memory_free(search->normals);
    rt_memory_free(search);
}

size_t rt_neighbour_search_stride(const rt_neighbour_search *search)
{
    return smaller(search->count, search->k);
}

/*
 * Whether there is anything to gather; the tree must not be given a point that is not finite.
 */
static int is_query(const rt_gather_point *point)
{
    const float *p = point->position, *w = point->weight;
    return (w[0] != 0 || w[1] != 0 || w[2] != 0) && isfinite(p[0]) && isfinite(p[1]) &&
           isfinite(p[2]);
}

/* Whether a point gathers photons of both sides of its surface. */
static int is_translucent(const rt_gather_point *point)
{
    return point->lobe == RT_LOBE_TRANSLUCENT;
}

static int is_accepted(const float a[3], const rt_gather_point *point)
{
    const float *b = point->normal, cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    return (is_translucent(point) ? fabsf(cosine) : cosine) > RT_PHOTON_NORMAL_COSINE;
}

/*
 * Ranks the candidates of a point, nearest first. Returns 1 with the disc complete, or 0 when more
 * candidates are needed.
 */
static int rank(const rt_neighbour_search *search, const rt_gather_point *point, const int *found,
                const float *squared, size_t candidates, rt_u32 *list, rt_gather_disc *disc)
{
    rt_u32 accepted = 0;
    size_t last = 0; /* place of the photon accepted last */

    disc->squared_radius = search->squared_limit;
    for (size_t j = 0; j < candidates && squared[j] < search->squared_limit; j++) {
        if (!is_accepted(search->normals[found[j]], point))
            continue;
        last = j;
        if (accepted + 1 == search->k) {
            disc->squared_radius = squared[j];
            disc->count = accepted;
            return 1;
        }
        list[accepted++] = (rt_u32)found[j];
    }
    disc->count = accepted;
    if (squared[candidates - 1] >= search->squared_limit)
        return 1;
    if (candidates == search->count) {
        if (search->squared_limit < HUGE_VALF)
            return 1;
        /* No limit, and fewer than k in the map: the farthest photon gives the radius. */
        disc->squared_radius = accepted ? squared[last] : 0;
        disc->count = accepted ? accepted - 1 : 0;
        return 1;
    }
    if (candidates == max_candidates(search)) {
        disc->squared_radius = squared[candidates - 1];
        disc->count = accepted - (accepted && last == candidates - 1);
        return 1;
    }
    return 0;
}

/* Points whose nearest photons are candidates, a row of them for each point. */
typedef struct ranking {
    const rt_neighbour_search *search;
    const rt_gather_point *points;
    const rt_u32 *queries; /* [count], which points */
    size_t count, candidates;
    size_t points_a_job;
    rt_u32 *lists;
    rt_gather_disc *discs;
    unsigned char *failed; /* [jobs], set where memory ran out */
} ranking;

/*
 * Finds and ranks the candidates of a share of the points; a disc that needs more gets a negative
 * squared radius.
 */
static void rank_share(void *user, uint32_t index)
{
    const ranking *l = user;
    const rt_neighbour_search *search = l->search;
    const rt_u32 *queries = l->queries + index * l->points_a_job;
    size_t count = smaller(l->points_a_job, l->count - index * l->points_a_job);
    size_t row = l->candidates;
    rt_memory *memory = search->memory;
    float(*positions)[3] = rt_memory_alloc(memory, count, sizeof *positions, what, NULL);
    int *found = rt_memory_alloc(memory, count * row, sizeof *found, what, NULL);
    float *squared = rt_memory_alloc(memory, count * row, sizeof *squared, what, NULL);

    l->failed[index] = !positions || !found || !squared;
    for (size_t i = 0; i < count && !l->failed[index]; i++)
        memcpy(positions[i], l->points[queries[i]].position, sizeof *positions);
    if (!l->failed[index])
        l->failed[index] = rt_flann_index_nearest(search->index, positions[0], count, row, found,
                                                  squared, NULL) != RT_OK;
    for (size_t i = 0; i < count && !l->failed[index]; i++) {
        rt_u32 *list = l->lists + queries[i] * rt_neighbour_search_stride(search);
        rt_gather_disc *disc = l->discs + queries[i];
        if (!rank(search, l->points + queries[i], found + i * row, squared + i * row, row, list,
                  disc))
            disc->squared_radius = -1;
    }
    rt_memory_free(positions);
    rt_memory_free(found);
    rt_memory_free(squared);
}

/* Says what so many threads need at a time: more than the limit, or more than there is. */
static rt_status fail_ranking(const ranking *l, size_t threads, rt_error *error)
{
    double each = sizeof(float[3]) + (double)l->candidates * (sizeof(int) + sizeof(float));
    rt_status status = rt_memory_foresee(l->search->memory,
                                         each * (double)(threads * l->points_a_job), what, error);
    return status == RT_OK ? rt_fail(error, RT_ERROR_MEMORY,
                                     "no memory for the %zu nearest photons of %zu points",
                                     l->candidates, l->count)
                           : status;
}

/*
 * Ranks so many candidates of the points in queries[*count], on all threads; those that need more
 * stay in queries, and *count becomes their number.
 */
static rt_status rank_all(const rt_neighbour_search *search, const rt_gather_point *points,
                          rt_u32 *queries, size_t *count, size_t candidates, rt_u32 *lists,
                          rt_gather_disc *discs, rt_error *error)
{
    ranking l = {search, points, queries, *count, candidates, 1, lists, discs, NULL};
    size_t left = 0;
    int failed = 0;

    if (candidates < NEIGHBOURS_A_JOB)
        l.points_a_job = NEIGHBOURS_A_JOB / candidates;
    size_t jobs = (*count + l.points_a_job - 1) / l.points_a_job;
    l.failed = rt_memory_zeroed(search->memory, jobs, 1, what, error);
    if (!l.failed)
        return RT_ERROR_MEMORY;
    rt_parallel(search->threads, (uint32_t)jobs, rank_share, &l);
    for (size_t i = 0; i < jobs; i++)
        failed |= l.failed[i];
    rt_memory_free(l.failed);
    if (failed)
        return fail_ranking(&l, smaller(jobs, search->threads), error);
    for (size_t i = 0; i < *count; i++)
        if (discs[queries[i]].squared_radius < 0)
            queries[left++] = queries[i];
    *count = left;
    return RT_OK;
}

/*
 * Finds the query points, in the order of a curve: those near each other visit the same nodes of
 * the tree.
 */
static rt_status find_queries(rt_u32 *queries, size_t *count, const rt_gather_point *points,
                              size_t point_count, const rt_neighbour_search *search,
                              rt_error *error)
{
    rt_memory *memory = search->memory;
    float(*positions)[3] = rt_memory_alloc(memory, point_count, sizeof *positions, what, error);
    uint64_t *items =
        positions ? rt_memory_alloc(memory, point_count, 2 * sizeof *items, what, error) : NULL;
    rt_status status = RT_OK;
    size_t n = 0;

    if (!items) {
        rt_memory_free(positions);
        return RT_ERROR_MEMORY;
    }
    for (size_t i = 0; i < point_count; i++)
        if (is_query(points + i)) {
            memcpy(positions[n], points[i].position, sizeof *positions);
            queries[n++] = (rt_u32)i;
        }
    if (n > 0)
        status = rt_point_order(items, items + n, positions[0], sizeof *positions, n,
                                search->threads, error);
    /* Reuse the key array to permute the queries into curve order. */
    for (size_t i = 0; i < n && status == RT_OK; i++)
        items[i] = queries[items[i] & RT_POINT_ORDER_INDEX];
    for (size_t i = 0; i < n && status == RT_OK; i++)
        queries[i] = (rt_u32)items[i];
    rt_memory_free(positions);
    rt_memory_free(items);
    *count = n;
    return status;
}

/* ---- Discs without photons ------------------------------------------------- */

enum { POINTS_A_TEST = 1 << 10, TEST_EVERY = 16 }; /* points of a job, and those tested first */

/* Points in the order of a curve that may have no photon. */
typedef struct emptiness {
    const rt_neighbour_search *search;
    const rt_gather_point *points;
    const rt_u32 *queries; /* [count] */
    size_t count, every;
    const rt_gather_disc *discs; /* what was found so far */
    unsigned char *empty;        /* [count], set where it is so */
} emptiness;

static int is_empty(const emptiness *e, size_t i)
{
    const rt_gather_point *point = e->points + e->queries[i];
    const float *normal = point->normal, other[3] = {-normal[0], -normal[1], -normal[2]};
    const rt_photon_boxes *boxes = e->search->boxes;
    const float limit = e->search->squared_limit;
    return e->discs[e->queries[i]].count == 0 &&
           rt_photon_boxes_none(boxes, point->position, normal, limit) &&
           (!is_translucent(point) || rt_photon_boxes_none(boxes, point->position, other, limit));
}

/* Tests some of the points of a share; and, where one of these is empty, those up to the next. */
static void test_share(void *user, uint32_t index)
{
    const emptiness *e = user;
    size_t end = smaller(((size_t)index + 1) * POINTS_A_TEST, e->count);
    for (size_t i = (size_t)index * POINTS_A_TEST; i < end; i++)
        if (i % e->every == 0 || e->empty[i - i % e->every])
            e->empty[i] = (unsigned char)is_empty(e, i);
}

/* Takes the points away that surely have no photon, looking closer at every so many. */
static rt_status drop_empty(const rt_neighbour_search *search, const rt_gather_point *points,
                            rt_u32 *queries, size_t *count, size_t every, rt_gather_disc *discs,
                            rt_error *error)
{
    size_t left = 0;
    if (!search->boxes || *count == 0)
        return RT_OK;
    emptiness e = {search, points, queries, *count, every, discs, NULL};
    e.empty = rt_memory_zeroed(search->memory, *count, 1, what, error);
    if (!e.empty)
        return RT_ERROR_MEMORY;
    rt_parallel(search->threads, (uint32_t)((*count + POINTS_A_TEST - 1) / POINTS_A_TEST),
                test_share, &e);
    for (size_t i = 0; i < *count; i++) {
        if (e.empty[i])
            discs[queries[i]].count = 0;
        else
            queries[left++] = queries[i];
    }
    rt_memory_free(e.empty);
    *count = left;
    return RT_OK;
}

rt_status rt_neighbour_search_find(const rt_neighbour_search *search, const rt_gather_point *points,
                                   size_t count, rt_u32 *lists, rt_gather_disc *discs,
                                   rt_error *error)
{
    rt_u32 *queries = rt_memory_alloc(search->memory, count, sizeof *queries, what, error);
    size_t left = 0;

    if (!queries)
        return RT_ERROR_MEMORY;
    for (size_t i = 0; i < count; i++)
        discs[i] = (rt_gather_disc){.pixel = points[i].pixel};
    rt_status status = find_queries(queries, &left, points, count, search, error);
    for (size_t i = 0; i < left && status == RT_OK; i++)
        discs[queries[i]].is_query = 1;
    if (search->count == 0)
        left = 0;
    if (status == RT_OK)
        status = drop_empty(search, points, queries, &left, TEST_EVERY, discs, error);
    /* Most points are done with k candidates; the others take twice as many, and again. */
    size_t first = rt_neighbour_search_stride(search);
    for (size_t candidates = first; left > 0 && status == RT_OK;) {
        status = rank_all(search, points, queries, &left, candidates, lists, discs, error);
        if (status == RT_OK && candidates == first)
            status = drop_empty(search, points, queries, &left, 1, discs, error);
        candidates = smaller(2 * candidates, max_candidates(search));
    }
    for (size_t i = 0; i < count && search->boxes; i++)
        discs[i].squared_radius = discs[i].count > 0 ? discs[i].squared_radius : 0;
    rt_memory_free(queries);
    return status;
}
