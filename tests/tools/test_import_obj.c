/*
 * test_import_obj.c - OBJ files with their MTL: names, colours of vertices, also
 * of glTF, and materials.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

#include "expect.h"
#include "lib/image/jpeg_sample.h"
#include "lib/image/scratch.h"
#include "mesh/load.h"
#include "spawn.h"

#define CORNERS "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

/* Leaves one space between the words of a text. */
static void flatten(char *text)
{
    char *out = text;
    for (const char *at = text; *at; at++)
        if (!strchr(" \n", *at))
            *out++ = *at;
        else if (out > text && out[-1] != ' ')
            *out++ = ' ';
    *out = '\0';
}

/* The material of the scene's instance of this number, from 0, is this block. */
static void expect_material(int instance, const char *block)
{
    static const char lead[] = " { material ";
    char name[64], head[80], *scene = scratch_read("m.rts"), *at = scene;
    flatten(scene);
    for (int i = -1; i < instance; i++) {
        at = strstr(at, lead);
        assert_non_null(at);
        at += strlen(lead);
    }
    assert_int_equal(sscanf(at, "%63s", name), 1);
    snprintf(head, sizeof head, " material %s {", name);
    at = strstr(scene, head);
    assert_non_null(at);
    at += strlen(head) - 1;
    if (strncmp(at, block, strlen(block)) != 0)
        fail_msg("'%s' is not at '%s'", block, at);
    free(scene);
}

