/*
 * test_irradiance.c - the final gather of precomputed irradiance: the nearest point is that of
 * brute force, the picture is that of gathering, and what does not go with it is refused.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "lib/mode/photon_room.h"
#include "lib/photon/points.h"
#include "photon/gather.h"

enum { POINTS = 700, PLACES_MAX = 3000 };

/* ---- The nearest ---------------------------------------------------------------- */

/* Places on the six sides of a box; some face the wrong way, some lie where another does. */
static void fill_places(rt_photon *places, size_t count)
{
    points_stream stream = {29};
    memset(places, 0, count * sizeof *places);
    for (size_t i = 0; i < count; i++) {
        rt_photon *p = places + i;
        const int side = (int)(6 * points_uniform(&stream)), axis = side / 2;
        p->position[axis] = (float)(side % 2);
        p->position[(axis + 1) % 3] = points_uniform(&stream);
        p->position[(axis + 2) % 3] = points_uniform(&stream);
        p->normal[axis] = (side % 2) ^ (i % 16 == 3) ? -1.0f : 1.0f;
        if (i % 50 == 49)
            memcpy(p, p - 1, sizeof *p);
        for (int c = 0; c < 3; c++)
            p->flux[c] = (float)(1 + i % 50) + 0.25f * (float)c;
        p->shading = 1;
    }
}

/* On the floor, and above it; each 101st faces where there is no place. */
static void fill_points(rt_gather_point *points)
{
    points_stream stream = {31};
    memset(points, 0, POINTS * sizeof *points);
    for (size_t i = 0; i < POINTS; i++) {
        points[i].position[0] = points_uniform(&stream);
        points[i].position[1] = i % 3 ? 0 : 0.02f * points_uniform(&stream);
        points[i].position[2] = points_uniform(&stream);
        if (i % 101 == 50)
            points[i].normal[0] = points[i].normal[2] = 0.70710678f;
        else
            points[i].normal[1] = 1;
        points[i].weight[0] = points[i].weight[1] = points[i].weight[2] = 2;
        points[i].pixel = (rt_u32)i;
    }
}

static float squared_distance(const rt_photon *place, const rt_gather_point *point)
{
    float d[3];
    for (int c = 0; c < 3; c++)
        d[c] = point->position[c] - place->position[c];
    const float xx = d[0] * d[0], yy = d[1] * d[1], zz = d[2] * d[2], xy = xx + yy;
    return xy + zz;
}

static int is_accepted(const rt_photon *place, const rt_gather_point *point)
{
    float cosine = 0;
    for (int c = 0; c < 3; c++)
        cosine += place->normal[c] * point->normal[c];
    return cosine > RT_PHOTON_NORMAL_COSINE;
}

/* The point after two gathers has twice what the nearest place, or one as near, reflects. */
static void check_point(const rt_gather_point *point, const rt_gather_disc *disc,
                        const rt_photon *places, size_t count, float limit)
{
    float nearest = limit * limit;
    int is_one = 0;
    for (size_t i = 0; i < count; i++)
        if (is_accepted(places + i, point))
            nearest = fminf(nearest, squared_distance(places + i, point));
    const int is_found = nearest < limit * limit;
    assert_int_equal(disc->is_query, 1);
    assert_int_equal(disc->count, is_found);
    for (size_t i = 0; i < count && is_found; i++) {
        const float each = 2 * 2 / 3.14159265f * places[i].flux[1];
        is_one |= is_accepted(places + i, point) &&
                  squared_distance(places + i, point) == nearest &&
                  fabsf(point->radiance[1] - each) < 1e-5f * each;
    }
    if (is_found != is_one || (is_found && disc->squared_radius != nearest))
        fail_msg("%zu places, limit %g: found %g away, the nearest is %g away; radiance %g", count,
                 limit, sqrt(disc->squared_radius), sqrt(nearest), point->radiance[1]);
}

