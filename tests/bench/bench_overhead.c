/*
 * bench_overhead.c - by how much checkpoints lengthen a render of 1920 x 1080 pixels with all
 * layers.
 *
 *     bench_overhead SCENE MODE SPP [SECONDS [PAIRS]]
 *
 * MODE is path or photon. The same render is timed without and with a checkpoint every SECONDS (10)
 * in turn, PAIRS (3) times, the file in the current folder, until the last one is on the disk.
 * Prints the medians of the wall clock and of CPU time, the bytes of a checkpoint and how long the
 * render waits for one. Of renders of few minutes the difference is within their noise: where
 * SECONDS is less than 10, the overhead that it makes is printed as that of every 10 s too, as each
 * checkpoint costs the same.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "base/progress.h"
#include "rt.h"

enum { pairs_max = 32 };

static const char path[] = "bench_overhead.rtpart";

static void must(rt_status status, const rt_error *error)
{
    if (status != RT_OK) {
        fprintf(stderr, "bench_overhead: %s\n", error->message);
        exit(1);
    }
}

/* The checkpoints of a render. */
typedef struct keeper {
    rt_film_saver *saver;
    int count;
    double seconds; /* that the render waited */
} keeper;

static void keep(void *user, const rt_film *film)
{
    keeper *k = user;
    rt_error error;
    const double began = rt_clock();
    must(rt_film_saver_put(k->saver, film, &error), &error);
    k->seconds += rt_clock() - began;
    k->count++;
}

/* What a render took. */
typedef struct cost {
    double wall, cpu;
} cost;

static cost render(rt_renderer *renderer, const rt_render_options *options, keeper *k)
{
    rt_render_options o = *options;
    rt_film *film = NULL;
    rt_error error;
    if (k) {
        must(rt_film_saver_create(&k->saver, path, &error), &error);
        o.checkpoint = keep;
        o.checkpoint_user = k;
    }
    const double began = rt_clock();
    const clock_t busy = clock();
    must(rt_render(&film, renderer, &o, &error), &error);
    if (k)
        must(rt_film_saver_wait(k->saver, &error), &error);
    const cost took = {rt_clock() - began, (double)(clock() - busy) / CLOCKS_PER_SEC};
    if (k)
        rt_film_saver_destroy(k->saver);
    rt_film_destroy(film);
    return took;
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(const double *values, int count)
{
    double sorted[pairs_max];
    memcpy(sorted, values, (size_t)count * sizeof *values);
    qsort(sorted, (size_t)count, sizeof *sorted, by_value);
    return 0.5 * (sorted[count / 2] + sorted[(count - 1) / 2]);
}

static void report(const char *what, const double *without, const double *with, int pairs,
                   double seconds)
{
    double more[pairs_max] = {0};
    for (int i = 0; i < pairs; i++)
        more[i] = with[i] / without[i] - 1;
    const double overhead = 100 * median(more, pairs);
    printf("  %-10s %8.3f s without, %8.3f s with: %+.2f %%", what, median(without, pairs),
           median(with, pairs), overhead);
    printf(seconds < 10 ? ", %+.2f %% at every 10 s\n" : "\n", overhead * seconds / 10);
}

static void bench(rt_renderer *renderer, const rt_render_options *o, int pairs)
{
    double wall[2][pairs_max] = {{0}}, cpu[2][pairs_max] = {{0}};
    keeper k = {0};
    struct stat file;
    rt_render_options warm = *o;
    warm.spp = 1;
    render(renderer, &warm, NULL);
    for (int i = 0; i < pairs; i++) {
        const cost without = render(renderer, o, NULL), with = render(renderer, o, &k);
        wall[0][i] = without.wall;
        cpu[0][i] = without.cpu;
        wall[1][i] = with.wall;
        cpu[1][i] = with.cpu;
    }
    if (stat(path, &file) != 0)
        exit(1);
    unlink(path);
    printf(
        "%s, %u samples, a checkpoint every %g s: %.1f MB, %.1f a render, each waited for %.3f s\n",
        rt_mode_name(o->mode), o->spp, o->checkpoint_seconds, (double)file.st_size * 1e-6,
        (double)k.count / pairs, k.seconds / k.count);
    report("wall clock", wall[0], wall[1], pairs, o->checkpoint_seconds);
    report("CPU", cpu[0], cpu[1], pairs, o->checkpoint_seconds);
}

int main(int argc, char **argv)
{
    rt_render_options o = {.width = 1920, .height = 1080, .aov = 1, .part = 1, .parts = 1};
    rt_scene *scene = NULL;
    rt_device *device = NULL;
    rt_renderer *renderer = NULL;
    rt_error error;
    if (argc < 4) {
        fprintf(stderr, "usage: bench_overhead SCENE MODE SPP [SECONDS [PAIRS]]\n");
        return 2;
    }
    if (strcmp(argv[2], "photon") == 0) {
        o.mode = RT_MODE_PHOTON;
        o.photons = 20000;
        o.photon_layers = 1;
    }
    o.spp = (uint32_t)strtoul(argv[3], NULL, 10);
    o.checkpoint_seconds = argc > 4 ? strtod(argv[4], NULL) : 10;
    const long pairs = argc > 5 ? strtol(argv[5], NULL, 10) : 3;
    must(rt_scene_load(&scene, argv[1], NULL, &error), &error);
    must(rt_device_open(&device, NULL, &error), &error);
    must(rt_renderer_create(&renderer, scene, device, NULL, &error), &error);
    bench(renderer, &o, pairs < 1 ? 1 : pairs > pairs_max ? pairs_max : (int)pairs);
    rt_renderer_destroy(renderer);
    rt_device_close(device);
    rt_scene_destroy(scene);
    return 0;
}
