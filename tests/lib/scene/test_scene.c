/* test_scene.c - what the builder calls accept, refuse and derive. */
#include "support.h"

#include <math.h>
#include <string.h>

#include "image/image.h"
#include "lib/image/scratch.h"
#include "lib/scene/scenes.h"
#include "light/lights.h"
#include "scene/scene.h"

static const float origin[3], up[3] = {0, 1, 0};

static void materials_that_gain_energy_are_refused(void **state)
{
    rt_scene *scene = new_scene();
    rt_error error;
    rt_material m = {.kd = {0.6f, 0, 0}, .ks = {0.3f, 0, 0}, .kt = {0.2f, 0, 0}};
    (void)state;

    expect_refused(rt_scene_add_material(scene, NULL, "m", &m, &error), &error, "kd");
    assert_non_null(strstr(error.message, "red"));
    m.kt[0] = 0.1f; /* exactly 1, but for the rounding of decimals */
    assert_int_equal(rt_scene_add_material(scene, NULL, "m", &m, &error), RT_OK);
    m.kd[1] = -0.1f;
    expect_refused(rt_scene_add_material(scene, NULL, "m", &m, &error), &error, "kd");
    m.kd[1] = NAN;
    expect_refused(rt_scene_add_material(scene, NULL, "m", &m, &error), &error, "kd");
    m.kd[1] = 0;
    m.ior = -1;
    expect_refused(rt_scene_add_material(scene, NULL, "m", &m, &error), &error, "ior");
    rt_scene_destroy(scene);
}

