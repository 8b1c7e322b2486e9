/* seed_means.c - means of pictures over seeds. */
#include "lib/mode/seed_means.h"

#include <math.h>

#include "kernels/statistics.h"
#include "support.h"

static const char *const channel[3] = {"red", "green", "blue"};

/* The mean of a picture. */
static void render(double out[3], rt_renderer *renderer, const rt_render_options *options)
{
    rt_film *film = NULL;
    rt_film_stats stats;
    rt_error error;
    expect_ok(rt_render(&film, renderer, options, &error), &error);
    rt_film_get_stats(film, &stats);
    assert_int_equal(stats.rejected + stats.photons_rejected, 0);
    const size_t pixels = (size_t)options->width * options->height;
    for (int c = 0; c < 3; c++) {
        out[c] = 0;
        for (size_t i = 0; i < pixels; i++)
            out[c] += rt_film_rgb(film)[3 * i + (size_t)c] / (double)pixels;
    }
    rt_film_destroy(film);
}

seed_mean seed_mean_of(rt_renderer *renderer, rt_render_options options)
{
    seed_mean m = {{0}, {0}};
    double found[SEEDS][3];
    for (uint32_t i = 0; i < SEEDS; i++) {
        options.seed = test_seed(i + 1);
        render(found[i], renderer, &options);
        for (int c = 0; c < 3; c++)
            m.value[c] += found[i][c] / SEEDS;
    }
    for (uint32_t i = 0; i < SEEDS; i++)
        for (int c = 0; c < 3; c++)
            m.error[c] += pow(found[i][c] - m.value[c], 2) / (SEEDS * (SEEDS - 1));
    for (int c = 0; c < 3; c++)
        m.error[c] = sqrt(m.error[c]);
    return m;
}

void expect_mean_near(const seed_mean *m, const double exact[3], double part)
{
    for (int c = 0; c < 3; c++)
        expect_close(m->value[c], exact[c], 5 * m->error[c] + part * exact[c], channel[c]);
}

void expect_same_mean(const seed_mean *a, const seed_mean *b, double part)
{
    for (int c = 0; c < 3; c++)
        expect_close(a->value[c], b->value[c],
                     5 * hypot(a->error[c], b->error[c]) + part * b->value[c], channel[c]);
}
