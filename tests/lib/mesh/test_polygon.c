/* Polygons as triangles: what is inside is covered once, whatever corner is first. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "mesh/ears.h"

enum { FEW = 64, MANY = 10000, VERY_MANY = 1000000 };

/* A polygon in the plane. */
typedef struct outline {
    double p[MANY][2];
    size_t count;
} outline;

static outline shape; /* too large for the stack */
static double corners[MANY][3];
static uint32_t triangles[MANY][3];

static uint32_t state_of_random;

static double uniform(void)
{
    state_of_random = state_of_random * 1664525u + 1013904223u;
    return (state_of_random >> 8) * 0x1p-24;
}

static double turn(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* Its area by the shoelace formula. */
static double area_of(const outline *o)
{
    double sum = 0;
    for (size_t i = 0; i < o->count; i++)
        sum += 0.5 * turn(o->p[0], o->p[i], o->p[(i + 1) % o->count]);
    return sum;
}

/* Whether a point is inside, by how often a ray crosses edges. */
static int is_inside(const outline *o, const double *q)
{
    int odd = 0;
    for (size_t i = 0; i < o->count; i++) {
        const double *a = o->p[i], *b = o->p[(i + 1) % o->count];
        if ((a[1] > q[1]) != (b[1] > q[1]))
            odd ^= q[0] < a[0] + (q[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
    }
    return odd;
}

/* The same outline from another corner on. */
static void rotate(outline *o)
{
    double first[2];
    memcpy(first, o->p[0], sizeof first);
    memmove(o->p[0], o->p[1], (o->count - 1) * sizeof first);
    memcpy(o->p[o->count - 1], first, sizeof first);
}

/* Where in space the plane is: turned, and bent by so much. */
static void place(const outline *o, double bend)
{
    for (size_t i = 0; i < o->count; i++) {
        const double *p = o->p[i], z = bend * sin(3 * p[0] + 5 * p[1]);
        corners[i][0] = 7 + 0.6 * p[0] - 0.48 * p[1] + 0.64 * z;
        corners[i][1] = -3 + 0.8 * p[0] + 0.36 * p[1] - 0.48 * z;
        corners[i][2] = 0.8 * p[1] + 0.6 * z;
    }
}

static rt_polygon cut(size_t count)
{
    rt_polygon found;
    assert_int_equal(rt_polygon_cut(triangles[0], &found, corners[0], count, NULL), RT_OK);
    for (size_t i = 0; i < count - 2; i++)
        for (int k = 0; k < 3; k++)
            assert_true(triangles[i][k] < count);
    return found;
}

/* Every triangle turns as the polygon does, together they have its area, and points agree. */
static void expect_cover(const outline *o, double slack)
{
    double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY}, sum = 0;
    const double area = area_of(o);
    for (size_t i = 0; i < o->count - 2; i++) {
        const uint32_t *t = triangles[i];
        double part = 0.5 * turn(o->p[t[0]], o->p[t[1]], o->p[t[2]]);
        assert_true(part * area >= -slack * area * area);
        sum += fabs(part);
    }
    assert_true(fabs(sum - fabs(area)) <= (slack + 1e-9) * fabs(area));
    for (size_t i = 0; i < o->count; i++)
        for (int c = 0; c < 2; c++) {
            lo[c] = fmin(lo[c], o->p[i][c]);
            hi[c] = fmax(hi[c], o->p[i][c]);
        }
    for (int k = 0; k < 20 && slack == 0; k++) {
        const double q[2] = {lo[0] + uniform() * (hi[0] - lo[0]),
                             lo[1] + uniform() * (hi[1] - lo[1])};
        int covered = 0;
        for (size_t i = 0; i < o->count - 2; i++) {
            const double *a = o->p[triangles[i][0]], *b = o->p[triangles[i][1]],
                         *c = o->p[triangles[i][2]];
            const double s = area > 0 ? 1 : -1;
            covered += s * turn(a, b, q) > 0 && s * turn(b, c, q) > 0 && s * turn(c, a, q) > 0;
        }
        assert_int_equal(covered, is_inside(o, q));
    }
}

/* From every corner on, and the other way round too. */
static void expect_simple(outline *o)
{
    for (int way = 0; way < 2; way++) {
        for (size_t i = 0; i < o->count; i++, rotate(o)) {
            place(o, 0);
            assert_int_equal(cut(o->count), RT_POLYGON_SIMPLE);
            expect_cover(o, 0);
        }
        for (size_t i = 0; i < o->count; i++)
            o->p[i][0] = -o->p[i][0];
    }
}

static void use(const double (*p)[2], size_t count)
{
    shape.count = count;
    memcpy(shape.p, p, count * sizeof *p);
}

#define USE(p) use(p, sizeof(p) / sizeof *(p))

static const double horseshoe[][2] = {{0, 0}, {3, 0}, {3, 3}, {2, 3},
                                      {2, 1}, {1, 1}, {1, 3}, {0, 3}};

static void every_corner_may_be_the_first(void **state)
{
    (void)state;
    static const double dart[][2] = {{0, 0}, {2, 0.5}, {0.5, 0.5}, {0.5, 2}};
    static const double straight[][2] = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 1}, {0, 2}};
    static const double comb[][2] = {{0, 0}, {5, 0}, {5, 4}, {4, 0.5}, {4, 4}, {3, 1},
                                     {3, 4}, {2, 1}, {2, 4}, {1, 0.5}, {1, 4}, {0, 1}};
    static const double twice[][2] = {{0, 0}, {3, 0}, {3, 0}, {3, 3}, {1, 1}, {1, 1}, {0, 3}};
    USE(horseshoe);
    assert_float_equal(area_of(&shape), 7, 1e-12);
    expect_simple(&shape);
    USE(dart);
    expect_simple(&shape);
    USE(straight);
    expect_simple(&shape);
    USE(comb);
    expect_simple(&shape);
    USE(twice);
    expect_simple(&shape);
}

