/* test_import_textures.c - how imported textures lie on surfaces, and what is read of them. */
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

/* A glTF of one triangle with these materials, samplers and textures. */
static void write_gltf(const char *parts)
{
    char text[4096];
    snprintf(text, sizeof text,
             "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],"
             "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":"
             "{\"POSITION\":0},\"material\":0}]}],\"images\":[{\"uri\":\"n.ppm\"}],%s,"
             "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,"
             "\"type\":\"VEC3\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
             "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
             "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}",
             parts);
    scratch_write("n.ppm", "P3 1 1 255 128 128 255\n");
    scratch_write("t.gltf", text);
}

/* A scene of Mitsuba with a sphere whose reflectance is a bitmap with these children. */
static void write_mitsuba(const char *children)
{
    char text[4096];
    snprintf(text, sizeof text,
             "<scene version=\"3.0.0\"><shape type=\"rectangle\"><bsdf type=\"diffuse\">"
             "<texture name=\"reflectance\" type=\"bitmap\"><string name=\"filename\" "
             "value=\"n.ppm\"/>%s</texture></bsdf></shape></scene>",
             children);
    scratch_write("n.ppm", "P3 1 1 255 128 128 255\n");
    scratch_write("t.xml", text);
}

/* Imports it without a word of what is left out, and reads what came of it. */
static void expect_imported(const char *file)
{
    char command[64];
    snprintf(command, sizeof command, "import %s --out t.rts", file);
    run run = run_rtc(command);
    expect_status(&run, 0);
    expect_no_err(&run, "left out");
    run_free(&run);
    expect_rtc(0, "check t.rts");
}

static void textures_without_interpolation_stay_so(void **state)
{
    (void)state;
    write_mitsuba("<string name=\"filter_type\" value=\"nearest\"/>");
    expect_imported("t.xml");
    expect_in_file("t.rts", "filter nearest");
    write_mitsuba("<string name=\"filter_type\" value=\"bilinear\"/>");
    expect_imported("t.xml");
    expect_not_in_file("t.rts", "filter");
    for (int filter = 9728; filter <= 9729; filter++) {
        char parts[512];
        snprintf(parts, sizeof parts,
                 "\"samplers\":[{\"magFilter\":%d}],\"textures\":[{\"source\":0,\"sampler\":0}],"
                 "\"materials\":[{\"pbrMetallicRoughness\":{\"metallicFactor\":0,"
                 "\"baseColorTexture\":{\"index\":0}}}]",
                 filter);
        write_gltf(parts);
        expect_imported("t.gltf");
        (filter == 9728 ? expect_in_file : expect_not_in_file)("t.rts", "filter nearest");
    }
    scratch_write("t.pbrt",
                  "WorldBegin\nTexture \"n\" \"spectrum\" \"imagemap\" \"string filename\" "
                  "\"n.ppm\" \"string filter\" \"point\"\nMaterial \"diffuse\" "
                  "\"texture reflectance\" \"n\"\nShape \"sphere\"\n");
    expect_imported("t.pbrt");
    expect_in_file("t.rts", "filter nearest");
}

/* The matrix as a rotation, a scale and a shear, where v of the image runs downwards. */
static void maps_of_uv_are_kept(void **state)
{
    (void)state;
    write_mitsuba("<transform name=\"to_uv\"><rotate z=\"1\" angle=\"90\"/></transform>");
    expect_imported("t.xml");
    expect_in_file("t.rts", "scale 1 -1  offset 0 1  rotate -90 }");
    write_mitsuba(
        "<transform name=\"to_uv\"><matrix value=\"2 1 0 0.5 0 3 0 0.25 0 0 1 0 0 0 0 1\"/>"
        "</transform>");
    expect_imported("t.xml");
    expect_in_file("t.rts", "scale 2 -3  offset 0.5 0.75  shear 1 }");
    write_gltf("\"textures\":[{\"source\":0}],\"materials\":[{\"pbrMetallicRoughness\":"
               "{\"metallicFactor\":0,\"baseColorTexture\":{\"index\":0,\"extensions\":"
               "{\"KHR_texture_transform\":{\"rotation\":1.5707963267948966,\"scale\":[2,3],"
               "\"offset\":[0.125,0.25]}}}}}]");
    expect_imported("t.gltf");
    expect_in_file("t.rts", "scale 2 3  offset 3.125 0.75  rotate 90 }");
}

