/*
 * test_ggx.c - rough reflection and refraction: sampling against evaluation, reciprocity, energy;
 * metals' reflectance.
 */
#include "support.h"

#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "statistics.h"
#include "statistics/facets.h"
#include "types.h"

#define PI 3.14159265358979323846

enum { n = 1 << 16 };

typedef struct boundary {
    float ks, kt, alpha, eta;
} boundary;

typedef struct result {
    float wi[3], pdf_w;
    float weight[3], unused;
    float value[3], eval_pdf_w;
} result;

static result results[n];

static const rt_material_data plain, dielectric = {.flags = RT_MATERIAL_FRESNEL};

/* The same with facets of each kind, three times as rough across as along where they differ. */
enum { facet_kinds = 8 };

static rt_material_data with_facets(const rt_material_data *material, int kind, float alpha)
{
    rt_material_data out = *material;
    out.flags |= kind & 1 ? RT_MATERIAL_ANISOTROPIC : 0;
    out.flags |= kind & 2 ? RT_MATERIAL_BECKMANN : 0;
    out.flags |= kind & 4 ? RT_MATERIAL_SEPARABLE : 0;
    out.roughness_v = 3 * alpha < 1 ? 3 * alpha : 1;
    return out;
}

/* Seen at this cosine. */
static void view(float wo[4], double cosine)
{
    wo[0] = (float)(0.8 * sqrt(1 - cosine * cosine));
    wo[1] = (float)(-0.6 * sqrt(1 - cosine * cosine));
    wo[2] = (float)cosine;
    wo[3] = 0;
}

static void sample(const rt_material_data *material, boundary b, double cosine)
{
    uint32_t seed = test_seed(5), count = n;
    float wo[4];
    view(wo, cosine);
    cl_kernel kernel = test_kernel("ggx", "sample_ggx");
    cl_mem m = test_buffer(sizeof *material, material), out = test_buffer(sizeof results, NULL);
    rt_arg args[] = {RT_ARG(seed), RT_ARG(count), RT_ARG(m), RT_ARG(b), RT_ARG(wo), RT_ARG(out)};
    test_run(kernel, args, 6, n);
    test_read(out, sizeof results, results);
    rt_buffer_release(test_device(), m);
    rt_buffer_release(test_device(), out);
    rt_kernel_release(kernel);
}

static void evaluate(const char *name, const rt_material_data *material, boundary b, double cosine,
                     const float (*directions)[4], uint32_t count, float (*out)[4])
{
    float wo[4];
    view(wo, cosine);
    cl_kernel kernel = test_kernel("ggx", name);
    cl_mem m = test_buffer(sizeof *material, material),
           in = test_buffer(count * sizeof *directions, directions);
    cl_mem made = test_buffer(count * sizeof *out, NULL);
    rt_arg args[] = {RT_ARG(count), RT_ARG(m), RT_ARG(b), RT_ARG(wo), RT_ARG(in), RT_ARG(made)};
    test_run(kernel, args, 6, count);
    test_read(made, count * sizeof *out, out);
    rt_buffer_release(test_device(), m);
    rt_buffer_release(test_device(), in);
    rt_buffer_release(test_device(), made);
    rt_kernel_release(kernel);
}

static void direction(float w[4], double z, double turns)
{
    double r = sqrt(fmax(0, 1 - z * z));
    w[0] = (float)(r * cos(2 * PI * turns));
    w[1] = (float)(r * sin(2 * PI * turns));
    w[2] = (float)z;
    w[3] = 0;
}

/* ---- Sampling ---------------------------------------------------------------- */

/* How many of the samples seen at this cosine do not evaluate to what was sampled. */
static int count_far(const rt_material_data *material, boundary b, double cosine)
{
    /* Where facets are steep over a short way, rounding of the direction changes the density. */
    const double near = 2e-6 / (b.alpha * b.alpha) + 1e-3;
    int far = 0;
    sample(material, b, cosine);
    for (int i = 0; i < n; i++) {
        const result *r = results + i;
        double light = (double)r->weight[0] * r->pdf_w;
        if (r->pdf_w == 0)
            continue;
        far += !(fabs(r->pdf_w - r->eval_pdf_w) <= near * r->pdf_w) ||
               !(fabs(light - r->value[0]) <= near * light);
    }
    return far;
}

