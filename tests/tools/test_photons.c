/*
 * test_photons.c - `rtc photons` and --photon-map: maps emitted, merged, inspected, exported and
 * rendered with.
 */
#include <fcntl.h>
#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "expect.h"
#include "image/image.h"
#include "lib/image/scratch.h"
#include "spawn.h"
#include "tools/status.h"

/*
 * A closed box with a glass ball under an area light, and a light far too weak for its share of
 * the paths.
 */
#define SCENE                                                                                      \
    "camera { eye 0 0 0.9  look_at 0 0 0  fov 80 }\n"                                              \
    "film { width 16  height 16 }\n"                                                               \
    "material wall { kd 0.6 }\n"                                                                   \
    "material glass { kt 1  ior 1.5  fresnel dielectric }\n"                                       \
    "sphere { centre 0 0 0  radius 1  material wall }\n"                                           \
    "sphere { centre 0 -0.3 0  radius 0.3  material glass }\n"                                     \
    "quad { corner -0.2 0.7 -0.2  edge1 0.4 0 0  edge2 0 0 0.4  material wall  power 5 }\n"

static void succeed(const char *line)
{
    run run = run_rtc("%s", line);
    expect_status(&run, 0);
    run_free(&run);
}

/* Enters a scratch directory that holds the scene a.rts. */
static int enter(void **state)
{
    int failed = scratch_enter(state);
    if (!failed)
        scratch_write("a.rts", SCENE);
    return failed;
}

static void parts_merge_into_the_same_file(void **state)
{
    (void)state;
    succeed("photons a.rts --photons 3000 --caustic-photons 1000 --quiet --out whole.rtp");
    succeed("photons a.rts --photons 3000 --caustic-photons 1000 --quiet --out 1.rtp --part 1/3");
    succeed("photons a.rts --photons 3000 --caustic-photons 1000 --quiet --out 2.rtp --part 2/3 "
            "--threads 1");
    succeed("photons a.rts --photons 3000 --caustic-photons 1000 --quiet --out 3.rtp --part 3/3 "
            "--work-group 64");
    succeed("photons merge 3.rtp 1.rtp 2.rtp --out merged.rtp");
    expect_same_files("whole.rtp", "merged.rtp");
    expect_different_files("1.rtp", "2.rtp");
}

/* A part stands for an emission that was stopped; the map of all is then the checkpoint too. */
static void an_emission_goes_on_from_its_checkpoint(void **state)
{
    static const char options[] = "--photons 3000 --caustic-photons 1000";
    (void)state;
    run whole = run_rtc("photons a.rts %s --quiet --out whole.rtp --checkpoint kept.rtp --every 0",
                        options);
    expect_status(&whole, 0);
    run_free(&whole);
    expect_same_files("whole.rtp", "kept.rtp");
    for (int part = 1; part <= 3; part++) {
        run stopped =
            run_rtc("photons a.rts %s --quiet --out c%d.rtp --part %d/3", options, part, part);
        run on = run_rtc("photons a.rts %s --quiet --out on.rtp --resume c%d.rtp", options, part);
        expect_status(&stopped, 0);
        expect_status(&on, 0);
        expect_same_files("whole.rtp", "on.rtp");
        run_free(&stopped);
        run_free(&on);
    }
    expect_same_files("whole.rtp", "c2.rtp");
}

/* Two processes do not write one checkpoint. */
static void a_checkpoint_is_of_one_process(void **state)
{
    char pid[32], said[1 << 16];
    (void)state;
    unlink("l.rtp");
    running first = start_rtc("photons a.rts --photons 3e6 --out on.rtp --checkpoint l.rtp "
                              "--every 0");
    for (int waits = 0; waits < 3000 && access("l.rtp", F_OK) != 0; waits++)
        nanosleep(&(struct timespec){0, 10000000}, NULL);
    kill(first.pid, SIGSTOP); /* it holds the lock as long as is needed here */
    snprintf(pid, sizeof pid, "process %ld", (long)first.pid);
    run second = run_rtc("photons a.rts --photons 3e6 --out x.rtp --resume l.rtp");
    kill(first.pid, SIGKILL);
    running_finish(&first, said, sizeof said);
    expect_status(&second, STATUS_OUTPUT);
    expect_err(&second, "l.rtp is the checkpoint of a run that goes on");
    expect_err(&second, pid);
    run_free(&second);
    run third = run_rtc("photons a.rts --photons 3e5 --out x.rtp --resume l.rtp");
    expect_no_err(&third, "is the checkpoint of");
    run_free(&third);
    expect_no_file("l.rtp.rtlock");
}

