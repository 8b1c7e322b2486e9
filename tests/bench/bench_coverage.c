/*
 * bench_coverage.c - how many pixels are within their error bound, over many renders.
 *
 *     bench_coverage SCENE REFERENCE [RENDERS [PASSES]]
 *
 * Renders the scene with the seeds 1, 2 and so on by photon passes of default settings, as large as
 * the reference, an image file with much less noise. Prints the share of the values, over pixels,
 * channels and renders, whose error is below the layer error_bound; the share that is within the
 * interval by noise alone; and what part of the values has more bias than noise, with the share of
 * these.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "bench/bench.h"
#include "rt.h"

/* Of one value in all renders. */
typedef struct tally {
    double sum, variance, within, by_noise;
} tally;

static void add(tally *tallies, const rt_film *film, const float *reference, size_t values)
{
    const float *rgb = rt_film_rgb(film), *variance = rt_film_layer(film, "variance", NULL),
                *bound = rt_film_layer(film, "error_bound", NULL);
    rt_film_stats stats;
    rt_film_get_stats(film, &stats);
    for (size_t i = 0; i < values; i++) {
        const double error = fabs(rgb[i] - reference[i]);
        tallies[i].sum += rgb[i];
        tallies[i].variance += variance[i];
        tallies[i].within += error <= bound[i];
        tallies[i].by_noise += error <= stats.interval_factor * sqrt(variance[i]);
    }
}

static void print(const tally *tallies, const float *reference, size_t values, double renders)
{
    double within = 0, by_noise = 0, biased = 0, within_biased = 0;
    for (size_t i = 0; i < values; i++) {
        const tally *t = tallies + i;
        const double bias = t->sum / renders - reference[i];
        const int is_biased = bias * bias > t->variance / renders;
        within += t->within / renders;
        by_noise += t->by_noise / renders;
        biased += is_biased;
        within_biased += is_biased * t->within / renders;
    }
    bench_figure("within the bound", within / (double)values);
    bench_figure("within the interval of noise", by_noise / (double)values);
    bench_figure("with more bias than noise", biased / (double)values);
    bench_figure("of these within the bound", within_biased / biased);
}

static float *read_reference(const char *path, uint32_t *width, uint32_t *height)
{
    rt_image *image = NULL;
    rt_error error;
    bench_must(rt_image_read(&image, path, &error), &error);
    rt_image_get_size(image, width, height);
    float *rgb = bench_allocate((size_t)*width * *height, 3 * sizeof *rgb);
    bench_must(rt_image_get_rgb(rgb, image, NULL, &error), &error);
    rt_image_destroy(image);
    return rgb;
}

/* Renders the scene with the seeds 1 to `renders`. */
static void run(tally *tallies, rt_scene *scene, rt_render_options *options, uint32_t renders,
                const float *reference)
{
    rt_device *device = bench_device();
    rt_renderer *renderer = NULL;
    rt_error error;
    bench_must(rt_renderer_create(&renderer, scene, device, NULL, &error), &error);
    for (options->seed = 1; options->seed <= renders; options->seed++) {
        rt_film *film = NULL;
        bench_must(rt_render(&film, renderer, options, &error), &error);
        add(tallies, film, reference, 3 * (size_t)options->width * options->height);
        rt_film_destroy(film);
    }
    rt_renderer_destroy(renderer);
    rt_device_close(device);
}

int main(int argc, char **argv)
{
    rt_scene *scene = NULL;
    rt_error error;
    rt_render_options options = {.mode = RT_MODE_PHOTON, .max_depth = 24, .variance = 1};
    if (argc < 3) {
        fprintf(stderr, "usage: bench_coverage SCENE REFERENCE [RENDERS [PASSES]]\n");
        return 2;
    }
    float *reference = read_reference(argv[2], &options.width, &options.height);
    const size_t values = 3 * (size_t)options.width * options.height;
    const uint32_t renders = argc > 3 ? (uint32_t)strtoul(argv[3], NULL, 10) : 100;
    options.passes = argc > 4 ? (uint32_t)strtoul(argv[4], NULL, 10) : 200;
    tally *tallies = bench_allocate(values, sizeof *tallies);
    bench_must(rt_scene_load(&scene, argv[1], NULL, &error), &error);
    run(tallies, scene, &options, renders, reference);
    print(tallies, reference, values, renders);
    rt_scene_destroy(scene);
    free(tallies);
    free(reference);
    return 0;
}
