/* test_import_spectra.c - spectra by wavelength of Mitsuba and pbrt, as colours. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "expect.h"
#include "lib/image/scratch.h"
#include "spawn.h"

/* The three numbers behind a field of the scene that an import made of a file. */
static void read_colour(const char *name, const char *field, double out[3])
{
    char line[256], word[32];
    run run = run_rtc("import %s --out colour.rts", name);
    expect_status(&run, 0);
    run_free(&run);
    FILE *file = fopen("colour.rts", "r");
    assert_non_null(file);
    snprintf(word, sizeof word, " %s ", field);
    int found = 0;
    while (!found && fgets(line, sizeof line, file)) {
        const char *at = strstr(line, word);
        found = at && sscanf(at + strlen(word), "%lf %lf %lf", &out[0], &out[1], &out[2]) == 3;
    }
    fclose(file);
    assert_true(found);
}

static void read_mitsuba(const char *spectrum, int is_emission, double out[3])
{
    char text[1024];
    snprintf(text, sizeof text, "<scene>\n<shape type=\"sphere\">%s%s%s</shape></scene>\n",
             is_emission ? "<emitter type=\"area\">" : "<bsdf type=\"diffuse\">", spectrum,
             is_emission ? "</emitter>" : "</bsdf>");
    scratch_write("s.xml", text);
    read_colour("s.xml", is_emission ? "radiance" : "kd", out);
}

static void expect_colour(const double made[3], double r, double g, double b, double part)
{
    const double right[3] = {r, g, b};
    for (int c = 0; c < 3; c++)
        if (!(fabs(made[c] - right[c]) <= part * fabs(right[c])))
            fail_msg("%g %g %g, expected %g %g %g", made[0], made[1], made[2], r, g, b);
}

/*
 * What reflects all wavelengths alike is grey, and half of it half as much; what emits them alike
 * has the colour of X = Y = Z = 2, whose red is 2 (3.24045 - 1.53714 - 0.49853).
 */
static void even_spectra_have_their_colours(void **state)
{
    double rgb[3];
    (void)state;
    read_mitsuba("<spectrum name=\"reflectance\" value=\"360:0.5, 830:0.5\"/>", 0, rgb);
    expect_colour(rgb, 0.5, 0.5, 0.5, 5e-4);
    read_mitsuba("<spectrum name=\"radiance\" value=\"360:2, 830:2\"/>", 1, rgb);
    expect_colour(rgb, 2.40957, 1.89660, 1.81779, 5e-4);
    read_mitsuba("<spectrum name=\"radiance\" value=\"2\"/>", 1, rgb);
    expect_colour(rgb, 2.40957, 1.89660, 1.81779, 5e-4);
    read_mitsuba("<spectrum name=\"reflectance\" value=\"0.5\"/>", 0, rgb);
    expect_colour(rgb, 0.5, 0.5, 0.5, 1e-7);
}

/* One spectrum in each way of writing it; the colours are those of Mitsuba 3, to 0.2 %. */
static void spectra_are_read_in_every_form(void **state)
{
    static const char *const forms[] = {
        "<spectrum name=\"reflectance\" value=\"400:0.1, 500:.3, 600:.6 700:.8\"/>",
        "<spectrum name=\"reflectance\" filename=\"s.spd\"/>",
        "<spectrum name=\"reflectance\" type=\"regular\"><float name=\"wavelength_min\" "
        "value=\"400\"/><float name=\"wavelength_max\" value=\"700\"/><string name=\"values\" "
        "value=\"0.1, 0.3, 0.6, 0.8\"/></spectrum>",
        "<spectrum name=\"reflectance\" type=\"irregular\"><string name=\"wavelengths\" "
        "value=\"400 500 600 700\"/><string name=\"values\" value=\"0.1 0.3 0.6 0.8\"/></spectrum>",
    };
    double rgb[3];
    (void)state;
    scratch_write("s.spd", "# a spectrum\n400 0.1\n500 0.3 # green\n600 0.6\n700 0.8\n");
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        read_mitsuba(forms[i], 0, rgb);
        expect_colour(rgb, 0.70561, 0.42654, 0.17420, 2e-3);
    }
    read_mitsuba("<spectrum name=\"radiance\" value=\"400:0, 500:8, 600:15.6, 700:18.4\"/>", 1,
                 rgb);
    expect_colour(rgb, 20.7108, 10.8546, 2.77115, 2e-3);
}

