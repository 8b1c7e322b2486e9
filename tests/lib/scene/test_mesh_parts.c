/* test_mesh_parts.c - a mesh file whose faces have several textures. */
#include "support.h"

#include <math.h>
#include <string.h>

#include "lib/image/scratch.h"
#include "lib/scene/scenes.h"
#include "scene/scene.h"

static const float pi = 3.14159265f;

/*
 * Four squares side by side at z = 0: red, none, blue, red; the colours of images of one texel. No
 * square has the texture between them, whose file is not there.
 */
static const char squares[] =
    "ply\nformat ascii 1.0\ncomment TextureFile red.ppm\n"
    "comment TextureFile missing.ppm\ncomment TextureFile blue.ppm\n"
    "element vertex 10\nproperty float x\nproperty float y\nproperty float z\nproperty float u\n"
    "property float v\nproperty float red\nproperty float green\nproperty float blue\n"
    "element face 4\nproperty list uchar int vertex_indices\nproperty int texnumber\nend_header\n"
    "0 0 0 0 0 1 1 1\n1 0 0 1 0 1 1 1\n2 0 0 2 0 1 1 1\n3 0 0 3 0 1 1 1\n4 0 0 4 0 1 1 1\n"
    "0 1 0 0 1 1 1 1\n1 1 0 1 1 1 1 1\n2 1 0 2 1 1 1 1\n3 1 0 3 1 1 1 1\n4 1 0 4 1 1 1 1\n"
    "4 0 1 6 5 0\n4 1 2 7 6 -1\n4 2 3 8 7 2\n4 3 4 9 8 0\n";

static rt_scene *load(uint32_t *mesh, rt_mesh_info *info)
{
    rt_scene *scene = new_scene();
    rt_error error;
    scratch_write("squares.ply", squares);
    scratch_write("red.ppm", "P3 1 1 255 255 0 0\n");
    scratch_write("blue.ppm", "P3 1 1 255 0 0 255\n");
    if (rt_scene_load_mesh(scene, mesh, "squares.ply", RT_SHADING_FILE, info, &error) != RT_OK)
        fail_msg("%s", error.message);
    return scene;
}

static void each_texture_has_its_triangles(void **state)
{
    (void)state;
    rt_mesh_info info;
    rt_error error;
    uint32_t mesh, shape;
    rt_scene *scene = load(&mesh, &info);
    rt_surface surface = {.texture = info.texture};
    assert_int_equal(info.part_count, 3);
    assert_int_equal(scene->texture_count, 2);
    assert_int_equal(info.triangle_count, 8);
    assert_int_equal(info.vertex_count, 10);
    assert_true(info.lo[0] == 0 && info.hi[0] == 4);
    assert_int_equal(rt_scene_add_instance(scene, &shape, mesh, &surface, &error), RT_OK);
    assert_int_equal(shape, 0);
    assert_int_equal(scene->shape_count, 3);
    static const size_t triangles[] = {4, 2, 2};
    static const float lo[] = {0, 2, 1}, hi[] = {4, 3, 2};
    for (size_t i = 0; i < 3; i++) {
        const rt_scene_mesh *part = scene->meshes + scene->shapes[i].mesh;
        assert_int_equal(part->triangle_count, triangles[i]);
        assert_true(part->lo[0] == lo[i] && part->hi[0] == hi[i]);
        for (size_t v = 0; v < part->vertex_count; v++) /* what a vertex has goes with it */
            assert_true(part->uv[2 * v] == part->positions[3 * v] &&
                        part->uv[2 * v + 1] == part->positions[3 * v + 1]);
        assert_non_null(part->colours);
    }
    assert_int_equal(scene->shapes[0].texture, info.texture);
    assert_true(scene->textures[scene->shapes[0].texture - 1].mean[0] == 1);
    assert_true(scene->textures[scene->shapes[1].texture - 1].mean[2] == 1);
    assert_int_equal(scene->shapes[2].texture, 0);
    rt_scene_destroy(scene);
}

/* A texture of the instance goes before those of the file; so does that of each instance. */
static void an_instance_may_have_its_own_texture(void **state)
{
    (void)state;
    rt_mesh_info info;
    rt_error error;
    uint32_t mesh, handle;
    rt_scene *scene = load(&mesh, &info);
    rt_texture texture = {.path = "blue.ppm"};
    assert_int_equal(rt_scene_add_texture(scene, &handle, &texture, &error), RT_OK);
    rt_surface surface = {.texture = handle};
    assert_int_equal(rt_scene_add_instance(scene, NULL, mesh, &surface, &error), RT_OK);
    for (size_t i = 0; i < 3; i++)
        assert_int_equal(scene->shapes[i].texture, handle);
    rt_scene_destroy(scene);
}

/* The power is that of all parts together. */
static void parts_share_the_power(void **state)
{
    (void)state;
    rt_mesh_info info;
    rt_error error;
    uint32_t mesh;
    rt_scene *scene = load(&mesh, &info);
    rt_surface surface = {.texture = info.texture, .power = {8 * pi, 4 * pi, 0}};
    assert_int_equal(rt_scene_add_instance(scene, NULL, mesh, &surface, &error), RT_OK);
    for (size_t i = 0; i < 3; i++) {
        float radiance[3];
        rt_scene_shape_radiance(scene, scene->shapes + i, radiance);
        assert_true(fabsf(radiance[0] - 2) < 1e-5f && fabsf(radiance[1] - 1) < 1e-5f &&
                    radiance[2] == 0);
    }
    rt_scene_destroy(scene);
}

/* What cannot be placed leaves nothing behind. */
static void all_parts_are_placed_or_none(void **state)
{
    (void)state;
    rt_mesh_info info;
    rt_error error;
    uint32_t mesh;
    rt_scene *scene = load(&mesh, &info);
    rt_surface surface = {.texture = info.texture, .material = 99};
    assert_int_equal(rt_scene_add_instance(scene, NULL, mesh, &surface, &error), RT_ERROR_INPUT);
    assert_int_equal(scene->shape_count, 0);
    /* The part without a texture, at x < 2, then the blue one, at x < 3, which is too far. */
    const float scale = 0.4f * RT_COORDINATE_MAX;
    uint32_t shape = 77;
    surface = (rt_surface){.transform = {{{scale, 0, 0, 0}, {0, scale, 0, 0}, {0, 0, scale, 0}}}};
    scene->meshes[mesh + 1].next = RT_NONE;
    scene->meshes[mesh + 2].next = mesh + 1;
    assert_int_equal(rt_scene_add_instance(scene, &shape, mesh + 2, &surface, &error),
                     RT_ERROR_INPUT);
    assert_int_equal(scene->shape_count, 0);
    assert_int_equal(shape, 77);
    rt_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_texture_has_its_triangles),
        cmocka_unit_test(an_instance_may_have_its_own_texture),
        cmocka_unit_test(parts_share_the_power),
        cmocka_unit_test(all_parts_are_placed_or_none),
    };
    return cmocka_run_group_tests_name("scene/mesh_parts", tests, scratch_enter, scratch_leave);
}
