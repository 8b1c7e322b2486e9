/*
 * test_vcm.c - the MIS weights of vertex connection and merging against the densities of all
 * techniques, written out: for random paths of up to seven segments, delta events among them, each
 * weight is what the power heuristic says, and together they are 1. What a path carries on from a
 * surface of several lobes.
 */
#include "support.h"

#include <math.h>
#include <stdlib.h>

#include "bsdf_draw.h"
#include "types.h"

enum { PATHS = 100000, LONGEST = 6, VERTICES = 8, WEIGHTS = 16 };

/* Weights: of emission, light sampling, joining vertices i and i + 1, the camera, merging at i. */
enum { EMISSION = 0, NEE = 1, JOIN = 1, CAMERA = 7, MERGE = 8 };

/* As in vcm.cl. */
typedef struct light_of_path {
    uint32_t length, delta;
    float camera, emit, light, reserved[3];
    float distance[VERTICES], near_cosine[VERTICES], far_cosine[VERTICES];
    float to_light[VERTICES], to_camera[VERTICES];
} light_of_path;

static uint32_t state_of_random = 1;

static double uniform(double low, double high)
{
    state_of_random = state_of_random * 1664525u + 1013904223u;
    return low + (high - low) * (state_of_random >> 8) * 0x1p-24;
}

/* Over two orders of magnitude. */
static float density(void)
{
    return (float)exp(uniform(-2.3, 2.3));
}

/* A path whose lengths are `scale` times those of about 1 m. */
static light_of_path random_path(uint32_t length, float scale)
{
    const float per_area = 1 / (scale * scale);
    light_of_path p = {.length = length,
                       .camera = density() * per_area,
                       .emit = density() * per_area,
                       .light = density()};
    for (uint32_t i = 1; i < length; i++)
        p.delta |= (uint32_t)(uniform(0, 1) < 0.3) << i;
    for (int i = 0; i < VERTICES; i++) {
        p.distance[i] = scale * (float)uniform(0.3, 3);
        p.near_cosine[i] = (float)uniform(0.05, 1);
        p.far_cosine[i] = (float)uniform(0.05, 1);
        p.to_light[i] = density();
        p.to_camera[i] = density();
    }
    return p;
}

static int is_delta(const light_of_path *p, uint32_t i)
{
    return p->delta >> i & 1;
}

/* The density over area with which the camera path samples vertices 1 to n. */
static double camera_density(const light_of_path *p, uint32_t n)
{
    double pdf = 1;
    for (uint32_t i = 1; i <= n; i++) {
        const double d = p->distance[i];
        double w = i == 1 ? p->camera * d * d : p->to_light[i - 1];
        /* A delta event has a probability per projected solid angle of the one direction. */
        if (i > 1 && is_delta(p, i - 1))
            w *= p->far_cosine[i - 1];
        pdf *= w * p->near_cosine[i] / (d * d);
    }
    return pdf;
}

/* The same of the light path, from the light to vertex n. */
static double light_density(const light_of_path *p, uint32_t n)
{
    double pdf = 1;
    for (uint32_t i = p->length - 1; i >= n && i >= 1; i--) {
        const double d = p->distance[i + 1];
        double w = i == p->length - 1 ? p->emit : p->to_camera[i + 1];
        if (i < p->length - 1 && is_delta(p, i + 1))
            w *= p->near_cosine[i + 1];
        pdf *= w * p->far_cosine[i] / (d * d);
    }
    return pdf;
}

/* The densities of all techniques that are used, times their number of samples. */
static void densities(double out[WEIGHTS], const light_of_path *p, const rt_vcm_params *vcm)
{
    const uint32_t k = p->length, last = k - 1;
    const double n = vcm->light_paths, d = p->distance[k];
    for (int i = 0; i < WEIGHTS; i++)
        out[i] = 0;
    if (vcm->techniques & RT_TECHNIQUE_EMISSION)
        out[EMISSION] = camera_density(p, k);
    if ((vcm->techniques & RT_TECHNIQUE_NEE) && k > 1 && !is_delta(p, last))
        out[NEE] = camera_density(p, last) * p->light * p->near_cosine[k] / (d * d);
    if ((vcm->techniques & RT_TECHNIQUE_CAMERA) && k > 1 && !is_delta(p, 1))
        out[CAMERA] = n * light_density(p, 1);
    for (uint32_t i = 1; i < last && (vcm->techniques & RT_TECHNIQUE_CONNECTION); i++)
        if (!is_delta(p, i) && !is_delta(p, i + 1))
            out[JOIN + i] = camera_density(p, i) * light_density(p, i + 1);
    for (uint32_t i = 1; i < k && (vcm->techniques & RT_TECHNIQUE_MERGING); i++)
        if (!is_delta(p, i))
            out[MERGE + i] = n * 3.14159265358979 * vcm->radius * vcm->radius *
                             camera_density(p, i) * light_density(p, i);
}

