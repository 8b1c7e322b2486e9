/*
 * test_path.c - path tracing against closed forms, and the same bits however samples are divided
 * into launches.
 */
#include "support.h"

#include "film/film.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render/renderer.h"
#include "statistics.h"
#include "types.h"

#define PI 3.14159265358979323846

enum { side = 24, pixels = side * side };

static const float origin[3] = {0, 0, 0};

static rt_scene *new_scene(void)
{
    rt_scene *scene = NULL;
    rt_error error;
    expect_ok(rt_scene_create(&scene, &error), &error);
    return scene;
}

static rt_surface add_material(rt_scene *scene, const rt_material *material)
{
    rt_surface surface = {0};
    rt_error error;
    expect_ok(rt_scene_add_material(scene, &surface.material, NULL, material, &error), &error);
    return surface;
}

static void add_sphere(rt_scene *scene, const float centre[3], float radius, rt_surface surface)
{
    rt_error error;
    expect_ok(rt_scene_add_sphere(scene, NULL, centre, radius, &surface, &error), &error);
}

static void add_quad(rt_scene *scene, const float corner[3], const float e1[3], const float e2[3],
                     rt_surface surface)
{
    rt_error error;
    expect_ok(rt_scene_add_quad(scene, NULL, corner, e1, e2, &surface, &error), &error);
}

static void aim_camera(rt_scene *scene, float x, float y, float z, float fov)
{
    rt_camera camera = {.eye = {x, y, z}, .look_at = {0, 0, 0}, .up = {0, 0, 1}, .fov = fov};
    rt_error error;
    expect_ok(rt_scene_set_camera(scene, &camera, &error), &error);
}

/* Renders and destroys the scene; the caller destroys the film. */
static rt_film *render(rt_scene *scene, uint32_t depth, uint32_t spp, rt_sampler sampler)
{
    rt_render_options options = {.width = side,
                                 .height = side,
                                 .spp = spp,
                                 .max_depth = depth,
                                 .seed = test_seed(1),
                                 .sampler = sampler};
    rt_renderer *renderer = NULL;
    rt_film *film = NULL;
    rt_film_stats stats;
    rt_error error;
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
    rt_film_get_stats(film, &stats);
    assert_int_equal(stats.rejected, 0);
    return film;
}

static double mean(const rt_film *film)
{
    const float *rgb = rt_film_rgb(film);
    double sum = 0;
    for (int i = 0; i < 3 * pixels; i++)
        sum += rgb[i];
    return sum / (3 * pixels);
}

/* Inside of a sphere of albedo a that emits 1 everywhere: each segment more adds a power of a. */
static void a_furnace_sums_the_series_of_its_albedo(void **state)
{
    static const rt_material wall = {
        .kd = {0.5f, 0.5f, 0.5f}, .emission = {1, 1, 1}, .two_sided = 1};
    static const uint32_t depths[] = {1, 2, 3, 6, 40};
    (void)state;
    for (size_t i = 0; i < sizeof depths / sizeof *depths; i++) {
        rt_scene *scene = new_scene();
        add_sphere(scene, origin, 10, add_material(scene, &wall));
        aim_camera(scene, 3, 2, 1, 90);
        rt_film *film = render(scene, depths[i], 64, RT_SAMPLER_SOBOL);
        /* 36864 paths whose sums deviate by less than 1 of each other: 5 standard errors. */
        expect_close(mean(film), (1 - pow(0.5, depths[i])) / 0.5, 5.0 / sqrt(64 * pixels),
                     "furnace");
        rt_film_destroy(film);
    }
}

/*
 * Solids that only reflect and refract, in a uniform environment of radiance 1 (white-furnace
 * test).
 */
static rt_scene *white_furnace(void)
{
    static const rt_material sky = {.emission = {1, 1, 1}, .two_sided = 1};
    rt_scene *scene = new_scene();
    add_sphere(scene, origin, 50, add_material(scene, &sky));
    aim_camera(scene, 4, 3, 2, 40);
    return scene;
}

/* What escapes within the depth is 1; what does not is less than the tolerance. */
static void expect_even(rt_scene *scene, double radiance)
{
    rt_film *film = render(scene, 200, 16, RT_SAMPLER_SOBOL);
    const float *rgb = rt_film_rgb(film);
    for (int i = 0; i < 3 * pixels; i++)
        assert_float_equal(rgb[i], radiance, 1e-3 * radiance);
    rt_film_destroy(film);
}

