/* test_import_media.c - participating media of pbrt: what fills shapes, and all space. */
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

#define FOG                                                                                        \
    "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [0.25 0.5 1]\n"       \
    " \"rgb sigma_s\" [2 3 4] \"float scale\" 0.5 \"float g\" 0.25\n"

/* Imports a scene, whose warnings are returned. */
static run import(const char *text)
{
    scratch_write("m.pbrt", text);
    run run = run_rtc("import m.pbrt --out m.rts");
    expect_status(&run, 0);
    return run;
}

static void media_fill_what_lets_light_through(void **state)
{
    (void)state;
    run run = import("WorldBegin\n" FOG "MediumInterface \"fog\" \"\"\n"
                     "Material \"interface\"\nShape \"sphere\"\n"
                     "Material \"dielectric\"\nShape \"sphere\" \"float radius\" 2\n"
                     "Material \"diffuse\"\nShape \"sphere\" \"float radius\" 3\n"
                     "Material \"thindielectric\"\nShape \"sphere\" \"float radius\" 4\n");
    expect_no_err(&run, "m.pbrt:12");
    expect_no_err(&run, "MediumInterface");
    run_free(&run);
    expect_in_file("m.rts", "{ interface true  absorption 0.125 0.25 0.5  scattering 1 1.5 2  "
                            "g 0.25 }");
    expect_in_file("m.rts", "    ior          1.5\n    relative_ior true\n"
                            "    absorption   0.125 0.25 0.5\n    scattering   1 1.5 2\n");
    expect_in_file("m.rts", "    thin         true\n    absorption   0.125 0.25 0.5\n");
    expect_in_file("m.rts", "{ kd 0.5 0.5 0.5 }");
    expect_rtc(0, "check m.rts");
}

/* Mitsuba's path tracer of surfaces takes media for empty space; here they are rendered. */
static void media_beside_an_integrator_of_surfaces_are_told(void **state)
{
    static const char scene[] = "<scene version=\"3.0.0\">\n<integrator type=\"%s\"/>\n"
                                "<shape type=\"sphere\"><bsdf type=\"null\"/>%s</shape></scene>\n",
                      medium[] = "<medium name=\"interior\" type=\"homogeneous\"/>";
    static const char told[] = "m.xml:3: the medium is rendered, which Mitsuba's integrators path, "
                               "direct and ptracer take for empty space";
    static const char *const types[] = {"path", "direct", "volpath"};
    char text[512];
    (void)state;
    for (int i = 0; i < 4; i++) {
        snprintf(text, sizeof text, scene, types[i % 3], i < 3 ? medium : "");
        scratch_write("m.xml", text);
        run run = run_rtc("check m.xml");
        expect_status(&run, 0);
        if (i < 2)
            expect_err(&run, told);
        else
            expect_no_err(&run, "the medium is rendered");
        run_free(&run);
    }
}

/* A medium ends with its attribute block, and one that nothing names is told. */
static void media_are_those_of_their_blocks(void **state)
{
    (void)state;
    run run = import("WorldBegin\n" FOG "Material \"interface\"\nAttributeBegin\n"
                     "MediumInterface \"fog\" \"\"\nAttributeEnd\n"
                     "Material \"dielectric\"\nShape \"sphere\"\n"
                     "MediumInterface \"mist\" \"\"\nShape \"sphere\" \"float radius\" 2\n"
                     "MakeNamedMedium \"c\" \"string type\" \"cloud\" \"float density\" 2\n"
                     "MediumInterface \"c\" \"\"\nShape \"sphere\" \"float radius\" 3\n");
    expect_err(&run, "m.pbrt:10: there is no medium 'mist': it is left out");
    expect_err(&run, "m.pbrt:12: a medium 'cloud' is left out");
    run_free(&run);
    expect_not_in_file("m.rts", "scattering");
    run = import("WorldBegin\n" FOG
                 "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"float g\" 0.75\n"
                 "MediumInterface \"fog\" \"\"\nMaterial \"interface\"\nShape \"sphere\"\n");
    expect_err(&run, "m.pbrt:4: a second medium 'fog' is left out");
    run_free(&run);
    expect_in_file("m.rts", "g 0.25");
}

