/* test_compare.c - `rtc compare`: its results, its limits and what it refuses. */
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
#include "image/image.h"
#include "lib/image/scratch.h"
#include "spawn.h"

enum { SIDE = 16, VALUES = 3 * SIDE * SIDE };

/* Writes a picture of one value; one value of it is another. */
static void write_picture(const char *name, float value, float other)
{
    float rgb[VALUES];
    rt_image *image = NULL;
    for (int i = 0; i < VALUES; i++)
        rgb[i] = i == 0 ? other : value;
    assert_int_equal(rt_image_from_rgb(&image, rgb, SIDE, SIDE, NULL), RT_OK);
    assert_int_equal(rt_image_write(image, name, NULL, NULL), RT_OK);
    rt_image_destroy(image);
}

/* Enters a scratch directory with the pictures a, of 0.75, and b, of 0.5. */
static int enter(void **state)
{
    int failed = scratch_enter(state);
    if (failed)
        return failed;
    write_picture("a.exr", 0.75f, 0.75f);
    write_picture("b.pfm", 0.5f, 0.5f);
    return 0;
}

/* ---- Results --------------------------------------------------------------------- */

static void results_are_lines_on_stdout(void **state)
{
    (void)state;
    run run = run_rtc("compare a.exr b.pfm");
    expect_status(&run, 0);
    expect_out(&run, "size: 16x16\n");
    assert_true(stats_number(&run, "mse") == 0.0625);
    assert_true(stats_number(&run, "rmse") == 0.25);
    assert_true(stats_number(&run, "relmse") == 0.240385);
    assert_true(stats_number(&run, "ratio") == 1.5);
    assert_true(stats_number(&run, "blocks off") == 1);
    expect_out(
        &run,
        "worst block: at 0 0, channel R, 0.75 for 0.5, ratio 1.5 +- 0, 50 of what is allowed\n");
    assert_string_equal(run.err, "");
    run_free(&run);
}

static void results_are_json_when_asked(void **state)
{
    (void)state;
    run run = run_rtc("compare a.exr b.pfm --json --max-rmse 0.2 --max-off=1");
    expect_status(&run, 1);
    assert_memory_equal(
        run.out, "{\"images\":[\"a.exr\"],\"reference\":\"b.pfm\",\"layer\":null,\"width\":16,",
        61);
    expect_out(&run, ",\"mse\":0.0625,\"rmse\":0.25,");
    expect_out(&run, ",\"ratio\":1.5,\"ratio_error\":0,\"shares_photons\":[false,false],\"ratio_"
                     "rgb\":[1.5,1.5,1.5],");
    expect_out(
        &run,
        ",\"limits\":[{\"option\":\"max-rmse\",\"limit\":0.2,\"measured\":0.25,\"kept\":false},"
        "{\"option\":\"max-off\",\"limit\":1,\"measured\":1,\"kept\":true}],\"within\":false}\n");
    run_free(&run);
    /* A number that JSON cannot hold, and a name that needs its escapes. */
    write_picture("\"b\\\n.pfm", 0.0f, 0.0f);
    write_picture("c.pfm", 0.0f, 0.0f);
    run = run_rtc("compare c.pfm \"b\\\n.pfm --json --blocks");
    expect_status(&run, 0);
    expect_out(&run, "\"reference\":\"\\\"b\\\\\\u000a.pfm\"");
    expect_out(&run, "\"ratio\":null");
    expect_out(&run,
               "\"block_list\":[{\"x\":0,\"y\":0,\"width\":16,\"height\":16,\"mean\":[0,0,0],");
    run_free(&run);
}

static void blocks_are_listed_when_asked(void **state)
{
    (void)state;
    run run = run_rtc("compare a.exr b.pfm --block 8 --blocks");
    expect_status(&run, 0);
    assert_true(stats_number(&run, "blocks") == 4);
    expect_out(&run, "\n8 8  1.5 0 50  1.5 0 50  1.5 0 50\n");
    run_free(&run);
}

/*
 * A block of one pixel has no scatter within it, so that one render does not tell its noise; two
 * do.
 */
static void noise_that_is_not_known_is_called_so(void **state)
{
    (void)state;
    write_picture("c.exr", 0.25f, 0.25f);
    run text = run_rtc("compare a.exr b.pfm --block 1 --blocks");
    run json = run_rtc("compare a.exr b.pfm --block 1 --json");
    run two = run_rtc("compare a.exr c.exr b.pfm --block 1");
    expect_out(&text, "\nratio: 1.5 +- unknown\n");
    expect_out(&text, "channel R, 0.75 for 0.5, ratio 1.5 +- unknown, 50 of what is allowed\n");
    expect_out(&text, "\n15 15  1.5 unknown 50  1.5 unknown 50  1.5 unknown 50\n");
    expect_out(&json, "\"ratio_error\":null,");
    expect_out(&json, "\"error\":[null,null,null]");
    /* The mean of 0.75 and 0.25 has a standard error of 0.25 in each pixel, of 0.25 / 16 in all. */
    expect_out(&two, "\nratio: 1 +- 0.031\n");
    run_free(&text);
    run_free(&json);
    run_free(&two);
}

