/*
 * test_light_environment.c - the environment: its directions, its density, and the light paths
 * that start from it.
 */
#include "light_draw.h"

#include <math.h>
#include <string.h>

#include "lib/image/scratch.h"
#include "statistics.h"
#include "statistics/sky.h"
#include "base/vec.h"

#define PI 3.14159265358979323846

enum { n = light_draws, width = sky_width, height = sky_height, cells = width * height };

static light_draw samples[n];
static compensated_draw compensated[n];
static emission_draw emissions[n];
static double values[n];

static const float origin[3] = {0, 0, 0};

/* Two openings beside the origin, one of them far away, and one that faces it edge on. */
static const rt_portal portals[] = {{{2, -1, -3}, {0, 2.5f, 0}, {0, 0, 4}},
                                    {{-40, 30, 10}, {10, 0, 0}, {0, 6, 8}},
                                    {{0, 0, 5}, {3, 0, 0}, {0, 0, 1}}};

static int has_portals;

/* A small sphere, which gives the scene its radius, in the sky. */
static rt_renderer *sky_turned(int has_image, float rotation, const rt_transform *transform)
{
    static const float centre[3] = {1, 2, 3};
    rt_scene *scene = light_scene();
    rt_environment environment = {
        .radiance = {2, 2, 2}, .rotation = rotation, .transform = *transform};
    rt_surface surface;
    rt_error error;
    memset(&surface, 0, sizeof surface);
    if (has_image)
        environment.path = sky_write_picture();
    expect_ok(rt_scene_add_sphere(scene, NULL, centre, 0.5f, &surface, &error), &error);
    for (size_t i = 0; i < sizeof portals / sizeof *portals && has_portals; i++)
        expect_ok(rt_scene_add_portal(scene, portals + i, &error), &error);
    expect_ok(rt_scene_set_environment(scene, &environment, &error), &error);
    return light_renderer(scene);
}

static rt_renderer *sky(int has_image, float rotation)
{
    return sky_turned(has_image, rotation, &(rt_transform){{{0}}});
}

/* A mirroring and a rotation, of twice the size; and none. */
static const rt_transform turned = {{{-4 / 3.0, -2 / 3.0, 4 / 3.0, 0},
                                     {-4 / 3.0, 4 / 3.0, -2 / 3.0, 0},
                                     {2 / 3.0, 4 / 3.0, 4 / 3.0, 0}}};
static const rt_transform upright = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

/* The unit direction along the axes of the image. */
static void along_axes(float out[3], const rt_transform *transform, const float w[3])
{
    double v[3], square = 0;
    for (int j = 0; j < 3; j++) {
        v[j] = 0;
        for (int i = 0; i < 3; i++)
            v[j] += transform->m[i][j] * w[i];
        square += v[j] * v[j];
    }
    for (int j = 0; j < 3; j++)
        out[j] = (float)(v[j] / sqrt(square));
}

/*
 * The point of the picture in direction w: the centre towards -z, growing towards +x, from the top
 * down.
 */
static void place(const float w[3], double rotation, double *u, double *v)
{
    *u = 0.5 + atan2(w[0], -w[2]) / (2 * PI) + rotation / 360;
    *u -= floor(*u);
    *v = acos(fmax(-1, fmin(1, w[1]))) / PI;
}

static int wrapped(int i, int size)
{
    return (i + size) % size;
}

static int clamped(int i, int size)
{
    return i < 0 ? 0 : i >= size ? size - 1 : i;
}

/* The picture between its pixels. */
static double radiance(double u, double v)
{
    double x = u * width - 0.5, y = v * height - 0.5;
    int i = (int)floor(x), j = (int)floor(y);
    double a = x - i, b = y - j;
    int left = wrapped(i, width), right = wrapped(i + 1, width), top = clamped(j, height),
        low = clamped(j + 1, height);
    return 2 * ((1 - b) * ((1 - a) * sky_texel(left, top) + a * sky_texel(right, top)) +
                b * ((1 - a) * sky_texel(left, low) + a * sky_texel(right, low)));
}

/* Its integral over all directions. */
static double whole_sky(void)
{
    enum { steps = 40 };
    double sum = 0;
    for (int i = 0; i < width * steps; i++)
        for (int j = 0; j < height * steps; j++) {
            double u = (i + 0.5) / (width * steps), v = (j + 0.5) / (height * steps);
            sum += radiance(u, v) * sin(PI * v);
        }
    return sum * 2 * PI * PI / (width * steps) / (height * steps);
}

