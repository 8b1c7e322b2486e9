/*
 * test_import_lights.c - the images of imported projectors, luminaires and spots are seen where the
 * other program shows them, and what is left out of them is told.
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

/*
 * A light at the origin, which looks to +z with y up, as both programs have it, and a dark sphere
 * of radius 1000 around it, of which the camera sees what lies along d.
 */
static double seen_in_mitsuba(const double d[3], const char *light)
{
    char text[2048];
    snprintf(text, sizeof text,
             "<scene version=\"3.0.0\"><sensor type=\"perspective\"><float name=\"fov\" "
             "value=\"0.01\"/><transform name=\"to_world\"><lookat origin=\"0,0,0\" "
             "target=\"%.9g,%.9g,%.9g\" up=\"0.3,0.4,0.5\"/></transform><film type=\"hdrfilm\">"
             "<integer name=\"width\" value=\"1\"/><integer name=\"height\" value=\"1\"/></film>"
             "</sensor><shape type=\"sphere\"><float name=\"radius\" value=\"1000\"/><boolean "
             "name=\"flip_normals\" value=\"true\"/><bsdf type=\"twosided\"><bsdf type=\"diffuse\">"
             "<rgb name=\"reflectance\" value=\"0.001\"/></bsdf></bsdf></shape>%s</scene>",
             d[0], d[1], d[2], light);
    scratch_write("t.xml", text);
    return imported_pixel("t.xml") * pi * 1e9; /* the intensity */
}

#define IMAGE(name)                                                                                \
    "<texture type=\"bitmap\" name=\"" name "\"><string name=\"filename\" value=\"slide.ppm\"/>"   \
    "<string name=\"filter_type\" value=\"nearest\"/></texture></emitter>"

static void expect_intensity(double found, double expected)
{
    if (!(fabs(found - expected) <= 1e-3 * expected))
        fail_msg("%g, not %g", found, expected);
}

/* As the program was asked, its x is to the left: pi of the value over the cube of the cosine. */
static void mitsuba_shows_projectors_upright(void **state)
{
    static const char light[] = "<emitter type=\"projector\"><float name=\"fov\" value=\"90\"/>"
                                "<float name=\"scale\" value=\"2\"/>" IMAGE("irradiance");
    const double d[3] = {0.75, 0.25, 1}, cosine = 1 / sqrt(1 + 0.75 * 0.75 + 0.25 * 0.25);
    (void)state;
    write_one_pixel("slide.ppm", 4, 2, 0, 0);
    expect_intensity(seen_in_mitsuba(d, light), 2 * pi / pow(cosine, 3));
    write_one_pixel("slide.ppm", 4, 2, 0, 1);
    assert_true(seen_in_mitsuba(d, light) < 1);
}

static void mitsuba_has_even_projectors(void **state)
{
    static const char light[] = "<emitter type=\"projector\"><float name=\"fov\" value=\"90\"/>"
                                "<rgb name=\"irradiance\" value=\"3\"/></emitter>";
    const double inside[3] = {0.9, -0.9, 1}, outside[3] = {0, 1.1, 1};
    (void)state;
    expect_intensity(seen_in_mitsuba(inside, light), 3 * pi * pow(1 + 2 * 0.81, 1.5));
    assert_true(seen_in_mitsuba(outside, light) < 1);
}

/* The image of a spot is turned by 180 degrees there. */
static void mitsuba_shows_images_of_spots_turned(void **state)
{
    static const char light[] =
        "<emitter type=\"spot\"><rgb name=\"intensity\" value=\"5\"/><float name=\"cutoff_angle\" "
        "value=\"45\"/><float name=\"beam_width\" value=\"44\"/>" IMAGE("texture");
    const double d[3] = {0.5, 0.5, 1};
    (void)state;
    write_one_pixel("slide.ppm", 2, 2, 1, 1);
    expect_intensity(seen_in_mitsuba(d, light), 5);
    write_one_pixel("slide.ppm", 2, 2, 0, 0);
    assert_true(seen_in_mitsuba(d, light) < 1);
}

static double seen_in_pbrt(const double d[3], const char *first, const char *light)
{
    char text[1024];
    snprintf(
        text, sizeof text,
        "%s\nLookAt 0 0 0  %.9g %.9g %.9g  0.3 0.4 0.5\n"
        "Camera \"perspective\" \"float fov\" 0.01\n"
        "Film \"rgb\" \"integer xresolution\" 1 \"integer yresolution\" 1\n"
        "WorldBegin\nLightSource %s\nMaterial \"diffuse\" \"rgb reflectance\" [.001 .001 .001]\n"
        "Shape \"sphere\" \"float radius\" 1000\n",
        first, d[0], d[1], d[2], light);
    scratch_write("t.pbrt", text);
    return imported_pixel("t.pbrt") * pi * 1e9;
}

