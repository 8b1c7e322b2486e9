/* test_live.c - rtc with --preview and --watch, as other programs of the machine meet it. */
#define _XOPEN_SOURCE 700 /* symlink */

#include "support.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
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

/* Says that the last picture has come, and waits for the end, which has this name. */
static int finish(live *l, const char *phase)
{
    char text[32];
    snprintf(text, sizeof text, "\"phase\":\"%s\"", phase);
    assert_true(http_wait_for(l->events, text));
    http_answer a = ask(l, "POST", "seen");
    assert_int_equal(a.status, 200);
    http_free(&a);
    close(l->events);
    l->said[0] = '\0';
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
        assert_int_equal(finish(&l, "finished"), 0);
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
    assert_int_equal(finish(&l, "stopped"), 130);
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
        {"--preview tev:host:99999", "--preview takes page, open or tev", 2},
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

/* ---- --watch ------------------------------------------------------------------------------- */

/* Reads until rtc waits for a change; what it said before is in l->said. */
static void wait_for_rest(live *l)
{
    l->said[0] = '\0';
    assert_int_equal(
        running_wait_for(&l->running, "waiting for a change of a file", l->said, sizeof l->said),
        0);
}

/* Writes a file as editors do: another one is renamed over it. */
static void replace(const char *name, const char *text)
{
    scratch_write("new", text);
    assert_int_equal(rename("new", name), 0);
}

static int interrupt(live *l)
{
    kill(l->running.pid, SIGINT);
    l->said[0] = '\0';
    return running_finish(&l->running, l->said, sizeof l->said);
}

static const char with_include[] = "include \"parts/ball.rts\"\n"
                                   "camera { eye 0 1 -5  look_at 0 1 0 }\n"
                                   "film { width 24  height 16 }\n"
                                   "light point { position 2 4 -3  intensity 20 }\n",
                  ball[] = "material m { kd 0.7 }\nsphere { centre 0 1 0  radius 1  material m }\n";

static void a_change_of_any_file_renders_again(void **state)
{
    live l = {0};
    (void)state;
    mkdir("parts", 0777);
    scratch_write("parts/ball.rts", ball);
    scratch_write("w.rts", with_include);
    l.running = start_rtc("w.rts --watch --spp 4 --out w.pfm");
    wait_for_rest(&l);
    expect_file("w.pfm");
    assert_int_equal(rename("w.pfm", "first.pfm"), 0);
    replace("parts/ball.rts", "material m { kd 0.7 }\n"
                              "sphere { centre 0 1 0  radius 0.5  material m }\n");
    wait_for_rest(&l);
    assert_non_null(strstr(l.said, "wrote w.pfm"));
    expect_different_files("w.pfm", "first.pfm");
    scratch_write("parts/ball.rts", ball);
    wait_for_rest(&l);
    expect_same_files("w.pfm", "first.pfm");
    assert_int_equal(interrupt(&l), 0);
}

static void meshes_and_textures_are_watched_too(void **state)
{
    live l = {0};
    (void)state;
    scratch_write("t.ppm", "P3\n1 1\n255\n255 0 0\n");
    scratch_write("m.obj", "v -1 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
    scratch_write("w.rts", "camera { eye 0 1 -5  look_at 0 1 0 }\nfilm { width 24  height 16 }\n"
                           "texture t { file \"t.ppm\" }\nmaterial m { kd_texture t }\n"
                           "model { file \"m.obj\"  material m }\n"
                           "light point { position 2 4 -3  intensity 20 }\n");
    l.running = start_rtc("w.rts --watch --spp 4 --out w.pfm");
    wait_for_rest(&l);
    assert_int_equal(rename("w.pfm", "first.pfm"), 0);
    replace("t.ppm", "P3\n1 1\n255\n0 255 0\n");
    wait_for_rest(&l);
    expect_different_files("w.pfm", "first.pfm");
    assert_int_equal(rename("w.pfm", "second.pfm"), 0);
    replace("m.obj", "v -1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    wait_for_rest(&l);
    expect_different_files("w.pfm", "second.pfm");
    /* A link, of which the file behind changes. */
    scratch_write("parts/real.ppm", "P3\n1 1\n255\n0 255 0\n");
    assert_int_equal(symlink("parts/real.ppm", "link"), 0);
    assert_int_equal(rename("link", "t.ppm"), 0);
    wait_for_rest(&l);
    assert_int_equal(rename("w.pfm", "third.pfm"), 0);
    replace("parts/real.ppm", "P3\n1 1\n255\n0 0 255\n");
    wait_for_rest(&l);
    expect_different_files("w.pfm", "third.pfm");
    assert_int_equal(interrupt(&l), 0);
}

static void an_error_waits_to_be_mended(void **state)
{
    live l = {0};
    (void)state;
    mkdir("parts", 0777);
    unlink("parts/ball.rts");
    unlink("w.pfm");
    scratch_write("w.rts", with_include);
    l.running = start_rtc("w.rts --watch --spp 4 --out w.pfm");
    wait_for_rest(&l);
    assert_non_null(strstr(l.said, "cannot include 'parts/ball.rts'"));
    expect_no_file("w.pfm");
    replace("parts/ball.rts", "spher { }\n");
    wait_for_rest(&l);
    assert_non_null(strstr(l.said, "ball.rts:1:1: error: unknown block 'spher'"));
    replace("parts/ball.rts", ball);
    wait_for_rest(&l);
    assert_non_null(strstr(l.said, "wrote w.pfm"));
    assert_int_equal(interrupt(&l), 0);
}

static void a_change_ends_the_render_under_way(void **state)
{
    live l = {0};
    (void)state;
    scratch_write("w.rts", small_scene);
    l.running = start_rtc("w.rts --watch --spp 16000000 --out w.pfm --progress plain --preview");
    look(&l);
    assert_true(http_wait_for(l.events, "\"coarse\":false,\"watched\":true,\"renders\":2"));
    unlink("w.pfm");
    replace("w.rts", "camera { eye 0 0 -5  look_at 0 0 0 }\n film { width 8  height 8 }\n"
                     "render { time 0.1 }\n light point { position 0 0 0  intensity 1 }\n");
    wait_for_rest(&l);
    assert_non_null(strstr(l.said, "wrote w.pfm: 8 x 8"));
    http_answer a = ask(&l, "GET", "picture");
    assert_int_equal(a.body_size, 8 * 8 * 3 * sizeof(float));
    http_free(&a);
    replace("w.rts", small_scene);
    assert_true(http_wait_for(l.events, "\"coarse\":false,\"watched\":true,\"renders\":6"));
    assert_true(http_wait_for(l.events, "\"elapsed\":1."));
    kill(l.running.pid, SIGINT);
    assert_int_equal(finish(&l, "stopped"), 130);
    assert_non_null(strstr(l.said, "interrupted; wrote w.pfm: 24 x 16"));
}

static void what_cannot_be_watched_is_refused(void **state)
{
    static const struct {
        const char *options, *says;
    } wrong[] = {
        {"- --watch --out e.pfm", "--watch: stdin is read once"},
        {"s.rts --watch --out e.rtpart", "--watch: a film (.rtpart) is of one scene"},
        {"s.rts --watch --checkpoint e.rtpart --out e.pfm",
         "--watch does not go with --checkpoint"},
        {"s.rts --watch --untrusted --out e.pfm", "--watch does not go with --untrusted"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        run r = run_rtc("%s", wrong[i].options);
        expect_status(&r, 2);
        expect_err(&r, wrong[i].says);
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
        cmocka_unit_test(a_change_of_any_file_renders_again),
        cmocka_unit_test(meshes_and_textures_are_watched_too),
        cmocka_unit_test(an_error_waits_to_be_mended),
        cmocka_unit_test(a_change_ends_the_render_under_way),
        cmocka_unit_test(what_cannot_be_watched_is_refused),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests(tests, enter, scratch_leave);
}
