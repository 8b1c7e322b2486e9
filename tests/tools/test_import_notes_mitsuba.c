/*
 * test_import_notes_mitsuba.c - what an import of Mitsuba says, and what it reads in silence.
 */
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

static void principled_materials_of_mitsuba_keep_their_numbers(void **state)
{
    (void)state;
    scratch_write("painted.xml",
                  "<scene>\n<shape type=\"rectangle\"><bsdf type=\"principled\">"
                  "<float name=\"metallic\" value=\"0.5\"/><float name=\"specular\" value=\"0.5\"/>"
                  "<float name=\"clearcoat\" value=\"0.25\"/>"
                  "<float name=\"clearcoat_gloss\" value=\"0.75\"/></bsdf></shape>\n"
                  "<shape type=\"rectangle\"><bsdf type=\"principledthin\">"
                  "<rgb name=\"base_color\" value=\"0.25, 0.5, 0\"/>"
                  "<float name=\"diff_trans\" value=\"1.5\"/>"
                  "<float name=\"spec_trans\" value=\"0.125\"/></bsdf></shape>\n</scene>\n");
    expect_rtc(0, "import painted.xml --out painted.rts");
    expect_in_file("painted.rts", "roughness       0.5\n    base_color      0.5 0.5 0.5\n"
                                  "    metallic        0.5\n    clearcoat       0.25\n"
                                  "    clearcoat_gloss 0.75\n    ior             1.5\n");
    expect_in_file("painted.rts", "base_color 0.25 0.5 0\n    spec_trans 0.125\n"
                                  "    diff_trans 1.5\n    ior        1.5\n    thin       true");
    expect_rtc(0, "check painted.rts");
}

/* Where one may lie in another; the ratio of a surface that nothing surrounds is the same. */
static void solids_that_may_be_nested_have_relative_indices(void **state)
{
    static const char glass[] = "<shape type=\"sphere\"><bsdf type=\"dielectric\"><float "
                                "name=\"int_ior\" value=\"1.5\"/><float name=\"ext_ior\" "
                                "value=\"1.2\"/></bsdf></shape>",
                      coat[] = "<shape type=\"sphere\"><bsdf type=\"plastic\"/></shape>",
                      grey[] = "<shape type=\"disk\"/>";
    const struct {
        const char *first, *second;
        int glasses, coats;
    } cases[] = {{glass, "", 0, 0}, {glass, grey, 1, 0}, {coat, grey, 0, 0}, {glass, coat, 1, 1}};
    char text[1024];
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        snprintf(text, sizeof text, "<scene version=\"3.0.0\">%s%s</scene>", cases[i].first,
                 cases[i].second);
        scratch_write("nested.xml", text);
        expect_rtc(0, "import nested.xml --out nested.rts");
        char *const made = scratch_read("nested.rts"), *found = strstr(made, "relative_ior");
        for (int n = 0; n < cases[i].glasses + cases[i].coats; n++) {
            assert_non_null(found);
            found = strstr(found + 1, "relative_ior true");
        }
        assert_null(found);
        free(made);
        expect_rtc(0, "check nested.rts");
    }
}

/* What no one reads is told with what it may have meant, by its name or by its element. */
static void what_was_meant_is_told(void **state)
{
    static const char text[] =
        "<scene><shape type=\"sphere\"><float name=\"raduis\" value=\"2\"/>\n"
        "<bsdf type=\"roughconductor\"><string name=\"alpha\" value=\"0.2\"/>\n"
        "<rgb name=\"specularReflectanse\" value=\"0.5\"/>\n"
        "<float name=\"sparkle\" value=\"1\"/></bsdf></shape></scene>";
    (void)state;
    scratch_write("meant.xml", text);
    run run = run_rtc("import meant.xml --out meant.rts");
    expect_status(&run, 0);
    expect_err(&run, "meant.xml:1: <float name=\"raduis\"> of <shape type=\"sphere\"> is left out: "
                     "did you mean 'radius'?\n");
    expect_err(&run,
               "meant.xml:2: <string name=\"alpha\"> of <bsdf type=\"roughconductor\"> is left "
               "out: expected <float>\n");
    expect_err(&run, "meant.xml:3: <rgb name=\"specularReflectanse\"> of "
                     "<bsdf type=\"roughconductor\"> is left out: did you mean "
                     "'specular_reflectance'?\n");
    expect_err(&run, "meant.xml:4: <float name=\"sparkle\"> of <bsdf type=\"roughconductor\"> is "
                     "left out\n");
    run_free(&run);
}