/* Whatever is sampled evaluates to the same light and the same density, however narrow the lobe. */
static void sampling_and_evaluation_agree(void **state)
{
    static const float alphas[] = {1e-3f, 1e-2f, 0.1f, 0.7f};
    (void)state;
    for (int kind = 0; kind < facet_kinds; kind++)
        for (int a = 0; a < 4; a++)
            for (int c = 1; c < 10; c += 2) {
                const boundary b = {0.3f, 0.6f, alphas[a], c % 4 == 1 ? 1 / 1.5f : 1.5f};
                const rt_material_data material =
                    with_facets(c % 3 ? &plain : &dielectric, kind, alphas[a]);
                const int far = count_far(&material, b, c / 10.0);
                /* At a tenth of alpha from the horizon all is steep. */
                if (far > n / 200)
                    fail_msg("facets %d, alpha %g, cosine %g: %d of %d differ", kind, alphas[a],
                             c / 10.0, far, n);
            }
}

/*
 * By rounding a path may meet a surface along it: what it samples there is light as anywhere else.
 */
static void a_view_along_the_surface_is_finite(void **state)
{
    static const double cosines[] = {0, 1e-38, 1e-30, 1e-20, 1e-9};
    static const float alphas[] = {1e-3f, 0.15f, 1};
    (void)state;
    for (int k = 0; k < 5 * 3 * facet_kinds; k++) {
        const float alpha = alphas[k / 5 % 3];
        const rt_material_data material = with_facets(&dielectric, k / 15, alpha);
        double mean = 0;
        sample(&material, (boundary){0.3f, 0.6f, alpha, k / 5 % 2 ? 1 / 1.5f : 1.5f},
               cosines[k % 5]);
        for (int i = 0; i < n; i++) {
            const result *r = results + i;
            assert_true(isfinite(r->wi[0] + r->wi[1] + r->wi[2]) && isfinite(r->pdf_w));
            assert_true(r->weight[0] >= 0 && r->weight[0] <= 1.001f);
            assert_true(isfinite(r->value[0]) && isfinite(r->eval_pdf_w));
            mean += r->weight[0] / n;
        }
        if (!(mean > 0.1 && mean < 0.901))
            fail_msg("facets %d, alpha %g, cosine %g: reflects and refracts %g of the light",
                     k / 15, alpha, cosines[k % 5], mean);
    }
}

/* ---- Reciprocity -------------------------------------------------------------- */

/*
 * fr is the same both ways; refracted flux is, over the square of the index on the side that it
 * comes from. The density on the way back is that of the way.
 */
static void light_goes_both_ways_alike(void **state)
{
    enum { count = 4096 };
    static float directions[count][4], there[count][4], back[count][4];
    static const float alphas[] = {0.1f, 0.6f};
    const double cosine = 0.6;
    int refracted = 0;
    (void)state;
    for (int i = 0; i < count; i++)
        direction(directions[i], 2 * (i / 64 + 0.5) / 64 - 1, (i % 64 + 0.5) / 64);
    for (int a = 0; a < 2; a++)
        for (int f = 0; f < 2 * facet_kinds; f++) {
            const boundary b = {0.4f, 0.5f, alphas[a], 1 / 1.5f};
            const rt_material_data material =
                with_facets(f % 2 ? &dielectric : &plain, f / 2, alphas[a]);
            evaluate("evaluate_ggx", &material, b, cosine, (const float(*)[4])directions, count,
                     there);
            evaluate("evaluate_back", &material, b, cosine, (const float(*)[4])directions, count,
                     back);
            for (int i = 0; i < count; i++) {
                int through = directions[i][2] < 0;
                double eta_scale = through ? (double)b.eta * b.eta : 1;
                double f1 = there[i][0] / fabs(directions[i][2]) * eta_scale,
                       f2 = back[i][0] / cosine;
                refracted += through && f1 > 0;
                assert_float_equal(f1, f2, 2e-3 * (f1 + f2) + 1e-7);
                assert_float_equal(there[i][3], back[i][3],
                                   2e-3 * (there[i][3] + back[i][3]) + 1e-7);
            }
        }
    assert_true(refracted > 100);
}

