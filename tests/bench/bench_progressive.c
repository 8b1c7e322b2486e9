/*
 * bench_progressive.c - passes a second of progressive photon mapping.
 *
 *     bench_progressive [SCENE [PASSES [RADIUS [DIRECT]]]]
 *
 * 512 x 512 pixels, one eye path a pixel and as many light paths a pass, paths of at most 10
 * segments. The default radius is 0.003 of that of a sphere around the box, as SmallVCM's `ppm`
 * begins. Kernels are compiled before. Prints passes a second, the photons of a pass, and
 * the part of the time that emission takes.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/bench.h"
#include "rt.h"

enum { side = 512 };

static double render(rt_renderer *renderer, const rt_render_options *options, rt_film_stats *stats)
{
    rt_film *film = NULL;
    rt_error error;
    bench_must(rt_render(&film, renderer, options, &error), &error);
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

    memset(&options, 0, sizeof options);
    options.mode = RT_MODE_PHOTON;
    options.width = options.height = side;
    options.max_depth = 10;
    options.photons = (uint64_t)options.width * options.height; /* as many as eye paths */
    options.passes = 2;
    options.radius = argc > 3 ? strtof(argv[3], NULL) : 0.0054f;
    options.direct =
        argc > 4 && strcmp(argv[4], "photons") == 0 ? RT_DIRECT_PHOTONS : RT_DIRECT_NEE;
    bench_must(rt_scene_load(&scene, path, NULL, &error), &error);
    device = bench_device();
    bench_must(rt_renderer_create(&renderer, scene, device, NULL, &error), &error);
    render(renderer, &options, &stats);
    options.passes = argc > 2 ? (uint32_t)strtoul(argv[2], NULL, 10) : 20;
    const double seconds = render(renderer, &options, &stats);
    bench_figure("passes.ours", stats.passes / seconds);
    bench_figure("photons", (double)stats.photons_stored / stats.passes);
    bench_figure("emission", stats.emit_seconds / seconds);
    rt_renderer_destroy(renderer);
    rt_device_close(device);
    rt_scene_destroy(scene);
    return 0;
}
