/*
 * test_import_poses.c - where the corners of glTF meshes are: in sparse accessors, by morph targets
 * and skins as the file has them, and in instances.
 */
#include <math.h>
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
#include "support.h"

enum { side = 16 };

/* The numbers that accessors are made of; two skins take bind_0 and bind_1. */
static const struct {
    float square[4][3]; /* half a metre wide, around the origin */
    float corner[3];
    float right[4][3], up[4][3]; /* morph targets, by which it moves a metre */
    float weights[4][4];
    float bind_0[16], bind_1[16];
    float moves[2][3];
    uint16_t indices[6], third[2];
    uint8_t joints[4][4];
} numbers = {
    {{-0.25f, -0.25f, 0}, {0.25f, -0.25f, 0}, {0.25f, 0.25f, 0}, {-0.25f, 0.25f, 0}},
    {0.75f, 0.75f, 0},
    {{1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}},
    {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}},
    {{1}, {1}, {1}, {1}},
    {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
    {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -0.5f, 0, 0, 1},
    {{-0.5f, 0, 0}, {0.5f, 0.5f, 0}},
    {0, 1, 2, 0, 2, 3},
    {2},
    {{0}},
};

enum {
    POSITIONS,
    CORNER,
    RIGHT,
    UP,
    WEIGHTS,
    BIND_0,
    BIND_1,
    MOVES,
    INDICES,
    THIRD,
    JOINTS,
    SPARSE, /* the square with another third corner */
    ALONE   /* zeros, with that corner */
};

/* One view of each array above, and an accessor of it; then those that are sparse. */
static int write_accessors(char *out, size_t size)
{
    static const struct {
        size_t offset, bytes;
        int type, count;
        const char *shape;
    } arrays[] = {
#define ARRAY(name, type, count, shape)                                                            \
    {(size_t)((const char *)numbers.name - (const char *)&numbers), sizeof numbers.name, type,     \
     count, shape}
        ARRAY(square, 5126, 4, "VEC3"),    ARRAY(corner, 5126, 1, "VEC3"),
        ARRAY(right, 5126, 4, "VEC3"),     ARRAY(up, 5126, 4, "VEC3"),
        ARRAY(weights, 5126, 4, "VEC4"),   ARRAY(bind_0, 5126, 1, "MAT4"),
        ARRAY(bind_1, 5126, 1, "MAT4"),    ARRAY(moves, 5126, 2, "VEC3"),
        ARRAY(indices, 5123, 6, "SCALAR"), ARRAY(third, 5123, 1, "SCALAR"),
        ARRAY(joints, 5121, 4, "VEC4"),
    };
    static const char sparse[] =
        "\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":9,\"componentType\":5123},"
        "\"values\":{\"bufferView\":1}},\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"}";
    const int count = sizeof arrays / sizeof *arrays;
    int used = snprintf(out, size, "\"bufferViews\":[");
    for (int i = 0; i < count; i++)
        used += snprintf(out + used, size - (size_t)used,
                         "%s{\"buffer\":0,\"byteOffset\":%d,\"byteLength\":%d}", i ? "," : "",
                         (int)arrays[i].offset, (int)arrays[i].bytes);
    used += snprintf(out + used, size - (size_t)used, "],\"accessors\":[");
    for (int i = 0; i < count; i++)
        used += snprintf(out + used, size - (size_t)used,
                         "{\"bufferView\":%d,\"componentType\":%d,\"count\":%d,\"type\":\"%s\"},",
                         i, arrays[i].type, arrays[i].count, arrays[i].shape);
    return used +
           snprintf(out + used, size - (size_t)used, "{\"bufferView\":0,%s,{%s]", sparse, sparse);
}

