/* test_rtc.c - rendering by the command: the effect of each option, and its files. */
#include <math.h>
#include <setjmp.h>
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
#include "small_scene.h"
#include "spawn.h"

static char top[4096]; /* the folder of the sources */

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
    {"mode", "--spp 2", "--spp 2 --mode direct"},
    {"variance", "--spp 40", "--spp 40 --variance"},
    {"target-error", "--spp 40 --variance", "--spp 40 --target-error 1"},
    {"mode", "--spp 2 --mode normals", "--spp 2 --mode albedo"},
    {"mode", "--spp 2 --mode normals", "--spp 2 --mode depth"},
    {"filter", "--spp 2", "--spp 2 --filter mitchell"},
    {"roulette-depth", "--spp 2", "--spp 2 --roulette-depth 9"},
    {"roulette-threshold", "--spp 2", "--spp 2 --roulette-threshold 1"},
    {"estimator", "--spp 2", "--spp 2 --estimator light"},
    {"estimator", "--spp 2", "--spp 2 --estimator bsdf"},
    {"spp", "--spp 2", "--spp 3"},
    {"max-depth", "--spp 2", "--spp 2 --max-depth 2"},
    {"seed", "--spp 2", "--spp 2 --seed 7"},
    {"sampler", "--spp 2", "--spp 2 --sampler independent"},
    {"photons", "--spp 2 --mode photon --photons 1000", "--spp 2 --mode photon --photons 2000"},
    {"k", "--spp 2 --mode photon --photons 1000", "--spp 2 --mode photon --photons 1000 --k 7"},
    {"radius", "--spp 2 --mode photon --photons 1000",
     "--spp 2 --mode photon --photons 1000 --radius 0.05"},
    {"kernel", "--spp 2 --mode photon --photons 1000",
     "--spp 2 --mode photon --photons 1000 --kernel box"},
    {"cone-k", "--spp 2 --mode photon --photons 1000 --kernel cone",
     "--spp 2 --mode photon --photons 1000 --kernel cone --cone-k 2"},
    {"direct", "--spp 2 --mode photon --photons 1000",
     "--spp 2 --mode photon --photons 1000 --direct photons"},
    {"final-gather", "--spp 2 --mode photon --photons 1000",
     "--spp 2 --mode photon --photons 1000 --final-gather 1"},
    {"caustic-photons", "--spp 2 --mode photon --photons 1000",
     "--spp 2 --mode photon --photons 1000 --caustic-photons 2000"},
    {"caustic-k", "--spp 2 --mode photon --photons 1000 --caustic-photons 5000",
     "--spp 2 --mode photon --photons 1000 --caustic-photons 5000 --caustic-k 9"},
    {"caustic-radius", "--spp 2 --mode photon --photons 1000 --caustic-photons 5000",
     "--spp 2 --mode photon --photons 1000 --caustic-photons 5000 --caustic-radius 0.05"},
    {"caustic-kernel", "--spp 2 --mode photon --photons 1000 --caustic-photons 5000",
     "--spp 2 --mode photon --photons 1000 --caustic-photons 5000 --caustic-kernel box"},
};

/* Renders with these options unless an earlier pair did; returns the number of the picture. */
static size_t render_once(const char *options)
{
    static const char *rendered[2 * sizeof pairs / sizeof pairs[0]];
    size_t i = 0;
    char name[16];
    while (rendered[i] && strcmp(rendered[i], options) != 0)
        i++;
    if (!rendered[i]) {
        snprintf(name, sizeof name, "%zu", i);
        render_and_forget(name, options);
        rendered[i] = options;
    }
    return i;
}

static void options_change_the_picture(void **state)
{
    (void)state;
    scratch_write("a.rts", small_scene);
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        char a[16], b[16];
        snprintf(a, sizeof a, "%zu.pfm", render_once(pairs[i].a));
        snprintf(b, sizeof b, "%zu.pfm", render_once(pairs[i].b));
        print_message("%s: %s and %s\n", pairs[i].option, a, b);
        expect_different_files(a, b);
    }
}

