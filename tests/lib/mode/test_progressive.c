/*
 * test_progressive.c - progressive passes converge to the reference at the rate of theory, and stop
 * when told to.
 *
 * The mean squared error against path tracing, over three seeds, is followed over passes that
 * double; the slope of its logarithm is to be -2/3, within 15 % (Knaus and Zwicker 2011, for alpha
 * = 2/3), of a caustic within 30 %. `make study-passes` shows more.
 */
#include "kernels/statistics.h"
#include "support.h"

#include <math.h>
#include <string.h>

#include "mode/modes.h"
#include "mode/photon/passes.h"
#include "setting/options.h"
#include "studies/study.h"

enum { side = 32, counts = 6, fewest = 8, renders = 2 };

static rt_render_options pass_options(const study *s, uint32_t passes)
{
    rt_render_options options = s->options;
    options.mode = RT_MODE_PHOTON;
    options.passes = passes;
    options.photons = 4000;
    options.direct = RT_DIRECT_PHOTONS;
    options.radius = 0.03f;
    options.seed = test_seed(options.seed);
    return options;
}

/* ---- A render whose film is seen on the way ----------------------------------------- */

typedef struct progression {
    rt_render_options options;
    rt_first_hit_layers layers; /* none */
    rt_render_job job;
    rt_photon_render render;
} progression;

static void progression_begin(progression *p, const study *s, const rt_render_options *options)
{
    rt_stage_progress progress;
    rt_error error;
    memset(p, 0, sizeof *p);
    p->options = *options;
    rt_options_complete(&p->options);
    p->job.renderer = s->renderer;
    p->job.options = &p->options;
    p->job.layers = &p->layers;
    expect_ok(rt_renderer_aim(s->renderer, &p->options, &error), &error);
    expect_ok(rt_film_create(&p->job.film, &p->options, NULL, &error), &error);
    expect_ok(rt_stage_begin(&progress, NULL, RT_STAGE_COMPILE), &error);
    expect_ok(rt_mode_photon.prepare(&p->job, &p->render, &progress, &error), &error);
    expect_ok(rt_photon_render_begin(&p->render, &error), &error);
}

/* The film after so many passes in all, those of the calls before included. */
static const rt_film *progression_after(progression *p, uint32_t passes)
{
    rt_error error;
    p->options.passes = passes;
    p->job.film->units = rt_units_of(&p->options, 0);
    p->render.work = rt_work_begin(p->job.film, &p->options);
    expect_ok(rt_photon_render_passes(&p->render, &error), &error);
    expect_ok(rt_eye_paths_read(&p->render.eye_paths, &error), &error);
    rt_film_make_means(p->job.film);
    return p->job.film;
}

static void progression_end(progression *p)
{
    rt_mode_photon.release(&p->render);
    rt_film_destroy(p->job.film);
}

static void the_film_on_the_way_is_that_of_so_many_passes(void **state)
{
    progression p;
    study s;
    (void)state;
    study_open(&s, "test_progressive", "scenes/box_area.rts", side);
    rt_render_options options = pass_options(&s, 5);
    rt_film *whole = study_render(&s, &options, NULL);
    progression_begin(&p, &s, &options);
    progression_after(&p, 2);
    const rt_film *seen = progression_after(&p, options.passes);
    assert_memory_equal(rt_film_rgb(seen), rt_film_rgb(whole), sizeof(float) * 3 * side * side);
    rt_film_destroy(whole);
    progression_end(&p);
    study_close(&s);
}

/* ---- Convergence ------------------------------------------------------------------- */

static rt_film *reference_of(const study *s, uint32_t spp, uint32_t seed)
{
    rt_render_options options = s->options;
    options.mode = RT_MODE_PATH;
    options.spp = spp;
    options.seed = test_seed(seed);
    return study_render(s, &options, NULL);
}

/*
 * Two references of `spp` samples each; their noise adds nothing to the error on average. The films
 * of fewer passes are those that the longest render of a seed comes by.
 */
