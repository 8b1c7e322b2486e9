/* test_find_textures.c - rt_scene_check reports textures and colours without a sensible effect. */
#include "support.h"

#include <stdio.h>
#include <string.h>

#include "lib/image/scratch.h"

#define MAPS                                                                                       \
    "texture c { pattern checker a 1 }\ntexture k { pattern constant a 0.5 }\n"                    \
    "texture n { pattern constant a 0 }\ntexture half { pattern constant a 0.6 }\n"                \
    "texture lies { pattern multiply a 1 a_texture c b 1 b_texture k }\n"                          \
    "texture grey { file \"grey.ppm\" linear true }\ntexture up { file \"up.ppm\" linear true }\n" \
    "texture twice { file \"twice.ppm\" linear true }\n"                                           \
    "texture atlas { file \"atlas.ppm\" linear true }\n"
#define MESH(name, material) "model { file \"" name "\" shading flat material " material " }\n"

static const struct {
    const char *text;
    rt_finding_kind kind;
    const char *says;
} cases[] = {
    {MAPS "material m { kd_texture c }" MESH("bare.off", "m"), RT_FINDING_NO_COORDINATES,
     "this mesh has no texture coordinates"},
    {MAPS "material m { kd_texture lies }" MESH("bare.off", "m"), RT_FINDING_NO_COORDINATES, ""},
    {MAPS "material a { kd_texture c } material w { kd 1 } material m { blend a with w }" MESH(
         "bare.off", "m"),
     RT_FINDING_NO_COORDINATES, ""},
    {MAPS "material m { kd 1 } model { file \"bare.off\" shading flat material m texture c }",
     RT_FINDING_NO_COORDINATES, ""},
    {MAPS "material m { kd_texture k }" MESH("bare.off", "m"), RT_FINDING_NONE, ""},
    {MAPS "material m { kd_texture c }" MESH("mapped.ply", "m"), RT_FINDING_NONE, ""},
    {MAPS "material m { kd_texture c }" MESH("two.off", "m"), RT_FINDING_NO_COORDINATES, ""},
    {MAPS "material m { kd_texture c }" MESH("one.off", "m"), RT_FINDING_NONE, ""},
    {MAPS "material m { kd_texture c }" MESH("part.obj", "m"), RT_FINDING_NO_COORDINATES,
     "some corners of this mesh have no texture coordinates"},
    {MAPS "material m { kd_texture c }" MESH("part.ply", "m"), RT_FINDING_NO_COORDINATES, "some"},
    {MAPS "material m { kd 1 }" MESH("bare.off", "m"), RT_FINDING_NONE, ""},

    {"material m { metal gold }" MESH("coloured.off", "m"), RT_FINDING_UNSEEN_COLOURS,
     "the colours of this mesh have no effect: its material has no `kd`"},
    {"material m { kd 1 }" MESH("coloured.off", "m"), RT_FINDING_NONE, ""},
    {"material w { kd 1 } material m { metal gold back w }" MESH("coloured.off", "m"),
     RT_FINDING_NONE, ""},
    {"material m { metal gold }" MESH("bare.off", "m"), RT_FINDING_NONE, ""},

    {MAPS "material m { kd 1 normal_texture grey }" MESH("mapped.ply", "m"), RT_FINDING_NO_NORMALS,
     "100 % of its texels do not decode"},
    {MAPS "material m { kd 1 normal_texture k }" MESH("mapped.ply", "m"), RT_FINDING_NO_NORMALS,
     "does not look like a normal map"},
    {MAPS "material m { kd 1 normal_texture twice }" MESH("mapped.ply", "m"), RT_FINDING_NO_NORMALS,
     "does not look like a normal map"},
    {MAPS "material m { kd 1 normal_texture atlas }" MESH("mapped.ply", "m"), RT_FINDING_NONE, ""},
    {"texture n { pattern attribute attribute \"nm\" } material m { kd 1 normal_texture n }" MESH(
         "attribute.ply", "m"),
     RT_FINDING_NONE, ""},
    {"material m { kd 1 }" MESH("parts.ply", "m"), RT_FINDING_NONE, ""},
    {MAPS "material m { emission 1 emission_texture c } model { file \"bare.off\" shading flat "
          "material m radiance 1 }",
     RT_FINDING_NONE, ""},
    {MAPS "material m { kd 1 normal_texture up }" MESH("mapped.ply", "m"), RT_FINDING_NONE, ""},

    {MAPS "material m { kd 1 opacity_texture n }" MESH("mapped.ply", "m"), RT_FINDING_VANISHED,
     "nothing of this mesh is seen: its opacity is at most 0"},
    {MAPS "material m { kd 1 opacity 0.000001 }" MESH("mapped.ply", "m"), RT_FINDING_VANISHED,
     "nothing of this mesh is seen: its opacity is at most 1e-06"},
    {MAPS "material m { kd 1 opacity 0.5 opacity_texture half opacity_cutoff 0.5 }" MESH(
         "mapped.ply", "m"),
     RT_FINDING_VANISHED, "at most 0.3, below opacity_cutoff"},
    {MAPS "material m { kd 1 opacity_texture half opacity_cutoff 0.5 }" MESH("mapped.ply", "m"),
     RT_FINDING_NONE, ""},
};

