/* test_progress.c - what the command says while it renders, and how it is interrupted. */
#define _XOPEN_SOURCE 700

#include <fcntl.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "device/work_folder.h"
#include "expect.h"
#include "lib/image/scratch.h"
#include "small_scene.h"
#include "spawn.h"

/* ---- What is said --------------------------------------------------------------- */

static void options_without_effect_are_warned_of(void **state)
{
    (void)state;
    scratch_write("a.rts", small_scene);
    run run = run_rtc("a.rts --spp 1 --k 5 --exposure 1 --out a.pfm");
    expect_status(&run, 0);
    expect_err(&run, "warning: --k has no effect without --mode photon");
    expect_err(&run, "warning: --exposure and --tonemap have no effect");
    run_free(&run);
    run = run_rtc("a.rts --spp 2 --part 1/2 --out a.rtpart");
    run_free(&run);
    run = run_rtc("--resume a.rtpart --k 5");
    expect_err(&run, "error: --k: k is 5, and 50 in the film to be continued");
    expect_no_err(&run, "warning");
    run_free(&run);
}

static void a_radius_of_merging_that_is_slow_is_warned_of(void **state)
{
    (void)state;
    scratch_write("a.rts", small_scene);
    run slow = run_rtc("a.rts --mode vcm --spp 1 --radius 4 --out a.pfm"),
        quick = run_rtc("a.rts --mode vcm --spp 1 --radius 0.2 --out a.pfm");
    expect_err(&slow, "warning: a radius of 4 m is 0.");
    expect_err(&slow, "and spreads their light over as wide a disc; the default is 0.1");
    expect_no_err(&quick, "warning");
    run_free(&slow);
    run_free(&quick);
}

/* Each has an effect without the last option of the line, or with the one beside it. */
static void options_without_effect_beside_others_are_warned_of(void **state)
{
    static const struct {
        const char *line, *says, *used;
    } cases[] = {
        {"--mode depth --max-depth 3", "--max-depth has no effect in a mode that shows no light",
         "--max-depth 3"},
        {"--mode albedo --roulette-depth 3", "--roulette-depth has no effect in a mode that",
         "--roulette-depth 3"},
        {"--mode normals --estimator light", "--estimator has no effect in a mode that",
         "--mode photon --photons 1000 --estimator light"},
        {"--mode photon --roulette-threshold 1",
         "--roulette-threshold has no effect in photon mode without",
         "--mode photon --roulette-threshold 1 --final-gather 1"},
        {"--mode photon --caustic-k 9", "--caustic-k has no effect without --caustic-photons",
         "--mode photon --caustic-k 9 --caustic-photons 500"},
        {"--mode photon --kernel cone --area hull", "--kernel has no effect with --area hull",
         "--mode photon --kernel cone"},
        {"--mode photon --kernel cone --cone-k 2 --area hull",
         "--cone-k has no effect with --area hull", "--mode photon --kernel cone --cone-k 2"},
        {"--mode photon --cone-k 2", "--cone-k has no effect without --kernel cone",
         "--mode photon --cone-k 2 --caustic-photons 500 --caustic-kernel cone"},
        {"--mode photon --alpha 0.5", "--alpha has no effect without --passes",
         "--mode photon --alpha 0.5 --passes 2"},
        {"--mode photon --volume-k 9", "--volume-k has no effect where no medium scatters",
         "--mode photon"},
        {"--mode photon --k 9 --passes 2 --radius 0.5",
         "--k has no effect with --passes and --radius", "--mode photon --k 9 --passes 2"},
    };
    (void)state;
    scratch_write("a.rts", small_scene);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *photons = strstr(cases[i].line, "photon") ? " --photons 1000" : "";
        run lost = run_rtc("a.rts --spp 1 %s%s --out a.pfm", cases[i].line, photons);
        run used = run_rtc("a.rts --spp 1 %s%s --out a.pfm", cases[i].used, photons);
        expect_status(&lost, 0);
        expect_err(&lost, "warning: ");
        expect_err(&lost, cases[i].says);
        expect_status(&used, 0);
        expect_no_err(&used, "no effect");
        run_free(&lost);
        run_free(&used);
    }
}

