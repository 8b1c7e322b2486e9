/*
 * test_import.c - scenes of other programs: those of tests/tools/import are read whole, and what is
 * wrong is refused with its place.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmocka.h>

#include "expect.h"
#include "lib/image/scratch.h"
#include "spawn.h"

static char top[4096]; /* the folder of the sources */

static void every_scene_of_the_folder_is_read_whole(void **state)
{
    static const struct {
        const char *name, *says;
    } scenes[] = {
        {"room.xml", "7 shapes, 0 triangles, 4 materials, 1 light"},
        {"metal.xml", "7 shapes, 0 triangles, 6 materials, 1 light"},
        {"picture.xml", "5 shapes, 24 triangles, 4 materials, 1 light"},
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
        {"picture.glb", "5 shapes, 30 triangles, 3 materials, 1 light"},
        {"delta.gltf", "4 shapes, 28 triangles, 3 materials, 3 lights"},
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
    {"need.gltf", "{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"EXT_texture_webp\"]}",
     "the file requires EXT_texture_webp, which is not read: run gltf-transform png"},
    {"short.glb", "glTF\2\0\0", "ends after 7 bytes"},
    {"small.glb", "glTF\2\0\0\0\4\0\0\0", "of which"},
    {"bomb.xml",
     "<?xml version=\"1.0\"?>\n<!DOCTYPE a [\n<!ENTITY b \"ha\">\n]>\n<scene>&b;</scene>",
     "bomb.xml:3: the file defines entities"},
    {"cut.xml", "<scene>\n<shape type=\"sphere\">\n", "cut.xml:2: <shape> is not closed"},
    {"root.xml", "<scenery/>", "not <scene>"},
    {"id.xml", "<scene>\n<bsdf id=\"a\" type=\"null\"/>\n<bsdf id=\"a\" type=\"null\"/></scene>",
     "id.xml:3: two elements have the id 'a'"},
    {"loop.xml",
     "<scene><bsdf type=\"twosided\" id=\"a\"><ref id=\"a\"/></bsdf>"
     "<shape type=\"cube\"><ref id=\"a\"/></shape></scene>",
     "nested deeper"},
    {"again.xml", "<scene>\n<include filename=\"./again.xml\"/></scene>",
     "again.xml' includes itself"},
    {"word.pbrt", "WorldBegin\nShpae \"sphere\"\n",
     "word.pbrt:2: the unknown directive 'Shpae' is left out"},
    {"cut.pbrt", "WorldBegin\nShape \"trianglemesh\" \"point3 P\" [ 0 0 0\n", "not closed"},
    {"deep.pbrt", "Include \"deep.pbrt\"\n", "includes are nested"},
    {"end.pbrt", "AttributeEnd\n", "end.pbrt:1: this end has no beginning"},
    {"open.pbrt", "AttributeBegin\n", "not closed"},
    {"nan.pbrt", "\nTranslate 0 inf 0\n", "nan.pbrt:2: Translate takes 3 numbers"},
    {"face.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n",
     "face.obj:3: a face is left out: it names vertex 3 of 2"},
    {"zero.obj", "v 0 0 0\nf 0 1 1\n", "zero.obj:2: a face is left out: '0' names no vertex"},
    {"uv.obj", "v 0 0 0\nf 1/0 1 1\n",
     "uv.obj:2: a face is left out: '0' names no texture coordinate"},
    {"nan.obj", "v 0 nan 0\n", "nan.obj:1: 'nan' is not a finite number"},
    {"none.obj", "v 0 0 0\n", "there is no face"},
    {"what.txt", "x", "not a format that is known"},
};

static void what_is_wrong_is_refused_with_its_place(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        size_t size = strcmp(wrong[i].name, "short.glb") == 0   ? 7
                      : strcmp(wrong[i].name, "small.glb") == 0 ? 12
                                                                : strlen(wrong[i].text);
        scratch_write_bytes(wrong[i].name, wrong[i].text, size);
        run run = run_rtc("import %s --out wrong.rts", wrong[i].name);
        if (run.status != 1 || !strstr(run.err, wrong[i].says))
            fail_msg("%s: status %d, expected '%s' in '%s'", wrong[i].name, run.status,
                     wrong[i].says, run.err);
        run_free(&run);
    }
    expect_no_file("wrong.rts");
}

