/*
 * test_bsdf.c - mixtures of lobes: energy, choice, Snell's law, scaling of radiance and flux,
 * shading normals. test_adjoint.c has flux at shading normals.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bsdf_draw.h"
#include "statistics.h"
#include "types.h"

#define PI 3.14159265358979323846

enum { n = 1 << 16 };

static bsdf_draw results[n];

static const rt_material_data mixture = {
    .kd = {0.3f, 0.2f, 0.1f}, .ks = {0.2f, 0.3f, 0.1f}, .kt = {0.4f, 0.2f, 0.6f}, .ior = 1.5f};

/* Seen at 50 degrees from above, flat, by a white path that is never ended. */
static situation flat(float eta)
{
    situation s = {{0, 0, 1, 0}, {0, 0, 1, 0}, {0.76604444f, 0, 0.64278761f}, 0, {1, 1, 1}, 1};
    s.eta = eta;
    return s;
}

static void scatter(const rt_material_data *material, const situation *at, uint32_t transport)
{
    draw_scatter(material, at, transport, 3, n, results);
}

/* Closed form in double precision; eta = eta_i / eta_t. */
static double fresnel(double cos_i, double eta)
{
    double sine2 = eta * eta * (1 - cos_i * cos_i);
    if (sine2 >= 1)
        return 1;
    double cos_t = sqrt(1 - sine2);
    double s = (eta * cos_i - cos_t) / (eta * cos_i + cos_t),
           p = (eta * cos_t - cos_i) / (eta * cos_t + cos_i);
    return (s * s + p * p) / 2;
}

static void fresnel_agrees_with_the_closed_form(void **state)
{
    static const float etas[] = {1 / 1.5f, 1.5f, 1 / 1.33f, 1.33f, 1, 2.4f, 1 / 2.4f};
    static float in[n][2], out[n][2];
    uint32_t count = n;
    (void)state;
    for (int i = 0; i < n; i++) {
        in[i][0] = (float)(i / 7 + 1) / (n / 7 + 1);
        in[i][1] = etas[i % 7];
    }
    cl_kernel kernel = test_kernel("bsdf", "reflectance");
    cl_mem given = test_buffer(sizeof in, in), made = test_buffer(sizeof out, NULL);
    rt_arg args[] = {RT_ARG(count), RT_ARG(given), RT_ARG(made)};
    test_run(kernel, args, 3, n);
    test_read(made, sizeof out, out);
    for (int i = 0; i < n; i++) {
        double critical = in[i][1] > 1 ? sqrt(1 - 1 / ((double)in[i][1] * in[i][1])) : 0;
        /* The reflectance is infinitely steep at the critical angle: rounding may show there. */
        double near = fabs(in[i][0] - critical) < 1e-3 && critical > 0 ? 2e-2 : 1e-5;
        assert_float_equal(out[i][0], fresnel(in[i][0], in[i][1]), near);
        if (in[i][0] < critical - 1e-6)
            assert_true(out[i][0] == 1 && out[i][1] == 0);
    }
    rt_buffer_release(test_device(), given);
    rt_buffer_release(test_device(), made);
    rt_kernel_release(kernel);
}

/* The mean weight is the albedo, whatever the roulette. */
static void expect_energy(const rt_material_data *material, const situation *at,
                          const double kept[3], const char *what)
{
    static double values[n];
    scatter(material, at, carry_radiance);
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < n; i++)
            values[i] = results[i].weight[c];
        expect_mean(values, n, kept[c], 1e-6, what);
        assert_float_equal(results[0].albedo[c], kept[c], 1e-6);
    }
}

static void energy_is_kept_without_bias(void **state)
{
    const double all[3] = {0.9, 0.7, 0.8}, survivals[] = {1, 0.5, 0.1};
    rt_material_data fresnel_mixture = mixture;
    (void)state;
    fresnel_mixture.flags = RT_MATERIAL_FRESNEL;
    for (int i = 0; i < 3; i++) {
        situation at = flat(1 / 1.5f);
        at.survival = (float)survivals[i];
        expect_energy(&mixture, &at, all, "mixture");
        expect_energy(&fresnel_mixture, &at, all, "mixture with Fresnel");
        at.beta[0] = 0.01f;
        at.beta[1] = 3;
        expect_energy(&mixture, &at, all, "mixture, coloured path");
        at.eta = 1.5f; /* total internal reflection */
        expect_energy(&mixture, &at, all, "mixture, total reflection");
    }
}