/* Three faces of these materials are red, green and blue, without a word. */
static void expect_colours(const char *const names[3], const char *const used[3], const char *lib)
{
    char mtl[512], obj[512];
    snprintf(mtl, sizeof mtl, "newmtl %s\nKd 1 0 0\nnewmtl %s\nKd 0 1 0\nnewmtl %s\nKd 0 0 1\n",
             names[0], names[1], names[2]);
    snprintf(obj, sizeof obj,
             "mtllib %s\n" CORNERS "usemtl %s\nf 1 2 3\nusemtl %s\nf 1 2 3\nusemtl %s\nf 1 2 3\n",
             lib, used[0], used[1], used[2]);
    scratch_write("part one.mtl", mtl);
    scratch_write("m.obj", obj);
    run run = run_rtc("import m.obj --out m.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "material");
    expect_out(&run, "3 triangles, 3 materials");
    run_free(&run);
    expect_material(0, "{ kd 1 0 0 }");
    expect_material(1, "{ kd 0 1 0 }");
    expect_material(2, "{ kd 0 0 1 }");
}

static void names_of_materials_go_to_the_end_of_the_line(void **state)
{
    static const char *const names[][3] = {
        {"/graphic part0", "/graphic part1", "/graphic part2"},
        {"a", "a b", "a  b"},
        {"part #1", "part #2", "part"},
        {"#1", "no.2#", "c#3"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        expect_colours(names[i], names[i], "part one.mtl");
}

static void comments_behind_names_are_none_of_a_name(void **state)
{
    static const char *const names[3] = {"red # the first", "green", "blue #\t3"},
                             *const used[3] = {"red", "green\t# as grass ", "blue # the last"};
    (void)state;
    expect_colours(names, used, "part one.mtl # all");
}

/* A line of mtllib, the files that are there, and those that are read: one material of each. */
static void libraries_are_one_name_or_several(void **state)
{
    static const struct {
        const char *line, *files[3];
        int count;
    } lines[] = {{"a b.mtl", {"a b.mtl", "a", "b.mtl"}, 1},
                 {"a.mtl b.mtl", {"a.mtl", "b.mtl"}, 2},
                 {"my a.mtl b.MTL c", {"my a.mtl", "b.MTL", "c"}, 3},
                 {"x y z", {"x", "y", "z"}, 3},
                 {"n#1.mtl", {"n#1.mtl"}, 1},
                 {"n #1.mtl", {"n #1.mtl", "n"}, 1},
                 {".\\n.mtl", {"n.mtl"}, 1}};
    (void)state;
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        char obj[256], mtl[64], says[64];
        size_t used = (size_t)snprintf(obj, sizeof obj, "mtllib %s\n" CORNERS, lines[i].line);
        for (int k = 0; k < lines[i].count; k++)
            used += (size_t)snprintf(obj + used, sizeof obj - used, "usemtl m%d\nf 1 2 3\n", k);
        for (int k = 0; k < 3 && lines[i].files[k]; k++) {
            snprintf(mtl, sizeof mtl, "newmtl m%d\nKd 0.5\n", k);
            scratch_write(lines[i].files[k], mtl);
        }
        scratch_write("m.obj", obj);
        run run = run_rtc("import m.obj --out m.rts");
        expect_status(&run, 0);
        expect_no_err(&run, "material");
        snprintf(says, sizeof says, "%d material", lines[i].count);
        expect_out(&run, says);
        run_free(&run);
        for (int k = 0; k < 3 && lines[i].files[k]; k++)
            remove(lines[i].files[k]);
    }
}

static void missing_libraries_and_materials_are_named_whole(void **state)
{
    (void)state;
    scratch_write("a.obj",
                  "mtllib no such.mtl b.mtl\n" CORNERS "usemtl red\nf 1// 2// 3//\nf 1/ 2/ "
                  "3/\n");
    run run = run_rtc("import a.obj --out a.rts");
    expect_status(&run, 0);
    expect_err(&run, "a.obj:1: 'no such.mtl' is not there: the library of materials is left out");
    expect_out(&run, "2 triangles");
    run_free(&run);
    scratch_write("b.mtl", "newmtl Metal dark\nKd 1\n");
    scratch_write("b.obj", "mtllib b.mtl\n" CORNERS "usemtl Metal drak\nf 1 2 3\n");
    run = run_rtc("import b.obj --out b.rts");
    expect_status(&run, 0);
    expect_err(&run, "there is no material 'Metal drak' (did you mean 'Metal dark'?): a grey one");
    run_free(&run);
}

/* A file or a material of faces on a line is told by the file that the user has. */
static void faces_on_a_line_are_told_by_their_line(void **state)
{
    (void)state;
    scratch_write("line.obj", CORNERS "v 2 0 0\nf 1 2 4\n");
    run run = run_rtc("import line.obj --out line.rts");
    expect_status(&run, 1);
    expect_err(&run, "line.obj: no face in it has an area");
    expect_no_err(&run, ".ply");
    run_free(&run);
    scratch_write("two.obj", CORNERS "v 2 0 0\nusemtl a\nf 1 2 4\nusemtl b\nf 1 2 3\n");
    run = run_rtc("import two.obj --out two.rts");
    expect_status(&run, 0);
    expect_err(&run, "two.obj:6: a face has all its corners on one line: it is not seen");
    expect_out(&run, "1 shape, 1 triangle");
    run_free(&run);
}

/* The mesh of a scene that was made, by its name there. */
/* A CR alone, too, behind a backslash as well. */
static void lines_end_by_cr_or_lf(void **state)
{
    static const char *const ends[] = {"\n", "\r\n", "\r"};
    (void)state;
    for (int i = 0; i < 3; i++) {
        const char *e = ends[i];
        char text[256];
        snprintf(text, sizeof text, "v 0 0 0%sv 1 0 0%sv 0 \\%s1 0%sf 1 2 3%sf 1 2 9%s", e, e, e, e,
                 e, e);
        scratch_write("a.obj", text);
        run run = run_rtc("check a.obj");
        expect_status(&run, 0);
        expect_out(&run, "1 shape, 1 triangle");
        expect_err(&run, "a.obj:6: ");
        run_free(&run);
    }
}

static void read_mesh(rt_mesh **mesh, const char *name)
{
    rt_error error;
    assert_int_equal(rt_mesh_load(mesh, name, NULL, &error), RT_OK);
}

static void colours_of_vertices_are_kept(void **state)
{
    const float half = 0.21404114f, quarter = 0.05087609f; /* linear, of sRGB values */
    const float expected[] = {1, 1, 1, 1, 1,    1,       1, 1, 1, half, quarter,
                              1, 0, 0, 0, half, quarter, 1, 1, 1, 1};
    rt_mesh *mesh;
    (void)state;
    scratch_write("c.obj", CORNERS "f 1 2 3\nv 2 0 0 0.5 0.25 1.00009\nv 3 0 0 0 0 0 1\n"
                                   "v 2 1 0 0.5 0.25 1\nv 2 2 0 0.5\nf 4 5 6\nf 4 6 7\n");
    run run = run_rtc("import c.obj --out c.rts");
    expect_status(&run, 0);
    run_free(&run);
    expect_in_file("c.rts", "material white_0 { kd 1 1 1 }");
    read_mesh(&mesh, "c_files/mesh_1.ply");
    assert_int_equal(mesh->vertex_count, 7);
    assert_non_null(mesh->colours);
    for (size_t i = 0; i < 21; i++)
        assert_true(mesh->colours[i] > expected[i] - 1e-6f &&
                    mesh->colours[i] < expected[i] + 1e-6f);
    rt_mesh_destroy(mesh);
}

/* Where one is above 1 they go to 255; what has none is white, what is negative black. */
static void colours_to_255_are_told(void **state)
{
    const float half = 0.21404114f; /* linear, of 127.5 in 255 */
    const float expected[] = {1, 1, 1, 1, 1, 1, 1, 1, 1, half, 0, 1};
    rt_mesh *mesh;
    (void)state;
    scratch_write("c.obj", CORNERS "v 0 0 1 127.5 -1 300\nf 1 2 3\nf 1 2 4\n");
    run run = run_rtc("import c.obj --out c.rts");
    expect_status(&run, 0);
    expect_err(&run, "c.obj:4: v: the colour -1 is negative: it became 0");
    expect_err(&run, "c.obj:4: v: the colour 127.5 is above 1: the colours of all vertices are "
                     "read as numbers to 255");
    run_free(&run);
    read_mesh(&mesh, "c_files/mesh_1.ply");
    assert_int_equal(mesh->vertex_count, 4);
    for (size_t i = 0; i < 12; i++)
        assert_float_equal(mesh->colours[i], expected[i], 1e-6);
    rt_mesh_destroy(mesh);
}

/* The normals of the mesh's vertices at a position: those of the largest and of the least x. */
static void expect_normals(const rt_mesh *mesh, const float position[3], const float most[3],
                           const float least[3])
{
    const float *found[2] = {NULL, NULL};
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const float *const n = mesh->normals + 3 * i;
        if (memcmp(mesh->positions + 3 * i, position, 3 * sizeof *position) != 0)
            continue;
        found[0] = !found[0] || n[0] > found[0][0] ? n : found[0];
        found[1] = !found[1] || n[0] < found[1][0] ? n : found[1];
    }
    assert_non_null(found[0]);
    for (size_t c = 0; c < 3; c++) {
        assert_float_equal(found[0][c], most[c], 1e-6);
        assert_float_equal(found[1][c], least[c], 1e-6);
    }
}

/*
 * Two squares along an edge, one up and one that looks along x: smooth across it in one group, not
 * across groups or without one; weighted by angles, not by how the squares are cut.
 */
static void smoothing_gives_normals(void **state)
{
#define EDGE "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 -9\nv 1 1 -9\n"
    const float edge[] = {1, 0, 0}, far[] = {0, 0, 0}, half = 0.70710678f;
    const struct {
        const char *faces;
        float most[3], least[3]; /* at the edge */
    } cases[] = {
        {"s 1\nf 1 2 3 4\nf 5 6 3 2\n", {half, 0, half}, {half, 0, half}},
        {"s 1\nf 1 2 3 4\nf 6 3 2 5\n", {half, 0, half}, {half, 0, half}},
        {"s on\nf 1 2 3 4\nf 5 6 3 2\n", {half, 0, half}, {half, 0, half}},
        {"s 1\nf 1 2 3 4\ns 2\nf 5 6 3 2\n", {1, 0, 0}, {0, 0, 1}},
        {"s 1\nf 1 2 3 4\ns off\nf 5 6 3 2\n", {1, 0, 0}, {0, 0, 1}},
        {"s 1\nf 1 2 3 4\ns 0\nf 5 6 3 2\n", {1, 0, 0}, {0, 0, 1}},
        /* Given ones stay, and the face without gets its own. */
        {"vn 0 0 1\nf 1//1 2//1 3//1 4//1\nf 5 6 3 2\n", {1, 0, 0}, {0, 0, 1}},
        {"vn 0.6 0 0.8\nf 1 2 3 4\nf 5//1 6//1 3//1 2//1\n", {0.6f, 0, 0.8f}, {0, 0, 1}},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const float up[] = {0, 0, 1};
        char text[512];
        rt_mesh *mesh;
        snprintf(text, sizeof text, EDGE "%s", cases[i].faces);
        scratch_write("s.obj", text);
        run run = run_rtc("import s.obj --out s.rts --quiet");
        expect_status(&run, 0);
        run_free(&run);
        read_mesh(&mesh, "s_files/mesh_1.ply");
        assert_non_null(mesh->normals);
        expect_normals(mesh, edge, cases[i].most, cases[i].least);
        expect_normals(mesh, far, up, up);
        rt_mesh_destroy(mesh);
    }
    scratch_write("s.obj", EDGE "f 1 2 3 4\nf 5 6 3 2\ns cube\n");
    run run = run_rtc("import s.obj --out s.rts");
    expect_status(&run, 0);
    expect_err(&run, "s.obj:9: 's cube' is taken as off");
    run_free(&run);
    rt_mesh *mesh;
    read_mesh(&mesh, "s_files/mesh_1.ply");
    assert_null(mesh->normals);
    rt_mesh_destroy(mesh);
}

/* A normal or a texture coordinate that is none is told, once, and the rest is read. */
static void what_is_no_normal_is_told(void **state)
{
    (void)state;
    scratch_write("n.obj", CORNERS "vn nan 0 1\nvn 0 0 inf\nvn 0 0 1\nvn 0 0 0\nvt x\nvt 1 1\n"
                                   "f 1/1/1 2/2/4 3/2/3\nf 1/1/1 2/2/2 3/2/3\n");
    run run = run_rtc("import n.obj --out n.rts");
    expect_status(&run, 0);
    expect_err(&run, "n.obj:4: 'nan' is not a finite number: the normal of the faces there stands "
                     "in its place");
    expect_err(&run, "n.obj:8: 'x' is not a finite number: 0 0 stands in its place");
    expect_no_err(&run, "n.obj:5");
    expect_no_err(&run, "n.obj:7");
    expect_out(&run, "1 shape, 2 triangles");
    run_free(&run);
    run = run_rtc("n.rts --spp 1 --width 8 --height 8");
    expect_status(&run, 0);
    expect_no_err(&run, "normal");
    run_free(&run);
}

/* Images are looked for beside the MTL that names them; names may stand in quotation marks. */
static void images_lie_beside_their_library(void **state)
{
    (void)state;
    assert_int_equal(mkdir("sub", 0700), 0);
    scratch_write("sub/a b.ppm", "P3 1 1 255 255 0 0\n");
    scratch_write("sub/m.mtl", "newmtl a\nmap_Kd -s 2 \"a b.ppm\"\nnewmtl b\nmap_Kd a b.ppm\n");
    scratch_write("m.obj", "mtllib \"sub/m.mtl\"\n" CORNERS
                           "vt 0 0\nusemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1/1 2/1 3/1\n");
    run run = run_rtc("import m.obj --out m.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "left out");
    expect_in_file("m.rts", "scale 2 1");
    run_free(&run);
}

/* A triangle of this material, whose positions 0 0 0, 2 0 0 and 0 -1 0.5 are the colours too. */
static void write_coloured_gltf(const char *material)
{
    char text[1400];
    snprintf(
        text, sizeof text,
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],"
        "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":"
        "{\"POSITION\":0,\"COLOR_0\":0,\"TEXCOORD_0\":1},\"material\":0},"
        "{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
        "\"materials\":[{%s}],\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"w.ppm\"}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\","
        "\"count\":3},{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC2\",\"count\":3}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
        "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:x;base64,"
        "AAAAAAAAAAAAAAAAAAAAQAAAAAAAAAAAAAAAAAAAgL8AAAA/\"}]}",
        material);
    scratch_write("c.gltf", text);
    scratch_write("w.ppm", "P3 1 1 255 200 100 50");
}

static void colours_of_gltf_are_clamped(void **state)
{
    static const float expected[] = {0, 0, 0, 1, 0, 0, 0, 0, 0.5f};
    rt_mesh *mesh;
    (void)state;
    write_coloured_gltf("");
    expect_rtc(0, "import c.gltf --out c.rts");
    read_mesh(&mesh, "c_files/mesh_2.ply");
    assert_null(mesh->colours);
    assert_memory_equal(mesh->of_vertices.values, expected, sizeof expected);
    rt_mesh_destroy(mesh);
}

/* An accessor of colours: its numbers, and what they are together. */
#define COLOURS(numbers, of) "\"bufferView\":1," numbers ",\"type\":" of
#define OF_BYTES "\"componentType\":5121,\"normalized\":true"

/* A triangle with these colours, of half an opacity each, in a material of this mode. */
static void import_colours(const char *colours, const char *mode, const char *says)
{
    char text[1024];
    snprintf(text, sizeof text,
             "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],"
             "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":"
             "{\"POSITION\":0,\"COLOR_0\":1},\"material\":0}]}],\"materials\":[{%s}],"
             "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\","
             "\"count\":3},{%s}],"
             "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":1,\"byteLength\":12},"
             "{\"buffer\":2,\"byteLength\":36}],"
             "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:x;base64,"
             "AAAAAAAAAAAAAAAAAAAAQAAAAAAAAAAAAAAAAAAAgL8AAAA/\"},"
             "{\"byteLength\":12,\"uri\":\"data:x;base64,/wCAgP8AgID/AICA\"},"
             "{\"byteLength\":36,\"uri\":\"data:x;base64,"
             "AADAfwAAwH8AAMB/AADAfwAAwH8AAMB/AADAfwAAwH8AAMB/\"}]}",
             mode, colours);
    scratch_write("a.gltf", text);
    run run = run_rtc("import a.gltf --out a.rts");
    expect_status(&run, 0);
    if (says)
        expect_err(&run, says);
    else
        expect_no_err(&run, "COLOR_0");
    run_free(&run);
}

static void colours_of_gltf_are_of_its_types(void **state)
{
    static const char bytes[] = COLOURS(OF_BYTES, "\"VEC4\",\"count\":3"),
                      blend[] = "\"alphaMode\":\"BLEND\"";
    static const struct {
        const char *colours, *says;
    } wrong[] = {
        {COLOURS("\"componentType\":5121", "\"VEC4\",\"count\":3"),
         "meshes[0]: COLOR_0 is left out: it holds neither floats nor normalized"},
        {COLOURS(OF_BYTES, "\"VEC4\",\"count\":2"),
         "meshes[0]: COLOR_0 is left out: 2 colours for 3 vertices"},
        {COLOURS(OF_BYTES, "\"VEC2\",\"count\":3"),
         "meshes[0]: COLOR_0 is left out: it is of neither VEC3 nor VEC4"},
    };
    rt_mesh *mesh;
    (void)state;
    import_colours(bytes, "", NULL);
    import_colours(bytes, blend, "meshes[0]: the opacity of COLOR_0 is left out");
    read_mesh(&mesh, "a_files/mesh_2.ply");
    for (int i = 0; i < 9; i++) {
        const double expected = i % 3 == 0 ? 1 : i % 3 == 1 ? 0 : 128 / 255.0;
        assert_float_equal(mesh->of_vertices.values[i], expected, 1e-6);
    }
    rt_mesh_destroy(mesh);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        import_colours(wrong[i].colours, "", wrong[i].says);
        expect_not_in_file("a.rts", "attribute");
    }
}

