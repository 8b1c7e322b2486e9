/*
 * tev.c - the packets of tev, https://github.com/Tom94/tev (src/Ipc.cpp): each its length in bytes,
 * these four included, its kind, and what belongs to the kind; numbers are little-endian, and texts
 * end with a zero byte.
 *
 *   CreateImage    (4)  focus, name, width, height, channels, their names
 *   UpdateImageV3  (6)  focus, name, channels, their names, x, y, width, height, of each channel
 *                       where its first value lies and how far apart they are (64 bits), values
 */
#define _POSIX_C_SOURCE 200809L /* getaddrinfo, open_memstream */

#include "tev.h"

#include <errno.h>
#include <netdb.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

enum { CREATE_IMAGE = 4, UPDATE_IMAGE = 6 };

/* Bytes of values in a packet, and seconds that tev may take to receive some. */
enum { VALUES_MAX = 4 << 20, PATIENCE = 10 };

struct tev {
    board *board;
    int fd;
    pthread_t thread;
    int failed;
    uint64_t sent[BOARD_LAYERS]; /* the number of the last picture of each layer */
    uint32_t width, height;      /* of the image that was made there; 0: none */
    char names[BOARD_LAYERS][32];
    size_t layers; /* of that image */
    char title[256];
};

/* ---- Packets ------------------------------------------------------------------------- */

static void put_bits(FILE *out, uint64_t value, int bytes)
{
    for (int i = 0; i < bytes; i++)
        putc((int)(value >> 8 * i & 255u), out);
}

static void put_name(FILE *out, const char *text)
{
    fwrite(text, 1, strlen(text) + 1, out);
}

/* The name of a channel of a layer, as an .exr has it. */
static void put_channel(FILE *out, const char *layer, uint32_t channel, uint32_t channels)
{
    const int is_place = strcmp(layer, "normal") == 0 || strcmp(layer, "position") == 0;
    const char *names = channels == 2 ? "UV" : is_place ? "XYZ" : "RGB";
    char name[40];
    if (!layer[0])
        snprintf(name, sizeof name, "%c", names[channel]);
    else if (channels == 1)
        snprintf(name, sizeof name, "%s%s", layer, strchr(layer, '.') ? "" : ".Y");
    else
        snprintf(name, sizeof name, "%s.%c", layer, names[channel]);
    put_name(out, name);
}

/* Sends all bytes, past partial writes. */
static int send_all(tev *t, const char *data, size_t size)
{
    while (size > 0) {
        const ssize_t sent = send(t->fd, data, size, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR)
            continue;
        if (sent <= 0)
            return 0;
        data += sent;
        size -= (size_t)sent;
    }
    return 1;
}

/* Sends a packet that was written to memory, whose first four bytes become its length. */
static int send_packet(tev *t, FILE *out, char **data, const size_t *size)
{
    int is_good = !ferror(out);
    is_good &= fclose(out) == 0;
    for (int i = 0; i < 4 && is_good; i++)
        (*data)[i] = (char)(*size >> 8 * i & 255u);
    is_good = is_good && send_all(t, *data, *size);
    free(*data);
    *data = NULL;
    return is_good;
}

/* Begins a packet; NULL without memory. */
static FILE *begin_packet(const tev *t, int kind, int has_focus, char **data, size_t *size)
{
    FILE *out = open_memstream(data, size);
    if (!out)
        return NULL;
    put_bits(out, 0, 4);
    putc(kind, out);
    putc(has_focus, out);
    put_name(out, t->title);
    return out;
}

/* What is to be sent of a layer. */
typedef struct part {
    char name[32];
    board_picture *picture;
} part;

static int create_image(tev *t, const part *parts, size_t count)
{
    char *data = NULL;
    size_t size = 0;
    uint32_t channels = 0;
    FILE *out = begin_packet(t, CREATE_IMAGE, 1, &data, &size);
    if (!out)
        return 0;
    for (size_t i = 0; i < count; i++)
        channels += parts[i].picture->channels;
    put_bits(out, parts[0].picture->width, 4);
    put_bits(out, parts[0].picture->height, 4);
    put_bits(out, channels, 4);
    for (size_t i = 0; i < count; i++)
        for (uint32_t c = 0; c < parts[i].picture->channels; c++)
            put_channel(out, parts[i].name, c, parts[i].picture->channels);
    return send_packet(t, out, &data, &size);
}

/* Some rows of a layer. */
static int update_rows(tev *t, const part *p, uint32_t first, uint32_t rows)
{
    const board_picture *picture = p->picture;
    const size_t row = (size_t)picture->width * picture->channels;
    char *data = NULL;
    size_t size = 0;
    FILE *out = begin_packet(t, UPDATE_IMAGE, 0, &data, &size);
    if (!out)
        return 0;
    put_bits(out, picture->channels, 4);
    for (uint32_t c = 0; c < picture->channels; c++)
        put_channel(out, p->name, c, picture->channels);
    put_bits(out, 0, 4);
    put_bits(out, first, 4);
    put_bits(out, picture->width, 4);
    put_bits(out, rows, 4);
    for (uint32_t c = 0; c < picture->channels; c++)
        put_bits(out, c, 8);
    for (uint32_t c = 0; c < picture->channels; c++)
        put_bits(out, picture->channels, 8);
    fwrite(picture->values + first * row, sizeof *picture->values, rows * row, out);
    return send_packet(t, out, &data, &size);
}

