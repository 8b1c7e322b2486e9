/*
 * study_photons.c - what the choices of photon mapping cost and bring: time and error against path
 * tracing.
 *
 *     study_photons [STUDY [SCENE [SIDE [REFERENCE]]]]
 *
 * STUDY is one of
 *   k         k swept at 100 000 photon paths
 *   paths     photon paths swept at k = 10
 *   direct    direct light from shadow rays and from the map
 *   kernels   the kernels side by side, all light from the map
 *   gathers   disc and hull, FLANN and the device, with and without final gather
 *   all       all of these, the default
 * SCENE: scenes/box_area.rts by default; SIDE: of the films, pixels (128); REFERENCE: samples a
 * pixel of the path traced picture (4096). The error is the root of the mean square over the film,
 * relative to the mean of the reference. The pictures of each study, in the order of its rows,
 * stand side by side in build/study/STUDY.png; the last is the reference.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "studies/study.h"

enum { ROWS_MAX = 16 };

typedef struct comparison {
    study s;
    rt_film *reference;
    double mean;
    rt_film *films[ROWS_MAX]; /* [count], of the study under way */
    int count;
} comparison;

static rt_render_options photon_options(const comparison *c)
{
    rt_render_options options = c->s.options;
    options.mode = RT_MODE_PHOTON;
    options.spp = 4;
    options.photons = 100000;
    options.k = 50;
    return options;
}

static void heading(const char *what)
{
    printf("\n%-24s %10s %12s %10s\n", what, "RMSE", "mean", "seconds");
}

static void row(comparison *c, const char *label, const rt_render_options *options)
{
    double seconds;
    rt_film *film = study_render(&c->s, options, &seconds);
    printf("%-24s %10.5f %12.5f %10.2f\n", label, sqrt(study_mse(film, c->reference)) / c->mean,
           study_mean(film) / c->mean, seconds);
    fflush(stdout);
    c->films[c->count++] = film;
}

/* Ends a study: its pictures, and the reference. */
static void write_pictures(comparison *c, const char *name)
{
    const rt_film *all[ROWS_MAX + 1];
    memcpy(all, c->films, (size_t)c->count * sizeof *all);
    all[c->count] = c->reference;
    study_write(&c->s, all, c->count + 1, name);
    while (c->count > 0)
        rt_film_destroy(c->films[--c->count]);
}

static void sweep_k(comparison *c)
{
    static const uint32_t ks[] = {2, 5, 10, 20, 50, 100, 200, 500, 1000};
    char label[32];
    heading("k at 100 000 paths");
    for (size_t i = 0; i < sizeof ks / sizeof *ks; i++) {
        rt_render_options options = photon_options(c);
        options.k = ks[i];
        snprintf(label, sizeof label, "%u", (unsigned)ks[i]);
        row(c, label, &options);
    }
}

static void sweep_paths(comparison *c)
{
    char label[32];
    heading("paths at k = 10");
    for (uint64_t n = 1000; n <= 10000000; n *= 10) {
        rt_render_options options = photon_options(c);
        options.k = 10;
        options.photons = n;
        snprintf(label, sizeof label, "%lu", (unsigned long)n);
        row(c, label, &options);
    }
}

static void compare_direct(comparison *c)
{
    rt_render_options options = photon_options(c);
    heading("direct light");
    row(c, "by shadow rays", &options);
    options.direct = RT_DIRECT_PHOTONS;
    row(c, "from the map", &options);
}

static void compare_kernels(comparison *c)
{
    static const char *const kernels[] = {"epanechnikov", "box",       "cone",
                                          "gaussian",     "silverman", "gaussian-jensen"};
    rt_render_options options = photon_options(c);
    options.direct = RT_DIRECT_PHOTONS;
    heading("kernel, all light");
    for (int i = 0; i < 6; i++) {
        options.kernel = (rt_density)i;
        row(c, kernels[i], &options);
    }
}

static void compare_gathers(comparison *c)
{
    rt_render_options options = photon_options(c);
    heading("area, k = 50");
    options.spp = 64;
    options.kernel = RT_DENSITY_BOX;
    row(c, "disc, box", &options);
    options.area = RT_AREA_HULL;
    row(c, "hull", &options);
    heading("gather, k = 50");
    options = photon_options(c);
    options.gather = RT_GATHER_FLANN;
    row(c, "FLANN", &options);
    options.gather = RT_GATHER_DEVICE;
    row(c, "device", &options);
    heading("final gather");
    options.spp = 64;
    row(c, "none, 64 samples", &options);
    options.final_gather = 1;
    row(c, "one bounce, 64 samples", &options);
}

static const struct {
    const char *name;
    void (*run)(comparison *c);
} studies[] = {
    {"k", sweep_k},
    {"paths", sweep_paths},
    {"direct", compare_direct},
    {"kernels", compare_kernels},
    {"gathers", compare_gathers},
};
enum { STUDIES = sizeof studies / sizeof *studies };

static int is_wanted(int i, const char *name)
{
    return strcmp(name, "all") == 0 || strcmp(name, studies[i].name) == 0;
}

int main(int argc, char **argv)
{
    const char *name = argc > 1 ? argv[1] : "all",
               *scene = argc > 2 ? argv[2] : "scenes/box_area.rts";
    comparison c = {.count = 0};
    int wanted = 0;
    for (int i = 0; i < STUDIES; i++)
        wanted += is_wanted(i, name);
    if (!wanted) {
        fprintf(
            stderr,
            "study_photons: no study '%s'; there are k, paths, direct, kernels, gathers and all\n",
            name);
        return 2;
    }
    study_open(&c.s, "study_photons", scene, argc > 3 ? (uint32_t)strtoul(argv[3], NULL, 10) : 128);
    rt_render_options options = c.s.options;
    options.mode = RT_MODE_PATH;
    options.spp = argc > 4 ? (uint32_t)strtoul(argv[4], NULL, 10) : 4096;
    options.seed = 1000;
    c.reference = study_render(&c.s, &options, NULL);
    c.mean = study_mean(c.reference);
    printf("%s, mean radiance %.5f\n", scene, c.mean);
    for (int i = 0; i < STUDIES; i++)
        if (is_wanted(i, name)) {
            studies[i].run(&c);
            write_pictures(&c, studies[i].name);
        }
    rt_film_destroy(c.reference);
    study_close(&c.s);
    return 0;
}
