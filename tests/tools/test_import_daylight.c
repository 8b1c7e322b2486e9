/*
 * test_import_daylight.c - sun and sky of Mitsuba: the sky of Hosek and Wilkie is that of Mitsuba
 * 3.9, which was asked for these radiances, the sun has its irradiance whatever the size of its
 * disc, and that of Mitsuba 0.x follows Preetham's formula.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <math.h>

#include <cmocka.h>

#include "expect.h"
#include "lib/image/scratch.h"
#include "spawn.h"
#include "tools/imported_pixel.h"

static const double pi = 3.14159265358979323846;

/* A scene of one pixel that looks along d from high above a floor, y upwards, under this light. */
static void write_scene(const char *version, const double d[3], const char *type,
                        const char *inside)
{
    char text[2048];
    snprintf(text, sizeof text,
             "<scene version=\"%s\"><sensor type=\"perspective\"><float name=\"fov\" "
             "value=\"0.01\"/><transform name=\"toWorld\"><lookat origin=\"0,9,0\" "
             "target=\"%.9g,%.9g,%.9g\" up=\"0.3,0.4,0.5\"/></transform><film type=\"hdrfilm\">"
             "<integer name=\"width\" value=\"1\"/><integer name=\"height\" value=\"1\"/></film>"
             "</sensor><shape type=\"rectangle\"><transform name=\"toWorld\"><rotate x=\"1\" "
             "angle=\"-90\"/></transform></shape><emitter type=\"%s\">%s</emitter></scene>",
             version, d[0], 9 + d[1], d[2], type, inside);
    scratch_write("t.xml", text);
}

static void expect_colour(const double wanted[3], double relative)
{
    double rgb[3];
    imported_colour("t.xml", rgb);
    for (int c = 0; c < 3; c++)
        if (fabs(rgb[c] - wanted[c]) > relative * wanted[c])
            fail_msg("%g %g %g, not %g %g %g", rgb[0], rgb[1], rgb[2], wanted[0], wanted[1],
                     wanted[2]);
}

/* Its z is up, unless its transform says else; by the place of the sun, or by date and time. */
static void skies_are_those_of_mitsuba(void **state)
{
    static const char by_sun[] = "<float name=\"turbidity\" value=\"5.3\"/><rgb name=\"albedo\" "
                                 "value=\".2 .5 .1\"/><vector name=\"sun_direction\" value=\"1 .4 "
                                 ".3\"/><float name=\"sun_scale\" value=\"0\"/>",
                      by_time[] = "<float name=\"sky_scale\" value=\"2\"/><float name=\"hour\" "
                                  "value=\"8\"/><float name=\"minute\" value=\"30\"/><float "
                                  "name=\"latitude\" value=\"50\"/><float name=\"longitude\" "
                                  "value=\"8\"/><float name=\"timezone\" value=\"2\"/><transform "
                                  "name=\"to_world\"><rotate x=\"1\" angle=\"-90\"/></transform>"
                                  "<float name=\"sun_scale\" value=\"0\"/>";
    static const struct {
        const char *inside;
        double d[3], rgb[3];
    } cases[] = {{by_sun, {0, 1, 2}, {0.02019973, 0.03358523, 0.0466714}},
                 {by_sun, {1, 0.2, 0.6}, {0.24025884, 0.22747213, 0.17260253}},
                 {by_sun, {-3, 1, 1}, {0.05293868, 0.08279233, 0.09406944}},
                 {by_sun, {0, 2, -1}, {0, 0, 0}},
                 {by_time, {0, 1, 2}, {0.49165583, 0.52505, 0.5057649}},
                 {by_time, {1, 0.2, 0.6}, {0.18155642, 0.26807275, 0.35094914}},
                 {by_time, {-3, 1, 1}, {0.12140293, 0.19278264, 0.2838796}},
                 {by_time, {0, 2, -1}, {0.03098426, 0.06167142, 0.12016804}}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_scene("3.0.0", cases[i].d, "sunsky", cases[i].inside);
        expect_colour(cases[i].rgb, 0.002);
    }
}

/* At 8:30 in July at 50 degrees north, 8 east. A white floor shows the irradiance by pi. */
static void the_sun_has_its_irradiance(void **state)
{
    static const double sun[3] = {-0.0697455, -0.897463, 0.43554}, down[3] = {0, -1, 0},
                        irradiance[3] = {1.35366981, 1.04196153, 0.66001074},
                        radiance[3] = {353.66513, 272.227, 172.43701};
    static const double apertures[] = {4, 0.5358, 0.01};
    (void)state;
    for (size_t i = 0; i < sizeof apertures / sizeof *apertures; i++) {
        char inside[400];
        double reflected[3];
        snprintf(inside, sizeof inside,
                 "<vector name=\"sun_direction\" x=\"%g\" y=\"%g\" z=\"%g\"/><float "
                 "name=\"sun_aperture\" value=\"%g\"/><float name=\"sky_scale\" value=\"0\"/>"
                 "<transform name=\"to_world\"><rotate x=\"1\" angle=\"-90\"/></transform>",
                 sun[0], sun[2], -sun[1], apertures[i]);
        for (int c = 0; c < 3; c++)
            reflected[c] = 0.5 * irradiance[c] * sun[2] / pi;
        write_scene("3.0.0", down, "sunsky", inside);
        expect_colour(reflected, i == 0 ? 0.06 : 0.02); /* one sample of a disc of 4 degrees */
        if (i == 0) {
            const double towards[3] = {sun[0], sun[2], -sun[1]};
            write_scene("3.0.0", towards, "sunsky", inside);
            expect_colour(radiance, 0.002);
        }
    }
}

