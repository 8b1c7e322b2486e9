/* test_tev.c - what a viewer that speaks tev's protocol receives of a render. */
#include "support.h"

#include <arpa/inet.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include "tools/preview/board.h"
#include "tools/preview/tev.h"

enum { WIDTH = 30, HEIGHT = 20, PIXELS = WIDTH * HEIGHT, CHANNELS = 32, NAME = 64 };

static rt_error error;

/* ---- A viewer ------------------------------------------------------------------------------ */

/* What it has received. */
typedef struct viewer {
    int listener;
    unsigned port;
    pthread_t thread;
    unsigned created, updated, bad;
    char image[NAME], names[CHANNELS][NAME];
    int32_t width, height, channels;
    float *values; /* [channels][height][width] */
} viewer;

/* A packet as it is read; what lies beyond its end is zero, and noted. */
typedef struct packet {
    const uint8_t *at, *end;
    int is_short;
} packet;

static uint64_t get_bits(packet *p, int bytes)
{
    uint64_t value = 0;
    p->is_short |= p->end - p->at < bytes;
    for (int i = 0; i < bytes && !p->is_short; i++)
        value |= (uint64_t)p->at[i] << 8 * i;
    p->at += p->is_short ? 0 : bytes;
    return value;
}

static void get_name(packet *p, char out[NAME])
{
    const uint8_t *zero = memchr(p->at, 0, (size_t)(p->end - p->at));
    p->is_short |= !zero || zero - p->at >= NAME;
    snprintf(out, NAME, "%s", p->is_short ? "" : (const char *)p->at);
    p->at = p->is_short ? p->at : zero + 1;
}

static void create(viewer *v, packet *p)
{
    v->bad += get_bits(p, 1) > 1;
    get_name(p, v->image);
    v->width = (int32_t)get_bits(p, 4);
    v->height = (int32_t)get_bits(p, 4);
    v->channels = (int32_t)get_bits(p, 4);
    v->bad += v->channels < 1 || v->channels > CHANNELS || v->width < 1 || v->height < 1;
    for (int c = 0; c < v->channels && !v->bad; c++)
        get_name(p, v->names[c]);
    v->bad += p->is_short || p->at != p->end;
    free(v->values);
    v->values = v->bad ? NULL
                       : calloc((size_t)v->width * (size_t)v->height * (size_t)v->channels,
                                sizeof *v->values);
    v->created++;
}

/* The number of a channel; counts what is not there as bad. */
static int channel_of(viewer *v, const char *name)
{
    for (int c = 0; c < v->channels; c++)
        if (strcmp(v->names[c], name) == 0)
            return c;
    v->bad++;
    return 0;
}

static void update(viewer *v, packet *p)
{
    char name[NAME];
    int which[CHANNELS];
    uint64_t offsets[CHANNELS], strides[CHANNELS];
    v->bad += get_bits(p, 1) > 1;
    get_name(p, name);
    v->bad += !v->values || strcmp(name, v->image) != 0;
    const int count = (int)get_bits(p, 4);
    v->bad += count < 1 || count > CHANNELS;
    for (int c = 0; c < count && !v->bad; c++) {
        get_name(p, name);
        which[c] = channel_of(v, name);
    }
    const int64_t x = (int32_t)get_bits(p, 4), y = (int32_t)get_bits(p, 4),
                  width = (int32_t)get_bits(p, 4), height = (int32_t)get_bits(p, 4);
    v->bad += x < 0 || y < 0 || x + width > v->width || y + height > v->height;
    for (int c = 0; c < count && !v->bad; c++)
        offsets[c] = get_bits(p, 8);
    for (int c = 0; c < count && !v->bad; c++)
        strides[c] = get_bits(p, 8);
    const size_t floats = (size_t)(p->end - p->at) / sizeof(float);
    for (int c = 0; c < count && !v->bad; c++)
        for (int64_t i = 0; i < width * height; i++) {
            const uint64_t from = offsets[c] + (uint64_t)i * strides[c];
            const int64_t to =
                ((int64_t)which[c] * v->height + y + i / width) * v->width + x + i % width;
            v->bad += from >= floats;
            if (from < floats)
                memcpy(v->values + to, p->at + from * sizeof(float), sizeof(float));
        }
    v->bad += p->is_short;
    v->updated++;
}

