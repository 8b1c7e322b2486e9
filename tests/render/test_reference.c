/*
 * The reference scenes against the renders of an independent renderer: linear radiance agrees block
 * by block, by the rule of rt_image_compare, in path and in photon mode. The page of the proof has
 * a section of it.
 *
 * RT_REFERENCE names the directory that holds box_point.exr, box_area.exr and box_caustic.exr,
 * 256x256. Without it the program fails: it is run by a target of its own. The signed differences
 * are left as .exr files in the directory that RT_REFERENCE_OUT names, if it is set.
 */
#include <stdio.h>
#include <stdlib.h>

#include "proof/page.h"
#include "support.h"

#define RENDERS_MAX 8

/* What is rendered, and how far it may be off. */
typedef struct reference_case {
    const char *scene;
    rt_mode mode;
    uint32_t spp;
    /* independent ones, of seeds 1, 2, ...: more than one where pixels share photons */
    uint32_t renders;
    uint64_t photons;
    uint32_t k;
    double tolerance;
} reference_case;

static const reference_case cases[] = {
    {"box_point", RT_MODE_PATH, 512, 1, 0, 0, 0.01},
    {"box_area", RT_MODE_PATH, 512, 1, 0, 0, 0.01},
    {"box_caustic", RT_MODE_PATH, 2048, 1, 0, 0, 0.02},
    {"box_point", RT_MODE_PHOTON, 32, 4, 8000000, 40, 0.01},
    {"box_area", RT_MODE_PHOTON, 32, 4, 8000000, 40, 0.01},
    {"box_caustic", RT_MODE_PHOTON, 32, 4, 8000000, 40, 0.02},
};

/* Renders a picture of the reference's size. */
static rt_image *render(rt_renderer *renderer, const rt_scene *scene, const reference_case *c,
                        const rt_image *reference, uint32_t seed)
{
    rt_film *film = NULL;
    rt_image *image = NULL;
    rt_error error;
    rt_render_options options;
    rt_scene_get_options(scene, &options);
    rt_image_get_size(reference, &options.width, &options.height);
    options.mode = c->mode;
    options.spp = c->spp;
    options.seed = seed;
    options.photons = c->photons;
    options.k = c->k;
    /* The map's own bias at edges would show: gather after the first bounce. */
    options.final_gather = c->mode == RT_MODE_PHOTON ? 1 : 0;
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    expect_ok(rt_image_from_rgb(&image, rt_film_rgb(film), options.width, options.height, &error),
              &error);
    rt_film_destroy(film);
    return image;
}

static const char *mode_name(const reference_case *c)
{
    return c->mode == RT_MODE_PHOTON ? "photon" : "path";
}

/* The row of the page. */
static void tell_page(const reference_case *c, const rt_comparison_info *info, double excess)
{
    char stated[128], measured[160];
    snprintf(stated, sizeof stated, "%s, %s: %s.exr\n ", c->scene, mode_name(c), c->scene);
    snprintf(measured, sizeof measured,
             "mean ratio %.6g, off by %+.2f standard errors of %.1e; %zu of %zu blocks off, the "
             "worst at %.2f",
             info->ratio, (info->ratio - 1.0) / info->ratio_error, info->ratio_error, info->off,
             info->blocks, excess);
    page_row(stated, measured);
}

static void keep_difference(const reference_case *c, const rt_comparison *comparison)
{
    char path[1024];
    rt_error error;
    const char *directory = getenv("RT_REFERENCE_OUT");
    if (!directory)
        return;
    snprintf(path, sizeof path, "%s/%s-%s-difference.exr", directory, c->scene, mode_name(c));
    expect_ok(rt_comparison_write_difference(comparison, path, 0.0, &error), &error);
}

static void compare_with_reference(const reference_case *c, const rt_image *const *renders,
                                   const rt_image *reference)
{
    rt_comparison *comparison = NULL;
    rt_comparison_info info;
    rt_error error;
    size_t count;
    rt_compare_options options = {.tolerance = c->tolerance};
    expect_ok(rt_image_compare(&comparison, renders, c->renders, reference, &options, &error),
              &error);
    rt_comparison_get_info(comparison, &info);
    const rt_image_block *worst = rt_comparison_blocks(comparison, &count) + info.worst;
    uint32_t channel = info.worst_channel;
    printf("%s %s: %zu of %zu blocks off, mean ratio %.5f, RMSE %.5f; worst at (%u, %u) channel "
           "%u: %.6f for %.6f, "
           "standard error %.6f, %.2f of what is allowed\n",
           c->scene, mode_name(c), info.off, info.blocks, info.ratio, info.rmse, worst->x, worst->y,
           channel, worst->mean[channel], worst->reference[channel], worst->error[channel],
           worst->excess[channel]);
    tell_page(c, &info, worst->excess[channel]);
    keep_difference(c, comparison);
    rt_comparison_destroy(comparison);
    assert_int_equal(info.off, 0);
}

static void agrees_with_the_reference(void **state)
{
    const reference_case *c = *state;
    char path[1024];
    rt_image *reference = NULL, *renders[RENDERS_MAX] = {0};
    rt_scene *scene = NULL;
    rt_renderer *renderer = NULL;
    rt_error error;

    snprintf(path, sizeof path, "%s/%s.exr", getenv("RT_REFERENCE"), c->scene);
    expect_ok(rt_image_read(&reference, path, &error), &error);
    snprintf(path, sizeof path, "scenes/%s.rts", c->scene);
    expect_ok(rt_scene_load(&scene, path, NULL, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    for (uint32_t i = 0; i < c->renders; i++)
        renders[i] = render(renderer, scene, c, reference, i + 1);
    compare_with_reference(c, (const rt_image *const *)renders, reference);

    for (uint32_t i = 0; i < c->renders; i++)
        rt_image_destroy(renders[i]);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
    rt_image_destroy(reference);
}

static void the_page_says_so(void **state)
{
    (void)state;
    page_section("Against stored renders");
}

int main(void)
{
    enum { COUNT = sizeof cases / sizeof cases[0] };
    struct CMUnitTest tests[COUNT + 1] = {[COUNT] = cmocka_unit_test(the_page_says_so)};
    char names[COUNT][64];
    if (!getenv("RT_REFERENCE")) {
        fprintf(stderr, "RT_REFERENCE does not name the directory of the reference renders\n");
        return 1;
    }
    for (int i = 0; i < COUNT; i++) {
        snprintf(names[i], sizeof names[i], "%s_agrees_in_mode_%s", cases[i].scene,
                 mode_name(&cases[i]));
        tests[i].name = names[i];
        tests[i].test_func = agrees_with_the_reference;
        tests[i].initial_state = (void *)&cases[i];
    }
    return cmocka_run_group_tests_name("render/reference", tests, NULL, NULL);
}
