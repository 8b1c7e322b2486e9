/*
 * test_weights.c - the MIS weights of mode vcm on paths that its kernels follow through scenes:
 * those of all techniques that could have made a path add up to 1.
 *
 * No part of `make check`: the kernel is that of the whole mode once more, and takes long to
 * compile. tests/kernels/test_vcm.c has the weights of paths that are made up.
 */
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "photon/light_sources.h"
#include "proof/page.h"
#include "proof/proof.h"
#include "proof/vcm_scenes.h"
#include "render/renderer.h"

enum { width = 12, height = 8, longest = 6, paths_least = 100000, items = 1 << 18 };

/* As vcm_sums.cl writes it. */
typedef struct path_sum {
    float weights, techniques;
} path_sum;

/* What the paths of a scene had. */
typedef struct found {
    uint64_t paths, of_length[longest], techniques;
    uint64_t grazing; /* left out: along a surface weights are those of a larger cosine */
    uint64_t rounded; /* of vertices that were stored: along a surface rounding shows */
    double worst;
} found;

static void take(found *f, const path_sum *sums, const char *scene, uint32_t techniques,
                 rt_u32 is_stored)
{
    for (size_t i = 0; i < (size_t)items * longest * 2; i++) {
        const path_sum *sum = sums + i;
        if (sum->techniques == 0.0f)
            continue;
        if (sum->techniques < 0.0f) {
            f->grazing++;
            continue;
        }
        const double off = fabs(sum->weights - 1.0);
        f->rounded += is_stored && !(off <= 1e-4);
        if (!(off <= (is_stored ? 1e-2 : 1e-4)))
            fail_msg("%s, techniques %u, path %zu of %zu segments: %g weights are together %.8g",
                     scene, techniques, i / 2 / longest, i / 2 % longest + 1,
                     (double)sum->techniques, (double)sum->weights);
        f->worst = fmax(f->worst, off);
        f->paths++;
        f->of_length[i / 2 % longest]++;
        f->techniques += (uint64_t)sum->techniques;
    }
}

/* Follows paths by the kernel, with these techniques and light vertices that were stored or not. */
static void follow(found *f, rt_renderer *renderer, const char *scene, uint32_t techniques,
                   rt_u32 is_stored)
{
    const size_t bytes = (size_t)items * longest * 2 * sizeof(path_sum);
    const rt_render_options options = {
        .width = width, .height = height, .max_depth = longest, .roulette_depth = 1000};
    rt_vcm_params vcm = {
        .techniques = techniques, .light_paths = width * height, .radius = 0.05f, .unit = 1};
    rt_params params = rt_params_make(&options);
    rt_light_sources lights;
    rt_error error;
    path_sum *sums = malloc(bytes);
    assert_non_null(sums);
    expect_ok(rt_renderer_aim(renderer, &options, &error), &error);
    expect_ok(rt_light_sources_read(&lights, test_device(), renderer->scene, NULL, 0, &error),
              &error);
    params.item_count = items;
    params.sample_count = 1;
    cl_mem shares = test_buffer(lights.light_count * sizeof *lights.shares, lights.shares),
           stores = test_buffer(items * sizeof(rt_light_vertex), NULL),
           out = test_buffer(bytes, NULL);
    cl_kernel kernel = test_kernel("vcm_sums", "vcm_sums");
    rt_arg args[] = {RT_ARG(params),    RT_ARG(renderer->scene), RT_ARG(vcm), RT_ARG(shares),
                     RT_ARG(is_stored), RT_ARG(stores),          RT_ARG(out)};
    test_run(kernel, args, 7, items);
    test_read(out, bytes, sums);
    take(f, sums, scene, techniques, is_stored);
    rt_kernel_release(kernel);
    rt_buffer_release(test_device(), shares);
    rt_buffer_release(test_device(), stores);
    rt_buffer_release(test_device(), out);
    rt_light_sources_free(&lights);
    free(sums);
}