static void materials_out_of_range_are_refused(void **state)
{
    rt_scene *scene = new_scene();
    rt_error error;
    const struct {
        rt_material material;
        const char *field;
    } cases[] = {
        {{.roughness = 1.5f}, "roughness"},
        {{.ks = {1, 1, 1}, .exponent = 0.5f}, "exponent"},
        {{.ks = {1, 1, 1}, .exponent = 1e5f}, "exponent"},
        {{.kd = {1, 1, 1}, .exponent = 20}, "exponent"},
        {{.ks = {0.5f, 0, 0}, .kt = {0.5f, 0, 0}, .exponent = 20}, "kt"},
        {{.ks = {1, 1, 1}, .roughness = 0.1f, .exponent = 20}, "roughness"},
        {{.ks = {1, 1, 1}, .fresnel = RT_FRESNEL_DIELECTRIC, .exponent = 20}, "fresnel"},
        {{.interface = 1, .exponent = 20}, "exponent"},
        {{.absorption = {0, -1, 0}}, "absorption"},
        {{.scattering = {0, 0, -1}}, "scattering"},
        {{.scattering = {1, 1, 1}, .g = 1}, "g"},
        {{.interface = 1, .kd = {0.5f, 0, 0}}, "kd"},
        {{.interface = 1, .fresnel = RT_FRESNEL_DIELECTRIC}, "fresnel"},
        {{.fresnel = (rt_fresnel)7}, "fresnel"},
        {{.fresnel = RT_FRESNEL_CONDUCTOR, .ks = {1, 1, 1}}, "eta"},
        {{.metal = (rt_metal)99}, "metal"},
        {{.glass = (rt_glass)99}, "glass"},
        {{.metal = RT_METAL_GOLD, .glass = RT_GLASS_BK7}, "glass"},
        {{.metal = RT_METAL_GOLD, .fresnel = RT_FRESNEL_CONDUCTOR}, "fresnel"},
        {{.metal = RT_METAL_GOLD, .eta = {1, 0, 0}}, "eta"},
        {{.metal = RT_METAL_GOLD, .k = {1, 0, 0}}, "k"},
        {{.glass = RT_GLASS_BK7, .ior = 1.5f}, "ior"},
        {{.interface = 1, .glass = RT_GLASS_BK7}, "glass"},
        {{.fresnel = RT_FRESNEL_CONDUCTOR, .eta = {1, 1, 1}, .k = {-1, 0, 0}}, "k"},
        {{.fresnel = RT_FRESNEL_CONDUCTOR, .eta = {1, 1, 1}, .kt = {0.5f, 0, 0}}, "kt"},
        {{.kd_texture = 1}, "kd_texture"},
        {{.bump_texture = 1}, "bump_texture"},
        {{.bump_scale = NAN}, "bump_scale"},
        {{.priority = -1}, "priority"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        expect_refused(rt_scene_add_material(scene, NULL, NULL, &cases[i].material, &error), &error,
                       cases[i].field);
    rt_scene_destroy(scene);
}

static void principled_materials_out_of_range_are_refused(void **state)
{
    rt_scene *scene = new_scene();
    rt_error error;
    const struct {
        rt_material material;
        const char *field;
    } cases[] = {
        {{.base_color = {0.5f, 0.5f, 0.5f}, .metallic = 1.1f}, "metallic"},
        {{.base_color = {0.5f, 0.5f, 0.5f}, .kd = {0.5f, 0.5f, 0.5f}}, "kd"},
        {{.metallic = 1, .fresnel = RT_FRESNEL_DIELECTRIC}, "fresnel"},
        {{.sheen = 1, .coat = 1}, "coat"},
        {{.specular = 0.5f, .ior = 1.5f}, "specular"},
        {{.base_color = {0.5f, 0.5f, 0.5f}, .clearcoat = -0.1f}, "clearcoat"},
        {{.base_color = {0.5f, 0.5f, 0.5f}, .diff_trans = 1}, "diff_trans"},
        {{.base_color = {0.5f, 0.5f, 0.5f}, .diff_trans = 2.1f, .thin = 1}, "diff_trans"},
        {{.metallic = 0.5f, .thin = 1}, "metallic"},
        {{.base_color = {0.5f, 0.5f, 0.5f}, .spec_trans = 1, .opacity = 0.5f}, "opacity"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        expect_refused(rt_scene_add_material(scene, NULL, NULL, &cases[i].material, &error), &error,
                       cases[i].field);
    rt_scene_destroy(scene);
}

static void textures_count_in_the_balance_of_energy(void **state)
{
    rt_scene *scene = new_scene();
    rt_error error;
    uint32_t half, full;
    rt_texture halves = {.kind = RT_TEXTURE_CHECKER, .a = {0.5f, 0.5f, 0.5f}}, whole = halves,
               negative = halves;
    rt_surface surface = {0};
    (void)state;
    whole.a[1] = 1;
    negative.b[2] = -1;
    expect_refused(rt_scene_add_texture(scene, NULL, &negative, &error), &error, "b");
    expect_ok(rt_scene_add_texture(scene, &half, &halves, &error), &error);
    expect_ok(rt_scene_add_texture(scene, &full, &whole, &error), &error);
    assert_true(half == 1 && full == 2);

    /*
     * A texture alone stands for kd; 0.5 + 0.6 is too much, and so is what a shape's own texture
     * makes.
     */
    rt_material m = {.kd_texture = half, .ks = {0.6f, 0, 0}};
    expect_refused(rt_scene_add_material(scene, NULL, NULL, &m, &error), &error, "kd_texture");
    m.ks[0] = 0.4f;
    expect_ok(rt_scene_add_material(scene, &surface.material, NULL, &m, &error), &error);
    assert_true(scene->materials[surface.material].kd[2] == 1);
    surface.texture = 3;
    expect_refused(rt_scene_add_sphere(scene, NULL, origin, 1, &surface, &error), &error,
                   "texture");
    surface.texture = full;
    expect_ok(rt_scene_add_sphere(scene, NULL, origin, 1, &surface, &error), &error);
    rt_scene_destroy(scene);
}

/* What is too bright is named by the files that it is in. */
static void bright_images_are_named(void **state)
{
    static const float values[6] = {0.5f, 0.5f, 0.5f, 0.5f, 3, 0.5f};
    rt_scene *scene = new_scene();
    rt_image *image = NULL;
    rt_texture texture = {.path = "bright.pfm"}, pattern = {.kind = RT_TEXTURE_CHECKER};
    rt_material white = {.kd = {1, 1, 1}};
    uint32_t bright, checker, material;
    rt_error error;
    (void)state;
    expect_ok(rt_image_from_rgb(&image, values, 2, 1, &error), &error);
    expect_ok(rt_image_write(image, texture.path, NULL, &error), &error);
    rt_image_destroy(image);
    expect_ok(rt_scene_add_texture(scene, &bright, &texture, &error), &error);
    expect_ok(rt_scene_add_texture(scene, &checker, &pattern, &error), &error);
    const rt_material cases[] = {{.kd_texture = bright, .ks_texture = checker},
                                 {.ks_texture = bright, .kt_texture = bright}};
    const char *const messages[] = {
        "kd + ks + kt is 3 in green where the textures are brightest (bright.pfm); it must",
        "kd + ks + kt is 6 in green where the textures are brightest (bright.pfm, bright.pfm);"};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        expect_refused(rt_scene_add_material(scene, NULL, "m", &cases[i], &error), &error,
                       i == 0 ? "kd_texture" : "ks_texture");
        assert_non_null(strstr(error.message, messages[i]));
    }
    expect_ok(rt_scene_add_material(scene, &material, NULL, &white, &error), &error);
    const rt_surface surface = {.material = material, .texture = bright};
    const float centre[3] = {0};
    expect_refused(rt_scene_add_sphere(scene, NULL, centre, 1, &surface, &error), &error,
                   "texture");
    assert_non_null(strstr(error.message, "(bright.pfm)"));
    rt_scene_destroy(scene);
}

/* The least and largest values that textures in each other may have, and who is told of them. */
static void nested_textures_are_bounded(void **state)
{
    static const float values[6] = {-0.5f, 0.25f, 0.25f, 0.5f, 2, 0.5f};
    rt_scene *scene = new_scene();
    rt_image *image = NULL;
    rt_texture heights = {.path = "nest.pfm"},
               product = {.kind = RT_TEXTURE_MULTIPLY, .b = {2, 1, 0.25f}},
               mixture = {.kind = RT_TEXTURE_MIX, .a = {1.5f, 0, 0}}, square = mixture,
               bright = {.kind = RT_TEXTURE_MULTIPLY};
    rt_error error;
    (void)state;
    expect_ok(rt_image_from_rgb(&image, values, 2, 1, &error), &error);
    expect_ok(rt_image_write(image, heights.path, NULL, &error), &error);
    rt_image_destroy(image);
    expect_ok(rt_scene_add_texture(scene, &product.a_texture, &heights, &error), &error);
    expect_ok(rt_scene_add_texture(scene, &mixture.b_texture, &product, &error), &error);
    expect_ok(rt_scene_add_texture(scene, NULL, &mixture, &error), &error);
    square.kind = RT_TEXTURE_MULTIPLY;
    square.a[0] = 0;
    square.a_texture = square.b_texture = product.a_texture;
    expect_ok(rt_scene_add_texture(scene, NULL, &square, &error), &error);
    const rt_scene_texture *t = scene->textures;
    assert_true(t[1].least == -1 && t[1].largest[0] == 1 && t[1].largest[1] == 2 &&
                t[1].largest[2] == 0.125f && t[1].levels == 2);
    assert_true(t[2].least == -1 && t[2].largest[0] == 1.5f && t[2].largest[1] == 2);
    assert_true(t[2].mean[0] == 0.75f && t[2].mean[1] == 0.5f * 1.125f);
    assert_true(t[3].largest[1] == 4 && t[3].least == -1);
    const rt_material coloured = {.kd_texture = 3}, bumpy = {.kd = {1, 1, 1}, .bump_texture = 3};
    expect_refused(rt_scene_add_material(scene, NULL, "m", &coloured, &error), &error,
                   "kd_texture");
    assert_non_null(strstr(error.message, "kd_texture, nest.pfm, has the value -0.5 at pixel (0, "
                                          "0) from the top left; only heights may be negative"));
    expect_ok(rt_scene_add_material(scene, NULL, "m", &bumpy, &error), &error);

    /* What is too bright is named by the file inside. */
    const float bright_values[3] = {3, 1, 1};
    rt_texture file = {.path = "bright.pfm"};
    rt_material shiny = {0};
    expect_ok(rt_image_from_rgb(&image, bright_values, 1, 1, &error), &error);
    expect_ok(rt_image_write(image, file.path, NULL, &error), &error);
    rt_image_destroy(image);
    expect_ok(rt_scene_add_texture(scene, &bright.a_texture, &file, &error), &error);
    bright.b[0] = 0.5f;
    expect_ok(rt_scene_add_texture(scene, &shiny.ks_texture, &bright, &error), &error);
    expect_refused(rt_scene_add_material(scene, NULL, "m", &shiny, &error), &error, "ks_texture");
    assert_non_null(strstr(error.message, "1.5 in red where the textures are brightest "
                                          "(bright.pfm)"));
    rt_scene_destroy(scene);
}

/* What is wrong about textures in each other is said of the member. */
static void nested_textures_are_checked(void **state)
{
    const rt_texture grey = {.kind = RT_TEXTURE_CONSTANT, .a = {1, 1, 1}, .b = {-1, -1, -1}},
                     bright = {.kind = RT_TEXTURE_CONSTANT, .a = {4, 1, 1}};
    static const struct {
        rt_texture texture;
        const char *field;
    } cases[] = {{{.kind = RT_TEXTURE_MULTIPLY, .b = {1, 1, 1}}, "a"},
                 {{.kind = RT_TEXTURE_MULTIPLY, .a_texture = 1}, "b"},
                 {{.kind = RT_TEXTURE_MULTIPLY, .a_texture = 1, .b = {1, NAN, 1}}, "b"},
                 {{.kind = RT_TEXTURE_MULTIPLY, .a = {-1, 1, 1}, .b = {1, 1, 1}}, "a"},
                 {{.kind = RT_TEXTURE_CHECKER, .a_texture = 3}, "a_texture"},
                 {{.kind = RT_TEXTURE_GRADIENT, .b_texture = 9}, "b_texture"},
                 {{.kind = RT_TEXTURE_MIX, .weight_texture = 3}, "weight_texture"},
                 {{.kind = RT_TEXTURE_MIX, .weight_texture = 2}, "weight_texture"},
                 {{.kind = RT_TEXTURE_MIX, .weight = 1.5f}, "weight"},
                 {{.kind = RT_TEXTURE_MIX, .weight = -0.5f}, "weight"},
                 {{.kind = RT_TEXTURE_MIX, .weight = NAN}, "weight"},
                 {{.kind = RT_TEXTURE_MIX, .rotate = NAN}, "rotate"},
                 {{.kind = (rt_texture_kind)6}, "kind"}};
    rt_scene *scene = new_scene();
    rt_error error;
    (void)state;
    expect_ok(rt_scene_add_texture(scene, NULL, &grey, &error), &error);
    expect_ok(rt_scene_add_texture(scene, NULL, &bright, &error), &error);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        expect_refused(rt_scene_add_texture(scene, NULL, &cases[i].texture, &error), &error,
                       cases[i].field);
    assert_true(scene->texture_count == 2 && scene->texture_row_count == 0);
    rt_scene_destroy(scene);
}

/* The largest that there are: 256 rows are taken, one more is refused. */
static void nested_textures_have_so_many_rows(void **state)
{
    rt_scene *scene = new_scene();
    rt_error error;
    uint32_t eight = 0, last = 0;
    (void)state;
    /* Each doubles: rows 1, then 2 n + 1. */
    rt_texture t = {.kind = RT_TEXTURE_CONSTANT, .a = {1, 1, 1}, .name = "leaf"};
    expect_ok(rt_scene_add_texture(scene, &last, &t, &error), &error);
    for (int i = 0; i < 7; i++) {
        t = (rt_texture){
            .kind = RT_TEXTURE_MULTIPLY, .a_texture = last, .b_texture = last, .name = "tree"};
        expect_ok(rt_scene_add_texture(scene, &last, &t, &error), &error);
        eight = i == 5 ? last : eight;
    }
    assert_int_equal(scene->textures[last - 1].data.rows, 255);
    /* 127 and 127 of the last but one, a product, and two scales: 257. */
    t = (rt_texture){.kind = RT_TEXTURE_MULTIPLY,
                     .a = {2, 2, 2},
                     .a_texture = eight,
                     .b_texture = eight,
                     .name = "tree"};
    expect_ok(rt_scene_add_texture(scene, &last, &t, &error), &error);
    assert_int_equal(scene->textures[last - 1].data.rows, 256);
    t.b[0] = 2;
    assert_int_equal(rt_scene_add_texture(scene, NULL, &t, &error), RT_ERROR_INPUT);
    assert_string_equal(error.message, "texture 'tree': more than 256 images, patterns and "
                                       "products lie inside of it");
    rt_scene_destroy(scene);
}

/* Textures and the environment take a layer; the message of a missing one has its field. */
static void layers_of_images_are_taken(void **state)
{
    static const char *const names[] = {"V.A.R", "V.A.G", "V.A.B", "V.Z.Z"};
    rt_scene *scene = new_scene();
    rt_image *image = NULL;
    rt_texture texture = {.path = "layers.exr"};
    rt_environment sky = {.path = "layers.exr", .layer = "V.Z"};
    rt_error error;
    (void)state;
    expect_ok(rt_image_create(&image, 2, 1, names, 4, &error), &error);
    for (int i = 0; i < 8; i++)
        image->data[i] = (float)(i % 4);
    expect_ok(rt_image_write(image, texture.path, NULL, &error), &error);
    rt_image_destroy(image);
    expect_refused(rt_scene_add_texture(scene, NULL, &texture, &error), &error, "path");
    assert_non_null(strstr(error.message, "choose a layer, such as V.A"));
    texture.layer = "V.B";
    expect_refused(rt_scene_add_texture(scene, NULL, &texture, &error), &error, "layer");
    texture.layer = "V.A";
    expect_ok(rt_scene_add_texture(scene, NULL, &texture, &error), &error);
    for (int c = 0; c < 3; c++)
        assert_true(scene->textures[0].mean[c] == (float)c);
    expect_ok(rt_scene_set_environment(scene, &sky, &error), &error);
    assert_true(scene->environment.mean[0] == 3 && scene->environment.mean[2] == 3);
    rt_scene_destroy(scene);
}

/* A sky of 2 x 1 pixels, (400, 200, 100) and (3, 2, 1): as they are, in linear light. */
static void radiance_pictures_are_linear_skies(void **state)
{
    static const char file[] = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n"
                               "\xc8\x64\x32\x89\x03\x02\x01\x88";
    rt_scene *scene = new_scene();
    const rt_environment sky = {.path = "sky.hdr"};
    rt_error error;
    (void)state;
    scratch_write_bytes("sky.hdr", file, sizeof file - 1);
    expect_ok(rt_scene_set_environment(scene, &sky, &error), &error);
    const float *texels = scene->environment.texels;
    assert_true(texels[0] == 400 && texels[1] == 200 && texels[2] == 100);
    assert_true(texels[4] == 3 && texels[5] == 2 && texels[6] == 1);
    rt_scene_destroy(scene);
}

/* Light cannot be negative; a height can. */
static void negative_texels_are_refused_as_colours(void **state)
{
    static const float values[18] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, -0.5f, 0, 0, 0};
    rt_scene *scene = new_scene();
    rt_image *image = NULL;
    rt_texture texture = {.path = "heights.pfm"};
    rt_surface surface = {0}, emitter = {.radiance = {1, 1, 1}};
    uint32_t heights;
    rt_error error;
    (void)state;
    expect_ok(rt_image_from_rgb(&image, values, 3, 2, &error), &error);
    expect_ok(rt_image_write(image, texture.path, NULL, &error), &error);
    rt_image_destroy(image);
    expect_ok(rt_scene_add_texture(scene, &heights, &texture, &error), &error);

    const struct {
        rt_material material;
        const char *field;
    } cases[] = {
        {{.kd_texture = heights}, "kd_texture"},
        {{.ks_texture = heights}, "ks_texture"},
        {{.kt_texture = heights}, "kt_texture"},
        {{.emission_texture = heights}, "emission_texture"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        expect_refused(rt_scene_add_material(scene, NULL, "m", &cases[i].material, &error), &error,
                       cases[i].field);
        assert_non_null(strstr(
            error.message, "heights.pfm, has the value -0.5 at pixel (1, 1) from the top left"));
    }
    surface.texture = emitter.texture = heights;
    expect_refused(rt_scene_add_sphere(scene, NULL, origin, 1, &surface, &error), &error,
                   "texture");
    expect_refused(rt_scene_add_sphere(scene, NULL, origin, 1, &emitter, &error), &error,
                   "texture");

    rt_material bumpy = {.kd = {0.5f, 0.5f, 0.5f}, .bump_texture = heights};
    expect_ok(rt_scene_add_material(scene, NULL, NULL, &bumpy, &error), &error);
    rt_scene_destroy(scene);
}

static void missing_files_are_refused(void **state)
{
    rt_scene *scene = new_scene();
    rt_error error;
    uint32_t out;
    rt_texture texture = {.path = "tests/no_such.png"}, nameless = {0};
    rt_environment sky = {.path = "tests/no_such.exr"};
    (void)state;
    expect_refused(rt_scene_add_texture(scene, &out, &texture, &error), &error, "path");
    expect_refused(rt_scene_add_texture(scene, &out, &nameless, &error), &error, "path");
    expect_refused(rt_scene_set_environment(scene, &sky, &error), &error, "path");
    expect_refused(
        rt_scene_load_mesh(scene, &out, "tests/no_such.ply", RT_SHADING_FILE, NULL, &error), &error,
        "path");
    expect_refused(rt_scene_load_mesh(scene, &out, "x", (rt_shading)9, NULL, &error), &error,
                   "shading");
    assert_int_equal(scene->light_count, 0);
    rt_scene_destroy(scene);
}

/* Few digits are enough; what is not a rotation, however mirrored and scaled, is refused. */
static void skies_are_turned_by_rotations_alone(void **state)
{
    static const struct {
        double m[3][4];
        int is_fine;
    } cases[] = {{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}, 1},
                 {{{-5, 0, 0, 0}, {0, 0, 5, 0}, {0, 5, 0, 0}}, 1},
                 {{{0.866, 0, 0.5, 0}, {0, 1, 0, 0}, {-0.5, 0, 0.866, 0}}, 1},
                 {{{1e-30, 0, 0, 0}, {0, 1e-30, 0, 0}, {0, 0, 1e-30, 0}}, 1},
                 {{{0.86, 0, 0.5, 0}, {0, 1, 0, 0}, {-0.5, 0, 0.86, 0}}, 0},
                 {{{1, 0.01, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}, 0},
                 {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 0}}, 0},
                 {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 3}}, 0},
                 {{{1, 0, 0, 0}, {0, NAN, 0, 0}, {0, 0, 1, 0}}, 0},
                 {{{1, 0, 0, 0}, {0, INFINITY, 0, 0}, {0, 0, 1, 0}}, 0}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        rt_scene *scene = new_scene();
        rt_environment sky = {.radiance = {1, 1, 1}};
        rt_error error;
        memcpy(sky.transform.m, cases[i].m, sizeof sky.transform.m);
        if (!cases[i].is_fine) {
            expect_refused(rt_scene_set_environment(scene, &sky, &error), &error, "transform");
            assert_int_equal(scene->light_count, 0);
        } else {
            expect_ok(rt_scene_set_environment(scene, &sky, &error), &error);
            for (int j = 0; j < 9; j++) {
                const float *x = scene->environment.axes[j / 3],
                            *y = scene->environment.axes[j % 3];
                const float dot = x[0] * y[0] + x[1] * y[1] + x[2] * y[2], unit = j % 4 == 0;
                assert_float_equal(dot, unit, 3e-7);
            }
        }
        rt_scene_destroy(scene);
    }
}