/*
 * Layers go to an .exr; what the scene turns on by itself is no mistake of who types another name.
 */
static void layers_without_a_place_are_warned_of(void **state)
{
    static const char *const options[] = {"--aov", "--variance",
                                          "--mode photon --photons 1000 --photon-layers"},
                             *const says[] = {
                                 "warning: --aov has no effect without an .exr",
                                 "warning: --variance adds no layer without an .exr",
                                 "warning: --photon-layers has no effect without an .exr"};
    (void)state;
    scratch_write("a.rts", small_scene);
    for (size_t i = 0; i < sizeof says / sizeof *says; i++) {
        run png = run_rtc("a.rts --spp 8 %s --out a.png --out a.pfm", options[i]);
        run exr = run_rtc("a.rts --spp 8 %s --out a.png --out a.exr", options[i]);
        run off = run_rtc("a.rts --spp 8 %s --no-aov --no-variance --no-photon-layers --out a.png",
                          options[i]);
        expect_status(&png, 0);
        expect_err(&png, says[i]);
        expect_no_err(&exr, "warning");
        expect_no_err(&off, "warning");
        run_free(&png);
        run_free(&exr);
        run_free(&off);
    }
}

/* A scene without light, seen from inside of a ball of glass. */
static const char dark_scene[] =
    "camera { eye 0 0 -4  look_at 0 0 0 }\nfilm { width 8  height 8 }\n"
    "material glass { kt 1 }\nmaterial white { kd 1 }\n"
    "sphere { centre 0 0 0  radius 1  material white }\n"
    "sphere { centre 0 0 -4  radius 1  material glass }\n";

/* Notes are for a check alone; a render warns where its mode shows light. */
static void what_would_be_black_is_warned_of(void **state)
{
    (void)state;
    scratch_write("dark.rts", dark_scene);
    run run = run_rtc("check dark.rts");
    expect_status(&run, 0);
    expect_err(&run, "rtc: warning: dark.rts: the scene has no light: its picture is black\n");
    expect_err(&run, "dark.rts:1:1: note: the camera is inside a transparent sphere\n"
                     "    camera { eye 0 0 -4  look_at 0 0 0 }\n    ^~~~~~\n  hint: the sphere is "
                     "at dark.rts:6\n");
    expect_out(&run, "; 1 warning\n");
    run_free(&run);

    run = run_rtc("dark.rts --spp 1 --out a.pfm --progress none");
    expect_status(&run, 0);
    expect_err(&run, "rtc: warning: the scene has no light: its picture is black\nwrote ");
    run_free(&run);
    scratch_write("away.rts", "camera { eye 0 1 -4  look_at 0 1 0 }\nfilm { width 8  height 8 }\n"
                              "material lamp { emission 1 }\nmaterial white { kd 1 }\n"
                              "plane { point 0 0 0  normal 0 1 0  material white }\n"
                              "quad { corner -0.5 3 -0.5  edge1 1 0 0  edge2 0 0 1  material "
                              "lamp }\nbox { centre 0 3.1 0  size 4 0.2 10  material white }\n");
    run = run_rtc("away.rts --spp 1 --out a.pfm --progress none");
    expect_status(&run, 0);
    expect_err(&run, "away.rts:6:1: warning: this light lights nothing, or next to it: ");
    expect_err(&run, "rtc: warning: no light of the scene lights anything: its picture is black");
    expect_no_err(&run, "rt_scene_check");
    run_free(&run);
    run = run_rtc("dark.rts --spp 8 --variance --out a.exr --progress none");
    expect_err(&run, "relative error unknown: the picture is black\n");
    run_free(&run);
    run = run_rtc("dark.rts --target-error 0.1 --out a.exr --progress none");
    expect_err(&run, "the target error of 10 % was not reached");
    run_free(&run);
    run = run_rtc("dark.rts --spp 1 --out a.pfm --progress none");
    expect_no_err(&run, "note");
    run_free(&run);
    run = run_rtc("dark.rts --spp 1 --mode normals --out a.pfm --progress none");
    expect_no_err(&run, "warning");
    run_free(&run);
    run = run_rtc("dark.rts --spp 1 --quiet --out a.pfm");
    assert_string_equal(run.err, "");
    run_free(&run);
}

