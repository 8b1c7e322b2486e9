/* worker.c - renders what rank 0 gives, and hands over films when asked. */
#include "worker.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "../crew.h"
#include "../interrupt.h"

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static rt_status fail_memory(rt_error *error)
{
    *error = (rt_error){.status = RT_ERROR_MEMORY, .message = "out of memory"};
    return RT_ERROR_MEMORY;
}

char *worker_hello(void)
{
    const message hello = {.kind = MESSAGE_HELLO};
    wire_send(0, TAG_UP, &hello);
    const message answer = wire_receive(0, TAG_DOWN);
    char *text = answer.kind == MESSAGE_NOTE ? calloc(1, answer.count + 1) : NULL;
    if (text)
        wire_receive_bytes(0, TAG_DATA, text, answer.count);
    return text;
}

void worker_bye(worker *w, int status, const char *text)
{
    const message bye = {
        .kind = MESSAGE_BYE, .first = (uint64_t)status, .count = text ? strlen(text) : 0};
    wire_send(0, TAG_UP, &bye);
    wire_send_bytes(0, TAG_DATA, text, bye.count);
    free(w->buffer);
    w->buffer = NULL;
}

static int must_stop(void)
{
    return interrupt_pending() || wire_is_there(0, TAG_STOP, NULL);
}

static int on_progress(void *user, const rt_progress *progress)
{
    (void)user;
    (void)progress;
    return must_stop();
}

/* ---- The photon map ------------------------------------------------------------- */

/* Sends the part of the map that is this worker's. */
static rt_status send_part(const rt_photon_map *part, rt_error *error)
{
    size_t size;
    rt_status status = rt_photon_map_encode(part, NULL, 0, &size, error);
    void *data = status == RT_OK ? malloc(size) : NULL;
    if (status == RT_OK && !data)
        status = fail_memory(error);
    if (status == RT_OK)
        status = rt_photon_map_encode(part, data, size, &size, error);
    if (status == RT_OK) {
        const message head = {.kind = MESSAGE_MAP, .count = size};
        wire_send(0, TAG_UP, &head);
        wire_send_bytes(0, TAG_DATA, data, size);
    }
    free(data);
    return status;
}

/* Waits for the whole map, and passes it on. */
static rt_status receive_map(worker *w, rt_photon_map **out, rt_error *error)
{
    const int parent = wire_parent(w->rank);
    while (!wire_is_there(parent, TAG_MAP, NULL)) {
        if (must_stop())
            return RT_CANCELLED;
        wire_rest();
    }
    const message head = wire_receive(parent, TAG_MAP);
    void *data = malloc(head.count ? head.count : 1);
    if (!data)
        return fail_memory(error);
    wire_receive_bytes(parent, TAG_MAP, data, head.count);
    wire_pass_on(w->rank, w->ranks, data, head.count);
    rt_status status = rt_photon_map_decode(out, data, head.count, w->memory, error);
    free(data);
    return status;
}

/* Emits a part of the map, and gets the whole of it. */
static rt_status share_map(worker *w, rt_photon_map **out, rt_renderer *renderer,
                           const rt_render_options *options, rt_error *error)
{
    const rt_emit_options emit = {
        .render = options, .part = (uint32_t)w->rank, .parts = (uint32_t)w->ranks};
    rt_photon_map *part = NULL;
    rt_status status = rt_photon_map_emit(&part, renderer, &emit, error);
    if (status == RT_OK)
        status = send_part(part, error);
    rt_photon_map_destroy(part);
    return status == RT_OK ? receive_map(w, out, error) : status;
}

/* ---- Samples ---------------------------------------------------------------------- */

/* Asks for more, and tells what was rendered. */
static void ask(worker *w)
{
    w->finished.kind = MESSAGE_ASK;
    wire_send(0, TAG_UP, &w->finished);
    w->finished = (message){0};
    w->is_asked = 1;
}

/* The next units are asked for while these are rendered. */
static rt_units_answer next_units(void *user, uint64_t *first, uint64_t *count)
{
    worker *w = user;
    if (w->given.count > 0)
        w->finished = (message){
            .first = w->given.first, .count = w->given.count, .seconds = now() - w->began};
    w->given = (message){0};
    if (w->is_ended || w->status != RT_OK)
        return RT_UNITS_NONE;
    if (!w->is_asked)
        ask(w);
    const message answer = wire_receive(0, TAG_DOWN);
    w->is_asked = 0;
    if (answer.kind == MESSAGE_HAND_OVER)
        return RT_UNITS_SAVE;
    w->is_ended = answer.kind != MESSAGE_RENDER;
    if (w->is_ended)
        return RT_UNITS_NONE;
    ask(w);
    w->given = answer;
    w->began = now();
    *first = answer.first;
    *count = answer.count;
    return RT_UNITS_GIVEN;
}

/* Makes the bytes of a film, in a buffer that is kept. */
static rt_status encode(worker *w, const rt_film *film, size_t *size)
{
    rt_status status = rt_film_encode(film, NULL, 0, size, w->error);
    if (status == RT_OK && *size > w->capacity) {
        free(w->buffer);
        w->buffer = malloc(*size);
        w->capacity = w->buffer ? *size : 0;
        if (!w->buffer)
            return fail_memory(w->error);
    }
    return status == RT_OK ? rt_film_encode(film, w->buffer, w->capacity, size, w->error) : status;
}

static void hand_over(void *user, const rt_film *film)
{
    worker *w = user;
    rt_film_info info;
    size_t size;
    rt_film_get_info(film, &info);
    if (info.units_done == 0 || w->status != RT_OK)
        return;
    w->status = encode(w, film, &size);
    if (w->status != RT_OK)
        return;
    const message head = {.kind = MESSAGE_FILM, .count = size};
    wire_send(0, TAG_UP, &head);
    wire_send_bytes(0, TAG_DATA, w->buffer, size);
}

rt_status worker_render(void *user, rt_film **out, rt_renderer *renderer,
                        const rt_render_options *options, rt_error *error)
{
    worker *w = user;
    const rt_hooks hooks = {.progress = on_progress, .user = w};
    rt_render_options o = *options;
    rt_photon_map *map = NULL;
    rt_film *film = NULL;
    rt_status status = RT_OK;
    *out = NULL;
    w->error = error;
    o.hooks = &hooks;
    if (crew_emits(options)) {
        status = share_map(w, &map, renderer, &o, error);
        o.photon_map = map;
    }
    o.time = 0;
    o.resume = NULL;
    o.next_units = next_units;
    o.units_user = o.checkpoint_user = w;
    o.checkpoint = hand_over;
    o.checkpoint_seconds = INFINITY;
    o.hand_over = 1;
    if (status == RT_OK)
        status = rt_render(&film, renderer, &o, error);
    rt_film_destroy(film);
    rt_photon_map_destroy(map);
    /* An answer that nobody waits for any more. */
    if (w->is_asked)
        wire_receive(0, TAG_DOWN);
    return w->status == RT_OK ? status : w->status;
}