static void shapes_without_extent_are_refused(void **state)
{
    rt_scene *scene = new_scene();
    rt_surface surface = {0};
    rt_error error;
    static const float line[9] = {0, 0, 0, 1, 1, 1, 2, 2, 2}, nan_point[3] = {0, NAN, 0};
    static const uint32_t corners[3] = {0, 1, 2}, beyond[3] = {0, 1, 3};
    (void)state;

    expect_refused(rt_scene_add_sphere(scene, NULL, origin, 0, &surface, &error), &error, "radius");
    expect_refused(rt_scene_add_sphere(scene, NULL, origin, -1, &surface, &error), &error,
                   "radius");
    expect_refused(rt_scene_add_sphere(scene, NULL, origin, NAN, &surface, &error), &error,
                   "radius");
    expect_refused(rt_scene_add_sphere(scene, NULL, nan_point, 1, &surface, &error), &error,
                   "centre");
    expect_refused(rt_scene_add_plane(scene, NULL, origin, origin, &surface, &error), &error,
                   "normal");
    expect_refused(rt_scene_add_quad(scene, NULL, origin, up, up, &surface, &error), &error,
                   "edge2");
    expect_refused(rt_scene_add_triangles(scene, NULL, line, 3, corners, 1, NULL, &surface, &error),
                   &error, "positions");
    expect_refused(rt_scene_add_triangles(scene, NULL, line, 3, beyond, 1, NULL, &surface, &error),
                   &error, "indices");
    expect_refused(rt_scene_add_disc(scene, NULL, origin, origin, 1, 0, &surface, &error), &error,
                   "normal");
    expect_refused(rt_scene_add_disc(scene, NULL, origin, up, 1, 1, &surface, &error), &error,
                   "inner_radius");
    expect_refused(rt_scene_add_cylinder(scene, NULL, up, up, 1, 1, &surface, &error), &error, "b");
    expect_refused(rt_scene_add_cylinder(scene, NULL, origin, up, 0, 1, &surface, &error), &error,
                   "radius");
    expect_refused(rt_scene_add_cone(scene, NULL, up, up, 1, 0, 1, &surface, &error), &error,
                   "apex");
    expect_refused(rt_scene_add_cone(scene, NULL, origin, up, 1, 2, 1, &surface, &error), &error,
                   "apex_radius");
    expect_refused(rt_scene_add_ellipsoid(scene, NULL, origin, up, &surface, &error), &error,
                   "radii");
    expect_refused(rt_scene_add_torus(scene, NULL, origin, up, 1, 1, &surface, &error), &error,
                   "minor_radius");
    expect_refused(rt_scene_add_torus(scene, NULL, origin, origin, 1, 0.1f, &surface, &error),
                   &error, "axis");
    expect_refused(rt_scene_add_box(scene, NULL, origin, up, &surface, &error), &error, "size");
    expect_refused(rt_scene_add_instance(scene, NULL, 0, &surface, &error), &error, "mesh");
    surface.material = 1;
    expect_refused(rt_scene_add_sphere(scene, NULL, origin, 1, &surface, &error), &error,
                   "material");
    rt_scene_destroy(scene);
}

