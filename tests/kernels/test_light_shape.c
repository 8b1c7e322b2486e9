/* test_light_shape.c - lights of every shape with a placement, and lights with textures. */
#include "light_draw.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene.h"
#include "shape_kinds.h"
#include "statistics.h"

#define PI 3.14159265358979323846

enum { n = light_draws };

static light_draw samples[n];
static emission_draw emissions[n];
static double values[n], directions[n];
static rt_ray rays[n];
static rt_hit hits[n];

static const struct emitter {
    const char *name, *shape;
    int hides_itself; /* a part of its lit side may hide another */
} emitters[] = {
    {"ellipsoid", "ellipsoid { centre 0.3 0.2 -0.1  radii 0.5 0.2 0.8", 0},
    {"disc", "disc { centre 0.3 0.2 -0.1  normal 0.5 1.4 0.3  radius 0.7  inner_radius 0.3", 0},
    {"cylinder", "cylinder { a 0.3 0.2 -0.1  b 0.5 1.4 0.3  radius 0.4", 0},
    {"pipe", "cylinder { a 0.3 0.2 -0.1  b 0.5 1.4 0.3  radius 0.4  caps false", 1},
    {"cone", "cone { base 0.3 0.2 -0.1  apex 0.5 1.4 0.3  radius 0.5", 0},
    {"frustum", "cone { base 0.3 0.2 -0.1  apex 0.5 1.4 0.3  radius 0.5  apex_radius 0.2", 0},
    {"box", "box { centre 0.3 0.2 -0.1  size 0.5 1.2 0.8", 0},
    {"torus", "torus { centre 0.3 0.2 -0.1  axis 0.5 1.4 0.3  major_radius 0.6  minor_radius 0.2",
     0},
};
enum { emitter_count = sizeof emitters / sizeof *emitters };

/* The shape as an area light, turned and stretched; marks its kind in `seen`. */
static rt_renderer *shape_light(const struct emitter *emitter, int seen[SHAPE_KINDS_MAX])
{
    rt_scene *scene = NULL;
    char text[512];
    rt_error error;
    snprintf(text, sizeof text,
             "material black {}\n%s  material black  radiance 2  "
             "matrix 1.2 0.1 0 0.3  -0.2 0.8 0.3 0.1  0 -0.2 1.1 0 }\n",
             emitter->shape);
    expect_ok(rt_scene_parse(&scene, text, "test", NULL, &error), &error);
    seen[scene->shapes[0].kind] = 1;
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
    int seen[SHAPE_KINDS_MAX] = {0};
    (void)state;
    for (const struct emitter *emitter = emitters; emitter < emitters + emitter_count; emitter++) {
        if (emitter->hides_itself)
            continue;
        rt_renderer *renderer = shape_light(emitter, seen);
        for (uint32_t k = 0; k < 3; k++) {
            draw_lights(renderer, k, from[k], samples);
            for (int i = 0; i < n; i++) {
                const light_draw *s = samples + i;
                values[i] = s->radiance[0] > 0 ? s->inv_pdf : 0;
                if (s->radiance[0] > 0)
                    assert_float_equal(s->again_pdf_w * s->inv_pdf, 1, 2e-3);
            }
            look_around(renderer, from[k]);
            expect_mean(values, n, average(directions), 5 * 4 * PI / n, emitter->name);
        }
        rt_renderer_destroy(renderer);
    }
    RT_PLACED_SHAPES(EXPECT_SEEN)
}

/* The mean flux of light paths is the power that the host states, which follows from the area. */
static void light_paths_of_shapes_carry_their_power(void **state)
{
    int seen[SHAPE_KINDS_MAX] = {0};
    (void)state;
    for (const struct emitter *emitter = emitters; emitter < emitters + emitter_count; emitter++) {
        rt_renderer *renderer = shape_light(emitter, seen);
        draw_emissions(renderer, 5, emissions);
        for (int i = 0; i < n; i++) {
            const emission_draw *e = emissions + i;
            values[i] = e->flux[0];
            assert_true(e->direction[0] * e->normal[0] + e->direction[1] * e->normal[1] +
                            e->direction[2] * e->normal[2] >=
                        -1e-6);
        }
        expect_mean(values, n, renderer->image.light_power, 1e-4 * renderer->image.light_power,
                    emitter->name);
        rt_renderer_destroy(renderer);
    }
    RT_PLACED_SHAPES(EXPECT_SEEN)
}

