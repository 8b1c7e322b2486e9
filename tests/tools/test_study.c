/* test_study.c - rtc study: what it takes and refuses, measures, keeps and writes. */
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "expect.h"
#include "lib/image/scratch.h"
#include "spawn.h"

/* A ball in a room of light; its size is a constant. */
static const char scene[] = "let size = 1\n"
                            "camera { eye 0 0 -4  look_at 0 0 0 }\n"
                            "film { width 12  height 9 }\n"
                            "material white { kd 0.7 }\n"
                            "sphere { centre 0 0 0  radius (size)  material white }\n"
                            "plane { point 0 -1 0  normal 0 1 0  material white }\n"
                            "quad { corner -1 3 -1  edge1 2 0 0  edge2 0 0 2  material white\n"
                            "       radiance 9 }\n";

/* ---- Files ------------------------------------------------------------------------- */

static size_t count(const char *text, const char *what)
{
    size_t times = 0;
    for (const char *at = strstr(text, what); at; at = strstr(at + 1, what))
        times++;
    return times;
}

/* So many pictures were not rendered again. */
static void expect_count(const run *run, size_t kept)
{
    if (count(run->err, ", kept") != kept)
        fail_msg("not %zu pictures were kept:\n%s", kept, run->err);
}

/* The value of a column of a table, in row 0 or below; to be freed. No value has a comma. */
static char *cell(const char *name, size_t row, const char *column)
{
    char *text = scratch_read(name), *at = text, *value = NULL;
    size_t number = 0, length = strcspn(at, ",\n");
    while (strncmp(at, column, length) != 0 || column[length]) {
        if (at[length] != ',')
            fail_msg("no column '%s' in:\n%s", column, text);
        number++;
        at += length + 1;
        length = strcspn(at, ",\n");
    }
    for (at = text; row + 1 > 0 && at; row--)
        at = strchr(at, '\n') ? strchr(at, '\n') + 1 : NULL;
    for (; at && number > 0; number--)
        at += strcspn(at, ",\n") + 1;
    if (!at)
        fail_msg("no such row in:\n%s", text);
    value = strndup(at, strcspn(at, ",\n"));
    free(text);
    return value;
}

static double number(const char *name, size_t row, const char *column)
{
    char *text = cell(name, row, column);
    const double value = *text ? strtod(text, NULL) : -1;
    free(text);
    return value;
}

/* ---- Refusals ---------------------------------------------------------------------- */