static void glass_disappears_in_a_white_furnace(void **state)
{
    static const rt_material glass = {.kt = {1, 1, 1}, .ior = 1.5f, .fresnel = 1},
                             plain = {.kt = {0.75f, 0.75f, 0.75f},
                                      .ks = {0.25f, 0.25f, 0.25f},
                                      .ior = 1.3f};
    (void)state;
    for (int fresnel = 0; fresnel < 2; fresnel++) {
        rt_scene *scene = white_furnace();
        add_sphere(scene, origin, 1.5f, add_material(scene, fresnel ? &glass : &plain));
        expect_even(scene, 1);
    }
}

static void nested_and_overlapping_solids_disappear_in_a_white_furnace(void **state)
{
    static const rt_material water = {.kt = {1, 1, 1}, .ior = 1.33f, .fresnel = 1},
                             glass = {.kt = {1, 1, 1}, .ior = 1.5f, .fresnel = 1, .priority = 1},
                             bubble = {.kt = {1, 1, 1}, .ior = 1, .fresnel = 1, .priority = 2};
    static const float aside[3] = {0.9f, 0.4f, 0};
    rt_scene *scene = white_furnace();
    (void)state;
    add_sphere(scene, origin, 1.5f, add_material(scene, &water));
    add_sphere(scene, aside, 1, add_material(scene, &glass));
    add_sphere(scene, aside, 0.4f, add_material(scene, &bubble));
    expect_even(scene, 1);
}

static void radiance_inside_glass_is_the_index_squared(void **state)
{
    static const rt_material glass = {.kt = {1, 1, 1}, .ior = 1.5f, .fresnel = 1};
    rt_scene *scene = white_furnace();
    (void)state;
    /* The camera sits near the centre, so that nothing is reflected totally. */
    add_sphere(scene, origin, 20, add_material(scene, &glass));
    expect_even(scene, 2.25);
}

static void mirrors_reflect_what_they_should(void **state)
{
    static const rt_material mirror = {.ks = {0.5f, 0.25f, 1}};
    static const float corner[3] = {-9, -9, 0}, x[3] = {18, 0, 0}, y[3] = {0, 18, 0};
    rt_scene *scene = white_furnace();
    (void)state;
    add_quad(scene, corner, x, y, add_material(scene, &mirror));
    rt_film *film = render(scene, 4, 16, RT_SAMPLER_SOBOL);
    const float *centre = rt_film_rgb(film) + 3 * (side / 2 * side + side / 2);
    for (int c = 0; c < 3; c++)
        assert_float_equal(centre[c], mirror.ks[c], 0.05);
    rt_film_destroy(film);
}

/* A white floor seen from so high that the film shows one square metre about the origin. */
static rt_scene *floor_seen_from_above(void)
{
    static const rt_material white = {.kd = {0.8f, 0.8f, 0.8f}};
    static const float corner[3] = {-50, -50, 0}, x[3] = {100, 0, 0}, y[3] = {0, 100, 0};
    rt_scene *scene = new_scene();
    rt_camera camera = {.eye = {0, 0, 20}, .up = {0, 1, 0}, .fov = 0.02f};
    rt_error error;
    add_quad(scene, corner, x, y, add_material(scene, &white));
    expect_ok(rt_scene_set_camera(scene, &camera, &error), &error);
    return scene;
}

static void a_point_light_lights_a_floor_by_the_inverse_square(void **state)
{
    rt_point_light light = {.position = {3, 0, 4}, .intensity = {10, 10, 10}};
    rt_scene *scene = floor_seen_from_above();
    rt_error error;
    (void)state;
    expect_ok(rt_scene_add_point_light(scene, &light, &error), &error);
    rt_film *film = render(scene, 2, 1, RT_SAMPLER_SOBOL);
    assert_float_equal(mean(film), 0.8 / PI * 10 / 25 * 4 / 5, 1e-4);
    rt_film_destroy(film);
}

/*
 * Form factor from a point to a parallel rectangle with a corner right above it (Howell's
 * catalogue, B-3).
 */
static double corner_factor(double a, double b, double height)
{
    double x = a / height, y = b / height, rx = sqrt(1 + x * x), ry = sqrt(1 + y * y);
    return (x / rx * atan(y / rx) + y / ry * atan(x / ry)) / (2 * PI);
}