/* Stopped behind its first checkpoint, and gone on with from that. */
static void a_stopped_emission_leaves_its_checkpoint(void **state)
{
    static const int signals[] = {SIGINT, SIGKILL};
    (void)state;
    succeed("photons a.rts --photons 3e5 --quiet --out whole.rtp");
    for (size_t i = 0; i < 2; i++) {
        char said[1 << 16];
        unlink("c.rtp");
        running running = start_rtc("photons a.rts --photons 3e5 --out on.rtp --checkpoint c.rtp "
                                    "--every 0");
        for (int waits = 0; waits < 3000 && access("c.rtp", F_OK) != 0; waits++)
            nanosleep(&(struct timespec){0, 10000000}, NULL);
        kill(running.pid, signals[i]);
        const int status = running_finish(&running, said, sizeof said);
        /* On a fast machine it may be done before. */
        assert_true(status == 0 || status == (i == 0 ? STATUS_INTERRUPTED : 128 + SIGKILL));
        if (status == STATUS_INTERRUPTED)
            assert_non_null(strstr(said, "the same command with --resume c.rtp goes on"));
        unlink("on.rtp");
        succeed("photons a.rts --photons 3e5 --quiet --out on.rtp --resume c.rtp");
        expect_same_files("whole.rtp", "on.rtp");
    }
}

static void what_cannot_be_gone_on_with_is_refused(void **state)
{
    static const struct {
        const char *line, *says;
    } cases[] = {
        {"--resume a.rtp --max-depth 3", "max_depth is 3 here, and"},
        {"--resume a.rtp --seed 2", "seed is 2 here, and 0 in the photon map"},
        {"--resume a.rtp --photons 50", "photons is 50 here, and the photon map that is there has"},
        {"--resume none.rtp", "none.rtp: No such file"},
        {"--resume a.rts", "a.rts: this is no photon map"},
        {"--checkpoint a.rtp", "--checkpoint a.rtp: the file is there already"},
        {"--checkpoint a.exr", "a file called NAME.rtp"},
        {"--checkpoint nowhere/c.rtp", "there is no such directory"},
    };
    (void)state;
    succeed("photons a.rts --photons 100 --quiet --out a.rtp");
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        run run = run_rtc("photons a.rts --photons 100 --out b.rtp %s", cases[i].line);
        assert_int_not_equal(run.status, 0);
        expect_err(&run, "error: ");
        expect_err(&run, cases[i].says);
        run_free(&run);
        expect_no_file("b.rtp");
    }
}

