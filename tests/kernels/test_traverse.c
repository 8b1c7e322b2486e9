/*
 * test_traverse.c - the tree against testing every primitive: the same hits to the bit. Both tests
 * run the same intersections, and ties go to the lower primitive, so the result does not depend on
 * the order of traversal. All of it once more at width 1, which has a tree of its own.
 */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "kernels/rays.h"
#include "render/renderer.h"
#include "support.h"

/*
 * Traces through the tree and through everything, expects equal results, and returns the number of
 * hits.
 */
static size_t expect_same(const rt_scene *scene, const rt_ray *rays, size_t count)
{
    rt_renderer *tree = rays_renderer(scene, RT_ACCEL_BVH),
                *all = rays_renderer(scene, RT_ACCEL_NONE);
    rt_hit *a = rays_trace(tree, RT_TRACE_CLOSEST, rays, count);
    rt_hit *b = rays_trace(all, RT_TRACE_CLOSEST, rays, count);
    rt_hit *any = rays_trace(tree, RT_TRACE_ANY, rays, count);
    rt_hit *any_of_all = rays_trace(all, RT_TRACE_ANY, rays, count);
    size_t hits = 0;
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(a[i].shape, b[i].shape);
        assert_int_equal(a[i].prim, b[i].prim);
        assert_memory_equal(&a[i], &b[i], sizeof a[i]);
        assert_int_equal(any[i].shape != RT_NONE, a[i].shape != RT_NONE);
        assert_int_equal(any_of_all[i].shape != RT_NONE, a[i].shape != RT_NONE);
        if (a[i].shape == RT_NONE)
            continue;
        assert_true(a[i].t >= rays[i].t_min && a[i].t <= rays[i].t_max);
        hits++;
    }
    free(a);
    free(b);
    free(any);
    free(any_of_all);
    rt_renderer_destroy(tree);
    rt_renderer_destroy(all);
    return hits;
}

/* Loose triangles of the given size in a cube of half width 1, scaled and moved. */
static void add_soup(rt_scene *scene, rays_stream *stream, size_t count, float size, float scale,
                     const float move[3])
{
    float *positions = malloc(count * 9 * sizeof *positions);
    uint32_t *indices = malloc(count * 3 * sizeof *indices);
    for (size_t i = 0; i < count; i++) {
        float centre[3], corner[3];
        rays_point(stream, 1.0f, centre);
        for (size_t c = 0; c < 3; c++) {
            rays_point(stream, size, corner);
            for (size_t a = 0; a < 3; a++)
                positions[9 * i + 3 * c + a] = move[a] + scale * (centre[a] + corner[a]);
            indices[3 * i + c] = (uint32_t)(3 * i + c);
        }
    }
    rays_add_triangles(scene, positions, 3 * count, indices, count);
    free(positions);
    free(indices);
}

/* Rays of all kinds about that cube; every eighth along an axis, some with a range. */
static rt_ray *make_rays(rays_stream *stream, size_t count, float scale, const float move[3])
{
    rt_ray *rays = malloc(count * sizeof *rays);
    for (size_t i = 0; i < count; i++) {
        float from[3], direction[3];
        rays_point(stream, i % 3 ? 3.0f : 1.0f, from);
        rays_direction(stream, direction);
        if (i % 2)
            for (int a = 0; a < 3; a++)
                direction[a] = 0.5f * direction[a] - from[a]; /* roughly at the middle */
        if (i % 8 == 0) {
            direction[(i / 8) % 3] = 0.0f;
            if (i % 16 == 0)
                direction[(i / 8 + 1) % 3] = -0.0f;
        }
        for (int a = 0; a < 3; a++)
            from[a] = move[a] + scale * from[a];
        rays[i] = rays_make(from, direction, 0.0f, INFINITY);
        if (i % 5 == 0) {
            rays[i].t_min = rays_between(stream, 0.0f, 2.0f) * scale;
            rays[i].t_max = rays[i].t_min + rays_uniform(stream) * 2.0f * scale;
        }
    }
    return rays;
}

