/*
 * test_preview.c - --preview: what its value may be, who is refused at its page, and what is served
 * there.
 */
#include "support.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "expect.h"
#include "http.h"
#include "small_scene.h"
#include "tools/preview/board.h"
#include "tools/preview/request.h"
#include "tools/preview/server.h"
#include "tools/preview/target.h"

static rt_error error;

/* ---- The value of --preview ----------------------------------------------------------- */

static void targets_are_a_page_or_tev(void **state)
{
    static const struct {
        const char *text;
        preview_target target;
    } good[] = {
        {"page", {0, 0, 0, ""}},
        {"page:8080", {0, 0, 8080, ""}},
        {"open", {0, 1, 0, ""}},
        {"open:65535", {0, 1, 65535, ""}},
        {"tev", {1, 0, 14158, "127.0.0.1"}},
        {"tev:9000", {1, 0, 9000, "127.0.0.1"}},
        {"tev:desk", {1, 0, 14158, "desk"}},
        {"tev:desk:9000", {1, 0, 9000, "desk"}},
        {"tev:[::1]:9000", {1, 0, 9000, "::1"}},
        {"tev:[::1]", {1, 0, 14158, "::1"}},
    };
    static const char *const bad[] = {
        "",          "pages",   "page:", "page:0",    "page:65536", "page:-1",    "page: 80",
        "page:80x",  "open:a",  "tev:",  "tev:a:",    "tev:a:b",    "tev:[::1",   "tev:[]:1",
        "scene.rts", "tev:a:0", "tev:0", "tev:99999", "tevs",       "page:000080"};
    preview_target target;
    (void)state;
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        const preview_target *is = &good[i].target;
        assert_true(preview_target_read(&target, good[i].text));
        assert_true(target.is_tev == is->is_tev && target.opens == is->opens &&
                    target.port == is->port);
        assert_string_equal(target.host, is->host);
    }
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_false(preview_target_read(&target, bad[i]));
}

/* ---- Who has what ------------------------------------------------------------------------ */

static const char token[] = "0123456789abcdef0123456789abcdef";

static request_answer route(const char *method, const char *behind, const char *host,
                            const char *origin, const char *site)
{
    char path[128];
    snprintf(path, sizeof path, "/%s/%s", token, behind);
    const request r = {method, path, host, origin, site};
    return request_route(&r, token, 8080);
}

static void requests_have_what_their_method_fits(void **state)
{
    static const char here[] = "127.0.0.1:8080";
    (void)state;
    assert_int_equal(route("GET", "", here, NULL, NULL), REQUEST_PAGE);
    assert_int_equal(route("HEAD", "", here, NULL, NULL), REQUEST_PAGE);
    assert_int_equal(route("GET", "events", here, NULL, "same-origin"), REQUEST_EVENTS);
    assert_int_equal(route("HEAD", "events", here, NULL, NULL), REQUEST_NOT_SO);
    assert_int_equal(route("GET", "picture", "localhost:8080", NULL, NULL), REQUEST_PICTURE);
    assert_int_equal(route("GET", "stop", here, NULL, NULL), REQUEST_NOT_SO);
    assert_int_equal(route("POST", "stop", here, "http://127.0.0.1:8080", NULL), REQUEST_STOP);
    assert_int_equal(route("POST", "", here, NULL, NULL), REQUEST_NOT_SO);
    assert_int_equal(route("get", "", here, NULL, NULL), REQUEST_NOT_SO);
    assert_int_equal(route("GET", "page.html", here, NULL, NULL), REQUEST_UNKNOWN);
    assert_int_equal(route("GET", "../picture", here, NULL, NULL), REQUEST_UNKNOWN);
}

