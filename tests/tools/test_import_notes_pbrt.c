/*
 * test_import_notes_pbrt.c - what an import of pbrt says, and what it reads in silence.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "expect.h"
#include "lib/image/scratch.h"
#include "mesh/load.h"
#include "spawn.h"

/* Real scenes of pbrt have their materials and shapes in files of their own. */
static void places_in_included_files_of_pbrt_are_theirs(void **state)
{
    static const char text[] =
        "Camera \"perspective\" \"float screenwindow\" [ -2 2 -1 1 ]\n"
        "Film \"rgb\" \"integer xresolution\" 40 \"integer yresolution\" 20\n"
        "PixelFilter \"triangle\"\nSampler \"haltn\"\nOption \"seed\" 5\n"
        "WorldBegin\nInclude \"more.pbrt\"\nShape \"cone\"\n",
                      more[] = "# materials\nMaterial \"hair\"\nMakeNamedMaterial \"dark\" "
                               "\"string type\" \"diffuse\"\n \"rgb reflectance\" [ -1 0 0 ]\n"
                               "NamedMaterial \"dark\"\n"
                               "Shape \"sphere\" \"float radus\" 2",
                      broken[] = "\nShape \"sphere\" \"float radius\" \"abc\"\n";
    static const char *const says[] = {
        "main.pbrt:4: there is no sampler 'haltn'",
        "more.pbrt:2: a material 'hair' is unknown: diffuse grey",
        "more.pbrt:3: a negative reflectance, transmittance or roughness became 0",
        "more.pbrt:6: \"float radus\" of sphere is left out",
        "main.pbrt:8: a shape 'cone' is left out",
    };
    (void)state;
    scratch_write("main.pbrt", text);
    scratch_write("more.pbrt", more);
    run run = run_rtc("import main.pbrt --out main.rts");
    expect_status(&run, 0);
    for (size_t i = 0; i < sizeof says / sizeof *says; i++)
        expect_err(&run, says[i]);
    expect_no_err(&run, "main.pbrt:1:");
    expect_no_err(&run, "main.pbrt:3:");
    run_free(&run);
    expect_in_file("main.rts", "filter_radius 2");
    expect_in_file("main.rts", "seed 5");
    expect_in_file("main.rts", "fov     126.869");
    scratch_write("more.pbrt", broken);
    run = run_rtc("import main.pbrt --out main.rts");
    expect_status(&run, 0);
    expect_err(&run, "more.pbrt:2: \"float radius\" takes one number: it counts as not given");
    run_free(&run);
    scratch_write("more.pbrt", "AttributeBegin\n");
    run = run_rtc("import main.pbrt --out main.rts");
    expect_status(&run, 1);
    expect_err(&run, "more.pbrt:1: what begins here is not closed");
    run_free(&run);
}

