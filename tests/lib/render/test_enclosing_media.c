/*
 * test_enclosing_media.c - the kernel that looks for solids around the camera and the lights is
 * left out only where it would find none; and what it finds at one point of a light stands for all
 * of it only where that is so.
 */
#include "render/enclosing_media.h"
#include "render/renderer.h"
#include "scene/scene.h"
#include "support.h"

#include <stdlib.h>
#include <string.h>

enum { scenes = 1500, planes = 60, shapes = 3, around = 6, lights_max = around + 2 };

static const float radius = 0.1f; /* of the emitter */

static rt_error error;

static float uniform(float lo, float hi)
{
    return lo + (hi - lo) * (float)(rand() / (RAND_MAX + 1.0));
}

static void point(float p[3], float reach)
{
    for (int i = 0; i < 3; i++)
        p[i] = uniform(-reach, reach);
}

/* A tetrahedron, which is closed, or its first three faces. */
static void add_mesh(rt_scene *scene, const rt_surface *surface, const float at[3])
{
    static const uint32_t faces[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    float corners[4][3];
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 3; j++)
            corners[i][j] = at[j] + (i == j + 1);
    expect_ok(rt_scene_add_triangles(scene, NULL, corners[0], 4, faces, 3 + rand() % 2, NULL,
                                     surface, &error),
              &error);
}

/* One of the shapes, open or closed, somewhere. */
static void add_shape(rt_scene *scene, const rt_surface *surface)
{
    const float size[3] = {1, 2, 0.5f}, up[3] = {0, 1, 0},
                edge[2][3] = {{3, 0.2f, 0}, {0.2f, 0, 4}};
    float at[3], to[3];
    rt_status status = RT_OK;
    point(at, 2);
    point(to, 2);
    switch (rand() % 7) {
    case 0:
        status = rt_scene_add_sphere(scene, NULL, at, uniform(0.3f, 2), surface, &error);
        break;
    case 1:
        status = rt_scene_add_box(scene, NULL, at, size, surface, &error);
        break;
    case 2:
        status = rt_scene_add_torus(scene, NULL, at, up, 1, 0.4f, surface, &error);
        break;
    case 3:
        status = rt_scene_add_cylinder(scene, NULL, at, to, 0.5f, rand() % 2, surface, &error);
        break;
    case 4:
        status = rt_scene_add_quad(scene, NULL, at, edge[0], edge[1], surface, &error);
        break;
    case 5:
        add_mesh(scene, surface, at);
        break;
    case 6:
        if (rand() % 4 == 0)
            status = rt_scene_add_plane(scene, NULL, at, up, surface, &error);
        break;
    }
    expect_ok(status, &error);
}

/* The emitter, and point lights around it, just off its surface. */
static void add_emitter(rt_scene *scene, const rt_surface *surface)
{
    float at[3];
    point(at, 3);
    expect_ok(rt_scene_add_sphere(scene, NULL, at, radius, surface, &error), &error);
    for (int i = 0; i < around; i++) {
        rt_point_light light = {.intensity = {1, 1, 1}};
        memcpy(light.position, at, sizeof at);
        light.position[i / 2] += (i % 2 ? 1.001f : -1.001f) * radius;
        expect_ok(rt_scene_add_point_light(scene, &light, &error), &error);
    }
}

/* A few shapes of glass, an opaque emitter and a point light, seen from somewhere. */
static rt_scene *random_scene(void)
{
    const rt_material glass = {.kt = {1, 1, 1}, .ior = 1.5f}, black = {0};
    rt_scene *scene = NULL;
    rt_surface surface;
    rt_camera camera = {.look_at = {0.1f, 0.2f, 9}, .fov = 40};
    rt_point_light light = {.intensity = {1, 1, 1}};
    memset(&surface, 0, sizeof surface);
    for (int i = 0; i < 3; i++)
        surface.transform.m[i][i] = 1;
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_add_material(scene, NULL, NULL, &glass, &error), &error);
    expect_ok(rt_scene_add_material(scene, &surface.material, NULL, &black, &error), &error);
    surface.radiance[0] = 1;
    add_emitter(scene, &surface);
    surface.radiance[0] = 0;
    surface.material = 0;
    for (int i = 0; i < shapes; i++)
        add_shape(scene, &surface);
    point(light.position, 3);
    expect_ok(rt_scene_add_point_light(scene, &light, &error), &error);
    point(camera.eye, 3);
    expect_ok(rt_scene_set_camera(scene, &camera, &error), &error);
    return scene;
}

