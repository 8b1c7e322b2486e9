/* lead.c - the thread of rank 0 that talks to the workers. */
#include "lead.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "../crew.h"
#include "../interrupt.h"
#include "../status.h"

/*
 * Seconds to wait for the films of workers after an interrupt: Open MPI kills all processes a
 * second after it has passed one on.
 */
static const double patience = 0.7, patience_elsewhere = 10;

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

int lead_begin(lead *out, int ranks)
{
    memset(out, 0, sizeof *out);
    out->ranks = ranks;
    out->note = "";
    pthread_mutex_init(&out->lock, NULL);
    out->left = out->ranks - 1;
    out->members = calloc((size_t)out->ranks, sizeof *out->members);
    return out->members != NULL;
}

void lead_free(lead *l)
{
    for (int i = 0; i < l->ranks && l->members; i++)
        rt_photon_map_destroy(l->members[i].part);
    free(l->members);
    free(l->map);
    pthread_mutex_destroy(&l->lock);
}

/* ---- What workers say ------------------------------------------------------------- */

/* Notes why the render has to end; the first reason counts. */
static void fail(lead *l, int rank, int status, const char *why)
{
    static const char prefix[] = "rtc: error: ";
    const char *text = strstr(why, prefix);
    text = text ? text + strlen(prefix) : why;
    pthread_mutex_lock(&l->lock);
    if (l->status == 0)
        snprintf(l->why, sizeof l->why, "rank %d: %.*s", rank, (int)strcspn(text, "\n"), text);
    l->status = l->status ? l->status : status;
    pthread_mutex_unlock(&l->lock);
}

/* The bytes behind a message, with a zero byte; NULL where there is no memory for them. */
static char *receive(lead *l, int rank, const message *m)
{
    char *data = malloc(m->count + 1);
    if (!data) {
        fail(l, 0, STATUS_DEVICE, "out of memory");
        wire_abort(STATUS_DEVICE);
        return NULL;
    }
    wire_receive_bytes(rank, TAG_DATA, data, m->count);
    data[m->count] = '\0';
    return data;
}

static void take_film(lead *l, int rank, const message *m)
{
    const double began = now();
    rt_film *film = NULL;
    rt_error error;
    char *data = receive(l, rank, m);
    l->members[rank].is_sending = 0;
    rt_status status = rt_film_decode(&film, data, m->count, &error);
    if (status == RT_OK)
        status = rt_share_add(l->share, l->members[rank].worker, film, now() - began, &error);
    if (status != RT_OK)
        fail(l, rank, STATUS_INPUT, error.message);
    rt_film_destroy(film);
    free(data);
}

/* A rank has the film of another, or was told that there is none. */
static void take_collected(lead *l, int rank, const message *m)
{
    member *from = l->members + m->first;
    if (m->count > 0)
        rt_share_pass(l->share, from->worker, l->members[rank].worker);
    from->passes_to = 0;
    if (from->is_gone)
        rt_share_leave(l->share, from->worker);
}

static void take_part(lead *l, int rank, const message *m)
{
    rt_error error;
    char *data = receive(l, rank, m);
    if (rt_photon_map_decode(&l->members[rank].part, data, m->count, l->memory, &error) != RT_OK)
        fail(l, rank, STATUS_INPUT, error.message);
    pthread_mutex_lock(&l->lock);
    l->parts++;
    pthread_mutex_unlock(&l->lock);
    free(data);
}

static void take_leave(lead *l, int rank, const message *m)
{
    member *from = l->members + rank;
    char *text = receive(l, rank, m);
    const int status = (int)m->first;
    if (status != STATUS_DONE && status != STATUS_INTERRUPTED)
        fail(l, rank, status, text[0] ? text : "it failed without a word");
    if (from->has_joined && !from->passes_to)
        rt_share_leave(l->share, from->worker);
    from->is_gone = 1;
    from->is_sending = 0;
    l->left--;
    free(text);
}

static void answer_hello(lead *l, int rank)
{
    pthread_mutex_lock(&l->lock);
    const int is_over = l->is_over;
    pthread_mutex_unlock(&l->lock);
    const message answer = {.kind = is_over ? MESSAGE_END : MESSAGE_NOTE,
                            .count = is_over ? 0 : strlen(l->note)};
    wire_send(rank, TAG_DOWN, &answer);
    wire_send_bytes(rank, TAG_DATA, l->note, answer.count);
}

