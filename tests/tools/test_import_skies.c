/*
 * test_import_skies.c - a bright pixel of an imported sky is seen where the other program has it,
 * and what a sky cannot be turned by is told.
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

/* A scene of Mitsuba that looks along d, with its sky turned by these steps. */
static void write_mitsuba(const double d[3], const char *steps)
{
    char text[2048];
    snprintf(text, sizeof text,
             "<scene version=\"3.0.0\"><sensor type=\"perspective\"><float name=\"fov\" "
             "value=\"0.01\"/><transform name=\"to_world\"><lookat origin=\"0,0,0\" "
             "target=\"%.9g,%.9g,%.9g\" up=\"0.3,0.4,0.5\"/></transform><film type=\"hdrfilm\">"
             "<integer name=\"width\" value=\"1\"/><integer name=\"height\" value=\"1\"/></film>"
             "</sensor><shape type=\"sphere\"><point name=\"center\" x=\"0\" y=\"0\" "
             "z=\"1000\"/></shape><emitter type=\"envmap\"><string name=\"filename\" "
             "value=\"sky.ppm\"/><float name=\"scale\" value=\"3\"/><transform "
             "name=\"to_world\">%s</transform></emitter></scene>",
             d[0], d[1], d[2], steps);
    scratch_write("t.xml", text);
}

/* Its columns begin towards -z; its first and last row are the poles. */
static void mitsuba_has_rows_at_the_poles(void **state)
{
    enum { width = 16, height = 8 };
    (void)state;
    for (int row = 0; row < height; row += 2) {
        const double longitude = 2 * pi * 3.5 / width, polar = pi * row / (height - 1);
        const double d[3] = {sin(polar) * sin(longitude), cos(polar), -sin(polar) * cos(longitude)};
        const double about_x[3] = {d[0], -d[2], d[1]}, mirrored_about_z[3] = {-d[1], -d[0], d[2]};
        if (row == 0)
            continue;
        write_one_pixel("sky.ppm", width, height, 3, row);
        write_mitsuba(d, "");
        assert_true(fabs(imported_pixel("t.xml") - 3) < 0.06);
        write_mitsuba(about_x, "<rotate x=\"1\" angle=\"90\"/>");
        assert_true(fabs(imported_pixel("t.xml") - 3) < 0.06);
        write_mitsuba(mirrored_about_z, "<scale x=\"-1\"/><rotate z=\"1\" angle=\"90\"/>");
        assert_true(fabs(imported_pixel("t.xml") - 3) < 0.06);
    }
}

static void what_is_no_rotation_is_told(void **state)
{
    static const double ahead[3] = {0, 0, 1};
    (void)state;
    write_one_pixel("sky.ppm", 4, 2, 0, 0);
    write_mitsuba(ahead, "<rotate y=\"2\" angle=\"90\"/>");
    run run = run_rtc("import t.xml --out t.rts");
    expect_status(&run, 0);
    run_free(&run);
    expect_in_file("t.rts", "the axis of a rotation has the length 2");
    expect_in_file("t.rts", "the transform of a sky is left out: it is not a rotation");
    expect_rtc(0, "check t.rts");
    write_mitsuba(ahead, "<scale value=\"2\"/><rotate x=\"1\" angle=\"30\"/>");
    expect_rtc(0, "import t.xml --out t.rts");
    expect_in_file("t.rts", "the scale of an envmap's to_world");
    expect_in_file("t.rts", "-1 0 0 0 0 0.8660254 0.5 0 0 0.5 -0.8660254 0");
    expect_rtc(0, "check t.rts");
}

/* A scene of pbrt that looks along d. */
static void write_pbrt(const double d[3], const char *first, const char *turn, const char *image)
{
    char text[1024];
    snprintf(text, sizeof text,
             "%s\nLookAt 0 0 0  %.9g %.9g %.9g  0.3 0.4 0.5\n"
             "Camera \"perspective\" \"float fov\" 0.01\n"
             "Film \"rgb\" \"integer xresolution\" 1 \"integer yresolution\" 1\n"
             "WorldBegin\nAttributeBegin\n%s\nLightSource \"infinite\" \"string %s\" \"sky.ppm\"\n"
             "AttributeEnd\nTranslate 0 0 1000\nShape \"sphere\"\n",
             first, d[0], d[1], d[2], turn, image);
    scratch_write("t.pbrt", text);
}

/* z is up, and the columns begin towards x; the camera may be mirrored or not. */
static void skies_of_pbrt_have_z_upwards(void **state)
{
    static const char *const first[] = {"", "Scale -1 1 1"};
    enum { width = 16, height = 8 };
    const double longitude = 2 * pi * 2.5 / width, polar = pi * 3.5 / height;
    const double d[3] = {sin(polar) * cos(longitude), sin(polar) * sin(longitude), cos(polar)};
    const double turned[3] = {d[0], -d[2], d[1]};
    (void)state;
    write_one_pixel("sky.ppm", width, height, 2, 3);
    for (int i = 0; i < 2; i++) {
        write_pbrt(d, first[i], "", "mapname");
        assert_true(fabs(imported_pixel("t.pbrt") - 1) < 1e-3);
        write_pbrt(turned, first[i], "Rotate 90 1 0 0", "mapname");
        assert_true(fabs(imported_pixel("t.pbrt") - 1) < 1e-3);
    }
}

/* Of a square of four pixels each is a quarter of the sphere, from pole to pole. */
static void octahedral_skies_are_unfolded(void **state)
{
    static const double low[3] = {-1, 1, -0.7}, high[3] = {-1, 1, 0.7}, other[3] = {1, 1, 0.7},
                        bottom[3] = {-0.3, 0.3, -0.9}, top[3] = {-0.3, 0.3, 0.9};
    (void)state;
    write_one_pixel("sky.ppm", 2, 2, 0, 1);
    write_pbrt(low, "", "", "filename");
    assert_true(fabs(imported_pixel("t.pbrt") - 1) < 0.05);
    expect_in_file("t.rts", "sampled anew, as 4 x 2 pixels of longitude and latitude");
    write_pbrt(high, "Scale -1 1 1", "", "filename");
    assert_true(fabs(imported_pixel("t.pbrt") - 1) < 0.05);
    write_pbrt(other, "", "", "filename");
    assert_true(fabs(imported_pixel("t.pbrt")) < 0.05);
    /* Of sixteen, those in the corners are about -z. */
    write_one_pixel("sky.ppm", 4, 4, 0, 3);
    write_pbrt(bottom, "", "", "filename");
    assert_true(imported_pixel("t.pbrt") > 0.9);
    write_pbrt(top, "", "", "filename");
    assert_true(imported_pixel("t.pbrt") < 0.1);
    write_one_pixel("sky.ppm", 4, 2, 0, 1);
    expect_rtc(0, "import t.pbrt --out t.rts");
    expect_in_file("t.rts", "the image of a light is left out: it is not square");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(mitsuba_has_rows_at_the_poles, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(what_is_no_rotation_is_told, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(skies_of_pbrt_have_z_upwards, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(octahedral_skies_are_unfolded, scratch_enter,
                                        scratch_leave),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests_name("import_skies", tests, NULL, NULL);
}
