/* test_rtc.c - rendering by the command: the effect of each option, its files, its progress, its interruption. */
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "expect.h"
#include "image/image_file.h"
#include "lib/image/scratch.h"
#include "spawn.h"

/* A diffuse and a glass ball on a floor, under a square lamp: every option can matter. */
static const char scene[] = "camera { eye 0 1.5 -5  look_at 0 0.8 0  fov 45 }\n"
                            "film { width 24  height 16 }\n"
                            "material white { kd 0.7 }\n"
                            "material glass { kt 1  ior 1.5  fresnel true }\n"
                            "quad { corner -4 0 -4  edge1 0 0 8  edge2 8 0 0  material white }\n"
                            "quad { corner -4 0 3  edge1 0 6 0  edge2 8 0 0  material white }\n"
                            "sphere { centre -1 1 0  radius 1  material white }\n"
                            "sphere { centre 1 1 0  radius 0.9  material glass }\n"
                            "quad { corner -1 4 -1  edge1 2 0 0  edge2 0 0 2  material white  radiance 8 }\n";

static void write_scene(void)
{
    scratch_write("a.rts", scene);
}

static rt_image *read_image(const char *path)
{
    rt_image *image;
    rt_error error;
    if (rt_image_read(&image, path, &error) != RT_OK)
        fail_msg("%s: %s", path, error.message);
    return image;
}

/* The mean of all channels of an image. */
static double image_mean(const char *path)
{
    rt_image *image = read_image(path);
    size_t count = (size_t)image->width * image->height * image->channel_count;
    double sum = 0.0;
    for (size_t i = 0; i < count; i++)
        sum += image->data[i];
    rt_image_destroy(image);
    return sum / (double)count;
}

/* Renders a.rts quietly with these options and --out name.pfm; --stats comes back. Free it. */
static run render(const char *name, const char *options)
{
    run run = run_rtc("a.rts --quiet --stats %s --out %s.pfm", options, name);
    expect_status(&run, 0);
    assert_string_equal(run.err, "");
    return run;
}

static void render_and_forget(const char *name, const char *options)
{
    run run = render(name, options);
    run_free(&run);
}

/* ---- Options that change the picture ------------------------------------------ */

/* Each pair differs in the one option that is named last. */
static const struct {
    const char *option, *a, *b;
} pairs[] = {
    {"mode", "--spp 2", "--spp 2 --mode photon --photons 1000"},
    {"spp", "--spp 2", "--spp 3"},
    {"max-depth", "--spp 2", "--spp 2 --max-depth 2"},
    {"seed", "--spp 2", "--spp 2 --seed 7"},
    {"sampler", "--spp 2", "--spp 2 --sampler independent"},
    {"photons", "--spp 2 --mode photon --photons 1000", "--spp 2 --mode photon --photons 2000"},
    {"k", "--spp 2 --mode photon --photons 1000", "--spp 2 --mode photon --photons 1000 --k 7"},
    {"radius", "--spp 2 --mode photon --photons 1000", "--spp 2 --mode photon --photons 1000 --radius 0.05"},
    {"kernel", "--spp 2 --mode photon --photons 1000", "--spp 2 --mode photon --photons 1000 --kernel box"},
    {"cone-k", "--spp 2 --mode photon --photons 1000 --kernel cone",
     "--spp 2 --mode photon --photons 1000 --kernel cone --cone-k 2"},
    {"direct", "--spp 2 --mode photon --photons 1000", "--spp 2 --mode photon --photons 1000 --direct photons"},
    {"final-gather", "--spp 2 --mode photon --photons 1000", "--spp 2 --mode photon --photons 1000 --final-gather 1"},
    {"caustic-photons", "--spp 2 --mode photon --photons 1000",
     "--spp 2 --mode photon --photons 1000 --caustic-photons 2000"},
    {"caustic-k", "--spp 2 --mode photon --photons 1000 --caustic-photons 5000",
     "--spp 2 --mode photon --photons 1000 --caustic-photons 5000 --caustic-k 9"},
    {"caustic-radius", "--spp 2 --mode photon --photons 1000 --caustic-photons 5000",
     "--spp 2 --mode photon --photons 1000 --caustic-photons 5000 --caustic-radius 0.05"},
    {"caustic-kernel", "--spp 2 --mode photon --photons 1000 --caustic-photons 5000",
     "--spp 2 --mode photon --photons 1000 --caustic-photons 5000 --caustic-kernel box"},
};

