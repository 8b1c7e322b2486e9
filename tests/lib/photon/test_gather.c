/* test_gather.c - a gatherer adds to the film what the photons around each point make of it. */
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/photon/points.h"
#include "photon/gather.h"

#define PI 3.14159265358979323846

enum { photon_count = 2000, point_count = 300 };

static const float kd[2][3] = {{0.9f, 0.5f, 0.1f}, {0.2f, 0.4f, 0.6f}};

/* A scene buffer of two diffuse materials. */
static cl_mem make_scene(void)
{
    struct {
        rt_scene_header header;
        rt_material_data materials[2];
    } scene;
    memset(&scene, 0, sizeof scene);
    scene.header.materials = sizeof scene.header / RT_SCENE_ROW;
    scene.header.material_count = 2;
    for (int i = 0; i < 2; i++)
        memcpy(scene.materials[i].kd, kd[i], sizeof kd[i]);
    return test_buffer(sizeof scene, &scene);
}

static rt_photon_map make_map(void)
{
    rt_photon_map map = {calloc(photon_count, sizeof *map.photons), photon_count, photon_count, photon_count, 0};
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
        points[i].material = i % 2;
        points[i].film_weight = 1;
        for (int c = 0; c < 3; c++) {
            points[i].weight[c] = i % 7 ? points_uniform(&stream) : 0;
            points[i].radiance[c] = points_uniform(&stream);
        }
    }
}

/* Radiance by the definition, in float64, with an Epanechnikov kernel over all photons within the radius. */
static void expected_radiance(double out[3], const rt_photon_map *map, const rt_gather_point *point, double r)
{
    double sum[3] = {0};
    for (size_t i = 0; i < map->count; i++) {
        double x = map->photons[i].position[0] - point->position[0];
        double z = map->photons[i].position[2] - point->position[2], t2 = (x * x + z * z) / (r * r);
        for (int c = 0; c < 3 && t2 < 1; c++)
            sum[c] += map->photons[i].flux[c] * map->photons[i].shading * 2 * (1 - t2) / (PI * r * r);
    }
    for (int c = 0; c < 3; c++)
        out[c] = point->radiance[c] + point->weight[c] / PI * sum[c];
}

static cl_kernel gather_kernel(void)
{
    rt_error error;
    cl_kernel kernel = NULL;
    expect_ok(rt_device_kernel(test_device(), &kernel, "photon_gather", "photon_gather", NULL, &error), &error);
    return kernel;
}

static void samples_are_radiance_plus_weighted_reflection(void **state)
{
    static rt_film_pixel film[point_count];
    static rt_gather_point points[point_count];
    const rt_gather_options options = {1000, 0.1f, RT_DENSITY_EPANECHNIKOV, 1.1f}; /* all within 0.1 m count */
    rt_photon_map map = make_map();
    rt_gatherer *gatherer = NULL;
    cl_kernel kernel = gather_kernel();
    cl_mem scene = make_scene(), pixels = test_buffer(sizeof film, film);
    uint64_t asked = 0;
    rt_error error;
    (void)state;

    make_points(points);
    expect_ok(rt_gatherer_create(&gatherer, test_device(), kernel, scene, &map, &options, &error), &error);
    assert_true(rt_gatherer_capacity(gatherer) >= point_count);
    expect_ok(rt_buffer_write(test_device(), rt_gatherer_points(gatherer), 0, sizeof points, points, &error), &error);
    for (int sample = 0; sample < 2; sample++)
        expect_ok(rt_gatherer_add(gatherer, point_count, pixels, &asked, &error), &error);
    test_read(pixels, sizeof film, film);

    for (size_t i = 0; i < point_count; i++) {
        const rt_film_pixel *pixel = film + points[i].pixel;
        double expected[3];
        expected_radiance(expected, &map, points + i, 0.1f);
        assert_true(pixel->weight == 2 && pixel->count == 2);
        for (int c = 0; c < 3; c++)
            assert_float_equal(pixel->sum[c] / 2, expected[c], 1e-5 * (1 + expected[c]));
    }
    assert_int_equal(asked, 2 * (point_count - (point_count + 6) / 7));
    rt_gatherer_destroy(gatherer);
    rt_photon_map_clear(&map);
    rt_buffer_release(scene);
    rt_buffer_release(pixels);
    rt_kernel_release(kernel);
}

static void an_empty_map_leaves_the_radiance_alone(void **state)
{
    static rt_film_pixel film[point_count];
    static rt_gather_point points[point_count];
    const rt_gather_options options = {50, 0, RT_DENSITY_GAUSSIAN, 1.1f};
    rt_photon_map map = {0};
    rt_gatherer *gatherer = NULL;
    cl_kernel kernel = gather_kernel();
    cl_mem scene = make_scene(), pixels = test_buffer(sizeof film, film);
    rt_error error;
    (void)state;

    make_points(points);
    expect_ok(rt_gatherer_create(&gatherer, test_device(), kernel, scene, &map, &options, &error), &error);
    expect_ok(rt_buffer_write(test_device(), rt_gatherer_points(gatherer), 0, sizeof points, points, &error), &error);
    expect_ok(rt_gatherer_add(gatherer, point_count, pixels, NULL, &error), &error);
    test_read(pixels, sizeof film, film);
    for (size_t i = 0; i < point_count; i++)
        for (int c = 0; c < 3; c++)
            assert_true(film[points[i].pixel].sum[c] == points[i].radiance[c]);
    rt_gatherer_destroy(gatherer);
    rt_buffer_release(scene);
    rt_buffer_release(pixels);
    rt_kernel_release(kernel);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_are_radiance_plus_weighted_reflection),
        cmocka_unit_test(an_empty_map_leaves_the_radiance_alone),
    };
    return cmocka_run_group_tests_name("lib/photon/gather", tests, NULL, NULL);
}