/* Zeros stand for what an accessor leaves open, and for what is no number: both are told. */
static void colours_of_gltf_that_are_no_numbers_are_black(void **state)
{
    static const char *const colours[] = {
        "\"componentType\":5126,\"type\":\"VEC3\",\"count\":3",
        "\"bufferView\":2,\"componentType\":5126,\"type\":\"VEC3\",\"count\":3"};
    static const char *const says[] = {"accessors[1] has no bufferView: it holds zeros",
                                       "meshes[0]: what is no number in COLOR_0 became 0"};
    (void)state;
    for (int i = 0; i < 2; i++) {
        rt_mesh *mesh;
        import_colours(colours[i], "", says[i]);
        read_mesh(&mesh, "a_files/mesh_2.ply");
        for (int k = 0; k < 9; k++)
            assert_true(mesh->of_vertices.values[k] == 0);
        rt_mesh_destroy(mesh);
    }
}

/* They multiply the base colour, whatever that is of, on the meshes that have them alone. */
static void colours_of_gltf_multiply_the_base_colour(void **state)
{
    static const struct {
        const char *material, *of_colours, *without;
    } cases[] = {
        {"\"pbrMetallicRoughness\":{\"roughnessFactor\":0.5}", "ks 1 1 1  ks_texture color_0",
         "ks 1 1 1  roughness 0.25"},
        {"\"pbrMetallicRoughness\":{\"metallicFactor\":0}", "kd_texture     color_0", "kd   "},
        {"\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0},"
         "\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1}}",
         "kt 1 1 1  kt_texture color_0", "kt 1 1 1  fresnel"},
        {"\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,1,1,1]},"
         "\"extensions\":{\"KHR_materials_unlit\":{}}",
         "emission 0.5 1 1  emission_texture color_0", "emission 0.5 1 1 }"},
        {"\"pbrMetallicRoughness\":{\"roughnessFactor\":0.5,\"baseColorTexture\":{\"index\":0}}",
         "ks 1 1 1  ks_texture base_3", "ks 1 1 1  ks_texture base_7"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_coloured_gltf(cases[i].material);
        run run = run_rtc("import c.gltf --out c.rts");
        expect_status(&run, 0);
        expect_no_err(&run, "colours of vertices");
        run_free(&run);
        expect_in_file("c.rts", "{ pattern attribute  attribute \"color\" }");
        expect_in_file("c.rts", cases[i].of_colours);
        expect_in_file("c.rts", cases[i].without);
        expect_rtc(0, "check c.rts");
    }
    expect_in_file("c.rts", "{ pattern multiply  a_texture base_1  b_texture color_2 }");
}

/* A triangle of dark corners, whose colours and those of its face have these names. */
static void write_coloured_ply(const char *const names[3])
{
    char ply[512];
    snprintf(ply, sizeof ply,
             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
             "property float z\nproperty uchar %s\nproperty uchar %s\nproperty uchar %s\n"
             "element face 1\nproperty list uchar int vertex_indices\n"
             "property uchar %s\nproperty uchar %s\nproperty uchar %s\nend_header\n"
             "0 0 0 9 9 9\n1 0 0 9 9 9\n0 1 0 9 9 9\n3 0 1 2 9 9 9\n",
             names[0], names[1], names[2], names[0], names[1], names[2]);
    scratch_write("m.ply", ply);
}

/* The mesh of the scene m.rts that was made has its corners, and no colours. */
static void expect_no_colours(const char *line)
{
    rt_mesh *mesh;
    run run = run_rtc("%s", line);
    expect_status(&run, 0);
    run_free(&run);
    char *scene = scratch_read("m.rts"), *file = strstr(scene, "m_files/");
    assert_non_null(file);
    file[strcspn(file, "\"")] = '\0';
    read_mesh(&mesh, file);
    assert_null(mesh->colours);
    assert_int_equal(mesh->vertex_count, 3);
    rt_mesh_destroy(mesh);
    free(scene);
}

/* Mitsuba and pbrt show them only through a texture, which is told where it is left out. */
static void colours_that_other_programs_do_not_show_are_left_out(void **state)
{
    static const char *const names[][3] = {{"red", "green", "blue"},
                                           {"diffuse_red", "diffuse_green", "diffuse_blue"},
                                           {"r", "g", "b"}};
    (void)state;
    scratch_write("m.xml", "<scene><shape type=\"ply\"><string name=\"filename\" "
                           "value=\"m.ply\"/></shape></scene>");
    scratch_write("m.pbrt", "WorldBegin\nShape \"plymesh\" \"string filename\" \"m.ply\"\n");
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        write_coloured_ply(names[i]);
        expect_no_colours("import m.xml --out m.rts");
        expect_no_colours("import m.pbrt --out m.rts");
    }
    scratch_write("m.obj", "v 0 0 0 0 0 0\nv 1 0 0 128 -1 0\nv 0 1 0 0 0 0\nf 1 2 3\n");
    scratch_write("o.xml", "<scene><shape type=\"obj\"><string name=\"filename\" "
                           "value=\"m.obj\"/></shape></scene>");
    expect_no_colours("import o.xml --out m.rts");
}