/* A photon render says in its file what it is; its noise is not in the scatter of its pixels. */
static void photon_renders_by_themselves_are_warned_of(void **state)
{
    (void)state;
    scratch_write("a.rts", "camera { eye 0 0 -4  look_at 0 0 0 }\n"
                           "film { width 16  height 16 }\n"
                           "material white { kd 0.7 }\n"
                           "sphere { centre 0 0 0  radius 1  material white }\n"
                           "light point { position 2 4 -3  intensity 20 }\n");
    run made[] = {
        run_rtc("a.rts --spp 1 --quiet --out path.exr"),
        run_rtc("a.rts --spp 1 --mode photon --photons 100 --quiet --aov --out 1.exr --out 1.pfm"),
        run_rtc("a.rts --spp 1 --mode photon --photons 100 --seed 1 --quiet --out 2.exr")};
    run one = run_rtc("compare 1.exr path.exr --json"),
        two = run_rtc("compare 1.exr 2.exr path.exr --json");
    run reference = run_rtc("compare path.exr 1.exr"), other = run_rtc("compare 1.pfm path.exr");
    run layer = run_rtc("compare 1.exr 1.exr --layer albedo");
    expect_err(&one, "warning: 1.exr: the noise of one photon render is understated");
    expect_out(&one, "\"shares_photons\":[true,false]");
    assert_string_equal(two.err, "");
    expect_out(&two, "\"shares_photons\":[false,false]");
    expect_err(&reference,
               "warning: 1.exr: the noise of a reference of photon mode is understated");
    assert_string_equal(other.err, "");
    assert_string_equal(layer.err, "");
    for (int i = 0; i < 3; i++)
        run_free(&made[i]);
    run_free(&one);
    run_free(&two);
    run_free(&reference);
    run_free(&other);
    run_free(&layer);
}

static void renders_compare_as_their_mean(void **state)
{
    (void)state;
    write_picture("c.exr", 0.25f, 0.25f);
    run run = run_rtc("compare a.exr c.exr b.pfm");
    expect_status(&run, 0);
    assert_true(stats_number(&run, "mse") == 0.0);
    run_free(&run);
}

static void formats_of_one_render_are_equal(void **state)
{
    (void)state;
    scratch_write("a.rts", "camera { eye 0 0 -4  look_at 0 0 0 }\n"
                           "film { width 32  height 32 }\n"
                           "material white { kd 0.7 }\n"
                           "sphere { centre 0 0 0  radius 1  material white }\n"
                           "light point { position 2 4 -3  intensity 20 }\n");
    run render =
        run_rtc("a.rts --spp 4 --aov --quiet --out r.exr --out r.pfm --out r.png --out r.ppm");
    expect_status(&render, 0);
    run_free(&render);
    static const char *const lines[] = {
        "r.exr r.pfm --max-mse 0 --max-off 0 --min-ssim 1",
        "r.png r.ppm --max-mse 0 --max-off 0 --min-ssim 1",
        /* Half an 8-bit step, 0.5 / 255, times the slope of the sRGB curve, at most 2.3. */
        "r.png r.exr --max-rmse 0.0045 --min-ssim 0.99",
        "r.exr r.exr --layer albedo --max-mse 0",
        "r.exr r.exr --layer normal --max-mse 0",
        "r.exr r.exr --layer depth --max-mse 0",
        "r.exr r.exr --layer uv --max-mse 0",
    };
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        run run = run_rtc("compare %s", lines[i]);
        expect_status(&run, 0);
        assert_string_equal(run.err, "");
        run_free(&run);
    }
    run near = run_rtc("compare r.exr r.exr --layer abledo");
    expect_status(&near, 1);
    expect_err(&near, "r.exr has no layer 'abledo' (did you mean 'albedo'?)");
    run_free(&near);
    run differ = run_rtc("compare r.png r.exr --max-mse 0");
    expect_status(&differ, 1);
    run_free(&differ);
}

/* ---- Limits ---------------------------------------------------------------------- */