static int update_layer(tev *t, const part *p)
{
    const size_t row = p->picture->channels * p->picture->width * sizeof *p->picture->values;
    const uint32_t most = row < VALUES_MAX ? (uint32_t)(VALUES_MAX / row) : 1;
    int is_good = 1;
    for (uint32_t y = 0; y < p->picture->height && is_good; y += most)
        is_good =
            update_rows(t, p, y, p->picture->height - y < most ? p->picture->height - y : most);
    return is_good;
}

/* Whether the image over there has these layers. */
static int has_image(const tev *t, const part *parts, size_t count)
{
    int has = count <= t->layers && t->width == parts[0].picture->width &&
              t->height == parts[0].picture->height;
    for (size_t i = 0; i < count && has; i++)
        has = strcmp(parts[i].name, t->names[i]) == 0;
    return has;
}

static int send_parts(tev *t, const part *parts, size_t count)
{
    int is_good = 1;
    if (!has_image(t, parts, count)) {
        is_good = create_image(t, parts, count);
        memset(t->sent, 0, sizeof t->sent);
        t->width = parts[0].picture->width;
        t->height = parts[0].picture->height;
        t->layers = count;
        for (size_t i = 0; i < count; i++)
            memcpy(t->names[i], parts[i].name, sizeof t->names[i]);
    }
    for (size_t i = 0; i < count && is_good; i++)
        if (parts[i].picture->number > t->sent[i]) {
            is_good = update_layer(t, parts + i);
            t->sent[i] = parts[i].picture->number;
        }
    return is_good;
}

/* ---- The thread --------------------------------------------------------------------------- */

/* Whether a render has ended. */
static int is_whole(const board *b)
{
    return board_is_over(b) || b->phase == BOARD_WAITING;
}

/*
 * Takes the pictures that are there, at the end those of all layers, until then the first alone.
 * Called with the lock. Returns how many, 0 where none of them is new.
 */
static size_t take_parts(part *parts, const tev *t)
{
    board *b = t->board;
    const size_t most = is_whole(b) ? b->layer_count : 1;
    size_t count = 0;
    int is_new = 0;
    for (size_t i = 0; i < most && b->layers[i].picture; i++, count++)
        is_new |= b->layers[i].picture->number > t->sent[i];
    for (size_t i = 0; i < count && is_new; i++) {
        board_layer *l = b->layers + i;
        memcpy(parts[i].name, l->name, sizeof parts[i].name);
        parts[i].picture = l->picture;
        l->is_fresh = 0;
        __atomic_add_fetch(&l->picture->holders, 1, __ATOMIC_RELAXED);
    }
    return is_new ? count : 0;
}

static void *send_pictures(void *user)
{
    tev *t = user;
    board *b = t->board;
    part parts[BOARD_LAYERS];
    pthread_mutex_lock(&b->lock);
    while (!t->failed) {
        const size_t count = take_parts(parts, t);
        if (count == 0 && b->is_closing)
            break;
        if (count == 0) {
            b->satisfied = is_whole(b);
            pthread_cond_broadcast(&b->changed);
            pthread_cond_wait(&b->changed, &b->lock);
            continue;
        }
        pthread_mutex_unlock(&b->lock);
        const int is_good = send_parts(t, parts, count);
        for (size_t i = 0; i < count; i++)
            board_give(parts[i].picture);
        pthread_mutex_lock(&b->lock);
        t->failed = !is_good;
    }
    b->viewers--;
    pthread_cond_broadcast(&b->changed);
    pthread_mutex_unlock(&b->lock);
    return NULL;
}

/* ---- Begin and end -------------------------------------------------------------------------- */

/* A connection, or -1 and why there is none. */
static int connect_to(const char *host, unsigned port, const char **why)
{
    const struct addrinfo hints = {.ai_family = AF_UNSPEC, .ai_socktype = SOCK_STREAM};
    const struct timeval patience = {.tv_sec = PATIENCE};
    struct addrinfo *found = NULL;
    char service[8];
    int fd = -1;
    snprintf(service, sizeof service, "%u", port);
    /* No host is the loopback, as localhost is (RFC 6761), also where no file says so. */
    const char *name = strcmp(host, "localhost") == 0 ? NULL : host;
    const int code = getaddrinfo(name, service, &hints, &found);
    *why = code ? gai_strerror(code) : "";
    for (const struct addrinfo *at = found; at && fd < 0; at = at->ai_next) {
        fd = socket(at->ai_family, at->ai_socktype, at->ai_protocol);
        if (fd >= 0 && (setsockopt(fd, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience) != 0 ||
                        connect(fd, at->ai_addr, at->ai_addrlen) != 0)) {
            *why = strerror(errno);
            close(fd);
            fd = -1;
        }
    }
    if (found)
        freeaddrinfo(found);
    return fd;
}

const char *tev_open(tev **out, board *board, const char *host, unsigned port)
{
    const char *why = NULL;
    tev *t = calloc(1, sizeof *t);
    if (!t)
        return "out of memory";
    t->board = board;
    snprintf(t->title, sizeof t->title, "%s", board->title);
    t->fd = connect_to(host, port, &why);
    if (t->fd < 0) {
        free(t);
        return why;
    }
    pthread_mutex_lock(&board->lock);
    board->viewers++;
    pthread_mutex_unlock(&board->lock);
    if (pthread_create(&t->thread, NULL, send_pictures, t) != 0) {
        board->viewers--;
        close(t->fd);
        free(t);
        return "there can be no thread";
    }
    *out = t;
    return NULL;
}

int tev_close(tev *t)
{
    if (!t)
        return 1;
    pthread_join(t->thread, NULL);
    const int is_good = !t->failed;
    close(t->fd);
    free(t);
    return is_good;
}