static const float nowhere[3] = {0, 0, 0};

static void bvh_matches_brute_force_on_triangles(void **state)
{
    (void)state;
    static const struct {
        size_t count;
        float size, scale, move[3];
    } soups[] = {
        {1, 0.5f, 1, {0, 0, 0}},       {9, 0.5f, 1, {0, 0, 0}},
        {500, 0.2f, 1, {0, 0, 0}},     {3000, 0.05f, 1, {0, 0, 0}},
        {1000, 1.0f, 1, {0, 0, 0}},    {1000, 0.1f, 1e-3f, {0, 0, 0}},
        {1000, 0.1f, 1e3f, {0, 0, 0}}, {1000, 0.1f, 1, {1e3f, -1e3f, 5}},
        {1000, 0.1f, 1e6f, {0, 0, 0}},
    };
    rays_stream stream = {5};
    size_t hits = 0;
    for (size_t s = 0; s < sizeof soups / sizeof *soups; s++) {
        rt_scene *scene = rays_scene();
        add_soup(scene, &stream, soups[s].count, soups[s].size, soups[s].scale, soups[s].move);
        rt_ray *rays = make_rays(&stream, 8192, soups[s].scale, soups[s].move);
        hits += expect_same(scene, rays, 8192);
        free(rays);
        rt_scene_destroy(scene);
    }
    assert_true(hits > 10000);
}

static void bvh_matches_brute_force_on_all_kinds(void **state)
{
    (void)state;
    rays_stream stream = {6};
    rt_scene *scene = rays_scene();
    add_soup(scene, &stream, 300, 0.2f, 1.0f, nowhere);
    for (int i = 0; i < 60; i++) {
        float centre[3], edge1[3], edge2[3];
        rays_point(&stream, 1.0f, centre);
        rays_add_sphere(scene, centre, rays_between(&stream, 0.01f, 0.2f));
        rays_point(&stream, 1.0f, centre);
        rays_point(&stream, 0.3f, edge1);
        rays_point(&stream, 0.3f, edge2);
        rays_add_quad(scene, centre, edge1, edge2);
    }
    rays_add_plane(scene, (const float[3]){0, -1.5f, 0}, (const float[3]){0.1f, 1, 0});
    rays_add_plane(scene, (const float[3]){0, 0, 2.5f}, (const float[3]){0, 0, 1});
    rt_ray *rays = make_rays(&stream, 20000, 1.0f, nowhere);
    assert_true(expect_same(scene, rays, 20000) > 5000);
    free(rays);
    rt_scene_destroy(scene);
}

static const rt_surface plain;

/* A bumpy open sheet of 2 x side x side triangles over the square of half width 0.5. */
static void make_sheet(rt_mesh_data *mesh, int is_smooth)
{
    enum { side = 30, across = side + 1 };
    static float positions[across * across][3], normals[across * across][3], uv[across * across][2];
    static uint32_t indices[2 * side * side][3];
    for (uint32_t i = 0; i < across * across; i++) {
        const double x = (double)(i % across) / side - 0.5, y = (double)(i / across) / side - 0.5;
        positions[i][0] = (float)x;
        positions[i][1] = (float)y;
        positions[i][2] = (float)(0.1 * sin(9 * x) * cos(7 * y));
        normals[i][0] = (float)(-0.9 * cos(9 * x) * cos(7 * y));
        normals[i][1] = (float)(0.7 * sin(9 * x) * sin(7 * y));
        normals[i][2] = 1;
        uv[i][0] = (float)(3 * x + y);
        uv[i][1] = (float)(2 * y);
    }
    for (uint32_t i = 0; i < side * side; i++) {
        const uint32_t a = i / side * across + i % side;
        const uint32_t faces[2][3] = {{a, a + 1, a + across}, {a + 1, a + across + 1, a + across}};
        memcpy(indices[2 * i], faces, sizeof faces);
    }
    *mesh = (rt_mesh_data){positions[0],
                           is_smooth ? normals[0] : NULL,
                           uv[0],
                           NULL,
                           indices[0],
                           across * across,
                           2 * side * side,
                           NULL,
                           0};
}

