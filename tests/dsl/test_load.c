/* What a good text puts into the scene, and how files are found. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "scene/scene.h"
#include "tests/dsl/collect.h"

static void assert_vector(const float found[3], float x, float y, float z)
{
    assert_float_equal(found[0], x, 1e-6);
    assert_float_equal(found[1], y, 1e-6);
    assert_float_equal(found[2], z, 1e-6);
}

static void every_field_reaches_the_scene(void **state)
{
    static const char text[] =
        "camera { eye 0 1 -4  look_at 0 1 0  up 0 1 1  fov 40  aperture 0.02  focal_distance 3 }\n"
        "film { width 640  height 480 }\n"
        "render { mode photon spp 7 max_depth 9 seed 4294967295 sampler independent time 2.5 photons 4000000000\n"
        "  k 60 radius 0.25 kernel gaussian_jensen cone_k 1.5 direct photons final_gather 2 }\n"
        "material glass { kd 0.1  ks 0.1 0.2 0.3  kt 0.6  emission 1 2 3  ior 1.33  fresnel dielectric  two_sided true\n"
        "  priority 3 }\n"
        "material plain { kd 0.7 }\n"
        "plane { point 0 0 0  normal 0 2 0  material plain }\n"
        "sphere { centre 1 2 3  radius 0.5  material glass  radiance 4 5 6 }\n"
        "triangle { a 0 0 0  b 1 0 0  c 0 1 0  na 0 0 1  nb 0 1 1  nc 1 0 1  material plain }\n"
        "quad { corner 1 1 1  edge1 2 0 0  edge2 0 0 2  material plain  power 8 }\n"
        "light point { position 1 2 3  intensity 4 }\n";
    static collected c;
    (void)state;
    collect_text(&c, text);
    expect_clean(&c, text);

    const rt_camera *camera = &c.scene->camera;
    assert_vector(camera->eye, 0, 1, -4);
    assert_vector(camera->look_at, 0, 1, 0);
    assert_vector(camera->up, 0, 1, 1);
    assert_float_equal(camera->fov, 40, 0);
    assert_float_equal(camera->aperture, 0.02f, 0);
    assert_float_equal(camera->focal_distance, 3, 0);

    rt_render_options o;
    rt_scene_get_options(c.scene, &o);
    assert_true(o.width == 640 && o.height == 480 && o.mode == RT_MODE_PHOTON && o.spp == 7 && o.max_depth == 9);
    assert_true(o.seed == 4294967295u && o.sampler == RT_SAMPLER_INDEPENDENT && o.time == 2.5);
    assert_true(o.photons == 4000000000u && o.k == 60 && o.radius == 0.25f && o.cone_k == 1.5f);
    assert_true(o.kernel == RT_DENSITY_GAUSSIAN_JENSEN && o.direct == RT_DIRECT_PHOTONS && o.final_gather == 2);

    const rt_material *m = &c.scene->materials[0];
    assert_vector(m->kd, 0.1f, 0.1f, 0.1f);
    assert_vector(m->ks, 0.1f, 0.2f, 0.3f);
    assert_vector(m->kt, 0.6f, 0.6f, 0.6f);
    assert_vector(m->emission, 1, 2, 3);
    assert_true(m->ior == 1.33f && m->fresnel == 1 && m->two_sided == 1 && m->priority == 3);

    const rt_scene_shape *s = c.scene->shapes;
    assert_int_equal(c.scene->shape_count, 4);
    assert_true(s[0].kind == RT_SHAPE_PLANE && s[0].surface.material == 1);
    assert_true(s[1].kind == RT_SHAPE_SPHERE && s[1].surface.material == 0 && s[1].p[3] == 0.5f);
    assert_vector(s[1].p, 1, 2, 3);
    assert_vector(s[1].surface.radiance, 4, 5, 6);
    const rt_scene_mesh *triangle = &c.scene->meshes[s[2].mesh];
    assert_true(s[2].kind == RT_SHAPE_TRIANGLES && triangle->triangle_count == 1 && triangle->normals);
    assert_vector(triangle->positions + 3, 1, 0, 0);
    assert_vector(triangle->normals + 6, 1, 0, 1);
    assert_true(s[3].kind == RT_SHAPE_QUAD);
    assert_vector(s[3].p + 3, 2, 0, 0);
    assert_vector(s[3].p + 6, 0, 0, 2);
    assert_vector(s[3].surface.power, 8, 8, 8);
    assert_vector(c.scene->lights[0].emission, 4, 4, 4);
    collected_free(&c);
}

/* Each choice of the language is the enumerator of that name. */
static void choices_match_their_enums(void **state)
{
    static const struct {
        const char *word;
        int value;
    } kernels[] = {{"epanechnikov", RT_DENSITY_EPANECHNIKOV}, {"box", RT_DENSITY_BOX},
                   {"cone", RT_DENSITY_CONE},                 {"gaussian", RT_DENSITY_GAUSSIAN},
                   {"silverman", RT_DENSITY_SILVERMAN},       {"gaussian_jensen", RT_DENSITY_GAUSSIAN_JENSEN}};
    static collected c;
    (void)state;
    for (size_t i = 0; i < sizeof kernels / sizeof *kernels; i++) {
        char text[128];
        snprintf(text, sizeof text, "render { kernel %s mode path sampler sobol direct nee }", kernels[i].word);
        collect_text(&c, text);
        expect_clean(&c, text);
        assert_int_equal(c.scene->options.kernel, kernels[i].value);
        assert_int_equal(c.scene->options.mode, RT_MODE_PATH);
        assert_int_equal(c.scene->options.sampler, RT_SAMPLER_SOBOL);
        assert_int_equal(c.scene->options.direct, RT_DIRECT_NEE);
        collected_free(&c);
    }
}