/* ---- Materials ----------------------------------------------------------------- */

/* A material of a few lines, what it becomes, and a part of what is said; NULL: nothing. */
typedef struct material {
    const char *lines, *becomes, *says;
} material;

static const material materials[] = {
    {"map_Kd t.ppm\n", "{ kd 1 1 1 kd_texture a_1 }", NULL},
    {"map_Kd t.jpg\n", "{ kd 1 1 1 kd_texture a_1 }", NULL},
    {"map_Kd t.webp\n", "{ kd 1 1 1 }",
     "left out: none of the formats EXR, PNG, JPEG, Radiance HDR, BMP, QOI, "
     "PFM, PPM, PGM, TGA"},
    {"Kd 0.5\nmap_Kd t.ppm\n", "{ kd 0.5 0.5 0.5 kd_texture a_1 }", NULL},
    {"Kd 0 0 0\nmap_Kd t.ppm\n", "{ }", "m.mtl:3: material a: map_Kd is multiplied by Kd 0 0 0"},
    {"Kd 0.2\nKs 0 0 0\nmap_Ks t.ppm\n", "{ kd 0.2 0.2 0.2 }", "map_Ks is multiplied by Ks 0 0 0"},
    {"Kd 0.2\nmap_Ks t.ppm\n", "{ kd 0.2 0.2 0.2 }", "m.mtl:3: material a: map_Ks is left out"},
    {"map_Ke t.ppm\n", "{ emission 1 1 1 emission_texture a_1 }", NULL},
    {"Ke 0 0 0\nmap_Ke t.ppm\n", "{ }", "map_Ke is multiplied by Ke 0 0 0"},
    {"Kd 0.5\nTr 0.25\n", "{ kd 0.5 0.5 0.5 opacity 0.75 }", NULL},
    {"Kd 0.5\nTr 0.25\nd 0.75\n", "{ kd 0.5 0.5 0.5 opacity 0.75 }", NULL},
    {"Kd 0.5\nd 0.5\nTr 1\n", "{ kd 0.5 0.5 0.5 opacity 0.5 }",
     "m.mtl:4: material a: Tr 1 is left out beside d 0.5"},
    {"Kd 0.5\nTr 1\nd 1\n", "{ kd 0.5 0.5 0.5 }",
     "m.mtl:4: material a: Tr 1 is left out beside d 1"},
    {"Kd 0.5\nKs 0.5\nPr 0.5\n",
     "{ kd 0.5 0.5 0.5 coat 1 coat_roughness 0.25 coat_ior 1.5 coat_linear true }", NULL},
    {"Kd 0.5\nKs 0\nNs 100\nPr 0.5\nillum 3\n", "{ kd 0.5 0.5 0.5 }", NULL},
    {"Kd 0.5\nKs 0.3\nNs 100\nillum 3\n", "{ kd 0.5 0.5 0.5 ks 0.3 0.3 0.3 }", NULL},
    {"Kd 0\nKs 0.5\nNs 0\n", "{ ks 0.5 0.5 0.5 roughness 1 facet_scattering single }", NULL},
    {"Kd 0.5\nKs 0.3\nNs 0\nPm 0\n",
     "{ kd 0.5 0.5 0.5 ks 0.3 0.3 0.3 roughness 1 facet_scattering single }",
     "m.mtl:1: material a: its Ks of 0.3 reflects that part of all light, as a metal does"},
    {"Kd 0.8\nKs 0.5\nPm 1\nPr 0.1\nillum 3\n", "{ ks 0.8 0.8 0.8 roughness 0.01 fresnel schlick }",
     NULL},
    {"Kd 0.8\nPm 1\n", "{ ks 0.8 0.8 0.8 roughness 1 fresnel schlick }", NULL},
    {"Kd 0.8\nPm 1\nPr 0.1\nillum 7\n", "{ ks 0.8 0.8 0.8 roughness 0.01 fresnel schlick }",
     "illum 7, glass, is left out beside Pm"},
    {"Kd 0.8\nNi 1.5\nPr 0.1\nillum 7\n",
     "{ kt 1 1 1 roughness 0.01 fresnel dielectric ior 1.5 facet_scattering single }", NULL},
    {"Kd 0.8\nNi 1.5\nNs 10\nillum 7\n", "{ kt 1 1 1 fresnel dielectric ior 1.5 }", NULL},
    {"Kd 0.8\nmap_Kd t.ppm\nillum 7\n", "{ kt 1 1 1 fresnel dielectric }",
     "its maps are left out: illum 7 is glass"},
    {"Kd 0.5\nKs 0\nmap_Kd t.ppm\nPm 0.25\nPr 1\n", "{ blend plastic_2 with metal_3 weight 0.25 }",
     NULL},
    {"Kd 0.5\nKs 0\nmap_Pm t.ppm\nPr 1\n", "{ blend plastic_2 with metal_3 weight_texture a_1 }",
     NULL},
    {"Kd 0.5\nKs 0\nmap_Pm t.ppm\nKe 2\nd 0.5\n",
     "{ emission 2 2 2 opacity 0.5 blend plastic_2 with metal_3 weight_texture a_1 }", NULL},
    {"Kd 0.5\nKs 0.5\nPr 0.5\nmap_Pr -imfchan g t.ppm\n",
     "{ kd 0.5 0.5 0.5 coat 1 coat_roughness 1 coat_roughness_texture a_1 coat_ior 1.5 coat_linear "
     "true }",
     NULL},
    {"Kd 0.5\nKs 0.5\nPr 0.5\nmap_Ks t.ppm\n",
     "{ kd 0.5 0.5 0.5 coat 1 coat_roughness 0.25 coat_ior 1.5 coat_linear true }",
     "m.mtl:5: material a: map_Ks is left out: a plastic reflects alike all over"},
    {"Kd 0.25\nKs 0.5\nPr 0.5\nTf 1\n", "{ roughness 0.5 base_color 0.25 0.25 0.25 spec_trans 1 }",
     NULL},
    {"Kd 0.25\nKs 0\nPr 0\nTf 0.5\n", "{ blend plastic_0 with glass_1 weight 0.5 }", NULL},
    {"Kd 0.5\nKs 0\nPr 1\nPs 0.5\n", "{ kd 0.5 0.5 0.5 fuzz 0.5 0.5 0.5 fuzz_roughness 0.5 }",
     NULL},
    {"Kd 0.5\nPr 0.9\nPs 0.5\n", "{ kd 0.5 0.5 0.5 fuzz 0.5 0.5 0.5 fuzz_roughness 0.5 }",
     "what is below its Ps reflects diffusely alone"},
    {"Kd 0.5\nPr 0.5\nPs 0.5\n",
     "{ kd 0.5 0.5 0.5 coat 1 coat_roughness 0.25 coat_ior 1.5 coat_linear true }",
     "its Ps is left out over what reflects by facets"},
    {"Kd 0.5\nPm 1\nPr 0.5\naniso 1\nanisor 0.25\n",
     "{ ks 0.5 0.5 0.5 roughness 0.7905694 roughness_v 0.07905694 fresnel schlick "
     "anisotropy_rotation 90 }",
     NULL},
    {"Kd 0.5\nPm 1\nPr 0.5\nPc 2\nPcr 0.5\n",
     "{ ks 0.5 0.5 0.5 roughness 0.20833333 coat 0.5 coat_roughness 0.25 fresnel schlick coat_ior "
     "1.5 coat_linear true }",
     "a metal is less rough below its clearcoat, which bends light here"},
    {"Kd 1\nnorm n.ppm\n", "{ kd 1 1 1 normal_texture a_1 }", NULL},
    {"Kd 1\nnorm t.ppm\n", "{ kd 1 1 1 normal_texture a_1 }",
     "m.mtl:3: material a: the image of 'norm' holds no unit vectors"},
    {"Kd 1\nnorm -bm 0 n.ppm\n", "{ kd 1 1 1 }", NULL},
    {"Kd 1\nnorm -imfchan r n.ppm\n", "{ kd 1 1 1 normal_texture a_1 }",
     "the option -imfchan of a map is left out"},
    {"Kd 1\nKs 0\nPm 0.5\nPr 1\nnorm -bm 0 n.ppm\n", "{ blend plastic_2 with metal_3 weight 0.5 }",
     NULL},
    {"Kd 1\nPr 0\nTf 1\nmap_d t.ppm\n", "{ kt 1 1 1 fresnel dielectric }",
     "material a: the d of glass is left out"},
    {"Kd 1\nmap_Pr\n", "{ kd 1 1 1 }", "m.mtl:3: material a: 'map_Pr' names no file"},
    {"Kd 1\nPr abc\nTf xyz 1 1 1\nNs\n", "{ kd 1 1 1 }",
     "m.mtl:3: material a: a line with 'abc', which is no number, is left out"},
    {"Kd 1\nPr 0\nTf 1\nPc 1\nd 0.5\n", "{ kt 1 1 1 fresnel dielectric }",
     "material a: Pc and Ps over glass are left out"},
    {"Kd 1\nmap_Bump -bm 0.5 n.ppm\n", "{ kd 1 1 1 normal_texture a_1 normal_scale 0.5 }", NULL},
    {"Kd 1\nbump t.ppm\n", "{ kd 1 1 1 }",
     "m.mtl:3: material a: 'bump' is left out: its heights have no unit"},
    {"Kd 0.8\nNi 1.5\nd 0.5\nillum 7\n", "{ kt 1 1 1 fresnel dielectric ior 1.5 }",
     "its d is left out: illum 7 is glass"},
    {"Kd 0.8\nPm 1\nPr 0.5\nd 0.5\nillum 7\n",
     "{ ks 0.8 0.8 0.8 roughness 0.25 fresnel schlick opacity 0.5 }",
     "illum 7, glass, is left out beside Pm"},
    {"Kd 1\nd 0.5\nillum 5\n", "{ kd 1 1 1 opacity 0.5 }", NULL},
    {"Kd 1\nmap_d t.ppm\n", "{ kd 1 1 1 opacity_texture a_1 }", NULL},
    {"Kd 1\nNi 1.5\nmap_d t.ppm\nillum 7\n", "{ kt 1 1 1 fresnel dielectric ior 1.5 }",
     "its d is left out: illum 7 is glass"},
    {"Kd 1\nPc 0\nPcr 0.03\nPs 0.000000\naniso 0.0\nanisor 0\nKa 0 0 0\n", "{ kd 1 1 1 }", NULL},
    {"Kd 1\nPc 2\n",
     "{ kd 0.96 0.96 0.96 ks 0.04 0.04 0.04 roughness 1 coat 0.5 coat_ior 1.5 coat_linear true }",
     "a plastic below a clearcoat reflects 0.04 at every angle"},
    {"Kd 0.5\nKa 0 0 0\nTf 1 1 1\nNi 1.00\nillum 4\n", "{ kd 0.5 0.5 0.5 }",
     "m.mtl:1: material a: illum 4 of Ni 1, as Maya writes what is opaque, is no glass"},
    {"Kd 0.5\nTf 0.5 1 1\nNi 1.00\nillum 4\n", "{ kt 0.5 1 1 fresnel dielectric ior 1 }", NULL},
    {"Ns 10\n", "{ kd 0.7 0.7 0.7 }",
     "m.mtl:1: material a: it gives no colour: grey of 0.7 stands in its place"},
    {"Kd red\n", "{ kd 0.7 0.7 0.7 }",
     "m.mtl:2: material a: a line with 'red', which is no number, is left out"},
    {"Kd 1\nrefl t.ppm\n", "{ kd 1 1 1 }", "m.mtl:3: material a: 'refl' is left out"},
};