/* A linear map of no special kind, mirrored at times, to somewhere in the cube of half width 1. */
static rt_transform random_placement(rays_stream *stream)
{
    rt_transform t;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            t.m[i][j] = rays_between(stream, -0.5f, 0.5f) + (i == j ? 0.7f : 0.0f);
        t.m[i][3] = rays_between(stream, -1.0f, 1.0f);
    }
    if (rays_uniform(stream) < 0.5f)
        for (int i = 0; i < 3; i++)
            t.m[i][0] = -t.m[i][0];
    return t;
}

/* Places one mesh many times; or, baked, as many meshes once each. */
static rt_scene *place_sheets(size_t count, int is_baked)
{
    rays_stream stream = {12};
    rt_scene *scene = rays_scene();
    rt_error error;
    rt_mesh_data data;
    uint32_t mesh = 0;
    for (size_t i = 0; i < count; i++) {
        make_sheet(&data, 1);
        if (is_baked || i == 0)
            expect_ok(rt_scene_add_mesh(scene, &mesh, &data, &error), &error);
        const rt_surface surface = {.transform = random_placement(&stream)};
        expect_ok(rt_scene_add_instance(scene, NULL, mesh, &surface, &error), &error);
    }
    return scene;
}

/*
 * The instance and its baked copy are the same but for rounding, which only tells where two sheets
 * all but meet.
 */
static void instances_match_baked_copies(void **state)
{
    (void)state;
    enum { count = 40000, placements = 12 };
    rays_stream stream = {13};
    rt_scene *placed = place_sheets(placements, 0), *baked = place_sheets(placements, 1);
    rt_renderer *a = rays_renderer(placed, RT_ACCEL_BVH), *b = rays_renderer(baked, RT_ACCEL_BVH);
    rt_ray *rays = make_rays(&stream, count, 1.0f, nowhere);
    rt_hit *in_a = rays_trace(a, RT_TRACE_CLOSEST, rays, count),
           *in_b = rays_trace(b, RT_TRACE_CLOSEST, rays, count);
    size_t hits = 0, unlike = 0;
    for (size_t i = 0; i < count; i++) {
        const rt_hit *p = &in_a[i], *q = &in_b[i];
        if (p->shape != q->shape || p->prim != q->prim) {
            unlike++;
            continue;
        }
        if (p->shape == RT_NONE)
            continue;
        hits++;
        const float along =
            fabsf(p->normal[0] * rays[i].direction[0] + p->normal[1] * rays[i].direction[1] +
                  p->normal[2] * rays[i].direction[2]);
        assert_true(fabsf(p->t - q->t) <= 1e-5f * q->t + 3e-6f / along);
        for (int k = 0; k < 3; k++)
            assert_true(fabsf(p->normal[k] - q->normal[k]) <= 1e-4f);
        if (along > 0.05f) {
            assert_true(fabsf(p->u - q->u) <= 1e-3f);
            assert_true(fabsf(p->v - q->v) <= 1e-3f);
        }
    }
    assert_true(hits > count / 5);
    assert_true(unlike < count / 1000);
    free(in_a);
    free(in_b);
    rt_renderer_destroy(a);
    rt_renderer_destroy(b);
    expect_same(placed, rays, count / 4);
    free(rays);
    rt_scene_destroy(placed);
    rt_scene_destroy(baked);
}

