/* test_import_attributes.c - scenes of other programs whose meshes have attributes. */
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
#include "spawn.h"
#include "support.h"

enum { side = 8 };

/* Imports a scene and renders side x side pixels of it; the film is to be destroyed. */
static rt_film *imported(const char *file, rt_mode mode, uint32_t spp)
{
    rt_scene *scene = NULL;
    rt_renderer *renderer = NULL;
    rt_film *film = NULL;
    rt_render_options options;
    rt_error error;
    expect_ok(rt_scene_import(&scene, "t.rts", file, NULL, &error), &error);
    rt_scene_get_options(scene, &options);
    options.width = options.height = side;
    options.filter = RT_FILTER_BOX;
    options.mode = mode;
    options.spp = spp;
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
    return film;
}

/*
 * The square from (-1, -1) to (1, 1), seen from above: its first set of coordinates is (x, y), the
 * second (y, -x), with v downwards as glTF has it. Its base colour is black; `texture` is the rest
 * of what names the image of its emission, 4 steps of grey along u.
 */
static void write_square(const char *attributes, const char *texture)
{
    char text[4096];
    snprintf(
        text, sizeof text,
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"mesh\":0},"
        "{\"camera\":0,\"translation\":[0,0,3]}],\"cameras\":[{\"type\":\"orthographic\","
        "\"orthographic\":{\"xmag\":1,\"ymag\":1,\"znear\":0.1,\"zfar\":10}}],\"meshes\":["
        "{\"primitives\":[{\"attributes\":{\"POSITION\":0%s},\"indices\":3,\"material\":0}]}],"
        "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0,0,1],"
        "\"metallicFactor\":0,\"baseColorTexture\":{\"index\":0}},\"emissiveFactor\":[1,1,1],"
        "\"emissiveTexture\":{\"index\":0%s}}],\"textures\":[{\"source\":0,\"sampler\":0}],"
        "\"samplers\":[{\"magFilter\":9728}],\"images\":[{\"uri\":\"steps.ppm\"}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
        "{\"bufferView\":1,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"},"
        "{\"bufferView\":2,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"},"
        "{\"bufferView\":3,\"componentType\":5123,\"count\":6,\"type\":\"SCALAR\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},"
        "{\"buffer\":0,\"byteOffset\":48,\"byteLength\":32},"
        "{\"buffer\":0,\"byteOffset\":80,\"byteLength\":32},"
        "{\"buffer\":0,\"byteOffset\":112,\"byteLength\":12}],\"buffers\":[{\"byteLength\":124,"
        "\"uri\":\"data:application/octet-stream;base64,"
        "AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAACAPwAAgD8AAAAAAACAvwAAgD8AAAAAAAAAAAAAgD8AAIA/"
        "AACAPwAAgD8A"
        "AAAAAAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAIA/AACAPwAAAQACAAAAAgADAA==\"}]}",
        attributes, texture);
    scratch_write("steps.ppm", "P3 4 1 65535 0 0 0 20000 20000 20000 40000 40000 40000 "
                               "65535 65535 65535\n");
    scratch_write("t.gltf", text);
}

/* What the square emits in each pixel: by x, or from the bottom upwards. */
static void expect_steps(int is_upwards)
{
    rt_film *film = imported("t.gltf", RT_MODE_PATH, 1);
    const float *rgb = rt_film_rgb(film);
    for (int y = 0; y < side; y++)
        for (int x = 0; x < side; x++) {
            const double codes[] = {0, 20000, 40000, 65535};
            const double code = codes[(is_upwards ? side - 1 - y : x) / 2] / 65535,
                         value = code <= 0.04045 ? code / 12.92 : pow((code + 0.055) / 1.055, 2.4);
            assert_float_equal(rgb[3 * (y * side + x)], value, 1e-3);
        }
    rt_film_destroy(film);
}

