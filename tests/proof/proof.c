/* proof.c - renders, compares means with what they should be, and keeps the rows. */
#include "proof/proof.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "chance.h"
#include "proof/page.h"

/* ---- Renders ----------------------------------------------------------------- */

const char *proof_text(const char *format, ...)
{
    static char texts[8][4096];
    static int turn;
    char *text = texts[turn++ % 8];
    va_list args;
    va_start(args, format);
    int length = vsnprintf(text, sizeof texts[0], format, args);
    va_end(args);
    assert_in_range(length, 0, sizeof texts[0] - 1);
    return text;
}

/* Copies the film, every number of which must be finite. */
static float *keep(const rt_film *film, uint32_t *width, uint32_t *height)
{
    rt_film_get_size(film, width, height);
    size_t count = (size_t)*width * *height * 3;
    float *rgb = malloc(count * sizeof *rgb);
    rt_film_stats stats;
    assert_non_null(rgb);
    memcpy(rgb, rt_film_rgb(film), count * sizeof *rgb);
    for (size_t i = 0; i < count; i++)
        assert_true(isfinite(rgb[i]));
    rt_film_get_stats(film, &stats);
    assert_int_equal(stats.rejected, 0);
    return rgb;
}

void proof_render(proof_films *out, const char *text, const rt_render_options *options)
{
    rt_scene *scene = NULL;
    rt_renderer *renderer = NULL;
    rt_error error;
    expect_ok(rt_scene_parse(&scene, text, "scene", NULL, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    for (uint32_t i = 0; i < proof_renders; i++) {
        rt_render_options one = *options;
        rt_film *film = NULL;
        one.seed = test_seed(options->seed + i);
        expect_ok(rt_render(&film, renderer, &one, &error), &error);
        out->rgb[i] = keep(film, &out->width, &out->height);
        rt_film_destroy(film);
    }
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
}

void proof_free(proof_films *films)
{
    for (int i = 0; i < proof_renders; i++)
        free(films->rgb[i]);
}

proof_values proof_mean_of(const proof_films *films, int channel, uint32_t x0, uint32_t y0,
                           uint32_t x1, uint32_t y1)
{
    proof_values values;
    for (int i = 0; i < proof_renders; i++) {
        double sum = 0;
        for (uint32_t y = y0; y < y1; y++)
            for (uint32_t x = x0; x < x1; x++)
                sum += films->rgb[i][3 * (y * films->width + x) + (uint32_t)channel];
        values.of[i] = sum / ((double)(x1 - x0) * (y1 - y0));
    }
    return values;
}

proof_values proof_mean(const proof_films *films, int channel)
{
    return proof_mean_of(films, channel, 0, 0, films->width, films->height);
}

/* ---- Statistics ---------------------------------------------------------------- */

/*
 * The mean of the values, its standard error with that of rounding, and how many of them it is off.
 */
typedef struct estimate {
    double mean, error, off;
} estimate;

static estimate estimate_of(const proof_values *values, double expected, double scale)
{
    estimate e = {0, 0, 0};
    for (int i = 0; i < proof_renders; i++)
        e.mean += values->of[i] / proof_renders;
    for (int i = 0; i < proof_renders; i++)
        e.error += (values->of[i] - e.mean) * (values->of[i] - e.mean) /
                   ((double)proof_renders * (proof_renders - 1));
    e.error = sqrt(e.error + PROOF_ROUNDING * PROOF_ROUNDING * scale * scale);
    if (e.mean != expected)
        e.off = (e.mean - expected) / e.error;
    return e;
}

/* Whether chance would be that far off too seldom, in one of so many checks. */
static int is_wrong(double off, double checks)
{
    chance_spend(PROOF_FALSE_ALARM);
    return !(chance_of_student(off, proof_renders - 1) >= PROOF_FALSE_ALARM / checks);
}

void proof_check(proof_row row, double expected, const proof_values *values)
{
    estimate e = estimate_of(values, expected, expected);
    page_row(proof_text("%s, %s: %s\n  expected %.6g,", row.scene, row.by, row.formula, expected),
             proof_text("ours %.6g: off by %+.2f standard errors of %.1e", e.mean, e.off, e.error));
    if (is_wrong(e.off, 1))
        fail_msg("%s by %s, %s: %.8g, should be %.8g; %+.1f standard errors of %.2g", row.scene,
                 row.by, row.formula, e.mean, expected, e.off, e.error);
}

void proof_radiance(proof_row row, double expected, const char *text,
                    const rt_render_options *options)
{
    proof_films films;
    proof_render(&films, text, options);
    proof_values values = proof_mean(&films, 1);
    proof_free(&films);
    proof_check(row, expected, &values);
}

static proof_values difference(const proof_values *a, const proof_values *b)
{
    proof_values d;
    for (int i = 0; i < proof_renders; i++)
        d.of[i] = a->of[i] - b->of[i];
    return d;
}

/* A number of the film, as each render has it. */
static proof_values number(const proof_films *films, size_t index)
{
    proof_values v;
    for (int i = 0; i < proof_renders; i++)
        v.of[i] = films->rgb[i][index];
    return v;
}

void proof_same(proof_row row, const proof_films *a, const proof_films *peer)
{
    size_t count = (size_t)a->width * a->height * 3, worst = 0;
    double worst_off = 0;
    assert_true(a->width == peer->width && a->height == peer->height);

    /* Compare number by number, with a limit for all of them. */
    for (size_t i = 0; i < count; i++) {
        proof_values x = number(a, i), y = number(peer, i), d = difference(&x, &y);
        estimate e = estimate_of(&d, 0, x.of[0]);
        if (!(fabs(e.off) <= fabs(worst_off))) {
            worst_off = e.off;
            worst = i;
        }
    }

    /* Compare the means. */
    proof_values x = proof_mean(a, 1), y = proof_mean(peer, 1), d = difference(&x, &y);
    estimate ours = estimate_of(&x, 0, 0), theirs = estimate_of(&y, 0, 0),
             e = estimate_of(&d, 0, ours.mean);
    page_row(proof_text("%s, %s: %s\n ", row.scene, row.by, row.formula),
             proof_text("expected %.6g, ours %.6g: off by %+.2f standard errors of %.1e; "
                        "worst of %d %+.2f",
                        theirs.mean, ours.mean, e.off, e.error, (int)count, worst_off));
    if (is_wrong(e.off, 1))
        fail_msg("%s by %s and by %s: mean %.8g and %.8g, %+.1f standard errors", row.scene, row.by,
                 row.formula, ours.mean, theirs.mean, e.off);
    if (is_wrong(worst_off, (double)count))
        fail_msg("%s by %s and by %s: channel %d of pixel %d, %d differs by %+.1f standard errors",
                 row.scene, row.by, row.formula, (int)(worst % 3), (int)(worst / 3 % a->width),
                 (int)(worst / 3 / a->width), worst_off);
}

void proof_page(const char *title)
{
    page_section(title);
}