/* Of pbrt: products, mixtures and checkers of textures and colours, and what needs no texture. */
static void textures_of_pbrt_lie_in_each_other(void **state)
{
    (void)state;
    scratch_write("n.ppm", "P3 1 1 255 128 128 255\n");
    scratch_write(
        "t.pbrt",
        "WorldBegin\nTexture \"n\" \"spectrum\" \"imagemap\" \"string filename\" \"n.ppm\"\n"
        "Texture \"c\" \"spectrum\" \"constant\" \"rgb value\" [ 0.5 0.25 0.125 ]\n"
        "Texture \"half\" \"spectrum\" \"scale\" \"texture tex\" \"n\" \"texture scale\" \"c\"\n"
        "Texture \"k\" \"spectrum\" \"checkerboard\" \"texture tex1\" \"half\" \"float uscale\" 3\n"
        "Texture \"p\" \"spectrum\" \"scale\" \"texture tex\" \"k\" \"texture scale\" \"half\"\n"
        "Texture \"x\" \"spectrum\" \"mix\" \"texture tex1\" \"p\" \"rgb tex2\" [ 1 0 0 ] "
        "\"texture amount\" \"k\"\n"
        "Texture \"y\" \"spectrum\" \"mix\" \"texture tex1\" \"x\" \"texture tex2\" \"n\" "
        "\"float amount\" 0.25\n"
        "Texture \"z\" \"spectrum\" \"mix\" \"texture tex1\" \"c\" \"rgb tex2\" [ 0.1 0.25 0.125 ] "
        "\"float amount\" 0.25\n"
        "Material \"diffuse\" \"texture reflectance\" \"y\"\nShape \"sphere\"\n"
        "Material \"diffuse\" \"texture reflectance\" \"z\"\nShape \"disk\"\n"
        "Material \"diffuse\" \"texture reflectance\" \"p\"\nShape \"disk\"\n");
    expect_imported("t.pbrt");
    expect_in_file("t.rts", "texture k_2 { pattern checker  a_texture n_1  a 0.5 0.25 0.125  "
                            "b 0 0 0  scale 3 1 }");
    expect_in_file("t.rts", "texture p_3 { pattern multiply  a_texture k_2  b_texture n_1 }");
    expect_in_file("t.rts", "texture x_4 { pattern mix  a_texture p_3  a 0.5 0.25 0.125  b 1 0 0  "
                            "weight_texture k_2  weight 1 }");
    expect_in_file("t.rts", "texture y_5 { pattern mix  a_texture x_4  b_texture n_1  "
                            "weight 0.25 }");
    expect_in_file("t.rts", "kd 1 1 1  kd_texture y_5");
    expect_in_file("t.rts", "kd 0.4 0.25 0.125");
    expect_in_file("t.rts", "kd 0.5 0.25 0.125  kd_texture p_3");
}

static void textures_of_mitsuba_lie_in_each_other(void **state)
{
    (void)state;
    scratch_write("n.ppm", "P3 1 1 255 128 128 255\n");
    scratch_write(
        "t.xml",
        "<scene version=\"3.0.0\"><texture type=\"scale\" id=\"s\"><float name=\"scale\" "
        "value=\"0.5\"/><texture type=\"bitmap\"><string name=\"filename\" value=\"n.ppm\"/>"
        "</texture></texture>"
        "<shape type=\"rectangle\"><bsdf type=\"diffuse\"><texture name=\"reflectance\" "
        "type=\"checkerboard\"><texture name=\"color0\" type=\"checkerboard\"><rgb "
        "name=\"color0\" value=\"0.5 0.25 1\"/></texture><ref name=\"color1\" id=\"s\"/>"
        "</texture></bsdf></shape><shape type=\"rectangle\"><bsdf type=\"diffuse\"><ref "
        "name=\"reflectance\" id=\"s\"/></bsdf></shape>"
        "<shape type=\"rectangle\"><bsdf type=\"bumpmap\"><texture type=\"scale\"><float "
        "name=\"scale\" value=\"-3\"/><texture type=\"bitmap\"><string name=\"filename\" "
        "value=\"n.ppm\"/></texture></texture><boolean name=\"use_shadowing_function\" "
        "value=\"false\"/><boolean name=\"flip_invalid_normals\" value=\"false\"/>"
        "<bsdf type=\"diffuse\"/></bsdf></shape></scene>");
    expect_imported("t.xml");
    expect_in_file("t.rts",
                   "checker_0 { pattern checker  a 0.5 0.25 1  b 0.2 0.2 0.2  scale 2 2 }");
    expect_in_file("t.rts", "    a_texture checker_0\n    b_texture bitmap_2\n"
                            "    b         0.5 0.5 0.5\n    scale     2 2\n");
    expect_in_file("t.rts", "kd 0.5 0.5 0.5  kd_texture bitmap_6");
    expect_in_file("t.rts", "bump_scale -3");
}