static void options_change_the_picture(void **state)
{
    (void)state;
    write_scene();
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        char a[32], b[32], file_a[40], file_b[40];
        snprintf(a, sizeof a, "%s-a", pairs[i].option);
        snprintf(b, sizeof b, "%s-b", pairs[i].option);
        snprintf(file_a, sizeof file_a, "%s.pfm", a);
        snprintf(file_b, sizeof file_b, "%s.pfm", b);
        render_and_forget(a, pairs[i].a);
        render_and_forget(b, pairs[i].b);
        expect_different_files(file_a, file_b);
    }
}

static void density_kernels_all_differ(void **state)
{
    (void)state;
    static const char *const kernels[] = {"box", "cone", "gaussian", "epanechnikov", "silverman", "gaussian-jensen"};
    enum { COUNT = sizeof kernels / sizeof kernels[0] };
    write_scene();
    for (int i = 0; i < COUNT; i++) {
        char options[128], a[64], b[64];
        snprintf(options, sizeof options, "--spp 1 --mode photon --photons 2000 --kernel %s", kernels[i]);
        render_and_forget(kernels[i], options);
        snprintf(a, sizeof a, "%s.pfm", kernels[i]);
        for (int j = 0; j < i; j++) {
            snprintf(b, sizeof b, "%s.pfm", kernels[j]);
            expect_different_files(a, b);
        }
    }
    /* It returns 53 % of the density. */
    assert_true(image_mean("gaussian-jensen.pfm") < image_mean("gaussian.pfm"));
}

static void size_is_what_is_asked(void **state)
{
    (void)state;
    write_scene();
    render_and_forget("size", "--spp 1 --width 31 --height 7");
    rt_image *image = read_image("size.pfm");
    assert_int_equal(image->width, 31);
    assert_int_equal(image->height, 7);
    rt_image_destroy(image);
}

static void options_of_the_scene_hold_where_the_line_is_silent(void **state)
{
    (void)state;
    char text[2000];
    snprintf(text, sizeof text, "%srender { spp 3  seed 5  mode photon  photons 1234 }\n", scene);
    scratch_write("a.rts", text);
    run both = render("both", "");
    run over = render("over", "--spp 2 --mode path");
    assert_true(stats_number(&both, "samples a pixel") == 3.0);
    assert_true(stats_number(&both, "photon paths emitted") == 1234.0);
    assert_true(stats_number(&over, "samples a pixel") == 2.0);
    expect_out(&over, "mode: path\n");
    run_free(&both);
    run_free(&over);
}

static void time_ends_a_render(void **state)
{
    (void)state;
    write_scene();
    time_t start = time(NULL);
    run run = render("time", "--spp 16000000 --time 0.5");
    assert_true(time(NULL) - start < 60);
    double spp = stats_number(&run, "samples a pixel");
    assert_true(spp >= 1.0 && spp < 16000000.0);
    expect_file("time.pfm");
    run_free(&run);
}

static void photons_are_counted(void **state)
{
    (void)state;
    write_scene();
    run run = render("photons", "--spp 1 --mode photon --photons 2e3");
    assert_true(stats_number(&run, "photon paths emitted") == 2000.0);
    assert_true(stats_number(&run, "photons stored") > 100.0);
    assert_true(stats_number(&run, "gathers") > 0.0);
    run_free(&run);
}