/* Neither a larger radius nor more photons help where no light falls on anything. */
static void an_empty_map_is_warned_of_once(void **state)
{
    (void)state;
    scratch_write("a.rts", "camera { eye 0 0 -4  look_at 0 0 0 }\nfilm { width 8  height 8 }\n"
                           "material white { kd 0.7 }\n"
                           "sphere { centre 0 0 0  radius 1  material white }\n"
                           "light spot { position 3 4 3  target 9 9 9  intensity 20\n"
                           "             inner 5  outer 10 }\n");
    run run = run_rtc("a.rts --mode photon --photons 1000 --spp 1 --out a.pfm");
    expect_status(&run, 0);
    expect_err(&run, "warning: the photon map is empty: none of 1000 photon paths left a photon");
    expect_no_err(&run, "found no photon");
    run_free(&run);
}

static size_t count_warnings(const run *run)
{
    size_t count = 0;
    for (const char *at = run->err; (at = strstr(at, "warning:")) != NULL; at++)
        count++;
    return count;
}

static void photons_without_a_light_are_warned_of_once(void **state)
{
    static const char *const lines[] = {
        "a.rts --mode photon --spp 1 --out a.pfm",
        "a.rts --mode photon --caustic-photons 50 --spp 1 --out a.pfm",
        "a.rts --mode photon --passes 2 --radius 0.1 --spp 1 --out a.pfm",
        "photons a.rts --out a.rtp", "photons a.rts --caustic-photons 50 --out b.rtp"};
    (void)state;
    scratch_write("a.rts", dark_scene);
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        run run = run_rtc("%s --photons 100 --progress none", lines[i]);
        expect_status(&run, 0);
        expect_err(&run, "warning: the scene has no light");
        if (count_warnings(&run) != 1)
            fail_msg("%s: %s", lines[i], run.err);
        run_free(&run);
    }
}

static void quiet_says_nothing(void **state)
{
    (void)state;
    scratch_write("a.rts", small_scene);
    run run = run_rtc("a.rts --spp 1 --quiet --k 5 --out a.pfm");
    expect_status(&run, 0);
    assert_string_equal(run.err, "");
    assert_string_equal(run.out, "");
    run_free(&run);
}

static void verbose_names_the_device_and_its_threads(void **state)
{
    (void)state;
    scratch_write("a.rts", small_scene);
    run run = run_rtc("a.rts --spp 1 --threads 1 --verbose --out a.pfm");
    expect_status(&run, 0);
    expect_err(&run, "device ");
    /* Of other devices all units are in use. */
    if (device_is_cpu())
        expect_err(&run, ", 1 compute unit\n");
    run_free(&run);
}

static void plain_progress_names_the_stages(void **state)
{
    (void)state;
    scratch_write("a.rts", small_scene);
    run run = run_rtc("a.rts --spp 1 --mode photon --photons 1000 --out a.pfm");
    expect_status(&run, 0);
    static const char *const stages[] = {"load    100 %", "build   100 %", "compile 100 %",
                                         "emit    100 %", "gather  100 %"};
    for (size_t i = 0; i < sizeof stages / sizeof stages[0]; i++)
        expect_err(&run, stages[i]);
    expect_no_err(&run, "\r");
    expect_no_err(&run, "\033");
    run_free(&run);
}

static void json_progress_is_one_object_a_line(void **state)
{
    (void)state;
    scratch_write("a.rts", small_scene);
    run run = run_rtc("a.rts --spp 1 --progress json --quiet --out a.pfm");
    expect_status(&run, 0);
    int lines = 0;
    for (char *line = strtok(run.err, "\n"); line; line = strtok(NULL, "\n"), lines++) {
        char stage[16], remaining[32], relative[32];
        double fraction, elapsed;
        assert_int_equal(
            sscanf(line,
                   "{\"stage\":\"%15[a-z]\",\"fraction\":%lf,\"elapsed\":%lf,\"remaining\":%31[^,],"
                   "\"error\":%31[^}]}",
                   stage, &fraction, &elapsed, remaining, relative),
            5);
        assert_true(fraction >= 0.0 && fraction <= 1.0 && elapsed >= 0.0);
        assert_int_equal(line[strlen(line) - 1], '}');
    }
    /* The beginning and the end of three stages. */
    assert_true(lines >= 6);
    run_free(&run);
}