/* The value of an expression, seen as the position of a light. */
static void expect_position(const char *expression, float x, float y, float z)
{
    static collected c;
    char text[512];
    snprintf(text, sizeof text, "let a = 3\nlet v = [1 2 3]\nlet e = %s\nlet used = (a + v + e)\n"
             "light point { position e  power used }", expression);
    collect_text(&c, text);
    expect_clean(&c, text);
    assert_vector(c.scene->lights[0].position, x, y, z);
    collected_free(&c);
}

static void arithmetic_follows_its_rules(void **state)
{
    (void)state;
    expect_position("[1 2 3]", 1, 2, 3);
    expect_position("v", 1, 2, 3);
    expect_position("2 * v + 1", 3, 5, 7);
    expect_position("v * [4 5 6]", 4, 10, 18);
    expect_position("[6 6 6] / v", 6, 3, 2);
    expect_position("v - [0 0 1] - [0 0 1]", 1, 2, 1);
    expect_position("[1 1 1] * (1 + 2 * 3)", 7, 7, 7);
    expect_position("[1 1 1] * (12 / 3 / 2)", 2, 2, 2);
    expect_position("[1 1 1] * (7 - 2 - 1)", 4, 4, 4);
    expect_position("[1 1 1] * ((1 + 2) * 3)", 9, 9, 9);
    expect_position("[(a - 1) -a a]", 2, -3, 3);
    expect_position("[-1 -(a + 1) (--a)]", -1, -4, 3);
    expect_position("-v", -1, -2, -3);
    expect_position("v\n* 2 # over\n # lines\n + 1", 3, 5, 7);
    expect_position("[.5 5. 1e2]", 0.5f, 5, 100);
    expect_position("[1E+2 1e-2 0.1e1]", 100, 0.01f, 1);
}

static void spaces_lines_and_marks_do_not_matter(void **state)
{
    static const char *const texts[] = {
        "film{width 4 height 5}",
        "film\n{\nwidth\n4\nheight 5 }",
        "film {\r\n\twidth 4\r\n\theight 5\r\n}\r\n",
        "\xef\xbb\xbf" "film { height 5 width 4 }",
        "# \xc3\xa9t\xc3\xa9\nfilm { width 4 # } \n height 5 }",
        "let width = 4\nfilm { width (width) height 5 }",
    };
    static collected c;
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        collect_text(&c, texts[i]);
        expect_clean(&c, texts[i]);
        assert_int_equal(c.scene->options.width, 4);
        assert_int_equal(c.scene->options.height, 5);
        collected_free(&c);
    }
}

/* ---- Files --------------------------------------------------------------- */

typedef struct scratch {
    char directory[64];
} scratch;