/* Without the tree the same hits are found; only rounding may differ. */
static void accel_none_gives_the_same_picture(void **state)
{
    (void)state;
    write_scene();
    render_and_forget("bvh", "--spp 8 --accel bvh");
    render_and_forget("none", "--spp 8 --accel none");
    rt_image *a = read_image("bvh.pfm"), *b = read_image("none.pfm");
    size_t count = (size_t)a->width * a->height * a->channel_count, differ = 0;
    for (size_t i = 0; i < count; i++) {
        double difference = (double)a->data[i] - (double)b->data[i];
        differ += difference * difference > 1e-6 * (double)a->data[i] * (double)a->data[i];
    }
    assert_true(differ <= count / 100);
    rt_image_destroy(a);
    rt_image_destroy(b);
}

/* ---- Outputs ------------------------------------------------------------------ */

static void without_out_the_files_are_named_after_the_scene(void **state)
{
    (void)state;
    assert_int_equal(mkdir("sub", 0777), 0);
    scratch_write("sub/b.rts", scene);
    run run = run_rtc("sub/b.rts --spp 1");
    unlink("sub/b.rts");
    expect_status(&run, 0);
    expect_file("b.png");
    expect_file("b.exr");
    expect_err(&run, "wrote b.png and b.exr: 24 x 16, 1 sample a pixel");
    assert_string_equal(run.out, "");
    run_free(&run);
}

static void out_may_be_repeated_in_every_format(void **state)
{
    (void)state;
    write_scene();
    run run = run_rtc("a.rts --spp 1 --out a.exr --out a.pfm --out A.PNG --out a.ppm");
    expect_status(&run, 0);
    expect_file("a.exr");
    expect_file("a.pfm");
    expect_file("A.PNG");
    expect_file("a.ppm");
    expect_no_file("a.png");
    assert_true(image_mean("a.exr") == image_mean("a.pfm"));
    run_free(&run);
}

static void exposure_and_tonemap_change_8_bit_files_only(void **state)
{
    (void)state;
    static const char *const options[] = {"--exposure 0", "--exposure 1.5", "--tonemap reinhard", "--tonemap aces"};
    write_scene();
    for (int i = 0; i < 4; i++) {
        run run = run_rtc("a.rts --spp 1 --quiet %s --out %d.ppm --out %d.pfm", options[i], i, i);
        expect_status(&run, 0);
        run_free(&run);
        for (int j = 0; j < i; j++) {
            char a[16], b[16];
            snprintf(a, sizeof a, "%d.ppm", i);
            snprintf(b, sizeof b, "%d.ppm", j);
            expect_different_files(a, b);
        }
    }
    expect_same_files("0.pfm", "1.pfm");
    expect_same_files("0.pfm", "3.pfm");
}

static void exr_tells_where_it_came_from(void **state)
{
    (void)state;
    write_scene();
    run run = run_rtc("a.rts --spp 1 --seed 9 --threads 1 --quiet --out a.exr");
    expect_status(&run, 0);
    rt_image *image = read_image("a.exr");
    int found = 0;
    for (size_t i = 0; i < image->attribute_count; i++)
        found |= strcmp(image->attributes[i].value, "rtc a.rts --spp 1 --seed 9") == 0;
    assert_true(found);
    rt_image_destroy(image);
    run_free(&run);
}

static void output_that_cannot_be_written_is_status_4_before_rendering(void **state)
{
    (void)state;
    write_scene();
    assert_int_equal(mkdir("dir.png", 0777), 0);
    static const char *const names[] = {"nowhere/a.png", "dir.png", "a.rts/b.png", "/proc/a.png"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        run run = run_rtc("a.rts --spp 16000000 --out %s", names[i]);
        expect_status(&run, 4);
        expect_err(&run, names[i]);
        run_free(&run);
    }
    /* The place is tried out, and nothing is left there. */
    assert_int_equal(scratch_count(), 2);
}

static void full_disk_is_status_4(void **state)
{
    (void)state;
    write_scene();
    assert_int_equal(symlink("/dev/full", "full.png"), 0);
    run run = run_rtc("a.rts --spp 1 --out full.png --out a.pfm");
    expect_status(&run, 4);
    expect_err(&run, "full.png");
    expect_file("a.pfm");
    run_free(&run);
}

