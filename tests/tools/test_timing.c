/* test_timing.c - --stats and --profile: where the time of a render goes. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "expect.h"
#include "lib/image/scratch.h"
#include "small_scene.h"
#include "spawn.h"

/* A number of a row of the tables: column 0 is behind the name. */
static double cell(const run *run, const char *row, int column)
{
    char start[64];
    snprintf(start, sizeof start, "\n  %s ", row);
    char *at = strstr(run->out, start);
    double value = -1;
    if (!at)
        fail_msg("no row '%s' in:\n%s", row, run->out);
    at += strlen(start);
    for (int i = 0; i <= column; i++)
        value = strtod(at, &at);
    return value;
}

/* The sum of the percents of the owners of memory; their names have no digits. */
static double shares_of_memory(const run *run)
{
    const char *line = strstr(run->out, "\nmemory at its most");
    double sum = 0;
    assert_non_null(line);
    while ((line = strchr(line + 1, '\n')) && strncmp(line, "\n  ", 3) == 0) {
        char *at = NULL;
        strtod(line + strcspn(line, "0123456789"), &at);
        sum += strtod(at, NULL);
    }
    return sum;
}

/* A run whose stages take nearly all of its time; on a busy machine not each run is one. */
static run run_accounted_for(const char *options)
{
    for (int tries = 0;; tries++) {
        run run = run_rtc("a.rts --quiet --stats %s --out a.pfm", options);
        expect_status(&run, 0);
        assert_true(cell(&run, "all", 1) == 100);
        if (cell(&run, "other", 1) < 5)
            return run;
        run_free(&run);
        assert_true(tries < 4);
    }
}

static void stages_account_for_the_time(void **state)
{
    static const struct {
        const char *options, *stage, *kernel;
    } modes[] = {
        {"--mode path --spp 4096", "trace", "path_plain"},
        {"--mode direct --spp 1024", "trace", "direct_plain"},
        {"--mode normals --spp 1024", "trace", "first_hit_plain"},
        {"--mode photon --spp 64 --photons 2e5", "emit", "photon_emit_plain"},
        {"--mode photon --spp 64 --photons 2e5", "structure", "photon_camera_plain"},
        {"--mode photon --spp 4 --passes 40 --photons 2e4", "gather", "gather_tree_plain"}};
    (void)state;
    scratch_write("a.rts", small_scene);
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) {
        run run = run_accounted_for(modes[i].options);
        assert_true(cell(&run, modes[i].stage, 0) > 0);
        /* A kernel is launched within the stages, and not longer than they take. */
        assert_true(cell(&run, modes[i].kernel, 2) >= 1);
        assert_true(cell(&run, modes[i].kernel, 0) <= cell(&run, "all", 0));
        assert_true(stats_number(&run, "memory counted") > 0);
        assert_true(stats_number(&run, "memory of the process") > 0);
        assert_true(fabs(shares_of_memory(&run) - 100) < 1);
        run_free(&run);
    }
}

static void timing_changes_no_byte(void **state)
{
    static const char *const modes[] = {"--spp 9", "--mode photon --photons 1e4",
                                        "--mode photon --passes 3 --photons 1e4"};
    (void)state;
    scratch_write("a.rts", small_scene);
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) {
        run plain = run_rtc("a.rts --quiet %s --out a.pfm", modes[i]);
        run timed = run_rtc("a.rts --quiet %s --stats --profile t.json --out b.pfm", modes[i]);
        expect_status(&plain, 0);
        expect_status(&timed, 0);
        expect_same_files("a.pfm", "b.pfm");
        expect_file("t.json");
        run_free(&plain);
        run_free(&timed);
    }
}

/* An event of a trace. */
typedef struct event {
    double began, seconds;
    int process, track;
} event;

/* Reads the events of a trace, one a line; returns how many. */
static size_t read_trace(const char *path, event *out, size_t room)
{
    char line[512], *at;
    size_t count = 0;
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    while (count < room && fgets(line, sizeof line, file))
        if ((at = strstr(line, "\"ts\":")) &&
            sscanf(at, "\"ts\":%lf,\"dur\":%lf,\"pid\":%d,\"tid\":%d", &out[count].began,
                   &out[count].seconds, &out[count].process, &out[count].track) == 4)
            count++;
    fclose(file);
    return count;
}

/* Whether two events of a track are apart, or one is within the other; times have three digits. */
static int are_nested(const event *a, const event *b)
{
    const double a_end = a->began + a->seconds, b_end = b->began + b->seconds, unit = 0.002;
    return a_end <= b->began + unit || b_end <= a->began + unit ||
           (a->began <= b->began + unit && b_end <= a_end + unit) ||
           (b->began <= a->began + unit && a_end <= b_end + unit);
}