/* What is known of a scene's lights; those around the emitter come first, the emitter is last. */
typedef struct known {
    rt_light_data lights[lights_max];
    int is_possible; /* that a solid is around the camera or a light, as the bounds tell */
    int is_there;    /* one that the kernel finds */
} known;

static void find_media(known *out, const rt_scene *scene)
{
    rt_renderer *renderer = NULL;
    rt_stage_progress progress;
    rt_scene_header header;
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    out->is_possible = renderer->image.may_start_in_solids;
    expect_ok(rt_stage_begin(&progress, NULL, RT_STAGE_BUILD), NULL);
    expect_ok(rt_enclosing_media_find(renderer->device, renderer->scene, scene, &progress, &error),
              &error);
    test_read(renderer->scene, sizeof header, &header);
    assert_int_equal(header.light_count, lights_max);
    expect_ok(rt_buffer_read(renderer->device, renderer->scene,
                             (size_t)header.lights * RT_SCENE_ROW, sizeof out->lights, out->lights,
                             &error),
              &error);
    out->is_there = header.eye_media[0] != 0;
    for (int i = 0; i < lights_max; i++)
        out->is_there |= out->lights[i].media[0] != 0;
    rt_renderer_destroy(renderer);
}

static int is_partly_enclosed(const rt_light_data *light)
{
    return (light->flags & RT_LIGHT_PARTLY_ENCLOSED) != 0;
}

/* Whether the solid that counts is the same at all points around the emitter and for itself. */
static int are_alike(const known *of)
{
    for (int i = 0; i < around; i++)
        if (!is_partly_enclosed(of->lights + i) &&
            of->lights[i].media[0] != of->lights[lights_max - 1].media[0])
            return 0;
    return 1;
}

static void media_are_possible_where_the_kernel_finds_them(void **state)
{
    (void)state;
    int found = 0, left_out = 0, parts = 0, wholes = 0;
    srand(1);
    for (int i = 0; i < scenes; i++) {
        rt_scene *scene = random_scene();
        known of;
        find_media(&of, scene);
        if (of.is_there && !of.is_possible)
            fail_msg("scene %d: a medium is there that was held impossible", i);
        const int is_part = is_partly_enclosed(of.lights + lights_max - 1);
        if (!is_part && !are_alike(&of))
            fail_msg("scene %d: one point of the emitter does not stand for all", i);
        found += of.is_there;
        left_out += !of.is_possible;
        parts += is_part;
        wholes += !is_part && of.lights[lights_max - 1].media[0] != 0;
        rt_scene_destroy(scene);
    }
    /* All cases occur. */
    assert_in_range(found, scenes / 20, scenes);
    assert_in_range(left_out, scenes / 20, scenes);
    assert_in_range(parts, scenes / 20, scenes / 2);
    assert_in_range(wholes, scenes / 200, scenes);
}

/* Wherever the normal points: the ray that looks for solids may never leave a half-space. */
static void half_spaces_lie_behind_their_planes(void **state)
{
    (void)state;
    int inside = 0, outside = 0;
    srand(2);
    for (int i = 0; i < planes; i++) {
        rt_scene *scene = random_scene();
        const rt_material water = {.kt = {1, 1, 1}, .ior = 1.3f, .priority = 1};
        rt_surface surface;
        float at[3], normal[3];
        double height = 0;
        rt_u32 material;
        known of;
        memset(&surface, 0, sizeof surface);
        for (int k = 0; k < 3; k++)
            surface.transform.m[k][k] = 1;
        expect_ok(rt_scene_add_material(scene, &material, NULL, &water, &error), &error);
        surface.material = material;
        point(at, 3);
        point(normal, 1);
        expect_ok(rt_scene_add_plane(scene, NULL, at, normal, &surface, &error), &error);
        find_media(&of, scene);
        /* The point light comes after those around the emitter. */
        for (int k = 0; k < 3; k++)
            height += (double)normal[k] * (of.lights[around].a[k] - at[k]);
        rt_scene_destroy(scene);
        if (is_partly_enclosed(of.lights + around))
            continue;
        if ((of.lights[around].media[0] == material + 1) != (height < 0))
            fail_msg("scene %d: a light %g m over a plane has the medium %u", i, height,
                     (unsigned)of.lights[around].media[0]);
        inside += height < 0;
        outside += height > 0;
    }
    assert_in_range(inside, planes / 8, planes);
    assert_in_range(outside, planes / 8, planes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(half_spaces_lie_behind_their_planes),
        cmocka_unit_test(media_are_possible_where_the_kernel_finds_them)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