/* A pattern of values above 1, which Mitsuba refuses, is no error here. */
static void bright_patterns_are_scaled_down(void **state)
{
    (void)state;
    scratch_write("t.xml",
                  "<scene version=\"3.0.0\"><shape type=\"rectangle\"><bsdf type=\"diffuse\">"
                  "<texture name=\"reflectance\" type=\"checkerboard\"><rgb name=\"color0\" "
                  "value=\"2 4 5\"/></texture></bsdf></shape></scene>");
    run run = run_rtc("import t.xml --out t.rts");
    expect_status(&run, 0);
    expect_err(&run, "a material reflects and transmits more light than it gets: scaled down");
    run_free(&run);
    expect_in_file("t.rts", "kd 0.2 0.2 0.2");
    expect_rtc(0, "check t.rts");
}

/* What lies in itself, or too deep, is a colour where the language ends, and is told. */
static void textures_too_deep_in_each_other_are_told(void **state)
{
    char text[4096] = "WorldBegin\nTexture \"t0\" \"spectrum\" \"imagemap\" \"string filename\" "
                      "\"n.ppm\"\n";
    (void)state;
    scratch_write("n.ppm", "P3 1 1 255 128 128 255\n");
    for (int i = 1; i < 12; i++) {
        const size_t used = strlen(text);
        snprintf(text + used, sizeof text - used,
                 "Texture \"t%d\" \"spectrum\" \"checkerboard\" \"texture tex1\" \"t%d\"\n", i,
                 i - 1);
    }
    const size_t used = strlen(text);
    snprintf(text + used, sizeof text - used,
             "Material \"diffuse\" \"texture reflectance\" \"t11\"\nShape \"sphere\"\n");
    scratch_write("t.pbrt", text);
    scratch_write("t.xml", "<scene version=\"3.0.0\"><texture type=\"checkerboard\" id=\"s\"><ref "
                           "name=\"color0\" id=\"s\"/></texture><shape type=\"sphere\"><bsdf "
                           "type=\"diffuse\"><ref name=\"reflectance\" id=\"s\"/></bsdf></shape>"
                           "</scene>");
    for (int i = 0; i < 2; i++) {
        run run = run_rtc(i ? "import t.xml --out t.rts" : "import t.pbrt --out t.rts");
        expect_status(&run, 0);
        expect_err(&run, "textures lie too deep in each other: some became colours");
        run_free(&run);
        expect_rtc(0, "check t.rts");
    }
}

/* Of Mitsuba normals stay where they are when their map turns. */
static void normals_of_a_rotated_map_are_told(void **state)
{
    (void)state;
    scratch_write("n.ppm", "P3 1 1 255 128 128 255\n");
    scratch_write("t.xml", "<scene version=\"3.0.0\"><shape type=\"sphere\"><bsdf "
                           "type=\"normalmap\"><texture name=\"normalmap\" type=\"bitmap\"><string "
                           "name=\"filename\" value=\"n.ppm\"/><transform name=\"to_uv\"><rotate "
                           "z=\"1\" angle=\"30\"/></transform></texture><bsdf type=\"diffuse\"/>"
                           "</bsdf></shape></scene>");
    run run = run_rtc("import t.xml --out t.rts");
    expect_status(&run, 0);
    expect_err(&run, "the normals of a rotated map are turned with it");
    run_free(&run);
}

/* Green holds the roughness of glTF, whose square is alpha of GGX. */
static void roughness_of_gltf_is_the_square_of_green(void **state)
{
    (void)state;
    write_gltf("\"textures\":[{\"source\":0}],\"materials\":[{\"pbrMetallicRoughness\":"
               "{\"roughnessFactor\":0.5,\"metallicFactor\":0,"
               "\"metallicRoughnessTexture\":{\"index\":0}}}]");
    expect_imported("t.gltf");
    expect_in_file("t.rts", "linear true  channel g  power 2");
    expect_in_file("t.rts", "coat_roughness         0.25");
    expect_in_file("t.rts", "coat_roughness_texture roughness");
    write_gltf("\"textures\":[{\"source\":0}],\"materials\":[{\"pbrMetallicRoughness\":"
               "{\"metallicRoughnessTexture\":{\"index\":0}}}]");
    expect_imported("t.gltf");
    expect_in_file("t.rts", "roughness_texture roughness");
    expect_in_file("t.rts", "fresnel schlick }");
    expect_in_file("t.rts", "weight_texture metallic");
    expect_in_file("t.rts", "channel b");
    expect_in_file("t.rts", "channel g");
}