/* A name of a stranger's that stands for this machine, and pages of others. */
static void requests_of_strangers_are_forbidden(void **state)
{
    static const char *const hosts[] = {NULL,
                                        "",
                                        "evil.example:8080",
                                        "127.0.0.1",
                                        "127.0.0.1:80801",
                                        "::1:8080",
                                        "localhost",
                                        "127.0.0.1:8081",
                                        "127.0.0.1:8080.evil.example"};
    static const char here[] = "127.0.0.1:8080";
    (void)state;
    for (size_t i = 0; i < sizeof hosts / sizeof *hosts; i++)
        assert_int_equal(route("GET", "", hosts[i], NULL, NULL), REQUEST_FORBIDDEN);
    assert_int_equal(route("POST", "stop", here, "http://evil.example", NULL), REQUEST_FORBIDDEN);
    assert_int_equal(route("POST", "stop", here, "null", NULL), REQUEST_FORBIDDEN);
    assert_int_equal(route("POST", "stop", here, NULL, "cross-site"), REQUEST_FORBIDDEN);
    assert_int_equal(route("GET", "picture", here, NULL, "same-site"), REQUEST_FORBIDDEN);
    assert_int_equal(route("GET", "", here, NULL, "cross-site"), REQUEST_PAGE);
}

static void paths_without_the_token_are_forbidden(void **state)
{
    static const char *const paths[] = {"",
                                        "/",
                                        "//",
                                        "/picture",
                                        "/0123/",
                                        "*",
                                        "/../",
                                        "/0123456789abcdef0123456789abcdef",
                                        "/0123456789abcdef0123456789abcdee/picture",
                                        "/1123456789abcdef0123456789abcdef/",
                                        "/0123456789abcdef0123456789abcdef0/",
                                        "/0123456789ABCDEF0123456789ABCDEF/"};
    (void)state;
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
        const request r = {"GET", paths[i], "127.0.0.1:8080", NULL, NULL};
        assert_int_equal(request_route(&r, token, 8080), REQUEST_FORBIDDEN);
    }
}

static void tokens_differ(void **state)
{
    char a[TOKEN_LENGTH + 1], b[TOKEN_LENGTH + 1];
    (void)state;
    assert_true(request_make_token(a) && request_make_token(b));
    assert_int_equal(strlen(a), TOKEN_LENGTH);
    assert_int_equal(strspn(a, "0123456789abcdef"), TOKEN_LENGTH);
    assert_string_not_equal(a, b);
}

/* ---- The server ----------------------------------------------------------------------------- */

/* A page on a board; both are there for one test. */
typedef struct served {
    board board;
    preview_server *server;
    unsigned port;
    char base[64]; /* "/TOKEN/" */
} served;

static int stops;

static void stop(void)
{
    __atomic_add_fetch(&stops, 1, __ATOMIC_RELAXED);
}

static void serve(served *s)
{
    board_begin(&s->board, "scene.rts");
    assert_null(server_open(&s->server, &s->board, 0, stop));
    assert_int_equal(
        sscanf(server_address(s->server), "http://127.0.0.1:%u%63s", &s->port, s->base), 2);
    stops = 0;
}

static void end(served *s)
{
    board_close(&s->board, 0);
    server_close(s->server);
    board_free(&s->board);
}

/* The status of METHOD of what is behind the token. */
static int ask(const served *s, const char *method, const char *behind, const char *lines)
{
    char path[128];
    snprintf(path, sizeof path, "%s%s", s->base, behind);
    http_answer a = http_ask(s->port, method, path, lines);
    const int status = a.status;
    http_free(&a);
    return status;
}

static void the_page_comes_with_its_headers(void **state)
{
    static const char *const headers[] = {
        "Content-Security-Policy: default-src 'none'; script-src 'nonce-",
        "connect-src 'self'",
        "frame-ancestors 'none'",
        "Cache-Control: no-store",
        "X-Content-Type-Options: nosniff",
        "Referrer-Policy: no-referrer",
        "X-Frame-Options: DENY",
        "Content-Type: text/html",
        "Cross-Origin-Resource-Policy: same-origin"};
    served s;
    (void)state;
    serve(&s);
    http_answer a = http_ask(s.port, "GET", s.base, NULL);
    assert_int_equal(a.status, 200);
    assert_non_null(strstr(a.body, "</html>"));
    assert_null(strstr(a.body, "@NONCE@"));
    for (size_t i = 0; i < sizeof headers / sizeof *headers; i++)
        assert_non_null(strstr(a.text, headers[i]));
    http_free(&a);
    end(&s);
}