static void events_of_a_trace_are_nested(void **state)
{
    static event events[2048];
    size_t stages = 0;
    (void)state;
    scratch_write("a.rts", small_scene);
    run run = run_rtc("a.rts --quiet --mode photon --passes 9 --photons 1e4 --profile t.json "
                      "--out a.pfm");
    expect_status(&run, 0);
    const size_t count = read_trace("t.json", events, 2048);
    for (size_t i = 0; i < count; i++) {
        stages += events[i].process == 1;
        assert_true(events[i].began >= 0 && events[i].seconds >= 0);
        for (size_t j = 0; j < i; j++)
            if (events[i].process == events[j].process && events[i].track == events[j].track)
                assert_true(are_nested(events + i, events + j));
    }
    /* Passes emit, build and gather; each launches three kernels or more. */
    assert_true(stages >= 9 * 3 && count - stages >= 9 * 4);
    run_free(&run);
}

static void an_emission_is_timed_too(void **state)
{
    (void)state;
    scratch_write("a.rts", small_scene);
    run text = run_rtc("photons a.rts --quiet --photons 1e5 --stats --profile t.json --out a.rtp");
    expect_status(&text, 0);
    assert_true(cell(&text, "emit", 0) > 0 && cell(&text, "write map", 0) > 0);
    /* The first launch is that which compiles; the others are all there, too. */
    assert_true(cell(&text, "photon_emit_plain", 2) > 1);
    assert_true(cell(&text, "photon_emit_plain", 0) > 0.2 * cell(&text, "emit", 0));
    expect_file("t.json");
    run json = run_rtc("photons a.rts --quiet --photons 1e4 --stats --json --out b.rtp");
    expect_status(&json, 0);
    expect_out(&json, ",\"wall_seconds\":");
    expect_out(&json, "{\"name\":\"emit\",\"count\":1,\"seconds\":");
    expect_out(&json, "{\"name\":\"photon_emit_plain\",\"count\":");
    run_free(&text);
    run_free(&json);
}

/* All of a wall fills the view; the light, which reflects nothing, is behind the camera. */
static const char wall[] =
    "camera { eye 0 0 0  look_at 0 0 1  fov 60 }\n"
    "film { width 24  height 16 }\n"
    "material white { kd 0.7 }\n"
    "material black { kd 0 }\n"
    "quad { corner -9 -9 2  edge1 0 18 0  edge2 18 0 0  material white }\n"
    "quad { corner -1 -1 -1  edge1 2 0 0  edge2 0 2 0  material black  radiance 8 }\n";

/*
 * Every camera ray meets the wall, where it samples the light once; with paths of two rays, one
 * bounce follows, that roulette does not end yet.
 */
static void rays_are_as_many_as_paths_have(void **state)
{
    const double paths = 24 * 16 * 8;
    (void)state;
    scratch_write("a.rts", wall);
    for (int depth = 1; depth <= 2; depth++) {
        run run = run_rtc("a.rts --quiet --spp 8 --max-depth %d --roulette-depth 4 --stats "
                          "--count-rays --out a.pfm",
                          depth);
        expect_status(&run, 0);
        assert_true(stats_number(&run, "camera rays") == paths);
        assert_true(stats_number(&run, "bounce rays") == (depth - 1) * paths);
        assert_true(stats_number(&run, "shadow rays") == (depth - 1) * paths);
        assert_true(stats_number(&run, "photon rays") == 0);
        assert_true(stats_number(&run, "mean length of a camera path") == depth);
        run_free(&run);
    }
    run run =
        run_rtc("a.rts --quiet --spp 8 --max-depth 2 --stats --json --count-rays --out b.pfm");
    expect_status(&run, 0);
    expect_out(&run, ",\"rays\":{\"camera\":3072,\"bounce\":3072,\"shadow\":3072,\"photon\":0,");
    run_free(&run);
}

/* A light path of two segments ends where its only ray does. */
static void rays_of_photons_are_counted(void **state)
{
    (void)state;
    scratch_write("a.rts", wall);
    run run = run_rtc("photons a.rts --quiet --photons 5000 --max-depth 2 --stats --count-rays "
                      "--out a.rtp");
    expect_status(&run, 0);
    assert_true(stats_number(&run, "photon rays") == 5000);
    assert_true(stats_number(&run, "camera rays") == 0);
    run_free(&run);
}

static void counting_changes_no_byte(void **state)
{
    static const char *const modes[] = {"--spp 9", "--mode direct --spp 9",
                                        "--mode normals --spp 4",
                                        "--mode photon --passes 3 --photons 1e4"};
    (void)state;
    scratch_write("a.rts", small_scene);
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) {
        run plain = run_rtc("a.rts --quiet %s --out a.pfm", modes[i]);
        run counted = run_rtc("a.rts --quiet %s --stats --count-rays --out b.pfm", modes[i]);
        expect_status(&plain, 0);
        expect_status(&counted, 0);
        expect_same_files("a.pfm", "b.pfm");
        assert_true(stats_number(&counted, "camera rays") > 0);
        run_free(&plain);
        run_free(&counted);
    }
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_enter, scratch_leave)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(stages_account_for_the_time),    TEST(timing_changes_no_byte),
        TEST(rays_are_as_many_as_paths_have), TEST(rays_of_photons_are_counted),
        TEST(counting_changes_no_byte),       TEST(events_of_a_trace_are_nested),
        TEST(an_emission_is_timed_too),
    };
    return spawn_find_rtc() == 0 ? cmocka_run_group_tests(tests, NULL, NULL) : 1;
}
