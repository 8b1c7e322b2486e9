/* test_attributes.c - meshes with attributes, and shapes whose textures ask for them. */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "lib/image/scratch.h"
#include "lib/scene/scenes.h"
#include "scene/scene.h"

static const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
static const uint32_t indices[] = {0, 1, 2};
static const float pairs[] = {0, 1, 2, -3, 4, 5}, odd[] = {0, 1, 2, NAN, 4, 5};

static rt_status add_mesh(rt_scene *scene, uint32_t *mesh, const rt_mesh_attribute *attributes,
                          size_t count, rt_error *error)
{
    const rt_mesh_data data = {.positions = positions,
                               .indices = indices,
                               .vertex_count = 3,
                               .triangle_count = 1,
                               .attributes = attributes,
                               .attribute_count = count};
    return rt_scene_add_mesh(scene, mesh, &data, error);
}

static void attributes_that_are_not_sound_are_refused(void **state)
{
    (void)state;
    static const char longest[] =
        "a234567890123456789012345678901234567890123456789012345678901234";
    const rt_mesh_attribute sound = {.name = "uv1", .values = pairs, .width = 2};
    const rt_mesh_attribute wrong[] = {{.name = "", .values = pairs, .width = 2},
                                       {.values = pairs, .width = 2},
                                       {.name = longest, .values = pairs, .width = 2},
                                       {.name = "uv1", .values = pairs, .width = 2},
                                       {.name = "uv2", .values = odd, .width = 2},
                                       {.name = "uv2", .values = pairs},
                                       {.name = "uv2", .values = pairs, .width = 4},
                                       {.name = "uv2", .width = 2}};
    rt_scene *scene = new_scene();
    rt_error error;
    uint32_t mesh;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        const rt_mesh_attribute both[] = {sound, wrong[i]};
        expect_refused(add_mesh(scene, &mesh, both, 2, &error), &error, "attributes");
    }
    assert_int_equal(scene->mesh_count, 0);
    rt_scene_destroy(scene);
}

/* Adds a ramp by this attribute, and a material that shows it in its roughness alone. */
static rt_status add_ramp(rt_scene *scene, rt_surface *surface, const char *attribute,
                          rt_error *error)
{
    const rt_texture ramp = {.kind = RT_TEXTURE_GRADIENT, .b = {1, 1, 1}, .attribute = attribute};
    rt_material material = {.ks = {0.5f, 0.5f, 0.5f}};
    const rt_status status = rt_scene_add_texture(scene, &material.roughness_texture, &ramp, error);
    memset(surface, 0, sizeof *surface);
    return status == RT_OK
               ? rt_scene_add_material(scene, &surface->material, NULL, &material, error)
               : status;
}

static void shapes_without_an_attribute_are_refused(void **state)
{
    (void)state;
    static const float centre[] = {0, 0, 0};
    const rt_mesh_attribute has[] = {{.name = "uv1", .values = pairs, .width = 2},
                                     {.name = "wear", .values = pairs, .width = 1}};
    static const struct {
        const char *name, *why;
    } wrong[] = {{"uv2", "it has 'uv1', 'wear'"}, {"wear", "of 1 number; coordinates are two"}};
    rt_scene *scene = new_scene();
    rt_surface surface;
    rt_error error;
    uint32_t mesh, bare;
    expect_ok(add_mesh(scene, &mesh, has, 2, &error), &error);
    expect_ok(add_mesh(scene, &bare, NULL, 0, &error), &error);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        expect_ok(add_ramp(scene, &surface, wrong[i].name, &error), &error);
        expect_refused(rt_scene_add_instance(scene, NULL, mesh, &surface, &error), &error,
                       "material");
        assert_non_null(strstr(error.message, wrong[i].why));
    }
    expect_ok(add_ramp(scene, &surface, "uv1", &error), &error);
    expect_ok(rt_scene_add_instance(scene, NULL, mesh, &surface, &error), &error);
    expect_refused(rt_scene_add_instance(scene, NULL, bare, &surface, &error), &error, "material");
    assert_non_null(strstr(error.message, "it has none"));
    expect_refused(rt_scene_add_sphere(scene, NULL, centre, 1, &surface, &error), &error,
                   "material");
    assert_non_null(strstr(error.message, "which only meshes have"));
    assert_int_equal(scene->shape_count, 1);
    rt_scene_destroy(scene);
}

