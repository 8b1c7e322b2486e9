/*
 * test_light.c - sampling lights from a point: radiance and density; and the starts of light paths.
 */
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "light_draw.h"
#include "statistics.h"

#define PI 3.14159265358979323846

enum { n = light_draws };

static light_draw samples[n];
static emission_draw emissions[n];

static const rt_surface emitter = {.radiance = {3, 2, 1}};

/* The mean of 1 / pdf_w over samples that carry light is the solid angle from which light comes. */
static void expect_solid_angle(double expected, const char *what)
{
    static double values[n];
    for (int i = 0; i < n; i++) {
        const light_draw *s = samples + i;
        values[i] = s->radiance[0] > 0 ? s->inv_pdf : 0;
        if (s->radiance[0] > 0)
            assert_float_equal(s->again_pdf_w * s->inv_pdf, 1, 1e-4);
    }
    expect_mean(values, n, expected, 1e-4 * expected, what);
}

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/*
 * Van Oosterom and Strackee, "The Solid Angle of a Plane Triangle", IEEE Trans. Biomed. Eng. 30(2),
 * 1983.
 */
static double triangle_angle(const double a[3], const double b[3], const double c[3])
{
    double bc[3], la = sqrt(dot(a, a)), lb = sqrt(dot(b, b)), lc = sqrt(dot(c, c));
    cross(b, c, bc);
    return 2 *
           atan2(fabs(dot(a, bc)), la * lb * lc + dot(a, b) * lc + dot(a, c) * lb + dot(b, c) * la);
}

/* Solid angle of the parallelogram, seen from a point. */
static double quad_angle(const float corner[3], const float e1[3], const float e2[3],
                         const float from[3])
{
    double p[4][3];
    for (int i = 0; i < 3; i++) {
        p[0][i] = (double)corner[i] - from[i];
        p[1][i] = p[0][i] + e1[i];
        p[2][i] = p[0][i] + e2[i];
        p[3][i] = p[1][i] + e2[i];
    }
    return triangle_angle(p[0], p[1], p[2]) + triangle_angle(p[1], p[3], p[2]);
}

static void quads_fill_their_solid_angle(void **state)
{
    static const float corner[3] = {1, 2, 3}, e1[3] = {2, 0, 0}, right[3] = {0, 0, 1},
                       skew[3] = {1, 0, 1};
    /*
     * The normal is e1 x e2 = -y: lit points are below. Near, beside, in a corner, far, close to
     * the plane.
     */
    static const float from[][3] = {{2, 1.5f, 3.5f}, {4, 1, 5},        {1, 1.9f, 3},
                                    {-20, -30, 10},  {5, 1.95f, 3.5f}, {2, 1.99f, 3.4f}};
    (void)state;
    for (int skewed = 0; skewed < 2; skewed++) {
        const float *e2 = skewed ? skew : right;
        rt_scene *scene = light_scene();
        rt_error error;
        expect_ok(rt_scene_add_quad(scene, NULL, corner, e1, e2, &emitter, &error), &error);
        rt_renderer *renderer = light_renderer(scene);
        for (size_t i = 0; i < sizeof from / sizeof *from; i++) {
            draw_lights(renderer, (uint32_t)i, from[i], samples);
            expect_solid_angle(quad_angle(corner, e1, e2, from[i]),
                               skewed ? "skewed quad" : "rectangle");
        }
        draw_lights(renderer, 1, (const float[3]){2, 2.5f, 3}, samples);
        for (int i = 0; i < n; i++)
            assert_true(samples[i].radiance[0] == 0);
        rt_renderer_destroy(renderer);
    }
}

/*
 * From close by, a sphere is sampled by its area: most samples are on its far side, and the others'
 * 1 / pdf_w has so long a tail that no mean of it tells anything. Each is known: A cos / d^2.
 */
static void expect_samples_by_area(const float centre[3], double radius, const float from[3])
{
    const double share = (1 - radius / (from[2] - centre[2])) / 2;
    const double expected[2] = {n * (1 - share), n * share};
    uint32_t counts[2] = {0};
    for (int i = 0; i < n; i++) {
        const light_draw *s = samples + i;
        double d[3], normal[3];
        for (int k = 0; k < 3; k++) {
            d[k] = (double)from[k] - s->position[k];
            normal[k] = ((double)s->position[k] - centre[k]) / radius;
        }
        counts[s->radiance[0] > 0]++;
        if (s->radiance[0] > 0)
            assert_float_equal(
                s->inv_pdf / (4 * PI * radius * radius * dot(d, normal) / pow(dot(d, d), 1.5)), 1,
                0.02);
    }
    expect_counts(counts, expected, 2, "sphere from close by");
}

