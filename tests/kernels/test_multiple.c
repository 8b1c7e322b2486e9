/*
 * test_multiple.c - light that meets more than one facet: rough metal and glass in a white furnace,
 * sampling against evaluation and density, reciprocity, and the colour of what is scattered often.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "kernels/facet_material.h"
#include "kernels/statistics.h"
#include "pack/facet_loss.h"

#define PI 3.14159265358979323846

enum { points = 3 << 14, n = 1 << 14 };

typedef struct boundary {
    float ks, kt, alpha, eta;
} boundary;

typedef struct result {
    float wi[3], pdf_w;
    float weight[3], unused;
    float value[3], eval_pdf_w;
} result;

static result results[n];
static float weights[points];

static void view(float wo[4], double cosine, double turn)
{
    const double sine = sqrt(1 - cosine * cosine);
    wo[0] = (float)(sine * cos(turn));
    wo[1] = (float)(sine * sin(turn));
    wo[2] = (float)cosine;
    wo[3] = 0;
}

/* ---- A white furnace ----------------------------------------------------------------- */

static double albedo(const facet_material *m, boundary b, double cosine, double turn)
{
    /* Smoother facets lose less, with less noise. */
    const uint32_t count = b.alpha < 0.5f ? points / 3 : points;
    float wo[4];
    double sum = 0;
    view(wo, cosine, turn);
    cl_kernel kernel = test_kernel("ggx", "weigh_ggx");
    cl_mem material = test_buffer(m->bytes, m->data), out = test_output(sizeof weights, weights);
    rt_arg args[] = {RT_ARG(count), RT_ARG(material), RT_ARG(b), RT_ARG(wo), RT_ARG(out)};
    test_run(kernel, args, 5, count);
    test_read(out, count * sizeof *weights, weights);
    rt_buffer_release(test_device(), material);
    rt_buffer_release(test_device(), out);
    rt_kernel_release(kernel);
    for (uint32_t i = 0; i < count; i++)
        sum += weights[i];
    return sum / count;
}

/* Of clear glass of this index, or of white metal where it is 0. */
static rt_material white(float ior, float alpha, rt_distribution distribution)
{
    rt_material m = {.roughness = alpha, .distribution = distribution};
    for (int c = 0; c < 3; c++)
        *(ior > 0 ? m.kt + c : m.ks + c) = 1;
    m.ior = ior;
    m.fresnel = ior > 0 ? RT_FRESNEL_DIELECTRIC : RT_FRESNEL_OFF;
    return m;
}

/* Seen from the side of index eta over that of the other; 0: white metal. */
static void expect_white(const facet_material *m, float alpha, float eta, double cosine,
                         double turn, const char *what)
{
    const boundary b = {eta > 0 ? 0 : 1, eta > 0 ? 1 : 0, alpha, eta > 0 ? eta : 1};
    const double found = albedo(m, b, cosine, turn);
    if (!(fabs(found - 1) <= 0.005))
        fail_msg("%s of roughness %g, eta %g, cosine %g, turn %g: albedo %.4f", what, alpha, eta,
                 cosine, turn, found);
}

