/*
 * test_gather.c - a gatherer adds to points the light that they reflect of the photons around them.
 */
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/photon/points.h"
#include "photon/gather.h"

#define PI 3.14159265358979323846

enum { photon_count = 2000, point_count = 300, emitted = 4 };

static rt_photon_list make_map(void)
{
    rt_photon_list map = {.photons = calloc(photon_count, sizeof *map.photons),
                          .count = photon_count,
                          .capacity = photon_count,
                          .emitted = emitted};
    points_stream stream = {5};
    assert_non_null(map.photons);
    for (size_t i = 0; i < map.count; i++) {
        rt_photon *p = map.photons + i;
        p->position[0] = points_uniform(&stream);
        p->position[2] = points_uniform(&stream);
        p->normal[1] = 1;
        p->shading = 0.5f + points_uniform(&stream);
        for (int c = 0; c < 3; c++)
            p->flux[c] = points_uniform(&stream);
    }
    return map;
}

static void make_points(rt_gather_point points[point_count])
{
    points_stream stream = {6};
    memset(points, 0, point_count * sizeof *points);
    for (size_t i = 0; i < point_count; i++) {
        points[i].position[0] = points_uniform(&stream);
        points[i].position[2] = points_uniform(&stream);
        points[i].normal[1] = 1;
        points[i].pixel = (rt_u32)(point_count - 1 - i);
        points[i].film_weight = 1;
        for (int c = 0; c < 3; c++) {
            points[i].weight[c] = i % 7 ? points_uniform(&stream) : 0;
            points[i].radiance[c] = points_uniform(&stream);
        }
    }
}

/*
 * Radiance by the definition, in float64, with an Epanechnikov kernel over all photons within the
 * radius.
 */
static void expected_radiance(double out[3], const rt_photon_list *map,
                              const rt_gather_point *point, double r)
{
    double sum[3] = {0};
    for (size_t i = 0; i < map->count; i++) {
        double x = map->photons[i].position[0] - point->position[0];
        double z = map->photons[i].position[2] - point->position[2], t2 = (x * x + z * z) / (r * r);
        for (int c = 0; c < 3 && t2 < 1; c++)
            sum[c] +=
                map->photons[i].flux[c] * map->photons[i].shading * 2 * (1 - t2) / (PI * r * r);
    }
    for (int c = 0; c < 3; c++)
        out[c] = point->radiance[c] + point->weight[c] / PI * sum[c] / emitted;
}

/* The program of each search. */
static const char *const programs[] = {"gather_neighbours", "gather_tree"};

/*
 * Gathers twice at the points behind `before` others, which are left alone; discs is what was
 * found.
 */
static void gather(const rt_photon_list *map, rt_gather_options options, size_t before,
                   rt_gather_point *points, rt_gather_disc *discs)
{
    size_t bytes = (before + point_count) * sizeof *points;
    const char *program = programs[options.search];
    rt_gatherer *gatherer = NULL;
    cl_kernel kernel = NULL;
    cl_mem buffer = test_buffer(bytes, points);
    rt_error error;

    expect_ok(rt_device_kernel(test_device(), &kernel, program, program, NULL, &error), &error);
    expect_ok(rt_gatherer_create(&gatherer, test_device(), kernel, map, &options, NULL, &error),
              &error);
    assert_true(rt_gatherer_capacity(gatherer) >= point_count);
    for (int time = 0; time < 2; time++)
        expect_ok(rt_gatherer_add(gatherer, buffer, before, point_count, discs, &error), &error);
    test_read(buffer, bytes, points);
    rt_gatherer_destroy(gatherer);
    rt_buffer_release(test_device(), buffer);
    rt_kernel_release(kernel);
}

static void check_reflection(rt_gather_options options)
{
    enum { before = 5 };
    static rt_gather_point points[before + point_count], asked[before + point_count];
    static rt_gather_disc discs[point_count];
    rt_photon_list map = make_map();

    make_points(asked + before);
    memcpy(points, asked, sizeof points);
    gather(&map, options, before, points, discs);
    assert_memory_equal(points, asked, before * sizeof *points);
    for (size_t i = 0; i < point_count; i++) {
        double expected[3];
        expected_radiance(expected, &map, asked + before + i, 0.1f);
        assert_int_equal(discs[i].is_query, i % 7 != 0);
        assert_true(discs[i].is_query == (discs[i].count > 0));
        for (int c = 0; c < 3; c++) {
            /* Twice the reflected light, as it was asked for twice. */
            double found = points[before + i].radiance[c] - asked[before + i].radiance[c];
            double wanted = 2 * (expected[c] - asked[before + i].radiance[c]);
            assert_float_equal(found, wanted, 1e-5 * (1 + wanted));
        }
    }
    rt_photon_list_clear(&map);
}

