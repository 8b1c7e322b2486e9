/*
 * test_import.c - scenes of other programs: those of tests/tools/import are read whole, what the
 * language lacks is told, and what is wrong is refused with its place.
 */
#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "expect.h"
#include "lib/image/scratch.h"
#include "spawn.h"

static char top[4096]; /* the folder of the sources */

static void put(const char *name, const char *text, size_t size)
{
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

/* Removes the folder of meshes and textures beside a scene, if there is one. */
static void remove_files(const char *folder)
{
    DIR *entries = opendir(folder);
    char path[512];
    for (const struct dirent *entry; entries && (entry = readdir(entries)) != NULL;) {
        snprintf(path, sizeof path, "%s/%.200s", folder, entry->d_name);
        unlink(path);
    }
    if (entries)
        closedir(entries);
    rmdir(folder);
}

static void every_scene_of_the_folder_is_read_whole(void **state)
{
    static const struct {
        const char *name, *says;
    } scenes[] = {
        {"room.xml", "7 shapes, 0 triangles, 4 materials, 1 light"},
        {"metal.xml", "7 shapes, 0 triangles, 6 materials, 1 light"},
        {"picture.xml", "5 shapes, 24 triangles, 3 materials, 1 light"},
        {"delta.xml", "4 shapes, 12 triangles, 3 materials, 3 lights"},
        {"smooth.xml", "7 shapes, 64 triangles, 5 materials, 1 light"},
        {"tall.xml", "6 shapes, 48 triangles, 3 materials, 1 light"},
        {"room.pbrt", "7 shapes, 34 triangles, 4 materials, 1 light"},
        {"metal.pbrt", "7 shapes, 34 triangles, 6 materials, 1 light"},
        {"picture.pbrt", "5 shapes, 30 triangles, 3 materials, 1 light"},
        {"delta.pbrt", "4 shapes, 28 triangles, 3 materials, 3 lights"},
        {"smooth.pbrt", "7 shapes, 74 triangles, 5 materials, 1 light"},
        {"tall.pbrt", "6 shapes, 52 triangles, 3 materials, 1 light"},
        {"room.glb", "7 shapes, 34 triangles, 4 materials, 1 light"},
        {"metal.gltf", "7 shapes, 34 triangles, 6 materials, 1 light"},
        {"picture.glb", "5 shapes, 30 triangles, 3 materials, 1 light"},
        {"delta.gltf", "4 shapes, 28 triangles, 3 materials, 3 lights"},
        {"smooth.gltf", "7 shapes, 74 triangles, 5 materials, 1 light"},
        {"tall.glb", "6 shapes, 52 triangles, 3 materials, 1 light"},
        {"room.obj", "4 shapes, 34 triangles, 5 materials, 1 light"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        run run = run_rtc("import %s/tests/tools/import/scenes/%s --out s%d.rts", top,
                          scenes[i].name, (int)i);
        expect_status(&run, 0);
        expect_out(&run, scenes[i].says);
        run_free(&run);
        char folder[32];
        snprintf(folder, sizeof folder, "s%d_files", (int)i);
        remove_files(folder);
    }
}

/* Files that are wrong, and what is said. */
static const struct {
    const char *name, *text, *says;
} wrong[] = {
    {"cut.gltf", "{\n\"asset\":{\"version\":\"2.0\"},\n\"scenes\":[", "cut.gltf:3: "},
    {"old.gltf", "{\"asset\":{\"version\":\"1.0\"}}", "asset.version"},
    {"none.gltf", "{\"asset\":{\"version\":\"2.0\"}}", "scenes[0]"},
    {"cycle.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],"
     "\"nodes\":[{\"children\":[1]},{\"children\":[0]}]}",
     "cycle.gltf: nodes[0]: it is a child of itself"},
    {"node.gltf", "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[-1]}],\"nodes\":[{}]}",
     "no index"},
    {"need.gltf", "{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"X_y\"]}", "X_y"},
    {"nan.gltf",
     "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],"
     "\"nodes\":[{\"translation\":[1e999,0,0]}]}",
     "nan.gltf: nodes[0]: 'translation' must be 3 finite numbers"},
    {"short.glb", "glTF\2\0\0", "of which"},
    {"small.glb", "glTF\2\0\0\0\4\0\0\0", "of which"},
    {"bomb.xml",
     "<?xml version=\"1.0\"?>\n<!DOCTYPE a [\n<!ENTITY b \"ha\">\n]>\n<scene>&b;</scene>",
     "bomb.xml:3: the file defines entities"},
    {"cut.xml", "<scene>\n<shape type=\"sphere\">\n", "cut.xml:3: no element found"},
    {"root.xml", "<scenery/>", "not <scene>"},
    {"ref.xml", "<scene>\n<shape type=\"cube\">\n<ref id=\"red\"/></shape></scene>",
     "ref.xml:3: there is no element with the id 'red'"},
    {"id.xml", "<scene>\n<bsdf id=\"a\" type=\"null\"/>\n<bsdf id=\"a\" type=\"null\"/></scene>",
     "id.xml:3: two elements have the id 'a'"},
    {"nan.xml",
     "<scene><shape type=\"sphere\">\n<float name=\"radius\" value=\"nan\"/></shape></scene>",
     "nan.xml:2: 'nan' is not a finite number"},
    {"loop.xml",
     "<scene><bsdf type=\"twosided\" id=\"a\"><ref id=\"a\"/></bsdf>"
     "<shape type=\"cube\"><ref id=\"a\"/></shape></scene>",
     "nested deeper"},
    {"again.xml", "<scene>\n<include filename=\"again.xml\"/></scene>", "includes are nested"},
    {"word.pbrt", "WorldBegin\nShpae \"sphere\"\n", "word.pbrt:2: unknown directive 'Shpae'"},
    {"cut.pbrt", "WorldBegin\nShape \"trianglemesh\" \"point3 P\" [ 0 0 0\n", "not closed"},
    {"deep.pbrt", "Include \"deep.pbrt\"\n", "includes are nested"},
    {"end.pbrt", "AttributeEnd\n", "end.pbrt:1: this end has no beginning"},
    {"open.pbrt", "AttributeBegin\n", "not closed"},
    {"nan.pbrt", "\nTranslate 0 inf 0\n", "nan.pbrt:2: Translate takes 3 numbers"},
    {"index.pbrt",
     "Shape \"trianglemesh\" \"integer indices\" [ 0 1 7 ]\n"
     "\"point3 P\" [ 0 0 0 1 0 0 0 1 0 ]",
     "the index 7 of 3 vertices"},
    {"face.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n", "face.obj:3: '3' names no vertex; there are 2"},
    {"zero.obj", "v 0 0 0\nf 0 1 1\n", "zero.obj:2: '0' names no vertex"},
    {"uv.obj", "v 0 0 0\nf 1/2 1 1\n", "uv.obj:2: '2' names no texture coordinate; there are 0"},
    {"nan.obj", "v 0 nan 0\n", "nan.obj:1: 'nan' is not a finite number"},
    {"none.obj", "v 0 0 0\n", "there is no face"},
    {"lib.obj", "mtllib\nmtllib nowhere.mtl\n", "lib.obj:2: cannot read 'nowhere.mtl'"},
    {"what.txt", "x", "not a format that is known"},
};

static void a_scene_that_was_there_stays(void **state)
{
    static const char text[] = "<scene>\n<shape type=\"sphere\"><bsdf type=\"diffuse\"><texture "
                               "name=\"reflectance\" type=\"bitmap\"><string name=\"filename\" "
                               "value=\"bad.png\"/></texture></bsdf></shape>\n</scene>\n";
    (void)state;
    put("bad.png", "\x89PNG\r\n\x1a\nxxxxxxxx", 16);
    put("bad.xml", text, strlen(text));
    run run = run_rtc("import bad.xml --out bad.rts");
    expect_status(&run, 1);
    run_free(&run);
    expect_no_file("bad.rts");
    expect_no_file("bad_files");
    put("mine.rts", "# mine\n", 7);
    put("bad.rts", "# mine\n", 7);
    run = run_rtc("import bad.xml --out bad.rts");
    expect_status(&run, 1);
    run_free(&run);
    expect_same_files("mine.rts", "bad.rts");
    expect_no_file("bad_files");
}

/* Runs rtc, which ends with this status. */
static void done(int status, const char *line)
{
    run run = run_rtc("%s", line);
    expect_status(&run, status);
    run_free(&run);
}

/* What is wrong comes behind a mesh that has changed, and is seen by who reads the whole scene. */
static void a_failed_import_leaves_the_meshes_of_an_earlier_one(void **state)
{
#define KEPT "<scene><shape type=\"obj\"><string name=\"filename\" value=\"kept.obj\"/></shape>"
    static const char before[] = KEPT "</scene>\n",
                      after[] = KEPT "<shape type=\"sphere\"><bsdf type=\"diffuse\"><texture "
                                     "name=\"reflectance\" type=\"bitmap\"><string "
                                     "name=\"filename\" value=\"bad.png\"/></texture></bsdf>"
                                     "</shape></scene>\n",
                      mesh[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
                      other[] = "v 0 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\n";
    (void)state;
    put("bad.png", "\x89PNG\r\n\x1a\nxxxxxxxx", 16);
    put("kept.obj", mesh, strlen(mesh));
    put("kept.xml", before, strlen(before));
    assert_int_equal(mkdir("made", 0777), 0);
    done(0, "import kept.xml --out made/kept.rts");
    done(0, "made/kept.rts --spp 1 --width 8 --height 8 --quiet --out before.pfm");
    put("kept.obj", other, strlen(other));
    put("kept.xml", after, strlen(after));
    done(1, "import kept.xml --out made/kept.rts");
    done(0, "made/kept.rts --spp 1 --width 8 --height 8 --quiet --out after.pfm");
    expect_same_files("before.pfm", "after.pfm");
    expect_no_file("made/.kept.rts.import");
    /* One that was killed has left its folder. */
    assert_int_equal(mkdir("made/.kept.rts.import", 0777), 0);
    put("made/.kept.rts.import/kept.rts", "#", 1);
    put("kept.xml", before, strlen(before));
    done(0, "import kept.xml --out made/kept.rts");
    expect_no_file("made/.kept.rts.import");
    done(0, "made/kept.rts --spp 1 --width 8 --height 8 --quiet --out other.pfm");
    expect_different_files("before.pfm", "other.pfm");
    remove_files("made/kept_files");
    remove_files("made");
}

static void a_file_without_shapes_is_told(void **state)
{
    (void)state;
    put("empty.pbrt", "\n", 1);
    run run = run_rtc("import empty.pbrt --out empty.rts");
    expect_status(&run, 0);
    expect_err(&run, "empty.pbrt: the file has no shape that is read");
    run_free(&run);
    run = run_rtc("import empty.pbrt --out a\"b.rts");
    expect_status(&run, 2);
    expect_err(&run, "a scene cannot name files by a path with quotes or line ends");
    run_free(&run);
}

static void what_is_wrong_is_refused_with_its_place(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        size_t size = strcmp(wrong[i].name, "short.glb") == 0   ? 7
                      : strcmp(wrong[i].name, "small.glb") == 0 ? 12
                                                                : strlen(wrong[i].text);
        put(wrong[i].name, wrong[i].text, size);
        run run = run_rtc("import %s --out wrong.rts", wrong[i].name);
        if (run.status != 1 || !strstr(run.err, wrong[i].says))
            fail_msg("%s: status %d, expected '%s' in '%s'", wrong[i].name, run.status,
                     wrong[i].says, run.err);
        run_free(&run);
    }
    expect_no_file("wrong.rts");
}

/* Files that a failed import wrote, and no others. */
static void what_fails_leaves_no_files(void **state)
{
    static const char obj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
                      text[] = "<scene>\n"
                               "<shape type=\"obj\"><string name=\"filename\" value=\"m.obj\"/>"
                               "</shape>\n<shape type=\"sphere\"><ref id=\"none\"/></shape>\n"
                               "</scene>\n";
    (void)state;
    put("m.obj", obj, strlen(obj));
    put("m.xml", text, strlen(text));
    run run = run_rtc("import m.xml --out m.rts");
    expect_status(&run, 1);
    run_free(&run);
    expect_no_file("m_files");
    assert_int_equal(mkdir("m_files", 0777), 0);
    put("m_files/notes", "x", 1);
    run = run_rtc("import m.xml --out m.rts");
    expect_status(&run, 1);
    run_free(&run);
    expect_no_file("m_files/mesh_1.ply");
    expect_file("m_files/notes");
    remove_files("m_files");
}

/* The bytes of an accessor that reach beyond, by its count, its offset or its stride. */
static void bounds_of_buffers_are_checked(void **state)
{
    static const struct {
        const char *view, *accessor, *says;
    } cases[] = {
        {"\"byteLength\":36", "\"count\":4", "do not fit"},
        {"\"byteLength\":36", "\"count\":1e300", "whole number"},
        {"\"byteLength\":36", "\"count\":3,\"byteOffset\":4", "do not fit"},
        {"\"byteLength\":40", "\"count\":3", "a buffer of 36"},
        {"\"byteLength\":36,\"byteStride\":-12", "\"count\":3", "'byteStride' must be"},
        {"\"byteLength\":36,\"byteStride\":16", "\"count\":3", "do not fit"},
        {"\"byteLength\":36,\"byteOffset\":9007199254740992", "\"count\":3", "a buffer of 36"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[2048];
        int length = snprintf(
            text, sizeof text,
            "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}]"
            ","
            "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
            "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",%s}],"
            "\"bufferViews\":[{\"buffer\":0,%s}],\"buffers\":[{\"byteLength\":36,\"uri\":"
            "\"data:x;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}",
            cases[i].accessor, cases[i].view);
        put("bounds.gltf", text, (size_t)length);
        run run = run_rtc("import bounds.gltf --out wrong.rts");
        if (run.status != 1 || !strstr(run.err, cases[i].says))
            fail_msg("case %d: status %d, expected '%s' in '%s'", (int)i, run.status, cases[i].says,
                     run.err);
        run_free(&run);
    }
}

static void expect_in_scene(const char *name, const char *text)
{
    char made[4096];
    FILE *file = fopen(name, "r");
    assert_non_null(file);
    made[fread(made, 1, sizeof made - 1, file)] = '\0';
    fclose(file);
    if (!strstr(made, text))
        fail_msg("no '%s' in %s:\n%s", text, name, made);
}

/* What is left out is a warning and a comment, each with its line. */
static void what_is_left_out_is_told(void **state)
{
    static const char text[] = "<scene>\n<shape type=\"sphere\">\n<bsdf type=\"measured\"/>\n"
                               "</shape>\n<shape type=\"sdfgrid\"/>\n</scene>\n";
    (void)state;
    put("note.xml", text, strlen(text));
    run run = run_rtc("import note.xml --out note.rts");
    expect_status(&run, 0);
    expect_err(&run, "note.xml:3: a material 'measured' became grey");
    expect_err(&run, "note.xml:5: a shape 'sdfgrid' is left out");
    expect_err(&run, "no camera");
    run_free(&run);
    expect_in_scene("note.rts", "# - note.xml:3: a material 'measured' became grey\n");
    expect_in_scene("note.rts", "# - note.xml:5: a shape 'sdfgrid' is left out\n");
    run = run_rtc("fmt --check note.rts");
    expect_status(&run, 0);
    run_free(&run);
}

/* Whatever an element holds beyond what is read, a name with a typing error among it. */
static void no_element_of_mitsuba_is_dropped_in_silence(void **state)
{
    static const char text[] =
        "<scene version=\"3.0.0\">\n"
        "<integrator type=\"path\"><boolean name=\"hide_emitters\" value=\"true\"/>"
        "<integer name=\"rr_depth\" value=\"9\"/></integrator>\n"
        "<sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/>"
        "<float name=\"principal_point_offset_x\" value=\"0.2\"/></sensor>\n"
        "<bsdf type=\"diffuse\" id=\"unused\"><rgb name=\"reflectanc\" value=\"1\"/></bsdf>\n"
        "<shape type=\"sphere\"><float name=\"raduis\" value=\"2\"/>\n"
        "<bsdf type=\"null\"/><medium name=\"interior\" type=\"homogeneous\"/></shape>\n"
        "<shape type=\"cube\"><bsdf type=\"diffuse\">\n"
        "<rgb name=\"reflectance\" value=\"1.5, -0.1, 0.5\"/></bsdf></shape>\n"
        "<shape type=\"disk\"><string name=\"flip_normals\" value=\"true\"/>\n"
        "<bsdf type=\"diffuse\"><rgb name=\"reflectanc\" value=\"1\"/></bsdf>\n"
        "<transform name=\"to_world\"><translate X=\"1\"/></transform></shape>\n"
        "<include filename=\"more.xml\"/>\n</scene>\n",
                      more[] = "<scene version=\"3.0.0\">\n"
                               "<medium id=\"fog\" type=\"homogeneous\"/>\n"
                               "<emitter type=\"point\"><float name=\"size\" value=\"1\"/>\n"
                               "<rgb name=\"intensity\" value=\"-1\"/></emitter>\n</scene>\n";
    static const char *const says[] = {
        "drop.xml:2: hide_emitters is left out",
        "drop.xml:3: <float name=?principal_point_offset_x?> of <sensor type=?perspective?> is "
        "left",
        "drop.xml:5: <float name=?raduis?> of <shape type=?sphere?> is left out",
        "drop.xml:6: <medium name=?interior?> of <shape type=?sphere?> is left out",
        "drop.xml:7: a negative reflectance or transmittance became 0",
        "drop.xml:7: a reflectance, transmittance or roughness above 1 became 1",
        "drop.xml:9: <string name=?flip_normals?> of <shape type=?disk?> is left out",
        "drop.xml:10: <rgb name=?reflectanc?> of <bsdf type=?diffuse?> is left out",
        "drop.xml:11: the attribute 'X' of <translate> is left out",
        "more.xml:2: <medium> of <scene> is left out",
        "more.xml:3: <float name=?size?> of <emitter type=?point?> is left out",
        "more.xml:3: a negative intensity became 0",
    };
    (void)state;
    put("drop.xml", text, strlen(text));
    put("more.xml", more, strlen(more));
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
    expect_in_scene("drop.rts", "light point { position 0 0 0  intensity 0 }");
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
        "{ file \"m_files/mesh_1.ply\" }", "{ file \"m_files/mesh_3.ply\" }",
        "{ file \"m_files/mesh_5.ply\" }", "{ file \"m_files/mesh_7.ply\"  shading flat }"};
    (void)state;
    put("m.obj", obj, strlen(obj));
    put("m.ply", ply, strlen(ply));
    put("m.xml", text, strlen(text));
    run run = run_rtc("import m.xml --out m.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "normals");
    run_free(&run);
    for (size_t i = 0; i < sizeof meshes / sizeof *meshes; i++)
        expect_in_scene("m.rts", meshes[i]);
    expect_in_scene("m_files/mesh_1.ply", "property float nx");
    remove_files("m_files");
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
    put("m.obj", obj, strlen(obj));
    put("n.ply", bare, strlen(bare));
    put("n.xml", stretched, strlen(stretched));
    run run = run_rtc("import n.xml --out n.rts");
    expect_status(&run, 0);
    expect_err(&run, "n.xml:2: the normals of a PLY file without any are weighted by area");
    expect_err(&run, "n.xml:3: the normals of a mesh without any are those before its transform");
    run_free(&run);
    expect_in_scene("n.rts", "shading smooth }");
    remove_files("n_files");
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
                                       "{ kd 0.3 0.3 0.3 }",
                                       "radiance 5 5 5",
                                       "{ kd 0.1 0.2 0.4 }",
                                       "fov     40\n"};
    (void)state;
    put("other.xml", text, strlen(text));
    run run = run_rtc("import other.xml --out other.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "warning");
    run_free(&run);
    for (size_t i = 0; i < sizeof made / sizeof *made; i++)
        expect_in_scene("other.rts", made[i]);
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
    put("part.xml", part, strlen(part));
    put("twice.xml", text, strlen(text));
    run run = run_rtc("import twice.xml --out twice.rts");
    expect_status(&run, 0);
    for (size_t i = 0; i < sizeof says / sizeof *says; i++)
        expect_err(&run, says[i]);
    run_free(&run);
    expect_in_scene("twice.rts", "spp 16777216");
}

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
        "more.pbrt:2: a material 'hair' became grey",
        "more.pbrt:3: a negative reflectance or transmittance became 0",
        "more.pbrt:6: \"float radus\" of sphere is left out",
        "main.pbrt:8: a shape 'cone' is left out",
    };
    (void)state;
    put("main.pbrt", text, strlen(text));
    put("more.pbrt", more, strlen(more));
    run run = run_rtc("import main.pbrt --out main.rts");
    expect_status(&run, 0);
    for (size_t i = 0; i < sizeof says / sizeof *says; i++)
        expect_err(&run, says[i]);
    expect_no_err(&run, "main.pbrt:1:");
    expect_no_err(&run, "main.pbrt:3:");
    run_free(&run);
    expect_in_scene("main.rts", "filter_radius 2");
    expect_in_scene("main.rts", "seed 5");
    expect_in_scene("main.rts", "fov     126.869");
    put("more.pbrt", broken, strlen(broken));
    run = run_rtc("import main.pbrt --out main.rts");
    expect_status(&run, 1);
    expect_err(&run, "more.pbrt:2: \"float radius\" takes one number");
    run_free(&run);
    put("more.pbrt", "AttributeBegin\n", 15);
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
    put("set.pbrt", text, strlen(text));
    run run = run_rtc("import set.pbrt --out set.rts");
    expect_status(&run, 0);
    expect_err(&run, "set.pbrt:1: a filter of radius 2 x 0.5 became the box of the language");
    expect_err(&run, "set.pbrt:2: the colour space 'rec2020' became srgb");
    expect_err(&run, "set.pbrt:4: regularize is left out");
    expect_err(&run, "set.pbrt:5: Option \"disablepixeljitter\" is left out");
    expect_no_err(&run, "set.pbrt:3");
    run_free(&run);
    expect_in_scene("set.rts", "spp 12");
    put("wide.pbrt", wide, strlen(wide));
    run = run_rtc("import wide.pbrt --out wide.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "filter");
    run_free(&run);
    expect_in_scene("wide.rts", "filter gaussian }");
    expect_in_scene("wide.rts", "seed 5");
    put("set.pbrt", silent, strlen(silent));
    run = run_rtc("import set.pbrt --out set.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "left out");
    expect_no_err(&run, "became");
    run_free(&run);
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
    put("a.gltf", json, strlen(json));
    run run = run_rtc("import a.gltf --out a.rts");
    expect_status(&run, 1);
    expect_err(&run, "a.gltf: cameras[1]: its angle or aspect ratio is out of range");
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
    expect_in_scene("a.rts", "{ ks 0 0.02 1  ior 1.5");
    put("a.obj", obj, strlen(obj));
    put("a.mtl", mtl, strlen(mtl));
    run = run_rtc("import a.obj --out a.rts");
    expect_status(&run, 0);
    expect_err(&run, "a.mtl:4: material m: 'frob' is left out");
    expect_err(&run, "a.mtl:1: material m: d below 1 is a sheet");
    expect_err(&run, "a.obj: the file has no camera");
    run_free(&run);
    put("a.mtl", broken, strlen(broken));
    run = run_rtc("import a.obj --out a.rts");
    expect_status(&run, 1);
    expect_err(&run, "a.mtl:2: 'x' is no number");
    run_free(&run);
}

static void files_outside_of_the_folder_are_not_read_from_strangers(void **state)
{
    static const char text[] = "mtllib ../outside.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    (void)state;
    assert_int_equal(mkdir("in", 0777), 0);
    put("in/outside.obj", text, strlen(text));
    put("outside.mtl", "newmtl m\n", 9);
    done(0, "import in/outside.obj --out outside.rts");
    if (has_landlock()) {
        run run = run_rtc("import in/outside.obj --untrusted --out outside.rts");
        expect_status(&run, 1);
        expect_err(&run, "outside of the scene's folder");
        run_free(&run);
    }
    remove_files("outside_files");
    remove_files("in");
}

/* A package of a stranger may hold links and pipes by the names of what an import makes. */
static void planted_names_are_not_followed(void **state)
{
    static const char text[] = "<scene><shape type=\"obj\"><string name=\"filename\" "
                               "value=\"a.obj\"/></shape></scene>\n",
                      mesh[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    (void)state;
    put("a.xml", text, strlen(text));
    put("a.obj", mesh, strlen(mesh));
    assert_int_equal(mkdir("victim", 0777), 0);
    put("victim/precious", "mine", 4);
    /* The folder in which an import is tried, or the one in there, leads elsewhere. */
    put("a.rts", "# mine\n", 7);
    assert_int_equal(mkdir(".a.rts.import", 0777) | symlink("../victim", ".a.rts.import/a_files"),
                     0);
    done(0, "import a.xml --out a.rts");
    assert_int_equal(symlink("victim", ".a.rts.import"), 0);
    done(0, "import a.xml --out a.rts");
    expect_no_file(".a.rts.import");
    expect_file("victim/precious");
    /* So does the folder of the files, or one of them. */
    remove_files("a_files");
    assert_int_equal(symlink("victim", "a_files"), 0);
    done(4, "import a.xml --out a.rts");
    assert_int_equal(unlink("a_files") | mkdir("a_files", 0777), 0);
    assert_int_equal(symlink("../victim/precious", "a_files/mesh_1.ply"), 0);
    done(4, "import a.xml --out a.rts");
    assert_int_equal(unlink("a_files/mesh_1.ply") | mkfifo("a_files/mesh_1.ply", 0600), 0);
    done(4, "import a.xml --out a.rts");
    put("mine", "mine", 4);
    expect_same_files("victim/precious", "mine");
    remove_files("a_files");
    remove_files("victim");
}

/* What a comment of a PLY file calls its texture is none for other programs. */
static void textures_in_comments_are_left_out(void **state)
{
    static const char mesh[] =
        "ply\nformat ascii 1.0\ncomment end_header\ncomment TextureFile t.png\nelement vertex "
        "3\nproperty float x\n"
        "property float y\nproperty float z\nelement face 1\nproperty list uchar int "
        "vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    static const char mitsuba[] = "<scene><shape type=\"ply\"><string name=\"filename\" "
                                  "value=\"m.ply\"/></shape></scene>\n",
                      pbrt[] = "WorldBegin\nShape \"plymesh\" \"string filename\" \"m.ply\"\n";
    (void)state;
    put("m.ply", mesh, strlen(mesh));
    put("m.xml", mitsuba, strlen(mitsuba));
    put("m.pbrt", pbrt, strlen(pbrt));
    done(0, "import m.xml --out m.rts");
    done(0, "import m.pbrt --out m.rts");
    remove_files("m_files");
}

/* Sixty files, each of which includes the next twice. */
static void includes_without_end_are_refused(void **state)
{
    char name[16], text[64];
    (void)state;
    for (int i = 0; i < 60; i++) {
        snprintf(name, sizeof name, "i%d.pbrt", i);
        snprintf(text, sizeof text, "Include \"i%d.pbrt\"\nInclude \"i%d.pbrt\"\n", i + 1, i + 1);
        put(name, text, strlen(text));
    }
    put("i60.pbrt", "\n", 1);
    run run = run_rtc("import i0.pbrt --out i.rts");
    expect_status(&run, 1);
    expect_err(&run, "more than 10000 includes");
    run_free(&run);
}

/* Each new name is looked for among all. */
static void materials_without_end_are_refused(void **state)
{
    enum { MANY = 20000 };
    char *text = malloc(64 + 24 * MANY);
    (void)state;
    assert_non_null(text);
    size_t used = (size_t)sprintf(text, "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    for (int i = 0; i < MANY; i++)
        used += (size_t)sprintf(text + used, "usemtl m%d\nf 1 2 3\n", i);
    put("many.obj", text, used);
    free(text);
    run run = run_rtc("import many.obj --out many.rts");
    expect_status(&run, 1);
    expect_err(&run, "many.obj:20004: more than 10000 materials");
    run_free(&run);
}

static void usage_is_told(void **state)
{
    (void)state;
    run run = run_rtc("import a.obj");
    expect_status(&run, 2);
    expect_err(&run, "--out SCENE.rts");
    run_free(&run);
    run = run_rtc("import a.obj --out a.png");
    expect_status(&run, 2);
    run_free(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(every_scene_of_the_folder_is_read_whole, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(what_is_wrong_is_refused_with_its_place, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(a_scene_that_was_there_stays, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(a_failed_import_leaves_the_meshes_of_an_earlier_one,
                                        scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(a_file_without_shapes_is_told, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(what_fails_leaves_no_files, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(bounds_of_buffers_are_checked, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(what_is_left_out_is_told, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(no_element_of_mitsuba_is_dropped_in_silence, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(meshes_of_mitsuba_are_shaded_as_there, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(normals_that_differ_from_those_of_mitsuba_are_told,
                                        scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(mitsuba_in_other_words_is_read, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(what_mitsuba_says_twice_or_of_nothing_is_told,
                                        scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(places_in_included_files_of_pbrt_are_theirs, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(settings_of_pbrt_that_change_the_picture_are_told,
                                        scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(places_are_those_of_items_and_of_other_files, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(files_outside_of_the_folder_are_not_read_from_strangers,
                                        scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(planted_names_are_not_followed, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(textures_in_comments_are_left_out, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(includes_without_end_are_refused, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(materials_without_end_are_refused, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(usage_is_told, scratch_enter, scratch_leave),
    };
    if (spawn_find_rtc() != 0 || !getcwd(top, sizeof top))
        return 1;
    return cmocka_run_group_tests_name("import", tests, NULL, NULL);
}
