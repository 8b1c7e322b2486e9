/* board.c - the pictures and messages of a render, between its thread and those that show them. */
#include "board.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

void board_begin(board *out, const char *title)
{
    pthread_condattr_t how;
    memset(out, 0, sizeof *out);
    pthread_mutex_init(&out->lock, NULL);
    pthread_condattr_init(&how);
    pthread_condattr_setclock(&how, CLOCK_MONOTONIC); /* which nobody sets back */
    pthread_cond_init(&out->changed, &how);
    pthread_condattr_destroy(&how);
    snprintf(out->title, sizeof out->title, "%s", title);
    out->progress.remaining = out->progress.error = -1;
    out->layer_count = 1;
    out->layers[0].is_wanted = 1;
    out->version = out->message_version = 1;
}

/* Tells everybody of a change; called with the lock. */
static void tell(board *b)
{
    b->version++;
    pthread_cond_broadcast(&b->changed);
    if (b->wake)
        b->wake(b->wake_user);
}

/* ---- Pictures ----------------------------------------------------------------- */

static const char owner[] = "the preview";

/* A picture without values; NULL where there is no memory. */
static board_picture *make_picture(uint32_t width, uint32_t height, uint32_t channels,
                                   rt_memory *memory)
{
    rt_error error;
    const size_t bytes = (size_t)width * height * channels * sizeof(float);
    if (rt_memory_take(memory, bytes, owner, &error) != RT_OK)
        return NULL;
    board_picture *made = calloc(1, sizeof *made);
    float *values = malloc(bytes);
    if (!made || !values) {
        free(made);
        free(values);
        rt_memory_give(memory, bytes, owner);
        return NULL;
    }
    *made = (board_picture){memory, 1, 0, width, height, channels, bytes, values};
    return made;
}

/* Holders count by atomic operations: a picture is let go with the lock and without. */
static void hold(board_picture *picture)
{
    __atomic_add_fetch(&picture->holders, 1, __ATOMIC_RELAXED);
}

void board_give(board_picture *picture)
{
    if (!picture || __atomic_sub_fetch(&picture->holders, 1, __ATOMIC_ACQ_REL) > 0)
        return;
    rt_memory_give(picture->memory, picture->bytes, owner);
    free(picture->values);
    free(picture);
}

void board_free(board *board)
{
    for (size_t i = 0; i < board->layer_count; i++)
        board_give(board->layers[i].picture);
    pthread_cond_destroy(&board->changed);
    pthread_mutex_destroy(&board->lock);
}

/* Each pixel scale x scale times, cut to the size of `out`. */
static void enlarge(board_picture *out, const board_picture *small, uint32_t scale)
{
    const size_t n = out->channels;
    for (uint32_t y = 0; y < out->height; y++) {
        const uint32_t row = y / scale < small->height ? y / scale : small->height - 1;
        for (uint32_t x = 0; x < out->width; x++) {
            const uint32_t column = x / scale < small->width ? x / scale : small->width - 1;
            memcpy(out->values + n * ((size_t)y * out->width + x),
                   small->values + n * ((size_t)row * small->width + column),
                   n * sizeof *out->values);
        }
    }
}

/* What a film shows of a layer, "" for its radiance; NULL where there is no memory, or no layer. */
static board_picture *picture_of(const rt_film *film, const char *name, rt_memory *memory)
{
    uint32_t width, height, channels;
    rt_error error;
    const char *layer = name[0] ? name : NULL;
    rt_film_get_size(film, &width, &height);
    if (rt_film_preview(NULL, film, layer, &channels, &error) != RT_OK)
        return NULL;
    board_picture *made = make_picture(width, height, channels, memory);
    if (made)
        rt_film_preview(made->values, film, layer, NULL, &error);
    return made;
}

static board_picture *enlarged(board_picture *small, uint32_t scale, uint32_t width,
                               uint32_t height)
{
    if (!small || scale == 1)
        return small;
    board_picture *made = make_picture(width, height, small->channels, small->memory);
    if (made)
        enlarge(made, small, scale);
    board_give(small);
    return made;
}

/* Puts a picture in the place of a layer's last one. */
static void put(board *b, size_t layer, board_picture *picture)
{
    board_layer *l = b->layers + layer;
    pthread_mutex_lock(&b->lock);
    board_picture *last = l->picture;
    picture->number = ++b->pictures;
    l->picture = picture;
    l->is_fresh = 1;
    tell(b);
    pthread_mutex_unlock(&b->lock);
    board_give(last);
}