/* The left column on -x, the top row on -y, intensity by direction; fov is of the shorter side. */
static void pbrt_shows_projections_turned_over(void **state)
{
    static const char *const first[] = {"", "Scale -1 1 1"},
                             light[] = "\"projection\" \"string filename\" \"slide.ppm\" \"float "
                                       "fov\" 90 \"float scale\" 3";
    const double d[3] = {-1.5, -0.5, 1};
    (void)state;
    for (int i = 0; i < 2; i++) {
        write_one_pixel("slide.ppm", 4, 2, 0, 0);
        expect_intensity(seen_in_pbrt(d, first[i], light), 3);
        write_one_pixel("slide.ppm", 4, 2, 3, 0);
        assert_true(seen_in_pbrt(d, first[i], light) < 1);
        write_one_pixel("slide.ppm", 4, 2, 0, 1);
        assert_true(seen_in_pbrt(d, first[i], light) < 1);
    }
}

/* In v3 longitude goes from x to z about y, in v4 there is a square, with z in its middle. */
static void pbrt_shows_luminaires_by_their_maps(void **state)
{
    static const char *const first[] = {"", "Scale -1 1 1"},
                             map[] = "\"goniometric\" \"string mapname\" \"slide.ppm\" \"rgb I\" "
                                     "[4 4 4]",
                             square[] = "\"goniometric\" \"string filename\" \"slide.ppm\"";
    const double longitude = 2 * pi * 2.5 / 16, polar = pi * 2.5 / 8;
    const double d[3] = {sin(polar) * cos(longitude), cos(polar), sin(polar) * sin(longitude)};
    const double other[3] = {d[0], d[1], -d[2]}, quarter[3] = {-1, 1, 0.7}, below[3] = {-1, 1, -9};
    (void)state;
    for (int i = 0; i < 2; i++) {
        write_one_pixel("slide.ppm", 16, 8, 2, 2);
        expect_intensity(seen_in_pbrt(d, first[i], map), 4);
        assert_true(seen_in_pbrt(other, first[i], map) < 1);
        write_one_pixel("slide.ppm", 2, 2, 0, 1);
        assert_true(seen_in_pbrt(quarter, first[i], square) > 0.9);
        write_one_pixel("slide.ppm", 4, 4, 0, 3);
        assert_true(seen_in_pbrt(quarter, first[i], square) < 0.1);
        assert_true(seen_in_pbrt(below, first[i], square) > 0.9);
    }
}

/* The pixel of a scene of pbrt with such a camera and film, and such a light alone. */
static double sky_in_pbrt(const char *camera, const char *film, const char *light)
{
    char text[512];
    snprintf(text, sizeof text,
             "Camera \"perspective\" \"float fov\" 1 %s\nFilm \"%s \"integer xresolution\" 1 "
             "\"integer yresolution\" 1\nWorldBegin\nLightSource \"infinite\" %s\n",
             camera, film, light);
    scratch_write("t.pbrt", text);
    return imported_pixel("t.pbrt");
}

