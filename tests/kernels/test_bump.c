/* test_bump.c - the tangents of every shape, and bumped normals, against finite differences. */
#include "support.h"

#include <math.h>
#include <string.h>

#include "render/renderer.h"
#include "scene/scene.h"
#include "shape_kinds.h"
#include "types.h"

enum { bundles = 1500, rays = 3 * bundles };

static const double height = 0.02; /* of v = 1 over v = 0, metres */

typedef struct row {
    float position[3], u, normal[3], v;
    float along_u[3], unused0, along_v[3], unused1;
} row;

/* A turn, a stretch and a shift. */
static const rt_transform placement = {
    {{0.9f, -0.5f, 0.1f, 0.2f}, {0.3f, 1.2f, -0.2f, -0.1f}, {0, 0.4f, 0.8f, 0.3f}}};
/* A turn about (1, 1, 1) by 120 degrees, twice as large: a sphere stays one. */
static const rt_transform turn = {{{0, 0, 2, 0.2f}, {2, 0, 0, -0.1f}, {0, 2, 0, 0.3f}}};

static rt_scene *bumpy_scene(rt_surface *surface)
{
    rt_scene *scene = NULL;
    rt_texture texture = {.kind = RT_TEXTURE_GRADIENT, .b = {1, 1, 1}};
    rt_material material = {.kd = {0.5f, 0.5f, 0.5f}, .bump_scale = (float)height};
    rt_error error;
    memset(surface, 0, sizeof *surface);
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_add_texture(scene, &material.bump_texture, &texture, &error), &error);
    expect_ok(rt_scene_add_material(scene, &surface->material, NULL, &material, &error), &error);
    return scene;
}

/* Bundles of three rays, close together, towards points near the origin. */
static void aim(rt_ray *out)
{
    uint32_t seed = 1;
    float r[6];
    for (int i = 0; i < bundles; i++) {
        for (int k = 0; k < 6; k++) {
            seed = seed * 1664525u + 1013904223u;
            r[k] = (float)(seed >> 8) / 16777216 * 2 - 1;
        }
        for (int k = 0; k < 3; k++) {
            rt_ray *ray = out + 3 * i + k;
            float shift[3] = {k == 1 ? 2e-3f : 0, k == 2 ? 2e-3f : 0,
                              k == 1 ? -1e-3f : 1e-3f * (float)k};
            for (int c = 0; c < 3; c++) {
                ray->direction[c] = r[3 + c] * 1.2f - r[c] * 8;
                ray->origin[c] = r[c] * 8 + shift[c];
            }
            ray->t_min = 0;
            ray->t_max = INFINITY;
        }
    }
}

