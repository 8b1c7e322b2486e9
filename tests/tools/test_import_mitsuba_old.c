/*
 * test_import_mitsuba_old.c - scenes of Mitsuba 0.x: what it has that Mitsuba 3 has not, and what
 * the same words mean there.
 */
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
#include "lib/image/scratch.h"
#include "spawn.h"

/* What the import of a sphere with this inside tells, in a scene of this version. */
static void expect_told(const char *version, const char *inside, const char *told)
{
    char text[1024];
    snprintf(text, sizeof text, "<scene version=\"%s\"><shape type=\"sphere\">%s</shape></scene>",
             version, inside);
    scratch_write("s.xml", text);
    run run = run_rtc("import s.xml --out s.rts");
    expect_status(&run, 0);
    expect_err(&run, told);
    run_free(&run);
}

/* The same, of what it becomes. */
static void expect_sphere(const char *version, const char *inside, const char *becomes)
{
    expect_told(version, inside, "");
    expect_in_file("s.rts", becomes);
    expect_rtc(0, "check s.rts");
}

/* One number is white there, and an even spectrum in Mitsuba 3. */
static void one_number_of_a_light_is_white(void **state)
{
    static const char light[] = "<emitter type=\"area\"><spectrum name=\"radiance\" "
                                "value=\"2\"/></emitter>";
    (void)state;
    expect_sphere("0.6.0", light, "radiance 2 2 2 }");
    expect_sphere("3.0.0", light, "radiance 2.409");
}

/* 0.5 of the curve of sRGB is 0.214, and of <rgb> it is the value itself. */
static void colours_of_srgb_are_decoded(void **state)
{
    (void)state;
    expect_sphere("0.6.0",
                  "<bsdf type=\"diffuse\"><srgb name=\"reflectance\" value=\"1, 0.5, 0\"/></bsdf>",
                  "{ kd 1 0.21404");
    expect_sphere("0.6.0",
                  "<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"1, 0.5, 0\"/></bsdf>",
                  "{ kd 1 0.5 0 ");
    expect_sphere("0.6.0",
                  "<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"#ff8000\"/></bsdf>",
                  "{ kd 1 0.5019608 0 ");
    expect_sphere("0.6.0",
                  "<bsdf type=\"diffuse\"><srgb name=\"diffuseReflectance\" value=\"#ff8000\"/>"
                  "</bsdf>",
                  "{ kd 1 0.21586");
}

/* The temperature is an attribute, with its unit or without, and may be scaled. */
static void black_bodies_have_attributes(void **state)
{
    double colours[3][3];
    static const char *const forms[] = {
        "<blackbody name=\"radiance\" temperature=\"2856K\" scale=\"2\"/>",
        "<blackbody name=\"radiance\" temperature=\"2856\"/>",
        "<spectrum name=\"radiance\" type=\"blackbody\"><float name=\"temperature\" "
        "value=\"2856\"/></spectrum>"};
    (void)state;
    for (int i = 0; i < 3; i++) {
        char inside[256];
        snprintf(inside, sizeof inside, "<emitter type=\"area\">%s</emitter>", forms[i]);
        expect_sphere("0.6.0", inside, "radiance ");
        char *const scene = scratch_read("s.rts");
        double *const c = colours[i];
        assert_int_equal(sscanf(strstr(scene, "  radiance ") + 11, "%lf %lf %lf", c, c + 1, c + 2),
                         3);
        free(scene);
    }
    for (int c = 0; c < 3; c++) {
        assert_float_equal(colours[0][c], 2 * colours[1][c], 1e-6 * colours[0][c]);
        assert_float_equal(colours[1][c], colours[2][c], 1e-6 * colours[1][c]);
    }
    scratch_write("s.xml", "<scene version=\"0.6.0\"><shape type=\"sphere\"><emitter type=\"area\">"
                           "<blackbody name=\"radiance\" temperature=\"hot\"/></emitter></shape>"
                           "</scene>");
    run run = run_rtc("import s.xml --out s.rts");
    expect_status(&run, 0);
    expect_err(&run, "s.xml:1: a black body became white of 1: its temperature is from 100 to 1e6");
    run_free(&run);
}

