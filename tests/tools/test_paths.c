/* test_paths.c - `rtc paths`: what it writes, and what it refuses. */
#include <setjmp.h>
#include <signal.h>
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

/* Glass and an environment, so that paths refract and escape. */
#define SCENE(settings)                                                                            \
    "camera { eye 0 1 -4  look_at 0 1 0  fov 40 }\n"                                               \
    "film { width 24  height 18 }\n"                                                               \
    "render { " settings " }\n"                                                                    \
    "material white { kd 0.7 }\n"                                                                  \
    "material glass { kt 1  ior 1.5  fresnel dielectric }\n"                                       \
    "disc { centre 0 0 0  normal 0 1 0  radius 3  material white }\n"                              \
    "sphere { centre 0 1 0  radius 1  material glass }\n"                                          \
    "light point { position 2 4 -3  intensity 20 }\n"                                              \
    "light environment { radiance 0.5 }\n"

static const char scene[] = SCENE("spp 8");

/* The number behind a text. */
static double number_after(const char *text, const char *name)
{
    const char *at = strstr(text, name);
    if (!at)
        fail_msg("no %s", name);
    return strtod(at + strlen(name), NULL);
}

static size_t count_of(const char *text, const char *what)
{
    size_t count = 0;
    for (const char *at = text; (at = strstr(at, what)); at += strlen(what))
        count++;
    return count;
}

static void the_mean_of_the_paths_is_the_pixel(void **state)
{
    rt_image *image = NULL;
    rt_error error;
    float rgb[24 * 18 * 3];
    (void)state;
    scratch_write("a.rts", scene);
    run render = run_rtc("a.rts --out a.exr --quiet");
    expect_status(&render, 0);
    if (rt_image_read(&image, "a.exr", &error) != RT_OK ||
        rt_image_get_rgb(rgb, image, NULL, &error) != RT_OK)
        fail_msg("%s", error.message);
    rt_image_destroy(image);
    for (int x = 2; x < 24; x += 7) {
        run run = run_rtc("paths a.rts --pixel %d,9 --quiet", x);
        expect_status(&run, 0);
        assert_int_equal(count_of(run.out, "\"sample\":"), 8);
        const double red = number_after(run.out, "\"radiance\":[");
        assert_true(red >= 0.999 * rgb[3 * (9 * 24 + x)] && red <= 1.001 * rgb[3 * (9 * 24 + x)]);
        run_free(&run);
    }
    run_free(&render);
}

static void samples_are_chosen(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    run some = run_rtc("paths a.rts --pixel 12,9 --sample 3-5 --quiet"),
        one = run_rtc("paths a.rts --pixel 12,9 --sample 4 --quiet");
    expect_status(&some, 0);
    expect_status(&one, 0);
    /* Those of the picture, whose number this scene leaves to the mode. */
    scratch_write("b.rts", SCENE(""));
    run all = run_rtc("paths b.rts --pixel 12,9 --quiet");
    expect_status(&all, 0);
    assert_int_equal(count_of(all.out, "\"sample\":"), 64);
    expect_no_err(&all, "beyond");
    run_free(&all);
    all = run_rtc("paths a.rts --pixel 12,9 --sample 7-8");
    expect_status(&all, 0);
    expect_err(&all, "the picture has 8 samples of a pixel, 0 to 7; those beyond are");
    run_free(&all);
    assert_int_equal(count_of(some.out, "\"sample\":"), 3);
    assert_int_equal(count_of(one.out, "\"sample\":"), 1);
    const char *path = strstr(one.out, "{\"sample\":4,");
    assert_non_null(path);
    ((char *)path)[strlen(path) - strlen("]}\n")] = '\0';
    assert_non_null(strstr(some.out, path));
    run_free(&some);
    run_free(&one);
}

/* As many vertices and edges as the header says, and edges between vertices that there are. */
static void lines_are_whole(void **state)
{
    unsigned vertices, edges, a, b, kind;
    char line[256];
    (void)state;
    scratch_write("a.rts", scene);
    run run = run_rtc("paths a.rts --pixel 12,9 --out a.ply --quiet");
    expect_status(&run, 0);
    FILE *file = fopen("a.ply", "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file) && strcmp(line, "end_header\n") != 0) {
        sscanf(line, "element vertex %u", &vertices);
        sscanf(line, "element edge %u", &edges);
    }
    for (unsigned i = 0; i < vertices; i++)
        assert_non_null(fgets(line, sizeof line, file));
    for (unsigned i = 0; i < edges; i++) {
        assert_int_equal(fscanf(file, "%u %u %u", &a, &b, &kind), 3);
        assert_true(a < vertices && b < vertices && a < b && kind < 3);
    }
    assert_int_equal(fscanf(file, "%u", &a), EOF);
    fclose(file);
    assert_true(vertices > 16 && edges >= vertices - 16);
    run_free(&run);
}