/* A map is not lost to another; one that has all of its paths may take its place. */
static void a_map_of_other_work_is_not_overwritten(void **state)
{
    static const struct {
        const char *line, *why;
    } others[] = {
        {"a.rts --photons 900 --part 1/3", "it has paths 300 to 599 of seed 0"},
        {"a.rts --photons 500", "it has paths 300 to 599 of seed 0"},
        {"a.rts --photons 900 --seed 1", "it has paths 300 to 599 of seed 0"},
        {"a.rts --photons 900 --max-depth 3", "max_depth is 3 here, and 16 in"},
        {"a.rts --photons 900 --caustic-photons 9", "caustic photons are kept apart here"},
        {"b.rts --photons 900", "of another scene"},
        {"merge 1.rtp 3.rtp", "it has paths 300 to 599 of seed 0"},
    };
    (void)state;
    scratch_write("b.rts", SCENE "light point { position 0 0 0.5  power 1 }\n");
    succeed("photons a.rts --photons 900 --part 1/3 --quiet --out 1.rtp");
    succeed("photons a.rts --photons 900 --part 2/3 --quiet --out 2.rtp");
    succeed("photons a.rts --photons 900 --part 2/3 --quiet --out kept.rtp");
    succeed("photons a.rts --photons 900 --part 3/3 --quiet --out 3.rtp");
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        run refused = run_rtc("photons %s --out kept.rtp", others[i].line);
        expect_status(&refused, STATUS_USAGE);
        expect_err(&refused, "--out kept.rtp: the photon map that is there is of other work");
        expect_err(&refused, others[i].why);
        expect_same_files("kept.rtp", "2.rtp");
        run_free(&refused);
    }
    succeed("photons a.rts --photons 900 --part 2/3 --quiet --out kept.rtp");
    succeed("photons merge 1.rtp 2.rtp --quiet --out kept.rtp");
    succeed("photons a.rts --photons 900 --quiet --resume kept.rtp --out kept.rtp");
    succeed("photons merge 1.rtp 2.rtp 3.rtp --quiet --out kept.rtp");
    scratch_write("kept.rtp", "half a map");
    succeed("photons a.rts --photons 900 --part 2/3 --quiet --out kept.rtp");
    expect_same_files("kept.rtp", "2.rtp");
}

/* Films and maps both go on from a checkpoint and are merged, by commands of their own. */
static void films_and_maps_that_are_confused_are_told(void **state)
{
    (void)state;
    succeed("photons a.rts --photons 10 --quiet --out a.rtp");
    succeed("a.rts --spp 1 --part 1/1 --quiet --out a.rtpart");
    run resumed = run_rtc("--resume a.rtp"), merged = run_rtc("photons merge a.rtpart --out b.rtp");
    assert_int_not_equal(resumed.status, 0);
    expect_err(&resumed, "`rtc photons SCENE --resume a.rtp` goes on with a photon map");
    assert_int_not_equal(merged.status, 0);
    expect_err(&merged, "`rtc merge` joins films");
    run_free(&resumed);
    run_free(&merged);
}

/* What --stats says of a map is what info says, and the time that it took. */
static void expect_begins(const run *stats, const run *info, size_t length, const char *next)
{
    assert_memory_equal(stats->out, info->out, length);
    assert_memory_equal(stats->out + length, next, strlen(next));
}

static void info_says_what_a_map_holds(void **state)
{
    (void)state;
    run made = run_rtc(
        "photons a.rts --photons 3000 --caustic-photons 1000 --seed 9 --stats --quiet --out a.rtp");
    run info = run_rtc("photons info a.rtp");
    expect_status(&made, 0);
    expect_status(&info, 0);
    expect_begins(&made, &info, strlen(info.out), "time by stage ");
    assert_true(stats_number(&info, "global photon paths") == 3000 &&
                stats_number(&info, "caustic photon paths") == 1000);
    assert_true(stats_number(&info, "global photons") > 1000 &&
                stats_number(&info, "caustic photons") > 50);
    expect_out(&info, "direct light: left to shadow rays");
    expect_out(&info, "global range: paths 0 to 2999 of seed 9, ");
    expect_out(&info, "ledger light 0 (shape 2): 3000 paths, power 5, emitted 5 = absorbed ");
    run_free(&made);
    run_free(&info);
}

/* Fog in a box: points in it, beside it, and at a black wall. */
static void points_away_from_photons_are_told(void **state)
{
    (void)state;
    scratch_write("fog.rts", "material fog { interface true  scattering 1 }\nmaterial black { }\n"
                             "box { centre 0 0.5 0  size 1 1 1  material fog }\n"
                             "quad { corner -3 0 -3  edge1 0 0 6  edge2 6 0 0  material black }\n"
                             "light point { position 2 2 0  intensity 10 }\n");
    succeed("photons fog.rts --photons 20000 --direct photons --quiet --out fog.rtp");
    scratch_write("points.txt", "0 0.5 0\n");
    run within = run_rtc("photons illuminance fog.rtp points.txt");
    assert_string_equal(within.err, "");
    run_free(&within);
    scratch_write("points.txt", "0 0.5 0\n2 1 0\n2 0 0 0 1 0\n");
    run beside = run_rtc("photons illuminance fog.rtp points.txt");
    expect_err(&beside, "of 3 points 2 lie outside of the media that photons lie in: the nearest "
                        "to point 2 is 1.");
    expect_err(&beside, "no photon lies on a surface, so that all irradiance is 0");
    run_free(&beside);
}