static const struct {
    const char *line;
    int status;
    const char *says;
} refusals[] = {
    {"", 2, "usage: rtc study SCENE --sweep"},
    {"a.rts", 2, "usage: rtc study SCENE --sweep"},
    {"a.rts --sweep", 2, "--sweep needs a value"},
    {"a.rts --sweep k", 2, "--sweep takes NAME=VALUE,VALUE,...; not 'k'"},
    {"a.rts --sweep k", 2, "such as --sweep k=1,2"},
    {"a.rts --sweep fov", 2, "'camera { ... fov (fov) }', make it a constant, for --sweep fov=1,2"},
    {"a.rts --sweep fov=40,50", 1, "'fov' is a field of camera"},
    {"--list later.studies", 1, "in the study 'b' of later.studies"},
    {"a.rts --sweep k=", 2, "--sweep takes NAME=VALUE,VALUE,...; not 'k='"},
    {"a.rts --sweep =3", 2, "--sweep takes NAME=VALUE,VALUE,...; not '=3'"},
    {"a.rts --sweep k=5,,9", 2, "a value is missing in '5,,9'"},
    {"a.rts --sweep k=5,", 2, "a value is missing in '5,'"},
    {"a.rts --sweep k=5,9,5", 2, "the value '5' is given twice"},
    {"a.rts --sweep k=5 --sweep k=9", 2, "--sweep k is given twice"},
    {"a.rts --sweep spp=x", 2, "spp takes a whole number from 1 to 16777216; not 'x'"},
    {"a.rts --sweep kernel=box,boxx", 2, "not 'boxx'"},
    {"a.rts --sweep accel=kd", 2, "it is bvh or none; not 'kd'"},
    {"a.rts --sweep spp=all", 2, "not 'all'"},
    {"a.rts --sweep frob=1", 1, "the scene has no constant 'frob'"},
    {"a.rts --sweep frob=1", 1, "no setting is called 'frob'"},
    {"a.rts --sweep let:frob=1", 1, "the scene has no constant 'frob'"},
    {"a.rts --sweep let:=1", 2, "--sweep takes NAME=VALUE,VALUE,...; not 'let:=1'"},
    {"a.rts --sweep let:size=1 --sweep size=2", 2, "--sweep size is given twice"},
    {"a.rts --sweep photns=1", 1, "did you mean photons?"},
    {"a.rts --sweep mod=path,photon --reference b.exr", 1, "did you mean mode?"},
    {"a.rts --sweep size=x", 1, "unknown constant 'x'"},
    {"a.rts --sweep size=1,x", 1, "in the picture of size=x"},
    {"a.rts --sweep scene=a.rts", 2, "--sweep scene=... names the scenes"},
    {"b.rts --sweep spp=1", 1, "b.rts"},
    {"a.rts --sweep spp=1 --reference b.exr", 1, "cannot read b.exr"},
    {"a.rts --sweep spp=1 --reference a.rts", 1, "a.rts"},
    {"a.rts --sweep size=1,2 --reference b.exr", 2, "--reference auto renders them"},
    {"--sweep scene=a.rts,c.rts --reference b.exr", 2, "one reference for each value, 2 in all"},
    {"a.rts --sweep width=10,20 --reference b.exr", 2, "needs one reference for each value, 2"},
    {"a.rts --sweep width=10,20 --reference none", 2, "leave --reference out"},
    {"--sweep scene=a.rts,c.rts --reference b,c,d", 2, "--reference names 3 images"},
    {"c.rts --sweep scene=a.rts,nope.rts", 2, "the scene is given twice: leave c.rts out"},
    {"--sweep scene=a.rts,nope.rts", 1, "nope.rts"},
    {"a.rts --sweep spp=1,2 --equal error", 2, "--equal takes samples or time; not 'error'"},
    {"a.rts --sweep spp=1 --repeat 2", 2, "add --reference auto"},
    {"a.rts --sweep spp=1 --repeat 0", 2, "--repeat takes a whole number from 1"},
    {"a.rts --sweep spp=1 --out a.png", 2, "--out NAME.html"},
    {"a.rts --sweep spp=1 --out a.html --out b.html", 2, "--out NAME.html"},
    {"a.rts --sweep spp=1 --out none/a.html", 4, "none/a.html"},
    {"--list none.studies", 1, "cannot read none.studies"},
    {"--list .", 1, "cannot read .: "},
    {"--list a.rts", 1, "at a.rts:1"},
    {"--list empty.studies", 1, "empty.studies has no study"},
    {"--list twice.studies", 1, "there are two studies 'a'"},
    {"--list wrong.studies", 2, "in the study 'w' of wrong.studies"},
    {"--list path.studies", 1, "characters other than letters"},
    {"--list quote.studies", 1, "a word in quotes has no end: 's=1"},
    {"--list out.studies", 2, "--out is for the command line"},
    {"--list device.studies", 2, "--threads is for the command line"},
    {"--list dollar.studies", 1, "begins with '$ ', '$full ' or '$quick '"},
    {"--list text.studies", 1, "text.studies has no line '$ SCENE.rts --sweep NAME=VALUE"},
    {"--list two.studies --only photnos", 2, "no study 'photnos'; did you mean photons?"},
    {"a.rts --sweep spp=1 --only k", 2, "--only needs --list"},
    {"a.rts --sweep spp=1 --quick", 2, "--quick needs --list"},
    {"--list good.studies --sweep k=3", 2, "no scene or --sweep goes with it"},
};