/* ---- Values ------------------------------------------------------------------- */

enum { grid = 32 };

/* Directions all over the hemisphere. */
static void make_grid(float directions[grid * grid][4])
{
    for (int i = 0; i < grid * grid; i++)
        direction(directions[i], (i / grid + 0.5) / grid, (i % grid + 0.5) / grid);
}

/* fr |n.wi| = D G2 / (4 n.wo) of a mirror's facets, by the papers' definitions in float64. */
static void facets_reflect_as_the_papers_say(void **state)
{
    static float directions[grid * grid][4], found[grid * grid][4];
    const boundary mirror = {1, 0, 0.3f, 1};
    const double cosine = 0.35;
    float wo[4];
    (void)state;
    make_grid(directions);
    view(wo, cosine);
    const double o[3] = {wo[0], wo[1], wo[2]};
    for (int kind = 0; kind < facet_kinds; kind++) {
        const rt_material_data material = with_facets(&plain, kind, mirror.alpha);
        const microfacets facets = microfacets_of(&material, mirror.alpha);
        evaluate("evaluate_ggx", &material, mirror, cosine, (const float(*)[4])directions,
                 grid * grid, found);
        for (int i = 0; i < grid * grid; i++) {
            const double wi[3] = {directions[i][0], directions[i][1], directions[i][2]};
            double h[3] = {o[0] + wi[0], o[1] + wi[1], o[2] + wi[2]};
            const double length = sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
            for (int c = 0; c < 3; c++)
                h[c] /= length;
            const double expected =
                facet_distribution(&facets, h) * facets_seen_from_both(&facets, o, wi) / (4 * o[2]);
            assert_float_equal(found[i][0], expected, 1e-4 * expected + 1e-7);
        }
    }
}

/* With alpha the same both ways, anisotropic facets are isotropic ones, in all directions. */
static void equal_alphas_are_isotropic(void **state)
{
    static float directions[grid * grid][4], one[grid * grid][4], both[grid * grid][4];
    const boundary mirror = {1, 0, 0.3f, 1};
    (void)state;
    make_grid(directions);
    for (int kind = 0; kind < facet_kinds; kind += 2) {
        rt_material_data alike = with_facets(&plain, kind + 1, mirror.alpha);
        const rt_material_data isotropic = with_facets(&plain, kind, mirror.alpha);
        alike.roughness_v = mirror.alpha;
        evaluate("evaluate_ggx", &isotropic, mirror, 0.5, (const float(*)[4])directions,
                 grid * grid, one);
        evaluate("evaluate_ggx", &alike, mirror, 0.5, (const float(*)[4])directions, grid * grid,
                 both);
        for (int i = 0; i < grid * grid; i++)
            for (int c = 0; c < 4; c++)
                assert_float_equal(both[i][c], one[i][c], 1e-5 * one[i][c] + 1e-9);
    }
}

/* ---- Energy ------------------------------------------------------------------- */

static double kept(const rt_material_data *material, boundary b, double cosine)
{
    double sum = 0;
    sample(material, b, cosine);
    for (int i = 0; i < n; i++)
        sum += results[i].weight[0];
    return sum / n;
}

/* The mean over the hemisphere, by the cosine. */
static double kept_on_average(const rt_material_data *material, boundary b)
{
    enum { steps = 16 };
    double sum = 0;
    for (int i = 0; i < steps; i++)
        sum += kept(material, b, sqrt((i + 0.5) / steps)) / steps;
    return sum;
}

/*
 * No lobe gains; a white metal and clear glass lose what ggx.h states, which is light that met
 * two facets.
 */
