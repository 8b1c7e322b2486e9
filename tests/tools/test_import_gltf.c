/* test_import_gltf.c - what glTF 2.0 allows and files seldom have. */
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

/* Members of a file, each with the comma before it or "". */
typedef struct parts {
    const char *node, *primitive, *mesh, *material, *accessors, *more;
} parts;

/*
 * The square from (-1, -1) to (1, 1), seen from above. Accessors: 0 its corners, 1 the indices of
 * its triangles, of 6 bytes from 0 on in view 2; then those of `accessors`.
 */
static void write_square(const parts *p)
{
    char text[8192];
    snprintf(
        text, sizeof text,
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"mesh\":0%s},"
        "{\"camera\":0,\"translation\":[0,0,3]}],\"cameras\":[{\"type\":\"orthographic\","
        "\"orthographic\":{\"xmag\":0.9,\"ymag\":0.9,\"znear\":0.1,\"zfar\":10}}],\"meshes\":[{"
        "\"primitives\":[{\"attributes\":{\"POSITION\":0%s},\"material\":0}]%s}],"
        "\"materials\":[{%s}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
        "{\"bufferView\":1,\"componentType\":5123,\"count\":6,\"type\":\"SCALAR\"}%s],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},"
        "{\"buffer\":0,\"byteOffset\":48,\"byteLength\":12},"
        "{\"buffer\":0,\"byteOffset\":60,\"byteLength\":6}],\"buffers\":[{\"byteLength\":68,"
        "\"uri\":\"data:application/octet-stream;base64,"
        "AACAvwAAgL8AAAAAAACAPwAAgL8AAAAA\\nAACAPwAAgD8AAAAAAACAvwAAgD8AAAAAAAABAAIAAAACAAMAAAECAwQ"
        "F"
        "AAA=\"}]%s}",
        p->node, p->primitive, p->mesh, p->material, p->accessors, p->more);
    scratch_write("t.gltf", text);
}

static const char indices[] = "},\"indices\":1,\"x\":{";

/* Imports the file, and compares the mean colour of what the camera sees. */
static void expect_colour(double red, double green, double blue)
{
    const double expected[3] = {red, green, blue};
    rt_scene *scene = NULL;
    rt_renderer *renderer = NULL;
    rt_film *film = NULL;
    rt_render_options options;
    rt_error error;
    expect_ok(rt_scene_import(&scene, "t.rts", "t.gltf", NULL, &error), &error);
    rt_scene_get_options(scene, &options);
    options.width = options.height = 1;
    options.spp = 1024;
    options.filter = RT_FILTER_BOX;
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    for (int c = 0; c < 3; c++)
        assert_float_equal(rt_film_rgb(film)[c], expected[c], 1e-3);
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
}

#define UNLIT                                                                                      \
    "\"extensions\":{\"KHR_materials_unlit\":{}},\"pbrMetallicRoughness\":{"                       \
    "\"baseColorFactor\":[0.5,0.25,1,1]}"

static const parts plain = {"", indices, "", UNLIT, "", ""};

static void what_is_unlit_shows_both_sides(void **state)
{
    parts p = plain;
    (void)state;
    write_square(&p);
    expect_colour(0.5, 0.25, 1);
    p.node = ",\"rotation\":[0,1,0,0]";
    write_square(&p);
    expect_colour(0, 0, 0);
    p.material = UNLIT ",\"doubleSided\":true";
    write_square(&p);
    expect_colour(0.5, 0.25, 1);
}

/* Of zeros, of which those that differ follow: the triangles of the square by bytes. */
static void indices_may_be_sparse(void **state)
{
    parts p = plain;
    (void)state;
    p.primitive = "},\"indices\":2,\"x\":{";
    p.accessors = ",{\"componentType\":5123,\"count\":6,\"type\":\"SCALAR\",\"sparse\":{"
                  "\"count\":6,\"indices\":{\"bufferView\":2,\"componentType\":5121},"
                  "\"values\":{\"bufferView\":1}}}";
    write_square(&p);
    expect_colour(0.5, 0.25, 1);
}

/* Half of the corners as colours: from 0 to 0.5 along x and y, where they are clamped. */
static void colours_may_be_morphed(void **state)
{
    parts p = plain;
    (void)state;
    p.primitive = ",\"COLOR_0\":2},\"indices\":1,\"targets\":[{\"COLOR_0\":3}],\"x\":{";
    p.mesh = ",\"weights\":[0.5]";
    p.accessors = ",{\"componentType\":5126,\"count\":4,\"type\":\"VEC3\",\"sparse\":{\"count\":1,"
                  "\"indices\":{\"bufferView\":2,\"componentType\":5121},"
                  "\"values\":{\"bufferView\":0}}},"
                  "{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"}";
    write_square(&p);
    expect_colour(0.5 * 0.25, 0.25 * 0.25, 0);
}

static void images_that_are_not_read_are_left_out(void **state)
{
    static const struct {
        const char *uri, *told;
    } wrong[] = {{"https://example.com/a.png", "nothing is fetched from other places: the image"},
                 {"data:image/png;base64,A*", "a data URI holds what is no base64: the image"},
                 {"data:image/png", "a data URI has no comma before its data: the image"}};
    parts p = plain;
    char more[256];
    (void)state;
    p.material = "\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}";
    p.more = more;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        snprintf(more, sizeof more, ",\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"%s\"}]",
                 wrong[i].uri);
        write_square(&p);
        run run = run_rtc("check t.gltf");
        expect_status(&run, 0);
        expect_err(&run, wrong[i].told);
        run_free(&run);
    }
}