static void expect_samples(const rt_transform *transform)
{
    rt_renderer *renderer = sky_turned(1, 100, transform);
    draw_lights(renderer, 7, origin, samples);
    for (int i = 0; i < n; i++) {
        const light_draw *s = samples + i;
        double u, v;
        float w[3];
        along_axes(w, transform, s->wi);
        place(w, 100, &u, &v);
        assert_float_equal(s->radiance[1], radiance(u, v), 2e-3);
        assert_float_equal(s->again_pdf_w * s->inv_pdf, 1, 2e-3);
        assert_true(s->delta == 0);
        values[i] = s->radiance[0] * s->inv_pdf;
    }
    expect_mean(values, n, whole_sky(), 1e-4 * whole_sky(), "light of the whole sky");
    rt_renderer_destroy(renderer);
}

static void samples_bring_the_radiance_of_their_direction(void **state)
{
    (void)state;
    expect_samples(&upright);
    expect_samples(&turned);
}

static void an_even_sky_is_sampled_evenly(void **state)
{
    rt_renderer *renderer = sky(0, 0);
    (void)state;
    draw_lights(renderer, 1, origin, samples);
    for (int i = 0; i < n; i++) {
        assert_float_equal(samples[i].inv_pdf, 4 * PI, 1e-4);
        assert_float_equal(samples[i].again_pdf_w * samples[i].inv_pdf, 1, 1e-6);
        values[i] = samples[i].wi[1] > 0;
    }
    expect_mean(values, n, 0.5, 0, "upper half of the sky");
    rt_renderer_destroy(renderer);
}

static void expect_above_the_mean(const rt_transform *transform)
{
    rt_renderer *renderer = sky_turned(1, 100, transform);
    const double mean = whole_sky() / (4 * PI);
    int above = 0, left_out = 0;
    draw_compensated(renderer, 3, origin, compensated);
    for (int i = 0; i < n; i++) {
        const compensated_draw *s = compensated + i;
        double u, v;
        float w[3];
        along_axes(w, transform, s->wi);
        place(w, 100, &u, &v);
        assert_true(s->inv_pdf > 0);
        assert_float_equal(s->again_pdf_w * s->inv_pdf, 1, 2e-3);
        above += radiance(u, v) > mean;
        values[i] = 4 * PI * s->any_pdf_w;
        left_out += s->any_pdf_w == 0;
    }
    expect_mean(values, n, 1, 1e-3, "density of the whole sphere");
    assert_true(above > 0.8 * n && left_out > 0.1 * n);
    rt_renderer_destroy(renderer);
}

/* Beside BSDF sampling the density is that of the radiance above the mean. */
static void beside_the_bsdf_the_sky_counts_above_its_mean(void **state)
{
    (void)state;
    expect_above_the_mean(&upright);
    expect_above_the_mean(&turned);
}

/* An even sky is left to the BSDF alone. */
static void beside_the_bsdf_an_even_sky_is_not_sampled(void **state)
{
    rt_renderer *renderer = sky(0, 0);
    (void)state;
    draw_compensated(renderer, 3, origin, compensated);
    for (int i = 0; i < n; i++)
        assert_true(compensated[i].inv_pdf == 0 && compensated[i].any_pdf_w == 0);
    rt_renderer_destroy(renderer);
}

/* ---- Portals ----------------------------------------------------------------------- */

/* Whether a direction from the origin leads through one of them. */
static int is_through(const float w[3])
{
    for (size_t i = 0; i < sizeof portals / sizeof *portals; i++) {
        const rt_portal *p = portals + i;
        double n[3], b[3], c[3], at[3], x = 0, y = 0, height = 0, cosine = 0;
        for (int k = 0; k < 3; k++) {
            b[k] = p->edge1[k];
            c[k] = p->edge2[k];
        }
        rt_vec_cross(n, b, c);
        for (int k = 0; k < 3; k++) {
            height += n[k] * p->corner[k];
            cosine += n[k] * w[k];
        }
        for (int k = 0; k < 3; k++) {
            at[k] = height / cosine * w[k] - p->corner[k];
            x += at[k] * b[k];
            y += at[k] * c[k];
        }
        if (height / cosine > 0 && x >= 0 && x <= b[0] * b[0] + b[1] * b[1] + b[2] * b[2] &&
            y >= 0 && y <= c[0] * c[0] + c[1] * c[1] + c[2] * c[2])
            return 1;
    }
    return 0;
}