/* A floor under a point light, in fog: E = 2 W/m^2 below it, and the fluence rate 2 at 1 m. */
static void illuminance_of_points_is_printed(void **state)
{
    (void)state;
    scratch_write("lit.rts", "material grey { kd 0.5 }\nmedium { scattering 0.1 }\n"
                             "light point { position 0 1 0  intensity 2 }\n"
                             "quad { corner -3 0 -3  edge1 0 0 6  edge2 6 0 0  material grey }\n");
    scratch_write("points.txt",
                  "# below the light, and beside it\n\n0 0 0  0 2 0\r\n1,1,0 # in air\n");
    succeed("photons lit.rts --photons 20000 --direct photons --quiet --max-depth 2 --out lit.rtp");
    run text = run_rtc("photons illuminance lit.rtp points.txt --k 300 --volume-k 60"),
        json = run_rtc("photons illuminance lit.rtp points.txt --json --radius 0.2");
    expect_status(&text, 0);
    expect_status(&json, 0);
    double v[17];
    const char *line = strstr(text.out, "\n0 0 0 ");
    assert_non_null(line);
    for (int i = 0; i < 17; i++)
        v[i] = strtod(line, (char **)&line);
    assert_true(fabs(v[3] - 2) < 5 * v[6] && v[6] > 0.02 && v[6] < 0.5);
    assert_true(fabs(v[9] - 179 * v[3]) < 1e-3 * v[9] && v[10] > 2);
    assert_non_null(strstr(text.out, "\n1 1 0 0 0 0 0 0 0 0 0 "));
    expect_out(&json, "{\"position\":[0,0,0],\"irradiance\":[");
    expect_out(&json, "\"illuminance_error\":");
    expect_out(&json, "\"volume_photons\":19,");
    run_free(&text);
    run_free(&json);
    scratch_write("points.txt", "0.1 0 0.3 0 1 0\n0 500 0 0 1 0\n");
    run far = run_rtc("photons illuminance lit.rtp points.txt --k 30000");
    expect_out(&far, "\n0.1 0 0.3 ");
    expect_err(&far, "fewer than the 30000 nearest that an estimate wants");
    expect_err(&far,
               "of 2 points 1 lies off the surfaces that photons lie on: the nearest to point "
               "2 is 500 m away");
    run_free(&far);
    static const struct {
        const char *points, *says;
    } bad[] = {{"0 0\n", "points.txt:1: a line should be"},
               {"0 0 0\n0 0 0 0 0 0\n", "points.txt:2: a line should be"},
               {"0 0 0 x\n", "points.txt:1: a line should be"},
               {"0 0 inf\n", "points.txt:1: a line should be"},
               {"0 0 1e20\n", "error: point 0 has the coordinate 1e+20; it must lie within 1e+15"},
               {"# nothing\n", "has no points"}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        scratch_write("points.txt", bad[i].points);
        run refused = run_rtc("photons illuminance lit.rtp points.txt");
        assert_true(refused.status == 1 || refused.status == 2);
        expect_err(&refused, bad[i].says);
        run_free(&refused);
    }
}