/* A shape with a medium and no material has no surface there, and is grey in Mitsuba 3. */
static void media_need_no_material(void **state)
{
    static const char medium[] = "<medium type=\"homogeneous\" name=\"interior\">"
                                 "<rgb name=\"sigmaS\" value=\"3\"/><rgb name=\"sigmaA\" "
                                 "value=\"1\"/></medium>";
    (void)state;
    expect_sphere("0.6.0", medium, "scattering 3 3 3");
    expect_sphere("3.0.0", medium, "{ kd 0.5 0.5 0.5  back black }");
    expect_sphere("0.6.0",
                  "<medium type=\"heterogeneous\" name=\"interior\"><volume name=\"density\" "
                  "type=\"constvolume\"><float name=\"value\" value=\"0.5\"/></volume><volume "
                  "name=\"albedo\" type=\"constvolume\"><float name=\"value\" value=\"1\"/>"
                  "</volume><float name=\"scale\" value=\"4\"/></medium>",
                  "scattering 2 2 2");
}

/* Without one, or with one that is none, it is Mitsuba 3's; that it may be another is told. */
static void versions_that_are_none_are_told(void **state)
{
    static const struct {
        const char *head, *told;
    } cases[] = {
        {"<scene>", "s.xml:1: the scene has no version: it is read as one of Mitsuba 3"},
        {"<scene version=\"abc\">", "s.xml:1: there is no version 'abc' of Mitsuba"},
        {"<scene version=\"\">", "s.xml:1: there is no version '' of Mitsuba"},
        {"<scene version=\"4.0.0\">", "s.xml:1: there is no version '4.0.0' of Mitsuba"},
        {"<scene version=\"0.3.0\">", "the names of Mitsuba before 0.4 are not known"},
        {"<scene version=\"3.5.0\">", "s.xml:1: the scene has version 3.5.0: it is read as one"},
        {"<scene version=\"0.4.1\">", NULL}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[400];
        snprintf(text, sizeof text,
                 "%s<shape type=\"sphere\"><transform name=\"toWorld\"><scale value=\"2\"/>"
                 "</transform></shape></scene>",
                 cases[i].head);
        scratch_write("s.xml", text);
        run run = run_rtc("import s.xml --out s.rts");
        expect_status(&run, 0);
        if (cases[i].told)
            expect_err(&run, cases[i].told);
        else
            expect_no_err(&run, "ersion");
        run_free(&run);
    }
}

/* The axes of rotations have any length there; Mitsuba 3 shears. */
static void rotations_about_axes_of_any_length(void **state)
{
    static const char turned[] = "<transform name=\"toWorld\"><rotate x=\"0\" y=\"3\" "
                                 "angle=\"90\"/><translate x=\"2\"/></transform>"
                                 "<point name=\"center\" x=\"0\" y=\"0\" z=\"1\"/>";
    (void)state;
    expect_sphere("0.6.0", turned, "0 1 2 0 1 0 0 -1 0 ");
    expect_told("3.0.0", turned, "the axis of a rotation has the length 3");
}

static void what_lacks_a_number_is_told(void **state)
{
    static const struct {
        int status;
        const char *inside, *told;
    } cases[] = {{0, "<transform name=\"toWorld\"><rotate y=\"1\" angel=\"30\"/></transform>",
                  "s.xml:1: a <rotate> is left out: its angle '' is empty"},
                 {0,
                  "</shape><sensor type=\"thinlens\"><float name=\"apertureRadius\" value=\"1\"/>"
                  "</sensor><shape type=\"disk\">",
                  "s.xml:1: a thinlens without a focus_distance above 0 is focused at 1"},
                 {0,
                  "<bsdf type=\"coating\"><rgb name=\"sigmaA\" value=\"-1 1 1\"/><bsdf "
                  "type=\"diffuse\"/></bsdf>",
                  "s.xml:1: a negative coat_absorption became 0"}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[600];
        snprintf(text, sizeof text,
                 "<scene version=\"0.6.0\"><shape type=\"sphere\">%s</shape></scene>",
                 cases[i].inside);
        scratch_write("s.xml", text);
        run run = run_rtc("import s.xml --out s.rts");
        expect_status(&run, cases[i].status);
        expect_err(&run, cases[i].told);
        run_free(&run);
    }
}