static void a_bridge_joins_a_hole(void **state)
{
    (void)state;
    static const double one[][2] = {{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0},
                                    {1, 1}, {1, 2}, {2, 2}, {2, 1}, {1, 1}};
    static const double two[][2] = {{0, 0}, {5, 0}, {5, 3}, {0, 3}, {0, 0}, {1, 1}, {1, 2}, {2, 2},
                                    {2, 1}, {3, 1}, {3, 2}, {4, 2}, {4, 1}, {3, 1}, {2, 1}, {1, 1}};
    static const double touching[][2] = {{0, 0}, {4, 0}, {4, 4}, {2, 4}, {3, 2},
                                         {2, 1}, {1, 2}, {2, 4}, {0, 4}};
    USE(one);
    assert_float_equal(area_of(&shape), 8, 1e-12);
    expect_simple(&shape);
    USE(two);
    expect_simple(&shape);
    USE(touching);
    expect_simple(&shape);
}

/* Whether two edges without a common corner meet. */
static int edges_meet(const outline *o, size_t i, size_t k)
{
    const double *a = o->p[i], *b = o->p[(i + 1) % o->count];
    const double *c = o->p[k], *d = o->p[(k + 1) % o->count];
    return (turn(a, b, c) > 0) != (turn(a, b, d) > 0) && (turn(c, d, a) > 0) != (turn(c, d, b) > 0);
}

/* Random corners, whose edges are turned about until none cross. */
static void make_random(outline *o, size_t count)
{
    int crossed = 1;
    o->count = count;
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < 2; c++)
            o->p[i][c] = uniform();
    while (crossed) {
        crossed = 0;
        for (size_t i = 0; i < count; i++)
            for (size_t k = i + 2; k < count; k++) {
                if ((i == 0 && k == count - 1) || !edges_meet(o, i, k))
                    continue;
                crossed = 1;
                for (size_t a = i + 1, b = k; a < b; a++, b--)
                    for (int c = 0; c < 2; c++) {
                        const double held = o->p[a][c];
                        o->p[a][c] = o->p[b][c];
                        o->p[b][c] = held;
                    }
            }
    }
}