static void wrong_input_is_refused(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    scratch_write("c.rts", scene);
    scratch_write("empty.studies", "# nothing\n");
    scratch_write("twice.studies", "== a A\n$ a.rts --sweep spp=1\n== a A\n");
    scratch_write("later.studies", "== a A\n$ a.rts --sweep spp=1\n== b B\n"
                                   "$ a.rts --sweep frob=1\n");
    scratch_write("wrong.studies", "== w W\n$ a.rts --sweep spp=1 --frob\n");
    scratch_write("path.studies", "== ../w W\n$ a.rts --sweep spp=1\n");
    scratch_write("dollar.studies", "== a A\n$ful a.rts --sweep spp=1\n");
    scratch_write("quote.studies", "== a A\n$ a.rts --sweep 's=1\n");
    scratch_write("out.studies", "== a A\n$ a.rts --sweep spp=1 --out z.html\n");
    scratch_write("device.studies", "== a A\n$ a.rts --sweep spp=1 --threads 1\n");
    scratch_write("text.studies", "== a A\na.rts --sweep spp=1\n");
    scratch_write("two.studies", "== a A\n$ a.rts --sweep spp=1\n"
                                 "== photons P\n$ a.rts --sweep k=3\n");
    scratch_write("good.studies", "== a A\n$ a.rts --sweep spp=1\n");
    for (size_t i = 0; i < sizeof refusals / sizeof *refusals; i++) {
        run run = run_rtc("study %s", refusals[i].line);
        expect_err(&run, refusals[i].says);
        expect_status(&run, refusals[i].status);
        run_free(&run);
    }
    expect_no_file("a.html");
    expect_no_file("a.csv");
    expect_no_file("later.a.csv");
}

/* ---- Files that cannot be written ---------------------------------------------------- */

static void a_folder_that_cannot_be_written_is_status_4(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    mkdir("locked", 0777);
    chmod("locked", 0555);
    scratch_drop_rights();
    run run = run_rtc("study a.rts --sweep spp=1 --out locked/a.html");
    scratch_take_rights();
    expect_status(&run, 4);
    expect_err(&run, "locked/a.html");
    expect_no_err(&run, "1 of 1"); /* before time is spent */
    run_free(&run);
    scratch_write("b.films", "a file where the folder is to be");
    run = run_rtc("study a.rts --sweep spp=1 --out b.html");
    expect_status(&run, 4);
    expect_err(&run, "cannot make the folder b.films/");
    run_free(&run);
}

static void a_full_disk_is_status_4(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    /* The picture is there: without its rights the user has no kernels, and would compile them. */
    run run = run_rtc("study a.rts --sweep spp=1 --out full.html");
    expect_status(&run, 0);
    run_free(&run);
    assert_int_equal(remove("full.html"), 0);
    assert_int_equal(symlink("/dev/full", "full.html"), 0);
    chmod(".", 0777);
    scratch_drop_rights();
    run = run_rtc("study a.rts --sweep spp=1 --out full.html");
    scratch_take_rights();
    expect_status(&run, 4);
    expect_err(&run, "full.html");
    run_free(&run);
}

/* ---- What is written ----------------------------------------------------------------- */

static void every_combination_is_on_the_page_and_in_the_table(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    run run = run_rtc("study a.rts --sweep spp=1,3 --sweep sampler=all --sweep size=1,0.5 "
                      "--seed 4 --out o.html");
    expect_status(&run, 0);
    expect_err(&run, "8 of 8: spp=3,sampler=independent,size=0.5");
    run_free(&run);
    char *table = scratch_read("o.csv"), *page = scratch_read("o.html");
    assert_int_equal(count(table, "\n"), 9);
    assert_int_equal(strncmp(table,
                             "spp,sampler,size,relative_rmse,relmse,flip,ratio,noise,bias,"
                             "reference_error,seconds,command\n1,sobol,1,,,,,,,,",
                             109),
                     0);
    assert_non_null(strstr(table, "rtc a.rts --spp 3 --seed 4 --sampler independent --set "
                                  "'size=0.5'\n"));
    assert_int_equal(count(page, "\"values\":[\"3\",\"independent\","), 2);
    assert_int_equal(count(page, "\"width\":12,\"height\":9,\"data\":\""), 8);
    /* It needs nothing else, and asks nobody. */
    assert_null(strstr(page, "@DATA@"));
    assert_null(strstr(page, "src="));
    assert_null(strstr(page, "url("));
    assert_non_null(strstr(page, "default-src 'none'"));
    free(table);
    free(page);
}