static void textures_of_gltf_have_their_sets(void **state)
{
    static const char both[] = ",\"TEXCOORD_0\":1,\"TEXCOORD_1\":2",
                      upright[] = "P3 1 4 65535 65535 65535 65535 40000 40000 40000 "
                                  "20000 20000 20000 0 0 0\n";
    (void)state;
    write_square(both, "");
    expect_steps(0);
    expect_not_in_file("t.rts", "attribute");
    write_square(both, ",\"texCoord\":1");
    expect_steps(1);
    /* the extension's number goes before that of the texture */
    write_square(both, ",\"texCoord\":0,\"extensions\":{\"KHR_texture_transform\":"
                       "{\"texCoord\":1}}");
    expect_steps(1);
    /* by v, from the bottom upwards */
    write_square(both, "");
    scratch_write("steps.ppm", upright);
    expect_steps(1);
    write_square(both, ",\"texCoord\":1");
    scratch_write("steps.ppm", upright);
    expect_steps(0);
}

static void sets_that_gltf_lacks_are_told(void **state)
{
    (void)state;
    write_square(",\"TEXCOORD_0\":1", ",\"texCoord\":1");
    run run = run_rtc("import t.gltf --out t.rts");
    expect_status(&run, 0);
    expect_err(&run, "a primitive without TEXCOORD_1 has them all 0");
    run_free(&run);
    expect_rtc(0, "check t.rts");
    write_square("", "");
    run = run_rtc("import t.gltf --out t.rts");
    expect_status(&run, 0);
    expect_err(&run, "a primitive without TEXCOORD_0 has them all 0");
    run_free(&run);
    write_square(",\"TEXCOORD_0\":1", ",\"texCoord\":9");
    run = run_rtc("import t.gltf --out t.rts");
    expect_status(&run, 0);
    expect_err(&run, "the texture coordinates 9 became the first ones");
    run_free(&run);
    write_square(",\"TEXCOORD_0\":1,\"TEXCOORD_1\":3", ",\"texCoord\":1");
    expect_rtc(1, "import t.gltf --out t.rts");
}

/* ---- Mitsuba ----------------------------------------------------------------- */

/*
 * A square of side 2 on the floor that has at its vertices a colour, a wear and a glow, and at its
 * two triangles a part.
 */
static void write_floor(const char *wear)
{
    char text[1024];
    snprintf(text, sizeof text,
             "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
             "property float z\nproperty float r\nproperty float g\nproperty float b\n"
             "property float %s\nproperty float glow_x\nproperty float glow_y\n"
             "property float glow_z\nelement face 2\nproperty list uchar int vertex_indices\n"
             "property float part_0\nend_header\n"
             "-1 -1 0  0.8 0.5 0.2  0.3  1 0 0\n1 -1 0  0.2 0.5 0.8  0.3  0 1 0\n"
             "1 1 0  0.5 0.8 0.2  0.3  0 0 1\n-1 1 0  0.5 0.2 0.8  0.3  1 1 1\n"
             "3 0 1 2 0.25\n3 0 2 3 0.75\n",
             wear);
    scratch_write("floor.ply", text);
}

#define BY(name, attribute)                                                                        \
    "<texture type=\"mesh_attribute\" name=\"" name "\"><string name=\"name\" value=\"" attribute  \
    "\"/></texture>"

/* The floor with this material, and a lamp like it above, seen from above. */
static void write_scene(const char *bsdf)
{
    char text[4096];
    snprintf(text, sizeof text,
             "<scene version=\"3.0.0\"><sensor type=\"orthographic\"><transform "
             "name=\"to_world\"><lookat origin=\"0 0 3\" target=\"0 0 0\" up=\"0 1 0\"/>"
             "</transform><film type=\"hdrfilm\"><rfilter type=\"box\"/></film></sensor>"
             "<integrator type=\"path\"><integer name=\"max_depth\" value=\"4\"/></integrator>"
             "<shape type=\"ply\"><string name=\"filename\" value=\"floor.ply\"/><boolean "
             "name=\"face_normals\" value=\"true\"/>%s</shape>"
             "<shape type=\"ply\"><string name=\"filename\" value=\"floor.ply\"/><boolean "
             "name=\"face_normals\" value=\"true\"/><transform name=\"to_world\"><scale "
             "value=\"0.5\"/><rotate x=\"1\" angle=\"180\"/><translate x=\"2\" z=\"1\"/>"
             "</transform><bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"0 0 0\"/>"
             "</bsdf><emitter type=\"area\">" BY("radiance", "vertex_glow") "</emitter></shape>"
                                                                            "</scene>",
             bsdf);
    scratch_write("t.xml", text);
}