/* What an image of normals says by its gamma of 1 is `raw` of Mitsuba 3. */
static void normal_maps_of_gamma_1_are_raw(void **state)
{
    char text[600];
    (void)state;
    scratch_write("n.ppm", "P3 1 1 255 128 128 255\n");
    for (int is_raw = 0; is_raw < 2; is_raw++) {
        snprintf(text, sizeof text,
                 "<scene version=\"0.6.0\"><shape type=\"sphere\"><bsdf type=\"normalmap\">"
                 "<texture type=\"bitmap\"><string name=\"filename\" value=\"n.ppm\"/>%s"
                 "</texture><bsdf type=\"diffuse\"/></bsdf></shape></scene>",
                 is_raw ? "<float name=\"gamma\" value=\"1\"/>" : "");
        scratch_write("s.xml", text);
        run run = run_rtc("import s.xml --out s.rts");
        expect_status(&run, 0);
        if (is_raw)
            expect_no_err(&run, "a normal map without");
        else
            expect_err(&run, "a normal map without");
        run_free(&run);
    }
}

/*
 * What is not given is of the preset, a hundredfold, or of skin; g is the mean of the channels'.
 * Jensen et al. 2001: skin scatters 0.74, 0.88, 1.01 and absorbs 0.032, 0.17, 0.48 per mm.
 * Narasimhan et al. 2006: regular milk scatters 4.5513, 5.8294, 7.136 where isotropic, with g of
 * 0.75, 0.714, 0.681.
 */
static void media_by_name_have_their_coefficients(void **state)
{
    static const char head[] = "<medium type=\"homogeneous\" name=\"interior\">";
    static const struct {
        const char *inside, *expected;
    } cases[] = {
        {"", "absorption 3.2 17 48  scattering 74 88 101"},
        {"<string name=\"material\" value=\"marble\"/><float name=\"scale\" value=\".1\"/>",
         "absorption 0.021 0.041 0.071  scattering 21.9 26.2 30"},
        {"<string name=\"material\" value=\"Regular Milk\"/>", "g          0.715"},
        {"<string name=\"material\" value=\"Regular Milk\"/>",
         "scattering 1820.52 2038.2517 2236.9905"},
        {"<string name=\"material\" value=\"regular milk\"/><float name=\"g\" value=\".5\"/>",
         "g          0.5"},
        {"<rgb name=\"sigmaS\" value=\"5\"/>", "absorption 3.2 17 48  scattering 5 5 5"},
        {"<rgb name=\"sigmaT\" value=\"77.2, 105, 149\"/>", "scattering 74 88 101"}};
    char inside[400];
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        snprintf(inside, sizeof inside, "%s%s</medium>", head, cases[i].inside);
        expect_sphere("0.6.0", inside, cases[i].expected);
    }
    snprintf(inside, sizeof inside, "%s<string name=\"material\" value=\"lava\"/></medium>", head);
    expect_told("0.6.0", inside,
                "there is no medium 'lava' of Mitsuba's: skin stands in its place");
    snprintf(inside, sizeof inside,
             "%s<rgb name=\"sigmaA\" value=\"1\"/><rgb name=\"albedo\" value=\"1\"/></medium>",
             head);
    expect_told("0.6.0", inside,
                "sigma_t and albedo are left out beside sigma_s or sigma_a, where Mitsuba refuses");
}

