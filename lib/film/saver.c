/*
 * saver.c - writes a film again and again while it is rendered: all cores pack what has changed
 * since the last time, and a thread writes all of it to the file while the render goes on.
 */
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "film/changed.h"
#include "film/film_file.h"

/* A packed band; its memory is used again by the next film. */
typedef struct band {
    uint8_t *data;
    size_t size, room;
    uint64_t runs;
} band;

struct rt_film_saver {
    char *path;
    rt_memory *memory; /* that the bands count in */
    band *bands;
    size_t count;
    uint8_t *changed; /* [count], bands that are to be packed */
    rt_film_state state;
    rt_bytes head;
    pthread_t thread;
    int is_writing;   /* the thread has to be joined */
    rt_status status; /* of the last writing, */
    rt_error error;   /* and why, until it is told */
};

/* ---- Packing ------------------------------------------------------------------ */

/* A film being packed by several threads; each takes every threads-th band that has changed. */
typedef struct packing {
    rt_film_saver *saver;
    const rt_film *film;
    uint32_t threads;
    rt_status *status; /* [threads] */
} packing;

/* Copies the bytes of a band, which has room for them or gets it. */
static rt_status keep(band *b, const uint8_t *bytes, size_t size, rt_memory *memory)
{
    rt_error error;
    if (size > b->room) {
        /* A little more, as the sums of the next film are longer. */
        const size_t room = size + size / 16;
        uint8_t *data = rt_memory_alloc(memory, room, 1, "a checkpoint", &error);
        if (!data)
            return RT_ERROR_MEMORY;
        rt_memory_free(b->data);
        b->data = data;
        b->room = room;
    }
    if (size > 0)
        memcpy(b->data, bytes, size);
    b->size = size;
    return RT_OK;
}

static void pack_some(void *user, uint32_t thread)
{
    const packing *p = user;
    rt_film_saver *saver = p->saver;
    uint8_t *bytes = malloc(rt_film_band_most(p->film));
    rt_status status = bytes ? RT_OK : RT_ERROR_MEMORY;
    for (size_t i = thread; i < saver->count && status == RT_OK; i += p->threads) {
        if (!saver->changed[i])
            continue;
        band *b = saver->bands + i;
        const size_t size = rt_film_put_band(bytes, &b->runs, p->film, i);
        status = keep(b, bytes, size, saver->memory);
    }
    p->status[thread] = status;
    free(bytes);
}

static void free_bands(rt_film_saver *saver)
{
    for (size_t i = 0; i < saver->count; i++)
        rt_memory_free(saver->bands[i].data);
    free(saver->bands);
    free(saver->changed);
    rt_film_state_free(&saver->state);
    saver->bands = NULL;
    saver->changed = NULL;
    saver->count = 0;
    rt_bytes_free(&saver->head);
}

/* Makes as many bands as the film has, in place of those of another film. */
static rt_status make_bands(rt_film_saver *saver, const rt_film *film)
{
    const size_t count = rt_film_bands(film);
    rt_bytes_free(&saver->head);
    if (saver->count == count && saver->memory == film->memory)
        return RT_OK;
    free_bands(saver);
    saver->memory = film->memory;
    saver->bands = calloc(count, sizeof *saver->bands);
    saver->changed = malloc(count);
    saver->count = saver->bands ? count : 0;
    return saver->bands && saver->changed ? RT_OK : RT_ERROR_MEMORY;
}

/* Takes what the film holds; with RT_ERROR_MEMORY nothing, and no message. */
static rt_status pack(rt_film_saver *saver, const rt_film *film, rt_error *error)
{
    enum { THREADS_MAX = 16 };
    rt_status done[THREADS_MAX];
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    packing p = {saver, film,
                 cores < 1             ? 1
                 : cores < THREADS_MAX ? (uint32_t)cores
                                       : THREADS_MAX,
                 done};
    rt_status status = make_bands(saver, film);
    if (status != RT_OK)
        return status;
    rt_film_changed(saver->changed, film, &saver->state);
    rt_film_state_free(&saver->state);
    rt_parallel(p.threads, p.threads, pack_some, &p);
    for (uint32_t i = 0; i < p.threads && status == RT_OK; i++)
        status = done[i];
    size_t size = 0;
    uint64_t runs = 0;
    for (size_t i = 0; i < saver->count; i++) {
        size += saver->bands[i].size;
        runs += saver->bands[i].runs;
    }
    if (status == RT_OK)
        rt_film_state_take(&saver->state, film);
    return status == RT_OK ? rt_film_put_head(&saver->head, film, runs, size, error) : status;
}

/* ---- Writing ------------------------------------------------------------------ */

static int put_content(const void *user, int fd)
{
    const rt_film_saver *saver = user;
    uint8_t end[RT_FRAME_CHECKSUM];
    rt_checksum sum = rt_checksum_begin();
    rt_checksum_add(&sum, saver->head.data, saver->head.size);
    int code = rt_file_put(fd, saver->head.data, saver->head.size);
    for (size_t i = 0; i < saver->count && !code; i++) {
        rt_checksum_add(&sum, saver->bands[i].data, saver->bands[i].size);
        code = rt_file_put(fd, saver->bands[i].data, saver->bands[i].size);
    }
    rt_put64(&(rt_writer){end}, rt_checksum_end(&sum));
    return code ? code : rt_file_put(fd, end, sizeof end);
}

static void *write_file(void *user)
{
    rt_film_saver *saver = user;
    saver->status = rt_file_replace_by(saver->path, put_content, saver, &saver->error);
    return NULL;
}

rt_status rt_film_saver_create(rt_film_saver **out, const char *path, rt_error *error)
{
    if (rt_is_missing(path, "path", error))
        return RT_ERROR_USAGE;
    rt_film_saver *saver = calloc(1, sizeof *saver);
    char *copy = malloc(strlen(path) + 1);
    if (!saver || !copy) {
        free(saver);
        free(copy);
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory to write a film");
    }
    saver->path = strcpy(copy, path);
    *out = saver;
    return RT_OK;
}

rt_status rt_film_saver_wait(rt_film_saver *saver, rt_error *error)
{
    if (rt_is_missing(saver, "saver", error))
        return RT_ERROR_USAGE;
    if (saver->is_writing)
        pthread_join(saver->thread, NULL);
    saver->is_writing = 0;
    const rt_status status = saver->status;
    saver->status = RT_OK;
    if (status != RT_OK && error)
        *error = saver->error;
    return status;
}

rt_status rt_film_saver_put(rt_film_saver *saver, const rt_film *film, rt_error *error)
{
    if (rt_is_missing(saver, "saver", error) || rt_is_missing(film, "film", error))
        return RT_ERROR_USAGE;
    const rt_status before = rt_film_saver_wait(saver, error);
    rt_status status = pack(saver, film, error);
    if (status == RT_ERROR_MEMORY) {
        /* Without memory for it all, band by band, and the render waits. */
        free_bands(saver);
        status = rt_film_save(film, saver->path, error);
    } else if (status == RT_OK) {
        saver->is_writing = pthread_create(&saver->thread, NULL, write_file, saver) == 0;
        if (!saver->is_writing)
            write_file(saver);
    }
    return status == RT_OK ? before : status;
}

void rt_film_saver_destroy(rt_film_saver *saver)
{
    if (!saver)
        return;
    rt_film_saver_wait(saver, NULL);
    free_bands(saver);
    free(saver->path);
    free(saver);
}