/* The table of theory.md: what each keeps by single scattering, at cosines of 0.2 and 0.8. */
static const struct {
    float ior;
    int is_inside;
    float alpha;
    double ggx[2], beckmann[2];
} table[] = {
    {0, 0, 0.1f, {0.905, 0.985}, {0.951, 1.000}},
    {0, 0, 0.3f, {0.839, 0.856}, {0.911, 0.983}},
    {0, 0, 1, {0.642, 0.351}, {0.907, 0.592}},
    {1.1f, 0, 0.1f, {0.960, 0.998}, {0.980, 1.000}},
    {1.1f, 0, 0.3f, {0.868, 0.986}, {0.961, 1.000}},
    {1.1f, 0, 1, {0.651, 0.887}, {0.773, 0.983}},
    {1.1f, 1, 0.1f, {0.854, 0.993}, {0.950, 1.000}},
    {1.1f, 1, 0.3f, {0.613, 0.946}, {0.683, 0.995}},
    {1.1f, 1, 1, {0.486, 0.770}, {0.496, 0.871}},
    {1.5f, 0, 0.1f, {0.952, 0.998}, {0.971, 1.000}},
    {1.5f, 0, 0.3f, {0.903, 0.979}, {0.951, 0.998}},
    {1.5f, 0, 1, {0.704, 0.833}, {0.877, 0.950}},
    {1.5f, 1, 0.1f, {0.894, 0.979}, {0.951, 1.000}},
    {1.5f, 1, 0.3f, {0.767, 0.851}, {0.910, 0.981}},
    {1.5f, 1, 1, {0.495, 0.471}, {0.615, 0.670}},
    {2.4f, 0, 0.1f, {0.950, 0.996}, {0.970, 1.000}},
    {2.4f, 0, 0.3f, {0.908, 0.963}, {0.949, 0.996}},
    {2.4f, 0, 1, {0.718, 0.741}, {0.921, 0.900}},
    {2.4f, 1, 0.1f, {0.902, 0.982}, {0.951, 1.000}},
    {2.4f, 1, 0.3f, {0.823, 0.840}, {0.911, 0.971}},
    {2.4f, 1, 1, {0.600, 0.354}, {0.863, 0.596}},
};

static void expect_row(int i, rt_distribution distribution, const double kept[2], const char *what)
{
    const float alpha = table[i].alpha, ior = table[i].ior;
    const float eta = ior == 0 ? 0 : table[i].is_inside ? ior : 1 / ior;
    const rt_material m = white(ior, alpha, distribution);
    const facet_material packed = facet_material_of(&m, 1);
    const rt_facets facets = {alpha, alpha, distribution == RT_DISTRIBUTION_BECKMANN, eta, 0};
    for (int c = 0; c < 2; c++) {
        const double cosine = c ? 0.8 : 0.2;
        assert_float_equal(1 - rt_facet_loss(&facets, cosine, 0), kept[c], 0.002);
        expect_white(&packed, alpha, eta, cosine, 0.6, what);
    }
    free(packed.data);
}

static void white_is_white(void **state)
{
    (void)state;
    for (int i = 0; i < (int)(sizeof table / sizeof *table); i++) {
        expect_row(i, RT_DISTRIBUTION_GGX, table[i].ggx, "GGX");
        expect_row(i, RT_DISTRIBUTION_BECKMANN, table[i].beckmann, "Beckmann");
    }
}

static void white_is_white_in_all_directions(void **state)
{
    static const float alphas[][2] = {{0.1f, 0.5f}, {0.6f, 0.2f}, {0.3f, 0.3f}};
    (void)state;
    for (int a = 0; a < 3; a++) {
        rt_material m = white(0, alphas[a][0], RT_DISTRIBUTION_GGX);
        m.roughness_v = alphas[a][1];
        const facet_material packed = facet_material_of(&m, 1);
        for (int turn = 0; turn < 3; turn++)
            for (int c = 2; c < 10; c += 6)
                expect_white(&packed, alphas[a][0], 0, c / 10.0, turn * PI / 5, "brushed");
        free(packed.data);
    }
}

static void textured_roughness_is_white(void **state)
{
    static const float alphas[] = {0.06f, 0.23f, 0.41f, 0.7f};
    rt_material metal = white(0, 0.75f, RT_DISTRIBUTION_GGX);
    (void)state;
    metal.roughness_texture = 1;
    const facet_material packed = facet_material_of(&metal, 1);
    for (int a = 0; a < 4; a++)
        for (int c = 2; c < 10; c += 6)
            expect_white(&packed, alphas[a], 0, c / 10.0, 0.6, "textured");
    free(packed.data);
}

/* Glass that lies in water, seen from both. */
static void glass_in_water_is_white(void **state)
{
    const rt_material both[] = {white(1.5f, 0.4f, RT_DISTRIBUTION_GGX),
                                white(1.33f, 0.1f, RT_DISTRIBUTION_GGX)};
    const facet_material packed = facet_material_of(both, 2);
    (void)state;
    expect_white(&packed, 0.4f, 1.33f / 1.5f, 0.3, 0.6, "from water, glass");
    expect_white(&packed, 0.4f, 1.5f / 1.33f, 0.3, 0.6, "towards water, glass");
    free(packed.data);
}

