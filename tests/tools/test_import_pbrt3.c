/* test_import_pbrt3.c - older files: those of pbrt-v3 and of Mitsuba 0.x by their rules. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "expect.h"
#include "lib/image/scratch.h"
#include "spawn.h"

static void materials_of_version_3_are_read(void **state)
{
    (void)state;
    scratch_write(
        "s.pbrt",
        "Film \"image\" \"integer xresolution\" 32 \"integer yresolution\" 16\nWorldBegin\n"
        "Material \"matte\" \"rgb Kd\" [0.5 0.25 0.125]\nShape \"sphere\"\n"
        "Material \"mirror\" \"rgb Kr\" [0.75 0.5 0.25]\nShape \"sphere\"\n"
        "Material \"glass\" \"float index\" 1.25\nShape \"sphere\"\n"
        "Material \"metal\" \"float roughness\" 0.25 \"bool remaproughness\" \"false\"\n"
        "Shape \"sphere\"\n"
        "Material \"plastic\" \"rgb Kd\" [0.125 0.25 0.375] \"rgb Ks\" [0.5 0.5 0.5] \"float "
        "roughness\" 0.0625 \"bool remaproughness\" \"false\"\nShape \"sphere\"\n"
        "Material \"uber\" \"rgb Kr\" [1 1 1] \"float opacity\" 0.5\nShape \"sphere\"\n"
        "Material \"matte\" \"float sigma\" 20\nShape \"sphere\"\n"
        "LightSource \"distant\" \"blackbody L\" [6500 2]\n");
    run run = run_rtc("import s.pbrt --out s.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "film");
    expect_no_err(&run, "grey");
    expect_err(&run, "s.pbrt: a file of pbrt-v3: its materials are read by its rules");
    expect_err(&run, "s.pbrt:11: Kd and Ks became a coat over a diffuse base (also at 13)");
    expect_err(&run, "s.pbrt:13: Kr and Kt of an uber material are left out");
    expect_err(&run,
               "s.pbrt:15: a rough diffuse surface keeps all light, of which Oren and Nayar's "
               "loses up to 13 %");
    run_free(&run);
    expect_in_file("s.rts", "roughness 0.299");
    expect_in_file("s.rts", "{ kd 0.5 0.25 0.125 }");
    expect_in_file("s.rts", "{ ks 0.75 0.5 0.25 }");
    expect_in_file("s.rts", "{ kt 1 1 1  fresnel dielectric  ior 1.25  relative_ior true }");
    expect_in_file("s.rts", "eta");
    expect_in_file("s.rts", "    relative_ior   true\n    coat_ior       1.5\n");
    expect_in_file("s.rts", "opacity");
}

/* Lights have their spectra as they are, which v4 brings to luminance 1, and a coloured scale. */
static void lights_of_version_3_are_not_normalized(void **state)
{
    static const char light[] = "LightSource \"point\" \"spectrum I\" [400 10 700 10]\n"
                                "LightSource \"point\" \"rgb I\" [4 4 4] \"rgb scale\" [1 0.5 2]\n"
                                "Shape \"sphere\"\n";
    char text[400];
    (void)state;
    snprintf(text, sizeof text, "Film \"image\"\nWorldBegin\n%s", light);
    scratch_write("s.pbrt", text);
    run run = run_rtc("import s.pbrt --out s.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "left out");
    run_free(&run);
    expect_in_file("s.rts", "intensity 11.998");
    expect_in_file("s.rts", "intensity 4 2 8 }");
    snprintf(text, sizeof text, "Film \"rgb\"\nWorldBegin\n%s", light);
    scratch_write("s.pbrt", text);
    expect_rtc(0, "import s.pbrt --out s.rts");
    expect_in_file("s.rts", "intensity 1.2005");
}

/* A box without PixelFilter, and the parameters of version 3; gaussian of v4. */
static void filters_of_version_3_are_read(void **state)
{
    static const struct {
        const char *film, *filter, *right;
    } all[] = {
        {"image", "", "filter box"},
        {"rgb", "", "filter gaussian"},
        {"image",
         "PixelFilter \"gaussian\" \"float xwidth\" 3 \"float ywidth\" 3 \"float alpha\" 0.5\n",
         "filter gaussian  filter_radius 3"},
        {"image", "PixelFilter \"triangle\" \"float xwidth\" 3 \"float ywidth\" 3\n",
         "filter tent  filter_radius 3"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        char text[300];
        snprintf(text, sizeof text, "%sFilm \"%s\"\nWorldBegin\nShape \"sphere\"\n", all[i].filter,
                 all[i].film);
        scratch_write("s.pbrt", text);
        run run = run_rtc("import s.pbrt --out s.rts");
        expect_status(&run, 0);
        expect_no_err(&run, "filter");
        run_free(&run);
        expect_in_file("s.rts", all[i].right);
    }
}

static void more_materials_of_version_3_are_read(void **state)
{
    (void)state;
    scratch_write("n.ppm", "P3 1 1 255 128 128 255\n");
    scratch_write("s.pbrt",
                  "Film \"image\"\nWorldBegin\n"
                  "Material \"translucent\" \"rgb Kd\" [1 0.5 0.25] \"rgb Ks\" [0 0 0]\n"
                  "Shape \"sphere\"\n"
                  "Material \"disney\" \"rgb color\" [1 0.5 0.25] \"float metallic\" 0.5 "
                  "\"float roughness\" 0.25\nShape \"sphere\"\n"
                  "Texture \"raw\" \"spectrum\" \"imagemap\" \"string filename\" \"n.ppm\" "
                  "\"bool gamma\" \"false\"\nMaterial \"matte\" \"texture Kd\" \"raw\"\n"
                  "Shape \"sphere\"\n");
    run run = run_rtc("import s.pbrt --out s.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "left out");
    expect_err(&run, "s.pbrt: 2 of 3 materials exact, 1 approximated: disney");
    run_free(&run);
    expect_in_file("s.rts", "{ kd 0.5 0.25 0.125  diffuse_transmission 0.5 0.25 0.125 }");
    expect_in_file("s.rts", "base_color 1 0.5 0.25");
    expect_in_file("s.rts", "linear true");
    expect_rtc(0, "check s.rts");
}

/* What is told where it is written counts as well as what is told where it is read, once. */
static void reflectances_above_1_are_counted_as_approximated(void **state)
{
    (void)state;
    scratch_write("s.pbrt",
                  "WorldBegin\nMakeNamedMaterial \"bright\" \"string type\" \"diffuse\" "
                  "\"rgb reflectance\" [1.5 0.5 2]\nNamedMaterial \"bright\"\nShape \"sphere\"\n"
                  "Shape \"sphere\" \"float alpha\" 0.5\n"
                  "Material \"diffuse\" \"rgb reflectance\" [2 0.5 0.5]\nShape \"sphere\"\n"
                  "Material \"diffuse\" \"rgb reflectance\" [1 0.5 0.5]\nShape \"sphere\"\n");
    run run = run_rtc("import s.pbrt --out s.rts");
    expect_status(&run, 0);
    expect_err(&run, "s.pbrt:2: a reflectance, transmittance or roughness above 1 became 1");
    expect_err(&run, "s.pbrt: 1 of 3 materials exact, 2 approximated: bright, material of line 6");
    run_free(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(materials_of_version_3_are_read),
        cmocka_unit_test(lights_of_version_3_are_not_normalized),
        cmocka_unit_test(filters_of_version_3_are_read),
        cmocka_unit_test(more_materials_of_version_3_are_read),
        cmocka_unit_test(reflectances_above_1_are_counted_as_approximated),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests(tests, scratch_enter, scratch_leave);
}