/* What is sampled through portals is so by its radiance: both are in proportion to a fifth. */
static void expect_even_radiance_over_pdf(void)
{
    double sum = 0, squares = 0;
    int count = 0;
    for (int i = 0; i < n; i++) {
        if (!is_through(samples[i].wi))
            continue;
        const double value = samples[i].radiance[0] * samples[i].inv_pdf;
        sum += value;
        squares += value * value;
        count++;
    }
    assert_true(sqrt(squares * count / (sum * sum) - 1) < 0.2);
}

/* Most samples go through them, and the light of all is as much as without. */
static void expect_portals(int has_image)
{
    const double whole = has_image ? whole_sky() : 8 * PI;
    int through = 0;
    rt_renderer *renderer = sky_turned(has_image, 100, &turned);
    draw_lights(renderer, 9, origin, samples);
    for (int i = 0; i < n; i++) {
        assert_true(samples[i].inv_pdf > 0);
        assert_float_equal(samples[i].again_pdf_w * samples[i].inv_pdf, 1, 5e-3);
        through += is_through(samples[i].wi);
        values[i] = samples[i].radiance[0] * samples[i].inv_pdf;
    }
    assert_true(through > 0.9 * n - 3 * sqrt(n));
    if (has_image)
        expect_even_radiance_over_pdf();
    expect_mean(values, n, whole, 1e-3 * whole, "light of the sky beside portals");

    draw_compensated(renderer, 3, origin, compensated);
    for (int i = 0; i < n; i++) {
        assert_float_equal(compensated[i].again_pdf_w * compensated[i].inv_pdf, 1, 5e-3);
        values[i] = 4 * PI * compensated[i].any_pdf_w;
    }
    expect_mean(values, n, 1, 2e-3, "density of the whole sphere beside portals");
    rt_renderer_destroy(renderer);
}

static void portals_are_hints(void **state)
{
    (void)state;
    has_portals = 1;
    expect_portals(0);
    expect_portals(1);
    has_portals = 0;
}

/*
 * Of a portal that leans, off the origin: what is sampled at its edges is through it, whatever the
 * side that rounding finds, and weighs no more than what is sampled within.
 */
static void expect_edges(int has_image)
{
    enum { count = 4096 };
    static const rt_portal leaning = {{300, -200, 700}, {3, 1, 0.5f}, {-1, 3, 0}};
    static float made[count][4];
    const float from[4] = {297, -199, 698, 0}, w[4] = {0.36f, 0.48f, -0.8f, 0};
    uint32_t items = count;
    rt_scene *scene = light_scene();
    rt_environment environment = {.radiance = {1, 1, 1}};
    rt_surface surface;
    rt_error error;
    memset(&surface, 0, sizeof surface);
    if (has_image)
        environment.path = sky_write_picture();
    expect_ok(rt_scene_add_sphere(scene, NULL, from, 9, &surface, &error), &error);
    expect_ok(rt_scene_add_portal(scene, &leaning, &error), &error);
    expect_ok(rt_scene_set_environment(scene, &environment, &error), &error);
    rt_renderer *renderer = light_renderer(scene);
    cl_kernel kernel = test_kernel("light", "portal_edges");
    cl_mem out = test_buffer(sizeof made, NULL);
    rt_arg args[] = {RT_ARG(renderer->scene), RT_ARG(from), RT_ARG(w), RT_ARG(items), RT_ARG(out)};
    test_run(kernel, args, 5, count);
    test_read(out, sizeof made, made);
    double light = 0;
    for (int i = 0; i < count; i++)
        light += made[i][1] * made[i][2] / count;
    for (int i = 0; i < count; i++) {
        assert_true(made[i][0] > 0 && made[i][0] < 1 / 0.9 + 1e-3);
        assert_true(made[i][1] * made[i][2] < 2 * light);
    }
    rt_buffer_release(test_device(), out);
    rt_kernel_release(kernel);
    rt_renderer_destroy(renderer);
}

static void edges_of_portals_weigh_no_more(void **state)
{
    (void)state;
    expect_edges(0);
    expect_edges(1);
}

/* ---- Light paths ------------------------------------------------------------------- */