static void take_question(lead *l, int rank, const message *m)
{
    member *from = l->members + rank;
    if (from->has_joined && m->count > 0)
        rt_share_note(l->share, from->worker, m->first, m->count, m->seconds);
    from->is_waiting = 1;
    from->is_new = m->kind == MESSAGE_BEGIN;
    from->is_sending = 0;
}

static void take(lead *l, int rank)
{
    const message m = wire_receive(rank, TAG_UP);
    switch ((message_kind)m.kind) {
    case MESSAGE_HELLO:
        answer_hello(l, rank);
        break;
    case MESSAGE_BEGIN:
    case MESSAGE_ASK:
        take_question(l, rank, &m);
        break;
    case MESSAGE_FILM:
        take_film(l, rank, &m);
        break;
    case MESSAGE_COLLECTED:
        take_collected(l, rank, &m);
        break;
    case MESSAGE_MAP:
        take_part(l, rank, &m);
        break;
    case MESSAGE_BYE:
        take_leave(l, rank, &m);
        break;
    case MESSAGE_NOTE:
    case MESSAGE_RAISED:
    case MESSAGE_RENDER:
    case MESSAGE_HAND_OVER:
    case MESSAGE_COLLECT:
    case MESSAGE_END:
        break;
    }
}

/* ---- What they are told ------------------------------------------------------------- */

static void tell(lead *l, int rank, message m)
{
    wire_send(rank, TAG_DOWN, &m);
    l->members[rank].is_waiting = 0;
}

/* What a worker is to do, if it waits and there is something; else MESSAGE_NOTE. */
static message task_of(lead *l, int rank, rt_share *share, int is_over)
{
    static const message_kind kinds[] = {[RT_SHARE_END] = MESSAGE_END,
                                         [RT_SHARE_RENDER] = MESSAGE_RENDER,
                                         [RT_SHARE_HAND_OVER] = MESSAGE_HAND_OVER,
                                         [RT_SHARE_WAIT] = MESSAGE_NOTE};
    member *to = l->members + rank;
    rt_error error;
    message m = {.kind = is_over ? MESSAGE_END : MESSAGE_NOTE};
    if (!to->is_waiting || !share)
        return to->is_waiting ? m : (message){.kind = MESSAGE_NOTE};
    if (to->is_new)
        return (message){.kind = MESSAGE_RAISED, .first = rt_share_raised_from(share)};
    if (to->passes_to)
        return (message){.kind = MESSAGE_NOTE};
    if (!to->has_joined)
        to->has_joined = rt_share_join(&to->worker, share, &error) == RT_OK;
    if (to->has_joined)
        m.kind = kinds[rt_share_ask(share, to->worker, &m.first, &m.count)];
    else
        m.kind = MESSAGE_END;
    if (m.kind == MESSAGE_HAND_OVER)
        m.first = 0;
    return m;
}

/* A worker hands its film to another, which adds it to its own. */
static void pair(lead *l, int from, int to)
{
    l->members[from].passes_to = to;
    tell(l, to, (message){.kind = MESSAGE_COLLECT, .first = (uint64_t)from});
    tell(l, from, (message){.kind = MESSAGE_HAND_OVER, .first = (uint64_t)to});
}

/*
 * Answers those that wait, where there is an answer. While one film is on its way to this process,
 * others that are due come together in pairs: so many films take as many steps as a tree has.
 */
static void answer_all(lead *l, rt_share *share, int is_over)
{
    int is_sent = 0, single = 0;
    for (int i = 1; i < l->ranks; i++)
        is_sent |= l->members[i].is_sending;
    for (int i = 1; i < l->ranks; i++) {
        const message m = task_of(l, i, share, is_over);
        if (m.kind == MESSAGE_HAND_OVER && is_sent && single) {
            pair(l, i, single);
            single = 0;
        } else if (m.kind == MESSAGE_HAND_OVER && is_sent) {
            single = i;
        } else if (m.kind != MESSAGE_NOTE) {
            is_sent |= l->members[i].is_sending = m.kind == MESSAGE_HAND_OVER;
            tell(l, i, m);
        }
    }
}

