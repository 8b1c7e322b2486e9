/*
 * test_contribution.c - what each technique of mode vcm adds: the pictures of all of them, made
 * from the same paths, sum to that of all; and what its programs for faceted scenes leave out.
 */
#include "support.h"

#include <math.h>
#include <stdlib.h>

#include "proof/vcm_scenes.h"
#include "render/renderer.h"

enum { width = 24, height = 16, values = 3 * width * height };

static const rt_techniques each[] = {RT_TECHNIQUES_EMISSION, RT_TECHNIQUES_NEE,
                                     RT_TECHNIQUES_CAMERA, RT_TECHNIQUES_CONNECTION,
                                     RT_TECHNIQUES_MERGING};
enum { contributions = sizeof each / sizeof *each };

static rt_render_options options_of(rt_techniques techniques, rt_techniques contribution)
{
    return (rt_render_options){.mode = RT_MODE_VCM,
                               .width = width,
                               .height = height,
                               .spp = 3,
                               .max_depth = 5,
                               .radius = 0.1f,
                               .techniques = techniques,
                               .contribution = contribution};
}

/* Adds the picture to the sum; returns its mean. */
static double add_picture(double *sum, rt_renderer *renderer, rt_techniques techniques,
                          rt_techniques contribution)
{
    const rt_render_options options = options_of(techniques, contribution);
    rt_film *film = NULL;
    rt_error error;
    double mean = 0;
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    for (size_t i = 0; i < values; i++) {
        const double value = (double)rt_film_rgb(film)[i];
        mean += value / values;
        sum[i] += value;
    }
    rt_film_destroy(film);
    return mean;
}

/* Each of the techniques adds something, and all of them make the picture. */
static void expect_whole(rt_renderer *renderer, rt_techniques techniques, size_t count)
{
    double sum[values] = {0}, whole[values] = {0};
    add_picture(whole, renderer, techniques, RT_TECHNIQUES_VCM);
    for (size_t i = 0; i < count; i++)
        assert_true(add_picture(sum, renderer, techniques, each[i]) > 1e-4);
    for (size_t i = 0; i < values; i++)
        assert_true(fabs(sum[i] - whole[i]) <= 1e-5 * whole[i] + 1e-7);
}

static void contributions_sum_to_the_whole(void **state)
{
    (void)state;
    rt_renderer *renderer = test_renderer(vcm_glass);
    expect_whole(renderer, RT_TECHNIQUES_VCM, contributions);
    expect_whole(renderer, RT_TECHNIQUES_BPT, contributions - 1);
    rt_renderer_destroy(renderer);
}

/* What bidirectional path tracing adds to vcm, and what merging does, are the whole, too. */
static void sets_of_techniques_contribute(void **state)
{
    double sum[values] = {0}, whole[values] = {0};
    (void)state;
    rt_renderer *renderer = test_renderer(vcm_glass);
    add_picture(whole, renderer, RT_TECHNIQUES_VCM, RT_TECHNIQUES_VCM);
    add_picture(sum, renderer, RT_TECHNIQUES_VCM, RT_TECHNIQUES_BPT);
    add_picture(sum, renderer, RT_TECHNIQUES_VCM, RT_TECHNIQUES_MERGING);
    for (size_t i = 0; i < values; i++)
        assert_true(fabs(sum[i] - whole[i]) <= 1e-5 * whole[i] + 1e-7);
    rt_renderer_destroy(renderer);
}

static void a_technique_that_is_left_out_adds_nothing(void **state)
{
    (void)state;
    rt_renderer *renderer = test_renderer(vcm_glass);
    rt_film *film = NULL;
    rt_error error;
    for (int i = 0; i < 2; i++) {
        const rt_render_options options = i ? options_of(RT_TECHNIQUES_PT, RT_TECHNIQUES_CAMERA)
                                            : options_of(RT_TECHNIQUES_BPT, RT_TECHNIQUES_MERGING);
        assert_int_equal(rt_render(&film, renderer, &options, &error), RT_ERROR_USAGE);
        assert_string_equal(error.field, "contribution");
    }
    rt_renderer_destroy(renderer);
}

/* Where no shading normal leans, the code for those that do adds nothing. */
static void faceted_scenes_are_the_same_without_the_code_for_others(void **state)
{
    double faceted[values] = {0}, any[values] = {0};
    (void)state;
    rt_renderer *renderer = test_renderer(vcm_glass);
    assert_false(renderer->has_shading_normals);
    add_picture(faceted, renderer, RT_TECHNIQUES_VCM, RT_TECHNIQUES_VCM);
    renderer->has_shading_normals = 1;
    assert_true(add_picture(any, renderer, RT_TECHNIQUES_VCM, RT_TECHNIQUES_VCM) > 1e-4);
    for (size_t i = 0; i < values; i++)
        assert_true(fabs(any[i] - faceted[i]) <= 1e-5 * any[i]);
    rt_renderer_destroy(renderer);
}

/* Bumps lean them, and normals of vertices. */
static void scenes_with_shading_normals_are_known(void **state)
{
    static const char *const leaning[] = {
        "texture t { pattern checker  a 1 }\nmaterial m { kd 0.5  bump_texture t }\n"
        "sphere { centre 0 0 0  radius 1  material m }\n",
        "material m { kd 0.5 }\n"
        "model { file \"tests/proof/cube.off\"  shading smooth  material m }\n"};
    (void)state;
    for (size_t i = 0; i < sizeof leaning / sizeof *leaning; i++) {
        rt_renderer *renderer = test_renderer(leaning[i]);
        assert_true(renderer->has_shading_normals);
        rt_renderer_destroy(renderer);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(contributions_sum_to_the_whole),
        cmocka_unit_test(sets_of_techniques_contribute),
        cmocka_unit_test(a_technique_that_is_left_out_adds_nothing),
        cmocka_unit_test(faceted_scenes_are_the_same_without_the_code_for_others),
        cmocka_unit_test(scenes_with_shading_normals_are_known),
    };
    return cmocka_run_group_tests_name("lib/mode/contribution", tests, NULL, NULL);
}