/* `let:` tells a constant from the setting of the same name. */
static void a_constant_called_like_a_setting_is_swept(void **state)
{
    (void)state;
    scratch_write("a.rts", "let spp = 2\n"
                           "camera { eye 0 0 4  look_at 0 0 0 }\n"
                           "film { width 4  height 3 }\n"
                           "material m { emission spp  two_sided true }\n"
                           "sphere { centre 0 0 0  radius 9  material m }\n");
    run run = run_rtc("study a.rts --sweep let:spp=3,5 --sweep spp=1,2 --out o.html");
    expect_status(&run, 0);
    run_free(&run);
    char *table = scratch_read("o.csv");
    assert_int_equal(strncmp(table, "let:spp,spp,", 12), 0);
    assert_non_null(strstr(table, "\n5,2,"));
    assert_non_null(strstr(table, "rtc a.rts --spp 2 --set 'spp=5'\n"));
    free(table);
}

/* A number that `rtc compare --json` prints. */
static double compared(const run *run, const char *name)
{
    char start[64];
    snprintf(start, sizeof start, "\"%s\":", name);
    const char *at = strstr(run->out, start);
    if (!at)
        fail_msg("no %s in %s", start, run->out);
    return strtod(at + strlen(start), NULL);
}

static void commas_in_parentheses_are_of_a_value(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    run run = run_rtc("study a.rts --sweep size=min(0.4,3),0.5 --spp 1");
    expect_status(&run, 0);
    expect_err(&run, "1 of 2: size=min(0.4,3): ");
    expect_err(&run, "2 of 2: size=0.5: ");
    run_free(&run);
}

static void errors_are_those_of_compare(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    run run = run_rtc("a.rts --spp 1024 --seed 77 --out r.pfm");
    expect_status(&run, 0);
    run_free(&run);
    run = run_rtc("study a.rts --sweep spp=1,7 --reference r.pfm");
    expect_status(&run, 0);
    run_free(&run);
    for (size_t row = 0; row < 2; row++) {
        char *command = cell("a.csv", row, "command");
        run = run_rtc("%s --out p.pfm", command + strlen("rtc "));
        expect_status(&run, 0);
        run_free(&run);
        run = run_rtc("compare p.pfm r.pfm --json");
        assert_float_equal(number("a.csv", row, "relmse"), compared(&run, "relmse"), 1e-5);
        assert_float_equal(number("a.csv", row, "flip"), compared(&run, "flip"), 1e-5);
        assert_float_equal(number("a.csv", row, "ratio"), compared(&run, "ratio"), 1e-5);
        run_free(&run);
        free(command);
    }
    assert_true(number("a.csv", 1, "relmse") < number("a.csv", 0, "relmse"));
}

static void each_scene_and_constant_has_its_reference(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    scratch_write("b.rts", "include \"a.rts\"\nlight environment { radiance 0.2 }\n");
    run run = run_rtc("study --sweep spp=64,256 --sweep scene=a.rts,b.rts --sweep size=1,0.5 "
                      "--width 4 --height 3 --reference auto --out o.html");
    expect_status(&run, 0);
    expect_err(&run, "12 of 12: ");
    expect_err(&run, "the reference,scene=b.rts,size=0.5 is rendered by mode path, in about ");
    run_free(&run);
    char *page = scratch_read("o.html"), *at = strstr(page, "\"references\":[");
    assert_non_null(at);
    assert_int_equal(count(at, "--set 'size="), 4);
    assert_int_equal(count(at, "rtc b.rts --mode path --spp 16384"), 2);
    /* By the wrong one, errors would be of the size of the picture. */
    for (size_t row = 0; row < 8; row++)
        assert_true(number("o.csv", row, "relmse") < 0.05);
    free(page);
}

static void each_scene_is_measured_by_its_file(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    scratch_write("b.rts", "include \"a.rts\"\nlight environment { radiance 2 }\n");
    for (int i = 0; i < 2; i++) {
        run run = run_rtc("%s --spp 64 --seed 5 --out %s", i ? "b.rts" : "a.rts",
                          i ? "b.exr --variance" : "a.pfm");
        expect_status(&run, 0);
        run_free(&run);
    }
    run run = run_rtc("study --sweep spp=1,64 --sweep scene=a.rts,b.rts "
                      "--reference a.pfm,b.exr --out o.html");
    expect_status(&run, 0);
    /* Only one of the references states its error, which is that of a picture. */
    expect_err(&run, "rtc: warning: the reference,scene=b.rts has an error of its own, ");
    assert_int_equal(count(run.err, "error of its own"), 1);
    run_free(&run);
    expect_in_file("o.html", ",\"coarse\":true}");
    for (size_t row = 2; row < 4; row++)
        assert_true(number("o.csv", row, "relmse") < 0.1);
    /* The other way round each is measured by the wrong one. */
    run = run_rtc("study --sweep spp=1,64 --sweep scene=a.rts,b.rts "
                  "--reference b.exr,a.pfm --out o.html");
    expect_status(&run, 0);
    run_free(&run);
    assert_true(number("o.csv", 3, "relmse") > 10);
}