static void a_rectangle_lights_a_floor_by_its_form_factor(void **state)
{
    static const rt_material emitter = {.emission = {2, 2, 2}};
    static const float heights[] = {0.3f, 2, 7};
    (void)state;
    for (int i = 0; i < 3; i++)
        for (int two = 1; two < 3; two++) {
            /*
             * From (1,1) to (-1,-1) downwards, and once more with light sampling alone able to end
             * the path.
             */
            float corner[3] = {-1, -1, heights[i]}, x[3] = {0, 2, 0}, y[3] = {2, 0, 0};
            rt_scene *scene = floor_seen_from_above();
            rt_camera beside = {
                .eye = {0, 3, 0.1f}, .look_at = {0, 0, 0}, .up = {0, 0, 1}, .fov = 0.02f};
            rt_error error;
            add_quad(scene, corner, x, y, add_material(scene, &emitter));
            expect_ok(rt_scene_set_camera(scene, &beside, &error), &error);
            rt_film *film = render(scene, 1 + (uint32_t)two, 256,
                                   two == 1 ? RT_SAMPLER_SOBOL : RT_SAMPLER_INDEPENDENT);
            expect_close(mean(film) / (0.8 * 2 * 4 * corner_factor(1, 1, heights[i])), 1, 5e-3,
                         "area light over a floor");
            rt_film_destroy(film);
        }
}

static void depth_counts_the_segments_from_the_eye(void **state)
{
    static const rt_material emitter = {.emission = {1, 1, 1}};
    static const float corner[3] = {-1, -1, 0}, x[3] = {2, 0, 0}, y[3] = {0, 2, 0},
                       high[3] = {-1, -1, 2};
    (void)state;
    /* The light itself takes one segment, the floor below it two. */
    rt_scene *scene = new_scene();
    rt_camera above = {.eye = {0, 0, 1}, .up = {0, 1, 0}, .fov = 20};
    rt_error error;
    add_quad(scene, corner, x, y, add_material(scene, &emitter));
    expect_ok(rt_scene_set_camera(scene, &above, &error), &error);
    rt_film *film = render(scene, 1, 1, RT_SAMPLER_SOBOL);
    assert_float_equal(mean(film), 1, 1e-6);
    rt_film_destroy(film);
    for (uint32_t depth = 1; depth < 3; depth++) {
        rt_surface down;
        scene = floor_seen_from_above();
        rt_camera beside = {.eye = {0, 3, 0.1f}, .up = {0, 0, 1}, .fov = 0.02f};
        down = add_material(scene, &emitter);
        add_quad(scene, high, y, x, down);
        expect_ok(rt_scene_set_camera(scene, &beside, &error), &error);
        film = render(scene, depth, 4, RT_SAMPLER_SOBOL);
        assert_true((mean(film) > 0.1) == (depth == 2));
        rt_film_destroy(film);
    }
}

/* An area light, a mirror, glass and diffuse spheres on a floor, all lengths times `scale`. */
static rt_scene *scaled_scene(float scale)
{
    static const rt_material materials[] = {{.kd = {0.7f, 0.6f, 0.5f}},
                                            {.ks = {0.9f, 0.9f, 0.9f}},
                                            {.kt = {1, 1, 1}, .ior = 1.5f, .fresnel = 1}};
    static const rt_material emitter = {.emission = {9, 9, 9}};
    rt_scene *scene = new_scene();
    float corner[3] = {-5 * scale, -5 * scale, 0}, x[3] = {10 * scale, 0, 0},
          y[3] = {0, 10 * scale, 0};
    float light_corner[3] = {-scale, -scale, 4 * scale}, light_x[3] = {0, 2 * scale, 0},
          light_y[3] = {2 * scale, 0, 0};
    add_quad(scene, corner, x, y, add_material(scene, materials));
    add_quad(scene, light_corner, light_x, light_y, add_material(scene, &emitter));
    for (int i = 0; i < 3; i++) {
        const float centre[3] = {(float)(i - 1) * 1.5f * scale, 0.5f * scale, 0.7f * scale};
        add_sphere(scene, centre, 0.7f * scale, add_material(scene, materials + i));
    }
    aim_camera(scene, 0, -6 * scale, 3 * scale, 50);
    return scene;
}

