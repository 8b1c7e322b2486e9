/*
 * test_import_notes.c - what an import says: what the language lacks is told with its place, and
 * what it has is read in silence; what is of one format alone stands beside in its own file.
 */
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
#include "mesh/load.h"
#include "spawn.h"
#include "tools/gltf_triangle.h"

/* What is left out is a warning and a comment, each with its line. */
static void what_is_left_out_is_told(void **state)
{
    static const char text[] = "<scene>\n<shape type=\"sphere\">\n<bsdf type=\"measured\"/>\n"
                               "</shape>\n<shape type=\"sdfgrid\"/>\n</scene>\n";
    (void)state;
    scratch_write("note.xml", text);
    run run = run_rtc("import note.xml --out note.rts");
    expect_status(&run, 0);
    expect_err(&run, "note.xml:3: a material 'measured' is unknown: diffuse grey of 0.5");
    expect_err(&run, "note.xml:5: a shape 'sdfgrid' is left out");
    expect_err(&run, "no camera");
    run_free(&run);
    expect_in_file("note.rts", "# - note.xml:3: a material 'measured' is unknown: diffuse grey of "
                               "0.5 stands in its place\n");
    expect_in_file("note.rts", "# - note.xml:5: a shape 'sdfgrid' is left out\n");
    expect_rtc(0, "fmt --check note.rts");
}

/* Lights come before shapes, shapes before materials; and what is told often, before the rare. */
static void what_concerns_most_of_the_picture_comes_first(void **state)
{
    static const char text[] =
        "<scene>\n<shape type=\"sphere\"><bsdf type=\"measured\"/></shape>\n"
        "<shape type=\"sphere\"><bsdf type=\"hair\"/></shape>\n"
        "<shape type=\"sphere\"><bsdf type=\"hair\"/></shape>\n"
        "<shape type=\"sdfgrid\"/>\n<emitter type=\"volumelight\"/>\n</scene>\n";
    static const char *const order[] = {"'volumelight'", "no camera", "'sdfgrid'", "'hair'",
                                        "'measured'"};
    (void)state;
    scratch_write("order.xml", text);
    run run = run_rtc("import order.xml --out order.rts");
    expect_status(&run, 0);
    const char *at = run.err;
    for (size_t i = 0; i < sizeof order / sizeof *order; i++) {
        at = strstr(at, order[i]);
        if (!at)
            fail_msg("%s is not behind the one before:\n%s", order[i], run.err);
    }
    run_free(&run);
}

/* What the language has no room for is bounded, and the picture still comes. */
static void numbers_beyond_the_language_are_bounded(void **state)
{
    static const char obj[] = "mtllib far.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n"
                              "f 1/1 2/1 3/1\n";
    static const struct {
        const char *line, *says;
    } cases[] = {
        {"Ke 1e30 1 1", "far.mtl:1: a component of emission above 1e+28 became that"},
        {"map_Kd -o 1e30 0 t.ppm", "far.mtl: the offset of a texture, beyond 1e+09, became that"},
        {"map_Kd -s 1 -1e30 t.ppm", "far.mtl: the scale of a texture, beyond 1e+09, became that"},
        {"norm -bm 1e20 t.ppm", "far.mtl:1: a scale of a normal map of 1e+20 became 1e+15"},
    };
    (void)state;
    scratch_write("far.obj", obj);
    scratch_write("t.ppm", "P3 1 1 255 128 128 255\n");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[200];
        snprintf(text, sizeof text, "newmtl m\nKd 0.5 0.5 0.5\n%s\n", cases[i].line);
        scratch_write("far.mtl", text);
        run run = run_rtc("check far.obj");
        expect_status(&run, 0);
        expect_err(&run, cases[i].says);
        run_free(&run);
    }
}

/* Metals and glasses by name are those of the language; of Mitsuba its own. */
static void metals_and_glasses_have_the_indices_of_the_language(void **state)
{
    (void)state;
    scratch_write(
        "named.pbrt",
        "WorldBegin\nMaterial \"conductor\" \"spectrum eta\" \"metal-CuZn-eta\" \"spectrum k\" "
        "\"metal-CuZn-k\"\nShape \"sphere\"\n"
        "Material \"dielectric\" \"spectrum eta\" \"glass-F11\"\nShape \"sphere\"\n"
        "Material \"dielectric\" \"spectrum eta\" \"glass-XY\"\nShape \"sphere\"\n");
    run run = run_rtc("import named.pbrt --out named.rts");
    expect_status(&run, 0);
    expect_err(&run, "named.pbrt:6: the glass 'glass-XY' became one of index 1.5");
    run_free(&run);
    expect_in_file("named.rts",
                   "eta          0.482 0.524 1.128\n    k            4.374 2.67 1.814");
    expect_in_file("named.rts", "glass sf11  dispersion true");
    scratch_write(
        "named.xml",
        "<scene><shape type=\"sphere\"><bsdf type=\"conductor\"><string name=\"material\" "
        "value=\"Hg\"/></bsdf></shape>\n<shape type=\"sphere\"><bsdf type=\"dielectric\">"
        "<string name=\"int_ior\" value=\"water\"/><float name=\"ext_ior\" value=\"1\"/>"
        "</bsdf></shape></scene>\n");
    expect_rtc(0, "import named.xml --out named_xml.rts");
    expect_in_file("named_xml.rts", "2.39894 1.44003 0.90957");
    expect_in_file("named_xml.rts", "ior 1.333");
}