/* KHR_materials_clearcoat over a metal and over a plastic. */
static void clearcoats_of_gltf_are_coats(void **state)
{
    (void)state;
    write_gltf("\"textures\":[{\"source\":0}],\"materials\":[{\"pbrMetallicRoughness\":"
               "{\"roughnessFactor\":0.5,\"baseColorFactor\":[0.75,0.5,0.25,1]},\"extensions\":"
               "{\"KHR_materials_clearcoat\":{\"clearcoatFactor\":0.5,"
               "\"clearcoatRoughnessFactor\":0.5,\"clearcoatRoughnessTexture\":{\"index\":0}}}}]");
    run run = run_rtc("import t.gltf --out t.rts");
    expect_status(&run, 0);
    expect_err(&run, "a metal is less rough below its clearcoat, which bends light here");
    run_free(&run);
    expect_in_file("t.rts", "ks                     0.75 0.5 0.25");
    expect_in_file("t.rts", "roughness              0.20833333"); /* 0.25 (1 - 0.5 / 3) */
    expect_in_file("t.rts", "coat                   0.5");
    expect_in_file("t.rts", "coat_roughness         0.25");
    expect_in_file("t.rts", "coat_roughness_texture coat_roughness");
    expect_in_file("t.rts", "fresnel                schlick");
    write_gltf("\"materials\":[{\"pbrMetallicRoughness\":"
               "{\"metallicFactor\":0,\"baseColorFactor\":[0.5,0.5,0.25,1]},\"extensions\":"
               "{\"KHR_materials_clearcoat\":{\"clearcoatFactor\":1}}}]");
    run = run_rtc("import t.gltf --out t.rts");
    expect_status(&run, 0);
    expect_err(&run, "a plastic below a clearcoat reflects 0.04 at every angle");
    run_free(&run);
    expect_in_file("t.rts", "kd          0.48 0.48 0.24");
    expect_in_file("t.rts", "coat        1");
}

/* What is metal in part is a blend, below a clearcoat, too. */
static void gltf_between_metal_and_plastic_is_a_blend(void **state)
{
    (void)state;
    write_gltf("\"materials\":[{\"pbrMetallicRoughness\":"
               "{\"roughnessFactor\":0.5,\"metallicFactor\":0.25},\"extensions\":"
               "{\"KHR_materials_clearcoat\":{\"clearcoatFactor\":0.5,"
               "\"clearcoatRoughnessFactor\":1}}}]");
    run run = run_rtc("import t.gltf --out t.rts");
    expect_status(&run, 0);
    expect_err(&run, "a plastic below a clearcoat reflects 0.04 at every angle");
    run_free(&run);
    expect_in_file("t.rts", "kd             0.96 0.96 0.96");
    expect_in_file("t.rts", "fresnel        schlick");
    expect_in_file("t.rts", "blend plastic");
    expect_in_file("t.rts", "with metal");
    expect_in_file("t.rts", "weight 0.25");
    write_gltf("\"textures\":[{\"source\":0}],\"materials\":[{\"pbrMetallicRoughness\":"
               "{\"metallicRoughnessTexture\":{\"index\":0}},\"extensions\":"
               "{\"KHR_materials_transmission\":{\"transmissionFactor\":0.5}}}]");
    run = run_rtc("import t.gltf --out t.rts");
    expect_status(&run, 0);
    expect_err(&run, "the metalness of a texture is left out: what lets light through is no metal");
    run_free(&run);
    expect_in_file("t.rts", "kt 0.5");
    write_gltf("\"materials\":[{\"extensions\":"
               "{\"KHR_materials_transmission\":{\"transmissionFactor\":0.5}}}]");
    expect_rtc(0, "import t.gltf --out t.rts");
    expect_in_file("t.rts", "ks 1 1 1  roughness 1  fresnel schlick }");
    write_gltf("\"materials\":[{\"pbrMetallicRoughness\":{\"metallicFactor\":0.5},\"extensions\":"
               "{\"KHR_materials_transmission\":{\"transmissionFactor\":0.5}}}]");
    run = run_rtc("import t.gltf --out t.rts");
    expect_status(&run, 0);
    expect_err(&run, "the metal in a material that lets light through is left out");
    run_free(&run);
}