/* A wrong value in a sphere, what is said, and a part of what the default makes. */
static const struct {
    const char *inside, *says, *makes;
} wrong_values[] = {
    {"<float name=\"radius\" value=\"nan\"/>",
     "'nan' is not a finite number: 'radius' counts as not given", "radius 1 "},
    {"<float name=\"radius\" value=\"\"/>", "'' is empty: 'radius' counts as not given",
     "radius 1 "},
    {"<boolean name=\"flip_normals\" value=\"maybe\"/>",
     "'maybe' is neither true nor false: 'flip_normals' counts as not given", "radius 1 "},
    {"<point name=\"center\" x=\"1\" y=\"inf\" z=\"2\"/>",
     "'inf' is not one or three finite numbers: 'center' counts as not given", "centre 0 0 0"},
    {"<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"0.1 0.2\"/></bsdf>",
     "'0.1 0.2' is not one or three finite numbers: 'reflectance' counts as not given",
     "kd 0.5 0.5 0.5"},
    {"<bsdf type=\"dielectric\"><float name=\"int_ior\" value=\"0\"/>"
     "<float name=\"ext_ior\" value=\"1\"/></bsdf>",
     "an index of refraction of 0 became 1.5046", "ior 1.5046"},
    {"<bsdf type=\"diffuse\"><rgb name=\"reflectance\"/></bsdf>",
     "'' is empty: 'reflectance' counts as not given", "kd 0.5 0.5 0.5"},
    {"<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\" \"/></bsdf>",
     "'' is empty: 'reflectance' counts as not given", "kd 0.5 0.5 0.5"},
    {"<bsdf type=\"diffuse\"><spectrum name=\"reflectance\" value=\"abc\"/></bsdf>",
     "'abc' is not one or three finite numbers: 'reflectance' counts as not given",
     "kd 0.5 0.5 0.5"},
    {"<emitter type=\"area\"><spectrum name=\"radiance\"/></emitter>",
     "'' is empty: 'radiance' counts as not given", "radiance 1"},
    {"</shape><integrator type=\"path\"><integer name=\"max_depth\" value=\"-7\"/>"
     "</integrator><shape type=\"sphere\">",
     "a max_depth of -7 counts as -1: paths of any length", "max_depth 1024"},
    {"<bsdf type=\"phong\"><float name=\"exponent\" value=\"-3\"/></bsdf>",
     "a negative exponent became 0", "roughness        1\n"},
    {"<bsdf type=\"mixturebsdf\"><string name=\"weights\" value=\"0.3, x\"/>"
     "<bsdf type=\"diffuse\"/><bsdf type=\"conductor\"/></bsdf>",
     "became 0.5 each", "weight 0.5"},
};

/* A wrong value is told, and its default stands in for it; with --strict it is an error. */
static void wrong_values_count_as_not_given(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof wrong_values / sizeof *wrong_values; i++) {
        char text[600];
        snprintf(text, sizeof text,
                 "<scene version=\"3.0.0\">\n<shape type=\"sphere\">\n%s</shape></scene>",
                 wrong_values[i].inside);
        scratch_write("wrong.xml", text);
        run run = run_rtc("import wrong.xml --out wrong.rts");
        expect_status(&run, 0);
        expect_err(&run, "warning: wrong.xml:3: ");
        expect_err(&run, wrong_values[i].says);
        run_free(&run);
        expect_in_file("wrong.rts", wrong_values[i].makes);
        expect_rtc(1, "import wrong.xml --out wrong.rts --strict");
    }
}