/*
 * Blender's own files have the principled material in Phong's fields: at Ns 250 the roughness is
 * 0.5, at a level of 0.5 a plastic of index 1.5 reflects 4 %, and illum 9 is an opacity.
 */
#define BARE "m.mtl: Blender wrote it without PBR Extensions: glass, coats and sheen are not in it"
static const material blender_materials[] = {
    {"Ka 1 1 1\nKd 0.5\nKs 0.5\nNi 1.5\nd 1\nillum 3\nmap_Ns t.ppm\n",
     "{ ks 0.5 0.5 0.5 roughness 1 roughness_texture a_1 fresnel schlick }", BARE},
    {"Ns 250\nKa 1 1 1\nKd 0.5\nKs 0.5\nNi 1.5\nd 1\nillum 2\n",
     "{ kd 0.5 0.5 0.5 coat 1 coat_roughness 0.25 coat_ior 1.5 coat_linear true }", BARE},
    {"Ns 250\nKa 1 1 1\nKd 0.5\nKs 0.5\nNi 1.5\nd 1\nillum 3\n",
     "{ ks 0.5 0.5 0.5 roughness 0.25 fresnel schlick }", BARE},
    {"Ns 250\nKa 0.25\nKd 0.5\nKs 0\nNi 1.5\nd 1\nillum 3\n",
     "{ blend plastic_0 with metal_1 weight 0.25 }", BARE},
    {"Ns 0\nKa 1 1 1\nKd 0.5\nKs 0\nNi 1.5\nd 0.5\nillum 9\n", "{ kd 0.5 0.5 0.5 opacity 0.5 }",
     BARE},
    {"Ns 250\nKa 1 1 1\nKd 0\nKs 0\nKe 2 2 2\nNi 1.5\nd 1\nillum 2\n",
     "{ emission 2 2 2 two_sided true }", BARE},
    {"Kd 0.5\nKs 0\nNi 1.5\nPr 0.5\n", "{ kd 0.5 0.5 0.5 }", NULL},
    {"Ka 1 1 1\nKd 0.5\nKs 0.5\nNi 1.5\nd 1\nillum 2\nmap_Ns t.ppm\n",
     "{ kd 0.5 0.5 0.5 coat 1 coat_roughness 1 coat_roughness_texture a_1 coat_ior 1.5 coat_linear "
     "true }",
     BARE},
};