static void the_nearest_is_that_of_brute_force(void **state)
{
    static const size_t counts[] = {0, 1, 7, 8, 9, 65, 600, PLACES_MAX};
    static const float limits[] = {0.003f, 0.05f, 10};
    static rt_photon places[PLACES_MAX];
    static rt_gather_point points[POINTS];
    static rt_gather_disc discs[POINTS];
    const char *name = rt_gather_kernel_name(RT_SEARCH_IRRADIANCE, 0);
    cl_kernel kernel = NULL;
    rt_error error;
    (void)state;
    fill_places(places, PLACES_MAX);
    expect_ok(rt_device_kernel(test_device(), &kernel, name, name, NULL, &error), &error);
    for (size_t n = 0; n < sizeof counts / sizeof *counts; n++)
        for (size_t l = 0; l < sizeof limits / sizeof *limits; l++) {
            const rt_photon_list list = {
                .photons = places, .count = counts[n], .capacity = counts[n], .emitted = 1};
            const rt_gather_options how = {.max_radius = limits[l], .search = RT_SEARCH_IRRADIANCE};
            rt_gatherer *gatherer = NULL;
            fill_points(points);
            cl_mem buffer = test_buffer(sizeof points, points);
            expect_ok(
                rt_gatherer_create(&gatherer, test_device(), kernel, &list, &how, NULL, &error),
                &error);
            for (int time = 0; time < 2; time++)
                expect_ok(rt_gatherer_add(gatherer, buffer, 0, POINTS, discs, &error), &error);
            test_read(buffer, sizeof points, points);
            for (size_t i = 0; i < POINTS; i++)
                check_point(points + i, discs + i, places, counts[n], limits[l]);
            rt_gatherer_destroy(gatherer);
            rt_buffer_release(test_device(), buffer);
        }
    rt_kernel_release(kernel);
}

/* ---- Pictures ----------------------------------------------------------------------- */

static rt_render_options options_of(uint32_t step)
{
    rt_render_options options = room_options();
    options.final_gather = 1;
    options.photons = 40000;
    options.irradiance_step = step;
    return options;
}

static double mean_of(rt_renderer *renderer, const rt_render_options *options)
{
    const uint32_t values = 3 * options->width * options->height;
    rt_film *film = room_render(renderer, options);
    double sum = 0;
    for (uint32_t i = 0; i < values; i++)
        sum += rt_film_rgb(film)[i];
    rt_film_destroy(film);
    return sum / values;
}

/* The same light, by one map or two, whatever the step. */
static void the_picture_is_that_of_gathering(void **state)
{
    (void)state;
    rt_renderer *renderer = room_renderer(test_device());
    for (uint64_t caustics = 0; caustics <= 10000; caustics += 10000) {
        rt_render_options gather = options_of(0);
        gather.caustic_photons = caustics;
        const double expected = mean_of(renderer, &gather);
        for (uint32_t step = 1; step <= 16; step *= 4) {
            rt_render_options options = options_of(step);
            options.caustic_photons = caustics;
            assert_float_equal(mean_of(renderer, &options), expected, 0.01 * expected);
        }
    }
    rt_renderer_destroy(renderer);
}

