/*
 * test_import_mitsuba.c - what scenes of Mitsuba name: folders, parameters, other ids, curves,
 * media and meshes in its compressed files.
 */
#include <math.h>
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
#include "mesh/load.h"
#include "spawn.h"
#include "tools/serialized_sample.h"

static void write_bytes(const char *name, const rt_bytes *bytes)
{
    rt_error error;
    assert_int_equal(rt_file_write(name, bytes->data, bytes->size, &error), RT_OK);
}

/* ---- Names ------------------------------------------------------------------- */

/*
 * <path> is relative to its own file, or else as files are; the folder that was named last comes
 * first.
 */
static void files_are_searched_in_folders(void **state)
{
    (void)state;
    mkdir("common", 0777);
    mkdir("later", 0777);
    mkdir("parts", 0777);
    scratch_write("common/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    scratch_write("common/b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    scratch_write("later/b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 4 3 2\n");
    scratch_write("parts/part.xml", "<scene><path value=\"../later\"/></scene>\n");
    scratch_write("searched.xml", "<scene><path value=\"common\"/>\n"
                                  "<include filename=\"parts/part.xml\"/>\n"
                                  "<path value=\"nowhere\"/>\n"
                                  "<shape type=\"obj\"><string name=\"filename\" value=\"a.obj\"/>"
                                  "</shape>\n<shape type=\"obj\"><string name=\"filename\" "
                                  "value=\"b.obj\"/></shape></scene>\n");
    run run = run_rtc("import searched.xml --out searched.rts");
    expect_status(&run, 0);
    expect_out(&run, "2 shapes, 3 triangles");
    expect_err(&run, "searched.xml:3: there is no folder 'nowhere'");
    run_free(&run);
}

/* Parameters stand anywhere in a value; one without a value leaves what it is of to its default. */
static void parameters_are_put_in_place(void **state)
{
    (void)state;
    scratch_write("named.xml",
                  "<scene><default name=\"r\" value=\"0.25\"/>\n"
                  "<default name=\"radius\" value=\"3\"/>\n"
                  "<default name=\"again\" value=\"$radius\"/>\n"
                  "<shape type=\"sphere\"><float name=\"radius\" value=\"$again\"/>\n"
                  "<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"$r, 0.5 $r\"/></bsdf>\n"
                  "</shape>\n<sensor type=\"perspective\"><sampler type=\"independent\">\n"
                  "<integer name=\"sample_count\" value=\"$spp\"/></sampler></sensor></scene>\n");
    run run = run_rtc("import named.xml --out named.rts");
    expect_status(&run, 0);
    expect_err(&run, "named.xml:8: '$spp' has no <default>: 'sample_count' counts as not given");
    run_free(&run);
    expect_in_file("named.rts", "radius 3");
    expect_in_file("named.rts", "kd 0.25 0.5 0.25");
    expect_in_file("named.rts", "spp 16");
}

static void an_alias_is_another_id(void **state)
{
    (void)state;
    scratch_write(
        "alias.xml",
        "<scene><bsdf type=\"diffuse\" id=\"a\"><rgb name=\"reflectance\" value=\"0.125\"/>"
        "</bsdf>\n<alias id=\"a\" as=\"b\"/><alias id=\"b\" as=\"c\"/>\n"
        "<shape type=\"sphere\"><ref id=\"c\"/></shape></scene>\n");
    run run = run_rtc("import alias.xml --out alias.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "left out");
    run_free(&run);
    expect_in_file("alias.rts", "kd 0.125 0.125 0.125");
    scratch_write("alias.xml", "<scene>\n<alias id=\"a\" as=\"b\"/></scene>\n");
    run = run_rtc("import alias.xml --out alias.rts");
    expect_status(&run, 1);
    expect_err(&run, "alias.xml:2: there is no element with the id 'a' so far");
    run_free(&run);
}

/* An emitter with an id is that of the shapes that name it, and shines nowhere else. */
static void emitters_are_named(void **state)
{
    (void)state;
    scratch_write("lamp.xml",
                  "<scene><emitter type=\"area\" id=\"lamp\"><rgb name=\"radiance\" value=\"7\"/>"
                  "</emitter><shape type=\"sphere\"><ref id=\"lamp\"/></shape>\n"
                  "<integrator type=\"direct\"/></scene>\n");
    run run = run_rtc("import lamp.xml --out lamp.rts");
    expect_status(&run, 0);
    expect_out(&run, "1 light");
    expect_no_err(&run, "left out");
    run_free(&run);
    expect_in_file("lamp.rts", "radiance 7 7 7");
    expect_in_file("lamp.rts", "max_depth 2");
}

/* How many materials are as they are, and which are near. */
static void materials_are_counted(void **state)
{
    (void)state;
    scratch_write("count.xml", "<scene><bsdf type=\"diffuse\" id=\"a\"/><bsdf type=\"measured\" "
                               "id=\"b\"/><bsdf type=\"hair\" id=\"c\"/>\n"
                               "<shape type=\"sphere\"><ref id=\"a\"/></shape>"
                               "<shape type=\"sphere\"><ref id=\"b\"/></shape>"
                               "<shape type=\"cube\"><ref id=\"c\"/></shape></scene>\n");
    run run = run_rtc("import count.xml --out count.rts");
    expect_err(&run, "count.xml: 1 of 3 materials exact, 2 approximated: b, c");
    run_free(&run);
    scratch_write("typo.xml", "<scene><bsdf type=\"twosided\" id=\"t\"><bsdf type=\"conductor\">\n"
                              "<float name=\"alfa\" value=\"1\"/><float name=\"beta\" value=\"1\"/>"
                              "</bsdf></bsdf><bsdf type=\"diffuse\" id=\"d\"/>\n"
                              "<shape type=\"sphere\"><ref id=\"t\"/></shape>"
                              "<shape type=\"cube\"><ref id=\"d\"/></shape></scene>\n");
    run = run_rtc("import typo.xml --out typo.rts");
    expect_err(&run, "typo.xml: 1 of 2 materials exact, 1 approximated: t");
    run_free(&run);
    scratch_write("count.obj", "mtllib count.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n");
    scratch_write("count.mtl", "newmtl m\nKd 0.5 0.5 0.5\nPr 2\nnewmtl n\nKd 0.1 0.1 0.1\n");
    run = run_rtc("import count.obj --out count.rts");
    expect_err(&run, "count.obj: 1 of 2 materials exact, 1 approximated: m");
    run_free(&run);
    scratch_write("plain.xml", "<scene><shape type=\"sphere\"/></scene>\n");
    run = run_rtc("import plain.xml --out count.rts");
    expect_no_err(&run, "materials exact");
    run_free(&run);
}

static void merged_shapes_are_placed(void **state)
{
    (void)state;
    scratch_write("merge.xml", "<scene><bsdf type=\"retarder\" id=\"r\"/>\n<shape type=\"merge\">"
                               "<shape type=\"sphere\"><ref id=\"r\"/></shape>"
                               "<shape type=\"cube\"/></shape></scene>\n");
    run run = run_rtc("import merge.xml --out merge.rts");
    expect_status(&run, 0);
    expect_out(&run, "2 shapes");
    expect_err(&run, "merge.xml:1: polarization is left out: a retarder lets all of the light");
    run_free(&run);
    expect_in_file("merge.rts", "kt 1 1 1  ior 1");
}

/* The base of a pplastic is darker by the reflectance of index 1.5 from outside, 0.0918. */
static void pplastics_lose_what_is_reflected_inside(void **state)
{
    (void)state;
    scratch_write(
        "pp.xml",
        "<scene><shape type=\"sphere\"><bsdf type=\"pplastic\"><rgb "
        "name=\"diffuse_reflectance\" value=\"0.5\"/><float name=\"int_ior\" "
        "value=\"1.5\"/><float name=\"ext_ior\" value=\"1\"/><float name=\"alpha\" "
        "value=\"0.2\"/></bsdf></shape>\n<shape type=\"sphere\"><bsdf "
        "type=\"polarizer\"><rgb name=\"transmittance\" value=\"0.5 1 0\"/></bsdf></shape>"
        "</scene>\n");
    run run = run_rtc("import pp.xml --out pp.rts");
    expect_status(&run, 0);
    expect_err(&run, "pp.xml:2: polarization is left out");
    run_free(&run);
    expect_in_file("pp.rts", "0.4541");
    expect_in_file("pp.rts", "coat_linear");
    expect_in_file("pp.rts", "kt 0.25 0.5 0  ior 1");
    expect_in_file("pp.rts", "max_depth 1024");
}

/* Colours of a mesh are those of a texture, of vertices or of faces, and do not multiply kd. */
static void colours_of_meshes_are_shown(void **state)
{
    static const char *const attributes[] = {"vertex_color", "face_tint_color", "face_color",
                                             "vertex_weight"},
                             *const own[] = {"\"color\"", "\"tint\"", NULL, NULL};
    (void)state;
    scratch_write("c.ply",
                  "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                  "property float y\nproperty float z\nproperty float r\n"
                  "property float g\nproperty float b\nelement face 1\n"
                  "property list uchar int vertex_indices\nproperty float tint_r\n"
                  "property float tint_g\nproperty float tint_b\nproperty float red\n"
                  "property float green\nproperty float blue\nend_header\n"
                  "0 0 0 1 0 0\n1 0 0 0 1 0\n0 1 0 0.25 0.5 0.75\n3 0 1 2 0.5 0.25 0.125 1 1 1\n");
    for (int i = 0; i < 4; i++) {
        const float colours[9] = {1, 0, 0, 0, 1, 0, 0.25f, 0.5f, 0.75f};
        char text[512];
        rt_mesh *mesh;
        rt_error error;
        snprintf(text, sizeof text,
                 "<scene><shape type=\"ply\"><string name=\"filename\" value=\"c.ply\"/><bsdf "
                 "type=\"twosided\"><bsdf type=\"diffuse\">\n<texture type=\"mesh_attribute\" "
                 "name=\"reflectance\"><string name=\"name\" value=\"%s\"/></texture></bsdf>"
                 "</bsdf></shape></scene>\n",
                 attributes[i]);
        scratch_write("colours.xml", text);
        run run = run_rtc("import colours.xml --out colours.rts");
        expect_status(&run, 0);
        if (!own[i]) {
            snprintf(text, sizeof text, "colours.xml:2: a texture by '%s' of a mesh is left out",
                     attributes[i]);
            expect_err(&run, text);
        }
        run_free(&run);
        if (own[i])
            expect_in_file("colours.rts", own[i]);
        expect_in_file("colours.rts", own[i] ? "kd 1 1 1" : "kd 0.5 0.5 0.5");
        snprintf(text, sizeof text, "colours_files/mesh_%d.ply", own[i] ? 2 : 1);
        assert_int_equal(rt_mesh_load(&mesh, text, NULL, &error), RT_OK);
        assert_null(mesh->colours);
        assert_string_equal(mesh->of_vertices.list[0].name, "color");
        assert_memory_equal(mesh->of_vertices.values, colours, sizeof colours);
        assert_string_equal(mesh->of_triangles.list[0].name, "tint");
        assert_int_equal(mesh->of_triangles.count, 2);
        rt_mesh_destroy(mesh);
    }
}

/* Four bytes in either order. */
static void put_word(FILE *file, const void *word, int is_big)
{
    uint32_t bits;
    memcpy(&bits, word, sizeof bits);
    for (int i = 0; i < 4; i++)
        fputc((int)(bits >> 8 * (is_big ? 3 - i : i) & 0xff), file);
}

/* A PLY file of one triangle: 0 as text, 1 little-endian, 2 big-endian. */
static void write_weights(int format)
{
    static const char *const formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    static const float rows[3][4] = {{0, 0, 0, 0.25f}, {1, 0, 0, -1}, {0, 1, 0, 2}};
    static const uint32_t corners[3] = {0, 1, 2};
    const float weight = 0.5f;
    FILE *file = fopen("w.ply", "wb");
    assert_non_null(file);
    fprintf(file,
            "ply\nformat %s 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
            "property float z\nproperty float weight_0\nelement face 1\n"
            "property list uchar int vertex_indices\nproperty char color_r\n"
            "property float weight_0\nend_header\n",
            formats[format]);
    for (int i = 0; i < 12; i++)
        if (format)
            put_word(file, &rows[i / 4][i % 4], format == 2);
        else
            fprintf(file, "%g%c", rows[i / 4][i % 4], i % 4 == 3 ? '\n' : ' ');
    if (format) {
        fputc(3, file);
        for (int i = 0; i < 3; i++)
            put_word(file, &corners[i], format == 2);
        fputc(-2, file);
        put_word(file, &weight, format == 2);
    } else {
        fprintf(file, "3 0 1 2 -2 0.5\n");
    }
    assert_int_equal(fclose(file), 0);
}

/* A shape of that file, with two colours by a weight. */
#define WEIGHED(weight, colour)                                                                    \
    "<shape type=\"ply\">\n<string name=\"filename\" value=\"w.ply\"/><bsdf type=\"blendbsdf\">"   \
    "<texture type=\"mesh_attribute\" name=\"weight\"><string name=\"name\" value=\"" weight       \
    "\"/></texture><bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"" colour               \
    "\"/></bsdf><bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"1 0 0\"/></bsdf></bsdf>"  \
    "</shape>"

/* Expects these colours of a mesh that was imported, or NULL: none. */
static void expect_colours(const char *name, const float *colours)
{
    rt_mesh *mesh;
    rt_error error;
    assert_int_equal(rt_mesh_load(&mesh, name, NULL, &error), RT_OK);
    assert_true((mesh->colours != NULL) == (colours != NULL));
    if (colours)
        assert_memory_equal(mesh->colours, colours, 9 * sizeof *colours);
    rt_mesh_destroy(mesh);
}

/* Two colours blended by a weight of the vertices or faces of a mesh are colours of these. */
static void weights_of_meshes_blend_colours(void **state)
{
    static const float vertices[9] = {0.25f, 0.375f, 0.75f, 0, 0.5f, 1, 1, 0, 0},
                       faces[9] = {0.5f, 0.25f, 0.5f, 0.5f, 0.25f, 0.5f, 0.5f, 0.25f, 0.5f},
                       others[9] = {0.5f, 0, 0, 0.5f, 0, 0, 0.5f, 0, 0};
    (void)state;
    scratch_write("weights.xml",
                  "<scene>" WEIGHED("vertex_weight", "0 0.5 1") WEIGHED("face_weight", "0 0.5 1")
                      WEIGHED("face_weight", "0 0 0") WEIGHED("face_other", "0 0 0") "</scene>\n");
    for (int format = 0; format < 3; format++) {
        write_weights(format);
        run run = run_rtc("import weights.xml --out weights.rts");
        expect_status(&run, 0);
        expect_err(&run, "weights.xml:4: a mesh without the weight 'other' is white");
        run_free(&run);
        expect_in_file("weights.rts", "kd 1 1 1  back black");
        expect_colours("weights_files/mesh_1.ply", vertices);
        expect_colours("weights_files/mesh_4.ply", faces);
        expect_colours("weights_files/mesh_7.ply", others);
        expect_colours("weights_files/mesh_10.ply", NULL);
    }
}

/* What a damaged file of weights lacks is told as that of any other. */
static void damaged_weights_are_told(void **state)
{
    (void)state;
    scratch_write("weights.xml", "<scene>" WEIGHED("face_weight", "0 0.5 1") "</scene>\n");
    write_weights(1);
    FILE *file = fopen("w.ply", "rb");
    char bytes[1024];
    assert_non_null(file);
    const size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    for (size_t length = 4; length < size; length += length < 200 ? 20 : 3) {
        file = fopen("w.ply", "wb");
        assert_non_null(file);
        assert_int_equal(fwrite(bytes, 1, length, file), length);
        fclose(file);
        expect_rtc(1, "import weights.xml --out weights.rts");
    }
}

/* ---- Curves ------------------------------------------------------------------ */

static void write_curve(const char *type, const char *points)
{
    char text[512];
    scratch_write("c.txt", points);
    snprintf(text, sizeof text,
             "<scene><shape type=\"%s\">\n<string name=\"filename\" value=\"c.txt\"/>"
             "<transform name=\"to_world\"><scale x=\"2\"/></transform></shape></scene>\n",
             type);
    scratch_write("c.xml", text);
}

/* Whether a vertex lies on the sphere of this radius about x on the first axis, facing outward. */
static int is_around(const float *p, const float *normal, float x, float radius)
{
    const float away[3] = {p[0] - x, p[1], p[2]};
    int is_good =
        fabsf(sqrtf(away[0] * away[0] + p[1] * p[1] + p[2] * p[2]) - radius) < 1e-5f * radius;
    for (int c = 0; c < 3; c++)
        is_good &= fabsf(normal[c] - away[c] / radius) < 1e-5f;
    return is_good;
}

/* Expects vertices around a segment of the first axis, or around its ends. */
static void expect_tube(float start, float end, float radius, uint32_t triangles)
{
    rt_mesh *mesh;
    rt_error error;
    expect_rtc(0, "import c.xml --out c.rts");
    assert_int_equal(rt_mesh_load(&mesh, "c_files/mesh_1.ply", NULL, &error), RT_OK);
    assert_int_equal(mesh->triangle_count, triangles);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const float *p = mesh->positions + 3 * i, *n = mesh->normals + 3 * i;
        assert_true(is_around(p, n, fminf(fmaxf(p[0], start), end), radius) ||
                    is_around(p, n, start, radius) || is_around(p, n, end, radius));
    }
    rt_mesh_destroy(mesh);
}

/* A straight curve is a capsule; a spline of points in even steps a tube between the inner two. */
static void curves_become_tubes(void **state)
{
    (void)state;
    write_curve("linearcurve", "0 0 0 0.5\n2 0 0 0.5\n");
    expect_tube(0, 4, 0.5f, 2 * 2 * 12 * 24 + 2 * 24);
    write_curve("bsplinecurve", "\n0 0 0 0.25\n1 0 0 0.25\n2, 0, 0, 0.25\r\n3 0 0 0.25\n\n\n");
    expect_tube(2, 4, 0.25f, 2 * 12 * 24);
}

static void wrong_curves_are_told(void **state)
{
    static const struct {
        const char *points, *says;
    } cases[] = {
        {"0 0 0 1\n1 0 0 1\n2 0 0 1\n", "c.xml:1: 'c.txt': curve 1 has fewer than 4"},
        {"0 0 0 1\n1 0 0 1\n2 0 0 1\n3 0 0 1\n\n0 0 0 1\n", "curve 2 has fewer than 4"},
        {"0 0 0 1\n1 0 0\n", "'c.txt': line 2 is no position and radius"},
        {"0 0 0 -1\n", "'c.txt': line 1 is no position and radius"},
        {"0 0 0 1e99\n", "'c.txt': line 1 is no position and radius"},
        {"\n\n", "'c.txt' has no curve"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_curve("bsplinecurve", cases[i].points);
        run run = run_rtc("import c.xml --out c.rts");
        expect_status(&run, 1);
        expect_err(&run, cases[i].says);
        run_free(&run);
    }
}

/* ---- Media ------------------------------------------------------------------- */

/* Coefficients in both ways of saying them, around nothing and in glass; phase functions. */
static void media_fill_their_shapes(void **state)
{
    (void)state;
    scratch_write(
        "media.xml",
        "<scene><medium type=\"homogeneous\" id=\"a\"><float name=\"scale\" value=\"2\"/>"
        "<float name=\"sigma_t\" value=\"10\"/><rgb name=\"albedo\" value=\"0.25 0.5 1\"/>"
        "<phase type=\"hg\"><float name=\"g\" value=\"0.5\"/></phase></medium>\n"
        "<medium type=\"homogeneous\" id=\"b\"><rgb name=\"sigma_s\" value=\"3\"/>"
        "<rgb name=\"sigma_a\" value=\"4 5 6\"/></medium>\n"
        "<shape type=\"sphere\"><bsdf type=\"null\"/><ref name=\"interior\" id=\"a\"/>"
        "</shape><shape type=\"sphere\"><bsdf type=\"dielectric\"/>"
        "<ref name=\"interior\" id=\"b\"/></shape>\n"
        "<shape type=\"sphere\"><ref name=\"interior\" id=\"b\"/></shape>\n"
        "<shape type=\"sphere\"><bsdf type=\"null\"/><ref name=\"exterior\" id=\"b\"/>"
        "</shape></scene>\n");
    run run = run_rtc("import media.xml --out media.rts");
    expect_status(&run, 0);
    expect_err(&run, "media.xml:5: a medium outside of a shape is left out");
    run_free(&run);
    expect_in_file("media.rts",
                   "{ interface true  absorption 15 10 0  scattering 5 10 20  g 0.5 }");
    expect_in_file("media.rts", "absorption   4 5 6\n    scattering   3 3 3");
    expect_in_file("media.rts", "{ kd 0.5 0.5 0.5  back black }");
}

/* In thin glass, too, whose faces some integrators do not count; not where it has holes. */
static void media_fill_thin_glass(void **state)
{
    static const char *const integrators[] = {"volpath", "path", "volpathmis", "volpath"};
    static const int depths[] = {9, 9, 9, 64};
    (void)state;
    for (int i = 0; i < 4; i++) {
        char text[2048];
        snprintf(
            text, sizeof text,
            "<scene><integrator type=\"%s\"><integer name=\"max_depth\" value=\"%d\"/>"
            "</integrator>\n<medium type=\"homogeneous\" id=\"b\">"
            "<rgb name=\"sigma_s\" value=\"3\"/><rgb name=\"sigma_a\" value=\"4 5 6\"/>"
            "</medium>\n<shape type=\"sphere\"><bsdf type=\"thindielectric\"/>"
            "<ref name=\"interior\" id=\"b\"/></shape>\n"
            "<shape type=\"sphere\"><bsdf type=\"mask\"><float name=\"opacity\" "
            "value=\"1.5\"/><bsdf type=\"mask\"><float name=\"opacity\" value=\"0.5\"/>"
            "<bsdf type=\"thindielectric\"/></bsdf></bsdf>"
            "<ref name=\"interior\" id=\"b\"/></shape>\n"
            "<shape type=\"sphere\"><bsdf type=\"blendbsdf\"><float name=\"weight\" "
            "value=\"0.5\"/><bsdf type=\"thindielectric\"/><bsdf type=\"thindielectric\"/></bsdf>"
            "<medium type=\"homogeneous\" name=\"interior\"><float name=\"sigma_t\" "
            "value=\"1\"/></medium></shape></scene>",
            integrators[i], depths[i]);
        scratch_write("thin.xml", text);
        run run = run_rtc("import thin.xml --out thin.rts");
        expect_status(&run, 0);
        expect_err(&run, "thin.xml:2: the medium inside of a thin sheet is left out, as the sheet "
                         "is not clear all over");
        expect_err(&run, "thin.xml:4: an opacity of 1.5 is taken as 1");
        expect_err(&run, "thin.xml:5: the medium inside of a blend of materials is left out");
        expect_no_err(&run, "sigma_t");
        if (i == 3)
            expect_no_err(&run, "max_depth");
        else
            expect_err(&run, i == 1
                                 ? "max_depth 9 does not count light that goes on through this mask"
                                 : "max_depth 9 counts light that goes through this thin sheet");
        run_free(&run);
        expect_in_file("thin.rts",
                       "thin         true\n    absorption   4 5 6\n    scattering   3 3 3");
    }
}

static void write_grid(uint32_t channels, const float *values, uint32_t count)
{
    const uint32_t head[] = {0x034c4f56, 1, count / channels, 1, 1, channels};
    const float box[6] = {0, 0, 0, 2, 1, 1};
    rt_bytes file = {0};
    assert_int_equal(rt_bytes_put(&file, 0, head, sizeof head, NULL), RT_OK);
    assert_int_equal(rt_bytes_put(&file, 24, box, sizeof box, NULL), RT_OK);
    assert_int_equal(rt_bytes_put(&file, 48, values, 4 * count, NULL), RT_OK);
    write_bytes("d.vol", &file);
    rt_bytes_free(&file);
}

/* A grid multiplies the coefficients, also one of three channels; of other numbers the mean. */
static void grids_are_densities(void **state)
{
    static const float values[] = {0.5f, 2, 1, 4, 1, 1};
    static const char text[] =
        "<scene><shape type=\"cube\"><bsdf type=\"null\"/>\n<medium type=\"heterogeneous\" "
        "name=\"interior\"><float name=\"scale\" value=\"2\"/>\n<volume name=\"sigma_t\" "
        "type=\"gridvolume\"><string name=\"filename\" value=\"d.vol\"/><boolean "
        "name=\"use_grid_bbox\" value=\"true\"/></volume></medium></shape></scene>\n";
    (void)state;
    scratch_write("grid.xml", text);
    write_grid(1, values, 2);
    run run = run_rtc("import grid.xml --out grid.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "channels");
    run_free(&run);
    expect_in_file("grid.rts", "matrix 2 0 0 0 0 1 0 0 0 0 1 0");
    expect_in_file("grid.rts", "absorption 0.5 0.5 0.5\n    scattering 1.5 1.5 1.5\n"
                               "    density    grid_1");
    const uint32_t counts[3] = {2, 1, 1};
    uint8_t bytes[29];
    FILE *file = fopen("grid_files/grid_0.grid", "rb");
    assert_non_null(file);
    assert_int_equal(fread(bytes, 1, sizeof bytes, file), 28);
    fclose(file);
    assert_memory_equal(bytes, "RTGRID1\n", 8);
    assert_memory_equal(bytes + 8, counts, 12);
    assert_memory_equal(bytes + 20, values, 8);
    write_grid(3, values, 6);
    run = run_rtc("import grid.xml --out grid.rts");
    expect_no_err(&run, "channels");
    run_free(&run);
    expect_in_file("grid.rts", "scattering 1.5 1.5 1.5");
    file = fopen("grid_files/grid_0.grid", "rb");
    assert_non_null(file);
    assert_int_equal(fread(bytes, 1, sizeof bytes, file), sizeof bytes);
    fclose(file);
    assert_memory_equal(bytes, "RTGRID3\n", 8);
    assert_memory_equal(bytes + 20, values, 9);
    write_grid(2, values, 6);
    run = run_rtc("import grid.xml --out grid.rts");
    expect_err(&run, "grid.xml:3: a grid of 2 channels became one of their mean");
    run_free(&run);
}

/* An albedo by a grid: all of the extinction becomes scattering. */
static void grids_are_albedos(void **state)
{
    static const float values[] = {0.5f, 1, 0.25f, 0, -0.5f, 1.5f},
                       kept[] = {0.5f, 1, 0.25f, 0, 0, 1};
    static const char text[] =
        "<scene><shape type=\"cube\"><bsdf type=\"null\"/>\n<medium type=\"homogeneous\" "
        "name=\"interior\"><rgb name=\"sigma_t\" value=\"1 2 3\"/><float name=\"scale\" "
        "value=\"2\"/>\n<volume name=\"albedo\" type=\"gridvolume\"><string name=\"filename\" "
        "value=\"d.vol\"/><string name=\"wrap_mode\" value=\"repeat\"/></volume></medium></shape>"
        "</scene>\n";
    uint8_t bytes[44];
    (void)state;
    scratch_write("albedo.xml", text);
    write_grid(3, values, 6);
    run run = run_rtc("import albedo.xml --out albedo.rts");
    expect_status(&run, 0);
    expect_err(&run, "albedo.xml:3: the negative values of a grid became 0");
    expect_err(&run, "albedo.xml:3: the albedos above 1 of a grid became 1");
    run_free(&run);
    expect_in_file("albedo.rts", "wrap repeat");
    expect_in_file("albedo.rts", "scattering 2 4 6  albedo grid_1");
    FILE *file = fopen("albedo_files/grid_0.grid", "rb");
    assert_non_null(file);
    assert_int_equal(fread(bytes, 1, sizeof bytes, file), sizeof bytes);
    fclose(file);
    assert_memory_equal(bytes, "RTGRID3\n", 8);
    assert_memory_equal(bytes + 20, kept, sizeof kept);
}

static void wrong_grids_are_told(void **state)
{
    static const float values[] = {1, 2};
    static const float bad[] = {NAN, 2}, negative[] = {-1, 2};
    (void)state;
    write_grid(1, bad, 2);
    run run = run_rtc("import grid.xml --out grid.rts");
    expect_status(&run, 1);
    expect_err(&run, "grid.xml:3: 'd.vol' has a value that is not finite");
    run_free(&run);
    write_grid(1, negative, 2);
    run = run_rtc("import grid.xml --out grid.rts");
    expect_status(&run, 0);
    expect_err(&run, "grid.xml:3: the negative values of a grid became 0");
    run_free(&run);
    write_grid(1, values, 2);
    assert_int_equal(truncate("d.vol", 52), 0);
    run = run_rtc("import grid.xml --out grid.rts");
    expect_status(&run, 1);
    expect_err(&run, "grid.xml:3: 'd.vol' ends before its last voxel");
    run_free(&run);
    scratch_write("d.vol", "VOL\002                                                          ");
    run = run_rtc("import grid.xml --out grid.rts");
    expect_status(&run, 1);
    expect_err(&run, "grid.xml:3: 'd.vol' is no grid of single precision, version 3");
    run_free(&run);
}

/* ---- Serialized meshes ------------------------------------------------------- */

static void write_scene_of_meshes(const char *index)
{
    char text[512];
    snprintf(
        text, sizeof text,
        "<scene><shape type=\"serialized\">\n<string name=\"filename\" value=\"m.serialized\"/>"
        "\n<integer name=\"shape_index\" value=\"%s\"/></shape></scene>\n",
        index);
    scratch_write("m.xml", text);
}

static void write_meshes(int version, int is_double)
{
    static const double heights[] = {1, 2.5};
    rt_bytes file = {0};
    size_t starts[2];
    for (int i = 0; i < 2; i++) {
        rt_bytes content = serialized_triangle(version, is_double, heights[i]);
        starts[i] = file.size;
        serialized_put_mesh(&file, version, &content);
        rt_bytes_free(&content);
    }
    serialized_put_table(&file, version, starts, 2);
    write_bytes("m.serialized", &file);
    rt_bytes_free(&file);
}

static void expect_triangle(const char *name, float z)
{
    const float corners[9] = {0, 0, z, 1, 0, z, 0, 1, z}, uv[6] = {0, 0, 1, 0, 0, 1};
    rt_mesh *mesh;
    rt_error error;
    assert_int_equal(rt_mesh_load(&mesh, name, NULL, &error), RT_OK);
    assert_int_equal(mesh->triangle_count, 1);
    assert_memory_equal(mesh->positions, corners, sizeof corners);
    assert_memory_equal(mesh->uv, uv, sizeof uv);
    rt_mesh_destroy(mesh);
}

/* Version 3 and 4, single and double precision, the first mesh and the second. */
static void serialized_meshes_are_read(void **state)
{
    (void)state;
    for (int i = 0; i < 8; i++) {
        write_meshes(3 + i % 2, i / 4);
        write_scene_of_meshes(i / 2 % 2 ? "1" : "0");
        expect_rtc(0, "import m.xml --out m.rts");
        expect_triangle("m_files/mesh_1.ply", i / 2 % 2 ? 2.5f : 1);
        expect_not_in_file("m_files/mesh_1.ply", "red"); /* Mitsuba does not show its colours */
    }
}

static size_t first_mesh_size(void)
{
    rt_bytes content = serialized_triangle(4, 0, 1), file = {0};
    serialized_put_mesh(&file, 4, &content);
    const size_t size = file.size;
    rt_bytes_free(&content);
    rt_bytes_free(&file);
    return size;
}

static void damaged_meshes_are_told(void **state)
{
    enum { LAST = 1 << 20 };
    static const struct {
        size_t at;
        uint8_t value;
        const char *index, *says;
    } cases[] = {
        {0, 0x1d, "0", "'m.serialized': not a file of serialized meshes"},
        {2, 5, "0", "'m.serialized': serialized meshes of another version than 3 and 4"},
        {20, 0xff, "0", "'m.serialized': a mesh is damaged, or ends before its last triangle"},
        {LAST, 0xff, "0", "'m.serialized': a mesh is damaged: its checksum is another"},
        {0, 0x1c, "2", "'m.serialized' has 2 meshes, not one of index 2"},
        {0, 0x1c, "-1", "a mesh of index -1"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_meshes(4, 0);
        FILE *file = fopen("m.serialized", "r+b");
        assert_non_null(file);
        /* the last byte of the first checksum stands before the second mesh */
        const long at = cases[i].at == LAST ? (long)first_mesh_size() - 1 : (long)cases[i].at;
        assert_int_equal(fseek(file, at, SEEK_SET), 0);
        fputc(cases[i].value, file);
        fclose(file);
        write_scene_of_meshes(cases[i].index);
        run run = run_rtc("import m.xml --out m.rts");
        expect_status(&run, 1);
        expect_err(&run, cases[i].says);
        run_free(&run);
    }
}

/* A mesh without normals that a transform mirrors faces the other way in Mitsuba. */
static void mirrored_meshes_are_turned(void **state)
{
    static const char text[] =
        "<scene><shape type=\"obj\"><string name=\"filename\" value=\"t.obj\"/><transform "
        "name=\"to_world\"><scale x=\"%s\"/></transform></shape>\n<shape "
        "type=\"sphere\"><transform "
        "name=\"to_world\"><scale x=\"-1\"/></transform></shape></scene>\n";
    static const char *const normals[] = {"", "vn 0 0 1\n"};
    (void)state;
    for (int i = 0; i < 4; i++) {
        const uint32_t ahead[3] = {0, 1, 2}, back[3] = {0, 2, 1};
        char scene[512], mesh_text[256];
        rt_mesh *mesh;
        rt_error error;
        snprintf(mesh_text, sizeof mesh_text, "v 0 0 0\nv 1 0 0\nv 0 1 0\n%s%s", normals[i / 2],
                 i / 2 ? "f 1//1 2//1 3//1\n" : "f 1 2 3\n");
        scratch_write("t.obj", mesh_text);
        snprintf(scene, sizeof scene, text, i % 2 ? "-1" : "2");
        scratch_write("t.xml", scene);
        run run = run_rtc("import t.xml --out t.rts");
        expect_no_err(&run, "t.xml:2");
        run_free(&run);
        expect_in_file("t.rts", "{ back material_");
        assert_int_equal(rt_mesh_load(&mesh, "t_files/mesh_1.ply", NULL, &error), RT_OK);
        assert_memory_equal(mesh->indices, i == 1 ? back : ahead, sizeof ahead);
        rt_mesh_destroy(mesh);
    }
}

/* A few bytes cannot claim more than they could hold. */
static void a_mesh_claims_no_more_than_its_file_holds(void **state)
{
    rt_bytes content = serialized_triangle(3, 0, 0), file = {0};
    (void)state;
    content.data[4 + 3] = 0x40; /* 2^30 vertices */
    serialized_put_mesh(&file, 3, &content);
    write_bytes("m.serialized", &file);
    write_scene_of_meshes("0");
    run run = run_rtc("import m.xml --out m.rts");
    expect_status(&run, 1);
    expect_err(&run, "a mesh has more vertices or triangles than its file can hold");
    run_free(&run);
    rt_bytes_free(&content);
    rt_bytes_free(&file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_are_searched_in_folders),
        cmocka_unit_test(parameters_are_put_in_place),
        cmocka_unit_test(an_alias_is_another_id),
        cmocka_unit_test(emitters_are_named),
        cmocka_unit_test(materials_are_counted),
        cmocka_unit_test(merged_shapes_are_placed),
        cmocka_unit_test(pplastics_lose_what_is_reflected_inside),
        cmocka_unit_test(colours_of_meshes_are_shown),
        cmocka_unit_test(weights_of_meshes_blend_colours),
        cmocka_unit_test(damaged_weights_are_told),
        cmocka_unit_test(curves_become_tubes),
        cmocka_unit_test(wrong_curves_are_told),
        cmocka_unit_test(media_fill_their_shapes),
        cmocka_unit_test(media_fill_thin_glass),
        cmocka_unit_test(grids_are_densities),
        cmocka_unit_test(grids_are_albedos),
        cmocka_unit_test(wrong_grids_are_told),
        cmocka_unit_test(serialized_meshes_are_read),
        cmocka_unit_test(damaged_meshes_are_told),
        cmocka_unit_test(mirrored_meshes_are_turned),
        cmocka_unit_test(a_mesh_claims_no_more_than_its_file_holds),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests(tests, scratch_enter, scratch_leave);
}