static void a_white_furnace_loses_what_meets_two_facets(void **state)
{
    static const struct {
        float alpha;
        /* metal, glass, and glass from inside, each at normal view and on average */
        double loss[6];
    } losses[] = {
        {0.01f, {0, 0, 0, 0, 0, 0}},
        {0.1f, {0.01, 0.03, 0, 0.01, 0.01, 0.03}},
        {0.2f, {0.05, 0.08, 0.01, 0.02, 0.04, 0.10}},
        {0.5f, {0.31, 0.30, 0.03, 0.08, 0.24, 0.30}},
        {1, {0.69, 0.59, 0.10, 0.20, 0.58, 0.52}},
    };
    (void)state;
    for (int i = 0; i < 5; i++) {
        const boundary metal = {1, 0, losses[i].alpha, 1},
                       glass = {0, 1, losses[i].alpha, 1 / 1.5f},
                       inside = {0, 1, losses[i].alpha, 1.5f};
        const double found[6] = {
            kept(&plain, metal, 1),       kept_on_average(&plain, metal),
            kept(&dielectric, glass, 1),  kept_on_average(&dielectric, glass),
            kept(&dielectric, inside, 1), kept_on_average(&dielectric, inside)};
        /* Stated in whole hundredths; the noise is below half of one. */
        for (int k = 0; k < 6; k++)
            if (!(found[k] <= 1 + 1e-6 && fabs(1 - found[k] - losses[i].loss[k]) < 0.01))
                fail_msg("alpha %g: keeps %g, should lose %g", losses[i].alpha, found[k],
                         losses[i].loss[k]);
    }
}

/*
 * At alpha 1 facets are spread by the cosine. Those within 45 degrees of a normal view reflect
 * upwards, and G2 = cos(2 t) / cos^2(t) of it gets away: the integral of 2 tan(t) cos(2 t) is 1 -
 * ln 2.
 */
static void the_roughest_metal_keeps_its_closed_form(void **state)
{
    static double values[n];
    const boundary metal = {1, 0, 1, 1};
    (void)state;
    sample(&plain, metal, 1);
    for (int i = 0; i < n; i++)
        values[i] = results[i].weight[0];
    expect_mean(values, n, 1 - log(2), 1e-6, "rough metal");
}

static void the_narrowest_lobe_is_the_smooth_boundary(void **state)
{
    const boundary narrow = {0, 1, 1e-3f, 1 / 1.5f};
    float wo[4];
    double reflected = 0;
    int far = 0;
    (void)state;
    view(wo, 0.6);
    sample(&dielectric, narrow, 0.6);
    for (int i = 0; i < n; i++) {
        const result *r = results + i;
        int up = r->wi[2] > 0;
        double z = up ? 0.6 : -sqrt(1 - 0.64 / 2.25), scale = up ? -1 : -1 / 1.5;
        double off = hypot(hypot(r->wi[0] - scale * wo[0], r->wi[1] - scale * wo[1]), r->wi[2] - z);
        if (off > 0.3)
            far++;
        else
            assert_float_equal(r->weight[0], 1, 2e-3);
        reflected += up;
    }
    /* A slope beyond 100 alpha has a chance of 1e-4. */
    expect_close(far, 0, 4e-4 * n, "directions far from the smooth one");
    double cos_t = sqrt(1 - 0.64 / 2.25), s = (0.6 - 1.5 * cos_t) / (0.6 + 1.5 * cos_t),
           p = (cos_t - 1.5 * 0.6) / (cos_t + 1.5 * 0.6), r = (s * s + p * p) / 2;
    expect_close(reflected / n, r, 5 * sqrt(r * (1 - r) / n) + 1e-4, "share that is reflected");
}

/* ---- Metals ------------------------------------------------------------------- */

static void reflect(const rt_material_data *material, const float *cosines, uint32_t count,
                    float (*out)[4])
{
    cl_kernel kernel = test_kernel("ggx", "reflect_metal");
    cl_mem m = test_buffer(sizeof *material, material),
           in = test_buffer(count * sizeof *cosines, cosines),
           made = test_buffer(count * sizeof *out, NULL);
    rt_arg args[] = {RT_ARG(count), RT_ARG(m), RT_ARG(in), RT_ARG(made)};
    test_run(kernel, args, 4, count);
    test_read(made, count * sizeof *out, out);
    rt_buffer_release(test_device(), m);
    rt_buffer_release(test_device(), in);
    rt_buffer_release(test_device(), made);
    rt_kernel_release(kernel);
}