static void scale_does_not_matter(void **state)
{
    static const float scales[] = {1e-3f, 1e3f};
    (void)state;
    rt_film *metre = render(scaled_scene(1), 12, 256, RT_SAMPLER_SOBOL);
    for (int i = 0; i < 2; i++) {
        rt_film *film = render(scaled_scene(scales[i]), 12, 256, RT_SAMPLER_SOBOL);
        expect_close(mean(film) / mean(metre), 1, 1e-3, "scaled scene");
        rt_film_destroy(film);
    }
    rt_film_destroy(metre);
}

static void samplers_agree(void **state)
{
    (void)state;
    /* Caustics leave a standard error of 0.45 % of the mean in the difference. */
    rt_film *sobol = render(scaled_scene(1), 12, 1024, RT_SAMPLER_SOBOL);
    rt_film *independent = render(scaled_scene(1), 12, 1024, RT_SAMPLER_INDEPENDENT);
    expect_close(mean(sobol) / mean(independent), 1, 2e-2, "samplers");
    rt_film_destroy(sobol);
    rt_film_destroy(independent);
}

/*
 * Launches the kernel `launches` times, each with its share of 16 samples, `each` pixels a
 * work-item.
 */
static void launch_in_parts(rt_renderer *renderer, uint32_t launches, uint32_t group, uint32_t each,
                            rt_film_pixel *film)
{
    cl_kernel kernel = NULL;
    rt_error error;
    rt_render_options options = {.width = side, .height = side, .max_depth = 8, .seed = 3};
    rt_params params = rt_params_make(&options);
    const size_t bytes = pixels * sizeof *film;
    const uint32_t kept = test_device()->work_group;
    memset(film, 0, bytes);
    cl_mem buffer = test_buffer(bytes, film);
    expect_ok(rt_device_kernel(test_device(), &kernel, "path", "path", NULL, &error), &error);
    params.first_item = 0;
    params.item_count = pixels;
    params.pixels_an_item = each;
    params.sample_count = 16 / launches;
    test_device()->work_group = group;
    for (params.first_sample = 0; params.first_sample < 16;
         params.first_sample += params.sample_count) {
        /* All pixels have as many samples: their rates are not read. */
        rt_arg args[] = {RT_ARG(params), RT_ARG(renderer->scene), RT_ARG(buffer), RT_ARG(buffer)};
        test_run(kernel, args, 4, (pixels + each - 1) / each);
    }
    test_device()->work_group = kept;
    test_read(buffer, bytes, film);
    rt_buffer_release(test_device(), buffer);
    rt_kernel_release(kernel);
}

static void the_film_does_not_depend_on_how_samples_are_shared_out(void **state)
{
    static rt_film_pixel whole[pixels], parts[pixels];
    static const uint32_t groups[] = {1, 16, 64};
    rt_scene *scene = scaled_scene(1);
    rt_renderer *renderer = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    launch_in_parts(renderer, 1, 64, 64, whole);
    for (uint32_t launches = 2; launches <= 16; launches *= 2)
        for (size_t i = 0; i < sizeof groups / sizeof *groups; i++) {
            launch_in_parts(renderer, launches, groups[i], 64, parts);
            assert_memory_equal(whole, parts, sizeof whole);
        }
    static const uint32_t each[] = {1, 5, 8, 1000};
    for (size_t i = 0; i < sizeof each / sizeof *each; i++) {
        launch_in_parts(renderer, 1, 16, each[i], parts);
        assert_memory_equal(whole, parts, sizeof whole);
    }
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
}

static void every_pixel_has_one_item(void **state)
{
    /* The last is more than a layer of rows of work-items. */
    enum { LARGEST = 1500 * 1001 };
    static const uint32_t sizes[][2] = {{1, 1},  {8, 8},   {7, 9},    {64, 3},
                                        {3, 64}, {17, 31}, {100, 50}, {1500, 1001}};
    (void)state;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        static uint32_t out[LARGEST];
        static unsigned char seen[LARGEST];
        rt_params params;
        memset(&params, 0, sizeof params);
        params.width = sizes[i][0];
        params.height = sizes[i][1];
        params.item_count = params.width * params.height;
        cl_kernel kernel = test_kernel("film", "pixels");
        cl_mem buffer = test_buffer(sizeof out, NULL);
        rt_arg args[] = {RT_ARG(params), RT_ARG(buffer)};
        test_run(kernel, args, 2, params.item_count);
        test_read(buffer, sizeof out, out);
        memset(seen, 0, sizeof seen);
        for (uint32_t k = 0; k < params.item_count; k++) {
            assert_true(out[k] < params.item_count);
            assert_false(seen[out[k]]++);
        }
        rt_buffer_release(test_device(), buffer);
        rt_kernel_release(kernel);
    }
}

