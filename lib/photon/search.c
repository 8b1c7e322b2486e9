#include "photon/search.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "accel/parallel.h"
#include "error.h"
#include "photon/flann_index.h"

/* Results that FLANN is asked for at a time: bounds the memory, 16 bytes each. */
enum { RESULTS_A_CALL = 1 << 22 };

/* Most photons looked at for a point, as a multiple of k. */
enum { LOOK_MAX = 16 };

enum { POINTS_A_JOB = 512 };

static const float normal_cosine_min = 0.5f;

struct rt_photon_search {
    rt_flann_index *index;
    float (*normals)[3]; /* of the photons */
    size_t count;        /* photons */
    uint32_t k;
    float squared_limit; /* of the radius */
    uint32_t threads;
    int *found;     /* [RESULTS_A_CALL at least], photons by distance */
    float *squared; /* beside it, squared distances */
    size_t results; /* length of both */
};

/* Positions alone, as the tree wants them, or normals alone, close together in memory. */
static float (*copy_vectors(const rt_photon_map *map, size_t member))[3]
{
    float(*vectors)[3] = malloc((map->count ? map->count : 1) * sizeof *vectors);
    if (vectors)
        for (size_t i = 0; i < map->count; i++)
            memcpy(vectors[i], (const char *)(map->photons + i) + member, sizeof *vectors);
    return vectors;
}

static size_t smaller(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* The most photons that are looked at for one point. */
static size_t look_limit(const rt_photon_search *search)
{
    return smaller(search->count, (size_t)LOOK_MAX * search->k);
}

rt_status rt_photon_search_create(rt_photon_search **out, const rt_photon_map *map, uint32_t k, float max_radius,
                                  uint32_t threads, rt_error *error)
{
    rt_photon_search *search = calloc(1, sizeof *search);
    float(*positions)[3] = copy_vectors(map, offsetof(rt_photon, position));
    rt_status status = RT_OK;

    if (!search || !positions) {
        free(search);
        free(positions);
        return rt_fail(error, RT_ERROR_MEMORY, "no memory to search %zu photons", map->count);
    }
    search->count = map->count;
    search->normals = copy_vectors(map, offsetof(rt_photon, normal));
    search->k = k;
    search->squared_limit = max_radius * max_radius;
    search->threads = threads;
    search->results = look_limit(search) > RESULTS_A_CALL ? look_limit(search) : RESULTS_A_CALL;
    search->found = malloc(search->results * sizeof *search->found);
    search->squared = malloc(search->results * sizeof *search->squared);
    if (!search->normals || !search->found || !search->squared)
        status = rt_fail(error, RT_ERROR_MEMORY, "no memory to search %zu photons", map->count);
    if (status == RT_OK)
        status = rt_flann_index_create(&search->index, positions[0], map->count, error);
    free(positions);
    if (status == RT_OK)
        *out = search;
    else
        rt_photon_search_destroy(search);
    return status;
}

void rt_photon_search_destroy(rt_photon_search *search)
{
    if (!search)
        return;
    rt_flann_index_destroy(search->index);
    free(search->normals);
    free(search->found);
    free(search->squared);
    free(search);
}

size_t rt_photon_search_stride(const rt_photon_search *search)
{
    return smaller(search->count, search->k);
}

/* Whether there is anything to gather; the tree must not be asked for a place that is not finite. */
static int is_asked(const rt_gather_point *point)
{
    const float *p = point->position, *w = point->weight;
    return (w[0] != 0 || w[1] != 0 || w[2] != 0) && isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]);
}

static int is_accepted(const float a[3], const float b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] > normal_cosine_min;
}

/*
 * Ranks the nearest `looked` photons of a point. Returns 1 with the disc complete, or 0 when
 * more photons have to be looked at.
 */