static void mean_of(double mean[3], const rt_film *film)
{
    const float *rgb = rt_film_rgb(film);
    for (int c = 0; c < 3; c++) {
        mean[c] = 0;
        for (int i = 0; i < side * side; i++)
            mean[c] += (double)rgb[3 * i + c] / (side * side);
    }
}

/* Roughness by an attribute that is the same all over is that number. */
static void roughness_of_mitsuba_may_be_an_attribute(void **state)
{
    static const char *const alphas[] = {BY("alpha", "vertex_wear"),
                                         "<float name=\"alpha\" value=\"0.3\"/>",
                                         "<float name=\"alpha\" value=\"0.4\"/>"};
    double means[3][3];
    (void)state;
    write_floor("wear_0");
    for (int i = 0; i < 3; i++) {
        char bsdf[512];
        snprintf(bsdf, sizeof bsdf,
                 "<bsdf type=\"roughconductor\"><string name=\"material\" value=\"Au\"/>%s</bsdf>",
                 alphas[i]);
        write_scene(bsdf);
        rt_film *film = imported("t.xml", RT_MODE_PATH, 64);
        (i == 0 ? expect_in_file : expect_not_in_file)("t.rts", "\"wear\"");
        mean_of(means[i], film);
        rt_film_destroy(film);
    }
    assert_float_equal(means[0][0] / means[1][0], 1, 2e-3);
    assert_true(fabs(means[2][0] / means[1][0] - 1) > 0.05);
}

/* Colours, a weight of faces and the radiance of a light by attributes, in every mode. */
static void modes_show_the_same_attributes(void **state)
{
    static const rt_mode modes[] = {RT_MODE_PATH, RT_MODE_PHOTON, RT_MODE_VCM};
    double means[3][3];
    (void)state;
    write_floor("wear_0");
    write_scene("<bsdf type=\"blendbsdf\">" BY("weight", "face_part") "<bsdf type=\"diffuse\">" BY(
        "reflectance",
        "vertex_color") "</bsdf><bsdf type=\"roughconductor\"><string "
                        "name=\"material\" value=\"Au\"/>" BY("alpha", "vertex_wear") "</bsdf>"
                                                                                      "</bsdf>");
    for (int i = 0; i < 3; i++) {
        rt_film *film = imported("t.xml", modes[i], 1024);
        mean_of(means[i], film);
        rt_film_destroy(film);
        for (int c = 0; c < 3; c++)
            assert_float_equal(means[i][c] / means[0][c], 1, 0.02);
    }
}

/* A material that two meshes share is what each of them has; those alike share it. */
static void meshes_without_the_attribute_are_told(void **state)
{
    char text[1024];
    (void)state;
    write_floor("other_0");
    scratch_write("bare.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                              "property float y\nproperty float z\nproperty float wear_0\n"
                              "element face 1\nproperty list uchar int vertex_indices\n"
                              "end_header\n0 0 0 0.1\n1 0 0 0.2\n0 1 0 0.3\n3 0 1 2\n");
    snprintf(
        text, sizeof text,
        "<scene><bsdf type=\"roughconductor\" id=\"m\">\n" BY(
            "alpha",
            "vertex_wear") "</bsdf><shape type=\"ply\"><string name=\"filename\" "
                           "value=\"bare.ply\"/>"
                           "<ref id=\"m\"/></shape><shape type=\"ply\"><string name=\"filename\" "
                           "value=\"floor.ply\"/><ref id=\"m\"/></shape><shape "
                           "type=\"ply\"><string "
                           "name=\"filename\" value=\"bare.ply\"/><ref id=\"m\"/></shape><shape "
                           "type=\"sphere\"><ref id=\"m\"/></shape></scene>");
    scratch_write("t.xml", text);
    run run = run_rtc("import t.xml --out t.rts");
    expect_status(&run, 0);
    expect_err(&run, "t.xml:2: a texture by 'vertex_wear' of a mesh is left out");
    expect_out(&run, "4 shapes");
    expect_out(&run, "3 materials");
    run_free(&run);
    expect_rtc(0, "check t.rts");
}

