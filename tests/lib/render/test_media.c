/*
 * test_media.c - media that scatter: whole renders against closed forms, quadrature, and each
 * other.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/statistics.h"

enum { side = 16, pixels = side * side };

static const double pi = 3.14159265358979323846;
static const char *const channel[3] = {"red", "green", "blue"};

/* Renders a scene text into out[channel][pixel]. */
static void render(double out[3][pixels], const char *text, rt_render_options options)
{
    rt_renderer *renderer = test_renderer(text);
    rt_film *film = NULL;
    rt_film_stats stats;
    rt_error error;
    options.width = options.height = side;
    options.seed = test_seed(options.seed);
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    rt_film_get_stats(film, &stats);
    assert_int_equal(stats.rejected, 0);
    for (int i = 0; i < pixels; i++)
        for (int c = 0; c < 3; c++)
            out[c][i] = rt_film_rgb(film)[3 * i + c];
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
}

/* ---- Transmittance ----------------------------------------------------------------- */

#define ALONG_Z "camera { projection orthographic  width 1e-3  eye 0 0 0  look_at 0 0 9 }\n"
#define SLAB(z0, z1, material)                                                                     \
    "quad { corner -50 -50 " z0 "  edge1 0 100 0  edge2 100 0 0  material " material " }\n"        \
    "quad { corner -50 -50 " z1 "  edge1 100 0 0  edge2 0 100 0  material " material " }\n"
#define SMOKE                                                                                      \
    "material smoke { interface true  absorption 0.1 0.2 0.3  scattering 0.5 0.3 0.9  g 0.5 }\n"

/* Of two slabs that overlap, the one of higher priority fills the overlap. */
static void unscattered_light_is_what_extinction_leaves(void **state)
{
    static const double first[3] = {0.6, 0.5, 1.2}, second[3] = {0.2, 0.4, 0};
    double found[3][pixels];
    (void)state;
    render(found,
           ALONG_Z SMOKE
           "light environment { radiance 1 }\n"
           "material dust { interface true  absorption 0.1 0.3 0  scattering 0.1  "
           "priority 1 }\nmaterial air { interface true }\n" SLAB("1", "1.75", "smoke")
               SLAB("1.5", "2.5", "dust") SLAB("0.5", "3", "air"),
           (rt_render_options){.spp = 64, .max_depth = 1, .seed = 1});
    for (int c = 0; c < 3; c++)
        expect_mean(found[c], pixels, exp(-0.5 * first[c] - (c == 2 ? 0.1 : second[c]) * 1.0), 1e-4,
                    channel[c]);
}

/* ---- Single scattering --------------------------------------------------------------- */

static const double absorption[3] = {0.1, 0.2, 0.3}, scattering[3] = {0.5, 0.3, 0.9};

/* A medium of these coefficients from z0 to z1, and a point light of intensity 5. */
typedef struct lit_slab {
    double z0, z1, light[3];
} lit_slab;

/* How much of the line between two heights lies in the slab, as a part of it. */
static double part_inside(const lit_slab *s, double a, double b)
{
    const double lo = fmin(a, b), hi = fmax(a, b);
    return fmax(fmin(hi, s->z1) - fmax(lo, s->z0), 0) / (hi - lo);
}

/* What the height z of the z axis scatters towards the origin, a W/(m^3 sr). */
static double scattered(const lit_slab *s, double z, int c)
{
    const double g = 0.5, sigma = absorption[c] + scattering[c], dz = s->light[2] - z;
    const double d = sqrt(s->light[0] * s->light[0] + s->light[1] * s->light[1] + dz * dz);
    const double phase = (1 - g * g) / (4 * pi * pow(1 + g * g - 2 * g * dz / d, 1.5));
    const double depth = sigma * ((z - s->z0) + d * part_inside(s, z, s->light[2]));
    return scattering[c] * phase * 5 / (d * d) * exp(-depth);
}