int board_put_film(board *b, const rt_film *film, rt_memory *memory, int all, uint32_t scale,
                   uint32_t width, uint32_t height)
{
    int is_good = 1;
    for (size_t i = 0; i < b->layer_count; i++) {
        pthread_mutex_lock(&b->lock);
        const int is_wanted = all || b->layers[i].is_wanted;
        pthread_mutex_unlock(&b->lock);
        if (!is_wanted)
            continue;
        board_picture *made =
            enlarged(picture_of(film, b->layers[i].name, memory), scale, width, height);
        if (made)
            put(b, i, made);
        is_good &= made != NULL;
    }
    return is_good;
}

int board_is_awaited(board *b)
{
    int is_awaited = 0;
    pthread_mutex_lock(&b->lock);
    for (size_t i = 0; i < b->layer_count && b->viewers > 0; i++)
        is_awaited |= b->layers[i].is_wanted && !b->layers[i].is_fresh;
    pthread_mutex_unlock(&b->lock);
    return is_awaited;
}

board_picture *board_take(board *b, const char *name)
{
    board_picture *taken = NULL;
    pthread_mutex_lock(&b->lock);
    for (size_t i = 0; i < b->layer_count; i++)
        if (strcmp(b->layers[i].name, name) == 0) {
            taken = b->layers[i].picture;
            b->layers[i].is_wanted = 1;
            b->layers[i].is_fresh = 0;
        }
    if (taken)
        hold(taken);
    pthread_mutex_unlock(&b->lock);
    return taken;
}

/* ---- The rest ------------------------------------------------------------------ */

void board_set_layers(board *b, const rt_film *film)
{
    const char *name;
    size_t count = 1;
    pthread_mutex_lock(&b->lock);
    for (; count < BOARD_LAYERS && (name = rt_film_preview_name(film, count - 1)); count++) {
        board_layer *l = b->layers + count;
        if (count < b->layer_count && strcmp(l->name, name) == 0)
            continue;
        if (count < b->layer_count)
            board_give(l->picture);
        *l = (board_layer){{0}, 0, 0, NULL};
        snprintf(l->name, sizeof l->name, "%s", name);
    }
    for (size_t i = count; i < b->layer_count; i++)
        board_give(b->layers[i].picture);
    b->layer_count = count;
    pthread_mutex_unlock(&b->lock);
}

int board_is_over(const board *b)
{
    return b->phase == BOARD_FINISHED || b->phase == BOARD_STOPPED || b->phase == BOARD_FAILED;
}

void board_set_phase(board *b, board_phase phase)
{
    pthread_mutex_lock(&b->lock);
    b->phase = phase;
    tell(b);
    pthread_mutex_unlock(&b->lock);
}

void board_set_progress(board *b, const rt_progress *progress)
{
    pthread_mutex_lock(&b->lock);
    b->progress = *progress;
    tell(b);
    pthread_mutex_unlock(&b->lock);
}

void board_begin_render(board *b, int is_coarse)
{
    pthread_mutex_lock(&b->lock);
    b->phase = BOARD_RENDERING;
    b->is_coarse = is_coarse;
    b->renders++;
    tell(b);
    pthread_mutex_unlock(&b->lock);
}

void board_clear_messages(board *b)
{
    pthread_mutex_lock(&b->lock);
    b->message_count = b->message_first = 0;
    b->message_version++;
    tell(b);
    pthread_mutex_unlock(&b->lock);
}

void board_close(board *b, double patience)
{
    struct timespec until;
    clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_sec += (time_t)patience;
    pthread_mutex_lock(&b->lock);
    while (b->viewers > b->satisfied &&
           pthread_cond_timedwait(&b->changed, &b->lock, &until) != ETIMEDOUT)
        continue;
    b->is_closing = 1;
    tell(b);
    pthread_mutex_unlock(&b->lock);
}

void board_say(board *b, const char *severity, const char *text)
{
    pthread_mutex_lock(&b->lock);
    board_message *m = b->messages + (b->message_first + b->message_count) % BOARD_MESSAGES;
    m->severity = severity;
    snprintf(m->text, sizeof m->text, "%s", text);
    if (b->message_count < BOARD_MESSAGES)
        b->message_count++;
    else
        b->message_first = (b->message_first + 1) % BOARD_MESSAGES;
    b->message_version++;
    tell(b);
    pthread_mutex_unlock(&b->lock);
}
