/*
 * test_light_tree.c - choosing lights for a point: each with the probability that is returned, near
 * ones more often.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "light_draw.h"
#include "support.h"

enum { numbers = 1 << 20 };

static rt_error error;

/*
 * One of every kind of light: two delta lights near by, one infinitely far, an environment, and
 * shapes.
 */
static rt_scene *all_kinds(void)
{
    static const float corner[3] = {-1, 3, -1}, x[3] = {2, 0, 0}, z[3] = {0, 0, 2},
                       ball[3] = {5, 1, 0}, ring[3] = {-5, 1, 0}, up[3] = {0, 1, 0};
    static const float corners[3][3] = {{0, 0, 5}, {1, 0, 5}, {0, 1, 5}};
    static const uint32_t indices[3] = {0, 1, 2};
    const rt_point_light point = {.position = {0, 4, 0}, .intensity = {1, 2, 3}};
    const rt_spot_light spot = {.position = {2, 4, 0}, .target = {0, 0, 0}, .intensity = {3, 3, 3}};
    const rt_directional_light sun = {.direction = {0, -1, 0}, .irradiance = {1, 1, 1}};
    const rt_environment sky = {.radiance = {0.2f, 0.2f, 0.3f}};
    rt_surface emitter;
    memset(&emitter, 0, sizeof emitter);
    emitter.radiance[0] = emitter.radiance[1] = emitter.radiance[2] = 5;
    rt_scene *scene = light_scene();
    expect_ok(rt_scene_add_point_light(scene, &point, &error), &error);
    expect_ok(rt_scene_add_directional_light(scene, &sun, &error), &error);
    expect_ok(rt_scene_add_spot_light(scene, &spot, &error), &error);
    expect_ok(rt_scene_set_environment(scene, &sky, &error), &error);
    expect_ok(rt_scene_add_quad(scene, NULL, corner, z, x, &emitter, &error), &error);
    expect_ok(rt_scene_add_sphere(scene, NULL, ball, 0.5f, &emitter, &error), &error);
    expect_ok(rt_scene_add_torus(scene, NULL, ring, up, 0.5f, 0.1f, &emitter, &error), &error);
    expect_ok(
        rt_scene_add_triangles(scene, NULL, corners[0], 3, indices, 1, NULL, &emitter, &error),
        &error);
    return scene;
}

/*
 * count x count point lights of different powers, 1 m apart in the plane y = 1, scaled and moved in
 * all.
 */
static rt_scene *a_field(int count, float scale, float move)
{
    rt_scene *scene = light_scene();
    for (int i = 0; i < count * count; i++) {
        const float power = (float)(1 + i * 7 % 5);
        const rt_point_light light = {
            .position = {scale * (float)(i % count) + move, scale, scale * (float)(i / count)},
            .power = {power, power, power}};
        expect_ok(rt_scene_add_point_light(scene, &light, &error), &error);
    }
    return scene;
}

/*
 * Each light is chosen by its probability's share of evenly spaced numbers, and that probability is
 * returned.
 */
static void expect_chances(rt_scene *scene, size_t lights, const float from[3])
{
    float point[4] = {from[0], from[1], from[2], 0}, *chances = malloc(lights * sizeof *chances);
    float(*chosen)[2] = malloc(numbers * sizeof *chosen);
    size_t *times = calloc(lights, sizeof *times);
    uint32_t count = numbers;
    double sum = 0;
    rt_renderer *renderer = light_renderer(scene);
    cl_kernel kernel = test_kernel("light", "choose");
    cl_mem made = test_buffer(numbers * sizeof *chosen, NULL);
    rt_arg args[] = {RT_ARG(renderer->scene), RT_ARG(count), RT_ARG(point), RT_ARG(made)};
    assert_true(chances && chosen && times);
    test_run(kernel, args, 4, numbers);
    test_read(made, numbers * sizeof *chosen, chosen);
    light_chances(renderer, from, lights, chances);
    for (size_t i = 0; i < numbers; i++) {
        const size_t light = (size_t)chosen[i][0];
        assert_true(light < lights);
        assert_float_equal(chosen[i][1], chances[light], 1e-5 * chances[light]);
        times[light]++;
    }
    for (size_t i = 0; i < lights; i++) {
        assert_true(chances[i] > 0);
        assert_float_equal(times[i], chances[i] * numbers, 2 + 1e-5 * numbers * chances[i]);
        sum += chances[i];
    }
    assert_float_equal(sum, 1, 1e-5);
    free(chances);
    free(chosen);
    free(times);
    rt_buffer_release(test_device(), made);
    rt_kernel_release(kernel);
    rt_renderer_destroy(renderer);
}

static void lights_of_all_kinds_are_chosen_as_often_as_is_told(void **state)
{
    static const float points[][3] = {{0, 0, 0}, {0, 4, 0}, {5, 1, 0.51f}, {-400, 30, 1e4f}};
    (void)state;
    for (size_t i = 0; i < sizeof points / sizeof *points; i++)
        expect_chances(all_kinds(), 8, points[i]);
}