static void scene_comes_from_stdin_too(void **state)
{
    (void)state;
    run run = run_rtc_input(scene, strlen(scene), "- --spp 1 --quiet");
    expect_status(&run, 0);
    assert_string_equal(run.err, "");
    expect_file("stdin.png");
    expect_file("stdin.exr");
    run_free(&run);
}

/* ---- What is said --------------------------------------------------------------- */

static void idle_options_are_warned_of(void **state)
{
    (void)state;
    write_scene();
    run run = run_rtc("a.rts --spp 1 --k 5 --exposure 1 --out a.pfm");
    expect_status(&run, 0);
    expect_err(&run, "warning: --k has no effect in path mode");
    expect_err(&run, "warning: --exposure and --tonemap have no effect");
    run_free(&run);

    run = run_rtc("a.rts --spp 1 --mode photon --photons 1000 --cone-k 2 --out a.pfm");
    expect_err(&run, "warning: --cone-k has no effect without --kernel cone");
    run_free(&run);
}

static void quiet_says_nothing(void **state)
{
    (void)state;
    write_scene();
    run run = run_rtc("a.rts --spp 1 --quiet --k 5 --out a.pfm");
    expect_status(&run, 0);
    assert_string_equal(run.err, "");
    assert_string_equal(run.out, "");
    run_free(&run);
}

static void verbose_names_the_device_and_its_threads(void **state)
{
    (void)state;
    write_scene();
    run run = run_rtc("a.rts --spp 1 --threads 1 --verbose --out a.pfm");
    expect_status(&run, 0);
    expect_err(&run, "device ");
    expect_err(&run, ", 1 compute unit\n");
    run_free(&run);
}

static void plain_progress_names_the_stages(void **state)
{
    (void)state;
    write_scene();
    run run = run_rtc("a.rts --spp 1 --mode photon --photons 1000 --out a.pfm");
    expect_status(&run, 0);
    static const char *const stages[] = {"build   100 %", "compile 100 %", "emit    100 %", "gather  100 %"};
    for (size_t i = 0; i < sizeof stages / sizeof stages[0]; i++)
        expect_err(&run, stages[i]);
    expect_no_err(&run, "\r");
    expect_no_err(&run, "\033");
    run_free(&run);
}

static void json_progress_is_one_object_a_line(void **state)
{
    (void)state;
    write_scene();
    run run = run_rtc("a.rts --spp 1 --progress json --quiet --out a.pfm");
    expect_status(&run, 0);
    int lines = 0;
    for (char *line = strtok(run.err, "\n"); line; line = strtok(NULL, "\n"), lines++) {
        char stage[16], remaining[32];
        double fraction, elapsed;
        assert_int_equal(sscanf(line, "{\"stage\":\"%15[a-z]\",\"fraction\":%lf,\"elapsed\":%lf,\"remaining\":%31[^}]}",
                                stage, &fraction, &elapsed, remaining),
                         4);
        assert_true(fraction >= 0.0 && fraction <= 1.0 && elapsed >= 0.0);
        assert_int_equal(line[strlen(line) - 1], '}');
    }
    /* The beginning and the end of three stages. */
    assert_true(lines >= 6);
    run_free(&run);
}

/* With an empty cache of the driver, the build takes seconds. */
static void first_compile_keeps_reporting(void **state)
{
    (void)state;
    char cache[64];
    snprintf(cache, sizeof cache, "/tmp/rtc-cache-%ld", (long)getpid());
    write_scene();
    assert_int_equal(mkdir(cache, 0777), 0);
    run run =
        run_rtc("POCL_CACHE_DIR=%s rtc a.rts --spp 1 --mode photon --photons 1000 --progress json --out a.pfm", cache);
    char remove[96];
    snprintf(remove, sizeof remove, "rm -rf %s", cache);
    assert_int_equal(system(remove), 0);
    expect_status(&run, 0);
    double last = 0.0, elapsed;
    int reports = 0;
    for (char *at = run.err; (at = strstr(at, "{\"stage\":\"compile\"")); at++, reports++) {
        assert_int_equal(sscanf(strstr(at, "elapsed"), "elapsed\":%lf", &elapsed), 1);
        assert_true(elapsed - last < 1.5);
        last = elapsed;
    }
    /* On another driver, or a fast machine, there is little to tell. */
    assert_true(reports >= 2);
    run_free(&run);
}