/* Fails unless the weights are those of the power heuristic. */
static void expect_weights(const light_of_path *p, const rt_vcm_params *vcm, const float *weights)
{
    double pdf[WEIGHTS], squares = 0, sum = 0;
    densities(pdf, p, vcm);
    for (int i = 0; i < WEIGHTS; i++)
        squares += pdf[i] * pdf[i];
    for (int i = 0; i < WEIGHTS; i++)
        if (pdf[i] > 0) {
            const double expected = pdf[i] * pdf[i] / squares;
            assert_float_equal(weights[i], expected, 2e-5);
            sum += weights[i];
        }
    if (squares > 0)
        assert_float_equal(sum, 1, 1e-4);
}

static void weights_are_those_of_all_densities(void **state)
{
    static const uint32_t sets[] = {31, 15, 3, 17, 16, 8, 4, 12, 23, 30, 31, 31};
    static const float scales[] = {1, 1e10f, 1e-10f}; /* all of them with all techniques */
    light_of_path *paths = malloc(PATHS * sizeof *paths);
    float *weights = malloc(PATHS * WEIGHTS * sizeof *weights);
    const uint32_t count = PATHS / (sizeof sets / sizeof *sets);
    (void)state;
    assert_non_null(paths);
    assert_non_null(weights);
    cl_kernel kernel = test_kernel("vcm", "weigh");
    for (size_t s = 0; s < sizeof sets / sizeof *sets; s++) {
        const float scale = scales[s % (sizeof scales / sizeof *scales)];
        const rt_vcm_params vcm = {.techniques = sets[s],
                                   .light_paths = 100,
                                   .radius = 0.04f * scale,
                                   .unit = ldexpf(1, ilogbf(scale))};
        for (uint32_t i = 0; i < count; i++)
            paths[i] = random_path(1 + i % LONGEST, scale);
        cl_mem in = test_buffer(count * sizeof *paths, paths),
               out = test_buffer(count * WEIGHTS * sizeof *weights, NULL);
        rt_arg args[] = {RT_ARG(count), RT_ARG(vcm), RT_ARG(in), RT_ARG(out)};
        test_run(kernel, args, 4, count);
        test_read(out, count * WEIGHTS * sizeof *weights, weights);
        for (uint32_t i = 0; i < count; i++)
            expect_weights(paths + i, &vcm, weights + (size_t)i * WEIGHTS);
        rt_buffer_release(test_device(), in);
        rt_buffer_release(test_device(), out);
    }
    rt_kernel_release(kernel);
    free(paths);
    free(weights);
}

/* Whichever lobe is chosen: less noise, and the density by which the path has its MIS weights. */
static void a_path_carries_the_light_of_all_lobes(void **state)
{
    enum { EVENTS = 4096 };
    static vertex_draw made[EVENTS];
    const rt_material_data gloss = {
        .kd = {0.3f, 0.2f, 0.1f}, .ks = {0.2f, 0.4f, 0.3f}, .roughness = 0.3f, .ior = 1};
    const situation at = {
        {0, 0, 1, 0}, {0, 0, 1, 0}, {0.76604444f, 0, 0.64278761f}, 1, {1, 1, 1}, 1};
    int chosen[2] = {0, 0};
    (void)state;
    for (uint32_t transport = carry_radiance; transport <= carry_flux; transport++) {
        draw_vertex_scatter(&gloss, &at, transport, 3, EVENTS, made);
        for (int i = 0; i < EVENTS; i++) {
            if (made[i].lobe < 0 || made[i].pdf_w <= 0)
                continue;
            chosen[is_diffuse((int)made[i].lobe)]++;
            for (int c = 0; c < 3; c++)
                assert_float_equal(made[i].weight[c] * made[i].pdf_w, made[i].value[c],
                                   1e-5 * made[i].value[c]);
        }
    }
    assert_true(chosen[0] > EVENTS / 4 && chosen[1] > EVENTS / 4);
}

/* Only `make proof` runs it, which takes minutes; each other test kernel is run by a test. */
static void the_program_of_the_proof_of_weights_is_built(void **state)
{
    (void)state;
    rt_kernel_release(test_kernel("vcm_sums", "vcm_sums"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(weights_are_those_of_all_densities),
        cmocka_unit_test(a_path_carries_the_light_of_all_lobes),
        cmocka_unit_test(the_program_of_the_proof_of_weights_is_built),
    };
    return cmocka_run_group_tests_name("kernels/vcm", tests, NULL, NULL);
}
