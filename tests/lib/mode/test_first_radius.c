/* test_first_radius.c - the radii that progressive passes begin with, where no radius is given. */
#include "support.h"

#include <math.h>
#include <string.h>

enum { side = 32 };

static rt_film *render_passes(const char *text, rt_render_options options)
{
    rt_film *film = NULL;
    rt_error error;
    options.mode = RT_MODE_PHOTON;
    options.width = options.height = side;
    rt_renderer *renderer = test_renderer(text);
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    rt_renderer_destroy(renderer);
    return film;
}

/* The mean over a square of pixels of one channel. */
static double mean_over(const float *values, int channels, int left, int top, int size)
{
    double sum = 0;
    for (int y = top; y < top + size; y++)
        for (int x = left; x < left + size; x++)
            sum += values[channels * (y * side + x)];
    return sum / (size * size);
}

/*
 * A floor of 4 m seen from above: dim all over, a hundred times as bright in a spot of about 0.5 m
 * in the middle.
 */
static const char spot[] =
    "camera { projection orthographic  eye 0 5 0  look_at 0 0 0  up 0 0 1  width 4 }\n"
    "material floor { kd 0.5 }\n"
    "quad { corner -2 0 -2  edge1 0 0 4  edge2 4 0 0  material floor }\n"
    "light spot { position 0 4 0  target 0 0 0  outer 4  inner 3  intensity 1600 }\n"
    "light point { position 0 4 0  intensity 16 }\n";

static void each_pixel_begins_with_its_own(void **state)
{
    rt_render_options options = {
        .passes = 2, .photons = 20000, .direct = RT_DIRECT_PHOTONS, .photon_layers = 1};
    (void)state;
    rt_film *film = render_passes(spot, options);
    const float *radius = rt_film_layer(film, "photon.radius", NULL);
    const double bright = mean_over(radius, 1, side / 2 - 1, side / 2 - 1, 2),
                 dim = mean_over(radius, 1, 2, 2, 4);
    print_message("radius %.4f m in the spot, %.4f m beside it\n", bright, dim);
    /* In proportion to one over the root of the density, but for the limit by the mean. */
    assert_true(bright > 0 && bright < 0.3 * dim);
    rt_film_destroy(film);

    options.radius = 0.2f;
    film = render_passes(spot, options);
    radius = rt_film_layer(film, "photon.radius", NULL);
    for (int i = 0; i < side * side; i++)
        assert_float_equal(radius[i], 0.2 * (1 + sqrt((1 + 2 / 3.0) / 2)) / 2, 1e-5);
    rt_film_destroy(film);
}

/*
 * All light comes through a pane that does not bend it; from the lone floor no path of the final
 * gather meets anything.
 */
static void caustics_are_seen_where_the_final_gather_sees_nothing(void **state)
{
    static const char pane[] =
        "camera { projection orthographic  eye 0 0.5 0  look_at 0 0 0  up 0 0 1  width 1 }\n"
        "material floor { kd 0.5 }\n"
        "material pane { kt 1  ior 1 }\n"
        "quad { corner -1 0 -1  edge1 0 0 2  edge2 2 0 0  material floor }\n"
        "quad { corner -1 1 -1  edge1 0 0 2  edge2 2 0 0  material pane }\n"
        "light point { position 0 2 0  intensity 8 }\n";
    rt_render_options options = {.passes = 4, .photons = 50000};
    (void)state;
    rt_film *plain = render_passes(pane, options);
    options.final_gather = 1;
    rt_film *gathered = render_passes(pane, options);
    const double expected = mean_over(rt_film_rgb(plain), 3, 0, 0, side);
    assert_true(expected > 0);
    assert_float_equal(mean_over(rt_film_rgb(gathered), 3, 0, 0, side), expected, 0.01 * expected);
    rt_film_destroy(plain);
    rt_film_destroy(gathered);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_pixel_begins_with_its_own),
        cmocka_unit_test(caustics_are_seen_where_the_final_gather_sees_nothing),
    };
    return cmocka_run_group_tests_name("lib/mode/first_radius", tests, NULL, NULL);
}
