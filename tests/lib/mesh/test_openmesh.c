/*
 * Reading through OpenMesh: no face is lost, no exception escapes, and no state is left over from
 * one file to the next.
 */
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "faults/failing_new.h"
#include "lib/image/scratch.h"
#include "lib/mesh/sample.h"
#include "mesh/openmesh_shim.h"

#define XYZ "property float x\nproperty float y\nproperty float z\n"
#define NORMAL "property float nx\nproperty float ny\nproperty float nz\n"
#define FACES "property list uchar uint vertex_index\nend_header\n"
#define NATIVE                                                                                     \
    (*(const uint8_t *)&(const uint16_t){1} ? "binary_little_endian" : "binary_big_endian")

/* Room for what a test reads. */
typedef struct arrays {
    float positions[64], normals[64], uv[64];
    uint32_t indices[64];
} arrays;

static rt_openmesh_sink sink_of(arrays *a, uint32_t vertices, uint32_t triangles)
{
    rt_openmesh_sink sink = {.positions = a->positions,
                             .normals = a->normals,
                             .uv = a->uv,
                             .indices = a->indices,
                             .vertex_room = vertices,
                             .triangle_room = triangles};
    return sink;
}

/* One triangle with the header given after the format line. */
static rt_openmesh_result read_triangle(rt_openmesh_sink *sink, const char *rest, int floats,
                                        char why[64])
{
    char header[512];
    static const float vertices[24] = {1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12,
                                       13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24};
    uint8_t face[13] = {3};
    const uint32_t corners[3] = {2, 0, 1};
    memcpy(face + 1, corners, sizeof corners);
    snprintf(header, sizeof header, "ply\nformat %s 1.0\n%s", NATIVE, rest);
    rt_openmesh_file file = {{header, vertices, face},
                             {strlen(header), (size_t)floats * sizeof(float), sizeof face}};
    return rt_openmesh_read(sink, &file, why, 64);
}

#define PLAIN "element vertex 3\n" XYZ "element face 1\n" FACES
#define RICH                                                                                       \
    "element vertex 3\n" XYZ NORMAL "property float u\nproperty float v\nelement face 1\n" FACES

static void vertices_and_faces_arrive_as_they_are(void **state)
{
    (void)state;
    static const float positions[] = {1, 2, 3, 9, 10, 11, 17, 18, 19},
                       normals[] = {4, 5, 6, 12, 13, 14, 20, 21, 22};
    static const float uv[] = {7, 8, 15, 16, 23, 24};
    arrays a;
    char why[64];
    rt_openmesh_sink sink = sink_of(&a, 3, 1);
    assert_int_equal(read_triangle(&sink, RICH, 24, why), RT_OPENMESH_OK);
    assert_int_equal(sink.vertex_count, 3);
    assert_int_equal(sink.triangle_count, 1);
    sample_expect_floats(a.positions, positions, 9);
    sample_expect_floats(a.normals, normals, 9);
    sample_expect_floats(a.uv, uv, 6);
    assert_int_equal(a.indices[0], 2);
    assert_int_equal(a.indices[1], 0);
    assert_int_equal(a.indices[2], 1);
}

/* OpenMesh's reader remembers the options of the file before. */
static void one_file_does_not_colour_the_next(void **state)
{
    (void)state;
    char why[64];
    for (int i = 0; i < 6; i++) {
        arrays a;
        memset(&a, 0, sizeof a);
        rt_openmesh_sink sink = sink_of(&a, 3, 1);
        int rich = i % 3 != 0;
        assert_int_equal(read_triangle(&sink, rich ? RICH : PLAIN, rich ? 24 : 9, why),
                         RT_OPENMESH_OK);
        assert_true(a.normals[0] == (rich ? 4 : 0));
        assert_true(a.uv[0] == (rich ? 7 : 0));
        assert_true(a.positions[3] == (rich ? 9 : 4));
    }
}

static void what_does_not_fit_is_a_failure(void **state)
{
    (void)state;
    arrays a;
    char why[64];
    rt_openmesh_sink few_vertices = sink_of(&a, 2, 1), few_triangles = sink_of(&a, 3, 0),
                     sink = sink_of(&a, 3, 1);
    assert_int_equal(read_triangle(&few_vertices, PLAIN, 9, why), RT_OPENMESH_FAILED);
    assert_int_equal(read_triangle(&few_triangles, PLAIN, 9, why), RT_OPENMESH_FAILED);
    assert_true(why[0] != '\0');
    /* A vertex that is not there, vertices cut short, a header of another kind. */
    assert_int_equal(
        read_triangle(&sink, "element vertex 2\n" XYZ "element face 1\n" FACES, 6, why),
        RT_OPENMESH_FAILED);
    assert_int_equal(read_triangle(&sink, PLAIN, 5, why), RT_OPENMESH_FAILED);
    rt_openmesh_file none = {{"solid", NULL, NULL}, {5, 0, 0}};
    assert_int_equal(rt_openmesh_read(&sink, &none, why, sizeof why), RT_OPENMESH_FAILED);
    assert_int_equal(read_triangle(&sink, PLAIN, 9, why), RT_OPENMESH_OK);
}