/*
 * Fails unless every line is an object with a stage or a severity; returns how many have a
 * severity.
 */
static int expect_json_lines(char *text)
{
    int messages = 0;
    for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n")) {
        int is_message = strncmp(line, "{\"severity\":\"", 13) == 0;
        if ((!is_message && strncmp(line, "{\"stage\":\"", 10) != 0) ||
            line[strlen(line) - 1] != '}' || strstr(line + 1, "{\""))
            fail_msg("no JSON object: %s", line);
        messages += is_message;
    }
    return messages;
}

/*
 * A program reads one stream: warnings, errors with their place, hints and the last word are
 * objects too.
 */
static void all_that_is_said_beside_json_progress_is_json(void **state)
{
    (void)state;
    scratch_write("a.rts", small_scene);
    run run = run_rtc("a.rts --spp 1 --k 5 --verbose --progress json --out a.pfm");
    expect_status(&run, 0);
    expect_err(&run,
               "{\"severity\":\"warning\",\"message\":\"--k has no effect without --mode photon\"");
    expect_err(&run, "{\"severity\":\"note\",\"message\":\"wrote a.pfm: ");
    assert_true(expect_json_lines(run.err) >= 3);
    run_free(&run);

    scratch_write("b.rts", "camera { eye 0 0 -4  look_at 0 0 0 }\nsphear { file \"a\\b\" }\n");
    run = run_rtc("b.rts --progress json --out a.pfm");
    expect_status(&run, 1);
    expect_err(&run,
               "{\"severity\":\"error\",\"file\":\"b.rts\",\"line\":2,\"column\":1,\"message\":\"");
    expect_err(&run, "'sphear'\",\"hint\":\"did you mean 'sphere'?\"}\n");
    assert_true(expect_json_lines(run.err) >= 1);
    run_free(&run);

    run = run_rtc("no\"where\\.rts --progress json --out a.pfm");
    expect_err(&run, "\"file\":\"no\\\"where\\\\.rts\"");
    run_free(&run);
}

static void no_progress_when_none_is_asked(void **state)
{
    (void)state;
    scratch_write("a.rts", small_scene);
    run run = run_rtc("a.rts --spp 1 --progress none --out a.pfm");
    expect_status(&run, 0);
    expect_no_err(&run, "%");
    expect_err(&run, "wrote a.pfm");
    run_free(&run);
}

/* Of the reading of the scene; elsewhere nothing is said of it. */
static void check_shows_progress_on_a_terminal_alone(void **state)
{
    (void)state;
    scratch_write("a.rts", small_scene);
    run run = run_rtc_terminal("TERM=xterm rtc check a.rts");
    expect_status(&run, 0);
    expect_out(&run, "load    100 %");
    expect_out(&run, "\r\033[Ka.rts: ok");
    run_free(&run);
    static const char *const silent[] = {"TERM=xterm rtc check a.rts --quiet",
                                         "TERM=xterm rtc check a.rts --json",
                                         "TERM=dumb rtc check a.rts"};
    for (size_t i = 0; i < sizeof silent / sizeof *silent; i++) {
        run = run_rtc_terminal("%s", silent[i]);
        expect_status(&run, 0);
        assert_null(strstr(run.out, "load"));
        run_free(&run);
    }
    run = run_rtc("check a.rts");
    assert_string_equal(run.err, "");
    run_free(&run);
}

static void terminal_gets_a_redrawn_line_and_colours(void **state)
{
    (void)state;
    scratch_write("a.rts", small_scene);
    run run = run_rtc_terminal("TERM=xterm rtc a.rts --spp 1 --k 5 --out a.pfm");
    expect_status(&run, 0);
    expect_out(&run, "\rrender  100 %");
    expect_out(&run, "\033[1;33mwarning: \033[0m");
    run_free(&run);

    run = run_rtc_terminal("TERM=xterm NO_COLOR=1 rtc a.rts --spp 1 --k 5 --out a.pfm");
    expect_status(&run, 0);
    expect_out(&run, "rtc: warning: --k");
    run_free(&run);

    run = run_rtc_terminal("TERM=dumb rtc a.rts --spp 1 --k 5 --out a.pfm");
    expect_status(&run, 0);
    expect_out(&run, "rtc: warning: --k");
    assert_null(strstr(run.out, "\033"));
    run_free(&run);
}

