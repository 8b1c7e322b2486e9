/*
 * test_table_lights.c - projectors, luminaires and spots with an image, against closed forms and in
 * all modes.
 */
#include "image/image_file.h"
#include "kernels/statistics.h"
#include "lib/image/scratch.h"
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "lib/photon/emitted.h"

static const double pi = 3.14159265358979323846;

static rt_error error;

/* ---- Files ----------------------------------------------------------------------- */

enum { width = 6, height = 4 };

static float texel(int x, int y, int channel)
{
    return channel == 0   ? 0.1f * (float)(x + 1)
           : channel == 1 ? 0.2f * (float)(y + 1)
                          : (float)((x + y) % 2);
}

static void write_image(const char *name)
{
    static const char *const names[] = {"R", "G", "B"};
    rt_image *image = NULL;
    expect_ok(rt_image_create(&image, width, height, names, 3, &error), &error);
    for (int i = 0; i < 3 * width * height; i++)
        image->data[i] = texel(i / 3 % width, i / 3 / width, i % 3);
    expect_ok(rt_image_write(image, name, NULL, &error), &error);
    rt_image_destroy(image);
}

static void write_text(const char *name, const char *text)
{
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

enum { side = 24 };

/* Of 24 x 24 pixels unless the options say more. */
static rt_film *render(const char *text, rt_render_options options)
{
    rt_renderer *renderer = test_renderer(text);
    rt_film *film = NULL;
    options.seed = test_seed(3);
    if (options.width == 0)
        options.width = options.height = side;
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    rt_renderer_destroy(renderer);
    return film;
}

/* ---- Projectors ------------------------------------------------------------------- */

/* A screen 3 m away, which the image covers and the camera sees pixel by texel. */
#define SCREEN                                                                                     \
    "camera { projection orthographic  eye 0 0 1  look_at 0 0 -1  width 6 }\n"                     \
    "material white { kd 1 }\n"                                                                    \
    "quad { corner -5 -5 -3  edge1 10 0 0  edge2 0 10 0  material white }\n"
#define PROJECTOR "position 0 0 0  target 0 0 -1  fov 90  file \"slide.pfm\"  filter nearest }\n"

/* Pixel by pixel, to single precision, times `factor`. */
static void expect_picture(const char *light, rt_render_options options,
                           double (*factor)(double x, double y))
{
    char text[1024];
    snprintf(text, sizeof text, SCREEN "%s", light);
    options.width = width;
    options.height = height;
    options.filter = RT_FILTER_BOX;
    rt_film *film = render(text, options);
    for (int i = 0; i < width * height; i++) {
        const double x = i % width - 2.5, y = 1.5 - i / width;
        for (int c = 0; c < 3; c++)
            assert_float_equal(rt_film_rgb(film)[3 * i + c],
                               texel(i % width, i / width, c) * factor(x, y), 2e-5);
    }
    rt_film_destroy(film);
}

/* 9 pi W/m^2 at 1 m is pi at 3 m, of which a white screen has the radiance 1. */
static double even(double x, double y)
{
    (void)x, (void)y;
    return 1;
}

static void a_screen_shows_the_image_to_the_texel(void **state)
{
    static const char light[] = "light projector { irradiance (9 * pi)  " PROJECTOR;
    (void)state;
    write_image("slide.pfm");
    expect_picture(light, (rt_render_options){.spp = 4}, even);
    expect_picture(light, (rt_render_options){.spp = 4, .mode = RT_MODE_DIRECT}, even);
    expect_picture(light, (rt_render_options){.spp = 4, .mode = RT_MODE_PHOTON, .photons = 1000},
                   even);
}

/* In the middle of a pixel: I cos^3 / (pi z^2), by an even subdivision of it. */
static double by_cosine(double x, double y)
{
    enum { steps = 16 };
    double sum = 0;
    for (int i = 0; i < steps * steps; i++) {
        const double u = (x + (i % steps + 0.5) / steps - 0.5) / 3,
                     v = (y + (double)(i / steps + 0.5) / steps - 0.5) / 3;
        sum += pow(1 + u * u + v * v, -1.5);
    }
    return sum / (steps * steps);
}

static void by_intensity_it_falls_by_the_cosine_cubed(void **state)
{
    char text[1024];
    (void)state;
    write_image("slide.pfm");
    snprintf(text, sizeof text, SCREEN "light projector { intensity (9 * pi)  " PROJECTOR);
    rt_film *film = render(
        text,
        (rt_render_options){.spp = 256, .width = width, .height = height, .filter = RT_FILTER_BOX});
    for (int i = 0; i < width * height; i++) {
        const double exact =
            texel(i % width, i / width, 0) * by_cosine(i % width - 2.5, 1.5 - (double)(i / width));
        assert_float_equal(rt_film_rgb(film)[3 * i] / exact, 1, 2e-3);
    }
    rt_film_destroy(film);
}

/* Bounds are several standard deviations of these renders; photons have some bias too. */
static void modes_agree_on_an_image(void **state)
{
    static const char scene[] =
        "camera { eye 0 1 4  look_at 0 0.5 0  fov 40 }\n"
        "material white { kd 0.7 }\nmaterial red { kd 0.8 0.2 0.1 }\n"
        "quad { corner -3 0 3  edge1 6 0 0  edge2 0 0 -5  material white }\n"
        "quad { corner -3 0 -2  edge1 6 0 0  edge2 0 4 0  material red }\n"
        "sphere { centre 0.6 0.5 -0.5  radius 0.5  material white }\n"
        "light projector { position -1.5 2 2.5  target 0 0.6 -0.5  irradiance 30  fov 40  file "
        "\"slide.pfm\"  up 0.3 1 0 }\n"
        "light spot { position 2 3 1  target 0 0 0  intensity 20  outer 30  inner 20  falloff "
        "linear  file \"slide.pfm\" }\n"
        "light goniometric { position 0 3 0  target 0.5 0 0.2  intensity 2  file \"slide.pfm\" }\n"
        "light goniometric { position -1 3 -1.2  target -1 0 -1.2  up 0 0 -1  file "
        "\"luminaire.ies\"  intensity 0.02 0.01 0.01 }\n";
    static const rt_render_options by[] = {
        {.spp = 256},
        {.spp = 256, .mode = RT_MODE_VCM},
        {.spp = 256, .mode = RT_MODE_VCM, .techniques = RT_TECHNIQUES_BPT},
        {.spp = 4,
         .mode = RT_MODE_PHOTON,
         .direct = RT_DIRECT_PHOTONS,
         .photons = 400000,
         .passes = 4,
         .k = 200}};
    double mean[4];
    (void)state;
    write_image("slide.pfm");
    write_text("luminaire.ies",
               "IESNA91\nTILT=NONE\n1 1000 1 4 3 1 1 0 0 0\n1 1 9\n"
               "0 30 60 90\n0 45 90\n900 700 200 0\n800 400 100 0\n600 600 600 0\n");
    for (int m = 0; m < 4; m++) {
        rt_film *film = render(scene, by[m]);
        mean[m] = 0;
        for (int i = 0; i < 3 * side * side; i++)
            mean[m] += rt_film_rgb(film)[i] / (3 * side * side);
        print_message("%g\n", mean[m]);
        rt_film_destroy(film);
    }
    for (int m = 1; m < 4; m++)
        expect_close(mean[m] / mean[0], 1, m == 3 ? 0.02 : 0.005, "mean of a mode over path's");
}

/* ---- Luminaires ------------------------------------------------------------------- */

/* 179 cd along the axis, half of that at 60 degrees, none at 90: 1, 1/2 and 0 W/sr. */
static void write_luminaire(void)
{
    write_text("luminaire.ies", "IESNA:LM-63-2002\n[TEST] by formula\nTILT=NONE\n"
                                "1 -1 4 3 1 1 2 0 0 0\n0.5 0.5 40\n0 60 90\n0\n179 89.5 0\n");
}

static double intensity_at(double angle)
{
    return angle < pi / 3 ? 1 - 0.5 * angle / (pi / 3) : 0.5 * (pi / 2 - angle) / (pi / 6);
}

/* 2 m above the floor, over the middle of what the camera sees. */
#define FLOOR                                                                                      \
    "camera { projection orthographic  eye 0 1 0  look_at 0 0 0  up 0 0 -1  width 4 }\n"           \
    "material grey { kd 0.5 }\n"                                                                   \
    "quad { corner -8 0 8  edge1 16 0 0  edge2 0 0 -16  material grey }\n"                         \
    "light goniometric { position 0 2 0  target 0 0 0  up 1 0 0  file \"luminaire.ies\" }\n"

/* I(angle) cos / d^2. */
static double illuminance(double x, double z)
{
    const double d = sqrt(x * x + z * z + 4);
    return intensity_at(acos(2 / d)) * 2 / (d * d * d);
}

static double mean_illuminance(void)
{
    enum { steps = 200 };
    double sum = 0;
    for (int i = 0; i < steps * steps; i++)
        sum += illuminance(4 * ((i % steps + 0.5) / steps - 0.5),
                           4 * ((double)(i / steps + 0.5) / steps - 0.5));
    return sum / (steps * steps);
}

/* The error of each is below a third of its bound, by renders with other seeds. */
static void a_floor_has_the_illuminance_of_a_luminaire(void **state)
{
    static const struct {
        rt_render_options options;
        double bound;
    } by[] = {{{.spp = 64}, 1e-3},
              {{.spp = 64, .mode = RT_MODE_DIRECT}, 1e-3},
              {{.spp = 64, .mode = RT_MODE_VCM}, 0.01},
              {{.spp = 64, .mode = RT_MODE_VCM, .techniques = RT_TECHNIQUES_BPT}, 0.01},
              {{.spp = 4,
                .mode = RT_MODE_PHOTON,
                .direct = RT_DIRECT_PHOTONS,
                .photons = 400000,
                .k = 400},
               0.03}};
    (void)state;
    write_luminaire();
    for (size_t m = 0; m < sizeof by / sizeof *by; m++) {
        rt_film *film = render(FLOOR, by[m].options);
        double sum = 0;
        for (int i = 0; i < 3 * side * side; i++)
            sum += rt_film_rgb(film)[i] / (3 * side * side);
        expect_close(sum * pi / 0.5 / mean_illuminance(), 1, by[m].bound, "illuminance");
        rt_film_destroy(film);
    }
}

static void photons_have_its_illuminance_and_flux(void **state)
{
    static const float at[2][3] = {{0.2f, 0, -0.1f}, {2, 0, 1}}, up[2][3] = {{0, 1, 0}, {0, 1, 0}};
    const rt_render_options options = {.direct = RT_DIRECT_PHOTONS,
                                       .photons = 400000,
                                       .k = RT_K_ALL,
                                       .radius = 0.1f,
                                       .seed = test_seed(5)};
    rt_photon_reading found[2];
    (void)state;
    write_luminaire();
    rt_renderer *renderer = test_renderer(FLOOR);
    rt_photon_map *map = emit_map(renderer, &(rt_emit_options){.render = &options});
    expect_ok(rt_photon_map_illuminance(found, map, at[0], up[0], 2, 3, &options, &error), &error);
    for (int i = 0; i < 2; i++)
        expect_close(found[i].irradiance[0] / illuminance(at[i][0], at[i][2]), 1, 0.15,
                     "illuminance of photons");
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_screen_shows_the_image_to_the_texel),
        cmocka_unit_test(by_intensity_it_falls_by_the_cosine_cubed),
        statistical_test(modes_agree_on_an_image),
        statistical_test(a_floor_has_the_illuminance_of_a_luminaire),
        statistical_test(photons_have_its_illuminance_and_flux),
    };
    /* Not as a fixture of the group, whose state would take the place of that of tests. */
    void *state = NULL;
    if (scratch_enter(&state) != 0)
        return 1;
    const int failed = cmocka_run_group_tests_name("lib/render/table_lights", tests, NULL, NULL);
    scratch_leave(&state);
    return failed;
}
