/* pass_film.c - shares of the film of a pass, one a job. */
#include "mode/photon/pass_film.h"

#include <string.h>

#include "base/parallel.h"
#include "film/photon_sums.h"

enum { PIXELS_A_JOB = 1 << 14 };

typedef struct clearing {
    rt_film_pixel *pass;
    rt_photon_sums *pass_sums;
    size_t pixels;
} clearing;

typedef struct joining {
    rt_film_pixel *plane;
    rt_photon_sums *sums;
    const rt_film_pixel *pass;
    const rt_photon_sums *pass_sums;
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
    const size_t first = (size_t)job * PIXELS_A_JOB, count = count_from(first, c->pixels);
    memset(c->pass + first, 0, count * sizeof *c->pass);
    if (c->pass_sums)
        memset(c->pass_sums + first, 0, count * sizeof *c->pass_sums);
}

static void join_share(void *user, uint32_t job)
{
    const joining *j = user;
    const size_t first = (size_t)job * PIXELS_A_JOB, count = count_from(first, j->pixels);
    rt_film_join_pixels(j->plane + first, j->pass + first, count);
    if (j->pass_sums)
        rt_photon_sums_join(j->sums + first, j->pass_sums + first, count);
}

void rt_pass_film_clear(rt_film_pixel *pass, rt_photon_sums *pass_sums, size_t pixels,
                        uint32_t threads)
{
    clearing c = {pass, pass_sums, pixels};
    rt_parallel(threads, jobs_of(pixels), clear_share, &c);
}

void rt_pass_film_join(rt_film_pixel *plane, rt_photon_sums *sums, const rt_film_pixel *pass,
                       const rt_photon_sums *pass_sums, size_t pixels, uint32_t threads)
{
    joining j = {plane, sums, pass, pass_sums, pixels};
    rt_parallel(threads, jobs_of(pixels), join_share, &j);
}