static void random_polygons_are_covered_once(void **state)
{
    (void)state;
    state_of_random = 1;
    for (int k = 0; k < 80; k++) {
        make_random(&shape, 4 + (size_t)k % (FEW - 4));
        expect_simple(&shape);
    }
}

static void polygons_need_not_be_flat(void **state)
{
    (void)state;
    state_of_random = 2;
    for (int k = 0; k < 100; k++) {
        make_random(&shape, 5 + (size_t)k % 20);
        for (size_t i = 0; i < shape.count; i++, rotate(&shape)) {
            place(&shape, 1e-4);
            if (cut(shape.count) == RT_POLYGON_SIMPLE)
                expect_cover(&shape, 2e-3);
            else
                fail();
        }
    }
}

/* What was a fan before and is right stays it, and so do its bytes. */
static void convex_polygons_are_fans(void **state)
{
    (void)state;
    for (size_t count = 3; count < 40; count++) {
        shape.count = count;
        for (size_t i = 0; i < count; i++) {
            /* pairs on straight sides, rounded to single precision */
            const double a = 6.283185307179586 * (double)(i / 3) / (double)((count + 2) / 3);
            const double b = 6.283185307179586 * (double)(i / 3 + 1) / (double)((count + 2) / 3);
            const double t = (double)(i % 3) / 3;
            shape.p[i][0] = (1 - t) * cos(a) + t * cos(b);
            shape.p[i][1] = (1 - t) * sin(a) + t * sin(b);
        }
        if (count < 7)
            continue; /* a line */
        place(&shape, 0);
        for (size_t i = 0; i < count; i++)
            for (int c = 0; c < 3; c++)
                corners[i][c] = (float)corners[i][c];
        assert_int_equal(cut(count), RT_POLYGON_SIMPLE);
        for (uint32_t i = 0; i < count - 2; i++)
            assert_true(triangles[i][0] == 0 && triangles[i][1] == i + 1 &&
                        triangles[i][2] == i + 2);
    }
}

static void expect_found(rt_polygon found)
{
    for (size_t i = 0; i < shape.count; i++, rotate(&shape)) {
        place(&shape, 0);
        assert_int_equal(cut(shape.count), found);
    }
}

static void what_is_no_simple_polygon_is_told(void **state)
{
    (void)state;
    static const double bow[][2] = {{0, 0}, {1, 1}, {1, 0}, {0, 1}};
    static const double uneven[][2] = {{0, 0}, {2, 2}, {2, 0}, {0, 1}};
    static const double star[][2] = {
        {0, 1}, {-0.588, -0.809}, {0.951, 0.309}, {-0.951, 0.309}, {0.588, -0.809}};
    static const double around[][2] = {{0, 0}, {4, 0}, {4, 4}, {0, 4},
                                       {0, 0}, {3, 1}, {3, 3}, {1, 3}};
    static const double loop[][2] = {{0, 0}, {4, 0}, {4, 4}, {2, -1}, {0, 4}};
    static const double line[][2] = {{0, 0}, {1, 1}, {3, 3}, {2, 2}};
    static const double point[][2] = {{1, 1}, {1, 1}, {1, 1}, {1, 1}, {1, 1}};
    USE(bow);
    expect_found(RT_POLYGON_CROSSING);
    USE(uneven);
    expect_found(RT_POLYGON_CROSSING);
    USE(star);
    expect_found(RT_POLYGON_CROSSING);
    USE(around);
    expect_found(RT_POLYGON_CROSSING);
    USE(loop);
    expect_found(RT_POLYGON_CROSSING);
    USE(line);
    expect_found(RT_POLYGON_NO_AREA);
    USE(point);
    expect_found(RT_POLYGON_NO_AREA);
}