/* What came before metalness: a diffuse colour below one of reflection. */
#define GLOSS(specular)                                                                            \
    "\"extensions\":{\"KHR_materials_pbrSpecularGlossiness\":{"                                    \
    "\"diffuseFactor\":[0.5,0.25,1,1],\"glossinessFactor\":0.5,\"specularFactor\":[" specular      \
    "]}}"

static void what_the_format_allows_is_imported(void **state)
{
    static const struct {
        parts p;
        const char *text;
    } files[] = {
        {{",\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"_ID\":2}}}", indices, "",
          UNLIT, ",{\"bufferView\":1,\"componentType\":5123,\"count\":2,\"type\":\"SCALAR\"}", ""},
         "instance mesh_2 { material unlit_0 }\ninstance mesh_2 { material unlit_0 }"},
        {{"", indices, "",
          "\"pbrMetallicRoughness\":{\"metallicFactor\":1.2e-7,\"baseColorFactor\":[0.5,0.5,0.5,1]"
          "}",
          "", ""},
         "kd"},
        {{"", indices, "", GLOSS("0.04,0.04,0.04"), "", ""},
         "{ kd 0.5 0.25 1  coat 1  coat_roughness 0.25  coat_ior 1.5  coat_linear true }"},
        {{"", indices, "", GLOSS("1,0.5,0"), "", ""}, "{ ks 1 0.5 0  roughness 0.25 }"},
        {{"},{\"camera\":0,\"scale\":[-1,1,1]", indices, "", UNLIT, "", ""}, "mirror     true"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        write_square(&files[i].p);
        expect_rtc(0, "import t.gltf --out t.rts");
        expect_in_file("t.rts", files[i].text);
    }
}

static void tangents_are_told_where_normal_maps_ask_for_them(void **state)
{
    parts p = plain;
    (void)state;
    p.primitive = ",\"TANGENT\":0},\"indices\":1,\"x\":{";
    write_square(&p);
    run run = run_rtc("check t.gltf");
    expect_status(&run, 0);
    expect_no_err(&run, "TANGENT");
    run_free(&run);
    p.material = "\"normalTexture\":{\"index\":0}";
    write_square(&p);
    run = run_rtc("check t.gltf");
    expect_status(&run, 0);
    expect_err(&run, "TANGENT is left out: a normal map lies by its texture coordinates");
    run_free(&run);
}

/* Half a turn is one, as any other angle is, and a scale of 0 shows one point. */
static void transforms_of_textures_are_kept(void **state)
{
    static const char *const cases[][2] = {
        {"\"rotation\":3.141592653589793", "rotate 180"},
        {"\"rotation\":3.1415", "rotate 179.99"},
        {"\"scale\":[0,0]", "scale 1e-06 1e-06"},
    };
    char material[512];
    parts p = plain;
    (void)state;
    p.primitive = ",\"TEXCOORD_0\":2},\"indices\":1,\"x\":{";
    p.accessors = ",{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"}";
    p.more = ",\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"a.ppm\"}]";
    p.material = material;
    scratch_write("a.ppm", "P3 2 1 255 0 0 0 255 255 255\n");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        snprintf(material, sizeof material,
                 "\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0,\"extensions\":{"
                 "\"KHR_texture_transform\":{%s}}}}",
                 cases[i][0]);
        write_square(&p);
        expect_rtc(0, "import t.gltf --out t.rts");
        expect_in_file("t.rts", cases[i][1]);
    }
}

/* Primitives that share the vertices of a large mesh take no more than they have. */
static void shared_vertices_are_read_where_they_are_used(void **state)
{
    enum { MANY = 3000, VERTICES = 30000 };
    FILE *file = fopen("t.gltf", "w");
    (void)state;
    assert_non_null(file);
    fprintf(file,
            "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{"
            "\"mesh\":0}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},"
            "{\"buffer\":0,\"byteLength\":48}],\"accessors\":[{\"componentType\":5126,"
            "\"type\":\"VEC3\",\"count\":%d,\"sparse\":{\"count\":4,\"indices\":{"
            "\"bufferView\":1,\"componentType\":5121,\"byteOffset\":0},\"values\":{"
            "\"bufferView\":0}}},{\"bufferView\":1,\"componentType\":5121,\"type\":"
            "\"SCALAR\",\"count\":3}],\"buffers\":[{\"byteLength\":48,\"uri\":\"data:;base64,"
            "AAECAwAAgL8AAAAAAACAPwAAgL8AAAAAAACAPwAAgD8AAAAAAACAvwAAgD8AAAAA\"}],"
            "\"meshes\":[{\"primitives\":[",
            VERTICES);
    for (int i = 0; i < MANY; i++)
        fprintf(file, "%s{\"attributes\":{\"POSITION\":0},\"indices\":1}", i ? "," : "");
    fprintf(file, "]}]}");
    fclose(file);
    run run = run_rtc("check t.gltf");
    expect_status(&run, 0);
    expect_out(&run, "3000 shapes, 3000 triangles");
    run_free(&run);
}

#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, scratch_enter, scratch_leave)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_SCRATCH(what_is_unlit_shows_both_sides),
        IN_SCRATCH(indices_may_be_sparse),
        IN_SCRATCH(colours_may_be_morphed),
        IN_SCRATCH(images_that_are_not_read_are_left_out),
        IN_SCRATCH(what_the_format_allows_is_imported),
        IN_SCRATCH(tangents_are_told_where_normal_maps_ask_for_them),
        IN_SCRATCH(transforms_of_textures_are_kept),
        IN_SCRATCH(shared_vertices_are_read_where_they_are_used),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests_name("import_gltf", tests, NULL, NULL);
}
