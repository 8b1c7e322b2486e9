/* test_light_shape.c - lights of every shape with a placement, and lights with textures. */
#include "light_draw.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "statistics.h"

#define PI 3.14159265358979323846

enum { n = light_draws };

static light_draw samples[n];
static emission_draw emissions[n];
static double values[n], directions[n];
static rt_ray rays[n];
static rt_hit hits[n];

static const float point[3] = {0.3f, 0.2f, -0.1f}, other[3] = {0.5f, 1.4f, 0.3f},
                   radii[3] = {0.5f, 0.2f, 0.8f};

enum { ELLIPSOID, DISC, CYLINDER, PIPE, CONE, FRUSTUM, TORUS, KINDS };

static const char *const names[KINDS] = {"ellipsoid", "disc",    "cylinder", "pipe",
                                         "cone",      "frustum", "torus"};

/* The shape as a lamp, turned and stretched. */
static rt_renderer *shape_light(int kind)
{
    rt_surface lamp;
    rt_scene *scene = light_scene();
    rt_error error;
    memset(&lamp, 0, sizeof lamp);
    lamp.radiance[0] = lamp.radiance[1] = lamp.radiance[2] = 2;
    lamp.transform =
        (rt_transform){{{1.2f, 0.1f, 0, 0.3f}, {-0.2f, 0.8f, 0.3f, 0.1f}, {0, -0.2f, 1.1f, 0}}};
    rt_status status =
        kind == ELLIPSOID ? rt_scene_add_ellipsoid(scene, NULL, point, radii, &lamp, &error)
        : kind == DISC    ? rt_scene_add_disc(scene, NULL, point, other, 0.7f, 0.3f, &lamp, &error)
        : kind == TORUS   ? rt_scene_add_torus(scene, NULL, point, other, 0.6f, 0.2f, &lamp, &error)
        : kind <= PIPE    ? rt_scene_add_cylinder(scene, NULL, point, other, 0.4f, kind == CYLINDER,
                                                  &lamp, &error)
                          : rt_scene_add_cone(scene, NULL, point, other, 0.5f,
                                           kind == FRUSTUM ? 0.2f : 0, 1, &lamp, &error);
    expect_ok(status, &error);
    return light_renderer(scene);
}

/* 4 pi for each of n directions in a spiral in which the lit side of something is met. */
static void look_around(rt_renderer *renderer, const float from[3])
{
    rt_error error;
    for (int i = 0; i < n; i++) {
        double z = 1 - (2 * i + 1.0) / n, r = sqrt(1 - z * z), turn = i * 2.399963229728653;
        rays[i] = (rt_ray){{from[0], from[1], from[2]},
                           0,
                           {(float)(r * cos(turn)), (float)(r * sin(turn)), (float)z},
                           INFINITY};
    }
    expect_ok(rt_trace(renderer, RT_TRACE_CLOSEST, rays, n, hits, &error), &error);
    for (int i = 0; i < n; i++) {
        const float *d = rays[i].direction, *m = hits[i].normal;
        directions[i] =
            hits[i].shape == 0 && d[0] * m[0] + d[1] * m[1] + d[2] * m[2] < 0 ? 4 * PI : 0;
    }
}

static double average(const double *v)
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += v[i];
    return sum / n;
}

/*
 * Where no part of the lit side hides another, as one of an open pipe may, the mean of 1 / pdf_w is
 * the solid angle.
 */
static void shapes_fill_their_solid_angle(void **state)
{
    static const float from[][3] = {{2, 4, 1.5f}, {1, 2.5f, 1.2f}, {-0.6f, -3, -0.5f}};
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        if (kind == PIPE)
            continue;
        rt_renderer *renderer = shape_light(kind);
        for (uint32_t k = 0; k < 3; k++) {
            draw_lights(renderer, k, from[k], samples);
            for (int i = 0; i < n; i++) {
                const light_draw *s = samples + i;
                values[i] = s->radiance[0] > 0 ? s->spread : 0;
                if (s->radiance[0] > 0)
                    assert_float_equal(s->again_pdf_w * s->spread, 1, 2e-3);
            }
            look_around(renderer, from[k]);
            expect_mean(values, n, average(directions), 5 * 4 * PI / n, names[kind]);
        }
        rt_renderer_destroy(renderer);
    }
}