/* In a texture inside of others, of the shape itself, and in a part of a material. */
static void every_texture_of_a_shape_counts(void **state)
{
    (void)state;
    rt_scene *scene = new_scene();
    rt_surface surface, own = {.material = 0};
    rt_texture outer = {.kind = RT_TEXTURE_MULTIPLY, .a_texture = 1, .b = {1, 1, 1}};
    rt_material blend = {.blend = 1, .with = 2};
    rt_error error;
    uint32_t mesh;
    expect_ok(add_mesh(scene, &mesh, NULL, 0, &error), &error);
    expect_ok(add_ramp(scene, &surface, "uv1", &error), &error);
    expect_ok(rt_scene_add_texture(scene, &own.texture, &outer, &error), &error);
    expect_refused(rt_scene_add_instance(scene, NULL, mesh, &own, &error), &error, "texture");
    expect_ok(rt_scene_add_material(scene, &surface.material, NULL, &blend, &error), &error);
    expect_refused(rt_scene_add_instance(scene, NULL, mesh, &surface, &error), &error, "material");
    rt_scene_destroy(scene);
}

static void a_scene_has_so_many_names(void **state)
{
    (void)state;
    rt_scene *scene = new_scene();
    rt_surface surface;
    rt_error error;
    char name[RT_ATTRIBUTE_NAME + 1];
    for (int i = 0; i < RT_ATTRIBUTES_MOST; i++) {
        snprintf(name, sizeof name, "set%d", i);
        expect_ok(add_ramp(scene, &surface, name, &error), &error);
    }
    expect_ok(add_ramp(scene, &surface, "set7", &error), &error);
    expect_refused(add_ramp(scene, &surface, "one more", &error), &error, "attribute");
    expect_refused(add_ramp(scene, &surface, "", &error), &error, "attribute");
    memset(name, 'a', RT_ATTRIBUTE_NAME);
    name[RT_ATTRIBUTE_NAME] = '\0';
    expect_refused(add_ramp(scene, &surface, name, &error), &error, "attribute");
    rt_scene_destroy(scene);
}

/* Two triangles by their own textures: what each has goes with it. */
static void parts_of_a_file_keep_theirs(void **state)
{
    (void)state;
    rt_scene *scene = new_scene();
    rt_mesh_info info;
    rt_error error;
    uint32_t mesh;
    scratch_write("red.ppm", "P3 1 1 255 255 0 0\n");
    scratch_write("two.ply",
                  "ply\nformat ascii 1.0\ncomment TextureFile red.ppm\ncomment TextureFile "
                  "red.ppm\nelement vertex 6\nproperty float x\nproperty float y\nproperty float "
                  "z\nproperty float w_x\nproperty float w_y\nelement face 2\nproperty list uchar "
                  "int vertex_indices\nproperty int texnumber\nproperty uchar part\nend_header\n"
                  "0 0 0 10 0\n1 0 0 11 1\n0 1 0 12 2\n0 0 1 13 3\n1 0 1 14 4\n0 1 1 15 5\n"
                  "3 3 4 5 1 51\n3 0 1 2 0 255\n");
    expect_ok(rt_scene_load_mesh(scene, &mesh, "two.ply", RT_SHADING_FILE, &info, &error), &error);
    assert_int_equal(info.part_count, 2);
    const rt_scene_mesh *first = scene->meshes + mesh, *second = scene->meshes + first->next;
    assert_float_equal(first->of_vertices.values[0], 10, 0);
    assert_float_equal(first->of_triangles.values[0], 1, 0);
    assert_float_equal(second->of_vertices.values[5], 5, 0);
    assert_float_equal(second->of_triangles.values[0], 0.2, 1e-7);
    assert_true(second->of_vertices.list[0].least == 3 &&
                second->of_vertices.list[0].largest == 15);
    rt_scene_destroy(scene);
}

