/*
 * measure.c - what a scene costs one thread of this machine: the figures that simulate.c starts
 * from, as lines "NAME=VALUE".
 *
 *     measure SCENE.rts [chunks]
 *
 * The scene's own size and depth count; its samples and mode do not. It takes about a minute, or
 * ten seconds for the figures of chunks alone.
 */
#include <math.h>
#include <rt/rt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* Chunks of `longest` samples a pixel come last in a render of so many samples. */
enum { longest = 32, samples = 128, most_chunks = 48, paths = 400000 };

/* Ends the program when something fails. */
static void need(int is_done, const rt_error *error)
{
    if (is_done)
        return;
    fprintf(stderr, "measure: %s\n", error->message);
    exit(1);
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void say(const char *name, double value, const char *what)
{
    printf("%s=%.4g%*s# %s\n", name, value, 2, "", what);
    fflush(stdout);
}

/* ---- Chunks ---------------------------------------------------------------------------------- */

/* The pixels of a chunk, and how many chunks a block of samples of the picture has. */
static uint64_t bands_of(uint64_t *chunk_pixels, const rt_render_options *options)
{
    const uint64_t pixels = (uint64_t)options->width * options->height;
    uint64_t first;
    rt_error error;
    need(rt_chunk_units(&first, chunk_pixels, options, 0, 1, &error) == RT_OK, &error);
    return (pixels + *chunk_pixels - 1) / *chunk_pixels;
}

/* Hands out every `step`th of the chunks from `at` on, and notes when. */
typedef struct dispenser {
    const rt_render_options *options;
    uint64_t at, end, step;
    double began[most_chunks + 1];
    int count; /* of those handed out */
} dispenser;

static rt_units_answer next(void *user, uint64_t *first, uint64_t *count)
{
    dispenser *d = user;
    rt_error error;
    d->began[d->count] = now();
    if (d->at >= d->end || d->count == most_chunks)
        return RT_UNITS_NONE;
    need(rt_chunk_units(first, count, d->options, d->at, 1, &error) == RT_OK, &error);
    d->at += d->step;
    d->count++;
    return RT_UNITS_GIVEN;
}

/* Renders some of the chunks first .. end - 1, evenly apart, and returns the film of all. */
static rt_film *render(dispenser *d, rt_renderer *renderer, rt_render_options options,
                       uint64_t first, uint64_t end)
{
    rt_error error;
    rt_film *film;
    *d = (dispenser){&options, first, end, (end - first + most_chunks - 1) / most_chunks, {0}, 0};
    options.next_units = next;
    options.units_user = d;
    need(rt_render(&film, renderer, &options, &error) == RT_OK, &error);
    return film;
}

/* Mean of the chunks' seconds, and their standard deviation over it. */
static double mean_of(const dispenser *d, double *deviation)
{
    double sum = 0, squares = 0;
    for (int i = 0; i < d->count; i++) {
        const double t = d->began[i + 1] - d->began[i];
        sum += t;
        squares += t * t;
    }
    const double mean = sum / d->count;
    *deviation = sqrt(fmax(squares / d->count - mean * mean, 0)) / mean;
    return mean;
}

static void measure_chunks(rt_renderer *renderer, rt_render_options options)
{
    rt_error error;
    dispenser d;
    uint64_t chunks, chunk_pixels;
    double deviation;

    options.mode = RT_MODE_PATH;
    options.spp = samples;
    const uint64_t columns = bands_of(&chunk_pixels, &options);
    need(rt_chunk_count(&chunks, &options, &error) == RT_OK, &error);
    rt_film_destroy(render(&d, renderer, options, 0, columns));
    const double one = mean_of(&d, &deviation);
    rt_film_destroy(render(&d, renderer, options, chunks - columns, chunks));
    const double most = mean_of(&d, &deviation);
    const double each = (most - one) / (longest - 1);
    say("sample", each / (double)chunk_pixels, "s, one sample of one pixel by one thread");
    say("chunk", fmax(one - each, 0), "s, what a chunk costs beside its samples");
    say("spread", deviation, "standard deviation of a chunk's time over its mean");
}

/* ---- Films ----------------------------------------------------------------------------------- */

/* A film of every pixel, by the chunks of a block: 1, the last one, or 2, the one before. */
static rt_film *film_of(rt_renderer *renderer, rt_render_options options, uint64_t block)
{
    uint64_t chunks, chunk_pixels;
    rt_film *film;
    rt_error error;
    options.mode = RT_MODE_PATH;
    options.spp = samples;
    const uint64_t columns = bands_of(&chunk_pixels, &options);
    need(rt_chunk_count(&chunks, &options, &error) == RT_OK, &error);
    need(rt_chunk_render(&film, renderer, &options, chunks - block * columns, columns, &error) ==
             RT_OK,
         &error);
    return film;
}

static void measure_films(rt_renderer *renderer, const rt_render_options *options)
{
    const double pixels = (double)options->width * options->height;
    rt_film *a = film_of(renderer, *options, 1), *b = film_of(renderer, *options, 2), *c;
    rt_error error;
    size_t size;

    need(rt_film_encode(a, NULL, 0, &size, &error) == RT_OK, &error);
    void *bytes = malloc(size);
    const double t0 = now();
    need(bytes && rt_film_encode(a, bytes, size, &size, &error) == RT_OK, &error);
    const double t1 = now();
    need(rt_film_decode(&c, bytes, size, &error) == RT_OK, &error);
    const double t2 = now();
    need(rt_film_add(b, c, &error) == RT_OK, &error);
    const double t3 = now();
    need(rt_film_resolve(b, NULL, &error) == RT_OK, &error);
    const double t4 = now();
    say("pixel_bytes", (double)size / pixels, "bytes, a pixel of a film on its way");
    say("encode", (t1 - t0) / pixels, "s, a pixel");
    say("decode", (t2 - t1) / pixels, "s, a pixel");
    say("add", (t3 - t2) / pixels, "s, a pixel");
    say("resolve", (t4 - t3) / pixels, "s, a pixel");
    free(bytes);
    rt_film_destroy(a);
    rt_film_destroy(b);
    rt_film_destroy(c);
}

/* ---- Photons --------------------------------------------------------------------------------- */

/* Seconds of camera paths, gathering and building the tree, for so many samples a pixel. */
static double gather(rt_renderer *renderer, rt_render_options options, uint32_t spp)
{
    rt_film *film;
    rt_error error;
    options.spp = spp;
    const double began = now();
    need(rt_render(&film, renderer, &options, &error) == RT_OK, &error);
    rt_film_destroy(film);
    return now() - began;
}

static void measure_photons(rt_renderer *renderer, rt_render_options options)
{
    const double pixels = (double)options.width * options.height;
    rt_photon_map *map;
    rt_error error;

    options.mode = RT_MODE_PHOTON;
    options.photons = paths;
    options.gather = RT_GATHER_DEVICE;
    const rt_emit_options emit = {.render = &options};
    const double began = now();
    need(rt_photon_map_emit(&map, renderer, &emit, &error) == RT_OK, &error);
    const double emitted = now() - began, stored = (double)rt_photon_map_count(map, 0);
    options.photon_map = map;
    gather(renderer, options, 1);
    const double one = gather(renderer, options, 1), three = gather(renderer, options, 3);
    say("path", emitted / paths, "s, one photon path");
    say("stored", stored / paths, "photons that a path leaves");
    say("gather", (three - one) / 2 / pixels, "s, one sample with its gathering");
    say("tree", fmax(one - (three - one) / 2, 0) / stored, "s, a photon, of building the tree");
    rt_photon_map_destroy(map);
}

int main(int argc, char **argv)
{
    const rt_device_options one_thread = {.threads = 1};
    rt_error error = {.message = "SCENE.rts [chunks]"};
    rt_render_options options;
    rt_scene *scene;
    rt_device *device;
    rt_renderer *renderer;
    dispenser d;

    const int is_whole = argc == 2;
    need(is_whole || (argc == 3 && strcmp(argv[2], "chunks") == 0), &error);
    need(rt_scene_load(&scene, argv[1], NULL, &error) == RT_OK, &error);
    rt_scene_get_options(scene, &options);
    options.spp = 1;
    const double began = now();
    need(rt_device_open(&device, &one_thread, &error) == RT_OK, &error);
    need(rt_renderer_create(&renderer, scene, device, NULL, &error) == RT_OK, &error);
    rt_film_destroy(render(&d, renderer, options, 0, 1));
    say("start", now() - began, "s, until a process has its first chunk");
    measure_chunks(renderer, options);
    if (is_whole) {
        measure_films(renderer, &options);
        measure_photons(renderer, options);
    }
    rt_renderer_destroy(renderer);
    rt_device_close(device);
    rt_scene_destroy(scene);
    return 0;
}