static void diff_tells_equal_maps_from_others(void **state)
{
    static const struct {
        const char *options, *says;
    } others[] = {
        {"--photons 999", "only in the first"},
        {"--photons 999",
         "ledger light 0 (shape 2): 1000 and 999 paths, share 1 and 1, emitted 5 and 5, absorbed "},
        {"--photons 1000 --seed 1", "0 equal, 0 changed"},
        {"--photons 1000 --max-depth 4", "longest path: 16 and 4"},
        {"--photons 1000 --direct photons", "direct light in the map: 0 and 1"},
        {"--photons 1000 --sampler independent", "sampler: 0 and 1"},
        {"--photons 1000 --caustic-photons 10", "caustic photons apart: 0 and 1"},
    };
    (void)state;
    succeed("photons a.rts --photons 1000 --quiet --out a.rtp");
    succeed("photons a.rts --photons 1000 --quiet --out b.rtp --accel none");
    run same = run_rtc("photons diff a.rtp b.rtp");
    expect_status(&same, 0);
    assert_string_equal(same.out, "the maps are equal\n");
    run_free(&same);
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        char line[128];
        unlink("b.rtp");
        snprintf(line, sizeof line, "photons a.rts %s --quiet --out b.rtp", others[i].options);
        succeed(line);
        run run = run_rtc("photons diff a.rtp b.rtp");
        expect_status(&run, 1);
        expect_out(&run, others[i].says);
        run_free(&run);
    }
}

static void results_are_json_when_asked(void **state)
{
    (void)state;
    run made = run_rtc("photons a.rts --photons 1000 --seed 9 --quiet --stats --json --out a.rtp");
    run info = run_rtc("photons info a.rtp --json");
    succeed("photons a.rts --photons 999 --seed 9 --quiet --out b.rtp");
    run same = run_rtc("photons diff a.rtp a.rtp --json"),
        other = run_rtc("photons diff a.rtp b.rtp --json");
    assert_memory_equal(info.out, "{\"map\":\"a.rtp\",\"scene\":\"", 24);
    expect_begins(&made, &info, strlen(info.out) - strlen("}\n"), ",\"wall_seconds\":");
    expect_out(&info, ",\"direct\":\"nee\",\"sampler\":\"sobol\",\"max_depth\":16,\"rejected\":0,"
                      "\"global\":{\"paths\":1000,");
    expect_out(&info, ",\"ranges\":[{\"first\":0,\"count\":1000,\"photons\":");
    expect_out(
        &info,
        ",\"seed\":9}]},"
        "\"ledger\":[{\"shape\":2,\"paths\":1000,\"share\":1,\"power\":[5,5,5],\"emitted\":[");
    assert_null(strstr(info.out, "\"caustic\":{"));
    expect_status(&same, 0);
    expect_out(&same, "{\"maps\":[\"a.rtp\",\"a.rtp\"],\"same_scene\":true,\"same_settings\":true,"
                      "\"same_rejected\":true,\"same_ledger\":true,\"global\":{\"equal\":");
    expect_out(&same, ",\"equal\":true}\n");
    expect_status(&other, 1);
    expect_out(&other, "\"same_ledger\":false,");
    expect_out(&other, "\"only_second\":0,\"same_paths\":false},");
    expect_out(&other, ",\"equal\":false}\n");
    run_free(&made);
    run_free(&info);
    run_free(&same);
    run_free(&other);
    made = run_rtc("photons a.rts --photons 10 --json --out a.rtp");
    expect_err(&made, "warning: --json has no effect without --stats");
    run_free(&made);
}

/* A difference that could not be told is a failure, not the answer that there is one. */
static void full_stdout_is_status_4(void **state)
{
    static const char *const lines[] = {"photons info a.rtp",
                                        "photons diff a.rtp a.rtp",
                                        "photons diff a.rtp b.rtp",
                                        "compare a.pfm a.pfm",
                                        "compare a.pfm b.pfm --max-rmse 0",
                                        "check a.rts",
                                        "a.rts --spp 1 --stats --quiet --out a.png",
                                        "photons a.rts --photons 10 --stats --quiet --out c.rtp"};
    (void)state;
    succeed("photons a.rts --photons 100 --quiet --out a.rtp");
    succeed("photons a.rts --photons 101 --quiet --out b.rtp");
    succeed("a.rts --spp 1 --quiet --out a.pfm");
    succeed("a.rts --spp 1 --seed 1 --quiet --out b.pfm");
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        run run = run_rtc_to("/dev/full", "%s", lines[i]);
        expect_status(&run, 4);
        expect_err(&run, "cannot write to stdout: No space left");
        run_free(&run);
    }
}