/* Whatever an element holds beyond what is read, a name with a typing error among it. */
static void no_element_of_mitsuba_is_dropped_in_silence(void **state)
{
    static const char text[] =
        "<scene version=\"3.0.0\">\n"
        "<integrator type=\"path\"><boolean name=\"hide_emitters\" value=\"true\"/>"
        "<integer name=\"rr_depth\" value=\"9\"/></integrator>\n"
        "<sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/>"
        "<float name=\"near_klip\" value=\"0.2\"/></sensor>\n"
        "<bsdf type=\"diffuse\" id=\"unused\"><rgb name=\"reflectanc\" value=\"1\"/></bsdf>\n"
        "<shape type=\"sphere\"><float name=\"raduis\" value=\"2\"/>\n"
        "<bsdf type=\"null\"/><medium name=\"exterior\" type=\"homogeneous\"/></shape>\n"
        "<shape type=\"cube\"><bsdf type=\"diffuse\">\n"
        "<rgb name=\"reflectance\" value=\"1.5, -0.1, 0.5\"/></bsdf></shape>\n"
        "<shape type=\"disk\"><string name=\"flip_normals\" value=\"true\"/>\n"
        "<bsdf type=\"diffuse\"><rgb name=\"reflectanc\" value=\"1\"/></bsdf>\n"
        "<transform name=\"to_world\"><translate X=\"1\"/></transform></shape>\n"
        "<include filename=\"more.xml\"/>\n</scene>\n",
                      more[] = "<scene version=\"3.0.0\">\n"
                               "<medium type=\"homogeneous\"/>\n"
                               "<emitter type=\"point\"><float name=\"size\" value=\"1\"/>\n"
                               "<rgb name=\"intensity\" value=\"-1\"/></emitter>\n</scene>\n";
    static const char *const says[] = {
        "drop.xml:3: <float name=?near_klip?> of <sensor type=?perspective?> is "
        "left",
        "drop.xml:5: <float name=?raduis?> of <shape type=?sphere?> is left out",
        "drop.xml:6: a medium outside of a shape is left out",
        "drop.xml:7: a negative reflectance, transmittance or roughness became 0",
        "drop.xml:7: a reflectance, transmittance or roughness above 1 became 1",
        "drop.xml:9: <string name=?flip_normals?> of <shape type=?disk?> is left out",
        "drop.xml:10: <rgb name=?reflectanc?> of <bsdf type=?diffuse?> is left out",
        "drop.xml:11: the attribute 'X' of <translate> is left out",
        "more.xml:2: <medium> of <scene> is left out",
        "more.xml:3: <float name=?size?> of <emitter type=?point?> is left out",
        "more.xml:3: a negative intensity became 0",
    };
    (void)state;
    scratch_write("drop.xml", text);
    scratch_write("more.xml", more);
    run run = run_rtc("import drop.xml --out drop.rts");
    expect_status(&run, 0);
    for (char *at = run.err; *at; at++)
        *at = *at == '"' ? '?' : *at;
    for (size_t i = 0; i < sizeof says / sizeof *says; i++)
        expect_err(&run, says[i]);
    expect_no_err(&run, "rr_depth");
    expect_no_err(&run, "drop.xml:4");
    expect_no_err(&run, "drop.xml:14");
    run_free(&run);
    expect_in_file("drop.rts", "light point { position 0 0 0  intensity 0 }");
}