/* Of the cosine, over its edge of 30 to 60 degrees; of v3 the spot by its Film. */
static void spots_of_pbrt_and_gltf_fall_by_their_own_laws(void **state)
{
    static const char spot[] =
        "\"spot\" \"float coneangle\" 60 \"float conedeltaangle\" 30 \"rgb I\" "
        "[5 5 5]";
    const double d[3] = {1, 0, 1}, x = (sqrt(0.5) - 0.5) / (sqrt(0.75) - 0.5);
    (void)state;
    expect_intensity(seen_in_pbrt(d, "", spot), 5 * x * x * (3 - 2 * x));
    expect_intensity(seen_in_pbrt(d, "Film \"image\"", spot), 5 * pow(x, 4));
    scratch_write(
        "s.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"extensions\":{\"KHR_lights_punctual\":{"
        "\"lights\":[{\"type\":\"spot\",\"intensity\":683,\"spot\":{\"innerConeAngle\":0.5,"
        "\"outerConeAngle\":1}}]}},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{"
        "\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}]}");
    run run = run_rtc("import s.gltf --out s.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "spot");
    run_free(&run);
    expect_in_file("s.rts", "falloff   square");
}

/* Two even skies are one; beside an image the second is left out. */
static void even_skies_add_up(void **state)
{
    static const char image[] = "LightSource \"infinite\" \"string mapname\" \"slide.ppm\"\n";
    char text[400];
    (void)state;
    expect_intensity(sky_in_pbrt("", "rgb\"",
                                 "\"rgb L\" [3 3 3]\nLightSource \"point\"\n"
                                 "LightSource \"infinite\" \"rgb L\" [2 1 1]"),
                     5);
    write_one_pixel("slide.ppm", 4, 2, 0, 0);
    snprintf(text, sizeof text, "WorldBegin\nLightSource \"infinite\"\n%sShape \"sphere\"\n",
             image);
    scratch_write("t.pbrt", text);
    run run = run_rtc("check t.pbrt");
    expect_err(&run, "t.pbrt:3: a second environment light is left out");
    run_free(&run);
}

/* Of the world, whose x is mirrored, whatever the light's own transformation. */
static void portals_of_pbrt_are_read(void **state)
{
    static const struct {
        const char *corners, *told;
    } wrong[] = {{"0 0 0 1 0 0 1 1 0", "a portal that is not of four points is left out"},
                 {"0 0 0 1 0 0 1 0 0 0 0 0", "a portal without area is left out"},
                 {"0 0 0 1 0 0 2 1 0 1 1 0", "a portal that is no rectangle is left out"}};
    char text[512];
    run run;
    (void)state;
    scratch_write("t.pbrt", "LookAt 0 0 -5 0 0 0 0 1 0\nCamera \"perspective\"\nWorldBegin\n"
                            "Translate 9 9 9\nLightSource \"infinite\" \"rgb L\" [3 2 1] "
                            "\"point3 portal\" [1 0.5 3 1 0.5 4 1 2.5 4 1 2.5 3]\n"
                            "Shape \"sphere\"\n");
    run = run_rtc("import t.pbrt --out t.rts");
    expect_status(&run, 0);
    expect_err(&run, "t.pbrt:5: light of a sky comes through other openings than its portal, too");
    run_free(&run);
    expect_in_file("t.rts", "corner -1 0.5 3");
    expect_in_file("t.rts", "edge1 0 0 1");
    expect_in_file("t.rts", "edge2 0 2 0");
    expect_rtc(0, "check t.rts");
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        snprintf(text, sizeof text,
                 "WorldBegin\nLightSource \"infinite\" \"point3 portal\" [%s]\n"
                 "Shape \"sphere\"\n",
                 wrong[i].corners);
        scratch_write("t.pbrt", text);
        run = run_rtc("import t.pbrt --out t.rts");
        expect_status(&run, 0);
        expect_err(&run, wrong[i].told);
        run_free(&run);
        expect_not_in_file("t.rts", "portal {");
    }
}

/* The shutter's seconds times ISO / 100 in v4, the film's scale in v3. */
static void pbrt_exposes_by_shutter_and_film(void **state)
{
    static const char light[] = "\"rgb L\" [3 3 3]",
                      shutter[] = "\"float shutteropen\" 0.25 \"float shutterclose\" 0.5";
    (void)state;
    expect_intensity(sky_in_pbrt("", "rgb\"", light), 3);
    expect_intensity(sky_in_pbrt(shutter, "rgb\"", light), 0.75);
    expect_intensity(sky_in_pbrt(shutter, "rgb\" \"float iso\" 800", light), 6);
    expect_intensity(sky_in_pbrt(shutter, "image\" \"float scale\" 2", light), 6);
    expect_intensity(sky_in_pbrt("", "rgb\" \"float iso\" 50", "\"float illuminance\" 31.4159265"),
                     5);
}

/* That of a distant light of v4 is its L. */
static void pbrt_has_illuminances(void **state)
{
    (void)state;
    scratch_write("t.pbrt",
                  "LookAt 0 0 1 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" 1\nFilm \"rgb\" "
                  "\"integer xresolution\" 1 \"integer yresolution\" 1\nWorldBegin\n"
                  "LightSource \"distant\" \"point3 from\" [0 0 1] \"point3 to\" [0 0 0] "
                  "\"float illuminance\" 12\nMaterial \"diffuse\" \"rgb reflectance\" [1 1 1]\n"
                  "Shape \"disk\"\n");
    expect_intensity(imported_pixel("t.pbrt") * pi, 12);
}