static void maps_render_as_if_emitted(void **state)
{
    (void)state;
    succeed("photons a.rts --photons 5000 --caustic-photons 2000 --quiet --out a.rtp");
    succeed("a.rts --photon-map a.rtp --spp 2 --quiet --out with.pfm");
    succeed("a.rts --mode photon --photons 5000 --caustic-photons 2000 --spp 2 --quiet --out "
            "without.pfm");
    expect_same_files("with.pfm", "without.pfm");
    /* A map that holds direct light is used so without being asked to. */
    succeed("photons a.rts --photons 5000 --direct photons --quiet --out d.rtp");
    succeed("a.rts --photon-map d.rtp --spp 2 --quiet --out with.pfm");
    succeed(
        "a.rts --mode photon --direct photons --photons 5000 --spp 2 --quiet --out without.pfm");
    expect_same_files("with.pfm", "without.pfm");
    run run = run_rtc("a.rts --photon-map d.rtp --direct nee --spp 1 --quiet --out x.pfm");
    expect_status(&run, 2);
    expect_err(&run, "--direct: the photon map already holds direct light");
    run_free(&run);
}

/* A pipe can be read once, from its start to its end. */
static void maps_are_read_from_pipes(void **state)
{
    static const char *const lines[] = {"photons info /dev/stdin",
                                        "photons export /dev/stdin --out a.ply",
                                        "a.rts --photon-map /dev/stdin --spp 1 --out a.pfm"};
    char map[1 << 15]; /* less than a pipe holds */
    (void)state;
    succeed("photons a.rts --photons 200 --quiet --out a.rtp");
    FILE *file = fopen("a.rtp", "rb");
    assert_non_null(file);
    size_t size = fread(map, 1, sizeof map, file);
    fclose(file);
    assert_in_range(size, 1000, sizeof map - 1);
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        char said[1 << 12] = "";
        int pipes[2];
        assert_int_equal(pipe(pipes), 0);
        fcntl(pipes[1], F_SETFD, FD_CLOEXEC);
        running running = start_rtc_reading(pipes[0], "%s", lines[i]);
        close(pipes[0]);
        assert_int_equal(write(pipes[1], map, size), size);
        close(pipes[1]);
        int status = running_finish(&running, said, sizeof said);
        if (status != 0)
            fail_msg("rtc %s: status %d: %s", lines[i], status, said);
    }
    expect_file("a.ply");
    expect_file("a.pfm");
}

static void maps_of_other_scenes_are_refused(void **state)
{
    (void)state;
    scratch_write("b.rts", SCENE "sphere { centre 0.5 0 0  radius 0.1  material wall }\n");
    succeed("photons a.rts --photons 100 --quiet --out a.rtp");
    succeed("photons b.rts --photons 100 --seed 1 --quiet --out b.rtp");
    run render = run_rtc("b.rts --photon-map a.rtp --spp 1 --quiet --out x.pfm");
    expect_status(&render, 1);
    expect_err(&render, "a.rtp does not fit b.rts: the photon map was emitted in another scene");
    expect_no_file("x.pfm");
    run merge = run_rtc("photons merge a.rtp b.rtp --out c.rtp");
    expect_status(&merge, 1);
    expect_err(&merge, "a.rtp and b.rtp: the photon maps are of different scenes");
    expect_no_file("c.rtp");
    run_free(&render);
    run_free(&merge);
}

static void exports_are_clouds_of_points(void **state)
{
    char line[64];
    (void)state;
    succeed("photons a.rts --photons 500 --quiet --out a.rtp");
    run info = run_rtc("photons info a.rtp");
    run export = run_rtc("photons export a.rtp --out a.ply");
    expect_status(&export, 0);
    snprintf(line, sizeof line, "wrote a.ply: %.0f photons of 500 paths",
             stats_number(&info, "global photons"));
    expect_err(&export, line);
    expect_file("a.ply");
    run_free(&info);
    run_free(&export);
}