/* What would make squares or reciprocals that are no numbers of float32. */
static void sizes_beyond_float_are_refused_with_the_true_range(void **state)
{
    rt_scene *scene = new_scene();
    rt_surface surface = {0}, emitter = {.power = {1e10f, 0, 0}},
               dazzling = {.radiance = {1e29f, 0, 0}};
    rt_error error;
    static const float x[3] = {1e-14f, 0, 0}, y[3] = {0, 1e-17f, 0};
    static const float small[9] = {0, 0, 0, 1e-17f, 0, 0, 0, 1e-17f, 0};
    static const uint32_t corners[3] = {0, 1, 2};
    (void)state;

    expect_refused(rt_scene_add_sphere(scene, NULL, origin, 1e-19f, &surface, &error), &error,
                   "radius");
    assert_non_null(strstr(error.message, "between 1e-15 and 1e+15"));
    expect_refused(rt_scene_add_sphere(scene, NULL, origin, 2e15f, &surface, &error), &error,
                   "radius");
    expect_ok(rt_scene_add_sphere(scene, NULL, origin, 1e-15f, &surface, &error), &error);
    expect_refused(rt_scene_add_sphere(scene, NULL, origin, 1e-15f, &emitter, &error), &error,
                   "power");
    assert_non_null(strstr(error.message, "1e+28"));
    expect_refused(rt_scene_add_quad(scene, NULL, origin, x, y, &surface, &error), &error, "edge2");
    assert_non_null(strstr(error.message, "at least 1e-30"));
    expect_refused(
        rt_scene_add_triangles(scene, NULL, small, 3, corners, 1, NULL, &surface, &error), &error,
        "positions");
    assert_non_null(strstr(error.message, "at least 1e-30"));
    expect_refused(rt_scene_add_sphere(scene, NULL, origin, 1, &dazzling, &error), &error,
                   "radiance");
    assert_non_null(strstr(error.message, "between 0 and 1e+28"));
    rt_scene_destroy(scene);
}

