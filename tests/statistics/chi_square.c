/* chi_square.c - counts samples in cells, and compares the counts with the density. */
#include "statistics/chi_square.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/parallel.h"
#include "chance.h"
#include "kernels/statistics.h"
#include "lib/image/scratch.h"
#include "statistics/quadrature.h"
#include "support.h"

enum { most_cells = 4096, most_tests = 256, most_seeds = 8, jobs = 32, fresh = 1000 };

static const double family_alpha = 0.01;
static const double near = 5e-3; /* relative error of a returned density that rounding explains */

static uint32_t samples_a_test, seeds_a_test;
static double alpha; /* of one test */

/* ---- Shares of the cells ------------------------------------------------------ */

/* A routine and the factor of its density. */
typedef struct subject {
    const routine *routine;
    double factor;
    double shares[most_cells + 1]; /* of each cell, and what is not sampled */
    size_t cells;
    /* what the samples say */
    int is_tested;
    double chances[most_seeds];       /* that true samples would be counted so, by seed */
    uint32_t off_square, told, wrong; /* samples; those of a told density, and of a wrong one */
} subject;

static subject subjects[most_tests];
static size_t subject_count;

static double density_at(const void *of, double x, double y)
{
    const routine *r = of;
    return r->method->density(r->setup, x, y);
}

static void find_shares(subject *s, const routine *r)
{
    const double near_share = 1e-2 / samples_a_test; /* a hundredth of a sample */
    double sum = 0;
    s->routine = r;
    s->cells = (size_t)r->across * (size_t)r->down;
    assert_true(s->cells <= most_cells);
    for (size_t i = 0; i < s->cells; i++) {
        const double x = (double)(i % (size_t)r->across) / r->across,
                     y = (double)(i / (size_t)r->across) / r->down;
        s->shares[i] =
            integral(density_at, r, x, y, x + 1.0 / r->across, y + 1.0 / r->down, near_share);
        sum += s->shares[i];
    }
    s->factor = r->method->is_proportional ? 1 / sum : 1;
    for (size_t i = 0; i < s->cells; i++)
        s->shares[i] *= s->factor;
    if (s->factor * sum > 1 + 1e-5)
        fail_msg("%s: the density's integral is %g", r->name, s->factor * sum);
    s->shares[s->cells] = fmax(0, 1 - s->factor * sum);
}

/* ---- Counts ------------------------------------------------------------------ */

/*
 * Counts of each cell, of what is not sampled, and of what lies off the square, for each part of
 * the samples.
 */
static uint32_t counts[jobs][most_cells + 2];

/* Coordinates may be 1, and off the square by rounding. */
static int is_on_square(const sampled *p)
{
    return p->x >= -1e-5 && p->x <= 1 + 1e-5 && p->y >= -1e-5 && p->y <= 1 + 1e-5;
}

static size_t cell_of(double x, int cells)
{
    const double place = x * cells;
    return place < 0 ? 0 : place >= cells ? (size_t)cells - 1 : (size_t)place;
}

/* A part of the samples, counted by any thread. */
static void count_part(void *user, uint32_t job)
{
    const subject *s = user;
    const routine *r = s->routine;
    const uint32_t end = (uint32_t)((uint64_t)samples_a_test * (job + 1) / jobs);
    memset(counts[job], 0, sizeof counts[job]);
    for (uint32_t i = (uint32_t)((uint64_t)samples_a_test * job / jobs); i < end; i++) {
        const sampled p = r->method->place(r->setup, i);
        size_t cell = s->cells + 1;
        if (p.x < -0.5)
            cell = s->cells;
        else if (is_on_square(&p))
            cell = cell_of(p.y, r->down) * (size_t)r->across + cell_of(p.x, r->across);
        counts[job][cell]++;
    }
}