static void events_come_as_often_as_the_coefficients_say(void **state)
{
    rt_material_data material = mixture;
    const situation at = flat(1 / 1.5f);
    double r = fresnel(0.64278761, 1 / 1.5), sum = 2.4;
    (void)state;
    for (int with_fresnel = 0; with_fresnel < 2; with_fresnel++) {
        uint32_t counts[event_count] = {0};
        double delta = 1.8;
        double expected[event_count] = {
            [diffuse] = 0.6 * n / sum, [reflected] = 0.6 * n / sum, [refracted] = 1.2 * n / sum};
        if (with_fresnel) {
            material.flags = RT_MATERIAL_FRESNEL;
            expected[reflected] = r * delta * n / sum;
            expected[refracted] = (1 - r) * delta * n / sum;
        }
        scatter(&material, &at, carry_radiance);
        for (int i = 0; i < n; i++)
            counts[(int)results[i].event]++;
        expect_counts(counts, expected, event_count, "events");
    }
}

static void diffuse_density_is_what_is_sampled(void **state)
{
    enum { side = 16 };
    static uint32_t counts[side * side];
    static double expected[side * side];
    const rt_material_data matte = {.kd = {0.5f, 0.5f, 0.5f}, .ior = 1};
    const situation at = flat(1);
    (void)state;
    scatter(&matte, &at, carry_radiance);
    for (int i = 0; i < n; i++) {
        const bsdf_draw *r = results + i;
        double t = atan2(r->wi[1], r->wi[0]) / (2 * PI) + 0.5;
        int ring = (int)((double)r->wi[2] * r->wi[2] * side), sector = (int)(t * side);
        counts[(ring > side - 1 ? side - 1 : ring) * side +
               (sector > side - 1 ? side - 1 : sector)]++;
        assert_float_equal(r->pdf_w, r->wi[2] / PI, 1e-6);
        assert_float_equal(r->eval_pdf_w, r->pdf_w, 1e-6);
        assert_float_equal(r->eval[1], 0.5 * r->wi[2] / PI, 1e-6);
        assert_float_equal(r->weight[1] * r->pdf_w, r->eval[1], 1e-6);
    }
    for (int i = 0; i < side * side; i++)
        expected[i] = (double)n / (side * side);
    expect_counts(counts, expected, side * side, "diffuse directions");
}

static void delta_directions_obey_the_laws_of_reflection_and_refraction(void **state)
{
    static const float etas[] = {1 / 1.5f, 1.1f};
    (void)state;
    for (int e = 0; e < 2; e++)
        for (int below = 0; below < 2; below++) {
            situation at = flat(etas[e]);
            int seen[event_count] = {0};
            double side = below ? -1 : 1;
            at.wo[2] *= (float)side;
            scatter(&mixture, &at, carry_radiance);
            for (int i = 0; i < n; i++) {
                const bsdf_draw *r = results + i;
                seen[(int)r->event]++;
                if (r->event == reflected) {
                    assert_float_equal(r->wi[0], -at.wo[0], 1e-6);
                    assert_float_equal(r->wi[2], at.wo[2], 1e-6);
                } else if (r->event == refracted) {
                    assert_float_equal(r->wi[0], -etas[e] * at.wo[0], 1e-6);
                    assert_true(r->wi[2] * side < 0);
                }
                if (r->event != diffuse)
                    assert_true(r->pdf_w == 0);
            }
            assert_true(seen[diffuse] && seen[reflected] && seen[refracted]);
        }
}

static void radiance_is_scaled_at_refraction_and_flux_is_not(void **state)
{
    const situation at = flat(1 / 1.5f);
    (void)state;
    for (uint32_t transport = carry_radiance; transport <= carry_flux; transport++) {
        scatter(&mixture, &at, transport);
        for (int i = 0; i < n; i++) {
            double factor =
                results[i].event == refracted && transport == carry_radiance ? 1 / 2.25 : 1;
            assert_float_equal(results[i].eta_scale, factor, 1e-6);
        }
    }
}

