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
    write_square(",\"TEXCOORD_0\":1", ",\"texCoord\":9");
    run = run_rtc("import t.gltf --out t.rts");
    expect_status(&run, 0);
    expect_err(&run, "the texture coordinates 9 became the first ones");
    run_free(&run);
    write_square(",\"TEXCOORD_0\":1,\"TEXCOORD_1\":3", ",\"texCoord\":1");
    expect_rtc(1, "import t.gltf --out t.rts");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(textures_of_gltf_have_their_sets, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(sets_that_gltf_lacks_are_told, scratch_enter,
                                        scratch_leave),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests_name("import_attributes", tests, NULL, NULL);
}