static void write_file(const scratch *s, const char *name, const char *text, size_t size, char path[256])
{
    snprintf(path, 256, "%s/%s", s->directory, name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static int make_scratch(void **state)
{
    static scratch s;
    strcpy(s.directory, "/tmp/librt-dsl-XXXXXX");
    *state = &s;
    return mkdtemp(s.directory) == NULL;
}

static int remove_scratch(void **state)
{
    static const char *const names[] = {"a.rts", "b.rts", "sub/c.rts", "sub"};
    const scratch *s = *state;
    char path[256];
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        snprintf(path, sizeof path, "%s/%s", s->directory, names[i]);
        remove(path);
    }
    return rmdir(s->directory);
}

static void includes_are_relative_to_the_file_that_names_them(void **state)
{
    static const char a[] = "include \"sub/c.rts\"\nfilm { width w  height h }\n";
    static const char b[] = "let h = 5\n";
    static const char c_text[] = "include \"../b.rts\"\nlet w = 4\nmaterial spare { }\n";
    const scratch *s = *state;
    static collected c;
    char path[256], sub[128];
    snprintf(sub, sizeof sub, "%s/sub", s->directory);
    assert_int_equal(mkdir(sub, 0700), 0);
    write_file(s, "b.rts", b, strlen(b), path);
    write_file(s, "sub/c.rts", c_text, strlen(c_text), path);
    write_file(s, "a.rts", a, strlen(a), path);
    collect_file(&c, path);
    expect_clean(&c, a);
    assert_int_equal(c.scene->options.width, 4);
    assert_int_equal(c.scene->options.height, 5);
    collected_free(&c);
}

static void errors_name_the_included_file_and_keep_the_order(void **state)
{
    static const char a[] = "foo\ninclude \"b.rts\"\nbar\n";
    static const char b[] = "\nfilm { width 0 }\n";
    const scratch *s = *state;
    static collected c;
    char path[256], included[256];
    write_file(s, "b.rts", b, strlen(b), included);
    write_file(s, "a.rts", a, strlen(a), path);
    collect_file(&c, path);
    assert_int_equal(c.count, 3);
    assert_string_equal(c.items[0].file, path);
    assert_string_equal(c.items[1].file, included);
    assert_int_equal(c.items[1].line, 2);
    assert_string_equal(c.items[1].source_line, "film { width 0 }");
    assert_string_equal(c.items[2].file, path);
    assert_int_equal(c.items[2].line, 3);
}

static void cycles_and_explosions_of_includes_are_refused(void **state)
{
    static const char self[] = "include \"a.rts\"\n";
    static const char twice[] = "include \"b.rts\"\ninclude \"b.rts\"\n";
    const scratch *s = *state;
    static collected c;
    char path[256];
    write_file(s, "a.rts", self, strlen(self), path);
    collect_file(&c, path);
    assert_int_equal(c.count, 1);
    assert_non_null(strstr(c.items[0].message, "it would include itself"));

    write_file(s, "b.rts", self, strlen(self), path);
    write_file(s, "a.rts", twice, strlen(twice), path);
    collect_file(&c, path);
    assert_int_equal(c.count, 2);
    assert_int_equal(c.items[0].line, 1);
    assert_non_null(strstr(c.items[0].file, "/b.rts"));
    assert_non_null(strstr(c.items[0].message, "it would include itself"));
}

static void what_is_no_text_is_one_error(void **state)
{
    static const char binary[] = "film { width 4 }\n\x89PNG\0\1\2\xff\xfe{{{";
    const scratch *s = *state;
    static collected c;
    char path[256];
    write_file(s, "a.rts", binary, sizeof binary, path);
    collect_file(&c, path);
    assert_int_equal(c.count, 1);
    assert_int_equal(c.items[0].line, 2);
    assert_int_equal(c.items[0].column, 5);
    assert_string_equal(c.items[0].message, "the file is not text: it holds a NUL byte here");
}

static void a_file_that_cannot_be_read_is_an_error_without_place(void **state)
{
    static const struct {
        const char *path, *message;
    } cases[] = {{"/no/such/scene.rts", "cannot read the scene: No such file or directory"},
                 {"/tmp", "cannot read the scene: it is a directory"},
                 {"/dev/zero", "cannot read the scene: the scene's files are larger than 256 MiB together"}};
    static collected c;
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        collect_file(&c, cases[i].path);
        assert_int_equal(c.status, RT_ERROR_INPUT);
        assert_string_equal(c.error.file, cases[i].path);
        assert_string_equal(c.error.message, cases[i].message);
        assert_int_equal(c.error.line, 0);
        assert_int_equal(c.count, 1);
        assert_int_equal(c.items[0].line, 0);
        assert_string_equal(c.items[0].source_line, "");
    }
}

static void without_callback_or_error_it_still_works(void **state)
{
    rt_scene *scene = NULL;
    (void)state;
    assert_int_equal(rt_scene_parse(&scene, "film { width 0 }", "text", NULL, NULL), RT_ERROR_INPUT);
    assert_null(scene);
    assert_int_equal(rt_scene_parse(&scene, "film { width 1 }", "text", NULL, NULL), RT_OK);
    rt_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_field_reaches_the_scene),
        cmocka_unit_test(choices_match_their_enums),
        cmocka_unit_test(arithmetic_follows_its_rules),
        cmocka_unit_test(spaces_lines_and_marks_do_not_matter),
        cmocka_unit_test_setup_teardown(includes_are_relative_to_the_file_that_names_them, make_scratch,
                                        remove_scratch),
        cmocka_unit_test_setup_teardown(errors_name_the_included_file_and_keep_the_order, make_scratch, remove_scratch),
        cmocka_unit_test_setup_teardown(cycles_and_explosions_of_includes_are_refused, make_scratch, remove_scratch),
        cmocka_unit_test_setup_teardown(what_is_no_text_is_one_error, make_scratch, remove_scratch),
        cmocka_unit_test(a_file_that_cannot_be_read_is_an_error_without_place),
        cmocka_unit_test(without_callback_or_error_it_still_works),
    };
    return cmocka_run_group_tests_name("load", tests, NULL, NULL);
}
