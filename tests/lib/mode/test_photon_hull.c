/*
 * test_photon_hull.c - the hull estimate through the whole pipeline, and its warning about Sobol
 * photons.
 *
 * A point light of intensity I stands the height h above a plane. Over a square of half the side a
 * below it, the mean irradiance is I times the square's solid angle, 4 asin(a^2 / (a^2 + h^2)),
 * over its area.
 */
#include "support.h"

#include <math.h>
#include <string.h>

enum { side = 32, renders = 8 };

#define FLOOR                                                                                      \
    "material grey { kd 0.5 }\n"                                                                   \
    "quad { corner -4 -4 0  edge1 8 0 0  edge2 0 8 0  material grey }\n"                           \
    "light point { position 0 0 1  intensity 1 }\n"                                                \
    "camera { projection orthographic  eye 0 0 0.9  look_at 0 0 0  up 0 1 0  width 1 }\n"          \
    "film { width 32  height 32 }\n"

static double mean_of(const rt_film *film)
{
    const float *rgb = rt_film_rgb(film);
    double sum = 0;
    for (int i = 0; i < 3 * side * side; i++)
        sum += rgb[i] / (3.0 * side * side);
    return sum;
}

static double exact(void)
{
    const double pi = 3.14159265358979323846, a = 0.5, h = 1;
    return 0.5 / pi * 4 * asin(a * a / (a * a + h * h)) / (4 * a * a);
}

/* With nothing else set, that is with the sampler sobol for the eye paths. */
static void the_mean_of_the_hull_is_right_with_the_default_sampler(void **state)
{
    rt_render_options options = {.mode = RT_MODE_PHOTON,
                                 .direct = RT_DIRECT_PHOTONS,
                                 .area = RT_AREA_HULL,
                                 .photons = 200000,
                                 .spp = 4,
                                 .k = 10};
    double sum = 0, squares = 0;
    (void)state;
    rt_renderer *renderer = test_renderer(FLOOR);
    options.width = options.height = side;
    for (uint32_t i = 0; i < renders; i++) {
        rt_film *film = NULL;
        rt_error error;
        options.seed = 5 + i;
        expect_ok(rt_render(&film, renderer, &options, &error), &error);
        double ratio = mean_of(film) / exact();
        sum += ratio;
        squares += ratio * ratio;
        rt_film_destroy(film);
    }
    double mean = sum / renders, sigma = sqrt((squares / renders - mean * mean) / (renders - 1));
    print_message("%.4f of the exact value, standard error %.4f\n", mean, sigma);
    assert_true(sigma < 0.01);
    assert_true(fabs(mean - 1) < 8 * sigma); /* Student's t with 7 degrees of freedom: below 1e-4 */
    rt_renderer_destroy(renderer);
}

static void count_even_photons(void *user, const char *line)
{
    *(int *)user += strstr(line, "more evenly than area hull supposes") != NULL;
}

/* A map made without the hull in mind warns of it; one emitted for it says how it was drawn. */
static void maps_of_even_photons_are_told(void **state)
{
    static const struct {
        rt_sampler sampler;
        rt_area emitted_for, asked;
        int warnings;
    } cases[] = {
        {RT_SAMPLER_SOBOL, RT_AREA_DISC, RT_AREA_HULL, 1},
        {RT_SAMPLER_SOBOL, RT_AREA_DISC, RT_AREA_DISC, 0},
        {RT_SAMPLER_SOBOL, RT_AREA_HULL, RT_AREA_HULL, 0},
        {RT_SAMPLER_INDEPENDENT, RT_AREA_DISC, RT_AREA_HULL, 0},
    };
    (void)state;
    rt_renderer *renderer = test_renderer(FLOOR);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        int warnings = 0;
        rt_hooks hooks = {.user = &warnings, .warning = count_even_photons};
        rt_render_options options = {
            .mode = RT_MODE_PHOTON, .direct = RT_DIRECT_PHOTONS, .photons = 1000, .spp = 1};
        rt_emit_options how = {.render = &options};
        rt_photon_map *map = NULL;
        rt_photon_map_info info;
        rt_film *film = NULL;
        rt_error error;
        options.sampler = cases[i].sampler;
        options.area = cases[i].emitted_for;
        expect_ok(rt_photon_map_emit(&map, renderer, &how, &error), &error);
        rt_photon_map_get_info(map, &info);
        assert_int_equal(info.sampler, cases[i].emitted_for == RT_AREA_HULL ? RT_SAMPLER_INDEPENDENT
                                                                            : options.sampler);
        options.width = options.height = side;
        options.area = cases[i].asked;
        options.photon_map = map;
        options.hooks = &hooks;
        expect_ok(rt_render(&film, renderer, &options, &error), &error);
        assert_int_equal(warnings, cases[i].warnings);
        rt_film_destroy(film);
        rt_photon_map_destroy(map);
    }
    rt_renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_mean_of_the_hull_is_right_with_the_default_sampler),
        cmocka_unit_test(maps_of_even_photons_are_told),
    };
    return cmocka_run_group_tests_name("lib/mode/photon_hull", tests, NULL, NULL);
}