/* A lamp of glass: all light on the walls is a caustic, or comes from one. */
static rt_renderer *lamp_renderer(void)
{
    static const char text[] =
        "camera { eye 0 1 3  look_at 0 1 0  fov 50 }\n"
        "material white { kd 0.6 }\nmaterial glass { kt 1  ior 1.5  fresnel dielectric }\n"
        "quad { corner -1 0 -1  edge1 0 0 2  edge2 2 0 0  material white }\n"
        "quad { corner -1 0 -1  edge1 2 0 0  edge2 0 2 0  material white }\n"
        "quad { corner -1 0 -1  edge1 0 2 0  edge2 0 0 2  material white }\n"
        "sphere { centre 0 1 0  radius 0.1  material glass }\n"
        "light point { position 0 1 0  power 1 }\n";
    const rt_load_options load = {0};
    rt_renderer *renderer = NULL;
    rt_scene *scene = NULL;
    rt_error error;
    expect_ok(rt_scene_parse(&scene, text, NULL, &load, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    rt_scene_destroy(scene);
    return renderer;
}

/* The irradiance is that of both maps, and caustics seen directly are gathered as ever. */
static void caustics_count_once(void **state)
{
    (void)state;
    rt_renderer *renderer = lamp_renderer();
    rt_render_options gather = options_of(0), irradiance = options_of(2);
    gather.caustic_photons = irradiance.caustic_photons = 40000;
    const double expected = mean_of(renderer, &gather);
    assert_float_equal(mean_of(renderer, &irradiance), expected, 0.02 * expected);
    rt_renderer_destroy(renderer);
}

/* With fewer photons than a step there is one point, and its irradiance is everywhere. */
static void few_photons_are_enough(void **state)
{
    (void)state;
    rt_renderer *renderer = room_renderer(test_device());
    rt_render_options options = options_of(1000000);
    options.photons = 100;
    assert_true(mean_of(renderer, &options) > 0);
    rt_renderer_destroy(renderer);
}

/* ---- Refusals --------------------------------------------------------------------------- */

static void expect_refused(rt_renderer *renderer, const rt_render_options *options,
                           const char *words)
{
    rt_film *film = NULL;
    rt_error error;
    assert_int_equal(rt_render(&film, renderer, options, &error), RT_ERROR_USAGE);
    assert_string_equal(error.field, "irradiance_step");
    if (!strstr(error.message, words))
        fail_msg("'%s' lacks '%s'", error.message, words);
    assert_null(film);
}

static void what_needs_the_photons_is_refused(void **state)
{
    rt_render_options passes = options_of(4), layers = options_of(4), ended = options_of(4);
    (void)state;
    rt_renderer *renderer = room_renderer(test_device());
    passes.passes = 3;
    layers.photon_layers = 1;
    expect_refused(renderer, &passes, "without passes");
    expect_refused(renderer, &layers, "without photon_layers");
    /* Without the final gather the step has no effect, and disturbs nothing. */
    ended.final_gather = 0;
    ended.passes = 2;
    rt_film_destroy(room_render(renderer, &ended));
    rt_renderer_destroy(renderer);
}

static void a_rough_lobe_is_refused_where_a_shape_has_it(void **state)
{
    static const char *const uses[] = {"flat", "rough"};
    (void)state;
    for (int i = 0; i < 2; i++) {
        const rt_load_options load = {0};
        rt_render_options options = options_of(4);
        rt_renderer *renderer = NULL;
        rt_scene *scene = NULL;
        rt_error error;
        char text[400];
        snprintf(text, sizeof text,
                 "camera { eye 0 1 3  look_at 0 0 0 }\n"
                 "material flat { kd 0.5 }\nmaterial rough { kd 0.5  roughness 0.4 }\n"
                 "quad { corner -1 0 -1  edge1 2 0 0  edge2 0 0 2  material %s }\n"
                 "light point { position 0 1 0  power 1 }\n",
                 uses[i]);
        expect_ok(rt_scene_parse(&scene, text, NULL, &load, &error), &error);
        expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
        if (i == 0)
            rt_film_destroy(room_render(renderer, &options));
        else
            expect_refused(renderer, &options, "roughness");
        rt_renderer_destroy(renderer);
        rt_scene_destroy(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_nearest_is_that_of_brute_force),
        cmocka_unit_test(the_picture_is_that_of_gathering),
        cmocka_unit_test(caustics_count_once),
        cmocka_unit_test(few_photons_are_enough),
        cmocka_unit_test(what_needs_the_photons_is_refused),
        cmocka_unit_test(a_rough_lobe_is_refused_where_a_shape_has_it),
    };
    return cmocka_run_group_tests_name("lib/mode/irradiance", tests, NULL, NULL);
}