static void broken_maps_and_places_have_their_status(void **state)
{
    static const struct {
        const char *line;
        int status;
        const char *says;
    } cases[] = {
        {"photons info a.rts", 1, "a.rts: this is no photon map"},
        {"photons a.rts --out none/m.rtp", 4, "none/m.rtp: there is no such directory"},
        {"photons info .", 1, "directory"},
        {"a.rts --photon-map . --out a.pfm", 1, "directory"},
        {"photons info none.rtp", 1, "none.rtp: No such file"},
        {"photons diff a.rtp a.rts", 1, "no photon map"},
        {"photons merge a.rtp ./a.rtp --out c.rtp", 2,
         "./a.rtp is given twice: merged maps must be of different parts or seeds"},
        {"photons merge a.rtp b.rtp --out c.rtp", 1,
         "a.rtp and b.rtp: the photon maps hold the same paths, 0 to 99 of seed 0"},
        {"mesh sphere --out none/m.ply", 4, "none/m.ply: there is no such directory"},
        {"photons export a.rtp --out nowhere/a.ply", 4, "nowhere/a.ply"},
        {"photons merge a.rtp --out nowhere/a.rtp", 4, "nowhere/a.rtp"},
        {"photons a.rts --photons 10 --out nowhere/a.rtp", 4, "nowhere/a.rtp"},
        {"photons none.rts --out d.rtp", 1, "none.rts"},
        {"a.rts --photon-map none.rtp --out a.pfm", 1, "none.rtp"},
    };
    (void)state;
    succeed("photons a.rts --photons 100 --quiet --out a.rtp");
    succeed("photons a.rts --photons 150 --quiet --out b.rtp");
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        run run = run_rtc("%s", cases[i].line);
        expect_status(&run, cases[i].status);
        expect_err(&run, "error: ");
        expect_err(&run, cases[i].says);
        run_free(&run);
    }
    assert_int_equal(scratch_count(), 3);
}

static void starved_lights_are_told_without_verbose(void **state)
{
    (void)state;
    scratch_write("b.rts", SCENE "light point { position 0 0 0.5  power 1e-9 }\n");
    run loud = run_rtc("photons b.rts --photons 1000 --out b.rtp");
    run quiet = run_rtc("photons b.rts --photons 1000 --quiet --out b.rtp");
    run shared = run_rtc("photons b.rts --photons 1000 --light-shares 1,1 --stats --out c.rtp");
    expect_status(&loud, 0);
    expect_err(
        &loud,
        "rtc: warning: fewer than 100 of 1000 photon paths came from a light with power, "
        "whose light is noisy, or missing where there are none: light 0, 1e-09 W, 0 paths; ");
    assert_string_equal(quiet.err, "");
    expect_no_err(&shared, "warning");
    expect_out(&shared, "ledger light 1 (shape 2): ");
    expect_out(&shared, "ledger of all lights: 1000 paths");
    run_free(&loud);
    run_free(&quiet);
    run_free(&shared);
}

/* Paths go to the lights as a render is told, and the picture says in its file that they did. */
static void renders_print_stats_as_json(void **state)
{
    (void)state;
    run photon =
        run_rtc("a.rts --mode photon --photons 1000 --spp 1 --quiet --stats --json --out a.pfm");
    run path = run_rtc("a.rts --spp 3 --variance --quiet --stats --json --out a.exr");
    run idle = run_rtc("a.rts --spp 1 --json --out a.pfm");
    expect_status(&photon, 0);
    assert_memory_equal(photon.out, "{\"device\":\"", 11);
    expect_out(&photon, ",\"shapes\":3,");
    expect_out(
        &photon,
        ",\"mode\":\"photon\",\"width\":16,\"height\":16,\"spp\":1,\"rejected\":0,\"replicates\":0,"
        "\"light_power\":5,");
    expect_out(&photon, ",\"photons_emitted\":1000,");
    expect_out(&photon, ",\"ledger\":[{\"shape\":2,\"paths\":1000,");
    expect_out(&path, ",\"mode\":\"path\",\"width\":16,\"height\":16,\"spp\":3,");
    expect_out(&path, ",\"relative_error_bound\":null,");
    expect_out(&path, ",\"render_seconds\":");
    assert_null(strstr(path.out, "ledger"));
    assert_string_equal(strchr(path.out, '\n'), "\n");
    expect_err(&idle, "warning: --json has no effect without --stats");
    assert_string_equal(idle.out, "");
    run_free(&photon);
    run_free(&path);
    run_free(&idle);
}