/* Of pbrt's table, where scattering is isotropic; g stands beside. Whole milk without a name. */
static void media_by_name_have_their_coefficients(void **state)
{
    static const struct {
        const char *medium, *expected;
    } cases[] = {{"\"string preset\" \"Ketchup\" \"float scale\" 10",
                  "absorption 0.61 9.7 14.5  scattering 1.8 0.7 0.3"},
                 {"\"string preset\" \"Coke\" \"float g\" 0.5", "g          0.5"},
                 {"", "absorption 0.0011 0.0024 0.014  scattering 2.55 3.21 3.77"},
                 {"\"string preset\" \"Apple\" \"rgb sigma_s\" [1 2 3]",
                  "absorption 0.003 0.0034 0.046  scattering 1 2 3"}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[400];
        snprintf(text, sizeof text,
                 "WorldBegin\nMakeNamedMedium \"m\" \"string type\" \"homogeneous\" %s\n"
                 "MediumInterface \"m\" \"\"\nMaterial \"interface\"\nShape \"sphere\"\n",
                 cases[i].medium);
        run run = import(text);
        expect_no_err(&run, "medium");
        run_free(&run);
        expect_in_file("m.rts", cases[i].expected);
    }
    run run = import("WorldBegin\nMaterial \"subsurface\" \"string name\" \"Skin2\"\n"
                     "Shape \"sphere\"\n");
    run_free(&run);
    expect_in_file("m.rts", "absorption 0.013 0.07 0.145\n    scattering 1.09 1.59 1.79");
    run = import("WorldBegin\nMaterial \"subsurface\" \"string name\" \"Lava\"\n"
                 "Shape \"sphere\"\n");
    expect_err(&run, "m.pbrt:2: there is no medium 'Lava' of pbrt's: whole milk stands in its");
    run_free(&run);
}

/* The camera's medium fills all space, unless the camera is in a shape that it fills. */
static void the_medium_of_the_camera_fills_space(void **state)
{
    (void)state;
    run run = import(FOG "MediumInterface \"\" \"fog\"\nCamera \"perspective\"\nWorldBegin\n"
                         "Shape \"disk\" \"float height\" 2\n");
    run_free(&run);
    expect_in_file("m.rts", "{ absorption 0.125 0.25 0.5  scattering 1 1.5 2  g 0.25 }");
    run = import(FOG "MediumInterface \"\" \"fog\"\nCamera \"perspective\"\nWorldBegin\n"
                     "MediumInterface \"fog\" \"\"\nMaterial \"interface\"\n"
                     "Shape \"sphere\" \"float radius\" 20\n");
    run_free(&run);
    expect_not_in_file("m.rts", "\nmedium ");
    expect_in_file("m.rts", "interface true");
}

static void expect_grid(const char *name, const char *word, const float *numbers, size_t count)
{
    unsigned char found[256];
    FILE *const file = fopen(name, "rb");
    assert_non_null(file);
    const size_t size = fread(found, 1, sizeof found, file);
    fclose(file);
    assert_int_equal(size, 20 + 4 * count);
    assert_memory_equal(found, word, 8);
    assert_true(found[8] == 2 && found[12] == 1 && found[16] == 1);
    assert_memory_equal(found + 20, numbers, 4 * count);
}

static void grids_lie_in_the_frame_of_their_medium(void **state)
{
    static const float even[] = {0, 1.5f}, sums[] = {4, 2, 1, 0, 1, 2},
                       parts[] = {0.75f, 0.5f, 0, 0, 1, 0.5f};
    (void)state;
    run run = import("WorldBegin\nTranslate 1 2 3\n"
                     "MakeNamedMedium \"g\" \"string type\" \"uniformgrid\" \"integer nx\" 2\n"
                     "\"float density\" [0 1.5] \"point3 p0\" [-1 -1 -1] \"point3 p1\" [1 2 3]\n"
                     "MediumInterface \"g\" \"\"\nMaterial \"interface\"\nShape \"sphere\"\n");
    run_free(&run);
    expect_in_file("m.rts", "matrix 2 0 0 0 0 3 0 1 0 0 4 2");
    expect_in_file("m.rts", "scattering 1 1 1  density grid_1");
    expect_grid("m_files/grid_0.grid", "RTGRID1\n", even, 2);
    run = import("WorldBegin\n"
                 "MakeNamedMedium \"g\" \"string type\" \"rgbgrid\" \"integer nx\" 2\n"
                 "\"rgb sigma_a\" [1 1 1 0 0 1] \"rgb sigma_s\" [3 1 0 0 1 1] \"float scale\" 2\n"
                 "MediumInterface \"g\" \"\"\nMaterial \"interface\"\nShape \"sphere\"\n");
    run_free(&run);
    expect_in_file("m.rts", "scattering 2 2 2  density grid_1  albedo grid_3");
    expect_grid("m_files/grid_0.grid", "RTGRID3\n", sums, 6);
    expect_grid("m_files/grid_2.grid", "RTGRID3\n", parts, 6);
    run = import("WorldBegin\n"
                 "MakeNamedMedium \"g\" \"string type\" \"uniformgrid\" \"integer nx\" 3\n"
                 "\"float density\" [0 1]\n"
                 "MediumInterface \"g\" \"\"\nMaterial \"interface\"\nShape \"sphere\"\n");
    expect_err(&run, "m.pbrt:2: the grid of a medium is left out: nx, ny and nz are not its "
                     "numbers");
    run_free(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(media_fill_what_lets_light_through, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(media_beside_an_integrator_of_surfaces_are_told,
                                        scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(media_are_those_of_their_blocks, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(media_by_name_have_their_coefficients, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(the_medium_of_the_camera_fills_space, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(grids_lie_in_the_frame_of_their_medium, scratch_enter,
                                        scratch_leave),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests_name("import_media", tests, NULL, NULL);
}