/* Shapes of all kinds that a transform places, and instances, among triangles. */
static void bvh_matches_brute_force_on_placed_shapes(void **state)
{
    (void)state;
    static const float zero[3] = {0, 0, 0}, up[3] = {0, 0, 0.3f}, radii[3] = {0.2f, 0.1f, 0.3f};
    rays_stream stream = {14};
    rt_scene *scene = place_sheets(5, 0);
    rt_error error;
    add_soup(scene, &stream, 300, 0.2f, 1.0f, nowhere);
    for (int i = 0; i < 20; i++) {
        rt_surface surface = plain;
        surface.transform = random_placement(&stream);
        expect_ok(rt_scene_add_ellipsoid(scene, NULL, zero, radii, &surface, &error), &error);
        surface.transform = random_placement(&stream);
        expect_ok(rt_scene_add_disc(scene, NULL, zero, up, 0.3f, 0.1f, &surface, &error), &error);
        surface.transform = random_placement(&stream);
        expect_ok(rt_scene_add_cylinder(scene, NULL, zero, up, 0.1f, i % 2, &surface, &error),
                  &error);
        surface.transform = random_placement(&stream);
        expect_ok(rt_scene_add_cone(scene, NULL, zero, up, 0.2f, i % 3 ? 0.1f : 0.0f, i % 2,
                                    &surface, &error),
                  &error);
        surface.transform = random_placement(&stream);
        expect_ok(rt_scene_add_torus(scene, NULL, zero, up, 0.3f, 0.05f, &surface, &error), &error);
    }
    rt_ray *rays = make_rays(&stream, 10000, 1.0f, nowhere);
    assert_true(expect_same(scene, rays, 10000) > 2500);
    free(rays);
    rt_scene_destroy(scene);
}

static void duplicates_give_the_lowest_primitive(void **state)
{
    (void)state;
    static const float positions[3][3] = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    static uint32_t indices[100][3];
    for (int i = 0; i < 100; i++)
        for (uint32_t c = 0; c < 3; c++)
            indices[i][c] = c;
    rays_stream stream = {7};
    rt_scene *scene = rays_scene();
    rays_add_triangles(scene, positions[0], 3, indices[0], 100);
    rt_ray *rays = make_rays(&stream, 2000, 1.0f, nowhere);
    expect_same(scene, rays, 2000);
    rt_renderer *renderer = rays_renderer(scene, RT_ACCEL_BVH);
    rt_hit *hits = rays_trace(renderer, RT_TRACE_CLOSEST, rays, 2000);
    size_t found = 0;
    for (size_t i = 0; i < 2000; i++)
        if (hits[i].shape != RT_NONE) {
            assert_int_equal(hits[i].prim, 0);
            found++;
        }
    assert_true(found > 50);
    free(hits);
    free(rays);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
}

static void an_empty_scene_is_missed(void **state)
{
    (void)state;
    rays_stream stream = {8};
    rt_scene *scene = rays_scene();
    rt_ray *rays = make_rays(&stream, 500, 1.0f, nowhere);
    assert_int_equal(expect_same(scene, rays, 500), 0);
    free(rays);
    rt_scene_destroy(scene);
}

/* One triangle at z = 2, and rays along z from 0: t is 2 exactly. */
static void the_range_includes_its_ends(void **state)
{
    (void)state;
    static const float positions[3][3] = {{-1, -1, 2}, {1, -1, 2}, {0, 1, 2}}, from[3] = {0, 0, 0},
                       along[3] = {0, 0, 1};
    static const uint32_t indices[3] = {0, 1, 2};
    static const struct {
        float t_min, t_max;
        int hit;
    } ranges[] = {{0, 2, 1},       {2, 3, 1},  {2, 2, 1},  {0, 1.9999f, 0},
                  {2.0001f, 5, 0}, {-5, 5, 1}, {-5, -1, 0}};
    rt_scene *scene = rays_scene();
    rays_add_triangles(scene, positions[0], 3, indices, 1);
    for (int accel = 0; accel < 2; accel++) {
        rt_renderer *renderer = rays_renderer(scene, accel ? RT_ACCEL_NONE : RT_ACCEL_BVH);
        for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
            const rt_ray ray = rays_make(from, along, ranges[i].t_min, ranges[i].t_max);
            rt_hit *closest = rays_trace(renderer, RT_TRACE_CLOSEST, &ray, 1);
            rt_hit *any = rays_trace(renderer, RT_TRACE_ANY, &ray, 1);
            assert_int_equal(closest->shape != RT_NONE, ranges[i].hit);
            assert_int_equal(any->shape != RT_NONE, ranges[i].hit);
            free(closest);
            free(any);
        }
        rt_renderer_destroy(renderer);
    }
    rt_scene_destroy(scene);
}