/* What Mitsuba would show as it is, whatever that means, is refused with its number. */
static void values_beyond_one_are_refused(void **state)
{
    (void)state;
    write_floor("wear_0");
    scratch_write("bright.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                                "property float y\nproperty float z\nproperty float wear_0\n"
                                "element face 1\nproperty list uchar int vertex_indices\n"
                                "end_header\n0 0 0 0.1\n1 0 0 7.5\n0 1 0 0.3\n3 0 1 2\n");
    scratch_write("t.xml",
                  "<scene><shape type=\"ply\"><string name=\"filename\" value=\"bright.ply\"/>"
                  "<bsdf type=\"roughconductor\">" BY("alpha", "vertex_wear") "</bsdf></shape>"
                                                                              "</scene>");
    run run = run_rtc("import t.xml --out t.rts");
    expect_status(&run, 1);
    expect_err(&run, "the attribute 'wear' of its mesh has the value 7.5");
    run_free(&run);
}

/* Of vertices or of faces, as they are, below an even white; without any a grey of 0.5. */
static void colours_of_a_mesh_alone_are_seen(void **state)
{
#define PLY_HEAD                                                                                   \
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"                \
    "property float z\n"
#define PLY_FACE "element face 1\nproperty list uchar int vertex_indices\n"
#define PLY_RGB(type) "property " type " red\nproperty " type " green\nproperty " type " blue\n"
    static const struct {
        const char *file, *text;
        float right[3];
    } all[] = {
        {"v.ply",
         PLY_HEAD PLY_RGB("float") PLY_FACE "end_header\n0 0 0 0.5 0.25 1\n1 0 0 0.5 0.25 1\n"
                                            "0 1 0 0.5 0.25 1\n3 0 1 2\n",
         {0.5f, 0.25f, 1}},
        {"f.ply",
         PLY_HEAD PLY_FACE PLY_RGB("uchar") "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 128\n",
         {1, 0, 0.21586f}},
        {"g.ply",
         PLY_HEAD PLY_FACE "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
         {0.5f, 0.5f, 0.5f}},
        {"c.off",
         "COFF\n3 1 0\n0 0 0 0.5 0.25 1 1\n1 0 0 0.5 0.25 1 1\n0 1 0 0.5 0.25 1 1\n3 0 1 2\n",
         {0.5f, 0.25f, 1}},
    };
    (void)state;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        scratch_write(all[i].file, all[i].text);
        rt_film *film = imported(all[i].file, RT_MODE_ALBEDO, 4);
        const float *rgb = rt_film_rgb(film), *seen = rgb;
        for (int k = 1; k < side * side; k++) /* one that the triangle fills */
            seen = rgb[3 * k] > seen[0] ? rgb + 3 * k : seen;
        for (int c = 0; c < 3; c++)
            assert_float_equal(seen[c], all[i].right[c], 1e-4);
        rt_film_destroy(film);
    }
}

/* What is found in the scene that was made is told of the mesh by its own name. */
static void a_mesh_is_told_by_its_name(void **state)
{
    char text[1024] = "mtllib m.mtl\nusemtl jar\n";
    (void)state;
    for (int i = 0; i < 8; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "v %d %d %d\nvn %d %d %d\n",
                 i & 1, i >> 1 & 1, i >> 2, 2 * (i & 1) - 1, 2 * (i >> 1 & 1) - 1,
                 2 * (i >> 2) - 1);
    snprintf(text + strlen(text), sizeof text - strlen(text),
             "f 1//1 3//3 4//4 2//2\nf 5//5 6//6 8//8 7//7\nf 1//1 2//2 6//6 5//5\n"
             "f 3//3 7//7 8//8 4//4\nf 1//1 5//5 7//7 3//3\nf 2//2 4//4 8//8 6//6\n");
    scratch_write("m.mtl", "newmtl jar\nKd 0 0 0\nTf 1 1 1\nNi 1.5\nillum 4\n");
    scratch_write("m.obj", text);
    run run = run_rtc("check m.obj");
    expect_status(&run, 0);
    expect_err(&run, "m.obj: mesh 'jar': normals lean by more than 30 degrees from 100 % of");
    run_free(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(textures_of_gltf_have_their_sets, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(sets_that_gltf_lacks_are_told, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(roughness_of_mitsuba_may_be_an_attribute, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(modes_show_the_same_attributes, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(meshes_without_the_attribute_are_told, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(colours_of_a_mesh_alone_are_seen, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(a_mesh_is_told_by_its_name, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(values_beyond_one_are_refused, scratch_enter,
                                        scratch_leave),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests_name("import_attributes", tests, NULL, NULL);
}