static void a_page_holds_paths_and_picture(void **state)
{
    static char page[1 << 20];
    (void)state;
    scratch_write("a.rts", scene);
    run run = run_rtc("paths a.rts --pixel 12,9 --out a.html --out a.json --quiet");
    expect_status(&run, 0);
    expect_file("a.json");
    FILE *file = fopen("a.html", "r");
    assert_non_null(file);
    page[fread(page, 1, sizeof page - 1, file)] = '\0';
    fclose(file);
    assert_non_null(strstr(page, "\"pixel\":[12,9]"));
    const char *pixels = strstr(page, "id=\"pixels\">") + strlen("id=\"pixels\">");
    assert_int_equal(strspn(pixels, "0123456789abcdef"), 8 * 24 * 18);
    assert_null(strstr(page, "@PATHS@"));
    assert_null(strstr(page, "http://www.w3.org/1999"));
    run_free(&run);
}

static void a_scene_in_photon_mode_is_followed_in_mode_path(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    scratch_write("b.rts", SCENE("mode photon  k 20"));
    run path = run_rtc("paths a.rts --pixel 12,9 --sample 0"),
        photon = run_rtc("paths b.rts --pixel 12,9 --sample 0");
    expect_status(&photon, 0);
    expect_err(&photon, "mode path");
    assert_string_equal(strstr(path.out, "\"paths\""), strstr(photon.out, "\"paths\""));
    run_free(&path);
    run_free(&photon);
}

/* Text of many paths takes a while. */
static void an_interrupt_ends_the_writing(void **state)
{
    static const char *const names[] = {"a.json", "a.ply"},
                             ended[] = "\"render\",\"fraction\":1.0000";
    static char said[1 << 16];
    (void)state;
    scratch_write("a.rts", scene);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        said[0] = '\0';
        running running = start_rtc(
            "paths a.rts --pixel 12,9 --sample 0-65535 --progress json --out %s", names[i]);
        assert_int_equal(running_wait_for(&running, ended, said, sizeof said), 0);
        assert_int_equal(kill(running.pid, SIGINT), 0);
        assert_int_equal(running_finish(&running, said, sizeof said), 130);
        assert_non_null(strstr(said, "interrupted; nothing was written"));
        expect_no_file(names[i]);
    }
}

static void mistakes_are_told(void **state)
{
    static const struct {
        const char *line, *said;
    } mistakes[] = {
        {"paths a.rts", "which pixel?"},
        {"paths --pixel 1,1", "which scene?"},
        {"paths a.rts --pixel 1", "--pixel takes X,Y"},
        {"paths a.rts --pixel 1,-1", "--pixel takes X,Y"},
        {"paths a.rts --pixel 24,0", "--pixel: there is no pixel 24,0 in a picture of 24 x 18"},
        {"paths a.rts --pixel 1,1 --sample 5-3", "--sample takes"},
        {"paths a.rts --pixel 1,1 --sample 0-65536", "--sample takes"},
        {"paths a.rts --pixel 1,1 --mode photon", "mode path, not of mode photon"},
        {"paths a.rts --pixel 1,1 --variance", "takes no option --variance"},
        {"paths a.rts --pixel 1,1 --out a.png", ".json, .ply or .html"},
        {"paths a.rts --pixel 1,1 --k 5", "takes no option --k"},
    };
    (void)state;
    scratch_write("a.rts", scene);
    for (size_t i = 0; i < sizeof mistakes / sizeof *mistakes; i++) {
        run run = run_rtc("%s", mistakes[i].line);
        expect_status(&run, 2);
        expect_err(&run, mistakes[i].said);
        assert_string_equal(run.out, "");
        run_free(&run);
    }
    run lost = run_rtc("paths a.rts --pixel 1,1 --out none/a.json");
    expect_status(&lost, 4);
    run_free(&lost);
    assert_int_equal(scratch_count(), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_enter, scratch_leave)
        TEST(the_mean_of_the_paths_is_the_pixel),
        TEST(samples_are_chosen),
        TEST(lines_are_whole),
        TEST(a_page_holds_paths_and_picture),
        TEST(a_scene_in_photon_mode_is_followed_in_mode_path),
        TEST(an_interrupt_ends_the_writing),
        TEST(mistakes_are_told),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests_name("tools/paths", tests, NULL, NULL);
}