static void what_cannot_be_measured_is_told_before_rendering(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    run run = run_rtc("a.rts --spp 1 --width 20 --out r.pfm");
    expect_status(&run, 0);
    run_free(&run);
    run = run_rtc("study a.rts --sweep spp=1,2 --reference r.pfm");
    expect_status(&run, 2);
    expect_err(&run, "--reference r.pfm has 20x9 pixels, but the pictures have 12x9");
    expect_err(&run, "--width 20 --height 9");
    expect_no_err(&run, "spp=1: ");
    run_free(&run);
}

static void a_setting_without_effect_in_any_picture_is_warned_of(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    run run = run_rtc("study a.rts --sweep k=5,10 --spp 1");
    expect_status(&run, 0);
    expect_err(&run, "rtc: warning: --k has no effect without --mode photon\n1 of 2: ");
    run_free(&run);
    run = run_rtc("study a.rts --sweep kernel=box,cone --spp 1 --quiet");
    expect_status(&run, 0);
    expect_no_err(&run, "no effect");
    run_free(&run);
    run = run_rtc("study a.rts --sweep mode=path,photon --k 5 --photons 100 --spp 1");
    expect_status(&run, 0);
    expect_no_err(&run, "no effect");
    run_free(&run);
}

/* ---- Measures ------------------------------------------------------------------------- */

static void noise_is_told_from_bias(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    run run = run_rtc("study a.rts --sweep mode=path,photon --spp 16 --photons 3000 --k 400 "
                      "--direct photons --repeat 4 --width 8 --height 6 --reference auto");
    expect_status(&run, 0);
    run_free(&run);
    assert_true(number("a.csv", 0, "noise") > 0);
    /* Path tracing has no bias beyond what noise hides; so few photons blur all. */
    assert_true(number("a.csv", 0, "bias") < number("a.csv", 0, "noise") / 2);
    assert_true(number("a.csv", 1, "bias") > 2 * number("a.csv", 1, "noise"));
    expect_file("a.films/mode=photon+3.rtpart");
}

static void equal_time_is_that_of_the_first_picture(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    run run = run_rtc("study a.rts --sweep sampler=all --sweep max-depth=8,4 --spp 1000 "
                      "--equal time");
    expect_status(&run, 0);
    run_free(&run);
    char time[64];
    const double first = number("a.csv", 0, "seconds");
    snprintf(time, sizeof time, "--spp 16777216 --time %.6g", first);
    assert_true(first > 0);
    for (size_t row = 1; row < 4; row++) {
        char *command = cell("a.csv", row, "command");
        if (!strstr(command, "--spp 16777216") || !strstr(command, strstr(time, "--time")))
            fail_msg("no '%s' in '%s'", time, command);
        assert_true(number("a.csv", row, "seconds") >= 0.9 * first);
        free(command);
    }
    run = run_rtc("study a.rts --sweep sampler=all --sweep max_depth=8,4 --spp 1000 "
                  "--equal time");
    expect_count(&run, 4);
    run_free(&run);
}

/* ---- What is kept --------------------------------------------------------------------- */

static void expect_kept(const char *line, size_t kept, size_t all)
{
    run run = run_rtc("study %s", line);
    char last[64];
    snprintf(last, sizeof last, "%zu of %zu: ", all, all);
    expect_status(&run, 0);
    expect_err(&run, last);
    expect_count(&run, kept);
    run_free(&run);
}