/* Of a number that is no power of two; one alone; all at one place; on every scale. */
static void any_number_of_lights_can_be_chosen_from(void **state)
{
    static const float scales[] = {1, 1e-12f, 1e10f};
    (void)state;
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        const float from[3] = {3.2f * scales[i], 0, 5.1f * scales[i]};
        expect_chances(a_field(11, scales[i], 0), 121, from);
        expect_chances(a_field(1, scales[i], 0), 1, from);
    }
    const float there[3] = {7, 0, 0};
    rt_scene *scene = a_field(1, 0, 7);
    for (int i = 0; i < 4; i++) {
        const rt_point_light light = {.position = {7, 0, 0}, .power = {1, 1, 1}};
        expect_ok(rt_scene_add_point_light(scene, &light, &error), &error);
    }
    expect_chances(scene, 5, there);
}

/* A black light is never chosen. */
static void lights_without_power_are_never_chosen(void **state)
{
    const rt_point_light black = {.position = {0, 1, 0}};
    float chances[5];
    const float from[3] = {0, 1, 0};
    (void)state;
    rt_scene *scene = a_field(2, 1, 0);
    expect_ok(rt_scene_add_point_light(scene, &black, &error), &error);
    rt_renderer *renderer = light_renderer(scene);
    light_chances(renderer, from, 5, chances);
    assert_true(chances[4] == 0);
    rt_renderer_destroy(renderer);

    scene = light_scene();
    expect_ok(rt_scene_add_point_light(scene, &black, &error), &error);
    renderer = light_renderer(scene);
    static light_draw draws[light_draws];
    draw_lights(renderer, 1, from, draws);
    for (int i = 0; i < light_draws; i++)
        assert_true(draws[i].radiance[0] == 0);
    rt_renderer_destroy(renderer);
}

/*
 * Under a large field, the lights within three metres, a tenth of all, bring most of the light and
 * get most choices.
 */
static void near_lights_are_chosen_more_often(void **state)
{
    enum { side = 20, lights = side * side };
    static float chances[lights];
    const float from[3] = {10.3f, 0, 9.6f};
    double near = 0, ideal = 0, all = 0;
    (void)state;
    rt_renderer *renderer = light_renderer(a_field(side, 1, 0));
    light_chances(renderer, from, lights, chances);
    for (int i = 0; i < lights; i++) {
        double x = i % side - from[0], z = i / side - from[2], d2 = x * x + z * z + 1;
        double brought = (1 + i * 7 % 5) / d2;
        near += d2 < 10 ? chances[i] : 0;
        ideal += d2 < 10 ? brought : 0;
        all += brought;
    }
    assert_true(ideal / all > 0.4);
    assert_true(near > 0.6 * ideal / all);
    rt_renderer_destroy(renderer);
}

/* Adds a quad of 0.2 m x 0.2 m, 3 m above the origin, that gives it 1 W/m^2. */
static void add_area_light(rt_scene *scene)
{
    static const float corner[3] = {-0.1f, 3, -0.1f}, x[3] = {0.2f, 0, 0}, z[3] = {0, 0, 0.2f};
    const rt_surface emitter = {.radiance = {225, 225, 225}};
    expect_ok(rt_scene_add_quad(scene, NULL, corner, x, z, &emitter, &error), &error);
}

/*
 * An area light, and one of another kind that gives the point below as much: each is chosen about
 * as often. By power an environment would be chosen four times as often, and a narrow spot hardly.
 */
static void lights_that_give_as_much_are_chosen_as_often(void **state)
{
    static const float pi = 3.14159265f, at[3] = {0, 3, 0}, down[3] = {0, -1, 0}, origin[3] = {0};
    const rt_point_light point = {.position = {0, 3, 0}, .intensity = {9, 9, 9}};
    const rt_spot_light spot = {
        .position = {0, 3, 0}, .intensity = {9, 9, 9}, .inner = 4, .outer = 5};
    const rt_directional_light sun = {.direction = {0, -1, 0}, .irradiance = {1, 1, 1}};
    const rt_environment sky = {.radiance = {1 / pi, 1 / pi, 1 / pi}};
    const float bright = 900 / pi;
    const rt_surface ball = {.radiance = {bright, bright, bright}};
    (void)state;
    for (int kind = 0; kind < 6; kind++) {
        float chances[2];
        rt_scene *scene = light_scene();
        add_area_light(scene);
        if (kind == 0)
            expect_ok(rt_scene_add_point_light(scene, &point, &error), &error);
        else if (kind == 1)
            expect_ok(rt_scene_add_spot_light(scene, &spot, &error), &error);
        else if (kind == 2)
            expect_ok(rt_scene_add_directional_light(scene, &sun, &error), &error);
        else if (kind == 3)
            expect_ok(rt_scene_set_environment(scene, &sky, &error), &error);
        else if (kind == 4)
            expect_ok(rt_scene_add_sphere(scene, NULL, at, 0.1f, &ball, &error), &error);
        else
            expect_ok(rt_scene_add_disc(scene, NULL, at, down, 0.1f, 0, &ball, &error), &error);
        rt_renderer *renderer = light_renderer(scene);
        light_chances(renderer, origin, 2, chances);
        assert_float_equal(chances[0], 0.5, 0.01);
        rt_renderer_destroy(renderer);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lights_of_all_kinds_are_chosen_as_often_as_is_told),
        cmocka_unit_test(any_number_of_lights_can_be_chosen_from),
        cmocka_unit_test(lights_without_power_are_never_chosen),
        cmocka_unit_test(near_lights_are_chosen_more_often),
        cmocka_unit_test(lights_that_give_as_much_are_chosen_as_often),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