static void a_file_without_shapes_is_told(void **state)
{
    (void)state;
    scratch_write("empty.pbrt", "LightSource \"point\"\n");
    run run = run_rtc("import empty.pbrt --out empty.rts");
    expect_status(&run, 0);
    expect_err(&run, "empty.pbrt: the file has no shape that is read");
    run_free(&run);
    scratch_write("nothing.pbrt", "\n");
    run = run_rtc("import nothing.pbrt --out nothing.rts");
    expect_status(&run, 1);
    expect_err(&run, "nothing.pbrt: nothing to render: no shape, camera or light was read");
    expect_no_err(&run, "warning");
    run_free(&run);
    expect_no_file("nothing.rts");
    run = run_rtc("import empty.pbrt --out a\"b.rts");
    expect_status(&run, 2);
    expect_err(&run, "a scene cannot name files by a path with quotes or line ends");
    run_free(&run);
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
        {"\"byteLength\":36,\"byteStride\":8", "\"count\":3", "overlap by the byteStride 8"},
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
        scratch_write_bytes("bounds.gltf", text, (size_t)length);
        run run = run_rtc("import bounds.gltf --out wrong.rts");
        if (run.status != 1 || !strstr(run.err, cases[i].says))
            fail_msg("case %d: status %d, expected '%s' in '%s'", (int)i, run.status, cases[i].says,
                     run.err);
        run_free(&run);
    }
}

/* Sixty files, each of which includes the next twice. */
static void includes_without_end_are_refused(void **state)
{
    char name[32], text[64];
    (void)state;
    for (int i = 0; i < 60; i++) {
        snprintf(name, sizeof name, "i%d.pbrt", i);
        snprintf(text, sizeof text, "Include \"i%d.pbrt\"\nInclude \"i%d.pbrt\"\n", i + 1, i + 1);
        scratch_write(name, text);
    }
    scratch_write("i60.pbrt", "\n");
    run run = run_rtc("import i0.pbrt --out i.rts");
    expect_status(&run, 1);
    expect_err(&run, "more than 10000 includes");
    run_free(&run);
}

