/*
 * test_study_reference.c - what rtc study measures against: references that find the light of the
 * scene, what they lack beside the numbers, and the time that they take.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <glob.h>

#include "expect.h"
#include "lib/image/scratch.h"
#include "spawn.h"

/* A glass ball above a floor; in the sun, or in mist, of which mode vcm refuses the scene. */
static const char ball[] = "camera { eye 0 1.5 -5  look_at 0 0.7 0  fov 40 }\n"
                           "film { width 8  height 6 }\n"
                           "material white { kd 0.7 }\n"
                           "material glass { kt 1  fresnel dielectric  ior 1.5 }\n"
                           "quad { corner -3 0 -3  edge1 0 0 6  edge2 6 0 0  material white }\n"
                           "sphere { centre 0 0.8 0  radius 0.8  material glass }\n"
                           "light environment { radiance 0.3 }\n";
static const char sun[] = "include \"ball.rts\"\n"
                          "light directional { direction 0.5 -1 0.5  irradiance 3 }\n";
static const char mist[] = "include \"ball.rts\"\nmedium { scattering 0.01 }\n"
                           "light point { position 2 5 -2  power 100 }\n";
static const char missing[] = "leaves out caustics of point, spot and directional lights";

static void write_scenes(void)
{
    scratch_write("ball.rts", ball);
    scratch_write("sun.rts", sun);
    scratch_write("mist.rts", mist);
}

/* The page from its references on; to be freed with *page. */
static const char *references_of(const char *name, char **page)
{
    *page = scratch_read(name);
    const char *at = strstr(*page, "\"references\":[");
    assert_non_null(at);
    return at;
}

/* ---- Light that a mode leaves out ------------------------------------------------------ */

static void a_reference_is_by_a_mode_that_finds_the_light_of_the_scene(void **state)
{
    static const struct {
        const char *scene, *reference, *mode;
        int is_chosen, lacks; /* lacks: the reference leaves out light */
    } cases[] = {
        {"ball", "auto", "path", 0, 0}, {"sun", "auto", "vcm", 1, 0},
        {"sun", "path", "path", 0, 1},  {"sun", "vcm", "vcm", 0, 0},
        {"mist", "auto", "path", 0, 1},
    };
    (void)state;
    write_scenes();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char command[64], *page;
        run run = run_rtc("study %s.rts --sweep spp=1 --reference %s --reference-error 0.2 --out "
                          "o.html",
                          cases[i].scene, cases[i].reference);
        expect_status(&run, 0);
        snprintf(command, sizeof command, "rtc %s.rts --mode %s --spp 16384", cases[i].scene,
                 cases[i].mode);
        const char *at = references_of("o.html", &page);
        if (!strstr(at, command) || !!strstr(at, "\"leaves_out\":\"caustics") != cases[i].lacks)
            fail_msg("%zu: not '%s': %.600s", i, command, at);
        (cases[i].is_chosen ? expect_err : expect_no_err)(
            &run, "reference is by mode vcm, as mode path leaves out caustics of point, ");
        char said[160];
        snprintf(said, sizeof said, "rtc: warning: the reference %s", missing);
        (cases[i].lacks ? expect_err : expect_no_err)(&run, said);
        run_free(&run);
        free(page);
        /* From the films that are kept the same is told. */
        run = run_rtc("study %s.rts --sweep spp=1 --reference %s --reference-error 0.2 --out "
                      "o.html",
                      cases[i].scene, cases[i].reference);
        expect_err(&run, ", kept");
        (cases[i].lacks ? expect_err : expect_no_err)(&run, said);
        run_free(&run);
    }
}

static void pictures_that_leave_out_light_say_so_beside_their_numbers(void **state)
{
    char *page;
    (void)state;
    write_scenes();
    run run = run_rtc("study sun.rts --sweep mode=path,vcm --spp 1 --out o.html");
    expect_status(&run, 0);
    run_free(&run);
    references_of("o.html", &page);
    const char *path = strstr(page, "\"values\":[\"path\"]"),
               *vcm = strstr(page, "\"values\":[\"vcm\"]"),
               *lacks = strstr(page, "\"leaves_out\":\"caustics of point");
    assert_true(path && vcm && lacks && path < lacks && lacks < vcm);
    assert_null(strstr(vcm, "\"leaves_out\":\"caustics"));
    free(page);
}

/* ---- The reference's own error --------------------------------------------------------- */

/* A number of the last film that info told of, by its name in JSON. */
static double json_number(const run *run, const char *name)
{
    char key[64];
    snprintf(key, sizeof key, "\"%s\":", name);
    const char *at = strstr(run->out, key);
    if (!at)
        fail_msg("no %s in %s", key, run->out);
    return strtod(at + strlen(key), NULL);
}

