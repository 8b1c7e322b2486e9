/*
 * test_scenes.c - malformed scenes: rtc names the place and what is wrong, with status 1, and never
 * crashes.
 */
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
#include "spawn.h"

#define CAMERA "camera { eye 0 0 -4  look_at 0 0 0 }\n"
#define WHITE "material white { kd 0.7 }\n"
#define BALL "sphere { centre 0 0 0  radius 1  material white }\n"
#define LIGHT "light point { position 2 4 -3  intensity 20 }\n"

/* A scene with one mistake, where it is, and a part of what is said about it. */
static const struct {
    const char *name, *text;
    int line, column;
    const char *says;
} mistakes[] = {
    {"unknown_block", "shpere { }\n", 1, 1, "did you mean 'sphere'?"},
    {"unknown_field", CAMERA "film { widht 4 }\n", 2, 8, "did you mean 'width'?"},
    {"unknown_material", WHITE "sphere { centre 0 0 0  radius 1  material wihte }\n", 2, 43,
     "did you mean 'white'?"},
    {"unknown_light", "light spto { position 0 0 0  intensity 1 }\n", 1, 7, "spto"},
    {"unknown_mode", "render { mode paht }\n", 1, 15, "did you mean 'path'?"},
    {"unknown_constant", "let a = 1\nfilm { width b }\n", 2, 14, "'b'"},
    {"missing_field", WHITE "sphere { centre 0 0 0  material white }\n", 2, 1, "radius"},
    {"missing_brace", "film { width 4\n", 1, 1, "}"},
    {"missing_value", "film { width }\n", 1, 8, "width"},
    {"two_numbers_for_three", "camera { eye 0 0  look_at 0 0 0 }\n", 1, 10,
     "three numbers, found two"},
    {"four_numbers_for_three", "camera { eye 0 0 0 0  look_at 0 0 1 }\n", 1, 20, "three numbers"},
    {"negative_radius", WHITE "sphere { centre 0 0 0  radius -1  material white }\n", 2, 31,
     "from 1e-15 to 1e+15"},
    {"zero_radius", WHITE "sphere { centre 0 0 0  radius 0  material white }\n", 2, 31,
     "from 1e-15 to 1e+15"},
    {"wide_fov", "camera { eye 0 0 0  look_at 0 0 1  fov 180 }\n", 1, 40, "180"},
    {"eye_is_look_at", "camera { eye 1 2 3  look_at 1 2 3 }\n", 1, 29, "eye"},
    {"zero_normal", WHITE "plane { point 0 0 0  normal 0 0 0  material white }\n", 2, 29, "zero"},
    {"flat_quad", WHITE "quad { corner 0 0 0  edge1 1 0 0  edge2 2 0 0  material white }\n", 2, 41,
     "edge"},
    {"flat_triangle", WHITE "triangle { a 0 0 0  b 1 1 1  c 2 2 2  material white }\n", 2, 1,
     "area is zero"},
    {"too_reflective", "material m { kd 0.6  ks 0.6 }\n", 1, 17, "must not exceed 1"},
    {"negative_albedo", "material m { kd -0.1 }\n", 1, 17, "kd"},
    {"zero_ior", "material m { kt 1  ior 0 }\n", 1, 24, "ior"},
    {"fractional_width", "film { width 4.5 }\n", 1, 14, "width"},
    {"huge_width", "film { width 1000000 }\n", 1, 14, "65536"},
    {"too_few_photons", "render { photons 0 }\n", 1, 18, "photons"},
    {"k_of_one", "render { k 1 }\n", 1, 12, "k"},
    {"division_by_zero", "film { width (4 / 0) }\n", 1, 17, "zero"},
    {"overflow", "film { width 1e999 }\n", 1, 14, "too large"},
    {"double_material", WHITE WHITE, 2, 10, "white"},
    {"double_camera", CAMERA CAMERA, 2, 1, "camera"},
    {"double_field", "film { width 4  width 5 }\n", 1, 17, "width"},
    {"power_and_intensity", "light point { position 0 0 0  intensity 1  power 1 }\n", 1, 44,
     "intensity"},
    {"stray_character", "film { width 4 } @\n", 1, 18, "@"},
    {"missing_include", "include \"nowhere.rts\"\n", 1, 10, "nowhere.rts"},
    {"include_of_itself", "include \"include_of_itself.rts\"\n", 1, 10, "include"},
    {"empty", "", 1, 1, "empty"},
    {"only_a_comment", "# nothing\n", 1, 1, "empty"},
};