static int stop(void *user, uint64_t done)
{
    ++*(int *)user;
    return done > 100000;
}

static void reading_can_be_stopped(void **state)
{
    (void)state;
    enum { vertices = 300000 };
    float *positions = calloc(vertices, 3 * sizeof *positions);
    char header[256], why[64];
    int calls = 0;
    assert_non_null(positions);
    rt_openmesh_sink sink = {
        .positions = positions, .vertex_room = vertices, .step = stop, .user = &calls};
    snprintf(header, sizeof header,
             "ply\nformat %s 1.0\nelement vertex %d\n" XYZ "element face 0\n" FACES, NATIVE,
             vertices);
    rt_openmesh_file file = {{header, positions, NULL},
                             {strlen(header), vertices * 3 * sizeof *positions, 0}};
    assert_int_equal(rt_openmesh_read(&sink, &file, why, sizeof why), RT_OPENMESH_STOPPED);
    assert_int_equal(calls, 2);
    free(positions);
}

/* Five triangles on one edge, one of them twice and one turned: a half-edge mesh would keep two. */
static void faces_of_a_non_manifold_mesh_are_kept(void **state)
{
    (void)state;
    static const unsigned indices[] = {0, 1, 2, 0, 1, 3, 0, 1, 4, 0, 1, 5,
                                       0, 1, 6, 0, 1, 2, 1, 0, 2, 2, 2, 2};
    static const float normals[] = {0, 0, 1, 0, 0, -1, 1, 0, 0, -1, 0,
                                    0, 0, 1, 0, 0, -1, 0, 0, 0, 1};
    rt_mesh *mesh = sample_accept(
        "a.ply", "ply\nformat ascii 1.0\nelement vertex 7\n" XYZ NORMAL "element face 8\n"
                 "property list uchar int vertex_indices\nend_header\n"
                 "0 0 0 0 0 1\n1 0 0 0 0 -1\n0 1 0 1 0 0\n0 -1 0 -1 0 0\n0 0 1 0 1 0\n0 0 -1 0 -1 "
                 "0\n0 1 1 0 0 1\n"
                 "3 0 1 2\n3 0 1 3\n3 0 1 4\n3 0 1 5\n3 0 1 6\n3 0 1 2\n3 1 0 2\n3 2 2 2\n");
    sample_expect_triangles(mesh, indices, 8);
    assert_int_equal(mesh->vertex_count, 7);
    sample_expect_floats(mesh->normals, normals, 21);
    rt_mesh_destroy(mesh);
}

enum { threads = 4, rounds = 50 };

static void *read_often(void *data)
{
    int rich = *(int *)data, good = 0;
    for (int i = 0; i < rounds; i++) {
        arrays a;
        char why[64];
        memset(&a, 0, sizeof a);
        rt_openmesh_sink sink = sink_of(&a, 3, 1);
        good += read_triangle(&sink, rich ? RICH : PLAIN, rich ? 24 : 9, why) == RT_OPENMESH_OK &&
                a.normals[0] == (rich ? 4 : 0) && a.indices[0] == 2;
    }
    *(int *)data = good;
    return NULL;
}

static void threads_do_not_disturb_each_other(void **state)
{
    (void)state;
    pthread_t ids[threads];
    int data[threads];
    for (int i = 0; i < threads; i++) {
        data[i] = i % 2;
        assert_int_equal(pthread_create(&ids[i], NULL, read_often, &data[i]), 0);
    }
    for (int i = 0; i < threads; i++)
        pthread_join(ids[i], NULL);
    for (int i = 0; i < threads; i++)
        assert_int_equal(data[i], rounds);
}

static void each_failure_of_memory_is_an_error(void **state)
{
    arrays a;
    char why[64];
    (void)state;
    rt_openmesh_sink sink = sink_of(&a, 3, 1);
    assert_int_equal(read_triangle(&sink, RICH, 24, why), RT_OPENMESH_OK); /* something is kept */
    const long before = failing_new_blocks();
    unsigned failing = 0, is_over = 0;
    while (!is_over) {
        sink = sink_of(&a, 3, 1);
        failing_new_at(++failing);
        rt_openmesh_result result = read_triangle(&sink, RICH, 24, why);
        is_over = !failing_new_failed();
        failing_new_at(0);
        assert_int_equal(result, is_over ? RT_OPENMESH_OK : RT_OPENMESH_MEMORY);
        assert_true(failing_new_blocks() <= before);
    }
    assert_int_equal(failing_new_blocks(), before);
    assert_true(failing > 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vertices_and_faces_arrive_as_they_are),
        cmocka_unit_test(one_file_does_not_colour_the_next),
        cmocka_unit_test(what_does_not_fit_is_a_failure),
        cmocka_unit_test(reading_can_be_stopped),
        cmocka_unit_test(faces_of_a_non_manifold_mesh_are_kept),
        cmocka_unit_test(threads_do_not_disturb_each_other),
        cmocka_unit_test(each_failure_of_memory_is_an_error),
    };
    return cmocka_run_group_tests_name("mesh/openmesh", tests, scratch_enter, scratch_leave);
}