/*
 * The same of vertices that went through the store. Its directions are good to 5e-7, so that
 * few weights are off by more than 1e-4 where a direction is within 1e-3 of a surface.
 */
static void expect_one_when_stored(rt_renderer *renderer, const char *scene)
{
    found f = {0};
    follow(&f, renderer, scene, 31, 1);
    follow(&f, renderer, scene, RT_TECHNIQUE_EMISSION | RT_TECHNIQUE_MERGING, 1);
    assert_true(f.paths >= 2 * paths_least);
    assert_true(f.rounded < f.paths / 50000);
    page_row(proof_text("%s, vertices of light paths that were stored: likewise\n ", scene),
             proof_text("%.0f paths: off by %.1e at most, %.0f of them by more than 1e-4",
                        (double)f.paths, f.worst, (double)f.rounded));
}

/* With a camera that sees lights, too, in place of the first line of the text. */
static void expect_one(const char *scene, const char *camera, const char *text)
{
    static const uint32_t sets[] = {31, 15, RT_TECHNIQUE_EMISSION | RT_TECHNIQUE_NEE,
                                    RT_TECHNIQUE_EMISSION | RT_TECHNIQUE_MERGING,
                                    RT_TECHNIQUE_EMISSION | RT_TECHNIQUE_CAMERA |
                                        RT_TECHNIQUE_CONNECTION};
    found f = {0};
    rt_renderer *renderer = test_renderer(proof_text("%s%s", camera, strchr(text, '\n')));
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) {
        const found before = f;
        follow(&f, renderer, scene, sets[i], 0);
        assert_true(f.paths - before.paths >= paths_least);
    }
    for (int i = 0; i < longest; i++)
        assert_true(f.of_length[i] > 1000);
    assert_true(f.grazing < 10);
    page_row(proof_text("%s, paths that are followed: weights of all techniques are 1\n ", scene),
             proof_text("%.0f paths of 1 to %d segments by %.1f techniques: off by %.1e at most, "
                        "without %.0f grazing ones",
                        (double)f.paths, longest, (double)f.techniques / (double)f.paths, f.worst,
                        (double)f.grazing));
    expect_one_when_stored(renderer, scene);
    rt_renderer_destroy(renderer);
}

static void weights_of_a_path_add_up_to_one(void **state)
{
    (void)state;
    expect_one("diffuse room", "camera { eye 0 0.9 -0.95  look_at 0 1 0.6  fov 90 }", vcm_diffuse);
    expect_one("glass over a glossy floor",
               "camera { eye 0 0.5 -0.95  look_at 0 0.8 0.6  fov 100 }", vcm_glass);
    expect_one("sky and lens",
               "camera { eye 0 3 0.5  look_at 0 0 0  up 0 0 -1  fov 80  aperture 0.3  "
               "focal_distance 1.5 }",
               vcm_lens);
    expect_one("sky beyond portals, and lens",
               "camera { eye 0 3 0.5  look_at 0 0 0  up 0 0 -1  fov 80  aperture 0.3  "
               "focal_distance 1.5 }",
               proof_text("%s%s", vcm_lens, vcm_portals));
    expect_one("cube of smooth normals", "camera { eye 0 0.9 -0.95  look_at 0 1 0.6  fov 90 }",
               proof_text(vcm_leaning, SMOOTH_CUBE("gloss")));
    expect_one("frosted sphere of 32 smooth triangles",
               "camera { eye 0 0.9 -0.95  look_at 0 1 0.6  fov 90 }",
               proof_text(vcm_leaning, SMOOTH_BALL("frosted")));
    expect_one("sphere of 32 smooth triangles of glass",
               "camera { eye 0 0.9 -0.95  look_at 0 1 0.6  fov 90 }",
               proof_text(vcm_leaning, SMOOTH_BALL("clear")));
    proof_page("Weights of mode vcm");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(weights_of_a_path_add_up_to_one)};
    return cmocka_run_group_tests_name("proof/weights", tests, NULL, NULL);
}