/* Fingers of a comb, a spiral, and corners anywhere: many, in time that is bounded by a count. */
static void large_polygons_take_bounded_time(void **state)
{
    (void)state;
    rt_polygon found;
    shape.count = MANY;
    for (size_t i = 0; i < MANY; i++) {
        const double x = i < MANY - 2 ? (double)i : i == MANY - 2 ? MANY : -1;
        shape.p[i][0] = -x;
        shape.p[i][1] = i < MANY - 2 ? (i % 2 ? 1000 : 1) : 0;
    }
    place(&shape, 0);
    assert_int_equal(cut(MANY), RT_POLYGON_SIMPLE);
    expect_cover(&shape, 0);
    for (size_t i = 0; i < MANY; i++) {
        const double a = 0.02 * (double)(i < MANY / 2 ? i : MANY - 1 - i);
        shape.p[i][0] = (a + (i < MANY / 2 ? 4 : 1)) * cos(a);
        shape.p[i][1] = (a + (i < MANY / 2 ? 4 : 1)) * sin(a);
    }
    place(&shape, 0);
    assert_int_equal(cut(MANY), RT_POLYGON_SIMPLE);
    expect_cover(&shape, 0);
    state_of_random = 3;
    for (size_t i = 0; i < MANY; i++)
        for (int c = 0; c < 3; c++)
            corners[i][c] = uniform();
    found = cut(MANY);
    assert_true(found == RT_POLYGON_CROSSING || found == RT_POLYGON_TOO_INVOLVED);
}

/* ---- A million corners --------------------------------------------------------- */

static double (*many)[3];
static uint32_t (*many_triangles)[3];

static int make_many(void **state)
{
    (void)state;
    many = calloc(VERY_MANY, sizeof *many);
    many_triangles = calloc(VERY_MANY, sizeof *many_triangles);
    return many && many_triangles ? 0 : -1;
}

static int free_many(void **state)
{
    (void)state;
    free(many);
    free(many_triangles);
    return 0;
}

static void set_many(size_t i, double x, double y)
{
    many[i][0] = x;
    many[i][1] = y;
}

/* A bow whose edges hold nearly all of its corners, so that next to none of them may be an ear. */
static void make_bow(size_t count)
{
    static const double ends[][2] = {{0, 0}, {2, 2}, {2, 0}, {0, 1}};
    for (size_t i = 0; i < count; i++) {
        const size_t side = 4 * i / count;
        const double *a = ends[side], *b = ends[(side + 1) % 4];
        const double t = (double)(4 * i % count) / (double)count;
        set_many(i, (1 - t) * a[0] + t * b[0], (1 - t) * a[1] + t * b[1]);
    }
}

/* Teeth along a diagonal: the boxes around all edges overlap. */
static void make_diagonal_comb(size_t count)
{
    for (size_t i = 0; i < count - 1; i++) {
        const double along = (double)i / (double)count, across = i % 2 ? 10 : 0;
        set_many(i, across + along, along - across);
    }
    set_many(count - 1, 2, 2);
}

static void make_comb(size_t count)
{
    for (size_t i = 0; i < count - 2; i++)
        set_many(i, -(double)i, i % 2 ? 1000 : 1);
    set_many(count - 2, -(double)count, 0);
    set_many(count - 1, 1, 0);
}

/* Without the bound, the last two would take minutes. */
static void a_million_corners_take_bounded_time(void **state)
{
    (void)state;
    rt_polygon found;
    const double began = rt_clock();
    for (size_t i = 0; i < VERY_MANY; i++) {
        const double a = 2 * 3.141592653589793 * (double)i / VERY_MANY;
        set_many(i, cos(a), sin(a));
    }
    assert_int_equal(rt_polygon_cut(many_triangles[0], &found, many[0], VERY_MANY, NULL), RT_OK);
    assert_int_equal(found, RT_POLYGON_SIMPLE);
    make_comb(VERY_MANY);
    assert_int_equal(rt_polygon_cut(many_triangles[0], &found, many[0], VERY_MANY, NULL), RT_OK);
    assert_int_equal(found, RT_POLYGON_SIMPLE);
    make_bow(VERY_MANY / 5);
    assert_int_equal(rt_polygon_cut(many_triangles[0], &found, many[0], VERY_MANY / 5, NULL),
                     RT_OK);
    assert_int_equal(found, RT_POLYGON_CROSSING);
    make_diagonal_comb(MANY);
    assert_int_equal(rt_polygon_cut(many_triangles[0], &found, many[0], MANY, NULL), RT_OK);
    assert_int_equal(found, RT_POLYGON_TOO_INVOLVED);
    assert_true(rt_clock() - began < 60); /* some 2 s */
}