/* A closed bumpy surface of a grid of side x 2 side cells around the origin. */
enum { side = 60, around = 2 * side };
static float shell[side + 1][around][3];
static uint32_t shell_faces[side][around][2][3];

static void make_shell(float scale, const float move[3])
{
    const double pi = acos(-1.0);
    for (uint32_t j = 0; j <= side; j++)
        for (uint32_t i = 0; i < around; i++) {
            const double u = 2 * pi * i / around, v = pi * j / side;
            const double r = j == 0 || j == side ? 1.0 : 1.0 + 0.1 * sin(7 * u) * sin(9 * v);
            shell[j][i][0] = move[0] + scale * (float)(r * sin(v) * (j == side ? 0 : cos(u)));
            shell[j][i][1] = move[1] + scale * (float)(r * cos(v));
            shell[j][i][2] = move[2] + scale * (float)(r * sin(v) * (j == side ? 0 : sin(u)));
        }
    for (uint32_t j = 0; j < side; j++)
        for (uint32_t i = 0; i < around; i++) {
            const uint32_t a = j * around + i, b = j * around + (i + 1) % around;
            const uint32_t faces[2][3] = {{a, b, a + around}, {b, b + around, a + around}};
            memcpy(shell_faces[j][i], faces, sizeof faces);
        }
}

/* From inside, at vertices, at the middles of edges, and along the axes: no ray gets out. */
static void closed_meshes_do_not_leak(void **state)
{
    (void)state;
    static const struct {
        float scale, move[3];
    } places[] = {{1, {0, 0, 0}}, {1e-3f, {0, 0, 0}}, {1, {100, 50, -70}}};
    enum { count = 60000 };
    rays_stream stream = {9};
    for (size_t p = 0; p < sizeof places / sizeof *places; p++) {
        make_shell(places[p].scale, places[p].move);
        rt_scene *scene = rays_scene();
        rays_add_triangles(scene, shell[0][0], (side + 1) * around, shell_faces[0][0][0],
                           2 * side * around);
        rt_ray *rays = malloc(count * sizeof *rays);
        for (size_t i = 0; i < count; i++) {
            float from[3], direction[3];
            const uint32_t *face =
                &shell_faces[0][0][0][0] + 3 * (size_t)(rays_uniform(&stream) * 2 * side * around);
            const float *a = &shell[0][0][0] + 3 * face[0], *b = &shell[0][0][0] + 3 * face[i % 2];
            rays_point(&stream, 0.4f * places[p].scale, from);
            for (int k = 0; k < 3; k++) {
                from[k] += places[p].move[k];
                direction[k] = 0.5f * (a[k] + b[k]) - from[k];
            }
            if (i % 10 == 0)
                for (int k = 0; k < 3; k++) {
                    from[k] = places[p].move[k];
                    direction[k] = k == (int)(i / 10 % 3) ? (i % 20 ? 1.0f : -1.0f) : 0.0f;
                }
            rays[i] = rays_make(from, direction, 0.0f, INFINITY);
        }
        rt_renderer *renderer = rays_renderer(scene, RT_ACCEL_BVH);
        rt_hit *hits = rays_trace(renderer, RT_TRACE_CLOSEST, rays, count);
        size_t leaks = 0;
        for (size_t i = 0; i < count; i++)
            leaks += hits[i].shape == RT_NONE;
        assert_int_equal(leaks, 0);
        free(hits);
        free(rays);
        rt_renderer_destroy(renderer);
        rt_scene_destroy(scene);
    }
}