static void limits_decide_the_status(void **state)
{
    static const struct {
        const char *options;
        int status;
        const char *says;
    } cases[] = {
        {"--max-mse 0.0625", 0, ""},
        {"--max-mse 0.0624", 1, "mse 0.0625 is over --max-mse 0.0624\n"},
        {"--max-rmse 0.25", 0, ""},
        {"--max-rmse 0.2499", 1, "rmse 0.25 is over --max-rmse 0.2499\n"},
        {"--max-relmse 0.2404", 0, ""},
        {"--max-relmse 0.2403", 1, "relmse 0.240385 is over --max-relmse 0.2403\n"},
        {"--max-bias 0.5", 0, ""},
        {"--max-bias 0.49", 1, "bias 0.5 is over --max-bias 0.49\n"},
        {"--min-ssim 0.5", 0, ""},
        {"--min-ssim 0.99", 1, " is not at least --min-ssim 0.99\n"},
        {"--max-flip 0.36", 0, ""},
        {"--max-flip 0.35", 1, "flip 0.352532 is over --max-flip 0.35\n"},
        {"--max-flip 0 --min-ssim 1 --exposure 1", 0, ""},
        {"--max-off 1", 0, ""},
        {"--max-off 0", 1, "blocks off 1 is over --max-off 0\n"},
        {"--max-off 0 --tolerance 0.51", 0, ""},
        {"--max-mse 0.1 --max-bias 0.1", 1, "--max-bias"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        run run = run_rtc("compare a.exr b.pfm %s", cases[i].options);
        expect_status(&run, cases[i].status);
        expect_err(&run, cases[i].says);
        expect_no_err(&run, "error");
        expect_out(&run, "rmse: 0.25\n");
        if (cases[i].status == 0)
            assert_string_equal(run.err, "");
        run_free(&run);
    }
}

/* What cannot be measured keeps no limit, and the reason is told. */
static void limits_on_what_is_not_known_are_not_kept(void **state)
{
    (void)state;
    scratch_write("small.pfm", "PF\n2 1\n-1.0\n012345678901234567890123");
    write_picture("black.pfm", 0.0f, 0.0f);
    run small = run_rtc("compare small.pfm small.pfm --min-ssim 0.5");
    run black = run_rtc("compare a.exr black.pfm --max-bias 0.5");
    expect_status(&small, 1);
    expect_out(&small, "\nssim: unknown\n");
    assert_string_equal(
        small.err,
        "the pictures are too small for --min-ssim: 2x1 pixels, and its window has 11x11\n");
    expect_status(&black, 1);
    expect_out(&black, "\nratio: unknown +- unknown\nratio by channel: unknown unknown unknown\n");
    assert_string_equal(
        black.err, "bias is unknown, and not within --max-bias: the mean of the reference is 0\n");
    run_free(&small);
    run_free(&black);
}

static void pixels_that_are_not_finite_keep_no_limit(void **state)
{
    (void)state;
    write_picture("n.exr", 0.5f, NAN);
    write_picture("i.pfm", 0.5f, INFINITY);
    run plain = run_rtc("compare n.exr b.pfm");
    run limited = run_rtc("compare n.exr i.pfm --max-mse 0");
    expect_status(&plain, 0);
    expect_out(&plain, "not finite: 1 and 0\n");
    expect_out(&plain, "rmse: 0\n");
    expect_out(&plain, "blocks off: 1\n");
    expect_status(&limited, 1);
    expect_out(&limited, "not finite: 1 and 1\n");
    expect_err(&limited, "1 pixels, and 1 of the reference, are not finite: within no limit\n");
    run_free(&plain);
    run_free(&limited);
}

/* ---- The difference picture --------------------------------------------------------- */

static void differences_are_written(void **state)
{
    (void)state;
    run run = run_rtc("compare a.exr b.pfm --out d.png --out d.exr --scale 0.5");
    rt_image *image = NULL;
    float rgb[VALUES];
    expect_status(&run, 0);
    assert_int_equal(rt_image_read(&image, "d.exr", NULL), RT_OK);
    assert_int_equal(rt_image_get_rgb(rgb, image, NULL, NULL), RT_OK);
    assert_true(rgb[0] == 0.25f && rgb[VALUES - 1] == 0.25f);
    rt_image_destroy(image);
    assert_int_equal(rt_image_read(&image, "d.png", NULL), RT_OK);
    assert_true(image->data[0] == 1.0f && fabs(image->data[1] - 0.5) < 0.003 &&
                fabs(image->data[2] - 0.5) < 0.003);
    rt_image_destroy(image);
    run_free(&run);
}

static void scales_that_nothing_shows_are_warned_of(void **state)
{
    (void)state;
    run none = run_rtc("compare a.exr b.pfm --scale 1"),
        exr = run_rtc("compare a.exr b.pfm --scale 1 --out d.exr");
    run png = run_rtc("compare a.exr b.pfm --scale 1 --out d.png");
    expect_err(&none, "warning: --scale has no effect without --out to a .png or .ppm\n");
    expect_err(&exr, "warning: --scale has no effect without --out to a .png or .ppm\n");
    assert_string_equal(png.err, "");
    run_free(&none);
    run_free(&exr);
    run_free(&png);
}

/* ---- Refusals ----------------------------------------------------------------------- */

static void bad_images_give_an_error_and_no_results(void **state)
{
    static const struct {
        const char *line;
        int status;
        const char *says;
    } cases[] = {
        {"a.exr none.exr", 1, "none.exr: No such file"},
        {"text.exr b.pfm", 1, "text.exr: it is no image of the formats EXR, PNG, JPEG,"},
        {"empty.png b.pfm", 1, "empty.png: it is empty"},
        {"short.pfm b.pfm", 1, "short.pfm: "},
        {"small.pfm b.pfm", 1, "small.pfm has 2x1 pixels but b.pfm 16x16"},
        {"a.exr b.pfm --layer albedo", 1, "b.pfm has no layer 'albedo': the image holds no layers"},
        {"a.exr b.pfm --out nowhere/d.png", 4, "nowhere/d.png"},
        {"a.exr b.pfm --out d.jpg", 2, "the extension tells the format"},
        {"a.exr ./a.exr b.pfm", 2, "./a.exr is given twice: several renders must be independent"},
        {"a.exr", 2, "which images?"},
        {"", 2, "which images?"},
        {"a.exr b.pfm --max-rmse -1", 2, "--max-rmse takes"},
        {"a.exr b.pfm --min-ssim 2", 2, "--min-ssim takes"},
        {"a.exr b.pfm --block 0", 2, "--block takes"},
        {"a.exr b.pfm --tolerance 0", 2, "--tolerance takes"},
        {"a.exr b.pfm --spp 3", 2, "`rtc compare` takes no option --spp"},
        {"a.exr b.pfm --max-rms 3", 2, "did you mean --max-rmse?"},
    };
    (void)state;
    scratch_write("text.exr", "not an image");
    scratch_write("empty.png", "");
    scratch_write("short.pfm", "PF\n16 16\n-1.0\n0123");
    scratch_write("small.pfm", "PF\n2 1\n-1.0\n012345678901234567890123");
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        run run = run_rtc(cases[i].line[0] ? "compare %s" : "compare%s", cases[i].line);
        expect_status(&run, cases[i].status);
        expect_err(&run, "rtc: error: ");
        expect_err(&run, cases[i].says);
        assert_string_equal(run.out, "");
        run_free(&run);
    }
}