/* A square that glows, seen from above from (-1, -1) to (1, 1). */
static void write_square(int positions, const char *of_primitive, const char *of_mesh,
                         const char *of_node, const char *nodes)
{
    char text[8192], accessors[4096];
    write_accessors(accessors, sizeof accessors);
    snprintf(text, sizeof text,
             "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":["
             "{\"mesh\":0%s},{\"camera\":0,\"translation\":[0,0,3]}%s],"
             "\"cameras\":[{\"type\":\"orthographic\",\"orthographic\":{\"xmag\":1,\"ymag\":1,"
             "\"znear\":0.1,\"zfar\":10}}],\"meshes\":[{%s\"primitives\":[{\"attributes\":{"
             "\"POSITION\":%d,\"JOINTS_0\":10,\"WEIGHTS_0\":4},%s\"indices\":8,\"material\":0}]}],"
             "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0,0,1]},"
             "\"emissiveFactor\":[1,1,1]}],\"skins\":[{\"joints\":[2]},{\"joints\":[2],"
             "\"inverseBindMatrices\":6}],%s,"
             "\"buffers\":[{\"byteLength\":%d,\"uri\":\"n.bin\"}]}",
             of_node, nodes, of_mesh, positions, of_primitive, accessors, (int)sizeof numbers);
    scratch_write_bytes("n.bin", (const uint8_t *)&numbers, sizeof numbers);
    scratch_write("t.gltf", text);
}

/* The area of what glows, m^2, and its middle. */
static void measure(double *area, double middle[2])
{
    rt_scene *scene = NULL;
    rt_renderer *renderer = NULL;
    rt_film *film = NULL;
    rt_render_options options;
    rt_error error;
    expect_ok(rt_scene_import(&scene, "t.rts", "t.gltf", NULL, &error), &error);
    rt_scene_get_options(scene, &options);
    options.width = options.height = side;
    options.filter = RT_FILTER_BOX;
    options.mode = RT_MODE_PATH;
    options.spp = 64;
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    *area = middle[0] = middle[1] = 0;
    for (int i = 0; i < side * side; i++) {
        const double part = rt_film_rgb(film)[3 * i] * (2.0 / side) * (2.0 / side);
        *area += part;
        middle[0] += part * ((i % side + 0.5) * 2 / side - 1);
        middle[1] += part * (1 - (i / side + 0.5) * 2 / side);
    }
    middle[0] /= *area;
    middle[1] /= *area;
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
}

static void expect_square(double area, double x, double y)
{
    double found, middle[2];
    measure(&found, middle);
    assert_float_equal(found, area, 0.01);
    assert_float_equal(middle[0], x, 0.02);
    assert_float_equal(middle[1], y, 0.02);
}

/* With the third corner at (3/4, 3/4) the square is a kite; from zeros, nothing has an area. */
static void sparse_values_replace_others(void **state)
{
    (void)state;
    write_square(POSITIONS, "", "", "", "");
    expect_square(0.25, 0, 0);
    write_square(SPARSE, "", "", "", "");
    expect_square(0.5, 1 / 6.0, 1 / 6.0);
    write_square(ALONE, "", "", "", "");
    run run = run_rtc("check t.gltf");
    expect_err(&run, "a mesh without a triangle that has an area is left out");
    run_free(&run);
}

#define TARGETS "\"targets\":[{\"POSITION\":2},{\"POSITION\":3}],"
static void morph_targets_move_by_their_weights(void **state)
{
    (void)state;
    write_square(POSITIONS, TARGETS, "", "", "");
    expect_square(0.25, 0, 0);
    write_square(POSITIONS, TARGETS, "\"weights\":[0.5,0.25],", "", "");
    expect_square(0.25, 0.5, 0.25);
    write_square(POSITIONS, TARGETS, "\"weights\":[0.5,0.25],", ",\"weights\":[0,-0.5]", "");
    expect_square(0.25, 0, -0.5);
}

/* The joint lies in a node around it; the transform of the node of the mesh does not count. */
#define JOINTED                                                                                    \
    ",{\"translation\":[0,0.5,0]},{\"translation\":[0.25,0,0],\"scale\":[2,1,1],"                  \
    "\"children\":[2]}"
static void skins_move_by_their_joints(void **state)
{
    (void)state;
    write_square(POSITIONS, "", "", ",\"skin\":0,\"translation\":[9,9,9]", JOINTED);
    expect_square(0.5, 0.25, 0.5);
    write_square(POSITIONS, "", "", ",\"skin\":1,\"translation\":[9,9,9]", JOINTED);
    expect_square(0.5 * 0.75, -0.75 + 0.125, 0.5); /* a quarter is beyond the picture */
    write_square(POSITIONS, TARGETS, "\"weights\":[0,-0.25],", ",\"skin\":0", JOINTED);
    expect_square(0.5, 0.25, 0.25);
}

#define INSTANCES                                                                                  \
    ",\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"TRANSLATION\":7}}}"
static void instances_lie_where_each_is(void **state)
{
    (void)state;
    write_square(POSITIONS, "", "", INSTANCES, "");
    expect_square(0.5, 0, 0.25);
}

/* A square, and one in a node around it. */
static void without_a_scene_all_nodes_count(void **state)
{
    (void)state;
    write_square(POSITIONS, "", "", "",
                 ",{\"mesh\":0,\"translation\":[0,0.5,0]},"
                 "{\"translation\":[0.5,0,0],\"children\":[2]}");
    char *text = scratch_read("t.gltf");
    static const char listed[] = "\"scenes\":[{\"nodes\":[0,1]}],";
    char *const scenes = strstr(text, listed);
    assert_non_null(scenes);
    memset(scenes, ' ', strlen(listed));
    scratch_write("t.gltf", text);
    free(text);
    expect_square(0.5, 0.25, 0.25);
}

static void wrong_poses_are_refused(void **state)
{
    (void)state;
    write_square(POSITIONS, "", "", ",\"skin\":2", JOINTED);
    run run = run_rtc("check t.gltf");
    expect_status(&run, 1);
    expect_err(&run, "names skins[2]; the file has 2 of them");
    run_free(&run);
    write_square(POSITIONS, "", "", ",\"skin\":0", "");
    run = run_rtc("check t.gltf");
    expect_status(&run, 1);
    expect_err(&run, "a joint of a skin is no node");
    run_free(&run);
    write_square(POSITIONS, "", "", ",\"skin\":0", ",{\"children\":[3]},{\"children\":[2]}");
    run = run_rtc("check t.gltf");
    expect_status(&run, 1);
    expect_err(&run, "nodes are nested deeper than 512");
    run_free(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(sparse_values_replace_others, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(morph_targets_move_by_their_weights, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(skins_move_by_their_joints, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(instances_lie_where_each_is, scratch_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(without_a_scene_all_nodes_count, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(wrong_poses_are_refused, scratch_enter, scratch_leave),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests_name("import_poses", tests, NULL, NULL);
}
