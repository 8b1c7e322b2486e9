/* worker.c - renders what rank 0 gives, and hands over films when asked. */
#include "worker.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "../crew.h"
#include "../interrupt.h"
#include "../status.h"

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

/* Adds the film that another worker hands over, if it has one, to the sum of those. */
static rt_status add_film(worker *w, const void *data, size_t size)
{
    rt_film *film = NULL;
    rt_status status = rt_film_decode(&film, data, size, w->error);
    if (status == RT_OK && w->sum)
        status = rt_film_add(w->sum, film, w->error);
    else if (status == RT_OK) {
        w->sum = film;
        return RT_OK;
    }
    rt_film_destroy(film);
    return status;
}

/* Waits for the film of another worker, which sends one, if only an empty one, whatever happens. */
static void collect(worker *w, int from)
{
    const message head = wire_receive(from, TAG_FILM);
    message collected = {.kind = MESSAGE_COLLECTED, .first = (uint64_t)from};
    void *data = malloc(head.count + 1);
    if (!data)
        wire_abort(STATUS_DEVICE);
    wire_receive_bytes(from, TAG_FILM, data, head.count);
    if (head.count > 0 && w->status == RT_OK) {
        w->status = add_film(w, data, head.count);
        collected.count = w->status == RT_OK;
    }
    wire_send(0, TAG_UP, &collected);
    free(data);
}

/* The answer to the last question; other workers' films are collected meanwhile. */
static message receive_answer(worker *w)
{
    for (;;) {
        const message answer = wire_receive(0, TAG_DOWN);
        w->is_asked = 0;
        if (answer.kind != MESSAGE_COLLECT)
            return answer;
        collect(w, (int)answer.first);
        ask(w);
    }
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
    const message answer = receive_answer(w);
    if (answer.kind == MESSAGE_HAND_OVER) {
        w->to = (int)answer.first;
        return RT_UNITS_SAVE;
    }
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

/* Sends the bytes of a film to whom it was to go; another worker waits for them even without. */
static void send_film(worker *w, size_t size)
{
    const message head = {.kind = MESSAGE_FILM, .count = size};
    if (size > 0 || w->to > 0) {
        wire_send(w->to, w->to > 0 ? TAG_FILM : TAG_UP, &head);
        wire_send_bytes(w->to, w->to > 0 ? TAG_FILM : TAG_DATA, w->buffer, size);
    }
    w->to = 0;
}

/* Hands the film over, with those of others; film: NULL where there are these alone. */
static void hand_over(void *user, const rt_film *film)
{
    worker *w = user;
    rt_film_info info = {0};
    size_t size = 0;
    if (film)
        rt_film_get_info(film, &info);
    if (w->status == RT_OK && w->sum && info.units_done > 0)
        w->status = rt_film_add(w->sum, film, w->error);
    if (w->status == RT_OK && (w->sum || info.units_done > 0))
        w->status = encode(w, w->sum ? w->sum : film, &size);
    send_film(w, w->status == RT_OK ? size : 0);
    rt_film_destroy(w->sum);
    w->sum = NULL;
}

/* Does what others count on when a question is answered that came too early. */
static void settle(worker *w)
{
    if (w->is_asked) {
        const message answer = wire_receive(0, TAG_DOWN);
        w->is_asked = 0;
        if (answer.kind == MESSAGE_COLLECT)
            collect(w, (int)answer.first);
        if (answer.kind == MESSAGE_HAND_OVER)
            w->to = (int)answer.first;
    }
    hand_over(w, NULL);
}

/* Asks what a film that is raised had; returns whether there is something to render. */
static int begin(rt_render_options *options)
{
    const message question = {.kind = MESSAGE_BEGIN};
    wire_send(0, TAG_UP, &question);
    const message answer = wire_receive(0, TAG_DOWN);
    options->raised_from = (uint32_t)answer.first;
    return answer.kind == MESSAGE_RAISED;
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
    o.resume = NULL;
    o.next_units = next_units;
    o.units_user = o.checkpoint_user = w;
    o.checkpoint = hand_over;
    o.checkpoint_seconds = INFINITY;
    o.hand_over = 1;
    if (status == RT_OK && begin(&o))
        status = rt_render(&film, renderer, &o, error);
    rt_film_destroy(film);
    rt_photon_map_destroy(map);
    settle(w);
    return w->status == RT_OK ? status : w->status;
}
