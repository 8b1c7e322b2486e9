/*
 * test_gather_tree.c - the gather on the device finds the photons that FLANN finds, and both find
 * those of brute force: the same disc and the same set, whatever the number of photons, k, and the
 * limit.
 *
 * Photons lie on the sides of a box and, much denser, in a spot on its floor; some face the wrong
 * way. Their places are random numbers of 24 bits, so that equal distances are rare; a disc whose
 * edge two photons share is told apart by its radius and left out of the comparison of sets (a tie
 * is in one of them by chance).
 */
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bsdf/lobes.h"
#include "lib/photon/points.h"
#include "photon/gather_tree.h"
#include "photon/point_order.h"
#include "photon/neighbour_search.h"

/* Queries are asked in parts of so many list entries. */
enum { ENTRIES = 1 << 20 };

static rt_photon_list make_list(size_t count)
{
    rt_photon_list list = {.photons = calloc(count ? count : 1, sizeof(rt_photon)),
                           .count = count,
                           .capacity = count,
                           .emitted = count};
    points_stream stream = {17};
    assert_non_null(list.photons);
    for (size_t i = 0; i < count; i++) {
        rt_photon *p = list.photons + i;
        int side = (int)(6 * points_uniform(&stream)), axis = side / 2;
        p->position[axis] = (float)(side % 2);
        p->position[(axis + 1) % 3] = points_uniform(&stream);
        p->position[(axis + 2) % 3] = points_uniform(&stream);
        p->normal[axis] = side % 2 ? -1.0f : 1.0f;
        if (i % 5 == 0) { /* a caustic */
            p->position[0] = 0.4f + 0.03f * points_uniform(&stream);
            p->position[1] = 0;
            p->position[2] = 0.7f + 0.03f * points_uniform(&stream);
            memcpy(p->normal, (float[3]){0, 1, 0}, sizeof p->normal);
        }
        if (i % 16 == 3)
            p->normal[axis] = -p->normal[axis];
        p->shading = 1;
    }
    return list;
}

/*
 * Points on the floor, one in four on the caustic, and a few that hardly any photon fits; one in
 * seven gathers the photons of both sides.
 */
static rt_gather_point *make_points(size_t count)
{
    rt_gather_point *points = calloc(count, sizeof *points);
    points_stream stream = {23};
    assert_non_null(points);
    for (size_t i = 0; i < count; i++) {
        float x = points_uniform(&stream), z = points_uniform(&stream);
        points[i].position[0] = i % 4 ? x : 0.39f + 0.05f * x;
        points[i].position[2] = i % 4 ? z : 0.69f + 0.05f * z;
        points[i].normal[i % 101 == 50 ? 0 : 1] = i % 211 == 30 ? -1.0f : 1.0f;
        points[i].weight[0] = 1;
        points[i].lobe = i % 7 == 2 ? RT_LOBE_TRANSLUCENT : RT_LOBE_LAMBERT;
    }
    return points;
}

typedef struct problem {
    rt_photon_list list;
    rt_gather_point *points;
    size_t queries;
    uint32_t k; /* 0: all within the limit */
    float limit;
} problem;

/* ---- The contestants --------------------------------------------------------- */

typedef struct answers {
    size_t stride;
    rt_gather_disc *discs; /* [part] */
    rt_u32 *lists;         /* [part][stride] */
} answers;

static int by_index(const void *a, const void *b)
{
    rt_u32 x = *(const rt_u32 *)a, y = *(const rt_u32 *)b;
    return (x > y) - (x < y);
}

static void sort_lists(answers *a, size_t part)
{
    for (size_t i = 0; i < part; i++)
        qsort(a->lists + i * a->stride, a->discs[i].count, sizeof *a->lists, by_index);
}

/* The photons in the order of the tree; to be freed. */
static uint64_t *order_of(const rt_photon_list *list)
{
    uint64_t *order = calloc(2 * list->count + 1, sizeof *order);
    rt_error error;
    assert_non_null(order);
    if (list->count > 0)
        expect_ok(rt_point_order(order, order + list->count, list->photons->position,
                                 sizeof *list->photons, list->count, test_device()->threads,
                                 &error),
                  &error);
    return order;
}