static void points_gain_what_they_reflect(void **state)
{
    (void)state;
    /* With k above the number of photons inside, all within 0.1 m count. */
    check_reflection(
        (rt_gather_options){1000, 0.1f, RT_DENSITY_EPANECHNIKOV, 1.1f, RT_AREA_DISC, 0, 0, NULL});
    check_reflection(
        (rt_gather_options){1000, 0.1f, RT_DENSITY_EPANECHNIKOV, 1.1f, RT_AREA_DISC, 1, 0, NULL});
    check_reflection(
        (rt_gather_options){0, 0.1f, RT_DENSITY_EPANECHNIKOV, 1.1f, RT_AREA_DISC, 1, 0, NULL});
}

static void both_searches_give_the_same_light(void **state)
{
    static const rt_gather_options options[] = {
        {50, 0, RT_DENSITY_GAUSSIAN, 1.1f, RT_AREA_DISC, 0, 0, NULL},
        {50, 0.03f, RT_DENSITY_CONE, 1.2f, RT_AREA_DISC, 0, 0, NULL},
        {5, 0, RT_DENSITY_SILVERMAN, 1.1f, RT_AREA_DISC, 0, 0, NULL},
        {500, 0, RT_DENSITY_BOX, 1.1f, RT_AREA_DISC, 0, 0, NULL}};
    static rt_gather_point host[point_count], device[point_count];
    static rt_gather_disc discs[point_count];
    rt_photon_list map = make_map();
    (void)state;
    for (size_t o = 0; o < sizeof options / sizeof *options; o++) {
        rt_gather_options on_device = options[o];
        on_device.search = RT_SEARCH_TREE;
        make_points(host);
        make_points(device);
        gather(&map, options[o], 0, host, discs);
        gather(&map, on_device, 0, device, discs);
        for (size_t i = 0; i < point_count; i++)
            for (int c = 0; c < 3; c++)
                assert_float_equal(host[i].radiance[c], device[i].radiance[c],
                                   1e-5 * (1 + host[i].radiance[c]));
    }
    rt_photon_list_clear(&map);
}

static void an_empty_map_leaves_the_radiance_alone(void **state)
{
    static rt_gather_point points[point_count], asked[point_count];
    static rt_gather_disc discs[point_count];
    rt_photon_list map = {0};
    (void)state;
    make_points(asked);
    for (int on_device = 0; on_device < 2; on_device++) {
        memcpy(points, asked, sizeof points);
        gather(
            &map,
            (rt_gather_options){50, 0, RT_DENSITY_GAUSSIAN, 1.1f, RT_AREA_DISC, on_device, 0, NULL},
            0, points, discs);
        assert_memory_equal(points, asked, sizeof points);
    }
}

/* FLANN where it is named and for the hull, else the faster tree. */
static void the_search_suits_the_settings(void **state)
{
    const rt_render_options nearest = {.k = 50, .caustic_k = 50},
                            hull = {.k = 50, .caustic_k = 50, .area = RT_AREA_HULL},
                            all = {.k = RT_K_ALL, .caustic_k = 50},
                            flann = {.k = 50, .caustic_k = 50, .gather = RT_GATHER_FLANN};
    (void)state;
    assert_int_equal(rt_photon_search_of(&nearest), RT_SEARCH_TREE);
    assert_int_equal(rt_photon_search_of(&hull), RT_SEARCH_NEIGHBOURS);
    assert_int_equal(rt_photon_search_of(&flann), RT_SEARCH_NEIGHBOURS);
    assert_int_equal(rt_photon_search_of(&all), RT_SEARCH_TREE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_search_suits_the_settings),
        cmocka_unit_test(points_gain_what_they_reflect),
        cmocka_unit_test(both_searches_give_the_same_light),
        cmocka_unit_test(an_empty_map_leaves_the_radiance_alone),
    };
    return cmocka_run_group_tests_name("lib/photon/gather", tests, NULL, NULL);
}