/* A number of four bytes, little-endian, of a grid. */
static unsigned char *put(unsigned char *at, const void *number)
{
    uint32_t bits;
    memcpy(&bits, number, sizeof bits);
    for (int i = 0; i < 4; i++)
        *at++ = (unsigned char)(bits >> 8 * i);
    return at;
}

/* The box of the file is that of the grid there, or the one of min and max. */
static void grids_fill_the_box_of_their_file(void **state)
{
    static const char head[] = "<medium type=\"heterogeneous\" name=\"interior\"><volume "
                               "name=\"density\" type=\"gridvolume\"><string name=\"filename\" "
                               "value=\"u.vol\"/>",
                      end[] = "</volume></medium>";
    static const int32_t counts[] = {1, 2, 2, 2, 1};
    static const float box[] = {-4, 0, -2, 4, 1, 2}, density = 1;
    unsigned char file[48 + 32] = "VOL\3", *at = file + 4;
    char inside[600];
    (void)state;
    for (int i = 0; i < 5; i++)
        at = put(at, &counts[i]);
    for (int i = 0; i < 6; i++)
        at = put(at, &box[i]);
    for (int i = 0; i < 8; i++)
        at = put(at, &density);
    scratch_write_bytes("u.vol", file, sizeof file);
    snprintf(inside, sizeof inside, "%s%s", head, end);
    expect_sphere("0.6.0", inside, "matrix 8 0 0 -4 0 1 0 0 0 0 4 -2");
    snprintf(inside, sizeof inside,
             "%s<point name=\"min\" x=\"0\" y=\"0\" z=\"0\"/><point name=\"max\" x=\"2\" y=\"2\" "
             "z=\"3\"/>%s",
             head, end);
    expect_sphere("0.6.0", inside, "matrix 2 0 0 0 0 2 0 0 0 0 3 0");
}