/* Simpson's rule over the angle at the light, in which the integrand is smooth. */
static double single_scattering(const lit_slab *s, int c)
{
    const int steps = 4000;
    const double h = hypot(s->light[0], s->light[1]);
    const double from = atan((s->z0 - s->light[2]) / h),
                 to = atan((fmin(s->z1, 1e3) - s->light[2]) / h);
    double sum = 0;
    for (int i = 0; i <= steps; i++) {
        const double angle = from + (to - from) * i / steps;
        const double z = s->light[2] + h * tan(angle);
        const double weight = i == 0 || i == steps ? 1 : i % 2 ? 4 : 2;
        sum += weight * scattered(s, z, c) * h / (cos(angle) * cos(angle));
    }
    return sum * (to - from) / steps / 3;
}

static void expect_single_scattering(const char *text, const lit_slab *slab)
{
    double found[3][pixels];
    render(found, text, (rt_render_options){.spp = 64, .max_depth = 2, .seed = 2});
    for (int c = 0; c < 3; c++) {
        const double exact = single_scattering(slab, c);
        expect_mean(found[c], pixels, exact, 1e-4 * exact, channel[c]);
    }
}

static void fog_scatters_the_light_of_a_point(void **state)
{
    (void)state;
    expect_single_scattering(ALONG_Z
                             "medium { absorption 0.1 0.2 0.3  scattering 0.5 0.3 0.9  g 0.5 }\n"
                             "light point { position 0.3 0.4 2  intensity 5 }\n",
                             &(lit_slab){0, 1e9, {0.3, 0.4, 2}});
}

/* Shadow rays go through the boundary, whose medium attenuates its own part of the way. */
static void a_slab_scatters_the_light_of_a_point_outside(void **state)
{
    (void)state;
    expect_single_scattering(
        ALONG_Z SMOKE SLAB("1", "3", "smoke") "light point { position 0.3 0.4 0.5  intensity 5 }\n",
        &(lit_slab){1, 3, {0.3, 0.4, 0.5}});
}

/* ---- The white furnace ------------------------------------------------------------------ */

#define FURNACE                                                                                    \
    "camera { eye 0 0 -5  look_at 0 0 0  fov 20 }\nlight environment { radiance 1 }\n"             \
    "sphere { centre 0 0 0  radius 1  material body }\n"

/* What scatters all light and absorbs none cannot be seen where radiance is 1 everywhere. */
static void albedo_of_1_disappears_in_a_white_furnace(void **state)
{
    static const char *const bodies[] = {
        "material body { interface true  scattering 1 2 4  g 0.6 }\n" FURNACE,
        "material body { kt 1  fresnel dielectric  ior 1.5  scattering 1 2 4  g -0.4 }\n" FURNACE,
        "material body { interface true  scattering 1 }\n" FURNACE
        "material pane { kt 1  fresnel dielectric  scattering 3 1 0  priority 1 }\n"
        "sphere { centre 0.5 0 -0.5  radius 0.6  material pane }\n",
    };
    double found[3][pixels];
    (void)state;
    for (size_t i = 0; i < sizeof bodies / sizeof *bodies; i++) {
        render(found, bodies[i], (rt_render_options){.spp = 16, .max_depth = 1000, .seed = 3});
        for (int c = 0; c < 3; c++)
            expect_mean(found[c], pixels, 1, 1e-4, channel[c]);
    }
}

/* ---- Techniques agree --------------------------------------------------------------------- */

#define ROOM                                                                                       \
    "camera { eye 0 1 -4  look_at 0 0.6 0  fov 40 }\nmaterial grey { kd 0.6 }\n"                   \
    "plane { point 0 0 0  normal 0 1 0  material grey }\n"                                         \
    "quad { corner -0.4 1.6 -0.4  edge1 0.8 0 0  edge2 0 0 0.8  material grey  radiance 6 }\n"     \
    "sphere { centre 0.9 0.7 -0.3  radius 0.2  material grey  radiance 1 4 2 }\n"
#define FOG "medium { absorption 0.02 0.1 0  scattering 0.4 0.2 0.3  g 0.4 }\n"