static void closed_stderr_does_not_end_a_render(void **state)
{
    (void)state;
    char said[1 << 12] = "";
    scratch_write("a.rts", small_scene);
    running running = start_rtc("a.rts --spp 20 --progress json --out a.pfm");
    assert_int_equal(running_wait_for(&running, "fraction", said, sizeof said), 0);
    assert_int_equal(running_abandon(&running), 0);
    expect_file("a.pfm");
}

/* ---- Interruption ----------------------------------------------------------------- */

/*
 * Waits until a render has samples. Its first report of the stage comes before all, and the next
 * two not before a batch is done.
 */
static void wait_for_samples(running *running, const char *stage, char *said, size_t size)
{
    char *from = said;
    for (int reports = 0; reports < 3; reports++) {
        assert_int_equal(running_wait_for(running, stage, from, size - (size_t)(from - said)), 0);
        from = strstr(from, stage) + 1;
    }
}

/*
 * Starts a render that would last for hours, sends a signal once it renders, and looks at what is
 * left.
 */
static void interrupt_render(int signal_number, const char *options, const char *stage)
{
    static char said[1 << 20];
    scratch_write("a.rts", small_scene);
    said[0] = '\0';
    running running = start_rtc("a.rts --spp 16000000 %s --progress json --out a.pfm", options);
    wait_for_samples(&running, stage, said, sizeof said);
    assert_int_equal(kill(running.pid, signal_number), 0);
    assert_int_equal(running_finish(&running, said, sizeof said), 130);
    assert_non_null(strstr(said, "{\"severity\":\"note\",\"message\":\"stopping; interrupt again"));
    assert_non_null(strstr(said, "interrupted; wrote a.pfm: 24 x 16, "));
    assert_int_equal(expect_json_lines(said), 2);
    expect_file("a.pfm");
}

static void interrupted_path_render_writes_its_samples(void **state)
{
    (void)state;
    interrupt_render(SIGINT, "", "\"render\"");
}

static void terminated_path_render_writes_its_samples(void **state)
{
    (void)state;
    interrupt_render(SIGTERM, "", "\"render\"");
}

static void a_lost_connection_writes_the_samples(void **state)
{
    (void)state;
    interrupt_render(SIGHUP, "", "\"render\"");
}

/* Where a driver compiles for seconds, it tells that it is still at it. */
static void expect_reports_of_compile(const char *said)
{
    double last = 0.0, elapsed;
    int reports = 0;
    for (const char *at = said; (at = strstr(at, "{\"stage\":\"compile\"")); at++, reports++) {
        assert_int_equal(sscanf(strstr(at, "elapsed"), "elapsed\":%lf", &elapsed), 1);
        assert_true(elapsed - last < 1.5);
        last = elapsed;
    }
    /* On another driver, or a fast machine, there is little to tell. */
    assert_true(reports >= 2);
}

/*
 * With an empty cache, the build takes seconds. SIGQUIT ends the render also after the driver has
 * compiled: LLVM takes this signal.
 */
static void first_compile_keeps_reporting_and_quit_ends_what_follows(void **state)
{
    static char said[1 << 20];
    const struct rlimit no_core = {0, 0};
    struct rlimit core;
    (void)state;
    scratch_write("a.rts", small_scene);
    said[0] = '\0';
    assert_int_equal(getrlimit(RLIMIT_CORE, &core) | setrlimit(RLIMIT_CORE, &no_core), 0);
    running running = start_rtc("POCL_CACHE_DIR=empty rtc a.rts --spp 16000000 --mode normals "
                                "--progress json --out a.pfm");
    assert_int_equal(running_wait_for(&running, "\"render\"", said, sizeof said), 0);
    assert_int_equal(kill(running.pid, SIGQUIT), 0);
    assert_int_equal(running_finish(&running, said, sizeof said), 128 + SIGQUIT);
    expect_no_file("a.pfm");
    expect_reports_of_compile(said);
    setrlimit(RLIMIT_CORE, &core);
    rt_folder_remove("empty");
}

