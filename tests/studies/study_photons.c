/*
 * study_photons.c - what the choices of photon mapping cost and bring: time and error against path tracing.
 *
 *     study_photons [SCENE [SIDE [REFERENCE]]]    scenes/box_area.rts, 128 pixels and 4096 samples by default
 *
 * k swept at 100 000 photon paths, paths swept at k = 10, direct light from shadow rays and from the map, the
 * kernels side by side, and the two ways to gather. The error is the root of the mean square over the film,
 * relative to the mean of the reference.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "studies/study.h"

typedef struct comparison {
    study s;
    rt_film *reference;
    double mean;
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

static void row(const comparison *c, const char *label, const rt_render_options *options)
{
    double seconds;
    rt_film *film = study_render(&c->s, options, &seconds);
    printf("%-24s %10.5f %12.5f %10.2f\n", label, sqrt(study_mse(film, c->reference)) / c->mean,
           study_mean(film) / c->mean, seconds);
    fflush(stdout);
    rt_film_destroy(film);
}

static void sweep_k(const comparison *c)
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

static void sweep_photons(const comparison *c)
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

static void compare_ways(const comparison *c)
{
    static const char *const kernels[] = {"epanechnikov", "box", "cone", "gaussian", "silverman", "gaussian-jensen"};
    rt_render_options options = photon_options(c);
    heading("direct light");
    row(c, "by shadow rays", &options);
    options.direct = RT_DIRECT_PHOTONS;
    row(c, "from the map", &options);
    heading("kernel, all light");
    for (int i = 0; i < 6; i++) {
        options.kernel = (rt_density)i;
        row(c, kernels[i], &options);
    }
    heading("area, k = 50");
    options = photon_options(c);
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

int main(int argc, char **argv)
{
    const char *scene = argc > 1 ? argv[1] : "scenes/box_area.rts";
    comparison c;
    study_open(&c.s, "study_photons", scene, argc > 2 ? (uint32_t)strtoul(argv[2], NULL, 10) : 128);
    rt_render_options options = c.s.options;
    options.mode = RT_MODE_PATH;
    options.spp = argc > 3 ? (uint32_t)strtoul(argv[3], NULL, 10) : 4096;
    options.seed = 1000;
    c.reference = study_render(&c.s, &options, NULL);
    c.mean = study_mean(c.reference);
    printf("%s, mean radiance %.5f\n", scene, c.mean);
    sweep_k(&c);
    sweep_photons(&c);
    compare_ways(&c);
    rt_film_destroy(c.reference);
    study_close(&c.s);
    return 0;
}