/* A file of this head and one material, and what its import says and becomes. */
static void expect_read(const char *head, const material *material)
{
    char mtl[256];
    snprintf(mtl, sizeof mtl, "%snewmtl a\n%s", head, material->lines);
    scratch_write("m.mtl", mtl);
    run run = run_rtc("import m.obj --out m.rts");
    expect_status(&run, 0);
    if (material->says)
        expect_err(&run, material->says);
    else
        expect_no_err(&run, "m.mtl");
    run_free(&run);
    expect_material(0, material->becomes);
}

/* Blender writes 0.8 as Kd where the colour is that of the vertices. */
static void its_default_gives_way_to_colours_of_vertices(void **state)
{
    static const char maker[] = "# Blender 4.5.15 LTS MTL File: 'a.blend'\n";
    static const struct {
        const char *maker, *kd, *colour;
        int is_white;
    } cases[] = {{maker, "0.8 0.8 0.8", "0.5 0.25 0.1", 1},
                 {maker, "0.8 0.8 0.8", "1 1 1", 0},
                 {maker, "0.8 0.8 0.7", "0.5 0.25 0.1", 0},
                 {"", "0.8 0.8 0.8", "0.5 0.25 0.1", 0}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[400];
        const char *const colour = cases[i].colour;
        snprintf(text, sizeof text,
                 "mtllib c.mtl\nv 0 0 0 %s\nv 1 0 0 %s\nv 0 1 0 %s\nv 0 0 1 0 1 0\nv 1 0 1 0 1 0\n"
                 "v 0 1 1 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 4 5 6\n",
                 colour, colour, colour);
        scratch_write("c.obj", text);
        snprintf(text, sizeof text, "%snewmtl a\nKd %s\nnewmtl b\nKd 0.3 0.3 0.3\n", cases[i].maker,
                 cases[i].kd);
        scratch_write("c.mtl", text);
        expect_rtc(0, "import c.obj --out c.rts");
        if (cases[i].is_white)
            expect_in_file("c.rts", "kd 1 1 1");
        else
            expect_not_in_file("c.rts", "kd 1 1 1");
    }
}