static double dot(const double a[3], const float b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/*
 * From one hit to its neighbour: dp = dp/du du + dp/dv dv, and the height's gradient along dp is
 * height dv.
 */
static int expect_step(const row *a, const row *b, const float bumped[3])
{
    double du = (double)b->u - a->u, dv = (double)b->v - a->v, dp[3], off[3], size = 0, miss = 0,
           across = 0, climb = 0;
    double same = 0, turning = 0, whole = a->v - floor(a->v);
    for (int c = 0; c < 3; c++) {
        dp[c] = (double)b->position[c] - a->position[c];
        off[c] = dp[c] - (a->along_u[c] * du + a->along_v[c] * dv);
        same += (double)a->normal[c] * b->normal[c];
        size += dp[c] * dp[c];
        miss += off[c] * off[c];
        across += (double)bumped[c] * a->normal[c];
        turning += (double)a->along_u[c] * a->along_u[c];
    }
    /*
     * Not over an edge, the seam, or next to a pole, where u turns fast; nor where the gradient
     * starts again.
     */
    if (same < 0.999 || fabs(du) > 0.02 || fabs(dv) > 0.02 || size > 1e-4 || turning < 0.6 ||
        whole < 0.03 || whole > 0.97)
        return 0;
    assert_true(sqrt(miss) < 0.05 * sqrt(size) + 1e-5);
    climb = dot(dp, a->normal) - dot(dp, bumped) / across;
    assert_float_equal(climb, height * dv, 0.05 * height * fabs(dv) + 0.02 * sqrt(size));
    return 1;
}

/* Kinds of which the tangents were measured. */
static int seen[SHAPE_KINDS_MAX];

/* Destroys the scene. */
static void expect_tangents(rt_scene *scene)
{
    static rt_ray given[rays];
    static row rows[rays];
    static float bumped[rays][4];
    uint32_t count = rays;
    int steps = 0;
    rt_renderer *renderer = NULL;
    rt_error error;

    aim(given);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    cl_kernel kernel = test_kernel("bump", "follow_parameters");
    cl_mem in = test_buffer(sizeof given, given), out = test_buffer(sizeof rows, NULL);
    cl_mem tilted = test_buffer(sizeof bumped, NULL);
    rt_arg args[] = {RT_ARG(count), RT_ARG(renderer->scene), RT_ARG(in), RT_ARG(out),
                     RT_ARG(tilted)};
    test_run(kernel, args, 5, rays);
    test_read(out, sizeof rows, rows);
    test_read(tilted, sizeof bumped, bumped);
    for (int i = 0; i < bundles; i++)
        for (int k = 1; k < 3; k++) {
            const row *a = rows + 3 * i, *b = a + k;
            if (a->v >= 0 && b->v >= 0)
                steps += expect_step(a, b, bumped[3 * i]);
        }
    assert_true(steps > 50);
    seen[scene->shapes[0].kind] = 1;
    if (rt_scene_is_instance(scene, scene->shapes))
        seen[RT_SHAPE_INSTANCE] = 1;
    rt_buffer_release(test_device(), in);
    rt_buffer_release(test_device(), out);
    rt_buffer_release(test_device(), tilted);
    rt_kernel_release(kernel);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
}

static const float origin[3] = {0, 0, 0}, top[3] = {0.1f, 1.2f, 0.3f}, ahead[3] = {0.2f, 1, 0.4f};

static void spheres_and_ellipsoids_have_their_tangents(void **state)
{
    static const float radii[3] = {1, 0.6f, 1.4f};
    rt_surface surface;
    rt_error error;
    (void)state;
    rt_scene *scene = bumpy_scene(&surface);
    expect_ok(rt_scene_add_sphere(scene, NULL, origin, 1.3f, &surface, &error), &error);
    expect_tangents(scene);
    scene = bumpy_scene(&surface);
    surface.transform = turn;
    expect_ok(rt_scene_add_sphere(scene, NULL, origin, 0.7f, &surface, &error), &error);
    expect_tangents(scene);
    scene = bumpy_scene(&surface);
    surface.transform = placement;
    expect_ok(rt_scene_add_ellipsoid(scene, NULL, origin, radii, &surface, &error), &error);
    expect_tangents(scene);
}

static void shapes_about_an_axis_have_their_tangents(void **state)
{
    rt_surface surface;
    rt_error error;
    (void)state;
    for (int caps = 0; caps < 2; caps++) {
        rt_scene *scene = bumpy_scene(&surface);
        surface.transform = placement;
        expect_ok(rt_scene_add_cylinder(scene, NULL, origin, top, 0.8f, caps, &surface, &error),
                  &error);
        expect_tangents(scene);
        scene = bumpy_scene(&surface);
        expect_ok(rt_scene_add_cone(scene, NULL, origin, top, 1.2f, 0.5f, caps, &surface, &error),
                  &error);
        expect_tangents(scene);
    }
    rt_scene *scene = bumpy_scene(&surface);
    surface.transform = placement;
    expect_ok(rt_scene_add_disc(scene, NULL, origin, ahead, 1.4f, 0.3f, &surface, &error), &error);
    expect_tangents(scene);
    scene = bumpy_scene(&surface);
    surface.transform = placement;
    expect_ok(rt_scene_add_torus(scene, NULL, origin, ahead, 1, 0.4f, &surface, &error), &error);
    expect_tangents(scene);
}

static void boxes_have_their_tangents(void **state)
{
    static const float size[3] = {1.6f, 1.2f, 1.4f};
    rt_surface surface;
    rt_error error;
    (void)state;
    rt_scene *scene = bumpy_scene(&surface);
    surface.transform = placement;
    expect_ok(rt_scene_add_box(scene, NULL, origin, size, &surface, &error), &error);
    expect_tangents(scene);
}

static void flat_shapes_have_their_tangents(void **state)
{
    static const float e1[3] = {1.5f, 0.2f, 0}, e2[3] = {0.3f, 1.1f, 0.8f},
                       corner[3] = {-0.7f, -0.6f, -0.2f};
    rt_surface surface;
    rt_error error;
    (void)state;
    for (int placed = 0; placed < 2; placed++) {
        rt_scene *scene = bumpy_scene(&surface);
        if (placed)
            surface.transform = placement;
        expect_ok(rt_scene_add_plane(scene, NULL, origin, ahead, &surface, &error), &error);
        expect_tangents(scene);
        scene = bumpy_scene(&surface);
        if (placed)
            surface.transform = placement;
        expect_ok(rt_scene_add_quad(scene, NULL, corner, e1, e2, &surface, &error), &error);
        expect_tangents(scene);
    }
}

static void meshes_have_the_tangents_of_their_coordinates(void **state)
{
    static const float positions[4][3] = {{-1, -1, 0.2f}, {1, -1, 0}, {-1, 1, 0}, {1, 1.2f, -0.4f}};
    static const float uvs[4][2] = {{0.2f, 0.1f}, {0.3f, 0.9f}, {0.8f, 0.2f}, {0.9f, 0.7f}};
    static const uint32_t indices[2][3] = {{0, 1, 2}, {1, 3, 2}};
    rt_mesh_data data = {
        .positions = positions[0], .indices = indices[0], .vertex_count = 4, .triangle_count = 2};
    rt_surface surface;
    uint32_t mesh;
    rt_error error;
    (void)state;
    for (int with_uv = 0; with_uv < 2; with_uv++)
        for (int places = 1; places < 3; places++) {
            rt_scene *scene = bumpy_scene(&surface);
            data.uv = with_uv ? uvs[0] : NULL;
            expect_ok(rt_scene_add_mesh(scene, &mesh, &data, &error), &error);
            for (int i = 0; i < places; i++) {
                surface.transform = placement;
                surface.transform.m[2][3] += (float)i;
                expect_ok(rt_scene_add_instance(scene, NULL, mesh, &surface, &error), &error);
            }
            expect_tangents(scene);
        }
}

static void tangents_of_every_kind_were_measured(void **state)
{
    (void)state;
    RT_SHAPES(EXPECT_SEEN)
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spheres_and_ellipsoids_have_their_tangents),
        cmocka_unit_test(shapes_about_an_axis_have_their_tangents),
        cmocka_unit_test(boxes_have_their_tangents),
        cmocka_unit_test(flat_shapes_have_their_tangents),
        cmocka_unit_test(meshes_have_the_tangents_of_their_coordinates),
        cmocka_unit_test(tangents_of_every_kind_were_measured),
    };
    return cmocka_run_group_tests_name("kernels/bump", tests, NULL, NULL);
}
