/* A scene that is written back as it was understood is the same scene. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "image/image.h"
#include "lib/image/scratch.h"
#include "rt.h"
#include "scene/scene.h"
#include "tests/dsl/collect.h"

static void on_block(void *user, const char *text)
{
    char *out = user;
    strcat(out, text);
}

/* What a text is understood as. */
static char *dump(const char *text, rt_scene **scene)
{
    char *out = calloc(1, 65536);
    const rt_load_options options = {.block = on_block, .user = out};
    rt_error error;
    *scene = NULL;
    if (rt_scene_parse(scene, text, NULL, &options, &error) != RT_OK)
        fail_msg("%s\nin\n%s", error.message, text);
    return out;
}

static const char scene_text[] =
    "let n = 2\n"
    "camera { eye 0 1 -4  look_at 0 0.1 0 }\n"
    "material m_1 { kd 0.1 }\n"
    "texture t { pattern checker  a 1  b 0 }\n"
    "texture dots { pattern constant  a 0.5 }\n"
    "texture both { pattern multiply  a_texture t  b 0.2 0.3 0.4  scale 2 3 }\n"
    "texture some { pattern mix  a_texture both  b_texture dots  weight 0.25  weight_texture t }\n"
    "texture rest { pattern mix  a_texture some  b 1 }\n"
    "texture again { pattern gradient  b 1  attribute \"uv1\" }\n"
    "texture worn { pattern attribute  attribute \"wear\" }\n"
    "repeat i from 1 to n {\n"
    "    material m { kd (0.3 / i) }\n"
    "    sphere { centre i 0 0  radius (1 / 3)  material m  translate 0 i 0 }\n"
    "}\n"
    "triangle { a 0 0 0  b 1 0 0  c 0 1 0  uva 0 0  uvb 2 0  uvc 0 3  material m_1  texture t }\n"
    "cylinder { a 0 0 0  b 0 1 0  radius 1  caps false  material m_1 }\n"
    "cylinder { a 0 0 0  b 0 1 0  radius 1  material m_1  power 2 }\n"
    "mesh k { file \"scenes/meshes/knot.ply\" }\n"
    "instance k { material m_1 }\n"
    "light point { position 0 3 0  intensity 0 }\n"
    "grid g { file \"scenes/media/puff.grid\"  lo 0 0 0  hi 1 2 1  rotate 0 1 0 30 }\n"
    "material paint { base_color 0.5  specular 0.3 }\n"
    "material mixed { blend paint with m_1  weight_texture rest }\n"
    "grid a { file \"scenes/media/puff.grid\"  wrap repeat }\n"
    "material fog { interface true  scattering 1  density g  albedo a }\n"
    "medium { absorption 1  scattering 1  density g  albedo g }\n"
    "render { mode photon  k all  radius 0.1  seed 7 }\n";

static void a_dump_reads_back_to_the_same_scene(void **state)
{
    rt_scene *a, *b;
    (void)state;
    char *first = dump(scene_text, &a), *second = dump(first, &b);
    assert_string_equal(first, second);
    assert_int_equal(a->shape_count, b->shape_count);
    assert_int_equal(a->material_count, b->material_count);
    assert_int_equal(a->attribute_count, 2);
    assert_memory_equal(a->attributes, b->attributes, sizeof a->attributes);
    for (size_t i = 0; i < a->shape_count; i++)
        assert_true(a->shapes[i].kind == b->shapes[i].kind &&
                    a->shapes[i].material == b->shapes[i].material &&
                    memcmp(a->shapes[i].p, b->shapes[i].p, sizeof a->shapes[i].p) == 0);
    assert_memory_equal(a->materials, b->materials, a->material_count * sizeof *a->materials);
    assert_true(a->texture_row_count > 10 && a->texture_row_count == b->texture_row_count);
    assert_memory_equal(a->texture_rows, b->texture_rows,
                        a->texture_row_count * sizeof *a->texture_rows);
    assert_true(a->options.seed == b->options.seed && a->options.k == b->options.k);
    assert_memory_equal(&a->camera, &b->camera, sizeof a->camera);
    rt_scene_destroy(a);
    rt_scene_destroy(b);
    free(first);
    free(second);
}

static void defaults_are_written_out_where_they_have_an_effect(void **state)
{
    rt_scene *scene;
    (void)state;
    char *text = dump(scene_text, &scene);
    assert_non_null(strstr(text, "fov 45"));
    assert_non_null(strstr(text, "material m_1_0 {"));
    assert_non_null(strstr(text, "material m_1 {"));
    assert_non_null(strstr(text, "caps false"));
    assert_non_null(strstr(text, "caps true"));
    assert_non_null(strstr(text, "uva 0 0"));
    assert_non_null(strstr(text, "intensity 0"));
    assert_non_null(strstr(text, "seed 7"));
    assert_null(strstr(text, "ior"));
    assert_null(strstr(text, "cone_k"));
    assert_null(strstr(text, "let"));
    rt_scene_destroy(scene);
    free(text);
}