static const char bare[] = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
                           "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
static const char two[] = "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n";
static const char coloured[] = "COFF\n4 4 0\n0 0 0 1 0 0 1\n1 0 0 0 1 0 1\n0 1 0 0 0 1 1\n"
                               "0 0 1 1 1 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
static const char mapped[] = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                             "property float y\nproperty float z\nproperty float u\n"
                             "property float v\nelement face 4\n"
                             "property list uchar int vertex_indices\nend_header\n"
                             "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n0 0 1 1 1\n"
                             "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

typedef struct told {
    rt_finding_kind kind;
    char message[256];
    int count;
} told;

static void collect(void *user, const rt_finding *finding)
{
    told *t = user;
    if (finding->kind < RT_FINDING_NO_COORDINATES)
        return;
    t->count++;
    t->kind = finding->kind;
    snprintf(t->message, sizeof t->message, "%s", finding->message);
    assert_int_equal(finding->severity, RT_SEVERITY_WARNING);
    assert_int_equal(finding->shape, 0);
}

static void textures_without_effect_are_told_and_no_others(void **state)
{
    (void)state;
    scratch_write("bare.off", bare);
    scratch_write("two.off", two);
    scratch_write("coloured.off", coloured);
    scratch_write("mapped.ply", mapped);
    scratch_write("grey.ppm", "P3 1 1 255 128 128 128\n");
    scratch_write("one.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    scratch_write("part.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\n"
                              "f 1/1 2/2 3/3\nf 1 3 4\n");
    scratch_write("part.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                              "property float y\nproperty float z\nelement face 2\n"
                              "property list uchar int vertex_indices\n"
                              "property list uchar float texcoord\nend_header\n0 0 0\n1 0 0\n"
                              "0 1 0\n0 0 1\n3 0 1 2 6 0 0 1 0 0 1\n3 0 2 3 0\n");
    scratch_write("attribute.ply",
                  "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                  "property float z\nproperty float nm_r\nproperty float nm_g\n"
                  "property float nm_b\nelement face 1\n"
                  "property list uchar int vertex_indices\nend_header\n0 0 0 .5 .5 1\n"
                  "1 0 0 .5 .5 1\n0 1 0 .5 .5 1\n3 0 1 2\n");
    scratch_write("parts.ply",
                  "ply\nformat ascii 1.0\ncomment TextureFile grey.ppm\n"
                  "comment TextureFile up.ppm\nelement vertex 4\nproperty float x\n"
                  "property float y\nproperty float z\nelement face 3\n"
                  "property list uchar int vertex_indices\n"
                  "property list uchar float texcoord\nproperty int texnumber\nend_header\n0 0 0\n"
                  "1 0 0\n0 1 0\n0 0 1\n3 0 1 2 6 0 0 1 0 0 1 0\n3 0 1 3 6 0 0 1 0 0 1 1\n"
                  "3 0 2 3 0 -1\n");
    scratch_write("twice.ppm", "P3 1 1 255 188 188 255\n");
    scratch_write("atlas.ppm", "P3 4 1 255 128 128 255 0 0 0 0 0 0 0 0 0\n");
    scratch_write("up.ppm", "P3 2 1 255 200 128 230 60 128 230\n");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        told t = {RT_FINDING_NONE, "", 0};
        rt_scene *scene = NULL;
        rt_error error;
        expect_ok(rt_scene_parse(&scene, cases[i].text, NULL, NULL, &error), &error);
        rt_scene_check(scene, collect, &t);
        if (t.kind != cases[i].kind || t.count > 1 || !strstr(t.message, cases[i].says))
            fail_msg("told %d times %d ('%s') of:\n%s", t.count, (int)t.kind, t.message,
                     cases[i].text);
        rt_scene_destroy(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(textures_without_effect_are_told_and_no_others),
    };
    return cmocka_run_group_tests_name("scene/find_textures", tests, scratch_enter, scratch_leave);
}