static void settings_of_pbrt_that_change_the_picture_are_told(void **state)
{
    static const char text[] = "PixelFilter \"box\" \"float xradius\" 2\n"
                               "ColorSpace \"rec2020\"\n"
                               "Sampler \"stratified\" \"integer xsamples\" 3 \"integer seed\" 4\n"
                               "Integrator \"volpath\" \"bool regularize\" true\n"
                               "Option \"disablepixeljitter\" true\n"
                               "WorldBegin\nShape \"sphere\"\n",
                      wide[] = "Option \"seed\" 5\nSampler \"halton\"\nPixelFilter \"gaussian\" "
                               "\"float xradius\" 3 \"float yradius\" 3\n"
                               "WorldBegin\nShape \"sphere\"\n",
                      silent[] = "PixelFilter \"gaussian\"\nColorSpace \"srgb\"\n"
                                 "Integrator \"path\" \"string lightsampler\" \"bvh\"\n"
                                 "WorldBegin\nShape \"sphere\"\n";
    (void)state;
    scratch_write("set.pbrt", text);
    run run = run_rtc("import set.pbrt --out set.rts");
    expect_status(&run, 0);
    expect_err(&run, "set.pbrt:1: a filter of radius 2 x 0.5 became the box of the language");
    expect_err(&run, "set.pbrt:2: the colour space 'rec2020' became srgb");
    expect_err(&run, "set.pbrt:4: regularize is left out");
    expect_err(&run, "set.pbrt:5: Option \"disablepixeljitter\" is left out");
    expect_no_err(&run, "set.pbrt:3");
    run_free(&run);
    expect_in_file("set.rts", "spp 12");
    scratch_write("wide.pbrt", wide);
    run = run_rtc("import wide.pbrt --out wide.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "filter");
    run_free(&run);
    expect_in_file("wide.rts", "filter gaussian }");
    expect_in_file("wide.rts", "seed 5");
    scratch_write("set.pbrt", silent);
    run = run_rtc("import set.pbrt --out set.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "left out");
    expect_no_err(&run, "became");
    run_free(&run);
}

/* A material for each alpha that shapes have, and for those without. */
static void shapes_of_pbrt_have_their_alpha(void **state)
{
    (void)state;
    scratch_write("a.pgm", "P2\n2 1\n255\n0 255\n");
    scratch_write(
        "alpha.pbrt",
        "WorldBegin\nTexture \"leaf\" \"float\" \"imagemap\" \"string filename\" \"a.pgm\"\n"
        "Material \"diffuse\" \"rgb reflectance\" [.5 .1 .1]\n"
        "Shape \"sphere\" \"texture alpha\" \"leaf\"\n"
        "Shape \"sphere\" \"float alpha\" 0.25\nShape \"sphere\"\n"
        "Shape \"disk\" \"float alpha\" 0.25\nShape \"disk\" \"float alpha\" 1\n"
        "Material \"dielectric\"\nShape \"sphere\" \"float alpha\" 0.5\n");
    run run = run_rtc("import alpha.pbrt --out alpha.rts");
    expect_status(&run, 0);
    expect_err(&run, "alpha.pbrt:10: the alpha of a shape of glass, or of what has an opacity, is "
                     "left out");
    expect_no_err(&run, "is not read");
    run_free(&run);
    expect_in_file("alpha.rts", "kd 0.5 0.1 0.1  opacity_texture leaf_1 }");
    expect_in_file("alpha.rts", "kd 0.5 0.1 0.1  opacity 0.25 }");
    expect_in_file("alpha.rts", "kd 0.5 0.1 0.1 }");
    run = run_rtc("check alpha.rts");
    expect_status(&run, 0);
    expect_out(&run, "6 shapes, 0 triangles, 4 materials");
    run_free(&run);
}

static void maps_of_pbrt_are_kept(void **state)
{
    (void)state;
    scratch_write("n.ppm", "P3\n1 1\n255\n127 127 255\n");
    scratch_write("maps.pbrt",
                  "WorldBegin\nTexture \"h\" \"float\" \"imagemap\" \"string filename\" \"n.ppm\" "
                  "\"float scale\" 0.02\n"
                  "Material \"diffuse\" \"string normalmap\" \"n.ppm\"\nShape \"sphere\"\n"
                  "Material \"diffuse\" \"texture displacement\" \"h\"\nShape \"sphere\"\n");
    run run = run_rtc("import maps.pbrt --out maps.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "displacement");
    expect_no_err(&run, "normalmap");
    run_free(&run);
    expect_in_file("maps.rts", "texture normals_");
    expect_in_file("maps.rts", "linear true }\n");
    expect_in_file("maps.rts", "normal_texture normals_");
    expect_in_file("maps.rts", "bump_texture h_");
    expect_in_file("maps.rts", "bump_scale 0.02");
    expect_rtc(0, "check maps.rts");
}

/* alpha is the root of the roughness, that of a texture's values too, unless it is not remapped. */
static void textures_of_roughness_of_pbrt_are_kept(void **state)
{
    (void)state;
    scratch_write("a.pgm", "P2\n2 1\n255\n0 255\n");
    scratch_write(
        "rough.pbrt",
        "WorldBegin\nTexture \"r\" \"float\" \"imagemap\" \"string filename\" \"a.pgm\" \"string "
        "encoding\" \"linear\" \"float scale\" 0.25\n"
        "Texture \"c\" \"float\" \"constant\" \"float value\" 0.09\n"
        "Material \"dielectric\" \"texture roughness\" \"r\"\nShape \"sphere\"\n"
        "Material \"dielectric\" \"texture roughness\" \"r\" \"bool remaproughness\" false\n"
        "Shape \"sphere\"\nMaterial \"dielectric\" \"texture roughness\" \"c\"\nShape \"sphere\"\n"
        "Material \"coateddiffuse\" \"texture roughness\" \"r\"\nShape \"sphere\"\n");
    expect_rtc(0, "import rough.pbrt --out rough.rts");
    expect_in_file("rough.rts",
                   "roughness_2 { file \"rough_files/a_pgm_0.ppm\"  linear true  power "
                   "0.5 }");
    expect_in_file("rough.rts", "    roughness         0.5\n");
    expect_in_file("rough.rts", "    roughness_texture roughness_2\n");
    expect_in_file("rough.rts", "    roughness         0.25\n");
    expect_in_file("rough.rts", "    roughness_texture r_1\n");
    expect_in_file("rough.rts", "    roughness        0.3\n");
    expect_in_file("rough.rts", "    coat_roughness_texture roughness_2\n");
    expect_rtc(0, "check rough.rts");
}

/* A metal below a coat, whose thickness counts only where something scatters in it. */
static void coated_conductors_of_pbrt_are_lacquered(void **state)
{
    (void)state;
    scratch_write("lacquer.pbrt",
                  "WorldBegin\nMaterial \"coatedconductor\" \"float interface.roughness\" 0.01\n"
                  "\"float interface.eta\" 1.6 \"spectrum conductor.eta\" \"metal-Au-eta\"\n"
                  "\"spectrum conductor.k\" \"metal-Au-k\" \"float conductor.roughness\" 0.04\n"
                  "\"float thickness\" 0.01\nShape \"sphere\"\n"
                  "Material \"coatedconductor\" \"rgb albedo\" [0.1 0 0]\nShape \"sphere\"\n");
    run run = run_rtc("import lacquer.pbrt --out lacquer.rts");
    expect_no_err(&run, "thickness");
    expect_err(&run, "lacquer.pbrt:7: scattering inside of a coat is left out");
    expect_in_file("lacquer.rts", "    roughness        0.2\n    coat             1\n"
                                  "    coat_roughness   0.1\n    fresnel          conductor\n");
    expect_in_file("lacquer.rts", "    coat_ior         1.6\n    facet_scattering single\n");
    expect_rtc(0, "check lacquer.rts");
}

/* A mix of pbrt is a blend of materials by name, whose second one has the amount. */
static void mixes_of_pbrt_become_blends(void **state)
{
    (void)state;
    scratch_write("mix.pbrt",
                  "WorldBegin\nMakeNamedMaterial \"a\" \"string type\" \"diffuse\"\n"
                  "MakeNamedMaterial \"g\" \"string type\" \"conductor\"\n"
                  "Material \"mix\" \"string materials\" [\"a\" \"g\"] \"float amount\" 0.25\n"
                  "Shape \"sphere\"\n");
    run run = run_rtc("import mix.pbrt --out mix.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "left out");
    run_free(&run);
    expect_in_file("mix.rts", "{ blend a_0  with g_1  weight 0.25 }");
    expect_rtc(0, "check mix.rts");
    scratch_write("mix.pbrt", "WorldBegin\nMaterial \"mix\" \"string materials\" [\"a\" \"b\"]\n");
    expect_rtc(1, "import mix.pbrt --out mix.rts");
    scratch_write(
        "three.pbrt",
        "WorldBegin\nMakeNamedMaterial \"a\" \"string type\" \"matte\"\n"
        "MakeNamedMaterial \"b\" \"string type\" \"mirror\"\n"
        "Material \"mix\" \"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"b\" "
        "\"rgb amount\" [0.75 0.75 0.75]\nShape \"sphere\"\n");
    expect_rtc(0, "import three.pbrt --out three.rts");
    expect_in_file("three.rts", "{ blend b_0  with a_1  weight 0.75 }");
}

/* The poles of spheres, and u and v of meshes without any, are those of pbrt where they show. */
static void coordinates_of_pbrt_are_its_own(void **state)
{
    static const char *const shapes =
        "Shape \"sphere\"\n"
        "Shape \"bilinearmesh\" \"point3 P\" [0 0 0  1 0 0  0 1 0  1 1 0]\n"
        "ReverseOrientation\nShape \"trianglemesh\" \"point3 P\" [0 0 0  1 0 0  0 1 0]\n";
    char text[1024];
    (void)state;
    snprintf(text, sizeof text, "WorldBegin\nMaterial \"diffuse\"\n%s", shapes);
    scratch_write("plain.pbrt", text);
    expect_rtc(0, "import plain.pbrt --out plain.rts");
    expect_in_file("plain.rts", "{ centre 0 0 0  radius 1  material material_0 }");
    snprintf(text, sizeof text,
             "WorldBegin\nTexture \"c\" \"spectrum\" \"checkerboard\"\n"
             "Material \"diffuse\" \"texture reflectance\" \"c\"\n%s",
             shapes);
    scratch_write("laid.pbrt", text);
    run run = run_rtc("import laid.pbrt --out laid.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "u and v");
    run_free(&run);
    expect_in_file("laid.rts", "material material_1  matrix 1 0 0 0 0 0 -1 0 0 1 0 0 }");
    rt_mesh *mesh;
    rt_error error;
    static const float patch[12] = {0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1},
                       triangle[6] = {0, 0, 1, 1, 1, 0};
    assert_int_equal(rt_mesh_load(&mesh, "laid_files/mesh_2.ply", NULL, &error), RT_OK);
    assert_int_equal(mesh->vertex_count, 6);
    assert_memory_equal(mesh->uv, patch, sizeof patch);
    rt_mesh_destroy(mesh);
    assert_int_equal(rt_mesh_load(&mesh, "laid_files/mesh_4.ply", NULL, &error), RT_OK);
    assert_memory_equal(mesh->uv, triangle, sizeof triangle);
    rt_mesh_destroy(mesh);
}

/* pbrt's default, one by its mean free path, and what cannot be one. */
static void subsurface_of_pbrt_is_a_solid_that_scatters(void **state)
{
    (void)state;
    scratch_write("wax.pbrt",
                  "WorldBegin\n"
                  "Material \"subsurface\" \"float scale\" 10 \"float g\" 0.5\nShape \"sphere\"\n"
                  "Material \"subsurface\" \"rgb reflectance\" [1 0 0.5] \"rgb mfp\" [0.5 0 0.1] "
                  "\"string name\" \"Ketchup\"\nShape \"sphere\"\n");
    run run = run_rtc("import wax.pbrt --out wax.rts");
    expect_status(&run, 0);
    expect_err(&run, "wax.pbrt:2: a subsurface became a solid in which light scatters (also at 4)");
    expect_err(&run, "wax.pbrt:4: reflectance and mfp of a subsurface are left out beside its");
    run_free(&run);
    expect_in_file("wax.rts", "absorption   0.011 0.024 0.14\n    scattering   25.5 32.1 37.7\n");
    expect_in_file("wax.rts", "ior          1.33\n");
    expect_rtc(0, "check wax.rts");
}

#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, scratch_enter, scratch_leave)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_SCRATCH(coated_conductors_of_pbrt_are_lacquered),
        IN_SCRATCH(places_in_included_files_of_pbrt_are_theirs),
        IN_SCRATCH(settings_of_pbrt_that_change_the_picture_are_told),
        IN_SCRATCH(shapes_of_pbrt_have_their_alpha),
        IN_SCRATCH(maps_of_pbrt_are_kept),
        IN_SCRATCH(textures_of_roughness_of_pbrt_are_kept),
        IN_SCRATCH(mixes_of_pbrt_become_blends),
        IN_SCRATCH(coordinates_of_pbrt_are_its_own),
        IN_SCRATCH(subsurface_of_pbrt_is_a_solid_that_scatters),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests_name("import_notes_pbrt", tests, NULL, NULL);
}