#define SHEEN(roughness, more)                                                                     \
    "\"textures\":[{\"source\":0}],\"materials\":[{\"pbrMetallicRoughness\":"                      \
    "{\"metallicFactor\":0,\"baseColorFactor\":[0.5,0.25,0.125,1],\"roughnessFactor\":" roughness  \
    "},\"extensions\":{" more "\"KHR_materials_sheen\":{\"sheenColorFactor\":[0.75,0.5,0.25],"     \
    "\"sheenRoughnessFactor\":0.5,\"sheenColorTexture\":{\"index\":0}}}}]"

/* Sheen over what is rough is fuzz; over what is glossy, or below a coat, it is Disney's. */
static void sheen_of_gltf_is_fuzz(void **state)
{
    (void)state;
    write_gltf(SHEEN("0.9", ""));
    run run = run_rtc("import t.gltf --out t.rts");
    expect_status(&run, 0);
    expect_err(&run, "below its sheen reflects diffusely alone: its rough reflection of 0.04 is");
    run_free(&run);
    expect_in_file("t.rts", "kd             0.5 0.25 0.125");
    expect_in_file("t.rts", "fuzz           0.75 0.5 0.25");
    expect_in_file("t.rts", "fuzz_roughness 0.5");
    expect_in_file("t.rts", "fuzz_texture   sheen");
    write_gltf(SHEEN("0.5", ""));
    run = run_rtc("import t.gltf --out t.rts");
    expect_status(&run, 0);
    expect_err(&run, "its sheen became Disney's, which is white");
    run_free(&run);
    write_gltf(SHEEN("0.9", "\"KHR_materials_clearcoat\":{\"clearcoatFactor\":0.5},"));
    expect_rtc(0, "import t.gltf --out t.rts");
    expect_in_file("t.rts", "clearcoat ");
    write_gltf(SHEEN("0.5", "\"KHR_materials_specular\":{\"specularFactor\":0},"));
    expect_imported("t.gltf");
    expect_in_file("t.rts", "fuzz_roughness 0.5");
}

/* glTF states 20 over the Abbe number, of what has a volume. */
static void dispersion_of_gltf_is_an_abbe_number(void **state)
{
    (void)state;
    write_gltf("\"materials\":[{\"pbrMetallicRoughness\":{\"metallicFactor\":0,"
               "\"roughnessFactor\":0},\"extensions\":{\"KHR_materials_ior\":{\"ior\":1.6},"
               "\"KHR_materials_dispersion\":{\"dispersion\":0.5},"
               "\"KHR_materials_volume\":{\"thicknessFactor\":1},"
               "\"KHR_materials_transmission\":{\"transmissionFactor\":1}}}]");
    expect_imported("t.gltf");
    expect_in_file("t.rts", "ior 1.6  abbe 40");
    write_gltf("\"materials\":[{\"pbrMetallicRoughness\":{\"metallicFactor\":0,"
               "\"roughnessFactor\":0},\"extensions\":{"
               "\"KHR_materials_dispersion\":{\"dispersion\":100},"
               "\"KHR_materials_volume\":{\"thicknessFactor\":1},"
               "\"KHR_materials_transmission\":{\"transmissionFactor\":1}}}]");
    expect_imported("t.gltf");
    expect_in_file("t.rts", "abbe 1 ");
}

static void roughness_of_mitsuba_may_be_a_texture(void **state)
{
    (void)state;
    scratch_write("n.ppm", "P3 1 1 255 128 128 255\n");
    scratch_write("t.xml",
                  "<scene version=\"3.0.0\"><shape type=\"sphere\"><bsdf type=\"roughconductor\">"
                  "<string name=\"distribution\" value=\"ggx\"/>"
                  "<texture name=\"alpha\" type=\"bitmap\"><string name=\"filename\" "
                  "value=\"n.ppm\"/><boolean name=\"raw\" value=\"true\"/></texture></bsdf></shape>"
                  "</scene>");
    expect_imported("t.xml");
    expect_in_file("t.rts", "    roughness_texture bitmap");
    expect_in_file("t.rts", "    roughness         1\n");
}