static void only_what_changed_is_rendered_again(void **state)
{
    (void)state;
    static const char line[] = "a.rts --sweep spp=1,2 --width 8 --height 6 --reference auto";
    scratch_write("a.rts", scene);
    expect_kept(line, 0, 3);
    expect_kept(line, 3, 3);
    expect_kept("a.rts --sweep spp=1,2,4 --width 8 --height 6 --reference auto", 3, 4);
    expect_kept("a.rts --sweep spp=1,2 --seed 3 --width 8 --height 6 --reference auto", 1, 3);
    expect_kept(line, 1, 3);
    /* Another scene under the same name, and a film that is damaged. */
    scratch_write("b.rts", "sphere { centre 1 1 0  radius 0.2  material white }\n");
    char *text = malloc(sizeof scene + 32);
    snprintf(text, sizeof scene + 32, "%s%s", scene, "include \"b.rts\"\n");
    scratch_write("a.rts", text);
    free(text);
    expect_kept(line, 0, 3);
    scratch_write("a.films/spp=2.rtpart", "damaged");
    expect_kept(line, 2, 3);
}

static void a_long_name_has_a_film_of_its_own(void **state)
{
    (void)state;
    char line[1024];
    scratch_write("a.rts", scene);
    scratch_write("x_y.rts", scene);
    mkdir("x", 0777);
    scratch_write("x/y.rts", "include \"../a.rts\"\nlight environment { radiance 1 }\n");
    expect_kept("--sweep scene=x_y.rts,x/y.rts --spp 1 --out o.html", 0, 2);
    expect_kept("--sweep scene=x_y.rts,x/y.rts --spp 1 --out o.html", 2, 2);
    snprintf(line, sizeof line, "a.rts --spp 1 --sweep size=1,%0300d,%0301d", 2, 3);
    expect_kept(line, 0, 3);
    expect_kept(line, 3, 3);
}

static void a_study_goes_on_where_it_ended(void **state)
{
    (void)state;
    static const int signals[] = {SIGKILL, SIGINT};
    static const char line[] = "study a.rts --sweep spp=1,2,3000 --out %s.html";
    scratch_write("a.rts", scene);
    for (int i = 0; i < 2; i++) {
        char said[4096] = "";
        const char *name = i == 0 ? "k" : "i";
        running running = start_rtc(line, name);
        assert_int_equal(running_wait_for(&running, "2 of 3", said, sizeof said), 0);
        kill(running.pid, signals[i]);
        const int status = running_finish(&running, said, sizeof said);
        assert_int_equal(status, i == 0 ? 128 + SIGKILL : 130);
        run run = run_rtc(line, name);
        expect_status(&run, 0);
        expect_count(&run, 2);
        run_free(&run);
    }
}

/* ---- Lists ---------------------------------------------------------------------------- */

/* Interrupts a study of one picture that would last for hours; returns how many samples it has. */
static double interrupt_study(void)
{
    static char said[1 << 20];
    char *from = said;
    said[0] = '\0';
    running running = start_rtc("study a.rts --sweep spp=16000000 --progress json");
    for (int reports = 0; reports < 3; reports++) {
        const size_t room = sizeof said - (size_t)(from - said);
        assert_int_equal(running_wait_for(&running, "\"render\"", from, room), 0);
        from = strstr(from, "\"render\"") + 1;
    }
    assert_int_equal(kill(running.pid, SIGINT), 0);
    assert_int_equal(running_finish(&running, said, sizeof said), 130);
    assert_non_null(strstr(said, " % of spp=16000000 is kept: the study goes on from there"));
    run run = run_rtc("info a.films/spp=16000000.unfinished.rtpart");
    expect_status(&run, 0);
    double done;
    assert_int_equal(sscanf(strstr(run.out, "done: "), "done: %lf", &done), 1);
    run_free(&run);
    return done;
}

static void an_interrupted_picture_goes_on(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    const double first = interrupt_study();
    assert_true(first > 0 && interrupt_study() > first);
    expect_no_file("a.films/spp=16000000.rtpart");
}

