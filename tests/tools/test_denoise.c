/* test_denoise.c - `rtc --denoise`, with a library that stands in for Open Image Denoise. */
#define _XOPEN_SOURCE 700 /* realpath */

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "lib/image/scratch.h"
#include "rt.h"
#include "tools/expect.h"
#include "tools/spawn.h"

static const char scene[] = "camera { eye 0 1 -4  look_at 0 1 0  fov 40 }\n"
                            "film { width 16  height 12 }\n"
                            "render { spp 2 }\n"
                            "material white { kd 0.7 }\n"
                            "plane { point 0 0 0  normal 0 1 0  material white }\n"
                            "sphere { centre 0 1 0  radius 1  material white }\n"
                            "light point { position 2 4 -3  intensity 20 }\n";

static char stub[4096]; /* the stand-in */

/* The picture of an .exr, or a layer of it. */
static void read_exr(float rgb[16 * 12 * 3], const char *path, const char *layer)
{
    rt_image *image = NULL;
    rt_error error;
    if (rt_image_read(&image, path, &error) != RT_OK ||
        rt_image_get_rgb(rgb, image, layer, &error) != RT_OK)
        fail_msg("%s", error.message);
    rt_image_destroy(image);
}

static void the_layer_stands_beside_a_picture_that_stays(void **state)
{
    static float raw[16 * 12 * 3], beside[16 * 12 * 3], layer[16 * 12 * 3];
    (void)state;
    scratch_write("a.rts", scene);
    run plain = run_rtc("a.rts --out a.png --out a.exr --quiet"),
        run = run_rtc("a.rts --out b.png --out b.exr --quiet --denoise --denoiser %s", stub);
    expect_status(&plain, 0);
    expect_status(&run, 0);
    expect_same_files("a.png", "b.png");
    expect_file("b.denoised.png");
    expect_different_files("b.png", "b.denoised.png");
    read_exr(raw, "a.exr", NULL);
    read_exr(beside, "b.exr", NULL);
    read_exr(layer, "b.exr", "denoised");
    assert_memory_equal(raw, beside, sizeof raw);
    for (int i = 0; i < 16 * 12 * 3; i++)
        assert_true(layer[i] == raw[i] / 2);
    assert_int_equal(scratch_count(), 6);
    run_free(&plain);
    run_free(&run);
}

static void the_library_is_named_by_the_environment(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    run run = run_rtc("RTC_DENOISER=%s rtc a.rts --out b.png --denoise", stub),
        doctor = run_rtc("RTC_DENOISER=%s rtc doctor", stub);
    expect_status(&run, 0);
    expect_err(&run, "wrote b.denoised.png");
    expect_out(&doctor, "ok    --denoise: Open Image Denoise 2.3.4 in");
    run_free(&run);
    run_free(&doctor);
}

static void a_library_that_is_named_must_be_one(void **state)
{
    (void)state;
    scratch_write("here.so", "no library");
    run here = run_rtc("doctor --denoiser here.so"),
        none = run_rtc("doctor --denoiser /no/file.so");
    expect_status(&here, 3);
    expect_out(&here, "FAIL  --denoise: cannot open Open Image Denoise: ./here.so: ");
    expect_status(&none, 3);
    expect_out(&none, "FAIL  --denoise: cannot open Open Image Denoise: /no/file.so: ");
    run_free(&here);
    run_free(&none);
}

static void a_library_that_fails_costs_its_layer_alone(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    run run = run_rtc("STUB_OIDN=filter-error rtc a.rts --out b.png --denoise --denoiser %s", stub);
    expect_status(&run, 3);
    expect_err(&run, "the filter is broken");
    expect_file("b.png");
    expect_no_file("b.denoised.png");
    run_free(&run);
}

static void photons_are_denoised_with_a_warning(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    run run =
        run_rtc("a.rts --mode photon --photons 2000 --out b.png --denoise --denoiser %s", stub);
    expect_status(&run, 0);
    expect_err(&run, "may leave the noise of photons");
    expect_file("b.denoised.png");
    run_free(&run);
}

static void what_cannot_be_denoised_is_told_before_the_render(void **state)
{
    static const struct {
        const char *options, *said;
        int status;
    } mistakes[] = {
        {"--denoiser ./none.so", "pip install pyoidn", 3},
        {"--mode depth", "shows no light", 2},
        {"--untrusted", "--untrusted", 2},
    };
    (void)state;
    scratch_write("a.rts", scene);
    for (size_t i = 0; i < sizeof mistakes / sizeof *mistakes; i++) {
        run run = run_rtc("a.rts --out a.png --denoise %s", mistakes[i].options);
        expect_status(&run, mistakes[i].status);
        expect_err(&run, mistakes[i].said);
        expect_no_file("a.png");
        run_free(&run);
    }
    run run = run_rtc("a.rts --part 1/2 --out a.rtpart --denoise --denoiser %s", stub);
    expect_status(&run, 2);
    expect_err(&run, "--denoise does not go with --part");
    expect_no_file("a.rtpart");
    run_free(&run);
    run = run_rtc("a.rts --out a.png --denoiser %s", stub);
    expect_status(&run, 0);
    expect_err(&run, "--denoiser has no effect without --denoise");
    run_free(&run);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_enter, scratch_leave)
        TEST(the_layer_stands_beside_a_picture_that_stays),
        TEST(the_library_is_named_by_the_environment),
        TEST(a_library_that_is_named_must_be_one),
        TEST(a_library_that_fails_costs_its_layer_alone),
        TEST(photons_are_denoised_with_a_warning),
        TEST(what_cannot_be_denoised_is_told_before_the_render),
    };
    char beside[4096];
    const char *slash = argc > 0 ? strrchr(argv[0], '/') : NULL;
    snprintf(beside, sizeof beside, "%.*s/../lib/denoise/stub.so",
             slash ? (int)(slash - argv[0]) : 1, slash ? argv[0] : ".");
    if (spawn_find_rtc() != 0 || !realpath(beside, stub))
        return 1;
    return cmocka_run_group_tests_name("tools/denoise", tests, NULL, NULL);
}