/*
 * How many events lose their light, all of them diffuse; those that keep it are on their side of
 * the surface.
 */
static int count_lost(const rt_material_data *material, const situation *at)
{
    int lost = 0;
    scatter(material, at, carry_radiance);
    for (int i = 0; i < n; i++) {
        const bsdf_draw *r = results + i;
        if (r->event == absorbed)
            continue;
        lost += !(r->weight[0] > 0);
        /* A smooth lobe uses the geometric normal there. */
        assert_true(r->weight[0] > 0 || r->event == diffuse);
        if (r->weight[0] > 0)
            assert_true((r->wi[2] > 0) == (r->event != refracted));
        if (r->wi[2] <= 0)
            assert_true(r->eval[0] == 0);
    }
    return lost;
}

static void shading_normals_leak_no_light(void **state)
{
    static const float black[3];
    rt_material_data matte = mixture;
    situation at = flat(1 / 1.5f);
    (void)state;
    /*
     * The shading normal leans 60 degrees away, so many directions about it are below the surface.
     */
    at.shading[0] = -0.8660254f;
    at.shading[2] = 0.5f;
    memcpy(matte.ks, black, sizeof black);
    memcpy(matte.kt, black, sizeof black);
    /* (1 - cos 60) / 2 of the directions by the cosine, and a quarter of the mixture is diffuse. */
    const double part = 0.25, of_mixture = 0.25 * part;
    assert_float_equal(count_lost(&matte, &at), part * n, 6 * sqrt(part * (1 - part) * n));
    assert_float_equal(count_lost(&mixture, &at), of_mixture * n,
                       6 * sqrt(of_mixture * (1 - of_mixture) * n));
}

/*
 * A rough event carries its lobe's light over its density, in a mixture as alone; below alpha 1e-3
 * none is rough.
 */
static void rough_events_carry_their_lobe(void **state)
{
    rt_material_data material = mixture;
    int through = 0, counted = 0;
    situation at = flat(1 / 1.5f);
    (void)state;
    at.beta[0] = 0.3f;
    for (int with_fresnel = 0; with_fresnel < 2; with_fresnel++) {
        material.flags = with_fresnel ? RT_MATERIAL_FRESNEL : 0;
        material.roughness = 0.4f;
        scatter(&material, &at, carry_radiance);
        for (int i = 0; i < n; i++) {
            const bsdf_draw *r = results + i;
            assert_true(r->event != reflected && r->event != refracted);
            if (r->event != rough || r->pdf_w < 1e-3)
                continue;
            counted++;
            through += r->wi[2] < 0;
            assert_float_equal(r->pdf_w, r->eval_pdf_w, 1e-2 * r->pdf_w);
            for (int c = 0; c < 3; c++)
                assert_float_equal(r->weight[c] * r->pdf_w * r->eta_scale, r->eval[c],
                                   1e-2 * r->eval[c]);
            assert_float_equal(r->eta_scale, r->wi[2] < 0 ? 1 / 2.25 : 1, 1e-6);
        }
        material.roughness = 9e-4f;
        scatter(&material, &at, carry_radiance);
        for (int i = 0; i < n; i++)
            assert_true(results[i].event != rough);
    }
    assert_true(through > n / 10 && counted - through > n / 20);
}

static void black_absorbs(void **state)
{
    const rt_material_data black = {.ior = 1};
    const situation at = flat(1);
    (void)state;
    scatter(&black, &at, carry_radiance);
    for (int i = 0; i < n; i++)
        assert_true(results[i].event == absorbed);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fresnel_agrees_with_the_closed_form),
        statistical_test(energy_is_kept_without_bias),
        statistical_test(events_come_as_often_as_the_coefficients_say),
        statistical_test(diffuse_density_is_what_is_sampled),
        cmocka_unit_test(delta_directions_obey_the_laws_of_reflection_and_refraction),
        cmocka_unit_test(radiance_is_scaled_at_refraction_and_flux_is_not),
        cmocka_unit_test(shading_normals_leak_no_light),
        cmocka_unit_test(rough_events_carry_their_lobe),
        cmocka_unit_test(black_absorbs),
    };
    return cmocka_run_group_tests_name("kernels/bsdf", tests, NULL, NULL);
}
