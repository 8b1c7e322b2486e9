/*
 * bench_progressive.c - passes a second of progressive photon mapping.
 *
 *     bench_progressive [SCENE [PASSES [RADIUS [DIRECT]]]]
 *
 * 512 x 512 pixels, one eye path a pixel and as many light paths a pass, paths of at most 10
 * segments. The default radius is 0.003 of that of a sphere around the box, as SmallVCM's `ppm`
 * begins. Prints the median of five runs; kernels are compiled before.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/progress.h"
#include "rt.h"

enum { runs = 5, side = 512 };

static void must(rt_status status, const rt_error *error)
{
    if (status != RT_OK) {
        fprintf(stderr, "bench_progressive: %s\n", error->message);
        exit(1);
    }
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double render(rt_renderer *renderer, const rt_render_options *options, rt_film_stats *stats)
{
    rt_film *film = NULL;
    rt_error error;
    must(rt_render(&film, renderer, options, &error), &error);
    rt_film_get_stats(film, stats);
    rt_film_destroy(film);
    return stats->emit_seconds + stats->gather_seconds;
}

int main(int argc, char **argv)
{
    const char *path = argc > 1 ? argv[1] : "scenes/cornell.rts";
    rt_render_options options;
    rt_scene *scene = NULL;
    rt_device *device = NULL;
    rt_renderer *renderer = NULL;
    rt_film_stats stats;
    rt_error error;
    double seconds[runs];

    memset(&options, 0, sizeof options);
    options.mode = RT_MODE_PHOTON;
    options.width = options.height = side;
    options.max_depth = 10;
    options.passes = 2;
    options.radius = argc > 3 ? strtof(argv[3], NULL) : 0.0054f;
    options.direct =
        argc > 4 && strcmp(argv[4], "photons") == 0 ? RT_DIRECT_PHOTONS : RT_DIRECT_NEE;
    must(rt_scene_load(&scene, path, NULL, &error), &error);
    must(rt_device_open(&device, NULL, &error), &error);
    must(rt_renderer_create(&renderer, scene, device, NULL, &error), &error);
    render(renderer, &options, &stats);
    options.passes = argc > 2 ? (uint32_t)strtoul(argv[2], NULL, 10) : 20;
    for (int run = 0; run < runs; run++)
        seconds[run] = render(renderer, &options, &stats);
    qsort(seconds, runs, sizeof *seconds, by_value);
    printf("progressive: %s, %.0f photons a pass, emission %.0f %% of the time\n", path,
           (double)stats.photons_stored / stats.passes,
           100 * stats.emit_seconds / (stats.emit_seconds + stats.gather_seconds));
    printf("librt  %6.2f passes/s\n", stats.passes / seconds[runs / 2]);
    rt_renderer_destroy(renderer);
    rt_device_close(device);
    rt_scene_destroy(scene);
    return 0;
}