static void ask_device(answers *a, rt_tree_gather *g, const uint64_t *order, cl_kernel kernel,
                       const rt_gather_point *points, size_t part)
{
    cl_mem on = test_buffer(part * sizeof *points, points);
    cl_mem lists = test_buffer(part * a->stride * sizeof *a->lists, NULL);
    cl_mem scratch = test_buffer(part * g->estimate.stride * sizeof(float), NULL);
    rt_params params;
    memset(&params, 0, sizeof params);
    params.item_count = (rt_u32)part;
    params.slots = (rt_u32)a->stride;
    rt_arg args[] = {RT_ARG(params),    RT_ARG(g->estimate),   RT_ARG(on),
                     RT_ARG(g->discs),  RT_ARG(g->tree.shape), RT_ARG(g->nodes),
                     RT_ARG(g->blocks), RT_ARG(scratch),       RT_ARG(scratch),
                     RT_ARG(lists)};
    test_run(kernel, args, sizeof args / sizeof *args, part);
    test_read(g->discs, part * sizeof *a->discs, a->discs);
    test_read(lists, part * a->stride * sizeof *a->lists, a->lists);
    rt_buffer_release(test_device(), on);
    rt_buffer_release(test_device(), lists);
    rt_buffer_release(test_device(), scratch);
    for (size_t i = 0; i < part; i++) {
        assert_true(a->discs[i].count <= a->stride);
        /* what the sum counts is what is listed */
        assert_int_equal(a->discs[i].count, a->discs[i].is_query);
        for (rt_u32 *place = a->lists + i * a->stride, *end = place + a->discs[i].count;
             place < end; place++)
            *place = (rt_u32)(order[*place] & RT_POINT_ORDER_INDEX);
    }
    sort_lists(a, part);
}

typedef struct near {
    float squared;
    rt_u32 index;
    int accepted;
} near;

static int by_distance(const void *a, const void *b)
{
    const near *x = a, *y = b;
    return (x->squared > y->squared) - (x->squared < y->squared);
}

/* The rules of lib/photon/neighbour_search.h, by sorting all photons. */
static void ask_all(answers *a, const problem *p, const rt_gather_point *points, size_t part)
{
    size_t n = p->list.count;
    near *all = malloc((n ? n : 1) * sizeof *all);
    assert_non_null(all);
    for (size_t q = 0; q < part; q++) {
        size_t accepted = 0, max_candidates = (size_t)RT_CANDIDATES_MAX * p->k;
        float edge = p->limit * p->limit, farthest = 0;
        for (size_t i = 0; i < n; i++) {
            const float *x = p->list.photons[i].position, *y = points[q].position;
            const float *m = p->list.photons[i].normal, *o = points[q].normal;
            all[i].squared = (y[0] - x[0]) * (y[0] - x[0]) + (y[1] - x[1]) * (y[1] - x[1]) +
                             (y[2] - x[2]) * (y[2] - x[2]);
            all[i].index = (rt_u32)i;
            const float cosine = m[0] * o[0] + m[1] * o[1] + m[2] * o[2];
            const int of_both_sides = points[q].lobe == RT_LOBE_TRANSLUCENT;
            all[i].accepted = (of_both_sides ? fabsf(cosine) : cosine) > 0.5f;
        }
        qsort(all, n, sizeof *all, by_distance);
        for (size_t i = 0; i < n && p->k > 0 && all[i].squared < edge; i++) {
            if (all[i].accepted) {
                farthest = all[i].squared;
                if (++accepted == p->k)
                    edge = all[i].squared;
            }
            if (i + 1 == max_candidates && max_candidates < n)
                edge = all[i].squared;
        }
        if (edge == HUGE_VALF)
            edge = farthest;
        a->discs[q] = (rt_gather_disc){0, edge, 0, 0};
        for (size_t i = 0; i < n && all[i].squared < edge; i++)
            if (all[i].accepted)
                a->lists[q * a->stride + a->discs[q].count++] = all[i].index;
    }
    free(all);
    sort_lists(a, part);
}

/* ---- Comparison --------------------------------------------------------------- */

/* Discs and lists are the same; returns the number of ties that were left out. */
static size_t compare(const char *name, const answers *a, const answers *b, size_t part)
{
    size_t ties = 0;
    for (size_t i = 0; i < part; i++) {
        if (a->discs[i].count > 0 && a->discs[i].squared_radius != b->discs[i].squared_radius)
            fail_msg("%s, point %zu: radius^2 %.9g and %.9g, counts %u and %u", name, i,
                     a->discs[i].squared_radius, b->discs[i].squared_radius, a->discs[i].count,
                     b->discs[i].count);
        if (a->discs[i].count != b->discs[i].count) {
            ties++;
            continue;
        }
        if (memcmp(a->lists + i * a->stride, b->lists + i * b->stride,
                   a->discs[i].count * sizeof *a->lists) != 0)
            fail_msg("%s, point %zu: other photons", name, i);
    }
    return ties;
}

static answers make_answers(size_t part, size_t stride)
{
    answers a = {stride, calloc(part, sizeof *a.discs), malloc(part * stride * sizeof *a.lists)};
    assert_non_null(a.discs);
    assert_non_null(a.lists);
    return a;
}

static void free_answers(answers *a)
{
    free(a->discs);
    free(a->lists);
}