/* A floor of which the camera sees a small part. */
static const char floor_scene[] =
    "let fov = 20\ncamera { eye 0 4 -1  look_at 0 0 0  fov (fov) }\nfilm { width 8  height 8 }\n"
    "render { mode photon  direct photons  spp 1 }\nmaterial white { kd 0.7 }\n"
    "quad { corner -5 0 -5  edge1 0 0 10  edge2 10 0 0  material white }\n"
    "light point { position 0 5 0  intensity 200 }\n";

static void few_photon_paths_that_are_seen_are_told(void **state)
{
    static const struct {
        const char *options;
        int hints;
    } cases[] = {
        {"", 1},        {"--photon-importance", 0}, {"--photons 10000", 0},
        {"--quiet", 0}, {"--set fov=120", 0},
    };
    (void)state;
    scratch_write("a.rts", floor_scene);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        run run = run_rtc("a.rts --out a.pfm %s", cases[i].options);
        expect_status(&run, 0);
        if (cases[i].hints) {
            expect_err(&run, "the camera gathers photons of about ");
            expect_err(&run, "  hint: with --passes 32 and --photon-importance it would be about ");
        } else {
            expect_no_err(&run, "--photon-importance");
        }
        run_free(&run);
    }
}

/* Nothing can be written before all photons are there, and the hint says what can be done. */
static void an_interrupt_while_photons_are_emitted_says_what_helps(void **state)
{
    static char said[1 << 20];
    (void)state;
    scratch_write("a.rts", small_scene);
    said[0] = '\0';
    running running = start_rtc("a.rts --mode photon --photons 1e9 --progress json --out a.pfm");
    assert_int_equal(running_wait_for(&running, "\"emit\"", said, sizeof said), 0);
    assert_int_equal(kill(running.pid, SIGINT), 0);
    assert_int_equal(running_finish(&running, said, sizeof said), 130);
    assert_non_null(strstr(said, "interrupted before the first sample; nothing was written"));
    assert_non_null(strstr(said, "with --passes N each pass"));
    expect_no_file("a.pfm");
}

static void interrupted_photon_render_writes_its_samples(void **state)
{
    (void)state;
    interrupt_render(SIGINT, "--mode photon --photons 1000", "\"gather\"");
}

/* The status alone tells of it. */
static void quiet_says_nothing_of_an_interrupt(void **state)
{
    static const char *const options[] = {"--spp 16000000 --quiet --out a.pfm",
                                          "--mode photon --photons 1e9 --quiet --out b.pfm"};
    const struct timespec nap = {1, 0};
    (void)state;
    scratch_write("a.rts", small_scene);
    for (size_t i = 0; i < sizeof options / sizeof *options; i++) {
        static char said[1 << 16];
        said[0] = '\0';
        running running = start_rtc("a.rts %s", options[i]);
        nanosleep(&nap, NULL);
        assert_int_equal(kill(running.pid, SIGINT), 0);
        assert_int_equal(running_finish(&running, said, sizeof said), 130);
        assert_string_equal(said, "");
    }
}

static void second_interrupt_kills(void **state)
{
    (void)state;
    static char said[1 << 20];
    scratch_write("a.rts", small_scene);
    said[0] = '\0';
    running running = start_rtc("a.rts --spp 16000000 --progress json --out a.pfm");
    assert_int_equal(running_wait_for(&running, "\"render\"", said, sizeof said), 0);
    /* While it stands still it cannot act on the first, so both are there when it goes on. */
    kill(running.pid, SIGSTOP);
    kill(running.pid, SIGINT);
    kill(running.pid, SIGTERM);
    kill(running.pid, SIGCONT);
    int status = running_finish(&running, said, sizeof said);
    assert_true(status == 128 + SIGINT || status == 128 + SIGTERM);
    expect_no_file("a.pfm");
}