/* ---- Single scattering, and colour ------------------------------------------------------ */

/* At normal view facets of GGX of alpha 1 lose ln 2. */
static void what_is_lost_has_the_colour_of_two_facets_or_more(void **state)
{
    enum { steps = 64 };
    const rt_facets facets = {1, 1, 0, 0, 0};
    rt_material m = white(0, 1, RT_DISTRIBUTION_GGX);
    double left = 1;
    (void)state;
    for (int i = 0; i < steps; i++)
        left -= rt_facet_loss(&facets, sqrt((i + 0.5) / steps), 0) / steps;
    const facet_material often = facet_material_of(&m, 1);
    const boundary grey = {0.5f, 0, 1, 1};
    const double colour = 0.25 * left / (1 - 0.5 * (1 - left));
    expect_close(albedo(&often, grey, 1, 0), 0.5 * (1 - log(2)) + colour * log(2), 2e-3, "grey");
    m.facet_scattering = RT_FACET_SCATTERING_SINGLE;
    const facet_material once = facet_material_of(&m, 1);
    assert_int_equal(once.data->facet_losses, 0);
    expect_close(albedo(&once, grey, 1, 0), 0.5 * (1 - log(2)), 2e-3, "grey that scatters once");
    free(often.data);
    free(once.data);
}

/* ---- Sampling, evaluation, density ------------------------------------------------------ */

static void sample(const facet_material *m, boundary b, double cosine, uint32_t seed)
{
    const uint32_t count = n;
    float wo[4];
    view(wo, cosine, 0.6);
    cl_kernel kernel = test_kernel("ggx", "sample_ggx");
    cl_mem material = test_buffer(m->bytes, m->data), out = test_buffer(sizeof results, NULL);
    rt_arg args[] = {RT_ARG(seed), RT_ARG(count), RT_ARG(material),
                     RT_ARG(b),    RT_ARG(wo),    RT_ARG(out)};
    test_run(kernel, args, 6, n);
    test_read(out, sizeof results, results);
    rt_buffer_release(test_device(), material);
    rt_buffer_release(test_device(), out);
    rt_kernel_release(kernel);
}

static void evaluate(const char *name, const facet_material *m, boundary b, double cosine,
                     const float (*directions)[4], uint32_t count, float (*out)[4])
{
    float wo[4];
    view(wo, cosine, 0.6);
    cl_kernel kernel = test_kernel("ggx", name);
    cl_mem material = test_buffer(m->bytes, m->data),
           in = test_buffer(count * sizeof *directions, directions),
           made = test_buffer(count * sizeof *out, NULL);
    rt_arg args[] = {RT_ARG(count), RT_ARG(material), RT_ARG(b),
                     RT_ARG(wo),    RT_ARG(in),       RT_ARG(made)};
    test_run(kernel, args, 6, count);
    test_read(made, count * sizeof *out, out);
    rt_buffer_release(test_device(), material);
    rt_buffer_release(test_device(), in);
    rt_buffer_release(test_device(), made);
    rt_kernel_release(kernel);
}

static const struct {
    float ior, alpha, eta;
    rt_distribution distribution;
    double cosine;
} views[] = {{0, 0.5f, 1, RT_DISTRIBUTION_GGX, 0.4},
             {0, 1, 1, RT_DISTRIBUTION_BECKMANN, 0.8},
             {1.5f, 0.6f, 1 / 1.5f, RT_DISTRIBUTION_GGX, 0.5},
             {1.5f, 0.8f, 1.5f, RT_DISTRIBUTION_GGX, 0.7}};
enum { view_count = 4 };

static facet_material material_of_view(int i, boundary *b)
{
    const rt_material m = white(views[i].ior, views[i].alpha, views[i].distribution);
    *b = (boundary){views[i].ior > 0 ? 0 : 1, views[i].ior > 0 ? 1 : 0, views[i].alpha,
                    views[i].eta};
    return facet_material_of(&m, 1);
}