/* Asks FLANN (unless k is 0) and the device all queries, and brute force the first `brute`. */
static void compete(const problem *p, size_t brute)
{
    size_t stride = p->k ? p->k : p->list.count, part = ENTRIES / (stride ? stride : 1), ties = 0;
    float limit = p->limit < HUGE_VALF ? p->limit : HUGE_VALF;
    rt_density_params estimate = {0, 1.1f, 0, p->k, limit * limit, 0, 0, 1, RT_AREA_DISC, 0, {0}};
    rt_neighbour_search *search = NULL;
    rt_tree_gather on;
    rt_error error;
    part = part < 1 ? 1 : part > p->queries ? p->queries : part;
    cl_kernel kernel = test_kernel("knn", "neighbours");
    answers theirs = make_answers(part, stride), ours = make_answers(part, stride);
    uint64_t *order = order_of(&p->list);

    expect_ok(
        rt_tree_gather_prepare(&on, test_device(), &p->list, &estimate, NULL, &part, NULL, &error),
        &error);
    if (p->k)
        expect_ok(rt_neighbour_search_create(&search, &p->list, p->k, limit, 0,
                                             test_device()->threads, NULL, &error),
                  &error);
    for (size_t first = 0; first < p->queries; first += part) {
        size_t count = p->queries - first < part ? p->queries - first : part;
        const rt_gather_point *points = p->points + first;
        ask_device(&ours, &on, order, kernel, points, count);
        if (first == 0) {
            size_t few = brute < count ? brute : count;
            ask_all(&theirs, p, points, few);
            ties += compare("brute force", &theirs, &ours, few);
        }
        if (search) {
            theirs.stride = rt_neighbour_search_stride(search);
            expect_ok(
                rt_neighbour_search_find(search, points, count, theirs.lists, theirs.discs, &error),
                &error);
            sort_lists(&theirs, count);
            ties += compare("FLANN", &theirs, &ours, count);
            theirs.stride = stride;
        }
    }
    print_message("N %zu k %u limit %g: %zu points agree, %zu ties\n", p->list.count,
                  (unsigned)p->k, p->limit, p->queries - ties, ties);
    assert_true(ties <= p->queries / 1000 + 1);
    rt_neighbour_search_destroy(search);
    rt_tree_gather_release(&on, test_device());
    free_answers(&theirs);
    free_answers(&ours);
    free(order);
    rt_kernel_release(kernel);
}

static void compete_at(size_t photons, size_t queries, size_t brute)
{
    static const uint32_t ks[] = {2, 10, 50, 1000};
    problem p = {make_list(photons), make_points(queries), queries, 0, HUGE_VALF};
    for (size_t i = 0; i < sizeof ks / sizeof *ks; i++) {
        p.k = ks[i];
        p.queries = ks[i] < 1000 || queries > 10000 ? queries : queries / 10;
        p.limit = HUGE_VALF;
        compete(&p, brute);
        /* A limit that about half of the searches end at. */
        p.limit = sqrtf((float)ks[i] * 6 / (3.14159265f * (float)photons));
        compete(&p, brute);
    }
    p.queries = queries < 1000 ? queries : 1000;
    p.k = 0;
    p.limit = sqrtf(400.0f * 6 / (3.14159265f * (float)photons)); /* hundreds of photons inside */
    compete(&p, brute);
    free(p.list.photons);
    free(p.points);
}

static void no_photons(void **state)
{
    (void)state;
    compete_at(0, 100, 100);
}

static void one_photon(void **state)
{
    (void)state;
    compete_at(1, 100, 100);
}

static void a_hundred_photons(void **state)
{
    (void)state;
    compete_at(100, 10000, 10000);
}

static void ten_thousand_photons(void **state)
{
    (void)state;
    compete_at(10000, 10000, 100);
}

/*
 * With RT_TEST_LONG, all of the above with 10^5 queries, and k up to 1000 of a million photons:
 * minutes.
 */
static void a_million_photons(void **state)
{
    problem p = {{0}, NULL, 100000, 50, HUGE_VALF};
    (void)state;
    if (getenv("RT_TEST_LONG")) {
        compete_at(100, 100000, 1000);
        compete_at(10000, 100000, 100);
        compete_at(1000000, 100000, 10);
        return;
    }
    p.list = make_list(1000000);
    p.points = make_points(p.queries);
    compete(&p, 2);
    free(p.list.photons);
    free(p.points);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_photons),        cmocka_unit_test(one_photon),
        cmocka_unit_test(a_hundred_photons), cmocka_unit_test(ten_thousand_photons),
        cmocka_unit_test(a_million_photons),
    };
    return cmocka_run_group_tests_name("lib/photon/gather_tree", tests, NULL, NULL);
}