static void other_programs_get_403(void **state)
{
    served s;
    char text[256];
    (void)state;
    serve(&s);
    http_answer a = http_ask(s.port, "GET", "/", NULL);
    assert_int_equal(a.status, 403);
    assert_non_null(strstr(a.text, "Cache-Control: no-store"));
    assert_null(strstr(a.text, s.base));
    http_free(&a);
    a = http_ask(s.port, "GET", "/0123456789abcdef0123456789abcdef/picture", NULL);
    assert_int_equal(a.status, 403);
    http_free(&a);
    snprintf(text, sizeof text,
             "GET %s HTTP/1.1\r\nHost: evil.example:%u\r\nConnection: close\r\n\r\n", s.base,
             s.port);
    a = http_send(s.port, text);
    assert_int_equal(a.status, 403);
    http_free(&a);
    assert_int_equal(
        ask(&s, "POST", "stop", "Origin: http://evil.example\r\nContent-Length: 0\r\n"), 403);
    assert_int_equal(stops, 0);
    end(&s);
}

static void methods_and_bodies_that_do_not_fit_are_refused(void **state)
{
    served s;
    (void)state;
    serve(&s);
    assert_int_equal(ask(&s, "PUT", "", "Content-Length: 0\r\n"), 405);
    assert_int_equal(ask(&s, "DELETE", "picture", NULL), 405);
    assert_int_equal(ask(&s, "GET", "stop", NULL), 405);
    assert_int_equal(ask(&s, "GET", "nothing", NULL), 404);
    assert_int_equal(ask(&s, "HEAD", "", NULL), 200);
    assert_int_equal(ask(&s, "POST", "stop", "Content-Length: 1000000000\r\n"), 413);
    assert_int_equal(ask(&s, "POST", "stop", "Transfer-Encoding: chunked\r\n"), 413);
    assert_int_equal(stops, 0);
    assert_int_equal(ask(&s, "POST", "stop", "Content-Length: 0\r\n"), 200);
    assert_int_equal(stops, 1);
    end(&s);
}

/* A head of 128 KiB, one that never ends, and what is no HTTP at all. */
static void oversized_and_broken_requests_end(void **state)
{
    enum { SIZE = 1 << 17 };
    served s;
    char *text = malloc(SIZE + 64);
    (void)state;
    assert_non_null(text);
    serve(&s);
    memset(text, 'a', SIZE);
    memcpy(text, "GET /", 5);
    strcpy(text + SIZE, " HTTP/1.1\r\nHost: a\r\n\r\n");
    http_answer a = http_send(s.port, text);
    assert_true(a.status == 0 || a.status >= 400);
    http_free(&a);
    memcpy(text, "GET / HTTP/1.1\r\nHost: a\r\nX: ", 28);
    a = http_send(s.port, text);
    assert_true(a.status == 0 || a.status >= 400);
    http_free(&a);
    const int fd = http_connect(s.port);
    assert_int_equal(send(fd, "\x16\x03\x01\x02\r\n\r\n", 8, MSG_NOSIGNAL), 8);
    close(fd);
    free(text);
    assert_int_equal(ask(&s, "GET", "", NULL), 200);
    end(&s);
}

/* Those who connect and say little do not keep others waiting, nor the end. */
static void slow_and_many_clients_are_borne(void **state)
{
    enum { SLOW = 40 };
    served s;
    int slow[SLOW];
    char text[160];
    (void)state;
    serve(&s);
    snprintf(text, sizeof text, "GET %sevents HTTP/1.1\r\nHost: 127.0.0.1:%u\r\n", s.base, s.port);
    for (int i = 0; i < SLOW; i++) {
        slow[i] = http_connect(s.port);
        assert_true(slow[i] >= 0);
        const size_t size = i % 2 ? strlen(text) : 7;
        assert_int_equal(send(slow[i], text, size, MSG_NOSIGNAL), size);
        if (i % 2)
            assert_int_equal(send(slow[i], "\r\n", 2, MSG_NOSIGNAL), 2);
    }
    for (int i = 0; i < 20; i++)
        assert_int_equal(ask(&s, "GET", "", NULL), 200);
    for (int i = 1; i < SLOW; i += 2)
        assert_true(http_wait_for(slow[i], "\"phase\":\"loading\""));
    board_set_phase(&s.board, BOARD_RENDERING);
    for (int i = 1; i < SLOW; i += 2)
        assert_true(http_wait_for(slow[i], "\"phase\":\"rendering\""));
    for (int i = 0; i < SLOW; i++)
        close(slow[i]);
    assert_int_equal(ask(&s, "GET", "", NULL), 200);
    end(&s);
}