static void spheres_fill_their_solid_angle(void **state)
{
    static const float centre[3] = {1, 2, 3}, distances[] = {1.0005f, 1.01f, 1.5f, 10, 1000};
    rt_scene *scene = light_scene();
    rt_error error;
    (void)state;
    expect_ok(rt_scene_add_sphere(scene, NULL, centre, 0.5f, &emitter, &error), &error);
    rt_renderer *renderer = light_renderer(scene);
    for (size_t i = 0; i < sizeof distances / sizeof *distances; i++) {
        /* As rounded to float32, where the viewer's distance counts. */
        float z = 3 + 0.5f * distances[i];
        double d = z - 3.0, sine2 = 0.25 / (d * d);
        const float from[3] = {1, 2, z};
        draw_lights(renderer, (uint32_t)i, from, samples);
        if (i == 0)
            expect_samples_by_area(centre, 0.5, from);
        else
            expect_solid_angle(2 * PI * sine2 / (1 + sqrt(1 - sine2)), "sphere");
    }
    rt_renderer_destroy(renderer);
}

static void triangles_fill_their_solid_angle(void **state)
{
    static const float positions[9] = {0, 2, 0, 0, 2, 2, 1, 2, 0};
    static const uint32_t indices[3] = {0, 2, 1};
    const double a[3] = {-0.5, 2, -0.25}, b[3] = {-0.5, 2, 1.75}, c[3] = {0.5, 2, -0.25};
    rt_scene *scene = light_scene();
    rt_error error;
    (void)state;
    expect_ok(rt_scene_add_triangles(scene, NULL, positions, 3, indices, 1, NULL, &emitter, &error),
              &error);
    rt_renderer *renderer = light_renderer(scene);
    draw_lights(renderer, 4, (const float[3]){0.5f, 0, 0.25f}, samples);
    expect_solid_angle(triangle_angle(a, b, c), "triangle");
    rt_renderer_destroy(renderer);
}

static void point_lights_fall_off_with_the_square_of_distance(void **state)
{
    rt_scene *scene = light_scene();
    rt_point_light light = {.position = {1, 2, 3}, .intensity = {5, 6, 7}};
    rt_error error;
    (void)state;
    expect_ok(rt_scene_add_point_light(scene, &light, &error), &error);
    rt_renderer *renderer = light_renderer(scene);
    draw_lights(renderer, 1, (const float[3]){1, 2, 0}, samples);
    for (int i = 0; i < n; i++) {
        assert_true(samples[i].delta == 1 && samples[i].inv_pdf == 1 && samples[i].wi[2] == 1);
        assert_float_equal(samples[i].radiance[1], 6.0 / 9, 1e-6);
    }
    rt_renderer_destroy(renderer);
}

/* Three lights of 1, 2 and 1 parts of the power: a quad, a sphere of both sides' area, a point. */
static rt_renderer *mixed_lights(void)
{
    static const float corner[3] = {0, 2, 0}, e1[3] = {1, 0, 0}, e2[3] = {0, 0, 1},
                       centre[3] = {5, 0, 0};
    rt_scene *scene = light_scene();
    rt_surface quad = {.power = {1, 1, 1}}, sphere = {.power = {2, 2, 2}};
    rt_point_light point = {.position = {0, -5, 0}, .power = {1, 1, 1}};
    rt_error error;
    expect_ok(rt_scene_add_point_light(scene, &point, &error), &error);
    expect_ok(rt_scene_add_quad(scene, NULL, corner, e1, e2, &quad, &error), &error);
    expect_ok(rt_scene_add_sphere(scene, NULL, centre, 1, &sphere, &error), &error);
    return light_renderer(scene);
}

static void light_paths_carry_the_power_of_all_lights(void **state)
{
    static double values[n];
    static const double shares[3] = {0.25, 0.25, 0.5};
    uint32_t counts[3] = {0};
    double expected[3];
    rt_renderer *renderer = mixed_lights();
    (void)state;
    draw_emissions(renderer, 1, emissions);
    for (int i = 0; i < n; i++) {
        values[i] = emissions[i].flux[0];
        counts[(int)emissions[i].light]++;
        assert_float_equal(values[i], 4, 1e-5);
    }
    for (int i = 0; i < 3; i++)
        expected[i] = n * shares[i];
    expect_counts(counts, expected, 3, "choice of light");
    rt_renderer_destroy(renderer);
}