static void each_mistake_is_placed_and_explained(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof mistakes / sizeof mistakes[0]; i++) {
        char file[64], place[96];
        snprintf(file, sizeof file, "%s.rts", mistakes[i].name);
        snprintf(place, sizeof place, "%s:%d:%d: error: ", file, mistakes[i].line,
                 mistakes[i].column);
        scratch_write(file, mistakes[i].text);
        run run = run_rtc("%s", file);
        expect_status(&run, 1);
        expect_err(&run, place);
        expect_err(&run, mistakes[i].says);
        expect_err(&run, "\n    ");
        expect_err(&run, "^");
        run_free(&run);
    }
    /* Only the scenes are there: nothing was rendered. */
    assert_int_equal(scratch_count(), sizeof mistakes / sizeof mistakes[0]);
}

static void five_mistakes_are_five_errors(void **state)
{
    (void)state;
    scratch_write("five.rts",
                  "camera { eye 0 0 -4  look_at 0 0 0  fov 400 }\n"
                  "film { widht 64 }\n" WHITE "sphere { centre 0 1 0  radius -1  material white }\n"
                  "plane { point 0 0 0  normal 0 1 0  material whit }\n"
                  "spere { }\n");
    run run = run_rtc("check five.rts");
    expect_status(&run, 1);
    int errors = 0;
    for (const char *at = run.err; (at = strstr(at, ": error: ")); at++)
        errors++;
    assert_int_equal(errors, 5);
    expect_err(&run, "five.rts:1:41: error: ");
    expect_err(&run, "five.rts:2:8: error: ");
    expect_err(&run, "five.rts:4:31: error: ");
    expect_err(&run, "five.rts:5:45: error: ");
    expect_err(&run, "five.rts:6:1: error: ");
    expect_err(&run, "five.rts: 5 errors\n");
    run_free(&run);
}

static void a_scene_of_stdin_has_one_name(void **state)
{
    (void)state;
    run run = run_rtc_input("foo\nfilm { widht 3 }\n", 21, "check -");
    expect_status(&run, 1);
    expect_err(&run, "stdin:1:1: error: ");
    expect_err(&run, "stdin: 2 errors\n");
    run_free(&run);
    run = run_rtc_input(CAMERA WHITE BALL LIGHT, strlen(CAMERA WHITE BALL LIGHT), "check -");
    expect_status(&run, 0);
    expect_out(&run, "stdin: ok: 1 shape, ");
    run_free(&run);
}

/* One line for each scene, sound or not; what is said of it is JSON too. */
static void check_prints_json(void **state)
{
    (void)state;
    scratch_write("a.rts", CAMERA WHITE BALL LIGHT);
    scratch_write("b.rts", CAMERA "film { widht 64 }\n");
    run run = run_rtc("check a.rts b.rts --json");
    expect_status(&run, 1);
    expect_out(&run, "{\"scene\":\"a.rts\",\"ok\":true,\"errors\":0,\"warnings\":0,\"shapes\":1,"
                     "\"triangles\":0,\"materials\":1,\"lights\":1,\"grids\":0}\n");
    expect_out(&run, "{\"scene\":\"b.rts\",\"ok\":false,\"errors\":1,\"warnings\":0}\n");
    expect_err(&run, "{\"severity\":\"error\",\"file\":\"b.rts\",\"line\":2,\"column\":8,"
                     "\"message\":\"unknown field 'widht' in film\",\"hint\":\"did you mean "
                     "'width'?\"}\n");
    run_free(&run);
}

static void quiet_check_tells_errors_alone(void **state)
{
    (void)state;
    scratch_write("a.rts", CAMERA WHITE BALL);
    scratch_write("b.rts", CAMERA "film { widht 64 }\n");
    run dark = run_rtc("check a.rts --quiet"), bad = run_rtc("check b.rts --quiet");
    expect_status(&dark, 0);
    assert_string_equal(dark.out, "");
    assert_string_equal(dark.err, "");
    expect_status(&bad, 1);
    expect_err(&bad, "b.rts:2:8: error: ");
    run_free(&dark);
    run_free(&bad);
}