/* The light of a flat shape along its normal; radius 1000 makes 10^6 of its irradiance. */
#define BEAM(type, placed)                                                                         \
    "<shape type=\"" type "\"><transform name=\"to_world\">" placed "<translate z=\"-1\"/>"        \
    "</transform><emitter type=\"directionalarea\"><rgb name=\"radiance\" value=\"7\"/></emitter>"

static void mitsuba_sends_beams_along_normals(void **state)
{
    static const struct {
        const char *light;
        double irradiance;
    } beams[] = {
        {BEAM("rectangle", "<scale x=\"0.5\" y=\"3\"/>") "</shape>", 7},
        {BEAM("rectangle", "<translate x=\"0.9\"/>") "</shape>", 7},
        {BEAM("rectangle", "<translate x=\"1.1\"/>") "</shape>", 0},
        {BEAM("rectangle", "<scale x=\"-1\"/>") "</shape>", 7},
        {BEAM("disk", "<translate x=\"0.9\" y=\"0.3\"/>") "</shape>", 7},
        {BEAM("disk", "<translate x=\"0.9\" y=\"0.9\"/>") "</shape>", 0},
        {BEAM("disk", "<scale x=\"2\"/><translate x=\"1.9\"/>") "</shape>", 7},
        {BEAM("rectangle", "") "<boolean name=\"flip_normals\" value=\"true\"/></shape>", 0}};
    const double d[3] = {0, 0, 1};
    (void)state;
    for (size_t i = 0; i < sizeof beams / sizeof *beams; i++) {
        expect_intensity(seen_in_mitsuba(d, beams[i].light), beams[i].irradiance * 1e6);
        expect_in_file("t.rts", "light beam {");
    }
    /* Far away the target is as far, so that rounding does not turn the axis. */
    seen_in_mitsuba(d, BEAM("disk", "<translate z=\"-6999\"/>") "</shape>");
    expect_in_file("t.rts", "target 0 0 0");
}

static void what_is_left_out_is_told(void **state)
{
    static const char *const lights[][2] = {
        {"<emitter type=\"projector\"><texture type=\"checkerboard\" name=\"irradiance\"/>"
         "</emitter>",
         "the texture 'checkerboard' of a light is left out"},
        {"<emitter type=\"projector\"><transform name=\"to_world\"><scale x=\"-1\"/></transform>"
         "<float name=\"fov\" value=\"9\"/>" IMAGE("irradiance"),
         "the mirroring of a projector is left out"},
        {BEAM("rectangle", "<matrix value=\"1 0.5 0 0 0 1 0 0 0 0 1 0 0 0 0 1\"/>") "</shape>",
         "the directionalarea of a shape that is no disk or rectangle, or a sheared one, is left "
         "out"},
        {BEAM("sphere", "") "</shape>", "the directionalarea of a shape that is no disk or "
                                        "rectangle, or a sheared one, is left out"},
    };
    const double d[3] = {0, 0, 1};
    (void)state;
    write_one_pixel("slide.ppm", 1, 1, 0, 0);
    for (size_t i = 0; i < sizeof lights / sizeof *lights; i++) {
        seen_in_mitsuba(d, lights[i][0]);
        expect_in_file("t.rts", lights[i][1]);
    }
    seen_in_pbrt(d, "", "\"projection\" \"string filename\" \"none.ppm\"");
    expect_in_file("t.rts", "a light 'projection' without image is left out");
    seen_in_pbrt(d, "", "\"goniometric\"");
    expect_in_file("t.rts", "a light 'goniometric' without image is left out");
}

int main(void)
{
#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, scratch_enter, scratch_leave)
    const struct CMUnitTest tests[] = {
        IN_SCRATCH(mitsuba_shows_projectors_upright),
        IN_SCRATCH(mitsuba_has_even_projectors),
        IN_SCRATCH(mitsuba_shows_images_of_spots_turned),
        IN_SCRATCH(pbrt_shows_projections_turned_over),
        IN_SCRATCH(pbrt_shows_luminaires_by_their_maps),
        IN_SCRATCH(pbrt_exposes_by_shutter_and_film),
        IN_SCRATCH(pbrt_has_illuminances),
        IN_SCRATCH(spots_of_pbrt_and_gltf_fall_by_their_own_laws),
        IN_SCRATCH(even_skies_add_up),
        IN_SCRATCH(portals_of_pbrt_are_read),
        IN_SCRATCH(mitsuba_sends_beams_along_normals),
        IN_SCRATCH(what_is_left_out_is_told),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests_name("import_lights", tests, NULL, NULL);
}