/* As timeout(1) sends them, to a process and to its group. */
static void a_signal_that_comes_twice_at_once_is_one(void **state)
{
    (void)state;
    static char said[1 << 20];
    scratch_write("a.rts", small_scene);
    said[0] = '\0';
    running running = start_rtc("a.rts --spp 16000000 --progress json --out a.pfm");
    assert_int_equal(running_wait_for(&running, "\"render\"", said, sizeof said), 0);
    kill(running.pid, SIGINT);
    assert_int_equal(running_wait_for(&running, "stopping", said, sizeof said), 0);
    kill(running.pid, SIGINT);
    assert_int_equal(running_finish(&running, said, sizeof said), 130);
    expect_file("a.pfm");
    remove("a.pfm");
}

/* As a service manager sends them: both ask for the same. */
static void a_hangup_with_a_termination_writes_the_picture(void **state)
{
    (void)state;
    static char said[1 << 20];
    scratch_write("a.rts", small_scene);
    said[0] = '\0';
    running running = start_rtc("a.rts --spp 16000000 --progress json --out a.pfm");
    assert_int_equal(running_wait_for(&running, "\"render\"", said, sizeof said), 0);
    kill(running.pid, SIGHUP);
    kill(running.pid, SIGTERM);
    assert_int_equal(running_finish(&running, said, sizeof said), 130);
    expect_file("a.pfm");
    remove("a.pfm");
}

/* A scene that never ends on stdin: the first signal stops the reading, and with it the run. */
static void interrupted_wait_for_stdin_ends_at_once(void **state)
{
    static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
    static char blanks[(1 << 16) + 1]; /* more than a pipe holds: once they are gone, rtc reads */
    (void)state;
    memset(blanks, ' ', sizeof blanks);
    for (size_t i = 0; i < sizeof signals / sizeof *signals; i++) {
        char said[1 << 12] = "";
        int pipes[2];
        assert_int_equal(pipe(pipes), 0);
        fcntl(pipes[1], F_SETFD, FD_CLOEXEC);
        running running = start_rtc_reading(pipes[0], "- --spp 1 --out a.pfm");
        close(pipes[0]);
        for (size_t done = 0; done < sizeof blanks;) {
            ssize_t count = write(pipes[1], blanks + done, sizeof blanks - done);
            assert_true(count > 0);
            done += (size_t)count;
        }
        assert_int_equal(kill(running.pid, signals[i]), 0);
        /* While the pipe is open. One that waits on would not end. */
        assert_int_equal(running_wait_for(&running, "rtc: interrupted; nothing was written\n", said,
                                          sizeof said),
                         0);
        close(pipes[1]);
        assert_int_equal(running_finish(&running, said, sizeof said), 130);
        expect_no_file("a.pfm");
    }
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_enter, scratch_leave)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(options_without_effect_are_warned_of),
        TEST(options_without_effect_beside_others_are_warned_of),
        TEST(a_radius_of_merging_that_is_slow_is_warned_of),
        TEST(layers_without_a_place_are_warned_of),
        TEST(what_would_be_black_is_warned_of),
        TEST(an_empty_map_is_warned_of_once),
        TEST(photons_without_a_light_are_warned_of_once),
        TEST(quiet_says_nothing),
        TEST(verbose_names_the_device_and_its_threads),
        TEST(plain_progress_names_the_stages),
        TEST(json_progress_is_one_object_a_line),
        TEST(all_that_is_said_beside_json_progress_is_json),
        TEST(no_progress_when_none_is_asked),
        TEST(check_shows_progress_on_a_terminal_alone),
        TEST(terminal_gets_a_redrawn_line_and_colours),
        TEST(closed_stderr_does_not_end_a_render),
        TEST(interrupted_path_render_writes_its_samples),
        TEST(terminated_path_render_writes_its_samples),
        TEST(interrupted_photon_render_writes_its_samples),
        TEST(a_signal_that_comes_twice_at_once_is_one),
        TEST(a_lost_connection_writes_the_samples),
        TEST(first_compile_keeps_reporting_and_quit_ends_what_follows),
        TEST(few_photon_paths_that_are_seen_are_told),
        TEST(an_interrupt_while_photons_are_emitted_says_what_helps),
        TEST(quiet_says_nothing_of_an_interrupt),
        TEST(second_interrupt_kills),
        TEST(a_hangup_with_a_termination_writes_the_picture),
        TEST(interrupted_wait_for_stdin_ends_at_once),
    };
    return spawn_find_rtc() == 0 ? cmocka_run_group_tests(tests, NULL, NULL) : 1;
}