static void density_kernels_all_differ(void **state)
{
    (void)state;
    static const char *const kernels[] = {"box",          "cone",      "gaussian",
                                          "epanechnikov", "silverman", "gaussian-jensen"};
    enum { COUNT = sizeof kernels / sizeof kernels[0] };
    scratch_write("a.rts", small_scene);
    for (int i = 0; i < COUNT; i++) {
        char options[128], a[64], b[64];
        snprintf(options, sizeof options, "--spp 1 --mode photon --photons 2000 --kernel %s",
                 kernels[i]);
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
    scratch_write("a.rts", small_scene);
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
    snprintf(text, sizeof text, "%srender { spp 3  seed 5  mode photon  photons 1234 }\n",
             small_scene);
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
    scratch_write("a.rts", small_scene);
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
    scratch_write("a.rts", small_scene);
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
    scratch_write("a.rts", small_scene);
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
    scratch_write("sub/b.rts", small_scene);
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
    scratch_write("a.rts", small_scene);
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
    static const char *const options[] = {"--exposure 0", "--exposure 1.5", "--tonemap reinhard",
                                          "--tonemap aces"};
    scratch_write("a.rts", small_scene);
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
    scratch_write("a.rts", small_scene);
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

static void aov_adds_layers_to_exr(void **state)
{
    static const char *const names[] = {"R", "albedo.G", "normal.X", "depth.Z"};
    (void)state;
    scratch_write("a.rts", small_scene);
    for (int aov = 0; aov < 2; aov++) {
        run run = run_rtc("a.rts --quiet --spp 1 %s --out a.exr", aov ? "--aov" : "");
        expect_status(&run, 0);
        run_free(&run);
        rt_image *image = read_image("a.exr");
        for (int i = 0; i < 4; i++)
            assert_int_equal(rt_image_channel(image, names[i]) != RT_IMAGE_NO_CHANNEL,
                             i == 0 || aov);
        rt_image_destroy(image);
    }
}

static void variance_is_a_layer_and_the_error_is_said(void **state)
{
    (void)state;
    scratch_write("a.rts", small_scene);
    run run = run_rtc("a.rts --spp 32 --variance --stats --out a.exr");
    expect_status(&run, 0);
    double said = stats_number(&run, "relative error"),
           bound = stats_number(&run, "relative error, 95 % bound");
    assert_true(said > 0 && bound > said && bound < 10 * said);
    assert_true(stats_number(&run, "independent sequences") == 8);
    expect_err(&run, "\nrelative error ");
    run_free(&run);

    /* What is said follows from the layer. */
    rt_image *image = read_image("a.exr");
    static const char *const names[] = {"R", "G", "B", "variance.R", "variance.G", "variance.B"};
    double sums[6];
    for (int c = 0; c < 6; c++) {
        uint32_t channel = rt_image_channel(image, names[c]);
        assert_true(channel != RT_IMAGE_NO_CHANNEL);
        sums[c] = 0;
        for (size_t i = 0; i < (size_t)image->width * image->height; i++)
            sums[c] += image->data[i * image->channel_count + channel];
    }
    double pixels = (double)image->width * image->height * 3,
           mean = (sums[0] + sums[1] + sums[2]) / pixels;
    assert_float_equal(sqrt((sums[3] + sums[4] + sums[5]) / pixels) / mean, said, 1e-4 * said);
    assert_string_equal(rt_image_attribute_value(image, "librt.replicates"), "8");
    assert_string_equal(rt_image_attribute_value(image, "librt.command"),
                        "rtc a.rts --spp 32 --variance");
    rt_image_destroy(image);
}

/* Words of a shell, without its quotes. */
static void unquote(char *text)
{
    char *out = text;
    for (; *text; text++)
        if (text[0] == '\\')
            *out++ = *++text;
        else if (text[0] != '\'')
            *out++ = text[0];
    *out = '\0';
}

/* A line without `rtc`, and a part of what is recorded. */
static const struct {
    const char *line, *recorded;
} recorded[] = {
    {"it's.rts --spp 3 --aov --accel none --set grey=0.3",
     "rtc 'it'\\''s.rts' --spp 3 --aov --set 'grey=0.3' --accel none"},
    {"it's.rts --spp 2 --mode photon --photons 1000 --photon-layers --no-variance",
     " --photon-layers"},
    {"it's.rts --spp 16000000 --time 0.2", " --spp "},
    {"it's.rts --mode photon --passes 16000000 --photons 100 --spp 2 --time 0.3 --seed 4",
     " --radius-rule mse"},
    {"it's.rts --mode vcm --spp 16000000 --time 0.2", " --mode vcm"},
};

static void a_recorded_command_makes_the_picture_again(void **state)
{
    (void)state;
    scratch_write("it's.rts",
                  "let grey = 0.5\nfilm { width 12  height 8 }\nmaterial g { kd grey }\n"
                  "camera { eye 0 1 4  look_at 0 0.5 0 }\n"
                  "sphere { centre 0 0.5 0  radius 0.5  material g }\n"
                  "plane { point 0 0 0  normal 0 1 0  material g }\n"
                  "light point { position 1 2 1  intensity 4 }\n");
    for (size_t i = 0; i < sizeof recorded / sizeof *recorded; i++) {
        run run = run_rtc("%s --quiet --out a.exr", recorded[i].line);
        expect_status(&run, 0);
        run_free(&run);
        rt_image *image = read_image("a.exr");
        const char *const command = rt_image_attribute_value(image, "librt.command");
        if (!strstr(command, recorded[i].recorded) || strstr(command, "--time") ||
            strstr(command, "16000000"))
            fail_msg("'%s' of '%s'", command, recorded[i].line);
        char *const words = strdup(command);
        unquote(words);
        run = run_rtc("%s --quiet --out b.exr", words + strlen("rtc "));
        expect_status(&run, 0);
        run_free(&run);
        expect_same_files("a.exr", "b.exr");
        free(words);
        rt_image_destroy(image);
    }
}

static void a_render_ends_at_the_target_error(void **state)
{
    (void)state;
    scratch_write("a.rts", small_scene);
    run run = run_rtc("a.rts --mode direct --target-error 0.1 --stats --out a.pfm");
    expect_status(&run, 0);
    assert_true(stats_number(&run, "relative error, 95 % bound") <= 0.1);
    expect_no_err(&run, "warning");
    run_free(&run);

    run = run_rtc("a.rts --target-error 1e-9 --spp 20 --out a.pfm");
    expect_status(&run, 0);
    expect_err(&run, "warning: the target error of 1e-07 % was not reached");
    run_free(&run);

    run = run_rtc(
        "a.rts --mode photon --passes 40 --photons 20000 --target-error 1 --stats --out a.pfm");
    expect_status(&run, 0);
    assert_true(stats_number(&run, "passes") == 32);
    expect_err(&run, "of the noise alone, not of the bias");
    run_free(&run);

    run = run_rtc("a.rts --mode photon --passes 2 --photons 1000 --target-error 1 --out a.pfm");
    expect_status(&run, 0);
    expect_err(&run, " %, without a bound, which takes 8 passes (");
    expect_err(&run, "warning: the target error of 100 % was not reached");
    run_free(&run);

    run = run_rtc("a.rts --mode photon --photons 1000 --target-error 0.1 --out a.pfm");
    expect_status(&run, 2);
    expect_err(&run, "--target-error: the samples of one photon map share its photons");
    run_free(&run);
}

/* The light is so near and so bright that some samples are beyond float32. */
/* One of these light paths begins along the light, where its density is 0. */
static void mode_vcm_has_finite_samples(void **state)
{
    (void)state;
    run run = run_rtc("%s/scenes/cornell.rts --mode vcm --techniques bpm --max-depth 3 --width 96 "
                      "--height 72 --spp 128 --variance --stats --out a.pfm",
                      top);
    expect_status(&run, 0);
    assert_true(stats_number(&run, "samples rejected") == 0);
    run_free(&run);
}

static void samples_that_are_not_finite_are_shown(void **state)
{
    (void)state;
    scratch_write(
        "a.rts",
        "camera { projection orthographic  eye 0 1 0  look_at 0 0 0  up 0 0 1  width 1e-4 }\n"
        "film { width 8  height 8 }\n"
        "material white { kd 0.7 }\n"
        "quad { corner -1 0 -1  edge1 0 0 2  edge2 2 0 0  material white }\n"
        "light point { position 0 1e-6 0  intensity 1e28 }\n");
    run run = run_rtc("a.rts --spp 64 --variance --stats --out a.pfm");
    expect_status(&run, 0);
    assert_true(stats_number(&run, "samples rejected") > 0);
    assert_true(isfinite(stats_number(&run, "relative error")));
    expect_err(&run, "samples left out because they were not finite: ");
    assert_true(isfinite(image_mean("a.pfm")));
    run_free(&run);
}

static void light_that_max_depth_cuts_off_is_told(void **state)
{
    static const char *const modes[] = {"path", "photon --photons 1000"};
    (void)state;
    scratch_write("a.rts", small_scene);
    scratch_write("b.rts", "camera { eye 0 0 0  look_at 0 0 1 }\n"
                           "film { width 16  height 16 }\n"
                           "material mirror { ks 0.95 }\n"
                           "sphere { centre 0 0 0  radius 1  material mirror }\n"
                           "light spot { position 0 0 0  target 0 0 1  intensity 1 }\n");
    for (size_t i = 0; i < sizeof modes / sizeof modes[0]; i++) {
        run loud = run_rtc("b.rts --mode %s --max-depth 4 --out a.pfm", modes[i]);
        run deep = run_rtc("b.rts --mode %s --max-depth 256 --out a.pfm", modes[i]);
        run quiet = run_rtc("b.rts --mode %s --max-depth 4 --quiet --stats --out a.pfm", modes[i]);
        expect_err(&loud, "warning: max_depth 4 cuts off ");
        expect_no_err(&deep, "cuts off");
        assert_string_equal(quiet.err, "");
        assert_float_equal(stats_number(&quiet, "throughput cut off"), 100 * pow(0.95, 4), 0.1);
        run_free(&loud);
        run_free(&deep);
        run_free(&quiet);
    }
}

static void output_that_cannot_be_written_is_status_4_before_rendering(void **state)
{
    (void)state;
    scratch_write("a.rts", small_scene);
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
    scratch_write("a.rts", small_scene);
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
    run run = run_rtc_input(small_scene, strlen(small_scene), "- --spp 1 --quiet");
    expect_status(&run, 0);
    assert_string_equal(run.err, "");
    expect_file("stdin.png");
    expect_file("stdin.exr");
    run_free(&run);
    /* Under the same name everywhere. */
    static const char *const lines[] = {"check -", "- --spp 1 --quiet --out a.rtpart",
                                        "info a.rtpart", "info a.rtpart --json"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        run = run_rtc_input(small_scene, strlen(small_scene), lines[i]);
        expect_status(&run, 0);
        if (i != 1)
            expect_out(&run, "stdin");
        run_free(&run);
    }
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
        TEST(aov_adds_layers_to_exr),
        TEST(variance_is_a_layer_and_the_error_is_said),
        TEST(a_recorded_command_makes_the_picture_again),
        TEST(a_render_ends_at_the_target_error),
        TEST(mode_vcm_has_finite_samples),
        TEST(samples_that_are_not_finite_are_shown),
        TEST(light_that_max_depth_cuts_off_is_told),
        TEST(output_that_cannot_be_written_is_status_4_before_rendering),
        TEST(full_disk_is_status_4),
        TEST(scene_comes_from_stdin_too),
    };
    if (spawn_find_rtc() != 0 || !getcwd(top, sizeof top))
        return 1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