/* What is left of a picture that was begun makes the same bits as a render at once. */
static void an_unfinished_picture_is_finished(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    scratch_write("b.rts", scene);
    run run = run_rtc("study a.rts --sweep spp=64");
    expect_status(&run, 0);
    run_free(&run);
    assert_int_equal(mkdir("b.films", 0777), 0);
    run = run_rtc("b.rts --spp 64 --part 1/2 --out b.films/spp=64.unfinished.rtpart");
    expect_status(&run, 0);
    run_free(&run);
    run = run_rtc("study b.rts --sweep spp=64");
    expect_status(&run, 0);
    run_free(&run);
    expect_no_file("b.films/spp=64.unfinished.rtpart");
    run = run_rtc("merge a.films/spp=64.rtpart --out a.pfm");
    expect_status(&run, 0);
    run_free(&run);
    run = run_rtc("merge b.films/spp=64.rtpart --out b.pfm");
    expect_status(&run, 0);
    run_free(&run);
    expect_same_files("a.pfm", "b.pfm");
}

static void a_list_is_read_in_full_quickly_or_for_one_study(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    scratch_write("l.studies", "== one One\n$ a.rts --sweep spp=1,2 --seed 3\n"
                               "$full --width 10\n$quick --width 5 --seed 4\n");
    run run = run_rtc("study --list l.studies");
    expect_status(&run, 0);
    run_free(&run);
    expect_in_file("l.one.csv", "--seed 3 --width 10\n");
    run = run_rtc("study --list l.studies --quick");
    expect_status(&run, 0);
    run_free(&run);
    expect_in_file("l.one.csv", "--seed 4 --width 5\n");
    scratch_write("m.studies", "== one One\n$ none.rts --sweep spp=1\n"
                               "== two Two\n$ a.rts --sweep spp=1\n");
    run = run_rtc("study --list m.studies --only two --out m.html");
    expect_status(&run, 0);
    run_free(&run);
    expect_file("m.two.csv");
}

static void a_list_makes_one_page_of_all_its_studies(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    scratch_write("l.studies",
                  "# comment\n= All <of> them\n== one The \"first\"\nA text\nof lines.\n"
                  "$ a.rts --sweep spp=1,2 --reference auto\n"
                  "== two Second\n$ a.rts --sweep size=1,0.5\n"
                  "$ --spp 9 --reference auto\n");
    run run = run_rtc("study --list l.studies --width 8 --height 6 --out p.html");
    expect_status(&run, 0);
    expect_err(&run, "study 2 of 2: Second");
    expect_err(&run, "7 of 7: ");
    /* The same reference serves both. */
    expect_err(&run, "reference: ");
    expect_count(&run, 0);
    run_free(&run);
    expect_in_file("p.html", "\"title\":\"All \\u003cof> them\"");
    expect_in_file("p.html", "\"title\":\"The \\u0022first\\u0022\"");
    expect_in_file("p.html", "\"text\":\"A text of lines.\"");
    expect_in_file("p.html", "\"width\":8,\"height\":6");
    expect_in_file("p.two.csv", "rtc a.rts --spp 9 --width 8 --height 6 --set 'size=0.5'");
    expect_file("p.films/one,spp=2.rtpart");
    expect_file("p.one.csv");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_enter, scratch_leave)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(wrong_input_is_refused),
        TEST(a_folder_that_cannot_be_written_is_status_4),
        TEST(a_full_disk_is_status_4),
        TEST(every_combination_is_on_the_page_and_in_the_table),
        TEST(a_constant_called_like_a_setting_is_swept),
        TEST(commas_in_parentheses_are_of_a_value),
        TEST(errors_are_those_of_compare),
        TEST(each_scene_and_constant_has_its_reference),
        TEST(each_scene_is_measured_by_its_file),
        TEST(what_cannot_be_measured_is_told_before_rendering),
        TEST(a_setting_without_effect_in_any_picture_is_warned_of),
        TEST(noise_is_told_from_bias),
        TEST(equal_time_is_that_of_the_first_picture),
        TEST(only_what_changed_is_rendered_again),
        TEST(a_long_name_has_a_film_of_its_own),
        TEST(a_study_goes_on_where_it_ended),
        TEST(an_interrupted_picture_goes_on),
        TEST(an_unfinished_picture_is_finished),
        TEST(a_list_is_read_in_full_quickly_or_for_one_study),
        TEST(a_list_makes_one_page_of_all_its_studies),
    };
    return spawn_find_rtc() == 0 ? cmocka_run_group_tests(tests, NULL, NULL) : 1;
}