/* By their content, a TGA by its name. */
static void images_of_other_formats_are_kept(void **state)
{
    static const uint8_t
        tga[21] = {[2] = 2, [12] = 1, [14] = 1, [16] = 24, [19] = 128},
        bmp[58] = {'B', 'M', [10] = 54, [14] = 40, [18] = 1, [22] = 1, [26] = 1, [28] = 24},
        qoi[23] = {'q', 'o', 'i', 'f', [7] = 1, [11] = 1, [12] = 3, [14] = 0xc0, [22] = 1};
    static const char hdr[] = "#?RADIANCE\n\n-Y 1 +X 1\nabc\200";
    (void)state;
    scratch_write_bytes("a.tga", tga, sizeof tga);
    scratch_write_bytes("b.x", bmp, sizeof bmp);
    scratch_write_bytes("d.x", qoi, sizeof qoi);
    scratch_write("c.hdr", hdr);
    scratch_write(
        "t.xml",
        "<scene version=\"3.0.0\"><shape type=\"sphere\"><bsdf type=\"diffuse\">"
        "<texture name=\"reflectance\" type=\"bitmap\"><string name=\"filename\" "
        "value=\"a.tga\"/></texture></bsdf></shape><shape type=\"sphere\"><bsdf "
        "type=\"diffuse\"><texture name=\"reflectance\" type=\"bitmap\"><string "
        "name=\"filename\" value=\"b.x\"/></texture></bsdf></shape><shape type=\"sphere\"><bsdf "
        "type=\"diffuse\"><texture name=\"reflectance\" type=\"bitmap\"><string "
        "name=\"filename\" value=\"d.x\"/></texture></bsdf></shape><emitter "
        "type=\"envmap\"><string name=\"filename\" value=\"c.hdr\"/></emitter>"
        "</scene>");
    expect_imported("t.xml");
    expect_in_file("t.rts", ".tga\"");
    expect_in_file("t.rts", ".bmp\"");
    expect_in_file("t.rts", ".hdr\"");
    expect_in_file("t.rts", ".qoi\"");
}

/* Of an image with an alpha that is not 1 everywhere, decoded as its colours are. */
static void numbers_of_pbrt_are_alpha(void **state)
{
    static const struct {
        const char *head, *type, *encoding;
        uint8_t alpha;
        const char *channel;
    } cases[] = {{"", "float", "", 128, "channel a  power 2.2"},
                 {"", "float", "\"string encoding\" \"linear\"", 128, "channel a }"},
                 {"", "float", "", 255, NULL},
                 {"", "spectrum", "", 128, NULL},
                 {"Film \"image\"\n", "float", "", 128, NULL}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[600];
        const uint8_t tga[26] = {[2] = 2,
                                 [12] = 2,
                                 [14] = 1,
                                 [16] = 32,
                                 [17] = 40,
                                 [18] = 90,
                                 [19] = 90,
                                 [20] = 90,
                                 [21] = 255,
                                 [22] = 200,
                                 [23] = 200,
                                 [24] = 200,
                                 [25] = cases[i].alpha};
        scratch_write_bytes("a.tga", tga, sizeof tga);
        snprintf(text, sizeof text,
                 "%sWorldBegin\nTexture \"a\" \"%s\" \"imagemap\" \"string filename\" \"a.tga\" "
                 "%s\nMaterial \"%s\" \"texture reflectance\" \"a\"\nShape \"sphere\" %s\n",
                 cases[i].head, cases[i].type, cases[i].encoding,
                 *cases[i].head ? "matte" : "diffuse",
                 strcmp(cases[i].type, "float") == 0 ? "\"texture alpha\" \"a\"" : "");
        scratch_write("t.pbrt", text);
        expect_rtc(0, "import t.pbrt --out t.rts");
        if (cases[i].channel)
            expect_in_file("t.rts", cases[i].channel);
        else
            expect_not_in_file("t.rts", "channel");
    }
}