/* Launches a kernel of trace.cl itself: rt_trace would refuse these rays. */
static void launch(rt_renderer *renderer, const char *name, const rt_ray *rays, rt_u32 count,
                   rt_hit *hits)
{
    cl_kernel kernel = NULL;
    rt_error error;
    expect_ok(rt_device_kernel(test_device(), &kernel, "trace", name, NULL, &error), &error);
    cl_mem in = test_buffer(count * sizeof *rays, rays),
           out = test_buffer(count * sizeof *hits, NULL);
    const rt_arg args[] = {RT_ARG(renderer->scene), RT_ARG(in), RT_ARG(count), RT_ARG(out)};
    test_run(kernel, args, 4, count);
    test_read(out, count * sizeof *hits, hits);
    rt_buffer_release(test_device(), in);
    rt_buffer_release(test_device(), out);
    rt_kernel_release(kernel);
}

static void rays_that_cannot_be_followed_miss(void **state)
{
    (void)state;
    const rt_ray rays[] = {
        {{0, 0, -3}, 0, {NAN, NAN, NAN}, INFINITY},
        {{0, 0, -3}, 0, {0, 0, NAN}, INFINITY},
        {{NAN, NAN, NAN}, 0, {0, 0, 1}, INFINITY},
        {{0, NAN, -3}, 0, {0, 0, 1}, INFINITY},
        {{0, 0, -3}, 0, {INFINITY, 0, 0}, INFINITY},
        {{INFINITY, INFINITY, 0}, 0, {0, 0, 1}, INFINITY},
        {{-INFINITY, INFINITY, 0}, 0, {NAN, 0, 1}, INFINITY},
        {{1e30f, 1e30f, -3}, 0, {0, 0, 1}, INFINITY},
        {{0, 0, -3}, 0, {0, 0, 0}, INFINITY},
        {{1e15f, 1e15f, -3}, 0, {0, 0, 1}, INFINITY},
    };
    enum { count = sizeof rays / sizeof *rays };
    rays_stream stream = {10};
    rt_hit hits[count];
    rt_scene *scene = rays_scene(), *empty = rays_scene();
    add_soup(scene, &stream, 1000, 0.2f, 1.0f, nowhere);
    rays_add_sphere(scene, nowhere, 0.5f);
    rt_renderer *renderers[] = {rays_renderer(scene, RT_ACCEL_BVH),
                                rays_renderer(empty, RT_ACCEL_BVH)};
    for (int i = 0; i < 2; i++) {
        launch(renderers[i], "trace_closest", rays, count, hits);
        for (int k = 0; k < count; k++)
            assert_int_equal(hits[k].shape, RT_NONE);
        launch(renderers[i], "trace_any", rays, count, hits);
        for (int k = 0; k < count; k++)
            assert_int_equal(hits[k].shape, RT_NONE);
        rt_renderer_destroy(renderers[i]);
    }
    rt_scene_destroy(scene);
    rt_scene_destroy(empty);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bvh_matches_brute_force_on_triangles),
        cmocka_unit_test(bvh_matches_brute_force_on_all_kinds),
        cmocka_unit_test(instances_match_baked_copies),
        cmocka_unit_test(bvh_matches_brute_force_on_placed_shapes),
        cmocka_unit_test(duplicates_give_the_lowest_primitive),
        cmocka_unit_test(an_empty_scene_is_missed),
        cmocka_unit_test(the_range_includes_its_ends),
        cmocka_unit_test(closed_meshes_do_not_leak),
        cmocka_unit_test(rays_that_cannot_be_followed_miss),
    };
    (void)argc;
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    if (failed || getenv("RT_TEST_BATCH"))
        return failed;
    setenv("RT_TEST_BATCH", "1", 1);
    execv("/proc/self/exe", argv);
    return 1;
}