/* What an included file has may get another id, and names of files are those of Windows, too. */
static void aliases_and_names_are_found(void **state)
{
    (void)state;
    scratch_write("n.ppm", "P3 1 1 255 128 128 255\n");
    scratch_write("more.xml",
                  "<scene version=\"0.6.0\"><bsdf type=\"diffuse\" id=\"white\"><texture "
                  "name=\"reflectance\" type=\"bitmap\"><string name=\"filename\" "
                  "value=\".\\n.ppm\"/></texture></bsdf></scene>");
    scratch_write("s.xml", "<scene version=\"0.6.0\"><include filename=\"more.xml\"/>"
                           "<alias id=\"white\" as=\"paper\"/><shape type=\"sphere\">"
                           "<ref id=\"paper\"/></shape></scene>");
    run run = run_rtc("import s.xml --out s.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "left out");
    run_free(&run);
    expect_in_file("s.rts", "kd_texture bitmap_");
}

/* A gamma of 1 is raw, wrapping is said along u and v, and one channel may be taken. */
static void images_are_read_by_its_words(void **state)
{
    (void)state;
    scratch_write("n.ppm", "P3 1 1 255 128 128 255\n");
    scratch_write("t.xml",
                  "<scene version=\"0.6.0\"><shape type=\"rectangle\"><bsdf type=\"diffuse\">"
                  "<texture name=\"reflectance\" type=\"bitmap\"><string name=\"filename\" "
                  "value=\"n.ppm\"/><float name=\"gamma\" value=\"1\"/><string "
                  "name=\"wrapModeU\" value=\"clamp\"/><string name=\"wrapModeV\" "
                  "value=\"clamp\"/><string name=\"channel\" value=\"b\"/></texture></bsdf>"
                  "</shape></scene>\n");
    run run = run_rtc("import t.xml --out t.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "left out");
    run_free(&run);
    expect_in_file("t.rts", "linear  true");
    expect_in_file("t.rts", "wrap    clamp");
    expect_in_file("t.rts", "channel b");
    scratch_write("t.xml",
                  "<scene version=\"0.6.0\"><emitter type=\"point\"><float name=\"samplingWeight\" "
                  "value=\"2\"/></emitter><shape type=\"rectangle\"><bsdf type=\"diffuse\">"
                  "<texture name=\"reflectance\" type=\"bitmap\"><string name=\"filename\" "
                  "value=\"n.ppm\"/><string name=\"wrapMode\" value=\"zero\"/></texture></bsdf>"
                  "</shape></scene>\n");
    run = run_rtc("import t.xml --out t.rts");
    expect_status(&run, 0);
    expect_err(&run, "t.xml:1: the wrap_mode 'zero' became clamp");
    expect_no_err(&run, "left out");
    run_free(&run);
    expect_in_file("t.rts", "wrap clamp");
}

/* uscale and so on, times and then plus, in the place of to_uv. */
static void textures_of_mitsuba_0_are_scaled(void **state)
{
    (void)state;
    scratch_write("n.ppm", "P3 1 1 255 128 128 255\n");
    scratch_write("t.xml",
                  "<scene version=\"0.6.0\"><shape type=\"rectangle\"><bsdf "
                  "type=\"diffuse\"><texture name=\"reflectance\" type=\"bitmap\">"
                  "<string name=\"filename\" value=\"n.ppm\"/><float name=\"uscale\" "
                  "value=\"2\"/><float name=\"vscale\" value=\"3\"/><float name=\"uoffset\" "
                  "value=\"0.5\"/></texture></bsdf></shape></scene>\n");
    run run = run_rtc("import t.xml --out t.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "left out");
    run_free(&run);
    expect_in_file("t.rts", "scale 2 -3  offset 0.5 1");
}

/* Materials that Mitsuba 3 has no more, a part of what they become, and of what is said. */
static const struct {
    const char *bsdf, *scene, *said;
} materials[] = {
    {"<bsdf type=\"coating\"><float name=\"intIOR\" value=\"1.6\"/><float name=\"extIOR\" "
     "value=\"1\"/><spectrum name=\"sigmaA\" value=\"0.5\"/><float name=\"thickness\" "
     "value=\"2\"/><bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"0.5 0.25 0.25\"/>"
     "</bsdf></bsdf>",
     "{ kd 0.5 0.25 0.25  coat 1  coat_absorption 1 1 1  coat_ior 1.6  back",
     "a coat keeps the light that it reflects back inside, which Mitsuba 0.x loses"},
    {"<bsdf type=\"roughcoating\"><float name=\"alpha\" value=\"0.25\"/>"
     "<bsdf type=\"conductor\"/></bsdf>",
     "coat_roughness 0.25",
     "a coat keeps the light that it reflects back inside, which Mitsuba 0.x loses"},
    {"<bsdf type=\"coating\"><bsdf type=\"difftrans\"/></bsdf>", "{ diffuse_transmission",
     "the coat over what is no diffuse material or metal is left out"},
    {"<bsdf type=\"mixturebsdf\"><string name=\"weights\" value=\"1\"/>"
     "<bsdf type=\"difftrans\"/></bsdf>",
     "{ diffuse_transmission", NULL},
    {"<bsdf type=\"coating\"><bsdf type=\"dielectric\"/></bsdf>", "fresnel dielectric",
     "the coat over what is no diffuse material or metal is left out"},
    {"<bsdf type=\"phong\"><float name=\"exponent\" value=\"7.5\"/></bsdf>",
     "    ks               0.2 0.2 0.2\n    roughness        0.25\n",
     "the lobe of a 'phong' became one of GGX of the same width"},
    {"<bsdf type=\"ward\"><float name=\"alphaU\" value=\"0.25\"/><float name=\"alphaV\" "
     "value=\"0.5\"/></bsdf>",
     "roughness        0.25\n    roughness_v      0.5\n", "the lobe of a 'ward' became"},
    {"<bsdf type=\"mixturebsdf\"><string name=\"weights\" value=\"0.25, 0.75\"/>"
     "<bsdf type=\"diffuse\"/><bsdf type=\"conductor\"/></bsdf>",
     "weight 0.75", NULL},
    {"<bsdf type=\"mixturebsdf\"><string name=\"weights\" value=\"0.25, 0.25\"/>"
     "<bsdf type=\"diffuse\"/><bsdf type=\"conductor\"/></bsdf>",
     "weight 0.6666667", NULL},
    {"<bsdf type=\"mixturebsdf\"><string name=\"weights\" value=\"0.25, 0.25\"/>"
     "<bsdf type=\"diffuse\"/><bsdf type=\"null\"/></bsdf>",
     "weight 0.6666667", NULL},
    {"<bsdf type=\"mixturebsdf\"><string name=\"weights\" value=\"1, 2, 1\"/>"
     "<bsdf type=\"diffuse\"/><bsdf type=\"conductor\"/><bsdf type=\"plastic\"/></bsdf>",
     "weight 0.75", "the weights of a 'mixturebsdf' add up to 4: divided by that"},
    {"<bsdf type=\"mixturebsdf\"><string name=\"weights\" value=\"1, 1\"/>"
     "<bsdf type=\"diffuse\"/></bsdf>",
     "{ kd 0.5 0.5 0.5  back black }",
     "one number from 0 to 1 for each of its 1 materials, became 1 each"},
    {"<bsdf type=\"roughdiffuse\"><rgb name=\"reflectance\" value=\"0.8 0.4 0.2\"/>"
     "<float name=\"alpha\" value=\"0.5\"/></bsdf>",
     "{ kd 0.8 0.4 0.2  roughness 0.3032884  back black }",
     "of which Oren and Nayar's loses up to 14 %"},
    {"<bsdf type=\"roughdiffuse\"><float name=\"alpha\" value=\"0\"/></bsdf>",
     "{ kd 0.5 0.5 0.5  back black }", NULL},
    {"<bsdf type=\"coating\"><bsdf type=\"roughdiffuse\"/></bsdf>",
     "{ kd 0.5 0.5 0.5  coat 1  coat_ior", NULL},
    {"<bsdf type=\"conductor\"/>", "fresnel conductor", NULL},
    {"<bsdf type=\"roughconductor\"/>", "roughness        0.1\n    fresnel          conductor",
     NULL},
};

static void materials_of_mitsuba_0_are_read(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof materials / sizeof *materials; i++) {
        char text[1024];
        snprintf(text, sizeof text,
                 "<scene version=\"0.6.0\"><shape type=\"sphere\">%s</shape></scene>",
                 materials[i].bsdf);
        scratch_write("old.xml", text);
        run run = run_rtc("import old.xml --out old.rts");
        expect_status(&run, 0);
        if (materials[i].said)
            expect_err(&run, materials[i].said);
        run_free(&run);
        expect_in_file("old.rts", materials[i].scene);
        expect_rtc(0, "check old.rts");
    }
}

#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, scratch_enter, scratch_leave)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_SCRATCH(one_number_of_a_light_is_white),
        IN_SCRATCH(colours_of_srgb_are_decoded),
        IN_SCRATCH(black_bodies_have_attributes),
        IN_SCRATCH(media_need_no_material),
        IN_SCRATCH(media_by_name_have_their_coefficients),
        IN_SCRATCH(versions_that_are_none_are_told),
        IN_SCRATCH(rotations_about_axes_of_any_length),
        IN_SCRATCH(what_lacks_a_number_is_told),
        IN_SCRATCH(normal_maps_of_gamma_1_are_raw),
        IN_SCRATCH(images_are_read_by_its_words),
        IN_SCRATCH(grids_fill_the_box_of_their_file),
        IN_SCRATCH(aliases_and_names_are_found),
        IN_SCRATCH(textures_of_mitsuba_0_are_scaled),
        IN_SCRATCH(materials_of_mitsuba_0_are_read),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests_name("import_mitsuba_old", tests, NULL, NULL);
}