/* Heights of MTL, which have no unit, are told, and leave the normals that stand beside them. */
static void heights_of_mtl_leave_normals(void **state)
{
    static const char *const mtl[] = {"newmtl a\nKd 1 1 1\nnorm n.ppm\nbump h.ppm\n",
                                      "newmtl a\nKd 1 1 1\nbump h.ppm\nnorm n.ppm\n"};
    (void)state;
    scratch_write("n.ppm", "P3 2 1 255 128 128 255 218 128 218\n");
    scratch_write("h.ppm", "P3 1 1 255 128 128 128\n");
    scratch_write("t.obj",
                  "mtllib t.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
    for (int i = 0; i < 2; i++) {
        scratch_write("t.mtl", mtl[i]);
        run run = run_rtc("import t.obj --out t.rts");
        expect_status(&run, 0);
        expect_err(&run, "bump");
        run_free(&run);
        expect_in_file("t.rts", "normal_texture");
    }
}

/* pbrt: 1 - scale x of a number, here a weight. */
static void numbers_of_pbrt_are_inverted(void **state)
{
    (void)state;
    scratch_write("n.ppm", "P3 1 1 255 128 128 128\n");
    scratch_write("t.pbrt",
                  "WorldBegin\nTexture \"t\" \"float\" \"imagemap\" \"string filename\" \"n.ppm\" "
                  "\"bool invert\" true \"float scale\" 0.5\n"
                  "MakeNamedMaterial \"a\" \"string type\" \"diffuse\"\n"
                  "Material \"mix\" \"string materials\" [\"a\" \"a\"] \"texture amount\" \"t\"\n"
                  "Shape \"sphere\"\n");
    run run = run_rtc("import t.pbrt --out t.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "left out");
    run_free(&run);
    expect_in_file("t.rts", "pattern mix  a 1 1 1  b 0 0 0  weight_texture t_1  weight 0.5");
    expect_in_file("t.rts", "weight_texture t_2");
}

static void expect_err_once(const run *run, const char *text)
{
    const char *const first = strstr(run->err, text);
    assert_non_null(first);
    assert_null(strstr(first + 1, text));
}

/* With a word of what is wrong, once, as with one that is not there; the others stay. */
static void damaged_images_are_left_out(void **state)
{
    static const char obj[] =
        "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 1 3 2\n",
                      mtl[] = "newmtl a\nmap_Kd cut.ppm\nnewmtl b\nmap_Kd n.ppm\n";
    (void)state;
    scratch_write("t.obj", obj);
    scratch_write("t.mtl", mtl);
    scratch_write("n.ppm", "P3 1 1 255 128 128 255\n");
    scratch_write("cut.ppm", "P3 2 2 255 128 128 255\n");
    run run = run_rtc("t.obj --width 8 --height 8 --spp 1 --out t.png --progress none");
    expect_status(&run, 0);
    expect_err(&run, "t.mtl:2: the image cut.ppm is left out: ");
    expect_err(&run, "1 of 2 materials exact");
    expect_err_once(&run, "the file has no camera");
    run_free(&run);
    /* made, and then made anew in the place of that */
    for (int i = 0; i < 2; i++) {
        run = run_rtc("import t.obj --out t.rts");
        expect_status(&run, 0);
        expect_err(&run, "t.mtl:2: the image cut.ppm is left out: ");
        expect_err_once(&run, "the file has no camera");
        run_free(&run);
        expect_in_file("t.rts", "n_ppm");
        expect_rtc(0, "check t.rts");
    }
    run = run_rtc("t.obj --strict --width 8 --height 8 --spp 1 --out t.png");
    expect_status(&run, 1);
    expect_err(&run, "error: t.mtl:2: the image cut.ppm is left out: ");
    run_free(&run);
    write_gltf("\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}],"
               "\"textures\":[{\"source\":0}]");
    scratch_write("n.ppm", "P3 2 2 255 128 128 255\n");
    run = run_rtc("check t.gltf");
    expect_status(&run, 0);
    expect_err(&run, "t.gltf: materials[0]: the image n.ppm is left out: ");
    run_free(&run);
}

/* Mitsuba's u and v, where those of a shape are others here: by the texture and the transform. */
static void textures_of_mitsuba_lie_as_there(void **state)
{
    static const struct {
        const char *shape, *texture, *placed;
    } cases[] = {
        {"sphere\">", "", " 1 0 0 0 0 0 -1 0 0 1 0 0"},
        {"rectangle\">", "scale 1 -1  offset 0 1", "quad"},
        {"rectangle\"><boolean name=\"flip_normals\" value=\"true\"/>", "scale -1 -1  offset 1 1",
         "quad"},
        {"disk\">", "rotate 90", "disc {"},
        {"cylinder\"><point name=\"p0\" x=\"1\"/><point name=\"p1\" x=\"1\" y=\"2\"/>",
         "scale 1 -1  offset 0 1", " 1 0 0 1 0 0 1 0 0 -1 0 0"},
        {"cube\">", "scale 1 -1  offset 0 1", "instance mesh"},
        {"obj\"><string name=\"filename\" value=\"a.obj\"/>", "texture bitmap", "instance mesh"},
        {"obj\"><boolean name=\"flip_tex_coords\" value=\"false\"/><string name=\"filename\" "
         "value=\"a.obj\"/>",
         "scale 1 -1  offset 0 1", "instance mesh"},
    };
    const uint8_t tga[21] = {[2] = 2, [12] = 1, [14] = 1, [16] = 24, [19] = 128};
    (void)state;
    scratch_write_bytes("a.tga", tga, sizeof tga);
    scratch_write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    for (size_t i = 0; i < 2 * (sizeof cases / sizeof *cases); i++) {
        const int is_light = i % 2;
        char text[512];
        snprintf(text, sizeof text,
                 "<scene><shape type=\"%s<%s><texture name=\"%s\" type=\"bitmap\">"
                 "<string name=\"filename\" value=\"a.tga\"/></texture></%s></shape></scene>",
                 cases[i / 2].shape, is_light ? "emitter type=\"area\"" : "bsdf type=\"diffuse\"",
                 is_light ? "radiance" : "reflectance", is_light ? "emitter" : "bsdf");
        scratch_write("t.xml", text);
        expect_imported("t.xml");
        expect_in_file("t.rts", cases[i / 2].texture);
        expect_in_file("t.rts", cases[i / 2].placed);
    }
}

/* Mitsuba turns a mirrored sphere inside out, and no cylinder. */
static void mirrored_shapes_of_mitsuba_face_as_there(void **state)
{
    static const struct {
        const char *shape, *material;
    } cases[] = {{"sphere\">", "kd 0.5 0.5 0.5  back black }"},
                 {"cylinder\">", "kd 0.5 0.5 0.5  back black }"},
                 {"cylinder\"><transform name=\"to_world\"><scale x=\"-1\"/></transform>",
                  "kd 0.5 0.5 0.5  back black }"},
                 {"sphere\"><transform name=\"to_world\"><scale x=\"-1\"/></transform>", "back"}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[512];
        snprintf(text, sizeof text,
                 "<scene><shape type=\"%s<bsdf type=\"diffuse\"/></shape></scene>", cases[i].shape);
        scratch_write("t.xml", text);
        expect_imported("t.xml");
        expect_in_file("t.rts", cases[i].material);
        if (i < 3)
            expect_not_in_file("t.rts", "turned");
        else
            expect_in_file("t.rts", "turned");
    }
}

/* Which is along u, and that of a disk goes outwards there. */
static void anisotropy_of_mitsuba_lies_as_there(void **state)
{
    static const char *const materials[] = {
        "roughconductor\"><float name=\"alpha_u\" value=\"0.1\"/><float name=\"alpha_v\" "
        "value=\"0.3\"/>",
        "principled\"><float name=\"roughness\" value=\"0.3\"/><float name=\"anisotropic\" "
        "value=\"0.8\"/>"};
    (void)state;
    for (int i = 0; i < 4; i++) {
        char text[512];
        snprintf(text, sizeof text,
                 "<scene><shape type=\"%s\"><bsdf type=\"%s</bsdf></shape></scene>",
                 i % 2 ? "disk" : "rectangle", materials[i / 2]);
        scratch_write("t.xml", text);
        expect_imported("t.xml");
        (i % 2 ? expect_in_file : expect_not_in_file)("t.rts", "anisotropy_rotation 90");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(images_of_other_formats_are_kept, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(numbers_of_pbrt_are_alpha, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(heights_of_mtl_leave_normals, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(numbers_of_pbrt_are_inverted, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(damaged_images_are_left_out, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(textures_without_interpolation_stay_so, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(textures_of_mitsuba_lie_as_there, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(mirrored_shapes_of_mitsuba_face_as_there, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(anisotropy_of_mitsuba_lies_as_there, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(maps_of_uv_are_kept, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(textures_of_pbrt_lie_in_each_other, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(textures_of_mitsuba_lie_in_each_other, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(bright_patterns_are_scaled_down, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(textures_too_deep_in_each_other_are_told, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(normals_of_a_rotated_map_are_told, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(roughness_of_gltf_is_the_square_of_green, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(clearcoats_of_gltf_are_coats, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(gltf_between_metal_and_plastic_is_a_blend, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(sheen_of_gltf_is_fuzz, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(dispersion_of_gltf_is_an_abbe_number, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(roughness_of_mitsuba_may_be_a_texture, scratch_enter,
                                        scratch_leave),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests_name("import_textures", tests, NULL, NULL);
}