/* An area light that is brighter to one edge: its texture multiplies what it sends. */
static void textures_multiply_emission(void **state)
{
    static const float corner[3] = {0, 2, 0}, e1[3] = {1, 0, 0}, e2[3] = {0.5f, 0, 1},
                       below[3] = {0.2f, 0.5f, 0.4f};
    rt_texture texture;
    rt_surface emitter;
    rt_scene *scene = light_scene();
    rt_error error;
    (void)state;
    memset(&texture, 0, sizeof texture);
    memset(&emitter, 0, sizeof emitter);
    texture.kind = RT_TEXTURE_GRADIENT;
    texture.b[0] = texture.b[1] = 1;
    emitter.radiance[0] = emitter.radiance[1] = emitter.radiance[2] = 4;
    expect_ok(rt_scene_add_texture(scene, &emitter.texture, &texture, &error), &error);
    expect_ok(rt_scene_add_quad(scene, NULL, corner, e1, e2, &emitter, &error), &error);
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
    expect_mean(values, n, PI * 4 * 0.5, 1e-4, "power of a textured area light");
    rt_renderer_destroy(renderer);
}

/* From 30 to 60 degrees, by the cosine. */
static double edge(rt_falloff falloff, double cosine)
{
    const double x = falloff == RT_FALLOFF_LINEAR ? (PI / 3 - acos(cosine)) / (PI / 6)
                                                  : (cosine - 0.5) / (sqrt(0.75) - 0.5);
    const double inside = x < 1e-5 ? 0 : fmin(1, x);
    return falloff == RT_FALLOFF_LINEAR    ? inside
           : falloff == RT_FALLOFF_SQUARE  ? inside * inside
           : falloff == RT_FALLOFF_QUARTIC ? pow(inside, 4)
                                           : inside * inside * (3 - 2 * inside);
}

/* Intensity by the angle, and light paths in proportion to it. */
static void expect_falloff(rt_falloff falloff)
{
    rt_spot_light spot = {.position = {0, 4, 0},
                          .target = {0, 0, 0},
                          .intensity = {6, 6, 6},
                          .inner = 30,
                          .outer = 60,
                          .falloff = falloff};
    rt_scene *scene = light_scene();
    rt_error error;
    expect_ok(rt_scene_add_spot_light(scene, &spot, &error), &error);
    rt_renderer *renderer = light_renderer(scene);
    for (int degrees = 0; degrees < 90; degrees += 15) {
        double c = cos(degrees * PI / 180);
        float from[3] = {(float)(2 * sin(degrees * PI / 180)), (float)(4 - 2 * c), 0};
        draw_lights(renderer, 1, from, samples);
        assert_float_equal(samples[0].radiance[1], 6 * edge(falloff, c) / 4, 1e-4);
    }

    enum { cells = 32 };
    uint32_t counts[cells] = {0};
    double expected[cells], total = 0;
    for (int i = 0; i < cells; i++) {
        expected[i] = 0;
        for (int k = 0; k < 1000; k++)
            expected[i] += edge(falloff, 0.5 + (i + (k + 0.5) / 1000) * 0.5 / cells);
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

static void spots_fall_off_over_their_edge(void **state)
{
    (void)state;
    expect_falloff(RT_FALLOFF_SMOOTH);
    expect_falloff(RT_FALLOFF_LINEAR);
    expect_falloff(RT_FALLOFF_SQUARE);
    expect_falloff(RT_FALLOFF_QUARTIC);
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