static int cancel_later(void *user, const rt_progress *progress)
{
    (void)progress;
    return ++*(int *)user > 1;
}

static rt_status cut_cancelled(int *reports)
{
    const rt_hooks hooks = {.progress = cancel_later, .user = reports};
    rt_stage_progress progress;
    rt_polygon found;
    *reports = 0;
    assert_int_equal(rt_stage_begin(&progress, &hooks, RT_STAGE_LOAD), RT_OK);
    return rt_polygon_cut_of(many_triangles[0], &found, many[0], VERY_MANY,
                             &(rt_mesh_source){.progress = &progress});
}

/* While edges that cross are looked for, and while ears are; the first would take half a minute. */
static void one_polygon_can_be_cancelled(void **state)
{
    (void)state;
    int reports;
    make_diagonal_comb(VERY_MANY);
    assert_int_equal(cut_cancelled(&reports), RT_CANCELLED);
    assert_int_equal(reports, 2);
    make_bow(VERY_MANY);
    assert_int_equal(cut_cancelled(&reports), RT_CANCELLED);
    assert_int_equal(reports, 2);
}

static void what_it_takes_is_counted(void **state)
{
    (void)state;
    rt_stage_progress progress = {.hooks = NULL};
    rt_memory *memory;
    rt_memory_info info;
    rt_error error;
    rt_mesh_source source = {.progress = &progress, .error = &error};
    make_comb(MANY);
    for (uint64_t limit = 1000000; limit >= 1000; limit /= 10) {
        assert_int_equal(rt_memory_create(&memory, limit, NULL), RT_OK);
        source.memory = memory;
        assert_int_equal(rt_polygon_cut_of(many_triangles[0], NULL, many[0], MANY, &source),
                         limit == 1000000 ? RT_OK : RT_ERROR_MEMORY);
        rt_memory_get_info(memory, &info);
        assert_true(info.used == 0 && info.most <= limit);
        assert_true(limit < 1000000 || info.most > 50 * MANY);
        rt_memory_destroy(memory);
    }
}

static void corners_are_numbers(void **state)
{
    (void)state;
    rt_error error;
    double p[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    assert_int_equal(rt_polygon_cut(triangles[0], NULL, p[0], 2, &error), RT_ERROR_INPUT);
    assert_string_equal(error.field, "count");
    assert_int_equal(rt_polygon_cut(triangles[0], NULL, p[0], 4, &error), RT_OK);
    p[2][1] = NAN;
    assert_int_equal(rt_polygon_cut(triangles[0], NULL, p[0], 4, &error), RT_ERROR_INPUT);
    p[2][1] = 1e300;
    assert_int_equal(rt_polygon_cut(triangles[0], NULL, p[0], 4, &error), RT_ERROR_INPUT);
    assert_string_equal(error.field, "corners");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_corner_may_be_the_first),
        cmocka_unit_test(a_bridge_joins_a_hole),
        cmocka_unit_test(random_polygons_are_covered_once),
        cmocka_unit_test(polygons_need_not_be_flat),
        cmocka_unit_test(convex_polygons_are_fans),
        cmocka_unit_test(what_is_no_simple_polygon_is_told),
        cmocka_unit_test(large_polygons_take_bounded_time),
        cmocka_unit_test(a_million_corners_take_bounded_time),
        cmocka_unit_test(one_polygon_can_be_cancelled),
        cmocka_unit_test(what_it_takes_is_counted),
        cmocka_unit_test(corners_are_numbers),
    };
    return cmocka_run_group_tests_name("mesh/polygon", tests, make_many, free_many);
}