/* Reads so many bytes; returns whether they came. */
static int read_bytes(int fd, uint8_t *out, size_t size)
{
    ssize_t got = 1;
    for (size_t at = 0; at < size && got > 0; at += got > 0 ? (size_t)got : 0)
        got = recv(fd, out + at, size - at, 0);
    return got > 0;
}

static void *view(void *user)
{
    viewer *v = user;
    uint8_t length[4];
    const int fd = accept(v->listener, NULL, NULL);
    while (fd >= 0 && read_bytes(fd, length, sizeof length)) {
        packet head = {length, length + 4, 0};
        const size_t size = (size_t)get_bits(&head, 4);
        uint8_t *data = size > 5 && size < 1 << 24 ? malloc(size - 4) : NULL;
        if (!data || !read_bytes(fd, data, size - 4)) {
            v->bad++;
            free(data);
            break;
        }
        packet p = {data + 1, data + size - 4, 0};
        if (data[0] == 4)
            create(v, &p);
        else if (data[0] == 6)
            update(v, &p);
        else
            v->bad++;
        free(data);
    }
    close(fd);
    return NULL;
}

static void open_viewer(viewer *v)
{
    const struct timeval patience = {.tv_sec = 20};
    struct sockaddr_in at = {.sin_family = AF_INET};
    socklen_t size = sizeof at;
    memset(v, 0, sizeof *v);
    v->listener = socket(AF_INET, SOCK_STREAM, 0);
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    setsockopt(v->listener, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    assert_int_equal(bind(v->listener, (struct sockaddr *)&at, sizeof at), 0);
    assert_int_equal(listen(v->listener, 1), 0);
    assert_int_equal(getsockname(v->listener, (struct sockaddr *)&at, &size), 0);
    v->port = ntohs(at.sin_port);
    assert_int_equal(pthread_create(&v->thread, NULL, view, v), 0);
}

static void close_viewer(viewer *v)
{
    close(v->listener);
    free(v->values);
}

/* ---- Renders -------------------------------------------------------------------------------- */

static rt_film *film_of(uint32_t spp, uint32_t width, int aov)
{
    rt_render_options o = {.width = width, .height = HEIGHT, .spp = spp, .aov = aov};
    rt_renderer *renderer = test_renderer("camera { eye 0 0 4  look_at 0 0 0 }\n"
                                          "material m { kd 0.5 0.4 0.3 }\n"
                                          "sphere { centre 0 0 0  radius 1  material m }\n"
                                          "light point { position 2 3 4  intensity 20 }\n");
    rt_film *film = NULL;
    expect_ok(rt_render(&film, renderer, &o, &error), &error);
    rt_renderer_destroy(renderer);
    return film;
}

/* The channels of a layer must be those of the film, and be called so. */
static void expect_layer(const viewer *v, const char *const names[], const float *values)
{
    size_t count = 0;
    while (names[count])
        count++;
    for (size_t c = 0; c < count; c++) {
        int which = 0;
        while (which < v->channels && strcmp(v->names[which], names[c]) != 0)
            which++;
        assert_true(which < v->channels);
        for (size_t i = 0; i < PIXELS; i++)
            assert_true(v->values[(size_t)which * PIXELS + i] == values[count * i + c]);
    }
}

static void tev_receives_the_picture_and_at_the_end_all_layers(void **state)
{
    static const char *const rgb[] = {"R", "G", "B", NULL},
                             *const albedo[] = {"albedo.R", "albedo.G", "albedo.B", NULL},
                             *const normal[] = {"normal.X", "normal.Y", "normal.Z", NULL},
                             *const depth[] = {"depth.Y", NULL},
                             *const uv[] = {"uv.U", "uv.V", NULL};
    rt_film *first = film_of(1, WIDTH, 1), *last = film_of(4, WIDTH, 1);
    viewer v;
    board b;
    tev *t = NULL;
    (void)state;
    open_viewer(&v);
    board_begin(&b, "scene.rts");
    assert_null(tev_open(&t, &b, "127.0.0.1", v.port));
    board_set_phase(&b, BOARD_RENDERING);
    board_set_layers(&b, first);
    assert_true(board_put_film(&b, first, NULL, 0, 1, WIDTH, HEIGHT));
    while (!board_is_awaited(&b))
        nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
    assert_true(board_put_film(&b, last, NULL, 1, 1, WIDTH, HEIGHT));
    board_set_phase(&b, BOARD_FINISHED);
    board_close(&b, 20);
    assert_true(tev_close(t));
    pthread_join(v.thread, NULL);
    assert_int_equal(v.bad, 0);
    assert_string_equal(v.image, "scene.rts");
    assert_true(v.created >= 1 && v.created <= 2 && v.updated >= 8);
    expect_layer(&v, rgb, rt_film_rgb(last));
    expect_layer(&v, albedo, rt_film_layer(last, "albedo", NULL));
    expect_layer(&v, normal, rt_film_layer(last, "normal", NULL));
    expect_layer(&v, depth, rt_film_layer(last, "depth", NULL));
    expect_layer(&v, uv, rt_film_layer(last, "uv", NULL));
    close_viewer(&v);
    board_free(&b);
    rt_film_destroy(first);
    rt_film_destroy(last);
}

/* Of 8 MiB of values none is missing, although a packet holds 4. */
static void large_pictures_go_in_several_packets(void **state)
{
    enum { SCALE = 30 };
    rt_film *film = film_of(1, WIDTH, 0);
    viewer v;
    board b;
    tev *t = NULL;
    (void)state;
    open_viewer(&v);
    board_begin(&b, "scene.rts");
    assert_null(tev_open(&t, &b, "localhost", v.port));
    assert_true(board_put_film(&b, film, NULL, 1, SCALE, SCALE * WIDTH, SCALE * HEIGHT));
    board_set_phase(&b, BOARD_FINISHED);
    board_close(&b, 20);
    assert_true(tev_close(t));
    pthread_join(v.thread, NULL);
    assert_int_equal(v.bad, 0);
    assert_true(v.created == 1 && v.updated == 2 && v.width == SCALE * WIDTH);
    for (size_t i = 0; i < (size_t)SCALE * SCALE * PIXELS; i++) {
        const size_t x = i % (SCALE * WIDTH) / SCALE, y = i / (SCALE * WIDTH) / SCALE;
        assert_true(v.values[i] == rt_film_rgb(film)[3 * (WIDTH * y + x)]);
    }
    close_viewer(&v);
    board_free(&b);
    rt_film_destroy(film);
}

static void a_viewer_that_goes_away_does_not_matter(void **state)
{
    rt_film *film = film_of(1, WIDTH, 0);
    viewer v;
    board b;
    tev *t = NULL;
    (void)state;
    open_viewer(&v);
    board_begin(&b, "scene.rts");
    assert_null(tev_open(&t, &b, "127.0.0.1", v.port));
    shutdown(v.listener, SHUT_RDWR);
    assert_true(board_put_film(&b, film, NULL, 1, 40, 40 * WIDTH, 40 * HEIGHT));
    board_set_phase(&b, BOARD_FINISHED);
    board_close(&b, 20);
    tev_close(t);
    pthread_join(v.thread, NULL);
    /* And none that listens is told at once. */
    assert_non_null(tev_open(&t, &b, "127.0.0.1", v.port));
    assert_non_null(tev_open(&t, &b, "no such name", 1));
    close_viewer(&v);
    board_free(&b);
    rt_film_destroy(film);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tev_receives_the_picture_and_at_the_end_all_layers),
        cmocka_unit_test(large_pictures_go_in_several_packets),
        cmocka_unit_test(a_viewer_that_goes_away_does_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