static void area_lights_emit_by_the_cosine_and_points_evenly(void **state)
{
    static double area[n], point[n];
    size_t area_count = 0, point_count = 0;
    rt_renderer *renderer = mixed_lights();
    (void)state;
    draw_emissions(renderer, 1, emissions);
    for (int i = 0; i < n; i++) {
        const emission_draw *e = emissions + i;
        double cosine = e->direction[0] * e->normal[0] + e->direction[1] * e->normal[1] +
                        e->direction[2] * e->normal[2];
        assert_float_equal(e->direction[0] * e->direction[0] + e->direction[1] * e->direction[1] +
                               e->direction[2] * e->direction[2],
                           1, 1e-6);
        if (e->light == 0) {
            point[point_count++] = e->direction[1];
        } else {
            assert_true(cosine >= -1e-6);
            area[area_count++] = cosine;
        }
    }
    expect_mean(point, point_count, 0, 1e-6, "direction from a point light");
    expect_mean(area, area_count, 2.0 / 3, 1e-6, "cosine from an area light");
    rt_renderer_destroy(renderer);
}

/* The flux of a start is what the light emits there over the density of emit_pdf.h. */
static void densities_of_starts_are_those_of_their_flux(void **state)
{
    static const double shares[] = {0.25, 0.25, 0.5};
    rt_renderer *renderer = mixed_lights();
    (void)state;
    draw_emissions(renderer, 3, emissions);
    for (int i = 0; i < n; i++) {
        const emission_draw *e = emissions + i;
        const double cosine = e->direction[0] * e->normal[0] + e->direction[1] * e->normal[1] +
                              e->direction[2] * e->normal[2];
        /* The intensity of the point; radiance times cosine. */
        const double emitted = e->light == 0   ? 1 / (4 * PI)
                               : e->light == 1 ? cosine / PI
                                               : 2 * cosine / (4 * PI * PI);
        assert_float_equal(e->flux[0] * shares[(int)e->light] * e->pdf, emitted, 1e-6);
    }
    rt_renderer_destroy(renderer);
}

/* The same of light from infinitely far, around a ball. */
static void densities_of_distant_starts_are_those_of_their_flux(void **state)
{
    static const float centre[3] = {1, 2, 3};
    const rt_directional_light sun = {.direction = {1, -2, 0.5f}, .irradiance = {3, 3, 3}};
    const rt_environment sky = {.radiance = {2, 2, 2}};
    (void)state;
    for (int is_sky = 0; is_sky < 2; is_sky++) {
        const rt_surface black = {0};
        rt_scene *scene = light_scene();
        rt_error error;
        expect_ok(rt_scene_add_sphere(scene, NULL, centre, 2, &black, &error), &error);
        expect_ok(is_sky ? rt_scene_set_environment(scene, &sky, &error)
                         : rt_scene_add_directional_light(scene, &sun, &error),
                  &error);
        rt_renderer *renderer = light_renderer(scene);
        draw_emissions(renderer, 4, emissions);
        for (int i = 0; i < n; i++)
            assert_float_equal(emissions[i].flux[0] * emissions[i].pdf, is_sky ? 2 : 3, 1e-4);
        rt_renderer_destroy(renderer);
    }
}

static void two_sided_lights_emit_on_both_sides(void **state)
{
    static const float corner[3] = {0, 2, 0}, e1[3] = {1, 0, 0}, e2[3] = {0, 0, 1};
    rt_material material = {.emission = {1, 1, 1}, .two_sided = 1};
    rt_surface surface = {0};
    rt_scene *scene = light_scene();
    rt_error error;
    int up = 0;
    (void)state;
    expect_ok(rt_scene_add_material(scene, &surface.material, NULL, &material, &error), &error);
    expect_ok(rt_scene_add_quad(scene, NULL, corner, e1, e2, &surface, &error), &error);
    rt_renderer *renderer = light_renderer(scene);
    for (int side = -1; side < 2; side += 2) {
        const float from[3] = {0.25f, 2 + (float)side, 0.5f};
        draw_lights(renderer, 1, from, samples);
        expect_solid_angle(quad_angle(corner, e1, e2, from), "two-sided rectangle");
    }
    draw_emissions(renderer, 1, emissions);
    for (int i = 0; i < n; i++) {
        up += emissions[i].direction[1] > 0;
        assert_float_equal(emissions[i].flux[0], 2 * PI, 1e-5);
    }
    expect_deviate((up - n / 2) / sqrt(n / 4.0), "paths upwards");
    rt_renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(quads_fill_their_solid_angle),
        statistical_test(spheres_fill_their_solid_angle),
        statistical_test(triangles_fill_their_solid_angle),
        cmocka_unit_test(point_lights_fall_off_with_the_square_of_distance),
        statistical_test(light_paths_carry_the_power_of_all_lights),
        statistical_test(area_lights_emit_by_the_cosine_and_points_evenly),
        cmocka_unit_test(densities_of_starts_are_those_of_their_flux),
        cmocka_unit_test(densities_of_distant_starts_are_those_of_their_flux),
        statistical_test(two_sided_lights_emit_on_both_sides),
    };
    return cmocka_run_group_tests_name("kernels/light", tests, NULL, NULL);
}
