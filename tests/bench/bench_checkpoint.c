/*
 * bench_checkpoint.c - what a checkpoint takes: bytes, and seconds to encode, decode and save.
 *
 *     bench_checkpoint [SCENE [SPP]]
 *
 * 1920 x 1080 pixels with all layers, by path tracing and photon mapping, the file in the current
 * folder. Prints the medians of five runs each, of time and of CPU time, and beside them plain
 * copies and writes of as many bytes.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/checksum.h"
#include "base/file.h"
#include "base/progress.h"
#include "rt.h"

enum { runs = 5 };

static const char path[] = "bench_checkpoint.rtpart";

static void must(rt_status status, const rt_error *error)
{
    if (status != RT_OK) {
        fprintf(stderr, "bench_checkpoint: %s\n", error->message);
        exit(1);
    }
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* A film and its bytes. */
typedef struct subject {
    const rt_film *film;
    rt_film *twin;
    rt_film_saver *saver;
    uint8_t *bytes, *copy;
    size_t size;
} subject;

static void encode(const subject *s)
{
    size_t size;
    rt_error error;
    must(rt_film_encode(s->film, s->copy, s->size, &size, &error), &error);
}

static void decode(const subject *s)
{
    rt_film *film = NULL;
    rt_error error;
    must(rt_film_decode(&film, s->bytes, s->size, &error), &error);
    rt_film_destroy(film);
}

static void save(const subject *s)
{
    rt_error error;
    must(rt_film_save(s->film, path, &error), &error);
}

/* What a render waits for a checkpoint. Two films in turn: all of each has to be packed. */
static void put(const subject *s)
{
    static int turn;
    rt_error error;
    turn = !turn;
    must(rt_film_saver_put(s->saver, turn ? s->film : s->twin, &error), &error);
}

/* And with the writing beside it. */
static void put_and_write(const subject *s)
{
    rt_error error;
    put(s);
    must(rt_film_saver_wait(s->saver, &error), &error);
}

static void check(const subject *s)
{
    if (rt_checksum_of(s->bytes, s->size) == 1)
        puts("");
}

static void copy(const subject *s)
{
    memcpy(s->copy, s->bytes, s->size);
}

static void write_plainly(const subject *s)
{
    const rt_bytes bytes = {s->bytes, s->size, s->size, NULL};
    rt_error error;
    must(rt_file_replace(path, &bytes, &error), &error);
}

static void measure(const char *name, void (*work)(const subject *), const subject *s)
{
    double seconds[runs], busy[runs];
    for (int run = 0; run < runs; run++) {
        const double began = rt_clock();
        const clock_t busy_before = clock();
        work(s);
        busy[run] = (double)(clock() - busy_before) / CLOCKS_PER_SEC;
        seconds[run] = rt_clock() - began;
    }
    qsort(seconds, runs, sizeof *seconds, by_value);
    qsort(busy, runs, sizeof *busy, by_value);
    printf("  %-12s %7.3f s  %7.3f s of CPU\n", name, seconds[runs / 2], busy[runs / 2]);
}

/* The part of "saver" that a render waits for: the file before is written. */
static void measure_after(const subject *s)
{
    rt_error error;
    double seconds[runs];
    for (int run = 0; run < runs; run++) {
        const double began = rt_clock();
        put(s);
        seconds[run] = rt_clock() - began;
        must(rt_film_saver_wait(s->saver, &error), &error);
    }
    qsort(seconds, runs, sizeof *seconds, by_value);
    printf("  %-12s %7.3f s\n", "  waited for", seconds[runs / 2]);
}

static void bench(const char *name, rt_renderer *renderer, const rt_render_options *options)
{
    rt_film *film = NULL;
    rt_error error;
    subject s;
    must(rt_render(&film, renderer, options, &error), &error);
    s.film = film;
    must(rt_film_encode(film, NULL, 0, &s.size, &error), &error);
    s.bytes = malloc(s.size);
    s.copy = malloc(s.size);
    if (!s.bytes || !s.copy)
        exit(1);
    must(rt_film_encode(film, s.bytes, s.size, &s.size, &error), &error);
    printf("%s: %.1f MB, %.1f bytes a pixel\n", name, (double)s.size * 1e-6,
           (double)s.size / (options->width * options->height));
    measure("save", save, &s);
    must(rt_film_decode(&s.twin, s.bytes, s.size, &error), &error);
    must(rt_film_saver_create(&s.saver, path, &error), &error);
    measure("saver", put_and_write, &s);
    measure_after(&s);
    rt_film_saver_destroy(s.saver);
    rt_film_destroy(s.twin);
    measure("encode", encode, &s);
    measure("decode", decode, &s);
    measure("checksum", check, &s);
    measure("plain copy", copy, &s);
    measure("plain write", write_plainly, &s);
    unlink(path);
    free(s.bytes);
    free(s.copy);
    rt_film_destroy(film);
}

int main(int argc, char **argv)
{
    rt_render_options o = {.width = 1920, .height = 1080, .aov = 1, .part = 1, .parts = 1};
    rt_scene *scene = NULL;
    rt_device *device = NULL;
    rt_renderer *renderer = NULL;
    rt_error error;
    must(rt_scene_load(&scene, argc > 1 ? argv[1] : "scenes/cornell.rts", NULL, &error), &error);
    must(rt_device_open(&device, NULL, &error), &error);
    must(rt_renderer_create(&renderer, scene, device, NULL, &error), &error);
    o.spp = argc > 2 ? (uint32_t)strtoul(argv[2], NULL, 10) : 4;
    bench("path", renderer, &o);
    o.variance = 1;
    bench("path with the error", renderer, &o);
    o.variance = 0;
    o.mode = RT_MODE_PHOTON;
    o.photons = 20000;
    o.photon_layers = 1;
    bench("photon", renderer, &o);
    rt_renderer_destroy(renderer);
    rt_device_close(device);
    rt_scene_destroy(scene);
    return 0;
}
