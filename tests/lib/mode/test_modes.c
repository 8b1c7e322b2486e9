/*
 * test_modes.c - the modes that show the first hit, the layers beside a picture, and the filters,
 * on known scenes.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "image/image_file.h"
#include "lib/image/scratch.h"

enum { width = 16, height = 8, pixels = width * height };

static rt_error error;

/*
 * Seen along -z by parallel rays, 4 m wide: on the left half a quad at depth 3, tilted by 45
 * degrees about x, so that the depth goes from 2 at the bottom to 4 at the top; on the right the
 * sky.
 */
static rt_renderer *tilted(void)
{
    static const float corner[3] = {-2, -1, 1}, x[3] = {2, 0, 0}, y[3] = {0, 2, -2};
    static const rt_material m = {.kd = {0.5f, 0.3f, 0.1f}, .ks = {0.2f, 0.2f, 0.2f}};
    rt_camera camera = {
        .kind = RT_CAMERA_ORTHOGRAPHIC, .eye = {0, 0, 3}, .look_at = {0, 0, 0}, .width = 4};
    rt_environment sky = {.radiance = {1, 1, 1}};
    rt_scene *scene = NULL;
    rt_renderer *renderer = NULL;
    rt_surface surface;
    memset(&surface, 0, sizeof surface);
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_set_camera(scene, &camera, &error), &error);
    expect_ok(rt_scene_set_environment(scene, &sky, &error), &error);
    expect_ok(rt_scene_add_material(scene, &surface.material, NULL, &m, &error), &error);
    expect_ok(rt_scene_add_quad(scene, NULL, corner, x, y, &surface, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    rt_scene_destroy(scene);
    return renderer;
}

static rt_film *render(rt_mode mode, int aov, rt_filter filter)
{
    rt_render_options options = {.width = width,
                                 .height = height,
                                 .mode = mode,
                                 .spp = 64,
                                 .aov = aov,
                                 .filter = filter,
                                 .photons = 1000};
    rt_renderer *renderer = tilted();
    rt_film *film = NULL;
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    rt_renderer_destroy(renderer);
    return film;
}

/* The mean depth in a row of pixels, whose samples are stratified. */
static double depth_of_row(int y)
{
    return 4 - 2 * (y + 0.5) / height;
}

static void expect_layers(const rt_film *film)
{
    uint32_t channels = 0;
    const float *albedo = rt_film_layer(film, "albedo", &channels);
    assert_int_equal(channels, 3);
    const float *normal = rt_film_layer(film, "normal", &channels);
    assert_int_equal(channels, 3);
    const float *depth = rt_film_layer(film, "depth", &channels);
    assert_int_equal(channels, 1);
    assert_null(rt_film_layer(film, "colour", NULL));
    for (int i = 0; i < pixels; i++) {
        int hit = i % width < width / 2;
        for (int c = 0; c < 3; c++) {
            static const double colour[3] = {0.7, 0.5, 0.3}, n[3] = {0, 0.70710678, 0.70710678};
            assert_float_equal(albedo[3 * i + c], hit ? colour[c] : 0, 1e-6);
            assert_float_equal(normal[3 * i + c], hit ? n[c] : 0, 1e-6);
        }
        assert_float_equal(depth[i], hit ? depth_of_row(i / width) : 0, 1e-3);
    }
}

static void layers_are_those_of_the_first_hit(void **state)
{
    static const rt_mode modes[] = {RT_MODE_PATH, RT_MODE_PHOTON, RT_MODE_DIRECT};
    (void)state;
    for (int i = 0; i < 3; i++) {
        rt_film *film = render(modes[i], 1, RT_FILTER_BOX);
        expect_layers(film);
        rt_film_destroy(film);
        film = render(modes[i], 0, RT_FILTER_BOX);
        assert_null(rt_film_layer(film, "depth", NULL));
        rt_film_destroy(film);
    }
}

static void modes_show_their_layer(void **state)
{
    static const rt_mode modes[] = {RT_MODE_ALBEDO, RT_MODE_NORMALS, RT_MODE_DEPTH};
    (void)state;
    for (int m = 0; m < 3; m++) {
        rt_film *film = render(modes[m], 0, RT_FILTER_BOX);
        const float *rgb = rt_film_rgb(film);
        rt_film_stats stats;
        rt_film_get_stats(film, &stats);
        assert_int_equal(stats.spp, 64);
        expect_layers(film);
        for (int i = 0; i < 3 * pixels; i++) {
            const float *albedo = rt_film_layer(film, "albedo", NULL),
                        *normal = rt_film_layer(film, "normal", NULL),
                        *depth = rt_film_layer(film, "depth", NULL);
            int hit = i / 3 % width < width / 2;
            double shown = m == 0   ? albedo[i]
                           : m == 1 ? (hit ? (normal[i] + 1) / 2 : 0)
                                    : depth[i / 3];
            assert_float_equal(rgb[i], shown, 1e-6);
        }
        rt_film_destroy(film);
    }
}

static void layers_go_to_exr_by_their_names(void **state)
{
    static const char *const names[] = {"albedo.R", "albedo.G", "albedo.B", "normal.X",
                                        "normal.Y", "normal.Z", "depth.Z"};
    static const char *const layers[] = {"albedo", "albedo", "albedo", "normal",
                                         "normal", "normal", "depth"};
    rt_image *image = NULL;
    rt_film *film = render(RT_MODE_PATH, 1, RT_FILTER_BOX);
    (void)state;
    expect_ok(rt_film_write(film, "layers.exr", NULL, &error), &error);
    expect_ok(rt_film_write(film, "layers.pfm", NULL, &error), &error);
    expect_ok(rt_image_read(&image, "layers.exr", &error), &error);
    assert_int_equal(image->channel_count, 17);
    assert_string_equal(rt_image_attribute_value(image, "librt.mode"), "path");
    for (int k = 0; k < 7; k++) {
        uint32_t channel = rt_image_channel(image, names[k]), channels = 0;
        const float *layer = rt_film_layer(film, layers[k], &channels);
        assert_true(channel != RT_IMAGE_NO_CHANNEL);
        for (size_t i = 0; i < pixels; i++)
            assert_true(image->data[i * 17 + channel] ==
                        layer[i * channels + (size_t)k % 3 % channels]);
    }
    uint32_t red = rt_image_channel(image, "R");
    for (size_t i = 0; i < pixels; i++)
        assert_true(image->data[i * 17 + red] == rt_film_rgb(film)[3 * i]);
    rt_image_destroy(image);
    expect_ok(rt_image_read(&image, "layers.pfm", &error), &error);
    assert_int_equal(image->channel_count, 3);
    rt_image_destroy(image);
    rt_film_destroy(film);
}

/*
 * Emission and light scattered once: of a floor under an even sky, the path tracer's picture at
 * depth 2.
 */
static void direct_light_is_the_path_of_two_segments(void **state)
{
    rt_render_options options = {
        .width = width, .height = height, .mode = RT_MODE_DIRECT, .spp = 16, .max_depth = 9};
    rt_renderer *renderer = tilted();
    rt_film *direct = NULL, *path = NULL;
    (void)state;
    expect_ok(rt_render(&direct, renderer, &options, &error), &error);
    options.mode = RT_MODE_PATH;
    options.max_depth = 2;
    expect_ok(rt_render(&path, renderer, &options, &error), &error);
    for (int i = 0; i < 3 * pixels; i++)
        assert_float_equal(rt_film_rgb(direct)[i], rt_film_rgb(path)[i], 1e-6);
    rt_film_destroy(direct);
    rt_film_destroy(path);
    rt_renderer_destroy(renderer);
}

/* Away from the edge all is even: every filter leaves the albedo as it is. */
static void filters_keep_what_is_even(void **state)
{
    (void)state;
    for (int filter = RT_FILTER_BOX; filter <= RT_FILTER_MITCHELL; filter++) {
        rt_film *film = render(RT_MODE_ALBEDO, 0, (rt_filter)filter);
        for (int y = 3; y < height - 3; y++)
            for (int x = 3; x < width / 2 - 3; x++)
                assert_float_equal(rt_film_rgb(film)[3 * (y * width + x)], 0.7, 1e-6);
        rt_film_destroy(film);
    }
}

/*
 * Across the edge at x = 8 the coverage is the filter's integral beyond it; only wide filters reach
 * further pixels.
 */
static void filters_spread_an_edge(void **state)
{
    /*
     * Coverage of the pixels left of the edge, whose centre is half a pixel off: of the nearest and
     * the second.
     */
    static const double covered[][2] = {{1, 1}, {0.875, 1}};
    (void)state;
    for (int filter = RT_FILTER_BOX; filter <= RT_FILTER_TENT; filter++) {
        rt_film *film = render(RT_MODE_ALBEDO, 0, (rt_filter)filter);
        const float *row = rt_film_rgb(film) + 3 * (height / 2) * width;
        for (int k = 0; k < 2; k++) {
            assert_float_equal(row[3 * (width / 2 - 1 - k)] / 0.7, covered[filter][k], 0.02);
            assert_float_equal(row[3 * (width / 2 + k)] / 0.7, 1 - covered[filter][k], 0.02);
        }
        rt_film_destroy(film);
    }
    /* Mitchell's filter overshoots: 72 times its integral from -2 to 1/2 and to 3/2. */
    double half = 0.5 * (64 + 0.25 * (21 * 0.5 - 48)), far = 36 + 0.125 * (8 - 3.5);
    rt_film *film = render(RT_MODE_ALBEDO, 0, RT_FILTER_MITCHELL);
    double nearest = 0, second = 0;
    for (int y = 3; y < height - 3; y++) {
        nearest += rt_film_rgb(film)[3 * (y * width + width / 2 - 1)] / 0.7 / (height - 6);
        second += rt_film_rgb(film)[3 * (y * width + width / 2 - 2)] / 0.7 / (height - 6);
    }
    assert_float_equal(nearest, 0.5 + half / 72, 0.05);
    assert_float_equal(second, 0.5 + far / 72, 0.05);
    rt_film_destroy(film);
}

/* A tent of radius 2 reaches the second pixel from the edge, and one of its own radius does not. */
static void a_filter_radius_widens_an_edge(void **state)
{
    static const double covered[] = {1 - 0.75 * 0.75 / 2, 1 - 0.25 * 0.25 / 2};
    rt_render_options options = {.width = width,
                                 .height = height,
                                 .mode = RT_MODE_ALBEDO,
                                 .spp = 256,
                                 .filter = RT_FILTER_TENT,
                                 .filter_radius = 2};
    rt_renderer *renderer = tilted();
    rt_film *film = NULL;
    (void)state;
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    const float *row = rt_film_rgb(film) + 3 * (height / 2) * width;
    for (int k = 0; k < 2; k++) {
        assert_float_equal(row[3 * (width / 2 - 1 - k)] / 0.7, covered[k], 0.01);
        assert_float_equal(row[3 * (width / 2 + k)] / 0.7, 1 - covered[k], 0.01);
    }
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
}

/* ---- What path tracing leaves out --------------------------------------------- */

static void count_missing_caustics(void *user, const char *line)
{
    *(int *)user += strstr(line, "mirrors or glass); the modes photon and vcm show them") != NULL;
    *(int *)user += 10 * (strstr(line, "mode vcm shows them") != NULL);
    *(int *)user += 100 * (strstr(line, "glass) that are seen through such surfaces; ") != NULL);
}

static rt_techniques techniques;

/* How often a render of a ball above a floor warns that caustics are missing. */
static int warnings_of(const char *ball, const char *floor, const char *light, rt_mode mode,
                       uint32_t depth)
{
    int count = 0;
    rt_hooks hooks = {.user = &count, .warning = count_missing_caustics};
    rt_render_options options = {.width = 2,
                                 .height = 2,
                                 .spp = 1,
                                 .mode = mode,
                                 .techniques = techniques,
                                 .max_depth = depth,
                                 .photons = 10,
                                 .hooks = &hooks};
    rt_scene *scene = NULL;
    rt_renderer *renderer = NULL;
    rt_film *film = NULL;
    char text[1000];
    snprintf(text, sizeof text,
             "camera { eye 0 1 -4  look_at 0 1 0 }\nmaterial ball { %s }\nmaterial floor { %s }\n"
             "sphere { centre 0 2 0  radius 1  material ball }\n"
             "quad { corner -2 0 -2  edge1 0 0 4  edge2 4 0 0  material floor }\nlight %s\n",
             ball, floor, light);
    expect_ok(rt_scene_parse(&scene, text, "ball", NULL, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    /* It can be asked for, too. */
    assert_int_equal(rt_renderer_leaves_out(renderer, &options) != NULL, count > 0);
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
    return count;
}

static void caustics_that_path_tracing_leaves_out_are_told(void **state)
{
    static const char glass[] = "kt 1  fresnel dielectric", matte[] = "kd 0.5",
                      gloss[] = "ks 0.9  roughness 0.3",
                      point[] = "point { position 0 5 0  power 9 }",
                      spot[] = "spot { position 0 5 0  target 0 0 0  intensity 1 }",
                      sun[] = "directional { direction 0 -1 0  irradiance 1 }",
                      sky[] = "environment { radiance 1 }",
                      out[] = "point { position 0 5 0  power 0 }";
    (void)state;
    assert_int_equal(warnings_of(glass, matte, point, RT_MODE_PATH, 0), 1);
    assert_int_equal(warnings_of(glass, matte, spot, RT_MODE_PATH, 3), 1);
    assert_int_equal(warnings_of("ks 0.5  kd 0.2", matte, sun, RT_MODE_PATH, 0), 1);
    assert_int_equal(warnings_of("ks 0.5  roughness 0.0005", matte, sun, RT_MODE_PATH, 0), 1);

    assert_int_equal(warnings_of(glass, matte, point, RT_MODE_PATH, 2), 0);
    assert_int_equal(warnings_of(glass, matte, point, RT_MODE_PHOTON, 0), 0);
    assert_int_equal(warnings_of(glass, matte, point, RT_MODE_DIRECT, 0), 0);
    assert_int_equal(warnings_of(glass, matte, sky, RT_MODE_PATH, 0), 0);
    assert_int_equal(warnings_of(glass, matte, out, RT_MODE_PATH, 0), 0);
    assert_int_equal(warnings_of(glass, glass, point, RT_MODE_PATH, 0), 0);
    assert_int_equal(warnings_of(matte, matte, point, RT_MODE_PATH, 0), 0);
    assert_int_equal(warnings_of("ks 0.5  roughness 0.1", matte, point, RT_MODE_PATH, 0), 0);
    assert_int_equal(warnings_of(glass, gloss, point, RT_MODE_PATH, 0), 10);
    assert_int_equal(warnings_of(glass, gloss, point, RT_MODE_PHOTON, 0), 10);
    assert_int_equal(warnings_of(glass, gloss, sky, RT_MODE_PHOTON, 0), 0);
    assert_int_equal(warnings_of(glass, gloss, point, RT_MODE_VCM, 0), 0);
    techniques = RT_TECHNIQUES_BPT;
    assert_int_equal(warnings_of(glass, matte, point, RT_MODE_VCM, 0), 100);
    assert_int_equal(warnings_of(glass, matte, sky, RT_MODE_VCM, 0), 0);
    techniques = RT_TECHNIQUES_VCM;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(layers_are_those_of_the_first_hit),
        cmocka_unit_test(modes_show_their_layer),
        cmocka_unit_test(layers_go_to_exr_by_their_names),
        cmocka_unit_test(direct_light_is_the_path_of_two_segments),
        cmocka_unit_test(filters_keep_what_is_even),
        cmocka_unit_test(filters_spread_an_edge),
        cmocka_unit_test(a_filter_radius_widens_an_edge),
        cmocka_unit_test(caustics_that_path_tracing_leaves_out_are_told),
    };
    return cmocka_run_group_tests_name("lib/mode/modes", tests, scratch_enter, scratch_leave);
}