/* The mean flux of light paths is the power that the host states, which follows from the area. */
static void light_paths_of_shapes_carry_their_power(void **state)
{
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        rt_renderer *renderer = shape_light(kind);
        draw_emissions(renderer, 5, emissions);
        for (int i = 0; i < n; i++) {
            const emission_draw *e = emissions + i;
            values[i] = e->flux[0];
            assert_true(e->direction[0] * e->normal[0] + e->direction[1] * e->normal[1] +
                            e->direction[2] * e->normal[2] >=
                        -1e-6);
        }
        expect_mean(values, n, renderer->image.light_power, 1e-4 * renderer->image.light_power,
                    names[kind]);
        rt_renderer_destroy(renderer);
    }
}

/* A lamp that is brighter to one edge: its texture multiplies what it sends. */
static void textures_multiply_emission(void **state)
{
    static const float corner[3] = {0, 2, 0}, e1[3] = {1, 0, 0}, e2[3] = {0.5f, 0, 1},
                       below[3] = {0.2f, 0.5f, 0.4f};
    rt_texture texture;
    rt_surface lamp;
    rt_scene *scene = light_scene();
    rt_error error;
    (void)state;
    memset(&texture, 0, sizeof texture);
    memset(&lamp, 0, sizeof lamp);
    texture.kind = RT_TEXTURE_GRADIENT;
    texture.b[0] = texture.b[1] = 1;
    lamp.radiance[0] = lamp.radiance[1] = lamp.radiance[2] = 4;
    expect_ok(rt_scene_add_texture(scene, &lamp.texture, &texture, &error), &error);
    expect_ok(rt_scene_add_quad(scene, NULL, corner, e1, e2, &lamp, &error), &error);
    rt_renderer *renderer = light_renderer(scene);
    draw_lights(renderer, 1, below, samples);
    for (int i = 0; i < n; i++) {
        /* v runs along the second edge, of which z is the length. */
        assert_float_equal(samples[i].radiance[0], 4 * samples[i].position[2], 1e-5);
        assert_true(samples[i].radiance[2] == 0);
    }
    draw_emissions(renderer, 1, emissions);
    for (int i = 0; i < n; i++)
        values[i] = emissions[i].flux[0];
    expect_mean(values, n, PI * 4 * 0.5, 1e-4, "power of a textured lamp");
    rt_renderer_destroy(renderer);
}

/* Spots: intensity by the angle, and light paths in proportion to it. */
static void spots_fall_off_over_their_edge(void **state)
{
    rt_spot_light spot = {.position = {0, 4, 0},
                          .target = {0, 0, 0},
                          .intensity = {6, 6, 6},
                          .inner = 30,
                          .outer = 60};
    rt_scene *scene = light_scene();
    rt_error error;
    (void)state;
    expect_ok(rt_scene_add_spot_light(scene, &spot, &error), &error);
    rt_renderer *renderer = light_renderer(scene);
    for (int degrees = 0; degrees < 90; degrees += 15) {
        double c = cos(degrees * PI / 180), x = (c - 0.5) / (sqrt(0.75) - 0.5);
        x = fmax(0, fmin(1, x));
        float from[3] = {(float)(2 * sin(degrees * PI / 180)), (float)(4 - 2 * c), 0};
        draw_lights(renderer, 1, from, samples);
        assert_float_equal(samples[0].radiance[1], x > 1e-5 ? 6 * x * x * (3 - 2 * x) / 4 : 0,
                           1e-4);
    }

    enum { cells = 32 };
    uint32_t counts[cells] = {0};
    double expected[cells], total = 0;
    for (int i = 0; i < cells; i++) {
        expected[i] = 0;
        for (int k = 0; k < 1000; k++) {
            double x = (0.5 + (i + (k + 0.5) / 1000) * 0.5 / cells - 0.5) / (sqrt(0.75) - 0.5);
            x = fmin(1, x);
            expected[i] += x * x * (3 - 2 * x);
        }
        total += expected[i];
    }
    draw_emissions(renderer, 1, emissions);
    for (int i = 0; i < n; i++) {
        double c = -emissions[i].direction[1];
        assert_true(c > 0.5 - 1e-5);
        assert_float_equal(emissions[i].flux[0], renderer->image.light_power,
                           1e-4 * renderer->image.light_power);
        counts[(int)fmax(0, fmin(cells - 1, (c - 0.5) * 2 * cells))]++;
    }
    for (int i = 0; i < cells; i++)
        expected[i] *= n / total;
    expect_counts(counts, expected, cells, "directions of a spot");
    rt_renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(shapes_fill_their_solid_angle),
        statistical_test(light_paths_of_shapes_carry_their_power),
        statistical_test(textures_multiply_emission),
        statistical_test(spots_fall_off_over_their_edge),
    };
    return cmocka_run_group_tests_name("kernels/light_shape", tests, NULL, NULL);
}