/* Flux through a disc of radius 0.1 in the middle of the scene whose normal is y, from above. */
static void expect_flux(double expected, const char *what)
{
    for (int i = 0; i < n; i++) {
        const emission_draw *e = emissions + i;
        double t = (2 - e->position[1]) / e->direction[1];
        double x = e->position[0] + t * e->direction[0] - 1,
               z = e->position[2] + t * e->direction[2] - 3;
        values[i] = t > 0 && e->direction[1] < 0 && x * x + z * z < 0.01 ? e->flux[0] : 0;
    }
    expect_mean(values, n, expected * PI * 0.01, 1e-5, what);
}

/* What comes from above, by the cosine. */
static void expect_flux_of_picture(const rt_transform *transform)
{
    enum { steps = 40 };
    const double(*m)[4] = transform->m,
          size = sqrt(m[1][0] * m[1][0] + m[1][1] * m[1][1] + m[1][2] * m[1][2]);
    double expected = 0;
    for (int i = 0; i < width * steps; i++)
        for (int j = 0; j < height * steps; j++) {
            const double u = (i + 0.5) / (width * steps), v = (j + 0.5) / (height * steps);
            const double longitude = 2 * PI * (u - 0.5), sine = sin(PI * v);
            const double up = m[1][0] * sine * sin(longitude) + m[1][1] * cos(PI * v) -
                              m[1][2] * sine * cos(longitude);
            expected += radiance(u, v) * sine * fmax(0, up / size);
        }
    rt_renderer *renderer = sky_turned(1, 0, transform);
    draw_emissions(renderer, 3, emissions);
    expect_flux(expected * 2 * PI * PI / (width * steps) / (height * steps), "sky of a picture");
    rt_renderer_destroy(renderer);
}

static void light_paths_of_the_sky_carry_its_irradiance(void **state)
{
    rt_renderer *renderer = sky(0, 0);
    (void)state;
    draw_emissions(renderer, 3, emissions);
    expect_flux(PI * 2, "even sky");
    rt_renderer_destroy(renderer);

    expect_flux_of_picture(&upright);
    expect_flux_of_picture(&turned);
}

/* Of a portal around the sphere of the scene, one that cuts it, and one that is off it. */
static void light_paths_through_portals_carry_it_too(void **state)
{
    static const float centre[3] = {1, 2, 3};
    const rt_portal own[] = {{{0.8f, 1.6f, 2.9f}, {0.6f, 0, 0}, {0, 0.6f, 0.6f}},
                             {{9, 9, 9}, {1, 0, 0}, {0, 1, 0}}};
    rt_directional_light sun = {.direction = {1, -2, 1}, .irradiance = {5, 5, 5}};
    (void)state;
    for (int is_sun = 0; is_sun < 2; is_sun++) {
        rt_environment environment = {.radiance = {2, 2, 2}};
        rt_surface surface;
        rt_scene *scene = light_scene();
        rt_error error;
        memset(&surface, 0, sizeof surface);
        expect_ok(rt_scene_add_sphere(scene, NULL, centre, 0.5f, &surface, &error), &error);
        for (int i = 0; i < 2; i++)
            expect_ok(rt_scene_add_portal(scene, own + i, &error), &error);
        expect_ok(is_sun ? rt_scene_add_directional_light(scene, &sun, &error)
                         : rt_scene_set_environment(scene, &environment, &error),
                  &error);
        rt_renderer *renderer = light_renderer(scene);
        draw_emissions(renderer, 3, emissions);
        expect_flux(is_sun ? 5 * 2 / sqrt(6) : PI * 2, "distant light beside portals");
        for (int i = 0; i < n; i++)
            values[i] = emissions[i].flux[0] > 0 && is_sun
                            ? emissions[i].flux[0] * emissions[i].pdf / 5
                            : 1;
        for (int i = 0; i < n; i++)
            assert_float_equal(values[i], 1, 1e-4);
        rt_renderer_destroy(renderer);
    }
}