static void materials_without_end_are_refused(void **state)
{
    enum { MANY = 20000 };
    char *text = malloc(64 + 24 * MANY);
    (void)state;
    assert_non_null(text);
    size_t used = (size_t)sprintf(text, "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    for (int i = 0; i < MANY; i++)
        used += (size_t)sprintf(text + used, "usemtl m%d\nf 1 2 3\n", i);
    scratch_write_bytes("many.obj", text, used);
    free(text);
    run run = run_rtc("import many.obj --out many.rts");
    expect_status(&run, 1);
    expect_err(&run, "many.obj:20004: more than 10000 materials");
    run_free(&run);
}

/* A file of the scene's folder, to be written and closed. */
static FILE *create(const char *name)
{
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    return file;
}

/* A name that comes again is no other material, and a library named again is not read again. */
static void materials_of_one_name_are_one(void **state)
{
    enum { AGAIN = 6000 };
    FILE *file = create("one.obj");
    (void)state;
    fprintf(file, "mtllib one.mtl\nmtllib one.mtl one.mtl\nusemtl m\n");
    fprintf(file, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    fclose(file);
    file = create("one.mtl");
    for (int i = 0; i < AGAIN; i++)
        fprintf(file, "newmtl m\nKd 0.%d 0 0\n", i + 1);
    fclose(file);
    run run = run_rtc("import one.obj --out one.rts");
    expect_status(&run, 0);
    expect_out(&run, "1 shape, 1 triangle, 1 material, 1 light");
    expect_err(&run, "one.mtl:3: a second material m is left out");
    run_free(&run);
    expect_in_file("one.rts", "kd 0.1 0 0");
    file = create("one.mtl");
    for (int i = 0; i <= 10000; i++)
        fprintf(file, "newmtl m\n");
    fclose(file);
    run = run_rtc("import one.obj --out one.rts");
    expect_status(&run, 1);
    expect_err(&run, "one.mtl:10001: more than 10000 materials");
    run_free(&run);
}

/* One file by many names, and one image by many lines. */
static void libraries_and_maps_are_bounded(void **state)
{
    FILE *file = create("many.obj");
    (void)state;
    scratch_write("m.mtl", "newmtl m\n");
    for (int i = 0; i <= 1000; i++) {
        fprintf(file, "mtllib ");
        for (int bit = 0; bit < 10; bit++)
            fprintf(file, i >> bit & 1 ? ".//" : "./");
        fprintf(file, "m.mtl\n");
    }
    fclose(file);
    run run = run_rtc("import many.obj --out many.rts");
    expect_status(&run, 1);
    expect_err(&run, "many.obj:1001: more than 1000 libraries of materials");
    run_free(&run);
    file = create("many.obj");
    fprintf(file, "mtllib");
    for (int i = 0; i <= 10000; i++)
        fprintf(file, " m.mtl");
    fclose(file);
    run = run_rtc("import many.obj --out many.rts");
    expect_status(&run, 1);
    expect_err(&run, "many.obj:1: more than 10000 libraries of materials beside others");
    run_free(&run);
    scratch_write("many.obj", "mtllib m.mtl\n");
    scratch_write("none.png", "no image");
    file = create("m.mtl");
    fprintf(file, "newmtl m\n");
    for (int i = 0; i <= 30000; i++)
        fprintf(file, "map_Kd none.png\n");
    fclose(file);
    run = run_rtc("import many.obj --out many.rts");
    expect_status(&run, 1);
    expect_err(&run, "m.mtl:30002: more than 30000 maps of materials");
    run_free(&run);
}

/* Each group places the one before twice, down to one that is empty. */
static void groups_without_end_are_refused(void **state)
{
    FILE *file = create("groups.xml");
    (void)state;
    fprintf(file, "<scene>\n<shape type=\"shapegroup\" id=\"g0\"/>\n");
    for (int i = 1; i <= 25; i++) {
        fprintf(file, "<shape type=\"shapegroup\" id=\"g%d\">\n", i);
        for (int k = 0; k < 2; k++)
            fprintf(file, "<shape type=\"instance\"><ref id=\"g%d\"/></shape>\n", i - 1);
        fprintf(file, "</shape>\n");
    }
    fprintf(file, "<shape type=\"instance\"><ref id=\"g25\"/></shape></scene>\n");
    fclose(file);
    run run = run_rtc("import groups.xml --out groups.rts");
    expect_status(&run, 1);
    expect_err(&run, "the instances of groups come to more than 1000000 shapes");
    expect_err(&run, "groups.xml:");
    run_free(&run);
}

/* An element of many others, which `use` has read each time. */
static void expect_bound_of_references(const char *head, const char *tail, const char *use)
{
    FILE *file = create("again.xml");
    fprintf(file, "<scene>\n%s", head);
    for (int i = 0; i < 40000; i++)
        fprintf(file, "<a/>");
    fprintf(file, "%s\n", tail);
    for (int i = 0; i < 1000; i++)
        fprintf(file, "%s\n", use);
    fprintf(file, "</scene>\n");
    fclose(file);
    run run = run_rtc("import again.xml --out again.rts");
    expect_status(&run, 1);
    expect_err(&run, "again.xml:4");
    expect_err(&run, "references come to more than 16000000 elements");
    run_free(&run);
}

static void references_to_what_is_long_are_bounded(void **state)
{
    (void)state;
    expect_bound_of_references("<shape type=\"shapegroup\" id=\"g\"><shape type=\"sphere\">",
                               "</shape></shape>",
                               "<shape type=\"instance\"><ref id=\"g\"/></shape>");
    expect_bound_of_references("<texture type=\"checkerboard\" id=\"t\">", "</texture>",
                               "<shape type=\"sphere\"><bsdf type=\"diffuse\">"
                               "<ref name=\"reflectance\" id=\"t\"/></bsdf></shape>");
    expect_bound_of_references("<bsdf type=\"diffuse\" id=\"b\">", "</bsdf>",
                               "<shape type=\"sphere\"><bsdf type=\"twosided\">"
                               "<ref id=\"b\"/></bsdf></shape>");
}

/* What a mesh without triangles leaves in an object takes no time each time that it is placed. */
static void instances_of_empty_objects_are_bounded(void **state)
{
    enum { MESHES = 5000, INSTANCES = 1000001 };
    FILE *file = create("empty.pbrt");
    (void)state;
    fprintf(file, "ObjectBegin \"o\"\n");
    for (int i = 0; i < MESHES; i++)
        fprintf(file, "Shape \"trianglemesh\" \"point3 P\" [0 0 0] \"integer indices\" []\n");
    fprintf(file, "ObjectEnd\n");
    for (int i = 0; i < INSTANCES; i++)
        fprintf(file, "ObjectInstance \"o\"\n");
    fclose(file);
    run run = run_rtc("import empty.pbrt --out empty.rts");
    expect_status(&run, 1);
    expect_err(&run, "empty.pbrt:1005003: more than 1000000 instances of objects");
    run_free(&run);
}

/* Opens again.gltf, whose first node has a list of children: each of them the second node. */
static FILE *begin_gltf(int children)
{
    FILE *file = create("again.gltf");
    fprintf(file, "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],");
    fprintf(file, "\"nodes\":[{\"children\":[");
    for (int i = 0; i < children; i++)
        fprintf(file, i ? ",1" : "1");
    fprintf(file, "]},");
    return file;
}

static void put_members(FILE *file, int count)
{
    for (int i = 0; i < count; i++)
        fprintf(file, "\"k%d\":0,", i);
}

static void expect_gltf_refused(FILE *file, const char *says)
{
    fclose(file);
    run run = run_rtc("import again.gltf --out again.rts");
    expect_status(&run, 1);
    expect_err(&run, "again.gltf: ");
    expect_err(&run, says);
    run_free(&run);
}

/* Objects of many members that nodes or primitives name again and again. */
static void long_objects_of_gltf_are_bounded(void **state)
{
    enum { MANY = 2500 };
    static const char says[] =
        "objects of more than 16 members that are named again come to more than 4000000";
    FILE *file = begin_gltf(MANY);
    (void)state;
    fprintf(file, "{");
    put_members(file, MANY);
    fprintf(file, "\"name\":\"n\"}]}");
    expect_gltf_refused(file, says);
    file = begin_gltf(MANY);
    fprintf(file, "{\"extensions\":{\"KHR_lights_punctual\":{");
    put_members(file, MANY);
    fprintf(file, "\"light\":0}}}],\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[");
    fprintf(file, "{\"type\":\"point\"}]}}}");
    expect_gltf_refused(file, says);
    file = begin_gltf(1);
    fprintf(file, "{\"mesh\":0}],\"materials\":[{");
    put_members(file, MANY);
    fprintf(file, "\"name\":\"m\"}],\"meshes\":[{\"primitives\":[{}");
    for (int i = 0; i < MANY; i++)
        fprintf(file, ",{\"material\":0}");
    fprintf(file, "]}]}");
    expect_gltf_refused(file, says);
}

/* Nodes that place one light 10^6 times. */
static void lights_of_gltf_are_bounded(void **state)
{
    FILE *file = begin_gltf(1000);
    (void)state;
    fprintf(file, "{\"children\":[2");
    for (int i = 1; i < 900; i++)
        fprintf(file, ",2");
    fprintf(file, "]},{\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}],");
    fprintf(file, "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[");
    fprintf(file, "{\"type\":\"point\"}]}}}");
    expect_gltf_refused(file, "lights[0]: the scene has more than 100000 lights");
}

/* Primitives without triangles that read the same positions, which takes no room but time. */
static void shared_accessors_of_gltf_are_bounded(void **state)
{
    enum { TRIPLES = 20000, PRIMITIVES = 6000 };
    FILE *file = begin_gltf(1);
    (void)state;
    fprintf(file, "{\"mesh\":0}],\"bufferViews\":[{\"buffer\":0,\"byteStride\":12,");
    fprintf(file, "\"byteLength\":%d}],\"accessors\":[", 3 * TRIPLES);
    fprintf(file, "{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":%d},",
            TRIPLES / 4);
    fprintf(file, "{\"bufferView\":0,\"componentType\":5121,\"type\":\"SCALAR\",\"count\":1}],");
    fprintf(file, "\"meshes\":[{\"primitives\":[{}");
    for (int i = 0; i < PRIMITIVES; i++)
        fprintf(file, ",{\"attributes\":{\"POSITION\":0}}");
    fprintf(file, "]}],\"buffers\":[{\"byteLength\":%d,\"uri\":\"data:;base64,", 3 * TRIPLES);
    for (int i = 0; i < TRIPLES; i++)
        fprintf(file, "AAAA");
    fprintf(file, "\"}]}");
    expect_gltf_refused(file, "meshes[0]: what its accessors and images share comes to more than "
                              "64 times its bytes");
}

/* Primitives without a mesh take no time where they are placed, or it would be minutes. */
static void empty_primitives_of_gltf_take_no_time(void **state)
{
    enum { MANY = 150000, SECONDS = 8 };
    struct rlimit limit;
    FILE *file = begin_gltf(MANY);
    (void)state;
    fprintf(file, "{\"mesh\":0}],\"meshes\":[{\"primitives\":[{}");
    for (int i = 1; i < MANY; i++)
        fprintf(file, ",{}");
    fprintf(file, "]}]}");
    fclose(file);
    assert_int_equal(getrlimit(RLIMIT_CPU, &limit), 0);
    const struct rlimit least = {SECONDS, limit.rlim_max};
    assert_int_equal(setrlimit(RLIMIT_CPU, &least), 0);
    run run = run_rtc("import again.gltf --out again.rts");
    setrlimit(RLIMIT_CPU, &limit);
    expect_status(&run, 1);
    expect_err(&run, "a primitive without positions is left out");
    run_free(&run);
}

enum { MANY_NAMES = 20000 };

/* What names of pbrt mean where there are many, and some are defined again. */
static void many_names_of_pbrt_keep_their_meaning(void **state)
{
    FILE *file = create("names.pbrt");
    (void)state;
    fprintf(file, "WorldBegin\n");
    for (int i = 0; i < MANY_NAMES; i++)
        fprintf(file,
                "MakeNamedMaterial \"n%d\" \"rgb reflectance\" [0.%05d 0 0]"
                " \"string type\" \"diffuse\"\n"
                "Texture \"n%d\" \"spectrum\" \"constant\" \"rgb value\" [0 0.%05d 0]\n"
                "Identity Translate %d 0 0 CoordinateSystem \"n%d\" Identity\n"
                "ObjectBegin \"n%d\" Shape \"sphere\" \"float radius\" %d ObjectEnd\n",
                i, i + 1, i, i + 1, i + 1, i, i, i + 2);
    fprintf(file, "NamedMaterial \"n0\" Shape \"sphere\"\n"
                  "MakeNamedMaterial \"n0\" \"rgb reflectance\" [0.9 0 0]"
                  " \"string type\" \"diffuse\"\n"
                  "AttributeBegin NamedMaterial \"n0\" Shape \"sphere\" AttributeEnd\n"
                  "Texture \"n0\" \"spectrum\" \"scale\" \"texture tex\" \"n0\""
                  " \"float scale\" 5\n"
                  "Material \"diffuse\" \"texture reflectance\" \"n0\" Shape \"sphere\"\n"
                  "Translate 0 7 0 CoordinateSystem \"n0\" Identity\n"
                  "ObjectBegin \"n0\" Shape \"sphere\" \"float radius\" 30003 ObjectEnd\n"
                  "CoordSysTransform \"n0\" ObjectInstance \"n0\"\n");
    for (int i = 0; i < MANY_NAMES; i++)
        fprintf(file, "NamedMaterial \"n1\" CoordSysTransform \"n%d\" ObjectInstance \"n%d\"\n",
                1 + i % 9, MANY_NAMES - 1);
    fclose(file);
    run run = run_rtc("import names.pbrt --out names.rts");
    expect_status(&run, 0);
    expect_out(&run, "20004 shapes, 0 triangles, 4 materials");
    run_free(&run);
    static const char *const parts[] = {"kd 1e-05 0 0", "kd 0.9 0 0", "kd 0 5e-05 0",
                                        "radius 2 ",    "0 1 0 7",    "radius 20001"};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        expect_in_file("names.rts", parts[i]);
}

/* Names that are alike in their first 200 bytes. */
static void long_names_of_pbrt_differ(void **state)
{
    char name[201];
    FILE *file = create("long.pbrt");
    (void)state;
    memset(name, 'n', 200);
    name[200] = '\0';
    fprintf(file, "WorldBegin\n");
    for (int i = 1; i <= 2; i++)
        fprintf(file,
                "MakeNamedMaterial \"%s%d\" \"rgb reflectance\" [0.%d 0 0]"
                " \"string type\" \"diffuse\"\n"
                "Texture \"%s%d\" \"spectrum\" \"constant\" \"rgb value\" [0 0.%d 0]\n"
                "Translate 0 0 %d CoordinateSystem \"%s%d\" Identity\n"
                "ObjectBegin \"%s%d\" Shape \"sphere\" \"float radius\" 0.%d ObjectEnd\n",
                name, i, i, name, i, i, 5 + i, name, i, name, i, i);
    fprintf(file,
            "NamedMaterial \"%s1\" Shape \"sphere\"\n"
            "Material \"diffuse\" \"texture reflectance\" \"%s1\" Shape \"sphere\"\n"
            "CoordSysTransform \"%s1\" ObjectInstance \"%s1\"\n",
            name, name, name, name);
    fclose(file);
    run run = run_rtc("import long.pbrt --out long.rts");
    expect_status(&run, 0);
    run_free(&run);
    static const char *const parts[] = {"kd 0.1 0 0", "kd 0 0.1 0", "radius 0.1", "1 6"};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        expect_in_file("long.rts", parts[i]);
}

static void many_names_of_mitsuba_keep_their_meaning(void **state)
{
    FILE *file = create("names.xml");
    (void)state;
    fprintf(file, "<scene>\n");
    for (int i = 0; i < MANY_NAMES; i++)
        fprintf(file,
                "<default name=\"n%d\" value=\"%d\"/>"
                "<bsdf type=\"diffuse\" id=\"n%d\">"
                "<rgb name=\"reflectance\" value=\"0.%05d 0 0\"/></bsdf>"
                "<emitter type=\"point\"/><emitter type=\"constant\"/>\n",
                i, i + 1, i, i + 1);
    fprintf(file, "<default name=\"n0\" value=\"7\"/>\n");
    for (int i = 0; i < MANY_NAMES; i++)
        fprintf(file,
                "<shape type=\"sphere\"><float name=\"radius\" value=\"$n%d\"/>"
                "<ref id=\"n%d\"/></shape>\n",
                MANY_NAMES - 1 - i, i);
    fprintf(file, "<include filename=\"other.xml\"/>\n</scene>\n");
    fclose(file);
    scratch_write("other.xml", "<scene><bsdf type=\"diffuse\" id=\"m\"/></scene>");
    run run = run_rtc("import names.xml --out names.rts");
    expect_status(&run, 0);
    expect_out(&run, "20000 shapes, 0 triangles, 20000 materials, 20001 lights");
    expect_in_file("names.rts", "radiance 20000 20000 20000");
    run_free(&run);
    expect_in_file("names.rts", "kd 0.2 0 0");
    scratch_write("other.xml", "<scene>\n<bsdf type=\"diffuse\" id=\"n7\"/></scene>");
    run = run_rtc("import names.xml --out names.rts");
    expect_status(&run, 1);
    expect_err(&run, "other.xml:2: two elements have the id 'n7'");
    run_free(&run);
}

static void usage_is_told(void **state)
{
    (void)state;
    run run = run_rtc("import a.obj");
    expect_status(&run, 2);
    expect_err(&run, "--out SCENE.rts");
    run_free(&run);
    static const struct {
        const char *line, *says;
        int status;
    } hints[] = {
        {"import b/a.obj", "hint: `rtc import b/a.obj --out a.rts`, with its meshes", 2},
        {"import it's.obj",
         "`rtc import 'it'\\''s.obj' --out 'it'\\''s.rts'`, with its meshes and images in "
         "it's_files",
         2},
        {"import a.obj b.rts", "hint: `rtc import a.obj --out b.rts`", 2},
        {"import a.ply", "hint: `rtc import a.ply --out a.rts`, with its meshes", 2},
        {"import a.stl --out a.rts", "a.stl: No such file", 1},
        {"import a(1).rts --out b.rts", "hint: `rtc 'a(1).rts'` renders it", 1},
        {"import a.rts --out b.rts", "hint: `rtc a.rts` renders it", 1},
        {"import a.blend --out b.rts", "export it as glTF", 1},
        {"import a.png --out b.rts", "a.png is a picture", 1},
    };
    for (size_t i = 0; i < sizeof hints / sizeof *hints; i++) {
        run = run_rtc("%s", hints[i].line);
        expect_status(&run, hints[i].status);
        expect_err(&run, hints[i].says);
        run_free(&run);
    }
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
        cmocka_unit_test_setup_teardown(a_file_without_shapes_is_told, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(bounds_of_buffers_are_checked, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(includes_without_end_are_refused, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(materials_without_end_are_refused, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(materials_of_one_name_are_one, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(libraries_and_maps_are_bounded, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(groups_without_end_are_refused, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(references_to_what_is_long_are_bounded, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(instances_of_empty_objects_are_bounded, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(long_objects_of_gltf_are_bounded, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(lights_of_gltf_are_bounded, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(shared_accessors_of_gltf_are_bounded, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(empty_primitives_of_gltf_take_no_time, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(many_names_of_pbrt_keep_their_meaning, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(long_names_of_pbrt_differ, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(many_names_of_mitsuba_keep_their_meaning, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(usage_is_told, scratch_enter, scratch_leave),
    };
    if (spawn_find_rtc() != 0 || !getcwd(top, sizeof top))
        return 1;
    return cmocka_run_group_tests_name("import", tests, NULL, NULL);
}