static void infinite_planes_cannot_emit(void **state)
{
    rt_scene *scene = new_scene();
    rt_surface surface = {.radiance = {1, 1, 1}};
    rt_error error;
    (void)state;
    expect_refused(rt_scene_add_plane(scene, NULL, origin, up, &surface, &error), &error,
                   "radiance");
    rt_scene_destroy(scene);
}

static void cameras_that_see_nothing_are_refused(void **state)
{
    rt_scene *scene = new_scene();
    rt_error error;
    rt_camera c = {.eye = {0, 0, 1}, .look_at = {0, 0, 1}};
    (void)state;

    expect_refused(rt_scene_set_camera(scene, &c, &error), &error, "look_at");
    c.look_at[2] = 0;
    c.up[2] = 2;
    expect_refused(rt_scene_set_camera(scene, &c, &error), &error, "up");
    c.up[2] = 0;
    c.fov = 180;
    expect_refused(rt_scene_set_camera(scene, &c, &error), &error, "fov");
    c.fov = 60;
    c.aperture = -1;
    expect_refused(rt_scene_set_camera(scene, &c, &error), &error, "aperture");
    c.aperture = 2e15f;
    expect_refused(rt_scene_set_camera(scene, &c, &error), &error, "aperture");
    assert_non_null(strstr(error.message, "between 0 and 1e+15"));
    c.aperture = 0;
    static const float distances[] = {-1, 1e-38f, 5e-16f, 2e15f, NAN};
    for (size_t i = 0; i < sizeof distances / sizeof *distances; i++) {
        c.focal_distance = distances[i];
        expect_refused(rt_scene_set_camera(scene, &c, &error), &error, "focal_distance");
        assert_non_null(strstr(error.message, "between 1e-15 and 1e+15"));
    }
    c.focal_distance = 1e-15f;
    expect_ok(rt_scene_set_camera(scene, &c, &error), &error);
    c.focal_distance = 0;
    c.blades = 2;
    expect_refused(rt_scene_set_camera(scene, &c, &error), &error, "blades");
    c.blades = 5;
    c.kind = (rt_camera_kind)3;
    expect_refused(rt_scene_set_camera(scene, &c, &error), &error, "kind");
    c.kind = RT_CAMERA_ORTHOGRAPHIC;
    c.width = -1;
    expect_refused(rt_scene_set_camera(scene, &c, &error), &error, "width");
    c.width = 1;
    c.eye[2] = 0;
    c.look_at[2] = 1e-25f;
    expect_refused(rt_scene_set_camera(scene, &c, &error), &error, "look_at");
    rt_scene_destroy(scene);
}