/* Its straight above is y, its sun that of Preetham, which a radius of 0 makes a direction. */
static void sun_and_sky_of_older_scenes(void **state)
{
    static const char high[] = "<vector name=\"sunDirection\" x=\"0\" y=\"1\" z=\"1\"/>",
                      low[] = "<float name=\"turbidity\" value=\"6\"/><float name=\"scale\" "
                              "value=\"2\"/><vector name=\"sunDirection\" x=\"0\" "
                              "y=\"0.17364818\" z=\"0.98480775\"/>";
    static const double down[3] = {0, -1, 0}, above[3] = {0, 1, 0}, pole[3] = {0, -1, 0.001};
    const double noon[3] = {1.31354, 1.08010, 0.87257},
                 evening[3] = {0.1110718, 0.0467089, 0.0097203};
    double lit[3], rgb[3];
    (void)state;
    for (int c = 0; c < 3; c++)
        lit[c] = 0.5 * noon[c] * sqrt(0.5) / pi;
    write_scene("0.6.0", pole, "sun", high);
    expect_colour(lit, 1e-3);
    for (int c = 0; c < 3; c++)
        lit[c] = 0.5 * 2 * evening[c] * 0.17364818 / pi;
    write_scene("0.6.0", pole, "sun", low);
    expect_colour(lit, 2e-3);
    run run = run_rtc("import t.xml --out u.rts");
    expect_err(&run,
               "t.xml:1: the sun became a direction: its shadows are sharp, and mirrors lack");
    run_free(&run);
    write_scene("0.6.0", above, "sky", high);
    imported_colour("t.xml", rgb);
    assert_true(rgb[2] > 1.5 * rgb[1] && rgb[1] > rgb[0] && rgb[0] > 0.01);
    write_scene("0.6.0", down, "sunsky",
                "<float name=\"sunRadiusScale\" value=\"0\"/><float name=\"skyScale\" "
                "value=\"0\"/><vector name=\"sunDirection\" x=\"0\" y=\"1\" z=\"1\"/>");
    expect_rtc(0, "import t.xml --out u.rts");
    expect_in_file("u.rts", "light directional { direction 0 -0.70710677 -0.70710677");
}

static void what_a_sky_cannot_be_is_told(void **state)
{
    static const double above[3] = {0, 1, 0};
    static const struct {
        const char *inside, *told;
    } cases[] = {
        {"<float name=\"hour\" value=\"23\"/>",
         "t.xml:1: the sun is below the horizon, where 'sunsky' has no light"},
        {"<float name=\"sun_scale\" value=\"-1\"/>", "t.xml:1: a sun_scale of -1 is taken as 0"},
        {"<rgb name=\"albedo\" value=\"2 0 0\"/>",
         "t.xml:1: an albedo of the ground outside of 0 to 1 is brought there"},
        {"<vector name=\"sun_direction\" value=\"0 0 0\"/>",
         "t.xml:1: the direction of the sun is zero: it stands straight above"},
        {"<float name=\"turbidity\" value=\"30\"/>", "t.xml:1: a turbidity of 30 is taken as 10"},
        {"<float name=\"hour\" value=\"9\"/><vector name=\"sun_direction\" x=\"1\" "
         "y=\"0\" z=\"1\"/>",
         "t.xml:1: the time and the place are left out beside sun_direction"},
        {"<float name=\"hour\" value=\"99\"/>",
         "t.xml:1: there is no hour 99: the sun stands where"},
        {"<float name=\"latitude\" value=\"-91\"/>", "t.xml:1: there is no latitude -91: the sun"},
        {"<boolean name=\"complex_sun\" value=\"true\"/>", "t.xml:1: the disc of the sun is even"},
        {"<float name=\"huor\" value=\"9\"/>", "did you mean 'hour'?"}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_scene("3.0.0", above, "sunsky", cases[i].inside);
        run run = run_rtc("import t.xml --out t.rts");
        expect_status(&run, 0);
        expect_err(&run, cases[i].told);
        expect_no_err(&run, "an even white sky");
        run_free(&run);
        expect_rtc(0, "check t.rts");
    }
    write_scene("3.0.0", above, "sunsky", "<integer name=\"year\" value=\"100000\"/>");
    run run = run_rtc("import t.xml --out t.rts");
    expect_status(&run, 1);
    expect_err(&run, "t.xml:1: there is no year 100000");
    run_free(&run);
    write_scene("3.0.0", above, "sunsky", "</emitter><emitter type=\"sunsky\">");
    run = run_rtc("import t.xml --out t.rts");
    expect_err(&run, "t.xml:1: a second environment light is left out");
    run_free(&run);
}

#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, scratch_enter, scratch_leave)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_SCRATCH(skies_are_those_of_mitsuba),
        IN_SCRATCH(the_sun_has_its_irradiance),
        IN_SCRATCH(sun_and_sky_of_older_scenes),
        IN_SCRATCH(what_a_sky_cannot_be_is_told),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests_name("import_daylight", tests, NULL, NULL);
}