/* The addresses that listen, in hexadecimal, of a port. */
static int listens_elsewhere(const char *table, unsigned port, const char *only)
{
    char line[512], local[64], end[16];
    int listens = 0, elsewhere = 0;
    FILE *file = fopen(table, "r");
    snprintf(end, sizeof end, ":%04X", port);
    while (file && fgets(line, sizeof line, file)) {
        unsigned state;
        if (sscanf(line, "%*d: %63s %*s %x", local, &state) != 2 || state != 0x0a ||
            strlen(local) < 5 || strcmp(local + strlen(local) - 5, end) != 0)
            continue;
        listens++;
        elsewhere += strncmp(local, only, strlen(only)) != 0;
    }
    if (file)
        fclose(file);
    return elsewhere || (only[0] == '0' && listens == 0);
}

static void only_the_loopback_device_listens(void **state)
{
    served s;
    (void)state;
    serve(&s);
    assert_false(listens_elsewhere("/proc/net/tcp", s.port, "0100007F:"));
    assert_false(listens_elsewhere("/proc/net/tcp6", s.port, "none"));
    end(&s);
}

static void a_port_that_is_taken_is_told(void **state)
{
    served s;
    board b;
    preview_server *none = NULL;
    (void)state;
    serve(&s);
    board_begin(&b, "b");
    assert_string_equal(server_open(&none, &b, s.port, stop), "Address already in use");
    assert_null(none);
    board_free(&b);
    end(&s);
}

/* ---- Pictures -------------------------------------------------------------------------------- */

static rt_film *film_of(uint32_t spp, int aov)
{
    rt_render_options o = {.width = 30, .height = 20, .spp = spp, .aov = aov};
    rt_renderer *renderer = test_renderer("camera { eye 0 0 4  look_at 0 0 0 }\n"
                                          "material m { kd 0.5 }\n"
                                          "sphere { centre 0 0 0  radius 1  material m }\n"
                                          "light point { position 2 3 4  intensity 20 }\n");
    rt_film *film = NULL;
    expect_ok(rt_render(&film, renderer, &o, &error), &error);
    rt_renderer_destroy(renderer);
    return film;
}

/* What is behind the token, as floats that film and board agree on. */
static void expect_picture(const served *s, const char *behind, const float *values, size_t bytes)
{
    char path[128];
    snprintf(path, sizeof path, "%s%s", s->base, behind);
    http_answer a = http_ask(s->port, "GET", path, NULL);
    assert_int_equal(a.status, 200);
    assert_non_null(strstr(a.text, "X-Width: 30\r\n"));
    assert_int_equal(a.body_size, bytes);
    assert_memory_equal(a.body, values, bytes);
    http_free(&a);
}

static void pictures_and_layers_are_those_of_the_film(void **state)
{
    enum { PIXELS = 30 * 20 };
    served s;
    rt_film *film = film_of(4, 1);
    (void)state;
    serve(&s);
    assert_int_equal(ask(&s, "GET", "picture", NULL), 204);
    board_set_layers(&s.board, film);
    assert_int_equal(ask(&s, "GET", "picture?layer=depth", NULL), 204);
    assert_true(board_put_film(&s.board, film, NULL, 0, 1, 30, 20));
    expect_picture(&s, "picture", rt_film_rgb(film), 3 * PIXELS * sizeof(float));
    expect_picture(&s, "picture?layer=depth", rt_film_layer(film, "depth", NULL),
                   PIXELS * sizeof(float));
    assert_int_equal(ask(&s, "GET", "picture?layer=normal", NULL), 204);
    assert_int_equal(ask(&s, "GET", "picture?layer=../../etc/passwd", NULL), 204);
    end(&s);
    rt_film_destroy(film);
}