/* A mesh without normals is smooth in Mitsuba, unless it has face_normals. */
static void meshes_of_mitsuba_are_shaded_as_there(void **state)
{
    static const char obj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\n",
                      ply[] = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                              "property float y\nproperty float z\nproperty float nx\n"
                              "property float ny\nproperty float nz\nelement face 1\n"
                              "property list uchar int vertex_indices\nend_header\n"
                              "0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n",
                      text[] = "<scene>\n"
                               "<shape type=\"obj\"><string name=\"filename\" value=\"m.obj\"/>"
                               "</shape>\n"
                               "<shape type=\"obj\"><string name=\"filename\" value=\"m.obj\"/>"
                               "<boolean name=\"face_normals\" value=\"true\"/></shape>\n"
                               "<shape type=\"ply\"><string name=\"filename\" value=\"m.ply\"/>"
                               "</shape>\n"
                               "<shape type=\"ply\"><string name=\"filename\" value=\"m.ply\"/>"
                               "<boolean name=\"face_normals\" value=\"true\"/></shape>\n"
                               "</scene>\n";
    static const char *const meshes[] = {
        "{ file \"m_files/mesh_1.ply\"  shading smooth }", "{ file \"m_files/mesh_3.ply\" }",
        "{ file \"m_files/mesh_5.ply\" }", "{ file \"m_files/mesh_7.ply\"  shading flat }"};
    (void)state;
    scratch_write("m.obj", obj);
    scratch_write("m.ply", ply);
    scratch_write("m.xml", text);
    run run = run_rtc("import m.xml --out m.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "normals");
    run_free(&run);
    for (size_t i = 0; i < sizeof meshes / sizeof *meshes; i++)
        expect_in_file("m.rts", meshes[i]);
}

/* Normals that are not exactly those of Mitsuba are told. */
static void normals_that_differ_from_those_of_mitsuba_are_told(void **state)
{
    static const char obj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\n";
    static const char
        bare[] = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                 "property float y\nproperty float z\nelement face 1\n"
                 "property list uchar int vertex_indices\nend_header\n"
                 "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
        stretched[] = "<scene>\n"
                      "<shape type=\"ply\"><string name=\"filename\" value=\"n.ply\"/></shape>\n"
                      "<shape type=\"obj\"><string name=\"filename\" value=\"m.obj\"/>"
                      "<transform name=\"to_world\"><scale x=\"2\"/></transform></shape>\n"
                      "</scene>\n";
    (void)state;
    scratch_write("m.obj", obj);
    scratch_write("n.ply", bare);
    scratch_write("n.xml", stretched);
    run run = run_rtc("import n.xml --out n.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "n.xml:2");
    expect_err(&run, "n.xml:3: the normals of a mesh without any are those before its transform");
    run_free(&run);
    expect_in_file("n.rts", "shading smooth }");
}

/* What Mitsuba has in words of its own and the language has too. */
static void mitsuba_in_other_words_is_read(void **state)
{
    static const char text[] =
        "<scene version=\"3.0.0\">\n"
        "<default name=\"a\" value=\"0.3\"/><default name=\"b\" value=\"$a\"/>\n"
        "<integrator type=\"aov\"><string name=\"aovs\" value=\"d:depth\"/>"
        "<integrator type=\"path\"><integer name=\"max_depth\" value=\"4\"/></integrator>"
        "</integrator>\n"
        "<sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/>"
        "<float name=\"near_clip\" value=\"0.1\"/><float name=\"focus_distance\" value=\"9\"/>"
        "<sampler type=\"independent\"><integer name=\"seed\" value=\"7\"/></sampler>"
        "<film type=\"hdrfilm\"><rfilter type=\"tent\"><float name=\"radius\" value=\"1.5\"/>"
        "</rfilter></film></sensor>\n"
        "<shape type=\"cube\"><bsdf type=\"diffuse\"><spectrum name=\"reflectance\" "
        "type=\"uniform\"><float name=\"value\" value=\"$b\"/></spectrum></bsdf>"
        "<emitter type=\"area\"><spectrum name=\"radiance\" type=\"d65\"><float name=\"scale\" "
        "value=\"5\"/></spectrum></emitter></shape>\n"
        "<shape type=\"disk\"><bsdf type=\"diffuse\"><texture name=\"reflectance\" "
        "type=\"srgb\"><rgb name=\"color\" value=\"0.1 0.2 0.4\"/></texture></bsdf></shape>\n"
        "</scene>\n";
    static const char *const made[] = {"max_depth 4  spp 16  seed 7",
                                       "filter tent",
                                       "filter_radius 1.5",
                                       "{ kd 0.3 0.3 0.3  back black }",
                                       "radiance 5 5 5",
                                       "{ kd 0.1 0.2 0.4  back black }",
                                       "fov     40\n"};
    (void)state;
    scratch_write("other.xml", text);
    run run = run_rtc("import other.xml --out other.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "warning");
    run_free(&run);
    for (size_t i = 0; i < sizeof made / sizeof *made; i++)
        expect_in_file("other.rts", made[i]);
}

static void what_mitsuba_says_twice_or_of_nothing_is_told(void **state)
{
    static const char text[] =
        "<scene version=\"3.0.0\">\n"
        "<integrator type=\"pth\"><integer name=\"max_depht\" value=\"4\"/></integrator>\n"
        "<shape type=\"cube\"><emitter type=\"area\"/>\n<emitter type=\"area\"/></shape>\n"
        "<shape type=\"instance\"/>\n"
        "<emitter type=\"point\"><point name=\"position\" x=\"1\"/><transform "
        "name=\"to_world\"><translate x=\"1\"/></transform></emitter>\n"
        "<shape type=\"hair\"/>\n<shape type=\"hair\"/>\n<shape type=\"hair\"/>\n"
        "<sensor type=\"radiancemeter\"><sampler type=\"independent\"><integer "
        "name=\"sample_count\" value=\"3\"/></sampler></sensor>\n"
        "<sensor type=\"perspective\"><sampler type=\"independent\"><integer "
        "name=\"sample_count\" value=\"20000000\"/></sampler></sensor>\n"
        "<include filename=\"part.xml\"/>\n</scene>\n",
                      part[] = "<scene>\n<shape type=\"hair\"/><shape type=\"hair\"/>\n</scene>";
    static const char *const says[] = {
        "twice.xml:2: the integrator 'pth' became path",
        "twice.xml:2: <integer name=\"max_depht\"> of <integrator type=\"pth\"> is left out",
        "twice.xml:4: a second emitter of a shape is left out",
        "twice.xml:5: an instance without a shapegroup is empty",
        "twice.xml:6: to_world of a light with a position is left out",
        "twice.xml:7: a shape 'hair' is left out (also at 8, 9, part.xml:2)\n",
        "twice.xml:10: a sensor 'radiancemeter' is left out",
        "twice.xml:11: spp 20000000 became 16777216",
    };
    (void)state;
    scratch_write("part.xml", part);
    scratch_write("twice.xml", text);
    run run = run_rtc("import twice.xml --out twice.rts");
    expect_status(&run, 0);
    for (size_t i = 0; i < sizeof says / sizeof *says; i++)
        expect_err(&run, says[i]);
    run_free(&run);
    expect_in_file("twice.rts", "spp 16777216");
}

/* What is not opaque is a cutout, by a value or a texture. */
static void masks_become_cutouts(void **state)
{
    static const char one_texel[] = "P2\n1 1\n255\n128\n";
    (void)state;
    scratch_write("m.pgm", one_texel);
    scratch_write("mask.xml",
                  "<scene version=\"3.0.0\"><shape type=\"sphere\"><bsdf type=\"mask\">"
                  "<float name=\"opacity\" value=\"0.25\"/><bsdf type=\"plastic\"/></bsdf></shape>"
                  "<shape type=\"rectangle\"><bsdf type=\"mask\"><texture name=\"opacity\" "
                  "type=\"bitmap\"><string name=\"filename\" value=\"m.pgm\"/>"
                  "<boolean name=\"raw\" value=\"true\"/></texture><bsdf type=\"diffuse\"/></bsdf>"
                  "</shape></scene>");
    run run = run_rtc("import mask.xml --out mask.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "opacity");
    run_free(&run);
    expect_in_file("mask.rts", "opacity     0.25\n    back        black\n");
    expect_in_file("mask.rts", "opacity_texture");
    expect_in_file("mask.rts", "linear true");
    expect_rtc(0, "check mask.rts");
}

/* At (0, 0) Mitsuba's pattern has its first colour, but the second of its numbers. */
static void checkers_of_mitsuba_begin_with_one_of_two(void **state)
{
    (void)state;
    scratch_write(
        "c.xml",
        "<scene version=\"3.0.0\"><shape type=\"rectangle\"><bsdf type=\"mask\">"
        "<texture name=\"opacity\" type=\"checkerboard\">"
        "<float name=\"color0\" value=\"0.875\"/></texture><bsdf type=\"diffuse\">"
        "<texture name=\"reflectance\" type=\"checkerboard\">"
        "<rgb name=\"color0\" value=\"1,0.5,0.25\"/>"
        "<rgb name=\"color1\" value=\"0.125,0,0\"/></texture></bsdf></bsdf></shape></scene>");
    expect_rtc(0, "import c.xml --out c.rts");
    expect_in_file("c.rts", "a 1 0.5 0.25  b 0.125 0 0  scale 2 2");
    expect_in_file("c.rts", "a 0.2 0.2 0.2  b 0.875 0.875 0.875  scale 2 2");
}

/* A path that meets an emitter of Mitsuba's adds its light whatever its mask. */
static void emitters_behind_masks_are_told(void **state)
{
    (void)state;
    scratch_write("m.xml", "<scene version=\"3.0.0\"><shape type=\"rectangle\"><bsdf type=\"mask\">"
                           "<float name=\"opacity\" value=\"0.5\"/><bsdf type=\"diffuse\"/></bsdf>"
                           "<emitter type=\"area\"/></shape></scene>");
    run run = run_rtc("import m.xml --out m.rts");
    expect_status(&run, 0);
    expect_err(&run, "an emitter emits by the opacity of its mask");
    run_free(&run);
}

#define BSDF(type, inside) "<bsdf type=\"" type "\">" inside "</bsdf>"
#define WEIGHT(x) "<float name=\"weight\" value=\"" x "\"/>"
#define OPACITY(x) "<float name=\"opacity\" value=\"" x "\"/>"
#define IOR(x) "<float name=\"int_ior\" value=\"" x "\"/>"

/* One-sided materials have a black back, others that which they have; blends are blends. */
static void blends_and_sides_of_mitsuba(void **state)
{
    static const struct {
        const char *bsdf, *made, *note;
    } cases[] = {
        {BSDF("diffuse", ""), "{ kd 0.5 0.5 0.5  back black }", NULL},
        {BSDF("twosided", BSDF("diffuse", "")), "{ kd 0.5 0.5 0.5 }", NULL},
        {BSDF("twosided", BSDF("diffuse", "") BSDF("conductor", "")),
         "{ kd 0.5 0.5 0.5  back part_0 }", NULL},
        {BSDF("blendbsdf", WEIGHT("0.25") BSDF("diffuse", "") BSDF("conductor", "")),
         "{ blend part_0  with part_1  weight 0.25  back black }", NULL},
        {BSDF("twosided", BSDF("blendbsdf", BSDF("diffuse", "") BSDF("conductor", ""))),
         "{ blend part_0  with part_1  weight 0.5 }", NULL},
        {BSDF("blendbsdf", WEIGHT("0.25") BSDF("null", "") BSDF("diffuse", "")),
         "{ kd 0.5 0.5 0.5  opacity 0.25  back black }", NULL},
        {BSDF("blendbsdf", WEIGHT("0.25") BSDF("diffuse", "") BSDF("null", "")),
         "{ kd 0.5 0.5 0.5  opacity 0.75  back black }", NULL},
        {BSDF("blendbsdf", BSDF("mask", OPACITY("0.5") BSDF("diffuse", "")) BSDF("conductor", "")),
         "{ opacity 0.75  blend part_0  with part_1  weight 0.6666667  back black }", NULL},
        {BSDF("mask", OPACITY("0.5") BSDF("blendbsdf", BSDF("diffuse", "") BSDF("conductor", ""))),
         "{ opacity 0.5  blend part_0  with part_1  weight 0.5  back black }", NULL},
        {BSDF("mask", OPACITY("0.5") BSDF("blendbsdf", BSDF("diffuse", "") BSDF("dielectric", ""))),
         "{ blend part_0  with part_1  weight 0.5 }", "the opacity of glass is left out"},
        {BSDF("blendbsdf", BSDF("dielectric", IOR("1.3")) BSDF("dielectric", IOR("1.7"))),
         "ior 1.699", "a blend of two kinds of glass became one of them"},
        {BSDF("blendbsdf",
              WEIGHT("0.25") BSDF("principled", "<float name=\"spec_trans\" value=\"1\"/>")
                  BSDF("principledthin", "<float name=\"diff_trans\" value=\"1\"/>")),
         "spec_trans", "a blend of two kinds of glass became one of them"},
        {BSDF("blendbsdf", WEIGHT("0") BSDF("diffuse", "") BSDF("conductor", "")),
         "{ kd 0.5 0.5 0.5  back black }", NULL},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[600];
        snprintf(text, sizeof text, "<scene><shape type=\"rectangle\">%s</shape></scene>\n",
                 cases[i].bsdf);
        scratch_write("b.xml", text);
        run run = run_rtc("import b.xml --out b.rts");
        expect_status(&run, 0);
        if (cases[i].note)
            expect_err(&run, cases[i].note);
        else
            expect_no_err(&run, "blend");
        run_free(&run);
        expect_in_file("b.rts", cases[i].made);
        expect_rtc(0, "check b.rts");
    }
}

#define FLIP "<boolean name=\"flip_normals\" value=\"true\"/>"

/* What shows its back to all is black but for it: the sides of its material are exchanged. */
static void what_is_turned_over_shows_its_back(void **state)
{
    static const char ply[] = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                              "property float y\nproperty float z\nelement face 1\n"
                              "property list uchar int vertex_indices\nend_header\n"
                              "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                      text[] = "<scene>\n"
                               "<shape type=\"sphere\">" FLIP "<bsdf type=\"plastic\"/></shape>\n"
                               "<shape type=\"cylinder\">" FLIP "</shape>\n"
                               "<shape type=\"ply\">" FLIP "<string name=\"filename\" "
                               "value=\"m.ply\"/></shape>\n"
                               "<shape type=\"sphere\">" FLIP "<bsdf type=\"twosided\">"
                               "<bsdf type=\"diffuse\"/></bsdf></shape>\n"
                               "<shape type=\"sphere\">" FLIP "<bsdf type=\"dielectric\"><float "
                               "name=\"int_ior\" value=\"1.25\"/><float name=\"ext_ior\" "
                               "value=\"1\"/></bsdf></shape>\n"
                               "<shape type=\"sphere\">" FLIP "<emitter type=\"area\"/></shape>\n"
                               "<shape type=\"sphere\">" FLIP "<bsdf type=\"null\"/><medium "
                               "name=\"interior\" type=\"homogeneous\"/></shape>\n"
                               "</scene>\n";
    (void)state;
    scratch_write("m.ply", ply);
    scratch_write("turned.xml", text);
    run run = run_rtc("import turned.xml --out turned.rts");
    expect_status(&run, 0);
    for (int line = 2; line <= 6; line++) {
        char place[32];
        snprintf(place, sizeof place, "turned.xml:%d:", line);
        expect_no_err(&run, place);
    }
    expect_err(&run, "turned.xml:7: a sphere that is turned over by flip_normals or a mirroring "
                     "sends light outwards, too");
    expect_err(&run, "turned.xml:8: a sphere that is turned over by flip_normals or a mirroring "
                     "stays as it is");
    run_free(&run);
    expect_in_file("turned.rts", "material turned_2    { back material_1 }");
    expect_in_file("turned.rts", "radius 1  material turned_2 }");
    expect_in_file("turned.rts", "{ material turned_9 }");
    expect_in_file("turned.rts", "fresnel dielectric  ior 0.8  relative_ior true }");
    expect_in_file("turned.rts", "two_sided true }");
    run = run_rtc("check turned.xml");
    expect_no_err(&run, "never used");
    run_free(&run);
}

#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, scratch_enter, scratch_leave)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_SCRATCH(principled_materials_of_mitsuba_keep_their_numbers),
        IN_SCRATCH(solids_that_may_be_nested_have_relative_indices),
        IN_SCRATCH(what_was_meant_is_told),
        IN_SCRATCH(wrong_values_count_as_not_given),
        IN_SCRATCH(no_element_of_mitsuba_is_dropped_in_silence),
        IN_SCRATCH(meshes_of_mitsuba_are_shaded_as_there),
        IN_SCRATCH(normals_that_differ_from_those_of_mitsuba_are_told),
        IN_SCRATCH(mitsuba_in_other_words_is_read),
        IN_SCRATCH(what_mitsuba_says_twice_or_of_nothing_is_told),
        IN_SCRATCH(masks_become_cutouts),
        IN_SCRATCH(checkers_of_mitsuba_begin_with_one_of_two),
        IN_SCRATCH(emitters_behind_masks_are_told),
        IN_SCRATCH(blends_and_sides_of_mitsuba),
        IN_SCRATCH(what_is_turned_over_shows_its_back),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests_name("import_notes_mitsuba", tests, NULL, NULL);
}