/* By complex arithmetic; with n = eta + i k, cos_t n = sqrt(n^2 - sin^2). */
static double metal(double cosine, double eta, double k)
{
    double complex index = eta + k * I, beyond = csqrt(index * index - (1 - cosine * cosine));
    double s = cabs((cosine - beyond) / (cosine + beyond));
    double p = cabs((index * index * cosine - beyond) / (index * index * cosine + beyond));
    return (s * s + p * p) / 2;
}

static void metals_reflect_by_complex_fresnel(void **state)
{
    enum { count = 256 };
    static const rt_material_data metals[] = {{.ks = {1, 1, 1},
                                               .eta = {0.2f, 1, 3},
                                               .k = {3.4f, 7, 0.1f},
                                               .flags = RT_MATERIAL_CONDUCTOR},
                                              {.ks = {1, 1, 1},
                                               .eta = {1.5f, 0.05f, 100},
                                               .k = {0, 4, 100},
                                               .flags = RT_MATERIAL_CONDUCTOR}};
    float cosines[count], out[count][4];
    (void)state;
    for (int i = 0; i < count; i++)
        cosines[i] = (float)(i + 1) / count;
    for (int m = 0; m < 2; m++) {
        reflect(&metals[m], cosines, count, out);
        for (int i = 0; i < count; i++)
            for (int c = 0; c < 3; c++)
                assert_float_equal(out[i][c], metal(cosines[i], metals[m].eta[c], metals[m].k[c]),
                                   3e-6);
    }
}

/* Schlick 1994; within 3 % of the exact reflectance of gold, and 1 when grazing. */
static void metals_reflect_by_their_colour(void **state)
{
    enum { count = 256 };
    static const rt_material_data tinted = {.ks = {0.9f, 0.5f, 0},
                                            .flags = RT_MATERIAL_CONDUCTOR | RT_MATERIAL_SCHLICK};
    float cosines[count], out[count][4];
    (void)state;
    for (int i = 0; i < count; i++)
        cosines[i] = (float)(i + 1) / count;
    reflect(&tinted, cosines, count, out);
    for (int i = 0; i < count; i++)
        for (int c = 0; c < 3; c++)
            assert_float_equal(out[i][c],
                               tinted.ks[c] + (1 - tinted.ks[c]) * pow(1 - cosines[i], 5), 1e-6);
    const double gold = metal(1, 0.17, 3.14);
    for (double cosine = 0.1; cosine <= 1; cosine += 0.1)
        assert_float_equal(metal(cosine, 0.17, 3.14), gold + (1 - gold) * pow(1 - cosine, 5), 0.03);
}

/*
 * At normal view: aluminium, gold and silver in the middle of the spectrum, red for gold, from
 * handbooks' n and k.
 */
static void known_metals_have_their_reflectance(void **state)
{
    static const rt_material_data metals = {.ks = {1, 1, 1},
                                            .eta = {0.96f, 0.17f, 0.06f},
                                            .k = {6.69f, 3.14f, 3.59f},
                                            .flags = RT_MATERIAL_CONDUCTOR};
    static const float one = 1;
    float out[1][4];
    (void)state;
    reflect(&metals, &one, 1, out);
    assert_float_equal(out[0][0], 0.92, 0.01);
    assert_float_equal(out[0][1], 0.94, 0.01);
    assert_float_equal(out[0][2], 0.98, 0.01);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sampling_and_evaluation_agree),
        cmocka_unit_test(a_view_along_the_surface_is_finite),
        cmocka_unit_test(light_goes_both_ways_alike),
        cmocka_unit_test(facets_reflect_as_the_papers_say),
        cmocka_unit_test(equal_alphas_are_isotropic),
        cmocka_unit_test(a_white_furnace_loses_what_meets_two_facets),
        statistical_test(the_roughest_metal_keeps_its_closed_form),
        statistical_test(the_narrowest_lobe_is_the_smooth_boundary),
        cmocka_unit_test(metals_reflect_by_complex_fresnel),
        cmocka_unit_test(metals_reflect_by_their_colour),
        cmocka_unit_test(known_metals_have_their_reflectance),
    };
    return cmocka_run_group_tests_name("kernels/ggx", tests, NULL, NULL);
}