static int rank(const rt_photon_search *search, const rt_gather_point *point, const int *found, const float *squared,
                size_t looked, rt_u32 *list, rt_gather_disc *disc)
{
    rt_u32 accepted = 0;
    size_t last = 0; /* place of the photon accepted last */

    disc->squared_radius = search->squared_limit;
    for (size_t j = 0; j < looked && squared[j] < search->squared_limit; j++) {
        if (!is_accepted(search->normals[found[j]], point->normal))
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
    if (squared[looked - 1] >= search->squared_limit)
        return 1;
    if (looked == search->count) {
        if (search->squared_limit < HUGE_VALF)
            return 1;
        /* No limit, and the map has too few: the farthest stands for the k-th. */
        disc->squared_radius = accepted ? squared[last] : 0;
        disc->count = accepted ? accepted - 1 : 0;
        return 1;
    }
    if (looked == look_limit(search)) {
        disc->squared_radius = squared[looked - 1];
        disc->count = accepted - (accepted && last == looked - 1);
        return 1;
    }
    return 0;
}

/* Points to be ranked. */
typedef struct ranking {
    const rt_photon_search *search;
    const rt_gather_point *points;
    const rt_u32 *asked; /* [count], which points */
    size_t count, looked;
    rt_u32 *lists;
    rt_gather_disc *discs;
} ranking;

/* Ranks a share of the points; a disc that needs more photons gets a negative squared radius. */
static void rank_share(void *user, uint32_t index)
{
    const ranking *r = user;
    const rt_photon_search *search = r->search;
    size_t begin = (size_t)index * POINTS_A_JOB, end = smaller(begin + POINTS_A_JOB, r->count);

    for (size_t i = begin; i < end; i++) {
        size_t at = r->asked[i];
        if (!rank(search, r->points + at, search->found + i * r->looked, search->squared + i * r->looked, r->looked,
                  r->lists + at * rt_photon_search_stride(search), r->discs + at))
            r->discs[at].squared_radius = -1;
    }
}

/*
 * Looks at the nearest `look` photons of the points in asked[*count]; those that need more stay
 * in asked, and *count becomes their number.
 */
static rt_status look_at(rt_photon_search *search, const rt_gather_point *points, rt_u32 *asked, size_t *count,
                         size_t look, float *queries, rt_u32 *lists, rt_gather_disc *discs, rt_error *error)
{
    size_t batch = search->results / look, left = 0;

    for (size_t first = 0; first < *count; first += batch) {
        ranking part = {search, points, asked + first, smaller(batch, *count - first), look, lists, discs};
        for (size_t i = 0; i < part.count; i++)
            for (int c = 0; c < 3; c++)
                queries[3 * i + c] = points[part.asked[i]].position[c];
        rt_status status = rt_flann_index_nearest(search->index, queries, part.count, look, search->threads,
                                                  search->found, search->squared, error);
        if (status != RT_OK)
            return status;
        rt_parallel(search->threads, (uint32_t)((part.count + POINTS_A_JOB - 1) / POINTS_A_JOB), rank_share, &part);
        for (size_t i = 0; i < part.count; i++)
            if (discs[part.asked[i]].squared_radius < 0)
                asked[left++] = part.asked[i];
    }
    *count = left;
    return RT_OK;
}

rt_status rt_photon_search_find(rt_photon_search *search, const rt_gather_point *points, size_t count, rt_u32 *lists,
                                rt_gather_disc *discs, uint64_t *asked_count, rt_error *error)
{
    rt_u32 *asked = malloc((count ? count : 1) * sizeof *asked);
    float *queries = malloc((count ? count : 1) * 3 * sizeof *queries);
    rt_status status = RT_OK;
    size_t left = 0;

    if (!asked || !queries)
        status = rt_fail(error, RT_ERROR_MEMORY, "no memory for %zu queries of the photon map", count);
    for (size_t i = 0; i < count && status == RT_OK; i++) {
        discs[i] = (rt_gather_disc){0};
        if (is_asked(points + i))
            asked[left++] = (rt_u32)i;
    }
    if (asked_count)
        *asked_count += left;
    /* Most points are done with k photons; the others look at twice as many, and again. */
    if (search->count == 0)
        left = 0;
    for (size_t look = rt_photon_search_stride(search); left > 0 && status == RT_OK;) {
        status = look_at(search, points, asked, &left, look, queries, lists, discs, error);
        look = smaller(2 * look, look_limit(search));
    }
    free(asked);
    free(queries);
    return status;
}