static void lights_without_direction_or_cone_are_refused(void **state)
{
    rt_scene *scene = new_scene();
    rt_error error;
    rt_spot_light spot = {.intensity = {1, 1, 1}};
    rt_directional_light sun = {.irradiance = {1, 1, 1}};
    rt_environment sky = {.radiance = {1, 1, 1}};
    const rt_medium fog = {.scattering = {1, 1, 1}, .g = -1}, void_fog = {.absorption = {-1, 0, 0}};
    (void)state;

    expect_refused(rt_scene_set_medium(scene, &fog, &error), &error, "g");
    expect_refused(rt_scene_set_medium(scene, &void_fog, &error), &error, "absorption");
    expect_refused(rt_scene_add_spot_light(scene, &spot, &error), &error, "target");
    spot.target[1] = -1;
    spot.outer = 181;
    expect_refused(rt_scene_add_spot_light(scene, &spot, &error), &error, "outer");
    spot.outer = 20;
    spot.inner = 21;
    expect_refused(rt_scene_add_spot_light(scene, &spot, &error), &error, "inner");
    spot.inner = 20;
    spot.falloff = (rt_falloff)4;
    expect_refused(rt_scene_add_spot_light(scene, &spot, &error), &error, "falloff");
    expect_refused(rt_scene_add_directional_light(scene, &sun, &error), &error, "direction");
    expect_ok(rt_scene_set_environment(scene, &sky, &error), &error);
    expect_refused(rt_scene_set_environment(scene, &sky, &error), &error, "");
    rt_scene_destroy(scene);
}