/* A black body of 2856 K has the chromaticity of the illuminant A, and at 560 nm Planck's value. */
static void black_bodies_have_their_colours(void **state)
{
    double rgb[3], xyz[3];
    static const double m[3][3] = {
        {0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};
    (void)state;
    read_mitsuba("<spectrum name=\"radiance\" type=\"blackbody\"><float name=\"temperature\" "
                 "value=\"2856\"/></spectrum>",
                 1, rgb);
    for (int i = 0; i < 3; i++)
        xyz[i] = m[i][0] * rgb[0] + m[i][1] * rgb[1] + m[i][2] * rgb[2];
    assert_true(fabs(xyz[0] / (xyz[0] + xyz[1] + xyz[2]) - 0.4476) < 1e-3);
    assert_true(fabs(xyz[1] / (xyz[0] + xyz[1] + xyz[2]) - 0.4075) < 1e-3);
    /* its luminance at 683 lm/W by the integral of y, 106.857 nm: 1.26e7 cd/m^2 (CIE A's) */
    const double planck = 1.1910429724e20 / pow(560, 5) / expm1(1.438776877e7 / (560 * 2856.0));
    assert_true(xyz[1] / planck > 0.9 && xyz[1] / planck < 1.1);
}

/* Indices of metals are not bounded as reflectances are. */
static void indices_of_metals_may_be_above_1(void **state)
{
    double rgb[3];
    (void)state;
    scratch_write("k.xml", "<scene><shape type=\"sphere\"><bsdf type=\"conductor\"><spectrum "
                           "name=\"eta\" value=\"360:2, 830:2\"/><spectrum name=\"k\" "
                           "value=\"360:6.5, 830:6.5\"/></bsdf></shape></scene>\n");
    read_colour("k.xml", "k", rgb);
    expect_colour(rgb, 6.5, 6.5, 6.5, 1e-3);
    scratch_write("k.pbrt", "WorldBegin\nMaterial \"conductor\" \"spectrum eta\" [360 2 830 2] "
                            "\"spectrum k\" [360 6.5 830 6.5]\nShape \"sphere\"\n");
    read_colour("k.pbrt", "k", rgb);
    expect_colour(rgb, 6.5, 6.5, 6.5, 1e-3);
    scratch_write("odd.pbrt", "WorldBegin\nMaterial \"diffuse\" \"spectrum reflectance\" "
                              "[400 .1 500]\nShape \"sphere\"\n");
    run run = run_rtc("import odd.pbrt --out odd.rts");
    expect_status(&run, 0);
    expect_err(&run, "odd.pbrt:2: a spectrum of 3 numbers became white: wavelengths and values are "
                     "pairs");
    run_free(&run);
}

static void colours_that_srgb_lacks_are_told(void **state)
{
    (void)state;
    scratch_write("laser.xml", "<scene>\n<shape type=\"sphere\"><bsdf type=\"diffuse\">\n<spectrum "
                               "name=\"reflectance\" value=\"500:1, 510:1\"/></bsdf></shape>"
                               "</scene>\n");
    run run = run_rtc("import laser.xml --out laser.rts");
    expect_status(&run, 0);
    expect_err(&run, "laser.xml:3: a spectrum has a colour that sRGB lacks: the nearest is taken");
    run_free(&run);
}

static void wrong_spectra_are_told(void **state)
{
    static const struct {
        const char *spectrum, *says;
    } cases[] = {
        {"value=\"500:1, 400:1\"", "the wavelengths of a spectrum do not rise at 400"},
        {"value=\"500:1, 510\"", "expected wavelength:value pairs"},
        {"value=\"500:nan\"", "expected wavelength:value pairs"},
        {"filename=\"nothing.spd\"", "cannot read nothing.spd: No such file or directory"},
        {"filename=\"empty.spd\"", "a spectrum without values"},
    };
    (void)state;
    scratch_write("empty.spd", "# nothing\n");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[512];
        snprintf(text, sizeof text,
                 "<scene><shape type=\"sphere\"><bsdf type=\"diffuse\"><spectrum "
                 "name=\"reflectance\" %s/></bsdf></shape></scene>\n",
                 cases[i].spectrum);
        scratch_write("wrong.xml", text);
        run run = run_rtc("import wrong.xml --out wrong.rts");
        expect_status(&run, 1);
        expect_err(&run, cases[i].says);
        run_free(&run);
    }
}

/* pbrt's lights have the colour of a spectrum, of luminance 1. */
static void spectra_of_pbrt_are_read(void **state)
{
    double rgb[3];
    (void)state;
    scratch_write("s.pbrt",
                  "WorldBegin\nLightSource \"infinite\" \"spectrum L\" [360 3 830 3]\n"
                  "Material \"diffuse\" \"spectrum reflectance\" [400 .1 500 .3 600 .6 700 .8]\n"
                  "Shape \"sphere\"\n");
    read_colour("s.pbrt", "kd", rgb);
    expect_colour(rgb, 0.70561, 0.42654, 0.17420, 2e-3);
    read_colour("s.pbrt", "radiance", rgb);
    expect_colour(rgb, 1.20478, 0.94830, 0.90889, 1e-3);
    scratch_write("s.spd", "400 .1\n500 .3\n600 .6\n700 .8\n");
    scratch_write("f.pbrt", "WorldBegin\nMaterial \"diffuse\" \"spectrum reflectance\" \"s.spd\"\n"
                            "Shape \"sphere\"\n");
    read_colour("f.pbrt", "kd", rgb);
    expect_colour(rgb, 0.70561, 0.42654, 0.17420, 2e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(even_spectra_have_their_colours),
        cmocka_unit_test(spectra_are_read_in_every_form),
        cmocka_unit_test(black_bodies_have_their_colours),
        cmocka_unit_test(indices_of_metals_may_be_above_1),
        cmocka_unit_test(colours_that_srgb_lacks_are_told),
        cmocka_unit_test(wrong_spectra_are_told),
        cmocka_unit_test(spectra_of_pbrt_are_read),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests(tests, scratch_enter, scratch_leave);
}
