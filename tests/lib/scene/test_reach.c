/* test_reach.c - lines meet walls where rays of the device do; shapes reach as far as rays find. */
#include "support.h"

#include <math.h>
#include <stdio.h>

#include "scene/reach.h"

enum { RAYS = 2000 };

static double uniform(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (*state >> 8) / 8388608.0 - 1;
}

static rt_scene *parse(const char *text)
{
    rt_scene *scene = NULL;
    rt_error error;
    expect_ok(rt_scene_parse(&scene, text, "scene", NULL, &error), &error);
    return scene;
}

/* A rectangle, a box, a triangle of calls and an infinite plane, seen from in and about them. */
static void lines_meet_walls_where_rays_do(void **state)
{
    static const float corners[9] = {-1, 3, -2, 2, 3.5f, 1, 0, 4, 2};
    static const uint32_t triangle[3] = {0, 1, 2};
    static const rt_surface white = {.material = 0};
    rt_scene *scene =
        parse("material white { kd 0.7 }\n"
              "quad { corner -2 0.5 -1  edge1 4 0.3 0  edge2 0 1 3  material white }\n"
              "box { centre 1 2 0  size 1 2 3  material white }\n"
              "plane { point 0 -1 0  normal 0.2 1 0  material white }\n");
    rt_renderer *renderer = NULL;
    rt_error error;
    uint32_t random = 5, met = 0;
    (void)state;
    expect_ok(rt_scene_add_triangles(scene, NULL, corners, 3, triangle, 1, NULL, &white, &error),
              &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    for (int i = 0; i < RAYS; i++) {
        rt_ray ray = {.t_max = INFINITY};
        rt_hit hit;
        double p[3], d[3], length, t = INFINITY;
        size_t work = 0;
        for (int k = 0; k < 3; k++) {
            ray.origin[k] = (float)(4 * uniform(&random));
            d[k] = uniform(&random);
        }
        length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        for (int k = 0; k < 3; k++) {
            d[k] /= length;
            ray.direction[k] = (float)d[k];
            p[k] = ray.origin[k];
        }
        expect_ok(rt_trace(renderer, RT_TRACE_CLOSEST, &ray, 1, &hit, &error), &error);
        const uint32_t shape = rt_scene_first_along(scene, NULL, p, d, 1, &t, &work);
        if (shape == RT_NONE || hit.shape == RT_NONE) {
            assert_int_equal(shape, hit.shape);
            continue;
        }
        assert_true(fabs(t - hit.t) < 1e-4 * (1 + t));
        met++;
    }
    assert_in_range(met, RAYS / 3, RAYS);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
}

/* Nearer than a limit alone; the triangles of a mesh beyond it are not looked at. */
static void lines_end_at_their_limit(void **state)
{
    static const float corners[9] = {-1, 0, 2, 1, 0, 2, 0, 1, 2};
    static const uint32_t triangle[3] = {0, 1, 2};
    static const rt_surface white = {.material = 0};
    static const double limits[] = {1.99, 2.01};
    static const double p[3] = {0, 0.25, 0}, d[3] = {0, 0, 1};
    rt_scene *scene = parse("material white { kd 0.7 }\n");
    rt_error error;
    (void)state;
    expect_ok(rt_scene_add_triangles(scene, NULL, corners, 3, triangle, 1, NULL, &white, &error),
              &error);
    for (size_t i = 0; i < 2; i++) {
        double t = limits[i];
        size_t work = 0;
        assert_int_equal(rt_scene_first_along(scene, NULL, p, d, 1, &t, &work), i ? 0 : RT_NONE);
        assert_true(fabs(t - (i ? 2 : limits[i])) < 1e-12);
        assert_int_equal(work, 1 + i);
    }
    rt_scene_destroy(scene);
}

/* The farthest point that rays against n find, of a grid of them, is as far as a shape reaches. */
static void shapes_reach_as_far_as_rays_find_them(void **state)
{
    static const char *const shapes[] = {
        "sphere { centre 0.1 0.2 0.3 radius 0.8 material white }",
        "ellipsoid { centre 0 0.2 0 radii 0.8 0.3 0.5 material white rotate 1 1 0 30 }",
        "box { centre 0 0 0.1 size 1 0.5 0.8 material white rotate 1 2 0 40 }",
        "cylinder { a -0.5 0 0 b 0.5 0.3 0 radius 0.4 material white }",
        "cone { base -0.5 0 0 apex 0.5 0.3 0 radius 0.6 material white }",
        "torus { centre 0 0 0 axis 1 1 0 major_radius 0.6 minor_radius 0.2 material white }",
        "disc { centre 0 0 0 normal 1 1 0.2 radius 0.8 material white }",
        "quad { corner -0.5 -0.5 0 edge1 1 0.2 0 edge2 0 1 0.3 material white }",
    };
    static const double n[3] = {0.6, 0.64, 0.48};
    enum { SIDE = 160 };
    static rt_ray rays[SIDE * SIDE];
    static rt_hit hits[SIDE * SIDE];
    double x[3], y[3];
    (void)state;
    rt_frame_about(n, x, y);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double u = 2.4 * (i % SIDE + 0.5) / SIDE - 1.2,
                     v = 2.4 * (i / SIDE + 0.5) / SIDE - 1.2;
        rays[i].t_max = INFINITY;
        for (int k = 0; k < 3; k++) {
            rays[i].origin[k] = (float)(5 * n[k] + u * x[k] + v * y[k]);
            rays[i].direction[k] = (float)-n[k];
        }
    }
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++) {
        char text[256];
        rt_error error;
        rt_renderer *renderer = NULL;
        double nearest = INFINITY;
        size_t work = 0;
        snprintf(text, sizeof text, "material white { kd 0.7 }\n%s\n", shapes[s]);
        rt_scene *scene = parse(text);
        expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
        expect_ok(rt_trace(renderer, RT_TRACE_CLOSEST, rays, SIDE * SIDE, hits, &error), &error);
        for (int i = 0; i < SIDE * SIDE; i++)
            nearest = fmin(nearest, hits[i].t);
        const double reach = rt_shape_reach(scene, scene->shapes, n, -INFINITY, &work);
        if (!(reach > 5 - nearest - 1e-4 && reach < 5 - nearest + 0.03))
            fail_msg("%g, not %g: %s", reach, 5 - nearest, shapes[s]);
        rt_renderer_destroy(renderer);
        rt_scene_destroy(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_meet_walls_where_rays_do),
        cmocka_unit_test(lines_end_at_their_limit),
        cmocka_unit_test(shapes_reach_as_far_as_rays_find_them),
    };
    return cmocka_run_group_tests_name("lib/scene/reach", tests, NULL, NULL);
}