static void no_progress_when_none_is_asked(void **state)
{
    (void)state;
    write_scene();
    run run = run_rtc("a.rts --spp 1 --progress none --out a.pfm");
    expect_status(&run, 0);
    expect_no_err(&run, "%");
    expect_err(&run, "wrote a.pfm");
    run_free(&run);
}

static void terminal_gets_a_redrawn_line_and_colours(void **state)
{
    (void)state;
    write_scene();
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
    write_scene();
    running running = start_rtc("a.rts --spp 20 --progress json --out a.pfm");
    assert_int_equal(running_wait_for(&running, "fraction", said, sizeof said), 0);
    assert_int_equal(running_abandon(&running), 0);
    expect_file("a.pfm");
}

/* ---- Interruption ----------------------------------------------------------------- */

/* Starts a render that would last for hours, sends a signal once it renders, and looks at what is left. */
static void interrupt_render(int signal_number, const char *options, const char *stage)
{
    static char said[1 << 20];
    write_scene();
    said[0] = '\0';
    running running = start_rtc("a.rts --spp 16000000 %s --progress json --out a.pfm", options);
    assert_int_equal(running_wait_for(&running, stage, said, sizeof said), 0);
    /* Let it draw a few samples. */
    const struct timespec nap = {0, 500000000};
    nanosleep(&nap, NULL);
    assert_int_equal(kill(running.pid, signal_number), 0);
    assert_int_equal(running_finish(&running, said, sizeof said), 130);
    assert_non_null(strstr(said, "interrupted; wrote a.pfm: 24 x 16, "));
    assert_true(image_mean("a.pfm") > 0.0);
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

static void interrupted_photon_render_writes_its_samples(void **state)
{
    (void)state;
    interrupt_render(SIGINT, "--mode photon --photons 1000", "\"gather\"");
}

static void second_interrupt_kills(void **state)
{
    (void)state;
    static char said[1 << 20];
    write_scene();
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

#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_enter, scratch_leave)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(options_change_the_picture),
        TEST(density_kernels_all_differ),
        TEST(size_is_what_is_asked),
        TEST(options_of_the_scene_hold_where_the_line_is_silent),
        TEST(time_ends_a_render),
        TEST(photons_are_counted),
        TEST(accel_none_gives_the_same_picture),
        TEST(without_out_the_files_are_named_after_the_scene),
        TEST(out_may_be_repeated_in_every_format),
        TEST(exposure_and_tonemap_change_8_bit_files_only),
        TEST(exr_tells_where_it_came_from),
        TEST(output_that_cannot_be_written_is_status_4_before_rendering),
        TEST(full_disk_is_status_4),
        TEST(scene_comes_from_stdin_too),
        TEST(idle_options_are_warned_of),
        TEST(quiet_says_nothing),
        TEST(verbose_names_the_device_and_its_threads),
        TEST(plain_progress_names_the_stages),
        TEST(json_progress_is_one_object_a_line),
        TEST(first_compile_keeps_reporting),
        TEST(no_progress_when_none_is_asked),
        TEST(terminal_gets_a_redrawn_line_and_colours),
        TEST(closed_stderr_does_not_end_a_render),
        TEST(interrupted_path_render_writes_its_samples),
        TEST(terminated_path_render_writes_its_samples),
        TEST(interrupted_photon_render_writes_its_samples),
        TEST(second_interrupt_kills),
    };
    return spawn_find_rtc() == 0 ? cmocka_run_group_tests(tests, NULL, NULL) : 1;
}