/* Facets keep their distribution, and their roughness along u and along v. */
static void facets_are_those_of_the_file(void **state)
{
    (void)state;
    scratch_write("facets.xml",
                  "<scene>\n<shape type=\"rectangle\"><bsdf type=\"roughconductor\">"
                  "<float name=\"alpha_u\" value=\"0.25\"/><float name=\"alpha_v\" value=\"0.5\"/>"
                  "</bsdf></shape>\n<shape type=\"sphere\"><bsdf type=\"roughdielectric\">"
                  "<float name=\"alpha_u\" value=\"0.125\"/>"
                  "<string name=\"distribution\" value=\"ggx\"/></bsdf></shape>\n"
                  "<shape type=\"sphere\"><bsdf type=\"roughplastic\"/></shape>\n</scene>\n");
    run run = run_rtc("import facets.xml --out facets.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "the directions of roughness");
    run_free(&run);
    expect_in_file("facets.rts", "    facet_scattering separable\n    distribution     beckmann\n");
    expect_in_file("facets.rts", "roughness        0.125\n    roughness_v      0.1\n");
    expect_in_file("facets.rts", "    coat_ior         1.4895874\n    coat_linear      true\n"
                                 "    facet_scattering separable\n    distribution     beckmann\n");
    scratch_write("facets.pbrt",
                  "WorldBegin\nMaterial \"conductor\" \"float uroughness\" 0.25 "
                  "\"float vroughness\" 0.01\nShape \"sphere\"\n"
                  "Material \"dielectric\" \"float uroughness\" 0.25 \"float vroughness\" 0 "
                  "\"bool remaproughness\" false\nShape \"sphere\"\n"
                  "Material \"coateddiffuse\" \"float uroughness\" 0.09 \"float vroughness\" 0.01\n"
                  "Shape \"sphere\"\n");
    run = run_rtc("import facets.pbrt --out facets_pbrt.rts");
    expect_status(&run, 0);
    expect_err(&run, "facets.pbrt:6: a roughness of a coat by direction became the same for all");
    run_free(&run);
    expect_in_file("facets_pbrt.rts", "roughness        0.5\n    roughness_v      0.1\n");
    expect_in_file("facets_pbrt.rts", "roughness        0.25\n    roughness_v      0.001\n");
}

/* Leaves and paper keep what they let through: reflectance, transmittance, factor and colour. */
static void diffuse_transmission_is_that_of_the_file(void **state)
{
    (void)state;
    scratch_write("leaf.pbrt",
                  "WorldBegin\nMaterial \"diffusetransmission\" \"rgb reflectance\" [0.5 0.25 0.5] "
                  "\"rgb transmittance\" [1 0.5 0.25] \"float scale\" 0.5\nShape \"sphere\"\n");
    expect_rtc(0, "import leaf.pbrt --out leaf_pbrt.rts");
    expect_in_file("leaf_pbrt.rts", "kd 0.25 0.125 0.25  diffuse_transmission 0.5 0.25 0.125 }");
    scratch_write("leaf.xml",
                  "<scene>\n<shape type=\"sphere\"><bsdf type=\"difftrans\">"
                  "<rgb name=\"transmittance\" value=\"0.25 0.5 0.125\"/></bsdf></shape>\n"
                  "</scene>\n");
    expect_rtc(0, "import leaf.xml --out leaf_xml.rts");
    expect_in_file("leaf_xml.rts", "{ diffuse_transmission 0.25 0.5 0.125 }");
    scratch_write("leaf.gltf",
                  "{\"asset\":{\"version\":\"2.0\"},\"materials\":[{\"pbrMetallicRoughness\":"
                  "{\"metallicFactor\":0,\"baseColorFactor\":[0.5,0.25,0.5,1]},\"extensions\":"
                  "{\"KHR_materials_specular\":{\"specularFactor\":0},"
                  "\"KHR_materials_diffuse_transmission\":{\"diffuseTransmissionFactor\":0.25,"
                  "\"diffuseTransmissionTexture\":{\"index\":0},"
                  "\"diffuseTransmissionColorFactor\":[1,0.5,0.25]}}}]," GLTF_TRIANGLE);
    run run = run_rtc("import leaf.gltf --out leaf_gltf.rts");
    expect_status(&run, 0);
    expect_err(&run, "a diffuseTransmissionTexture is left out: the factor holds all over");
    run_free(&run);
    expect_in_file("leaf_gltf.rts",
                   "kd 0.375 0.1875 0.375  diffuse_transmission 0.25 0.125 0.0625");
}
/* A glTF file of a triangle by a program. */
static void write_triangle(const char *file, const char *maker, const char *material)
{
    char text[1500];
    snprintf(text, sizeof text,
             "{\"asset\":{\"version\":\"2.0\",\"generator\":\"%s\"},\"materials\":[{%s}],"
             "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:;base64,"
             "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}],"
             "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
             "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,"
             "\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,1,0]}],"
             "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},"
             "\"material\":0}]}],\"nodes\":[{\"mesh\":0}],"
             "\"scenes\":[{\"nodes\":[0]}],\"scene\":0}",
             maker, material);
    scratch_write(file, text);
}

#define BLENDER "Khronos glTF Blender I/O v4.5.51"

/*
 * KHR_materials_anisotropy mixes alpha along its direction with 1, by its strength squared; by
 * Blender, strength 0.5 is an aspect of sqrt(1 - 0.45).
 */
static void anisotropy_of_gltf_is_along_its_direction(void **state)
{
    static const char material[] =
        "\"pbrMetallicRoughness\":{\"roughnessFactor\":0.5,\"baseColorFactor\":[0.5,0.5,0.5,1]},"
        "\"extensions\":{\"KHR_materials_anisotropy\":{\"anisotropyStrength\":0.5,"
        "\"anisotropyRotation\":1.5707963267948966}}";
    (void)state;
    write_triangle("facets.gltf", BLENDER, material);
    expect_rtc(0, "import facets.gltf --out facets_gltf.rts");
    expect_in_file("facets_gltf.rts",
                   "roughness           0.33709994\n    roughness_v         0.18540496\n");
    write_triangle("facets.gltf", "another", material);
    expect_rtc(0, "import facets.gltf --out facets_gltf.rts");
    expect_in_file("facets_gltf.rts", "roughness           0.4375\n    roughness_v         0.25\n");
    expect_in_file("facets_gltf.rts", "anisotropy_rotation 90\n");
}

/*
 * Blender writes (1 - blend) of the outer angle as the inner one, and lets a spot fall from where
 * its cosine has come down by blend of the way: of 30 degrees and 0.3, 21 and 25.0122.
 */
static void spots_of_blender_fall_as_in_cycles(void **state)
{
    static const char spot[] =
        "{\"asset\":{\"version\":\"2.0\",\"generator\":\"%s\"},\"extensionsUsed\":["
        "\"KHR_lights_punctual\"],\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{"
        "\"type\":\"spot\",\"spot\":{\"innerConeAngle\":%s,\"outerConeAngle\":"
        "0.5235987755982988}}]}},\"nodes\":[{\"extensions\":{\"KHR_lights_punctual\":{\"light\":"
        "0}}}],\"scenes\":[{\"nodes\":[0]}]}";
    static const struct {
        const char *maker, *inner, *becomes, *falloff;
    } cases[] = {{BLENDER, "0.3665191429188092", "inner     25.0122", NULL},
                 {BLENDER, "0", "inner     0\n", NULL},
                 {BLENDER, "0.5235987755982988", "inner     30", NULL},
                 {"another", "0.3665191429188092", "inner     21", "falloff   square"}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[sizeof spot + 64];
        snprintf(text, sizeof text, spot, cases[i].maker, cases[i].inner);
        scratch_write("spot.gltf", text);
        run run = run_rtc("import spot.gltf --out spot.rts");
        expect_status(&run, 0);
        expect_no_err(&run, "a spot light");
        run_free(&run);
        expect_in_file("spot.rts", cases[i].becomes);
        if (cases[i].falloff)
            expect_in_file("spot.rts", cases[i].falloff);
        else
            expect_not_in_file("spot.rts", "falloff"); /* smooth */
    }
}

/* What its exporter of glTF leaves out, which no other file of its would show. */
static void what_blender_does_not_write_is_told(void **state)
{
    static const char cloth[] =
        "\"pbrMetallicRoughness\":{\"metallicFactor\":0},\"extensions\":"
        "{\"KHR_materials_sheen\":{\"sheenColorFactor\":[1,1,1],\"sheenRoughnessFactor\":0.5}}";
    static const char *const told[] = {
        "materials[0] 'paint': it is white: Blender writes no other materials than its Principled "
        "BSDF",
        "its sheen is as strong as its tint: Blender writes no weight of it"};
    (void)state;
    for (int i = 0; i < 4; i++) {
        write_triangle("white.gltf", i % 2 ? "another" : BLENDER,
                       i < 2 ? "\"name\":\"paint\"" : cloth);
        run run = run_rtc("import white.gltf --out white.rts");
        expect_status(&run, 0);
        if (i % 2)
            expect_no_err(&run, "Blender");
        else
            expect_err(&run, told[i / 2]);
        run_free(&run);
    }
}

/* Without its library a file has no materials, which is told once. */
static void missing_materials_are_told_once(void **state)
{
    (void)state;
    scratch_write("bare.obj", "mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n"
                              "usemtl b\nf 1 2 3\n");
    run run = run_rtc("import bare.obj --out bare.rts");
    expect_status(&run, 0);
    expect_err(&run, "bare.obj:5: there are no materials: grey ones were added (also at 7)\n");
    expect_no_err(&run, "there is no material");
    run_free(&run);
}

/* Polygons of OBJ are cut as where the language reads the file itself, and told alike. */
static void polygons_are_cut_as_by_the_library(void **state)
{
#define HORSESHOE                                                                                  \
    "v 0 0 0\nv 3 0 0\nv 3 3 0\nv 2 3 0\nv 2 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\n"                     \
    "f 4 5 6 7 8 1 2 3\n"
    rt_error error;
    rt_mesh *mesh;
    float area = 0;
    (void)state;
    scratch_write("faces.obj", HORSESHOE "f 1 3 2 8\nf 5 5 5 5\n");
    run run = run_rtc("import faces.obj --out faces.rts");
    expect_status(&run, 0);
    expect_err(&run,
               "faces.obj:10: a face crosses itself: parts of it may be covered twice or not");
    expect_err(&run, "faces.obj:11: a face has all its corners on one line: it is not seen");
    run_free(&run);
    scratch_write("u.obj", HORSESHOE);
    expect_rtc(0, "import u.obj --out u.rts");
    assert_int_equal(rt_mesh_load(&mesh, "u_files/mesh_1.ply", NULL, &error), RT_OK);
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t *t = mesh->indices + 3 * i;
        const float *a = mesh->positions + 3 * t[0], *b = mesh->positions + 3 * t[1],
                    *c = mesh->positions + 3 * t[2];
        area += 0.5f * fabsf((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    }
    assert_true(area == 7);
    rt_mesh_destroy(mesh);
}

/* An OBJ far from the origin keeps its digits. */
static void far_meshes_keep_their_digits(void **state)
{
    rt_error error;
    rt_mesh *mesh;
    (void)state;
    scratch_write("far.obj", "v 448262.375 5411932.6875 0\nv 448262.390625 5411932.6875 0\n"
                             "v 448262.375 5411932.703125 0\nf 1 2 3\n");
    expect_rtc(0, "import far.obj --out far.rts");
    assert_int_equal(rt_mesh_load(&mesh, "far_files/mesh_1.ply", NULL, &error), RT_OK);
    assert_true(mesh->origin[1] + mesh->positions[1] == 5411932.6875);
    assert_true(mesh->origin[1] + mesh->positions[7] == 5411932.703125);
    rt_mesh_destroy(mesh);
}

/* A roughness or metalness out of range is told where it stands, as a reflectance is. */
static void numbers_of_mtl_out_of_range_are_told(void **state)
{
    (void)state;
    scratch_write("range.mtl", "newmtl a\nKd .8 .6 .4\nPr -1\nPm 3\nnewmtl b\nPr 1\nPm 0\n"
                               "newmtl c\nKd .8 .2\nd 5\nNs -5\nTr -1\n");
    scratch_write("range.obj", "mtllib range.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
    run run = run_rtc("import range.obj --out range.rts");
    expect_status(&run, 0);
    expect_err(&run, "range.mtl:3: Pr -1 is out of range: it became 0");
    expect_err(&run, "range.mtl:4: Pm 3 is out of range: it became 1");
    expect_err(&run, "range.mtl:9: two numbers are no colour: the third became 0.8");
    expect_err(&run, "range.mtl:10: d 5 is out of range: it became 1");
    expect_err(&run, "range.mtl:11: Ns -5 is out of range: it became 0");
    expect_err(&run, "range.mtl:12: Tr -1 is out of range: it became 0");
    expect_no_err(&run, "range.mtl:6");
    expect_no_err(&run, "range.mtl:7");
    run_free(&run);
}

/* Normal maps are linear, whatever their file says; heights keep their scale. */
static void maps_of_normals_and_heights_are_kept(void **state)
{
    static const char xml[] =
        "<scene version=\"3.0.0\"><shape type=\"rectangle\"><bsdf type=\"normalmap\">"
        "<boolean name=\"use_shadowing_function\" value=\"false\"/>"
        "<boolean name=\"flip_invalid_normals\" value=\"false\"/>"
        "<texture name=\"normalmap\" type=\"bitmap\"><string name=\"filename\" value=\"n.ppm\"/>"
        "</texture><bsdf type=\"diffuse\"/></bsdf></shape><shape type=\"rectangle\">"
        "<bsdf type=\"bumpmap\"><boolean name=\"flip_invalid_normals\" value=\"false\"/>"
        "<texture name=\"arbitrary\" type=\"bitmap\"><boolean name=\"raw\" "
        "value=\"true\"/><string name=\"filename\" value=\"n.ppm\"/></texture>"
        "<float name=\"scale\" value=\"0.25\"/><bsdf type=\"diffuse\"/></bsdf></shape></scene>";
    static const char gltf[] =
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],"
        "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":"
        "{\"POSITION\":0},\"material\":0}]}],\"images\":[{\"uri\":\"n.ppm\"}],"
        "\"textures\":[{\"source\":0}],\"materials\":[{\"normalTexture\":{\"index\":0,"
        "\"scale\":0.5}}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
        "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
        "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}";
    (void)state;
    scratch_write("n.ppm", "P3 1 1 255 128 128 255\n");
    scratch_write("maps.xml", xml);
    run run = run_rtc("import maps.xml --out maps.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "left out");
    run_free(&run);
    expect_in_file("maps.rts", "linear true  scale 1 -1");
    expect_in_file("maps.rts", "normal_texture bitmap");
    expect_in_file("maps.rts", "bump_scale     0.25\n    bump_shadowing true");
    run = run_rtc("check maps.rts");
    expect_status(&run, 0);
    run_free(&run);
    scratch_write("maps.gltf", gltf);
    run = run_rtc("import maps.gltf --out maps.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "left out");
    run_free(&run);
    expect_in_file("maps.rts", "linear true");
    expect_in_file("maps.rts", "normal_texture normals");
    expect_in_file("maps.rts", "normal_scale   0.5");
}

/* What the language cannot have is told, and what is made of it can be rendered. */
static void materials_beyond_the_language_are_told(void **state)
{
    (void)state;
    scratch_write(
        "odd.xml",
        "<scene><shape type=\"sphere\"><bsdf type=\"mask\"><float name=\"opacity\" value=\"0.5\"/>"
        "<bsdf type=\"dielectric\"><string name=\"int_ior\" value=\"BK7\"/></bsdf></bsdf></shape>\n"
        "<shape type=\"sphere\"><point name=\"center\" x=\"3\"/><bsdf type=\"plastic\">"
        "<float name=\"int_ior\" value=\"5\"/><float name=\"ext_ior\" "
        "value=\"1\"/></bsdf></shape>\n"
        "<shape type=\"sphere\"><point name=\"center\" x=\"6\"/><bsdf type=\"dielectric\">"
        "<string name=\"int_ior\" value=\"foo\"/></bsdf></shape></scene>\n");
    run run = run_rtc("import odd.xml --out odd.rts");
    expect_status(&run, 0);
    expect_err(&run, "odd.xml:1: the opacity of glass is left out");
    expect_err(&run, "odd.xml:2: a coat of index 5 became one of 3");
    expect_err(&run, "odd.xml:3: the material 'foo' became one of index 1.5046");
    run_free(&run);
    expect_rtc(0, "check odd.rts");
}

/* Thin glass of Mitsuba and pbrt reflects by both of its sides. */
static void thin_glass_becomes_sheets(void **state)
{
    (void)state;
    scratch_write("thin.xml",
                  "<scene version=\"3.0.0\"><shape type=\"sphere\"><bsdf type=\"thindielectric\">"
                  "<float name=\"int_ior\" value=\"1.6\"/><float name=\"ext_ior\" value=\"1\"/>"
                  "</bsdf></shape></scene>");
    scratch_write("thin.pbrt", "WorldBegin\nMaterial \"thindielectric\" \"float eta\" 1.6\n"
                               "Shape \"sphere\" \"float radius\" 1\n");
    for (int i = 0; i < 2; i++) {
        run run = run_rtc(i ? "import thin.xml --out thin.rts" : "import thin.pbrt --out thin.rts");
        expect_status(&run, 0);
        expect_no_err(&run, "reflect");
        run_free(&run);
        expect_in_file("thin.rts", "kt 1 1 1  fresnel dielectric  ior 1.6  thin true }");
    }
}

/* An opaque plastic reflects by Fresnel, and leaves the colour below as it is. */
static void plastics_of_gltf_are_coats(void **state)
{
    (void)state;
    scratch_write(
        "p.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],"
        "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":"
        "{\"POSITION\":0},\"material\":0}]}],\"materials\":[{\"pbrMetallicRoughness\":"
        "{\"metallicFactor\":0,\"roughnessFactor\":0.5,\"baseColorFactor\":[0.5,0.25,0.125,0.75]},"
        "\"alphaMode\":\"BLEND\"}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
        "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
        "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}");
    run run = run_rtc("import p.gltf --out p.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "at every angle");
    run_free(&run);
    expect_in_file("p.rts", "    kd             0.5 0.25 0.125\n    coat           1\n"
                            "    coat_roughness 0.25\n    coat_ior       1.5\n"
                            "    coat_linear    true\n    opacity        0.75\n");
}

/* Alpha of glTF is the opacity, by a cutoff where the mode says so; a JPEG has none. */
static void alpha_of_gltf_cuts_out(void **state)
{
    (void)state;
    scratch_write(
        "m.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],"
        "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":"
        "{\"POSITION\":0},\"material\":0}]}],\"materials\":[{\"alphaMode\":\"MASK\","
        "\"alphaCutoff\":0.25,\"pbrMetallicRoughness\":{\"metallicFactor\":0,"
        "\"baseColorTexture\":{\"index\":0}}}],\"textures\":[{\"source\":0}],"
        "\"images\":[{\"uri\":\"data:image/png;base64,"
        "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAYAAAD0In+KAA"
        "AADElEQVR42mP4DwEOACMmBzrQo3JUAAAAAElFTkSuQmCC\"}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
        "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
        "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}");
    run run = run_rtc("import m.gltf --out m.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "alpha");
    run_free(&run);
    expect_in_file("m.rts", "channel a");
    expect_in_file("m.rts", "opacity_texture alpha");
    expect_in_file("m.rts", "opacity_cutoff  0.25");
    expect_rtc(0, "check m.rts");
}

/* As that of a PNG; without such a channel there is none. */
static void alpha_of_a_qoi_cuts_out(void **state)
{
    static const char *const images[2] = {"cW9pZgAAAAIAAAABBAD/yGQyAP/IZDL/AAAAAAAAAAE=",
                                          "cW9pZgAAAAIAAAABAwD+yGQy/gpkMgAAAAAAAAAB"};
    (void)state;
    for (int i = 0; i < 2; i++) {
        char text[1500];
        snprintf(text, sizeof text,
                 "{\"asset\":{\"version\":\"2.0\"},\"materials\":[{\"alphaMode\":\"MASK\","
                 "\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorTexture\":"
                 "{\"index\":0}}}],\"textures\":[{\"source\":0}],\"images\":[{\"uri\":"
                 "\"data:image/qoi;base64,%s\"}]," GLTF_TRIANGLE,
                 images[i]);
        scratch_write("q.gltf", text);
        expect_rtc(0, "import q.gltf --out q.rts");
        expect_rtc(0, "check q.rts");
        if (i == 0)
            expect_in_file("q.rts", "opacity_texture alpha");
        else
            expect_not_in_file("q.rts", "opacity");
    }
}

/* JSON has no lines, and materials of an OBJ stand in a file of their own. */
static void places_are_those_of_items_and_of_other_files(void **state)
{
    static const char json[] =
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],"
        "\"nodes\":[{\"mesh\":0,\"camera\":1}],"
        "\"cameras\":[{},{\"perspective\":{\"yfov\":4}}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":1},"
        "{\"attributes\":{\"POSITION\":0},\"material\":1,\"mode\":1}]}],"
        "\"materials\":[{},{\"occlusionTexture\":{\"index\":0},\"pbrMetallicRoughness\":"
        "{\"metallicFactor\":0},\"extensions\":{\"KHR_materials_specular\":"
        "{\"specularColorFactor\":[0,0.5,1e9]}}}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
        "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
        "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}",
                      obj[] = "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
                      mtl[] = "newmtl m\nKd 1 1 1\nd 0.5\nfrob 1\n", broken[] = "newmtl m\nKd x\n";
    (void)state;
    scratch_write("a.gltf", json);
    run run = run_rtc("import a.gltf --out a.rts");
    expect_status(&run, 0);
    expect_err(&run,
               "a.gltf: cameras[1]: its angle of 4 radians or aspect ratio of 1.33333 is out of "
               "range: they became 0.7 and 4/3");
    run_free(&run);
    FILE *file = fopen("a.gltf", "r+");
    assert_non_null(file);
    assert_int_equal(fseek(file, strstr(json, "yfov\":4") - json + 6, SEEK_SET), 0);
    fputc('1', file);
    fclose(file);
    run = run_rtc("import a.gltf --out a.rts");
    expect_status(&run, 0);
    expect_err(&run, "a.gltf: materials[1]: its occlusionTexture is left out");
    expect_err(&run, "a.gltf: meshes[0]: points and lines are left out");
    run_free(&run);
    expect_in_file("a.rts", "{ ks 0 0.02 1  roughness 1");
    scratch_write("a.obj", obj);
    scratch_write("a.mtl", mtl);
    run = run_rtc("import a.obj --out a.rts");
    expect_status(&run, 0);
    expect_err(&run, "a.mtl:4: material m: 'frob' is left out");
    expect_err(&run, "a.obj: the file has no camera");
    run_free(&run);
    scratch_write("a.mtl", broken);
    run = run_rtc("import a.obj --out a.rts");
    expect_status(&run, 0);
    expect_err(&run, "a.mtl:2: material m: a line with 'x', which is no number, is left out");
    run_free(&run);
}

/* What a comment of a PLY file calls its texture is none for other programs. */
static void textures_in_comments_are_left_out(void **state)
{
#define REST                                                                                       \
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"     \
    "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
    static const char *const meshes[] = {
        "ply\nformat ascii 1.0\ncomment end_header\ncomment TextureFile t.png\n" REST,
        "ply\r\nformat ascii 1.0\r\ncomment\rTextureFile t.png\r\n" REST,
        "ply\nformat ascii 1.0\n\rcomment\v TextureFile\rt.png\n" REST};
    static const char mitsuba[] = "<scene>\n<shape type=\"ply\"><string name=\"filename\" "
                                  "value=\"m.ply\"/></shape></scene>\n",
                      pbrt[] = "WorldBegin\nShape \"plymesh\" \"string filename\" \"m.ply\"\n";
    (void)state;
    scratch_write("m.xml", mitsuba);
    scratch_write("m.pbrt", pbrt);
    for (size_t i = 0; i < sizeof meshes / sizeof *meshes; i++) {
        scratch_write("m.ply", meshes[i]);
        run run = run_rtc("import m.xml --out m.rts");
        expect_status(&run, 0);
        expect_err(&run, "m.xml:2: the texture that a comment of a PLY file names is left out");
        run_free(&run);
        run = run_rtc("import m.pbrt --out m.rts");
        expect_status(&run, 0);
        expect_err(&run, "m.pbrt:2: the texture that a comment of a PLY file names is left out");
        run_free(&run);
    }
}
/* Left out like those without triangles, and the rest comes. */
static void meshes_without_an_area_are_left_out(void **state)
{
    (void)state;
    scratch_write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    scratch_write("line.xml", "<scene>\n<shape type=\"obj\"><string name=\"filename\" "
                              "value=\"line.obj\"/></shape>\n<shape type=\"sphere\"/></scene>\n");
    scratch_write("line.pbrt", "WorldBegin\nShape \"trianglemesh\" \"point3 P\" "
                               "[0 0 0 1 0 0 2 0 0] \"integer indices\" [0 1 2]\n"
                               "Shape \"sphere\"\n");
    run run = run_rtc("check line.xml");
    expect_status(&run, 0);
    expect_err(&run, "line.xml:2: a mesh without a triangle that has an area is left out");
    run_free(&run);
    run = run_rtc("check line.pbrt");
    expect_status(&run, 0);
    expect_err(&run, "line.pbrt:2: a mesh without a triangle that has an area is left out");
    run_free(&run);
}

/* The header alone says so, of its vertices. */
static void normals_of_ply_files_are_those_of_their_vertices(void **state)
{
    static const char with[] = "ply\nformat ascii 1.0\ncomment end_header\nelement vertex 3\n"
                               "property float x\nproperty float y\nproperty float z\n"
                               "property float nx\nproperty float ny\nproperty float nz\n"
                               "element face 1\nproperty list uchar int vertex_indices\n"
                               "end_header\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n",
                      without[] = "ply\nformat ascii 1.0\ncomment property float nx\n" REST;
    static const char text[] = "<scene>\n<shape type=\"ply\"><string name=\"filename\" "
                               "value=\"m.ply\"/><transform name=\"to_world\"><scale "
                               "x=\"2\"/></transform></shape></scene>\n";
    (void)state;
    scratch_write("m.xml", text);
    scratch_write("m.ply", with);
    run run = run_rtc("import m.xml --out m.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "normals");
    run_free(&run);
    scratch_write("m.ply", without);
    run = run_rtc("import m.xml --out m.rts");
    expect_status(&run, 0);
    expect_err(&run, "m.xml:2: the normals of a mesh without any are those before its transform");
    run_free(&run);
}

#define TINY_PBRT "Scale 1e-30 1e-30 1e-30\nScale 1e-30 1e-30 1e-30\n"
#define TINY_XML "<scale value=\"1e-30\"/><scale value=\"1e-30\"/>"
#define TINY_GLTF "\"scale\":[1e-30,1e-30,1e-30]"
#define HEAD_GLTF "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],"
#define MESH_GLTF                                                                                  \
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":["            \
    "{\"bufferView\":0,\"componentType\":5121,\"type\":\"VEC3\",\"count\":3}],\"bufferViews\":["   \
    "{\"buffer\":0,\"byteLength\":9}],\"buffers\":[{\"byteLength\":9,\"uri\":"                     \
    "\"data:;base64,AAAAAQAAAAEA\"}]}"

/* Zero, too small or flat: nothing is placed. */
static void transforms_of_no_inverse_in_single_precision_are_told(void **state)
{
    static const char *const scenes[][2] = {
        {"tiny.pbrt", "WorldBegin\n" TINY_PBRT "Shape \"sphere\"\n"},
        {"mesh.pbrt",
         "WorldBegin\n" TINY_PBRT "Shape \"trianglemesh\" \"integer indices\" [0 1 2]\n"
         "\"point3 P\" [0 0 0 1 0 0 0 1 0]\n"},
        {"small.pbrt", "WorldBegin\nScale 1e-35 1e-35 1e-35\nShape \"sphere\"\n"},
        {"tiny.xml", "<scene>\n<shape type=\"cube\"><transform name=\"to_world\">" TINY_XML
                     "</transform></shape>\n</scene>\n"},
        {"tiny.gltf", HEAD_GLTF "\"nodes\":[{\"children\":[1]," TINY_GLTF "},{\"mesh\":0," TINY_GLTF
                                "}]," MESH_GLTF},
        {"flat.gltf",
         HEAD_GLTF "\"nodes\":[{\"mesh\":0,\"matrix\":[1,1,0,0,1,1.0000001,0,0,0,0,1,0,"
                   "0,0,0,1]}]," MESH_GLTF},
    };
    (void)state;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        scratch_write(scenes[i][0], scenes[i][1]);
        run run = run_rtc("import %s --out tiny.rts", scenes[i][0]);
        expect_status(&run, 0);
        expect_out(&run, "0 shapes");
        expect_err(&run, "a shape whose transform has no inverse is left out");
        expect_err(&run, "one that sees all shapes was added");
        run_free(&run);
    }
}

/* The camera looks at what is placed alone, and from a distance that single precision has. */
static void added_cameras_have_a_distance(void **state)
{
    static const char *const scenes[][2] = {
        {"none.pbrt", "WorldBegin\nLightSource \"point\"\n"},
        {"small.pbrt", "WorldBegin\nScale 1e-20 1e-20 1e-20\nShape \"sphere\"\n"},
        {"small.obj", "v 0 0 0\nv 1e-25 0 0\nv 0 1e-25 0\nf 1 2 3\n"},
        {"far.pbrt", "WorldBegin\nTranslate 1e8 0 1e8\nScale 0.01 0.01 0.01\nShape \"sphere\"\n"},
        {"look.pbrt", "Translate 0 0 1e10\nCamera \"perspective\"\nWorldBegin\nShape \"sphere\"\n"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        scratch_write(scenes[i][0], scenes[i][1]);
        run run = run_rtc("import %s --out c.rts", scenes[i][0]);
        expect_status(&run, 0);
        run_free(&run);
    }
    scratch_write("s.pbrt", "WorldBegin\nShape \"sphere\"\nTranslate 99 0 0\n" TINY_PBRT
                            "Shape \"trianglemesh\" \"integer indices\" [0 1 2]\n"
                            "\"point3 P\" [0 0 0 1 0 0 0 1 0]\n");
    expect_rtc(0, "import s.pbrt --out s.rts");
    expect_in_file("s.rts", "eye     1.957681 1.7129709 4.894202");
}

#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, scratch_enter, scratch_leave)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_SCRATCH(what_is_left_out_is_told),
        IN_SCRATCH(what_concerns_most_of_the_picture_comes_first),
        IN_SCRATCH(numbers_beyond_the_language_are_bounded),
        IN_SCRATCH(metals_and_glasses_have_the_indices_of_the_language),
        IN_SCRATCH(facets_are_those_of_the_file),
        IN_SCRATCH(diffuse_transmission_is_that_of_the_file),
        IN_SCRATCH(anisotropy_of_gltf_is_along_its_direction),
        IN_SCRATCH(what_blender_does_not_write_is_told),
        IN_SCRATCH(spots_of_blender_fall_as_in_cycles),
        IN_SCRATCH(missing_materials_are_told_once),
        IN_SCRATCH(polygons_are_cut_as_by_the_library),
        IN_SCRATCH(far_meshes_keep_their_digits),
        IN_SCRATCH(numbers_of_mtl_out_of_range_are_told),
        IN_SCRATCH(plastics_of_gltf_are_coats),
        IN_SCRATCH(alpha_of_gltf_cuts_out),
        IN_SCRATCH(alpha_of_a_qoi_cuts_out),
        IN_SCRATCH(thin_glass_becomes_sheets),
        IN_SCRATCH(materials_beyond_the_language_are_told),
        IN_SCRATCH(maps_of_normals_and_heights_are_kept),
        IN_SCRATCH(places_are_those_of_items_and_of_other_files),
        IN_SCRATCH(textures_in_comments_are_left_out),
        IN_SCRATCH(normals_of_ply_files_are_those_of_their_vertices),
        IN_SCRATCH(meshes_without_an_area_are_left_out),
        IN_SCRATCH(transforms_of_no_inverse_in_single_precision_are_told),
        IN_SCRATCH(added_cameras_have_a_distance),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests_name("import_notes", tests, NULL, NULL);
}