/* Programs write what they do not know as nan: that matters where a texture asks for it. */
static void numbers_of_files_count_where_they_are_used(void **state)
{
    (void)state;
    rt_scene *scene = new_scene();
    rt_surface surface, plain = {.material = 0};
    rt_error error;
    uint32_t mesh;
    scratch_write("odd.ply",
                  "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float "
                  "y\nproperty float z\nproperty float w_x\nproperty float w_y\nelement face "
                  "1\nproperty list uchar int vertex_indices\nend_header\n"
                  "0 0 0 10 0\n1 0 0 11 nan\n0 1 0 12 2\n3 0 1 2\n");
    expect_ok(rt_scene_load_mesh(scene, &mesh, "odd.ply", RT_SHADING_FILE, NULL, &error), &error);
    expect_ok(rt_scene_add_instance(scene, NULL, mesh, &plain, &error), &error);
    expect_ok(add_ramp(scene, &surface, "w", &error), &error);
    expect_refused(rt_scene_add_instance(scene, NULL, mesh, &surface, &error), &error, "material");
    assert_non_null(strstr(error.message, "has the value nan; coordinates are finite"));
    rt_scene_destroy(scene);
}

static void what_a_pattern_shows_lies_between_0_and_1(void **state)
{
    (void)state;
    static const float grey[][3] = {
        {0, 0.5f, 1}, {0, 1.00005f, 1}, {0, 1.01f, 1}, {0, -0.25f, 1}, {0.5f, 0.5f, 0.5f}};
    static const char *const why[] = {NULL, NULL, "has the value 1.01", "has the value -0.25",
                                      "is of 2 numbers; a pattern shows one or three"};
    rt_error error;
    for (size_t i = 0; i < sizeof grey / sizeof *grey; i++) {
        const rt_mesh_attribute wear = {
            .name = "wear", .values = i == 4 ? pairs : grey[i], .width = i == 4 ? 2 : 1};
        const rt_texture shown = {.kind = RT_TEXTURE_ATTRIBUTE, .attribute = "wear"};
        rt_scene *scene = new_scene();
        rt_surface surface = {.material = 0};
        uint32_t mesh;
        expect_ok(add_mesh(scene, &mesh, &wear, 1, &error), &error);
        expect_ok(rt_scene_add_texture(scene, &surface.texture, &shown, &error), &error);
        const rt_status status = rt_scene_add_instance(scene, NULL, mesh, &surface, &error);
        if (!why[i]) {
            expect_ok(status, &error);
        } else {
            expect_refused(status, &error, "texture");
            assert_non_null(strstr(error.message, why[i]));
        }
        rt_scene_destroy(scene);
    }
}

static void a_pattern_needs_a_name(void **state)
{
    (void)state;
    const rt_texture shown = {.kind = RT_TEXTURE_ATTRIBUTE};
    rt_scene *scene = new_scene();
    rt_error error;
    expect_refused(rt_scene_add_texture(scene, NULL, &shown, &error), &error, "attribute");
    rt_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(attributes_that_are_not_sound_are_refused),
        cmocka_unit_test(shapes_without_an_attribute_are_refused),
        cmocka_unit_test(every_texture_of_a_shape_counts),
        cmocka_unit_test(a_scene_has_so_many_names),
        cmocka_unit_test(parts_of_a_file_keep_theirs),
        cmocka_unit_test(what_a_pattern_shows_lies_between_0_and_1),
        cmocka_unit_test(a_pattern_needs_a_name),
        cmocka_unit_test(numbers_of_files_count_where_they_are_used),
    };
    return cmocka_run_group_tests_name("scene/attributes", tests, scratch_enter, scratch_leave);
}