static void damaged_images_never_crash(void **state)
{
    (void)state;
    FILE *file = fopen("a.exr", "rb");
    assert_non_null(file);
    char bytes[8192];
    size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    assert_true(size > 100 && size < sizeof bytes);
    for (size_t length = 1; length < size; length += size / 12) {
        file = fopen("d.exr", "wb");
        assert_non_null(file);
        assert_int_equal(fwrite(bytes, 1, length, file), length);
        fclose(file);
        run run = run_rtc("compare d.exr b.pfm");
        expect_status(&run, 1);
        expect_err(&run, "rtc: error: cannot read d.exr");
        run_free(&run);
    }
}

static void a_full_disk_is_status_4(void **state)
{
    (void)state;
    run run = run_rtc_to("/dev/full", "compare a.exr b.pfm");
    expect_status(&run, 4);
    expect_err(&run, "cannot write to stdout");
    run_free(&run);
}

int main(void)
{
    if (spawn_find_rtc() != 0)
        return 1;
#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, enter, scratch_leave)
    const struct CMUnitTest tests[] = {
        IN_SCRATCH(results_are_lines_on_stdout),
        IN_SCRATCH(results_are_json_when_asked),
        IN_SCRATCH(blocks_are_listed_when_asked),
        IN_SCRATCH(noise_that_is_not_known_is_called_so),
        IN_SCRATCH(photon_renders_by_themselves_are_warned_of),
        IN_SCRATCH(renders_compare_as_their_mean),
        IN_SCRATCH(formats_of_one_render_are_equal),
        IN_SCRATCH(limits_decide_the_status),
        IN_SCRATCH(limits_on_what_is_not_known_are_not_kept),
        IN_SCRATCH(pixels_that_are_not_finite_keep_no_limit),
        IN_SCRATCH(differences_are_written),
        IN_SCRATCH(scales_that_nothing_shows_are_warned_of),
        IN_SCRATCH(bad_images_give_an_error_and_no_results),
        IN_SCRATCH(damaged_images_never_crash),
        IN_SCRATCH(a_full_disk_is_status_4),
    };
    return cmocka_run_group_tests_name("tools/compare", tests, NULL, NULL);
}