/* The chance that true samples would be counted as those drawn are. */
static double count_samples(subject *s)
{
    static double expected[most_cells + 1];
    rt_parallel(test_device()->threads, jobs, count_part, s);
    for (size_t i = 0; i <= s->cells + 1; i++)
        for (size_t j = 1; j < jobs; j++)
            counts[0][i] += counts[j][i];
    s->off_square += counts[0][s->cells + 1];
    for (size_t i = 0; i <= s->cells; i++)
        expected[i] = samples_a_test * s->shares[i];
    return chance_of_counts(counts[0], expected, s->cells + 1);
}

/* Compares the densities that the kernels tell of samples with the stated one. */
static void compare_told(subject *s)
{
    const routine *r = s->routine;
    for (uint32_t i = 0; i < told_samples; i++) {
        const sampled p = r->method->place(r->setup, i);
        if (p.x < -0.5 || isnan(p.pdf))
            continue;
        const double exact = s->factor * density_at(r, p.x, p.y);
        s->told++;
        s->wrong += !(fabs(p.pdf - exact) <= near * exact);
    }
}

/* ---- Tests --------------------------------------------------------------------- */

static int draw_alike(const routine *a, const routine *b)
{
    const size_t bytes = a->method->drawn_bytes;
    return a == b || (bytes > 0 && a->method->draw == b->method->draw &&
                      memcmp(a->setup, b->setup, bytes) == 0);
}

/* Draws the samples of a routine, and tests with them all that draw alike. */
static void test_alike(const routine *drawn)
{
    for (size_t i = 0; i < subject_count; i++)
        if (draw_alike(drawn, subjects[i].routine))
            find_shares(subjects + i, subjects[i].routine);
    for (uint32_t seed = 0; seed < seeds_a_test; seed++) {
        drawn->method->draw(drawn->setup, test_seed(seed + 1), samples_a_test);
        for (subject *s = subjects; s < subjects + subject_count; s++)
            if (draw_alike(drawn, s->routine)) {
                s->chances[seed] = count_samples(s);
                compare_told(s);
                s->is_tested = 1;
            }
    }
}

/* One told density in 200 may be where the density is too steep for float32. */
static void samples_have_their_density(void **state)
{
    subject *s = *state;
    const routine *r = s->routine;
    if (!s->is_tested)
        test_alike(r);
    if (s->wrong > s->told / 200)
        fail_msg("%s: the density that the kernels tell is wrong at %u of %u samples", r->name,
                 s->wrong, s->told);
    for (uint32_t seed = 0; seed < seeds_a_test; seed++) {
        if (s->chances[seed] >= alpha)
            continue;
        r->method->draw(r->setup, test_seed(fresh + seed + 1), samples_a_test);
        const double second = count_samples(s);
        if (second < alpha)
            fail_msg("%s: such counts have a chance of %g, of a fresh seed %g", r->name,
                     s->chances[seed], second);
    }
    if (s->off_square > 0)
        fail_msg("%s: %u samples lie off the square", r->name, s->off_square);
}

int test_routines(const char *group, uint32_t sample_count, uint32_t seeds)
{
    static const routine_table *const tables[] = {&map_routines,     &number_routines,
                                                  &light_routines,   &emission_routines,
                                                  &scatter_routines, &table_light_routines};
    static struct CMUnitTest tests[most_tests];
    size_t count = 0;
    assert(seeds <= most_seeds);
    memset(tests, 0, sizeof tests);
    for (size_t t = 0; t < sizeof tables / sizeof *tables; t++)
        for (size_t i = 0; i < tables[t]->count && count < most_tests; i++, count++) {
            const routine *r = tables[t]->routines + i;
            subjects[count].routine = r;
            tests[count] = (struct CMUnitTest){r->name, samples_have_their_density, NULL, NULL,
                                               subjects + count};
        }
    subject_count = count;
    samples_a_test = sample_count;
    seeds_a_test = seeds;
    alpha = family_alpha / ((double)count * seeds);
    chance_spend((double)count * seeds * alpha * alpha);

    /* Files go to a directory of their own. */
    void *scratch = NULL;
    if (scratch_enter(&scratch) != 0)
        return 1;
    const int failed = _cmocka_run_group_tests(group, tests, count, NULL, NULL);
    return scratch_leave(&scratch) != 0 || failed != 0;
}