/* Tells all to stop, once, and no longer waits for them than is wise. */
static void stop(lead *l, rt_share *share)
{
    const message m = {.kind = MESSAGE_END};
    if (share)
        rt_share_stop(share);
    for (int i = 1; i < l->ranks && !l->has_stopped; i++)
        if (!l->members[i].is_gone)
            wire_send(i, TAG_STOP, &m);
    l->has_stopped = 1;
    if (l->deadline == 0 && interrupt_pending())
        l->deadline = now() + (getenv("OMPI_COMM_WORLD_SIZE") ? patience : patience_elsewhere);
}

/* Talks to the workers until the last one has ended. */
static void talk(lead *l)
{
    int rank;
    while (l->left > 0 && (l->deadline == 0 || now() < l->deadline)) {
        if (wire_is_there(WIRE_ANY, TAG_UP, &rank)) {
            take(l, rank);
            continue;
        }
        pthread_mutex_lock(&l->lock);
        rt_share *share = l->share;
        const int is_over = l->is_over, has_map = l->map != NULL;
        pthread_mutex_unlock(&l->lock);
        if (l->status != 0 || is_over || interrupt_pending())
            stop(l, share);
        else if (has_map && !l->map_is_sent) {
            wire_pass_on(0, l->ranks, l->map, l->map_size);
            l->map_is_sent = 1;
        }
        answer_all(l, share, is_over || l->has_stopped);
        wire_rest();
    }
}

static void *talk_on_thread(void *data)
{
    lead *l = data;
    talk(l);
    pthread_mutex_lock(&l->lock);
    if (l->status != 0 && l->share)
        rt_share_stop(l->share);
    pthread_mutex_unlock(&l->lock);
    return NULL;
}

void lead_end(lead *l)
{
    pthread_mutex_lock(&l->lock);
    l->is_over = 1;
    l->share = NULL;
    pthread_mutex_unlock(&l->lock);
    /* A worker that waits for the photon map learns of the end by this. */
    if (l->left > 0)
        stop(l, NULL);
    talk(l);
}

/* ---- The render --------------------------------------------------------------------- */

/* What the library would say of a failure like that of a worker. */
static rt_status failure_of(const lead *l, rt_error *error)
{
    static const rt_status statuses[] = {[STATUS_INPUT] = RT_ERROR_INPUT,
                                         [STATUS_USAGE] = RT_ERROR_USAGE,
                                         [STATUS_DEVICE] = RT_ERROR_DEVICE,
                                         [STATUS_OUTPUT] = RT_ERROR_OUTPUT};
    *error =
        (rt_error){.status = l->status <= STATUS_OUTPUT ? statuses[l->status] : RT_ERROR_DEVICE};
    snprintf(error->message, sizeof error->message, "%s", l->why);
    return error->status;
}

rt_status lead_render(void *user, rt_film **out, rt_renderer *renderer,
                      const rt_render_options *options, rt_error *error)
{
    lead *l = user;
    rt_render_options o = *options;
    rt_photon_map *map = NULL;
    rt_share *share = NULL;
    rt_status status = RT_OK;
    pthread_t thread;
    if (pthread_create(&thread, NULL, talk_on_thread, l) != 0) {
        *error = (rt_error){.status = RT_ERROR_MEMORY, .message = "no thread can be started"};
        return RT_ERROR_MEMORY;
    }
    if (crew_emits(options)) {
        status = lead_share_map(l, &map, renderer, options, error);
        o.photon_map = map;
    }
    if (status == RT_OK)
        status = rt_share_create(&share, renderer, &o, error);
    pthread_mutex_lock(&l->lock);
    l->share = share;
    l->is_over = status != RT_OK;
    if (share && l->status != 0)
        rt_share_stop(share);
    pthread_mutex_unlock(&l->lock);
    if (status == RT_OK)
        status = rt_share_render(share, renderer, o.hooks, error);
    pthread_join(thread, NULL);
    if (share && (status == RT_OK || status == RT_CANCELLED))
        status = rt_share_finish(out, share, o.hooks, error);
    if (l->status != 0) {
        rt_film_destroy(*out);
        *out = NULL;
        status = failure_of(l, error);
    }
    pthread_mutex_lock(&l->lock);
    l->share = NULL;
    pthread_mutex_unlock(&l->lock);
    rt_share_destroy(share);
    rt_photon_map_destroy(map);
    return status;
}