static void error_in_an_included_file_names_that_file(void **state)
{
    (void)state;
    scratch_write("part.rts", WHITE "\n  sphere { bogus 3 }\n");
    scratch_write("whole.rts", CAMERA "include \"part.rts\"\n");
    run run = run_rtc("check whole.rts");
    expect_status(&run, 1);
    expect_err(&run, "part.rts:3:12: error: ");
    run_free(&run);
}

static void caret_stands_under_the_place(void **state)
{
    (void)state;
    /* A tab before it stays a tab. */
    scratch_write("caret.rts", "# one\n\tfilm { width 4 }\n\tfilm_ { }\n");
    run run = run_rtc("check caret.rts");
    expect_status(&run, 1);
    expect_err(&run, "caret.rts:3:2: error: ");
    expect_err(&run, "\n    \tfilm_ { }\n    \t^~~~~\n");
    run_free(&run);
}

static void long_line_is_cut_around_the_place(void **state)
{
    (void)state;
    char text[4000];
    snprintf(text, sizeof text, "film { %*s bogus 1 %*s }\n", 1500, "", 1500, "");
    scratch_write("long.rts", text);
    run run = run_rtc("check long.rts");
    expect_status(&run, 1);
    expect_err(&run, "long.rts:1:1509: error: ");
    expect_err(&run, "bogus 1");
    assert_true(strlen(run.err) < 800);
    run_free(&run);
}

static void control_characters_do_not_reach_the_terminal(void **state)
{
    (void)state;
    scratch_write("escape.rts", "film { \033[31m\007 }\n");
    run run = run_rtc("check escape.rts");
    expect_status(&run, 1);
    expect_no_err(&run, "\033");
    expect_no_err(&run, "\007");
    run_free(&run);
}

static void what_is_no_scene_file_is_status_1(void **state)
{
    (void)state;
    static const char *const lines[] = {"nosuch.rts", ".", "check nosuch.rts", "check ."};
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        run run = run_rtc("%s", lines[i]);
        expect_status(&run, 1);
        expect_err(&run, "error: ");
        run_free(&run);
    }
    assert_int_equal(scratch_count(), 0);
}

static void binary_scene_is_status_1(void **state)
{
    (void)state;
    /* Every byte there is, then a picture's first bytes. */
    char bytes[256 + 8];
    for (int i = 0; i < 256; i++)
        bytes[i] = (char)i;
    memcpy(bytes + 256, "\x89PNG\r\n\x1a\n", 8);
    run run = run_rtc_input(bytes, sizeof bytes, "check -");
    expect_status(&run, 1);
    expect_err(&run, "error: ");
    run_free(&run);

    FILE *file = fopen("binary.rts", "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, sizeof bytes, file), sizeof bytes);
    assert_int_equal(fclose(file), 0);
    run = run_rtc("check binary.rts");
    expect_status(&run, 1);
    expect_err(&run, "binary.rts:1:1: error: ");
    run_free(&run);
}

static void scene_cut_short_anywhere_never_crashes(void **state)
{
    (void)state;
    static const char whole[] = CAMERA WHITE BALL LIGHT;
    int sound = 0;
    for (size_t length = 0; length <= strlen(whole); length += 3) {
        run run = run_rtc_input(whole, length, "check -");
        assert_in_range(run.status, 0, 1);
        sound += run.status == 0;
        run_free(&run);
    }
    /* Cut between two blocks it is a scene still. */
    assert_in_range(sound, 1, 8);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_enter, scratch_leave)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(each_mistake_is_placed_and_explained),
        TEST(five_mistakes_are_five_errors),
        TEST(a_scene_of_stdin_has_one_name),
        TEST(check_prints_json),
        TEST(quiet_check_tells_errors_alone),
        TEST(error_in_an_included_file_names_that_file),
        TEST(caret_stands_under_the_place),
        TEST(long_line_is_cut_around_the_place),
        TEST(control_characters_do_not_reach_the_terminal),
        TEST(what_is_no_scene_file_is_status_1),
        TEST(binary_scene_is_status_1),
        TEST(scene_cut_short_anywhere_never_crashes),
    };
    return spawn_find_rtc() == 0 ? cmocka_run_group_tests(tests, NULL, NULL) : 1;
}