static void materials_are_those_of_the_file(void **state)
{
    (void)state;
    scratch_write("m.obj", "mtllib m.mtl\n" CORNERS "vt 0 0\nusemtl a\nf 1/1 2/1 3/1\n");
    scratch_write("t.ppm", "P3\n1 1\n255\n255 255 255\n");
    scratch_write("n.ppm", "P3\n1 1\n255\n128 128 255\n");
    rt_bytes jpeg = jpeg_sample_file(&(jpeg_sample){.width = 8, .height = 8});
    scratch_write_bytes("t.jpg", jpeg.data, jpeg.size);
    rt_bytes_free(&jpeg);
    scratch_write("t.webp", "RIFF\x10");
    for (size_t i = 0; i < sizeof materials / sizeof *materials; i++)
        expect_read("", &materials[i]);
    for (size_t i = 0; i < sizeof blender_materials / sizeof *blender_materials; i++)
        expect_read("# Blender 4.5.15 LTS MTL File: 'scene.blend'\n", &blender_materials[i]);
}

#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, scratch_enter, scratch_leave)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_SCRATCH(names_of_materials_go_to_the_end_of_the_line),
        IN_SCRATCH(comments_behind_names_are_none_of_a_name),
        IN_SCRATCH(libraries_are_one_name_or_several),
        IN_SCRATCH(missing_libraries_and_materials_are_named_whole),
        IN_SCRATCH(faces_on_a_line_are_told_by_their_line),
        IN_SCRATCH(lines_end_by_cr_or_lf),
        IN_SCRATCH(colours_of_vertices_are_kept),
        IN_SCRATCH(colours_to_255_are_told),
        IN_SCRATCH(smoothing_gives_normals),
        IN_SCRATCH(what_is_no_normal_is_told),
        IN_SCRATCH(images_lie_beside_their_library),
        IN_SCRATCH(colours_of_gltf_are_clamped),
        IN_SCRATCH(colours_of_gltf_are_of_its_types),
        IN_SCRATCH(colours_of_gltf_that_are_no_numbers_are_black),
        IN_SCRATCH(colours_of_gltf_multiply_the_base_colour),
        IN_SCRATCH(colours_that_other_programs_do_not_show_are_left_out),
        IN_SCRATCH(its_default_gives_way_to_colours_of_vertices),
        IN_SCRATCH(materials_are_those_of_the_file),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