static void expect_same_means(const char *a, rt_estimator with_a, const char *b,
                              rt_estimator with_b, const char *what)
{
    double of_a[3][pixels], of_b[3][pixels];
    render(of_a, a, (rt_render_options){.spp = 32, .max_depth = 4, .seed = 4, .estimator = with_a});
    render(of_b, b, (rt_render_options){.spp = 32, .max_depth = 4, .seed = 5, .estimator = with_b});
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < pixels; i++)
            of_a[c][i] -= of_b[c][i];
        expect_mean(of_a[c], pixels, 0, 0, what);
    }
}

static void light_sampling_and_the_phase_function_have_one_mean(void **state)
{
    (void)state;
    expect_same_means(ROOM FOG, RT_ESTIMATOR_MIS, ROOM FOG, RT_ESTIMATOR_LIGHT, "light");
    expect_same_means(ROOM FOG, RT_ESTIMATOR_MIS, ROOM FOG, RT_ESTIMATOR_BSDF, "bsdf");
}

/* An interface around nothing changes no light; one of vacuum in fog keeps it out. */
static void an_interface_is_not_seen(void **state)
{
    (void)state;
    expect_same_means(ROOM, RT_ESTIMATOR_MIS,
                      ROOM "material nothing { interface true }\n"
                           "box { centre 0 0.8 0  size 1.4 1 1.2  material nothing }\n",
                      RT_ESTIMATOR_MIS, "nothing");
    expect_same_means(ROOM FOG, RT_ESTIMATOR_MIS,
                      ROOM FOG "material same { interface true  absorption 0.02 0.1 0  "
                               "scattering 0.4 0.2 0.3  g 0.4 }\n"
                               "box { centre 0 0.8 0  size 1.4 1 1.2  material same }\n",
                      RT_ESTIMATOR_MIS, "same");
}

/* ---- What is refused ------------------------------------------------------------------------ */

static void modes_without_media_refuse_them(void **state)
{
    static const rt_mode modes[] = {RT_MODE_VCM, RT_MODE_DIRECT};
    rt_renderer *renderer = test_renderer(ROOM FOG);
    static const char *const names[] = {"mode vcm", "mode direct"};
    rt_film *film = NULL;
    rt_paths *paths = NULL;
    rt_error error;
    (void)state;
    for (int i = 0; i < 2; i++) {
        const rt_render_options options = {
            .mode = modes[i], .width = 4, .height = 4, .photons = 10, .spp = 1};
        assert_int_equal(rt_render(&film, renderer, &options, &error), RT_ERROR_USAGE);
        assert_string_equal(error.field, "mode");
        assert_non_null(strstr(error.message, names[i]));
        assert_non_null(strstr(error.message, "modes path and photon do"));
    }
    assert_int_equal(rt_paths_trace(&paths, renderer, NULL, 0, 0, 0, 1, &error), RT_ERROR_USAGE);
    rt_renderer_destroy(renderer);
}

static void first_hits_are_of_surfaces(void **state)
{
    double found[3][pixels];
    (void)state;
    render(found, ALONG_Z SMOKE SLAB("1", "3", "smoke") FOG,
           (rt_render_options){.mode = RT_MODE_DEPTH, .spp = 1});
    for (int i = 0; i < pixels; i++)
        assert_float_equal(found[0][i], 1, 1e-5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(unscattered_light_is_what_extinction_leaves),
        statistical_test(fog_scatters_the_light_of_a_point),
        statistical_test(a_slab_scatters_the_light_of_a_point_outside),
        statistical_test(albedo_of_1_disappears_in_a_white_furnace),
        statistical_test(light_sampling_and_the_phase_function_have_one_mean),
        statistical_test(an_interface_is_not_seen),
        cmocka_unit_test(modes_without_media_refuse_them),
        cmocka_unit_test(first_hits_are_of_surfaces),
    };
    return cmocka_run_group_tests_name("render/media", tests, NULL, NULL);
}