/* A film of a quarter of the size, each of whose pixels is shown 4 x 4 times. */
static void coarse_pictures_are_enlarged(void **state)
{
    rt_film *film = film_of(1, 0);
    board b;
    (void)state;
    board_begin(&b, "b");
    assert_true(board_put_film(&b, film, NULL, 1, 4, 118, 80));
    board_picture *picture = board_take(&b, "");
    assert_true(picture->width == 118 && picture->height == 80);
    for (uint32_t y = 0; y < 80; y++)
        for (uint32_t x = 0; x < 118; x++)
            assert_memory_equal(picture->values + 3 * (118 * y + x),
                                rt_film_rgb(film) + 3 * (30 * (y / 4) + x / 4), 3 * sizeof(float));
    board_give(picture);
    board_free(&b);
    rt_film_destroy(film);
}

static void pictures_count_in_memory(void **state)
{
    rt_film *film = film_of(1, 0);
    rt_memory *memory = NULL;
    rt_memory_info info;
    board b;
    (void)state;
    expect_ok(rt_memory_create(&memory, 10000, &error), &error);
    board_begin(&b, "b");
    assert_true(board_put_film(&b, film, memory, 1, 1, 30, 20));
    rt_memory_get_info(memory, &info);
    assert_int_equal(info.used, 30 * 20 * 3 * sizeof(float));
    assert_false(board_put_film(&b, film, memory, 1, 1, 30, 20));
    board_free(&b);
    rt_memory_get_info(memory, &info);
    assert_int_equal(info.used, 0);
    rt_memory_destroy(memory);
    rt_film_destroy(film);
}

/* Pictures and progress come and go while viewers come and go. */
static void viewers_and_render_do_not_disturb_each_other(void **state)
{
    rt_film *film = film_of(2, 1);
    served s;
    char text[160];
    (void)state;
    serve(&s);
    board_set_layers(&s.board, film);
    for (int i = 0; i < 30; i++) {
        snprintf(text, sizeof text, "GET %sevents HTTP/1.1\r\nHost: 127.0.0.1:%u\r\n\r\n", s.base,
                 s.port);
        const int fd = http_connect(s.port);
        assert_int_equal(send(fd, text, strlen(text), MSG_NOSIGNAL), strlen(text));
        const rt_progress progress = {.stage = RT_STAGE_RENDER, .fraction = i / 30.0};
        board_set_progress(&s.board, &progress);
        board_say(&s.board, "warning", "a \"quoted\" \xff\n word");
        assert_true(board_put_film(&s.board, film, NULL, i % 2, 1, 30, 20));
        if (i % 3 == 0)
            assert_true(http_wait_for(fd, "a \\u0022quoted\\u0022 ?\\u000a word"));
        if (i % 5 == 0)
            expect_picture(&s, "picture", rt_film_rgb(film), 30 * 20 * 3 * sizeof(float));
        close(fd);
    }
    end(&s);
    rt_film_destroy(film);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(targets_are_a_page_or_tev),
        cmocka_unit_test(requests_have_what_their_method_fits),
        cmocka_unit_test(requests_of_strangers_are_forbidden),
        cmocka_unit_test(paths_without_the_token_are_forbidden),
        cmocka_unit_test(tokens_differ),
        cmocka_unit_test(the_page_comes_with_its_headers),
        cmocka_unit_test(other_programs_get_403),
        cmocka_unit_test(methods_and_bodies_that_do_not_fit_are_refused),
        cmocka_unit_test(oversized_and_broken_requests_end),
        cmocka_unit_test(slow_and_many_clients_are_borne),
        cmocka_unit_test(only_the_loopback_device_listens),
        cmocka_unit_test(a_port_that_is_taken_is_told),
        cmocka_unit_test(pictures_and_layers_are_those_of_the_film),
        cmocka_unit_test(coarse_pictures_are_enlarged),
        cmocka_unit_test(pictures_count_in_memory),
        cmocka_unit_test(viewers_and_render_do_not_disturb_each_other),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