/* Emitted power, W, of the only light of a scene. */
static float power_of_only_light(rt_scene *scene)
{
    rt_light_data light;
    rt_u32 first_prim[1] = {0}, first_light[1];
    assert_int_equal(rt_lights_count(scene), 1);
    rt_lights_fill(scene, first_prim, 3, &light, first_light);
    assert_true(light.pmf == 1 && light.cdf == 1);
    rt_scene_destroy(scene);
    return light.power;
}

static void power_of_a_point_light_is_four_pi_intensity(void **state)
{
    rt_error error;
    rt_point_light by_intensity = {.intensity = {1, 2, 3}}, by_power = {.power = {5, 5, 5}},
                   both = {.power = {1, 1, 1}};
    (void)state;

    rt_scene *scene = new_scene();
    expect_ok(rt_scene_add_point_light(scene, &by_intensity, &error), &error);
    assert_float_equal(power_of_only_light(scene), 4 * 3.14159265f * 2, 1e-5f);
    scene = new_scene();
    expect_ok(rt_scene_add_point_light(scene, &by_power, &error), &error);
    assert_float_equal(power_of_only_light(scene), 5, 1e-5f);
    scene = new_scene();
    both.intensity[0] = 1;
    expect_refused(rt_scene_add_point_light(scene, &both, &error), &error, "power");
    rt_scene_destroy(scene);
}

static void power_of_an_area_light_is_pi_radiance_area(void **state)
{
    static const float x[3] = {2, 0, 0}, z[3] = {0, 0, 3};
    rt_error error;
    rt_surface radiant = {.radiance = {1, 1, 1}}, powered = {.power = {7, 7, 7}};
    (void)state;

    rt_scene *scene = new_scene();
    expect_ok(rt_scene_add_quad(scene, NULL, origin, x, z, &radiant, &error), &error);
    assert_float_equal(power_of_only_light(scene), 3.14159265f * 6, 1e-4f);
    scene = new_scene();
    expect_ok(rt_scene_add_sphere(scene, NULL, origin, 2, &powered, &error), &error);
    assert_float_equal(power_of_only_light(scene), 7, 1e-5f);
}

static void power_of_distant_lights_is_what_meets_the_scene(void **state)
{
    const double pi = 3.14159265358979, disc = pi * 9;
    rt_error error;
    rt_spot_light spot = {.target = {0, -1, 0}, .intensity = {2, 2, 2}, .inner = 60, .outer = 60};
    rt_directional_light sun = {.direction = {0, -1, 0}, .irradiance = {1, 2, 3}};
    rt_environment sky = {.radiance = {0.5f, 0.5f, 0.5f}};
    (void)state;

    rt_scene *scene = new_scene();
    expect_ok(rt_scene_add_spot_light(scene, &spot, &error), &error);
    assert_float_equal(power_of_only_light(scene), 2 * pi * (1 - 0.5) * 2, 1e-3);
    spot.inner = 0;
    spot.outer = 90;
    spot.falloff = RT_FALLOFF_LINEAR;
    scene = new_scene();
    expect_ok(rt_scene_add_spot_light(scene, &spot, &error), &error);
    assert_float_equal(power_of_only_light(scene), 2 * pi * (1 - 2 / pi) * 2, 1e-4);
    for (int i = 0; i < 2; i++) {
        spot.falloff = i ? RT_FALLOFF_QUARTIC : RT_FALLOFF_SQUARE;
        scene = new_scene();
        expect_ok(rt_scene_add_spot_light(scene, &spot, &error), &error);
        assert_float_equal(power_of_only_light(scene), 2 * pi / (i ? 5 : 3) * 2, 1e-4);
    }
    scene = new_scene();
    expect_ok(rt_scene_add_directional_light(scene, &sun, &error), &error);
    assert_float_equal(power_of_only_light(scene), 2 * disc, 1e-4);
    scene = new_scene();
    expect_ok(rt_scene_set_environment(scene, &sky, &error), &error);
    assert_float_equal(power_of_only_light(scene), 0.5 * 4 * pi * disc, 1e-3);
}