/* Evenly over the ellipse, all with its flux; the axes are 1, 3 and 2 m along y, z and -x. */
static void light_paths_of_a_beam_start_on_its_cross_section(void **state)
{
    const rt_beam_light beam = {.position = {1, 2, 3},
                                .target = {0, 2, 3},
                                .width = 6,
                                .height = 2,
                                .irradiance = {5, 5, 5}};
    const double area = 3 * acos(-1);
    rt_scene *scene = light_scene();
    rt_error error;
    double places[n];
    (void)state;
    expect_ok(rt_scene_add_beam_light(scene, &beam, &error), &error);
    rt_renderer *renderer = light_renderer(scene);
    draw_emissions(renderer, 5, emissions);
    for (int i = 0; i < n; i++) {
        const emission_draw *e = emissions + i;
        const double y = e->position[1] - 2, z = (e->position[2] - 3) / 3;
        places[i] = y * y + z * z;
        assert_true(places[i] <= 1 + 1e-5 && fabs(e->position[0] - 1) < 1e-5);
        assert_true(fabs(e->direction[0] + 1) < 1e-6 && e->error > 0);
        assert_true(fabs(e->flux[0] / (5 * area) - 1) < 1e-5 && fabs(e->pdf * area - 1) < 1e-5);
    }
    expect_mean(places, n, 0.5, 1e-6, "a beam's places");
    rt_renderer_destroy(renderer);
}

static void light_paths_of_a_directional_light_carry_its_irradiance(void **state)
{
    static const float centre[3] = {1, 2, 3};
    rt_directional_light sun = {.direction = {1, -2, 1}, .irradiance = {5, 5, 5}};
    rt_surface surface;
    rt_scene *scene = light_scene();
    rt_error error;
    (void)state;
    memset(&surface, 0, sizeof surface);
    expect_ok(rt_scene_add_sphere(scene, NULL, centre, 0.5f, &surface, &error), &error);
    expect_ok(rt_scene_add_directional_light(scene, &sun, &error), &error);
    rt_renderer *renderer = light_renderer(scene);
    draw_emissions(renderer, 5, emissions);
    expect_flux(5 * 2 / sqrt(6), "directional light");
    draw_lights(renderer, 1, origin, samples);
    for (int i = 0; i < n; i++)
        assert_true(samples[i].delta == 1 && samples[i].inv_pdf == 1 &&
                    samples[i].radiance[0] == 5 && fabs(samples[i].wi[1] - 2 / sqrt(6)) < 1e-6);
    rt_renderer_destroy(renderer);
}

static void distant_light_starts_beyond_all_planes(void **state)
{
    static const float centre[3] = {1, 2, 3}, low[3] = {0, 2.5f, 0}, high[3] = {0, 4, 0},
                       up[3] = {0, 1, 0};
    rt_environment environment = {.radiance = {2, 2, 2}};
    rt_surface surface;
    rt_scene *scene = light_scene();
    rt_error error;
    (void)state;
    memset(&surface, 0, sizeof surface);
    /*
     * The planes lie above the sphere's centre: what comes from above meets both, what comes from
     * below at most one.
     */
    expect_ok(rt_scene_add_sphere(scene, NULL, centre, 0.5f, &surface, &error), &error);
    expect_ok(rt_scene_add_plane(scene, NULL, low, up, &surface, &error), &error);
    expect_ok(rt_scene_add_plane(scene, NULL, high, up, &surface, &error), &error);
    expect_ok(rt_scene_set_environment(scene, &environment, &error), &error);
    rt_renderer *renderer = light_renderer(scene);
    draw_emissions(renderer, 3, emissions);
    for (int i = 0; i < n; i++) {
        assert_float_equal(emissions[i].flux[0], emissions[0].flux[0], 1e-5 * emissions[0].flux[0]);
        assert_true(emissions[i].direction[1] < 0 ? emissions[i].position[1] > 4
                                                  : emissions[i].position[1] < 2.5f);
    }
    assert_true(emissions[0].flux[0] > 0);
    rt_renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(samples_bring_the_radiance_of_their_direction),
        statistical_test(an_even_sky_is_sampled_evenly),
        statistical_test(beside_the_bsdf_the_sky_counts_above_its_mean),
        cmocka_unit_test(beside_the_bsdf_an_even_sky_is_not_sampled),
        statistical_test(portals_are_hints),
        cmocka_unit_test(edges_of_portals_weigh_no_more),
        statistical_test(light_paths_of_the_sky_carry_its_irradiance),
        statistical_test(light_paths_through_portals_carry_it_too),
        statistical_test(light_paths_of_a_beam_start_on_its_cross_section),
        statistical_test(light_paths_of_a_directional_light_carry_its_irradiance),
        cmocka_unit_test(distant_light_starts_beyond_all_planes),
    };
    void *scratch = NULL;
    if (scratch_enter(&scratch) != 0)
        return 1;
    const int failed = cmocka_run_group_tests_name("kernels/light_sky", tests, NULL, NULL);
    return scratch_leave(&scratch) != 0 || failed != 0;
}