static void sampling_and_evaluation_agree(void **state)
{
    (void)state;
    for (int v = 0; v < view_count; v++) {
        boundary b;
        const facet_material m = material_of_view(v, &b);
        sample(&m, b, views[v].cosine, test_seed(5));
        for (int i = 0; i < n; i++) {
            const result *r = results + i;
            if (r->pdf_w == 0)
                continue;
            assert_float_equal(r->pdf_w, r->eval_pdf_w, 2e-3 * r->pdf_w);
            assert_float_equal(r->weight[0] * r->pdf_w, r->value[0], 2e-3 * r->value[0]);
        }
        free(m.data);
    }
}

enum { cells = 16, fine = 16, side = cells * fine };

/* Those of a sphere: cells of its cosine and turn, each of fine x fine directions. */
static void make_directions(float out[side * side][4])
{
    for (int i = 0; i < side * side; i++)
        view(out[i], 0, 2 * PI * (i % side + 0.5) / side);
    for (int i = 0; i < side * side; i++) {
        const double z = 2 * (i / side + 0.5) / side - 1, sine = sqrt(1 - z * z);
        out[i][0] *= (float)sine;
        out[i][1] *= (float)sine;
        out[i][2] = (float)z;
    }
}

static void directions_come_by_their_density(void **state)
{
    static float directions[side * side][4], found[side * side][4];
    (void)state;
    make_directions(directions);
    for (int k = 0; k < 3 * view_count; k++) {
        const int v = k / 3;
        uint32_t counts[cells * cells + 1] = {0};
        double expected[cells * cells + 1] = {0}, rest = n;
        boundary b;
        const facet_material m = material_of_view(v, &b);
        evaluate("evaluate_ggx", &m, b, views[v].cosine, (const float(*)[4])directions, side * side,
                 found);
        for (int i = 0; i < side * side; i++) {
            const double part = n * found[i][3] * 4 * PI / (side * side);
            expected[i / side / fine * cells + i % side / fine] += part;
            rest -= part;
        }
        expected[cells * cells] = rest; /* lost below the surface */
        sample(&m, b, views[v].cosine, test_seed(6 + (uint32_t)k % 3));
        for (int i = 0; i < n; i++) {
            const float *w = results[i].wi;
            const double turn = atan2(w[1], w[0]) / (2 * PI);
            const int z = (int)fmin((w[2] + 1) / 2 * cells, cells - 1),
                      x = (int)fmin((turn < 0 ? turn + 1 : turn) * cells, cells - 1);
            counts[results[i].pdf_w > 0 ? z * cells + x : cells * cells]++;
        }
        expect_counts(counts, expected, cells * cells + 1, "directions of rough facets");
        free(m.data);
    }
}

static void light_goes_both_ways_alike(void **state)
{
    static float directions[side * side][4], there[side * side][4], back[side * side][4];
    (void)state;
    make_directions(directions);
    for (int v = 0; v < view_count; v++) {
        boundary b;
        const facet_material m = material_of_view(v, &b);
        const double cosine = views[v].cosine;
        evaluate("evaluate_ggx", &m, b, cosine, (const float(*)[4])directions, side * side, there);
        evaluate("evaluate_back", &m, b, cosine, (const float(*)[4])directions, side * side, back);
        for (int i = 0; i < side * side; i++) {
            const double scale = directions[i][2] < 0 ? (double)b.eta * b.eta : 1;
            const double f1 = there[i][0] / fabs(directions[i][2]) * scale,
                         f2 = back[i][0] / cosine;
            assert_true(f1 > 0 || (b.kt == 0 && directions[i][2] < 0));
            assert_float_equal(f1, f2, 2e-3 * (f1 + f2));
            assert_float_equal(there[i][3], back[i][3], 2e-3 * (there[i][3] + back[i][3]));
        }
        free(m.data);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(white_is_white),
        cmocka_unit_test(white_is_white_in_all_directions),
        cmocka_unit_test(textured_roughness_is_white),
        cmocka_unit_test(glass_in_water_is_white),
        statistical_test(what_is_lost_has_the_colour_of_two_facets_or_more),
        cmocka_unit_test(sampling_and_evaluation_agree),
        statistical_test(directions_come_by_their_density),
        cmocka_unit_test(light_goes_both_ways_alike),
    };
    return cmocka_run_group_tests_name("kernels/multiple", tests, NULL, NULL);
}