static void samples_that_are_not_finite_are_counted_and_left_out(void **state)
{
    const float red[] = {1, NAN, 2, INFINITY, -INFINITY, 4};
    const uint32_t count = sizeof red / sizeof *red;
    rt_film_pixel pixel;
    (void)state;
    memset(&pixel, 0, sizeof pixel);
    cl_mem samples = test_buffer(sizeof red, red), film = test_buffer(sizeof pixel, &pixel);
    cl_kernel kernel = test_kernel("film", "add");
    rt_arg args[] = {RT_ARG(samples), RT_ARG(count), RT_ARG(film)};
    test_run(kernel, args, 3, 1);
    test_read(film, sizeof pixel, &pixel);
    assert_true(pixel.count == 3 && pixel.bins >> RT_FILM_REJECTED == 3 && pixel.weight == 3);
    assert_true(rt_film_sum(&pixel, 0) == 7 && rt_film_sum(&pixel, 1) == 3);
    rt_buffer_release(test_device(), samples);
    rt_buffer_release(test_device(), film);
    rt_kernel_release(kernel);
}

/*
 * No photons are gathered at a point whose position is not finite: it must be rejected, not black.
 */
static void samples_that_gather_nowhere_are_rejected(void **state)
{
    const float places[][3] = {{1, 2, 3}, {NAN, 2, 3}, {1, INFINITY, 3}};
    enum { COUNT = 3, SPLIT = 2 };
    rt_gather_point points[COUNT * SPLIT] = {0};
    rt_film_pixel pixels[COUNT] = {0};
    rt_params params = {0};
    cl_uint stride = 0;
    cl_kernel kernel = NULL;
    rt_error error;
    (void)state;
    for (uint32_t i = 0; i < COUNT; i++) {
        memcpy(points[SPLIT * i].position, places[0], sizeof places[0]);
        memcpy(points[SPLIT * i + 1].position, places[i], sizeof places[i]);
        points[SPLIT * i].pixel = points[SPLIT * i + 1].pixel = i;
        points[SPLIT * i].film_weight = points[SPLIT * i + 1].film_weight = 1;
    }
    params.item_count = COUNT;
    params.split = SPLIT;
    cl_mem gathered = test_buffer(sizeof points, points), film = test_buffer(sizeof pixels, pixels);
    expect_ok(rt_device_kernel(test_device(), &kernel, "photon_film", "photon_film", NULL, &error),
              &error);
    rt_arg args[] = {RT_ARG(params), RT_ARG(gathered), RT_ARG(gathered), RT_ARG(stride),
                     RT_ARG(film)};
    test_run(kernel, args, 5, COUNT);
    test_read(film, sizeof pixels, pixels);
    for (uint32_t i = 0; i < COUNT; i++) {
        assert_int_equal(pixels[i].count, i == 0 ? 1 : 0);
        assert_int_equal(pixels[i].bins >> RT_FILM_REJECTED, i == 0 ? 0 : 1);
    }
    rt_buffer_release(test_device(), gathered);
    rt_buffer_release(test_device(), film);
    rt_kernel_release(kernel);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_that_are_not_finite_are_counted_and_left_out),
        cmocka_unit_test(samples_that_gather_nowhere_are_rejected),
        statistical_test(a_furnace_sums_the_series_of_its_albedo),
        cmocka_unit_test(glass_disappears_in_a_white_furnace),
        cmocka_unit_test(nested_and_overlapping_solids_disappear_in_a_white_furnace),
        cmocka_unit_test(radiance_inside_glass_is_the_index_squared),
        cmocka_unit_test(mirrors_reflect_what_they_should),
        cmocka_unit_test(a_point_light_lights_a_floor_by_the_inverse_square),
        statistical_test(a_rectangle_lights_a_floor_by_its_form_factor),
        cmocka_unit_test(depth_counts_the_segments_from_the_eye),
        statistical_test(scale_does_not_matter),
        statistical_test(samplers_agree),
        cmocka_unit_test(the_film_does_not_depend_on_how_samples_are_shared_out),
        cmocka_unit_test(every_pixel_has_one_item),
    };
    return cmocka_run_group_tests_name("kernels/path", tests, NULL, NULL);
}