static void layers_are_written_by_name(void **state)
{
    static const char text[] = "texture t { file \"l.exr\"  layer \"V.A\" }\n"
                               "material m { kd 1  kd_texture t }\n"
                               "light environment { file \"l.exr\"  layer \"V.A\" }\n";
    static const char *const names[] = {"V.A.Y"};
    rt_image *image = NULL;
    rt_scene *a, *b;
    (void)state;
    assert_int_equal(rt_image_create(&image, 1, 1, names, 1, NULL), RT_OK);
    assert_int_equal(rt_image_write(image, "l.exr", NULL, NULL), RT_OK);
    rt_image_destroy(image);
    char *first = dump(text, &a), *second = dump(first, &b), *at = strstr(first, "layer \"V.A\"");
    assert_string_equal(first, second);
    assert_non_null(at);
    assert_non_null(strstr(at + 1, "layer \"V.A\""));
    rt_scene_destroy(a);
    rt_scene_destroy(b);
    free(first);
    free(second);
}

/* A turned sky is; one without an image has no directions. */
static void turns_of_the_sky_are_written_as_a_matrix(void **state)
{
    static const char *const names[] = {"Y"};
    static const char text[] = "light environment { file \"sky.exr\"  rotation 25  scale -2 2 2  "
                               "rotate 1 2 3 40 }\n";
    rt_image *image = NULL;
    rt_scene *a, *b;
    (void)state;
    assert_int_equal(rt_image_create(&image, 1, 1, names, 1, NULL), RT_OK);
    assert_int_equal(rt_image_write(image, "sky.exr", NULL, NULL), RT_OK);
    rt_image_destroy(image);
    char *first = dump(text, &a), *second = dump(first, &b);
    assert_string_equal(first, second);
    assert_non_null(strstr(first, "rotation 25"));
    assert_non_null(strstr(first, "matrix"));
    assert_true(a->environment.is_turned && b->environment.is_turned);
    assert_memory_equal(a->environment.axes, b->environment.axes, sizeof a->environment.axes);
    rt_scene_destroy(a);
    rt_scene_destroy(b);
    free(first);
    free(second);
    first = dump("light environment { radiance 1  rotate 1 0 0 20 }\n", &a);
    assert_null(strstr(first, "matrix"));
    assert_false(a->environment.is_turned);
    rt_scene_destroy(a);
    free(first);
}

static void metals_and_glasses_are_written_by_name(void **state)
{
    rt_scene *a, *b;
    (void)state;
    char *first = dump("material ring { metal aluminum  roughness 0.1 }\n"
                       "material window { glass water  priority 1 }\n",
                       &a),
         *second = dump(first, &b);
    assert_string_equal(first, second);
    assert_non_null(strstr(first, "metal aluminium"));
    assert_non_null(strstr(first, "glass water"));
    assert_null(strstr(first, "fresnel"));
    assert_null(strstr(first, " ior"));
    assert_memory_equal(a->materials, b->materials, a->material_count * sizeof *a->materials);
    rt_scene_destroy(a);
    rt_scene_destroy(b);
    free(first);
    free(second);
}

static void dispersion_is_written_as_it_was_given(void **state)
{
    rt_scene *a, *b;
    (void)state;
    char *first = dump("material prism { glass sf11  dispersion true }\n"
                       "material stone { kt 1  cauchy 2.4 0.01 }\n"
                       "material lens { kt 1  sellmeier_b 1 0.2 1  sellmeier_c 0.006 0.02 100 }\n"
                       "material drop { kt 1  abbe 55 }\n",
                       &a),
         *second = dump(first, &b);
    assert_string_equal(first, second);
    assert_non_null(strstr(first, "dispersion true"));
    assert_non_null(strstr(first, "cauchy 2.4 0.01"));
    assert_null(strstr(first, " ior"));
    assert_memory_equal(a->materials, b->materials, a->material_count * sizeof *a->materials);
    rt_scene_destroy(a);
    rt_scene_destroy(b);
    free(first);
    free(second);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_dump_reads_back_to_the_same_scene),
        cmocka_unit_test(turns_of_the_sky_are_written_as_a_matrix),
        cmocka_unit_test(metals_and_glasses_are_written_by_name),
        cmocka_unit_test(dispersion_is_written_as_it_was_given),
        cmocka_unit_test(defaults_are_written_out_where_they_have_an_effect),
        cmocka_unit_test_setup_teardown(layers_are_written_by_name, scratch_enter, scratch_leave),
    };
    return cmocka_run_group_tests_name("dump", tests, NULL, NULL);
}