static void lights_are_chosen_in_proportion_to_power(void **state)
{
    static const rt_u32 first_prim[1] = {0};
    rt_scene *scene = new_scene();
    rt_point_light dim = {.intensity = {1, 1, 1}}, bright = {.intensity = {3, 3, 3}}, off = {0};
    rt_light_data lights[3];
    rt_u32 first_light[1];
    rt_error error;
    (void)state;

    expect_ok(rt_scene_add_point_light(scene, &dim, &error), &error);
    expect_ok(rt_scene_add_point_light(scene, &bright, &error), &error);
    expect_ok(rt_scene_add_point_light(scene, &off, &error), &error);
    rt_lights_fill(scene, first_prim, 1, lights, first_light);
    assert_float_equal(lights[0].pmf, 0.25f, 1e-6f);
    assert_float_equal(lights[1].pmf, 0.75f, 1e-6f);
    assert_true(lights[1].cdf == 1 && lights[2].pmf == 0);
    rt_scene_destroy(scene);
}

static void options_out_of_range_are_refused(void **state)
{
    rt_scene *scene = new_scene();
    rt_error error;
    const struct {
        rt_render_options options;
        const char *field;
    } cases[] = {
        {{.k = 1}, "k"},
        {{.k = 4, .area = RT_AREA_HULL}, "k"},
        {{.caustic_k = 3, .area = RT_AREA_HULL}, "caustic_k"},
        {{.roulette_threshold = 1.5f}, "roulette_threshold"},
        {{.roulette_threshold = 1e-7f}, "roulette_threshold"},
        {{.cone_k = 0.5f}, "cone_k"},
        {{.cone_k = 1e7f}, "cone_k"},
        {{.radius = -1}, "radius"},
        {{.radius = 2e15f}, "radius"},
        {{.radius = 1e-20f}, "radius"},
        {{.spp = (1u << 24) + 1}, "spp"},
        {{.width = 100000}, "width"},
        {{.width = 65536, .height = 65536}, "height"},
        {{.time = NAN}, "time"},
        {{.photons = UINT64_C(1) << 40}, "photons"},
        {{.mode = (rt_mode)99}, "mode"},
        {{.filter = (rt_filter)99}, "filter"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_int_equal(rt_scene_set_options(scene, &cases[i].options, &error), RT_ERROR_USAGE);
        assert_string_equal(error.field, cases[i].field);
    }
    rt_scene_destroy(scene);
}

static void no_options_are_the_defaults(void **state)
{
    rt_scene *scene = new_scene();
    rt_render_options options = {.width = 7, .spp = 3}, defaults = {0};
    rt_error error;
    (void)state;
    expect_ok(rt_scene_set_options(scene, &options, &error), &error);
    expect_ok(rt_scene_set_options(scene, NULL, &error), &error);
    rt_scene_get_options(scene, &options);
    assert_memory_equal(&options, &defaults, sizeof options);
    rt_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(materials_that_gain_energy_are_refused),
        cmocka_unit_test(materials_out_of_range_are_refused),
        cmocka_unit_test(principled_materials_out_of_range_are_refused),
        cmocka_unit_test(textures_count_in_the_balance_of_energy),
        cmocka_unit_test(nested_textures_are_bounded),
        cmocka_unit_test(nested_textures_are_checked),
        cmocka_unit_test(nested_textures_have_so_many_rows),
        cmocka_unit_test_setup_teardown(bright_images_are_named, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(layers_of_images_are_taken, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(radiance_pictures_are_linear_skies, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(negative_texels_are_refused_as_colours, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test(missing_files_are_refused),
        cmocka_unit_test(lights_without_direction_or_cone_are_refused),
        cmocka_unit_test(power_of_distant_lights_is_what_meets_the_scene),
        cmocka_unit_test(skies_are_turned_by_rotations_alone),
        cmocka_unit_test(shapes_without_extent_are_refused),
        cmocka_unit_test(sizes_beyond_float_are_refused_with_the_true_range),
        cmocka_unit_test(infinite_planes_cannot_emit),
        cmocka_unit_test(cameras_that_see_nothing_are_refused),
        cmocka_unit_test(power_of_a_point_light_is_four_pi_intensity),
        cmocka_unit_test(power_of_an_area_light_is_pi_radiance_area),
        cmocka_unit_test(lights_are_chosen_in_proportion_to_power),
        cmocka_unit_test(options_out_of_range_are_refused),
        cmocka_unit_test(no_options_are_the_defaults),
    };
    return cmocka_run_group_tests_name("lib/scene", tests, NULL, NULL);
}