static void a_reference_that_ends_at_its_limit_says_so(void **state)
{
    char *page;
    (void)state;
    write_scenes();
    run run = run_rtc("study ball.rts --sweep spp=1 --width 2 --height 2 --reference auto "
                      "--reference-error 0.00001 --out o.html");
    expect_status(&run, 0);
    expect_err(&run, "and 16384 samples a pixel, which is its limit, with more than the error of "
                     "0.001 %");
    expect_err(&run, "rtc: warning: the reference ended at its limit of 16384 samples a pixel with "
                     "an error of 0.");
    expect_err(&run, " %, not 0.001 %");
    run_free(&run);
    assert_non_null(strstr(references_of("o.html", &page), "\"target\":1e-05,\"limit\":16384"));
    free(page);
    run =
        run_rtc("study ball.rts --sweep spp=1 --reference auto --reference-error 0.1 --out o.html");
    expect_no_err(&run, "limit of 16384 samples a pixel");
    expect_err(&run, "or to its limit, 16384 samples;");
    run_free(&run);
}

static void a_reference_that_cannot_be_is_told(void **state)
{
    (void)state;
    write_scenes();
    run run = run_rtc("study ball.rts --sweep spp=1 --reference aut --out o.html");
    expect_err(&run, "cannot read aut");
    expect_err(&run, "hint: did you mean --reference auto?");
    assert_int_not_equal(run.status, 0);
    run_free(&run);
    run = run_rtc("study ball.rts --sweep spp=1 --reference-error 0.1 --out o.html");
    expect_err(&run, "--reference-error is of a reference that is rendered: add --reference auto");
    assert_int_not_equal(run.status, 0);
    run_free(&run);
}

/* The second row of a table, and a value of it by its column. */
static double value_of(const char *table, const char *column)
{
    char *text = scratch_read(table), *row = strchr(text, '\n') + 1;
    size_t place = 0;
    const char *name = strstr(text, column);
    assert_true(name && name < row);
    for (const char *at = text; at < name; at++)
        place += *at == ',';
    for (; place > 0; place--)
        row = strchr(row, ',') + 1;
    const double value = strtod(row, NULL);
    free(text);
    return value;
}

/* Path tracing has no bias: what is measured is about what the reference is off by. */
static void a_bias_stands_beside_what_the_reference_is_off_by(void **state)
{
    char *page;
    (void)state;
    write_scenes();
    run run = run_rtc("study ball.rts --sweep spp=512 --repeat 8 --reference auto "
                      "--reference-error 0.2 --out o.html");
    expect_status(&run, 0);
    const double own = value_of("o.csv", "reference_error"), bias = value_of("o.csv", "bias");
    if (!(bias > own / 3 && bias < 3 * own))
        fail_msg("a bias of %g, and a reference that is off by %g", bias, own);
    expect_err(&run, "rtc: warning: the reference is off by ");
    expect_err(&run, " itself, root of relMSE, more than half of the least bias, ");
    run_free(&run);
    assert_non_null(strstr(references_of("o.html", &page), ",\"hides_bias\":true"));
    free(page);
}

/* ---- The time that it takes ------------------------------------------------------------ */

/*
 * The samples that are foretold, on which the time hangs, are about those that it takes. The noise
 * of so few as eight says little of those that follow.
 */
static void the_samples_of_a_reference_are_foretold(void **state)
{
    static const char room[] =
        "camera { eye 0 1 -2.9  look_at 0 1 0  fov 60 }\n"
        "material white { kd 0.7 }\n"
        "box { centre 0 1 0  size 4 2 6  material white }\n"
        "quad { corner -0.1 1.95 -0.1  edge1 0.2 0 0  edge2 0 0 0.2  material white\n"
        "       radiance 50 }\n"
        "sphere { centre 0 0.4 0.5  radius 0.4  material white }\n";
    glob_t found;
    (void)state;
    scratch_write("room.rts", room);
    run run = run_rtc("study room.rts --sweep spp=1 --width 24 --height 18 --reference auto "
                      "--reference-error 0.1 --out o.html");
    expect_status(&run, 0);
    const char *at = strstr(run.err, " is rendered by mode path, in about ");
    assert_non_null(at);
    at = strstr(at, " and ");
    assert_non_null(at);
    const double foretold = strtod(at + strlen(" and "), NULL);
    run_free(&run);
    assert_int_equal(glob("o.films/reference-*.rtpart", 0, NULL, &found), 0);
    run = run_rtc("info --json %s", found.gl_pathv[0]);
    globfree(&found);
    const double taken = json_number(&run, "samples_done");
    run_free(&run);
    if (!(taken > 50 && foretold > taken / 3 && foretold < 3 * taken))
        fail_msg("%g samples were foretold, %g taken", foretold, taken);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_enter, scratch_leave)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_reference_is_by_a_mode_that_finds_the_light_of_the_scene),
        TEST(pictures_that_leave_out_light_say_so_beside_their_numbers),
        TEST(a_reference_that_ends_at_its_limit_says_so),
        TEST(a_reference_that_cannot_be_is_told),
        TEST(a_bias_stands_beside_what_the_reference_is_off_by),
        TEST(the_samples_of_a_reference_are_foretold),
    };
    return spawn_find_rtc() == 0 ? cmocka_run_group_tests(tests, NULL, NULL) : 1;
}
