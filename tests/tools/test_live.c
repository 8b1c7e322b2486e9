/* test_live.c - rtc with --preview, as other programs of the machine meet it. */
#include "support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include "expect.h"
#include "http.h"
#include "lib/image/scratch.h"
#include "small_scene.h"

static int enter(void **state)
{
    if (scratch_enter(state) != 0)
        return -1;
    scratch_write("s.rts", small_scene);
    return 0;
}

/* A run with its page, whose events are read. */
typedef struct live {
    running running;
    unsigned port;
    char base[64]; /* "/TOKEN/" */
    int events;
    char said[1 << 16];
} live;

/* Waits for the page's address, and looks at it. */
static void look(live *l)
{
    char text[256];
    assert_int_equal(running_wait_for(&l->running, "/\n", l->said, sizeof l->said), 0);
    const char *at = strstr(l->said, "preview at http://127.0.0.1:");
    assert_non_null(at);
    assert_int_equal(sscanf(at, "preview at http://127.0.0.1:%u%63s", &l->port, l->base), 2);
    snprintf(text, sizeof text, "GET %sevents HTTP/1.1\r\nHost: 127.0.0.1:%u\r\n\r\n", l->base,
             l->port);
    l->events = http_connect(l->port);
    assert_int_equal(send(l->events, text, strlen(text), MSG_NOSIGNAL), strlen(text));
}

static http_answer ask(const live *l, const char *method, const char *behind)
{
    char path[128];
    snprintf(path, sizeof path, "%s%s", l->base, behind);
    return http_ask(l->port, method, path, "Content-Length: 0\r\n");
}

/* Says that the last picture has come, and waits for the end. */
static int finish(live *l)
{
    assert_true(http_wait_for(l->events, "\"phase\":\"finished\"") ||
                http_wait_for(l->events, "\"phase\":\"stopped\""));
    http_answer a = ask(l, "POST", "seen");
    assert_int_equal(a.status, 200);
    http_free(&a);
    close(l->events);
    return running_finish(&l->running, l->said, sizeof l->said);
}

static void a_picture_that_is_looked_at_has_the_same_bytes(void **state)
{
    static const char *const options[] = {"--spp 3000 --aov",
                                          "--mode photon --photons 1e5 --spp 64",
                                          "--mode photon --passes 30 --photons 3000"};
    (void)state;
    for (size_t i = 0; i < sizeof options / sizeof *options; i++) {
        live l = {0};
        unlink("a.rtpart");
        unlink("b.rtpart");
        run plain = run_rtc("s.rts %s --out a.exr --out a.png --out a.rtpart", options[i]);
        expect_status(&plain, 0);
        l.running =
            start_rtc("s.rts --preview %s --out b.exr --out b.png --out b.rtpart", options[i]);
        look(&l);
        http_answer a = ask(&l, "GET", "picture");
        while (a.status == 204) {
            http_free(&a);
            nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
            a = ask(&l, "GET", "picture");
        }
        assert_int_equal(a.status, 200);
        assert_int_equal(a.body_size, 24 * 16 * 3 * sizeof(float));
        http_free(&a);
        assert_int_equal(finish(&l), 0);
        expect_same_files("a.png", "b.png");
        run compared = run_rtc("compare a.exr b.exr --max-mse 0");
        expect_status(&compared, 0);
        run_free(&compared);
        run_free(&plain);
    }
}

static void stop_writes_the_picture_so_far(void **state)
{
    live l = {0};
    (void)state;
    unlink("c.pfm");
    l.running = start_rtc("s.rts --spp 16000000 --out c.pfm --preview page");
    look(&l);
    assert_true(http_wait_for(l.events, "\"number\":1"));
    http_answer a = http_ask(l.port, "POST", "/stop", "Content-Length: 0\r\n");
    assert_int_equal(a.status, 403);
    http_free(&a);
    a = ask(&l, "POST", "stop");
    assert_int_equal(a.status, 200);
    http_free(&a);
    assert_true(http_wait_for(l.events, "\"phase\":\"stopped\""));
    a = ask(&l, "POST", "seen");
    http_free(&a);
    close(l.events);
    assert_int_equal(running_finish(&l.running, l.said, sizeof l.said), 130);
    assert_non_null(strstr(l.said, "interrupted; wrote c.pfm"));
    expect_file("c.pfm");
}

static void nobody_has_to_look(void **state)
{
    (void)state;
    run r = run_rtc("--preview s.rts --spp 4 --out d.pfm");
    expect_status(&r, 0);
    expect_err(&r, "preview at http://127.0.0.1:");
    expect_file("d.pfm");
    run_free(&r);
}

static void what_cannot_be_previewed_is_refused(void **state)
{
    static const struct {
        const char *options, *says;
        int status;
    } wrong[] = {
        {"--preview=pages", "--preview takes page, open or tev", 2},
        {"--preview=page:99999", "--preview takes page, open or tev", 2},
        {"--preview tev:127.0.0.1:1", "no tev at 127.0.0.1:1: Connection refused", 4},
        {"--preview --untrusted", "--preview does not go with --untrusted", 2},
    };
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        run r = run_rtc("s.rts --spp 1 %s --out e.pfm", wrong[i].options);
        expect_status(&r, wrong[i].status);
        expect_err(&r, wrong[i].says);
        expect_no_file("e.pfm");
        run_free(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_picture_that_is_looked_at_has_the_same_bytes),
        cmocka_unit_test(stop_writes_the_picture_so_far),
        cmocka_unit_test(nobody_has_to_look),
        cmocka_unit_test(what_cannot_be_previewed_is_refused),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests(tests, enter, scratch_leave);
}