static void renders_share_paths_among_lights(void **state)
{
    (void)state;
    scratch_write("b.rts", SCENE "light point { position 0 0 0.5  power 5 }\n");
    run told = run_rtc(
        "b.rts --mode photon --photons 1000 --light-shares 0.25,0.75 --spp 1 --stats --out b.exr");
    run path = run_rtc("b.rts --light-shares 1,1 --spp 1 --out b.pfm");
    expect_status(&told, 0);
    const char *line = strstr(told.out, "ledger light 0: ");
    int paths = 0;
    assert_non_null(line);
    /*
     * Of 1000 paths a quarter, within five standard errors of 14; but sobol draws them more evenly.
     */
    assert_true(sscanf(line, "ledger light 0: %d paths", &paths) == 1 && paths > 180 &&
                paths < 320);
    rt_image *image = NULL;
    assert_int_equal(rt_image_read(&image, "b.exr", NULL), RT_OK);
    assert_non_null(
        strstr(rt_image_attribute_value(image, "librt.command"), "--light-shares 0.25,0.75"));
    rt_image_destroy(image);
    expect_err(&path, "warning: --light-shares has no effect without --mode photon");
    run_free(&told);
    run_free(&path);
    succeed("photons b.rts --photons 100 --quiet --out b.rtp");
    run map = run_rtc("b.rts --photon-map b.rtp --light-shares 1,1 --spp 1 --out b.pfm");
    expect_err(&map, "warning: --light-shares has no effect with --photon-map");
    run_free(&map);
}

static void renders_print_the_ledger(void **state)
{
    (void)state;
    run photon = run_rtc("a.rts --mode photon --photons 1000 --spp 1 --quiet --stats --out a.pfm");
    run path = run_rtc("a.rts --spp 1 --quiet --stats --out a.pfm");
    expect_status(&photon, 0);
    expect_out(&photon, "ledger light 0 (shape 2): 1000 paths, power 5, emitted 5 = absorbed ");
    assert_null(strstr(path.out, "ledger"));
    run_free(&photon);
    run_free(&path);
}

int main(void)
{
    if (spawn_find_rtc() != 0)
        return 1;
#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, enter, scratch_leave)
    const struct CMUnitTest tests[] = {
        IN_SCRATCH(parts_merge_into_the_same_file),
        IN_SCRATCH(an_emission_goes_on_from_its_checkpoint),
        IN_SCRATCH(a_checkpoint_is_of_one_process),
        IN_SCRATCH(a_stopped_emission_leaves_its_checkpoint),
        IN_SCRATCH(what_cannot_be_gone_on_with_is_refused),
        IN_SCRATCH(a_map_of_other_work_is_not_overwritten),
        IN_SCRATCH(films_and_maps_that_are_confused_are_told),
        IN_SCRATCH(info_says_what_a_map_holds),
        IN_SCRATCH(results_are_json_when_asked),
        IN_SCRATCH(points_away_from_photons_are_told),
        IN_SCRATCH(illuminance_of_points_is_printed),
        IN_SCRATCH(diff_tells_equal_maps_from_others),
        IN_SCRATCH(full_stdout_is_status_4),
        IN_SCRATCH(maps_render_as_if_emitted),
        IN_SCRATCH(maps_are_read_from_pipes),
        IN_SCRATCH(maps_of_other_scenes_are_refused),
        IN_SCRATCH(exports_are_clouds_of_points),
        IN_SCRATCH(broken_maps_and_places_have_their_status),
        IN_SCRATCH(starved_lights_are_told_without_verbose),
        IN_SCRATCH(renders_print_stats_as_json),
        IN_SCRATCH(renders_share_paths_among_lights),
        IN_SCRATCH(renders_print_the_ledger),
    };
    return cmocka_run_group_tests_name("tools/photons", tests, NULL, NULL);
}