static void follow(const char *scene, uint32_t spp, double close)
{
    double passes[counts], errors[counts] = {0}, last_mean = 0;
    study s;
    study_open(&s, "test_progressive", scene, side);
    rt_film *a = reference_of(&s, spp, 1000), *b = reference_of(&s, spp, 1001);
    /* What is prepared is that of the longest render. */
    rt_render_options options = pass_options(&s, fewest << (counts - 1));
    for (int k = 0; k < renders; k++, options.seed++) {
        const rt_film *film = NULL;
        progression p;
        progression_begin(&p, &s, &options);
        for (int i = 0; i < counts; i++) {
            passes[i] = fewest << i;
            film = progression_after(&p, (uint32_t)fewest << i);
            errors[i] += study_mse_of_two(film, a, b) / renders;
        }
        last_mean += 2 * study_mean(film) / (study_mean(a) + study_mean(b)) / renders;
        progression_end(&p);
    }
    double slope = study_slope(passes, errors, counts);
    print_message("%s: slope %.3f, error %.5f to %.5f, mean %.4f of path tracing\n", scene, slope,
                  errors[0], errors[counts - 1], last_mean);
    expect_close(slope, -2 / 3.0, close, scene);
    expect_close(last_mean, 1, 0.02, "mean");
    rt_film_destroy(a);
    rt_film_destroy(b);
    study_close(&s);
}

static void the_error_falls_as_theory_says(void **state)
{
    (void)state;
    follow("scenes/box_point.rts", 256, 0.1);
    follow("scenes/box_area.rts", 256, 0.1);
    /*
     * A caustic is narrower than the first discs: -0.78 over these passes, with a deviation of
     * 0.036 over 5 seeds.
     */
    follow("scenes/box_caustic.rts", 1024, 0.2);
}

/* ---- Options ----------------------------------------------------------------------- */

static void one_pass_of_one_sample_is_an_ordinary_render(void **state)
{
    rt_film_stats stats;
    study s;
    (void)state;
    study_open(&s, "test_progressive", "scenes/box_area.rts", side);
    rt_render_options options = pass_options(&s, 1);
    options.spp = 1;
    options.gather = RT_GATHER_DEVICE;
    options.k = RT_K_ALL;
    rt_film *once = study_render(&s, &options, NULL);
    rt_film_get_stats(once, &stats);
    assert_int_equal(stats.passes, 0);
    options.passes = 2;
    rt_film *twice = study_render(&s, &options, NULL);
    rt_film_get_stats(twice, &stats);
    assert_int_equal(stats.passes, 2);
    assert_int_equal(stats.spp, 2);
    assert_int_equal(stats.photons_emitted, 8000);
    /*
     * The second pass has other photons: the films are not the same, nor far apart in their mean.
     */
    assert_true(study_mse(once, twice) > 0);
    expect_close(study_mean(once) / study_mean(twice), 1, 0.6, "mean of one pass and of two");
    rt_film_destroy(once);
    rt_film_destroy(twice);
    study_close(&s);
}

static void passes_end_when_time_is_up(void **state)
{
    rt_film_stats stats;
    study s;
    (void)state;
    study_open(&s, "test_progressive", "scenes/box_area.rts", side);
    rt_render_options options = pass_options(&s, 1 << 20);
    options.time = 0.3;
    rt_film *film = study_render(&s, &options, NULL);
    rt_film_get_stats(film, &stats);
    assert_true(stats.passes >= 1 && stats.passes < 1 << 20);
    assert_int_equal(stats.spp, stats.passes);
    rt_film_destroy(film);
    study_close(&s);
}

static void expect_usage(study *s, const rt_render_options *options, const char *field)
{
    rt_film *film = NULL;
    rt_error error;
    assert_int_equal(rt_render(&film, s->renderer, options, &error), RT_ERROR_USAGE);
    assert_string_equal(error.field, field);
    assert_null(film);
}

static void options_that_do_not_go_together_are_refused(void **state)
{
    study s;
    (void)state;
    study_open(&s, "test_progressive", "scenes/box_area.rts", side);
    rt_render_options options = pass_options(&s, 4);
    options.gather = RT_GATHER_FLANN;
    expect_usage(&s, &options, "gather");
    options = pass_options(&s, 1);
    options.k = RT_K_ALL;
    options.gather = RT_GATHER_FLANN;
    expect_usage(&s, &options, "gather");
    options.gather = RT_GATHER_AUTO;
    options.radius = 0;
    expect_usage(&s, &options, "k");
    options = pass_options(&s, 1 << 24);
    options.spp = 1 << 16;
    expect_usage(&s, &options, "passes");
    options = pass_options(&s, 4);
    options.alpha = 1;
    expect_usage(&s, &options, "alpha");
    options = pass_options(&s, 4);
    options.k = RT_K_ALL;
    options.radius = 0;
    expect_usage(&s, &options, "k");
    study_close(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_film_on_the_way_is_that_of_so_many_passes),
        statistical_test(the_error_falls_as_theory_says),
        statistical_test(one_pass_of_one_sample_is_an_ordinary_render),
        cmocka_unit_test(passes_end_when_time_is_up),
        cmocka_unit_test(options_that_do_not_go_together_are_refused),
    };
    return cmocka_run_group_tests_name("lib/mode/progressive", tests, NULL, NULL);
}
