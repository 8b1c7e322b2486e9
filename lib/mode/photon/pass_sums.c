/* pass_sums.c - shares of the layers of a pass, one a job. */
#include "mode/photon/pass_sums.h"

#include <string.h>

#include "base/parallel.h"
#include "film/photon_sums.h"

enum { PIXELS_A_JOB = 1 << 14 };

typedef struct clearing {
    rt_photon_sums *pass;
    size_t pixels;
} clearing;

typedef struct joining {
    rt_photon_sums *sums;
    const rt_photon_sums *pass;
    size_t pixels;
} joining;

static uint32_t jobs_of(size_t pixels)
{
    return (uint32_t)((pixels + PIXELS_A_JOB - 1) / PIXELS_A_JOB);
}

/* How many pixels a job has, from this one on. */
static size_t count_from(size_t first, size_t pixels)
{
    return pixels - first < PIXELS_A_JOB ? pixels - first : PIXELS_A_JOB;
}

static void clear_share(void *user, uint32_t job)
{
    const clearing *c = user;
    const size_t first = (size_t)job * PIXELS_A_JOB;
    memset(c->pass + first, 0, count_from(first, c->pixels) * sizeof *c->pass);
}

static void join_share(void *user, uint32_t job)
{
    const joining *j = user;
    const size_t first = (size_t)job * PIXELS_A_JOB;
    rt_photon_sums_join(j->sums + first, j->pass + first, count_from(first, j->pixels));
}

void rt_pass_sums_clear(rt_photon_sums *pass, size_t pixels, uint32_t threads)
{
    clearing c = {pass, pixels};
    rt_parallel(threads, jobs_of(pixels), clear_share, &c);
}

void rt_pass_sums_join(rt_photon_sums *sums, const rt_photon_sums *pass, size_t pixels,
                       uint32_t threads)
{
    joining j = {sums, pass, pixels};
    rt_parallel(threads, jobs_of(pixels), join_share, &j);
}
