/* test_flann_index.c - FLANN behind the library's conventions finds what brute force finds. */
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/parallel.h"
#include "faults/failing_new.h"
#include "lib/photon/points.h"
#include "photon/flann_index.h"

enum { queries = 40 };

typedef enum layout { SCATTERED, ON_A_PLANE, CLUSTERED, DUPLICATED } layout;

static void place(float p[3], layout how, size_t i, points_stream *stream)
{
    for (int c = 0; c < 3; c++)
        p[c] = points_uniform(stream);
    if (how == ON_A_PLANE)
        p[1] = 0.25f;
    if (how == CLUSTERED) /* each tenth point far from the rest, which crowd at a corner */
        for (int c = 0; c < 3; c++)
            p[c] *= i % 10 ? 1e-4f : 10.0f;
    if (how == DUPLICATED) /* 27 places, so that most distances are tied */
        for (int c = 0; c < 3; c++)
            p[c] = floorf(3 * p[c]) / 3;
}

static float squared_distance(const float *a, const float *b)
{
    float x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return x * x + y * y + z * z;
}

static void assert_is_set(const int *indices, size_t k, size_t count)
{
    unsigned char *seen = calloc(count, 1);
    for (size_t i = 0; i < k; i++) {
        assert_true(indices[i] >= 0 && (size_t)indices[i] < count);
        assert_false(seen[indices[i]]);
        seen[indices[i]] = 1;
    }
    free(seen);
}

/*
 * The indices are different, every distance is that of its index, they ascend, and no nearer point
 * is left out.
 */
static void assert_nearest(const float *positions, size_t count, const float *query, size_t k,
                           const int *indices, const float *squared)
{
    float nearer = squared[k - 1] * (1 - 1e-6f);
    size_t in_all = 0, in_list = 0;

    assert_is_set(indices, k, count);
    for (size_t i = 0; i < k; i++) {
        float expected = squared_distance(positions + 3 * indices[i], query);
        assert_float_equal(squared[i], expected, 1e-6 * expected);
        assert_true(i == 0 || squared[i] >= squared[i - 1]);
        in_list += expected < nearer;
    }
    for (size_t i = 0; i < count; i++)
        in_all += squared_distance(positions + 3 * i, query) < nearer;
    assert_int_equal(in_list, in_all);
}

static void compare_with_brute_force(size_t count, size_t k, layout how)
{
    points_stream stream = {count + 1000 * k};
    float *positions = malloc(count * 3 * sizeof *positions), asked[queries][3];
    int *indices = malloc(queries * k * sizeof *indices);
    float *squared = malloc(queries * k * sizeof *squared);
    rt_flann_index *index = NULL;
    rt_error error;

    for (size_t i = 0; i < count; i++)
        place(positions + 3 * i, how, i, &stream);
    for (size_t i = 0; i < queries; i++)
        if (i % 2)
            place(asked[i], how, i, &stream);
        else
            memcpy(asked[i], positions + 3 * (i % count), sizeof asked[i]);
    expect_ok(rt_flann_index_create(&index, positions, count, NULL, &error), &error);
    expect_ok(rt_flann_index_nearest(index, asked[0], queries, k, indices, squared, &error),
              &error);
    for (size_t i = 0; i < queries; i++)
        assert_nearest(positions, count, asked[i], k, indices + i * k, squared + i * k);
    rt_flann_index_destroy(index);
    free(positions);
    free(indices);
    free(squared);
}

static void nearest_equal_brute_force(void **state)
{
    static const size_t counts[] = {1, 2, 17, 100, 1001, 20000, 100000};
    static const size_t ks[] = {1, 5, 50, 250, 251, 500, 1000};
    (void)state;
    for (size_t n = 0; n < sizeof counts / sizeof *counts; n++)
        for (size_t k = 0; k < sizeof ks / sizeof *ks; k++)
            if (ks[k] <= counts[n])
                for (layout how = SCATTERED; how <= DUPLICATED; how++)
                    compare_with_brute_force(counts[n], ks[k], how);
}

static void all_points_can_be_asked_for(void **state)
{
    (void)state;
    compare_with_brute_force(1, 1, SCATTERED);
    compare_with_brute_force(300, 300, SCATTERED);
    compare_with_brute_force(300, 300, DUPLICATED);
}

static void an_empty_set_is_an_index(void **state)
{
    rt_flann_index *index = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_flann_index_create(&index, NULL, 0, NULL, &error), &error);
    assert_non_null(index);
    rt_flann_index_destroy(index);
    rt_flann_index_destroy(NULL);
}

enum { many = 5000, jobs = 20, queries_a_job = 100, neighbours = 60 };

/* One index, asked from many threads at once. */
typedef struct shared_index {
    const rt_flann_index *index;
    const float *positions;
    int indices[jobs][queries_a_job * neighbours];
    float squared[jobs][queries_a_job * neighbours];
} shared_index;

static void ask_share(void *user, uint32_t job)
{
    shared_index *s = user;
    rt_flann_index_nearest(s->index, s->positions + 3 * job * queries_a_job, queries_a_job,
                           neighbours, s->indices[job], s->squared[job], NULL);
}

static void results_do_not_depend_on_threads(void **state)
{
    static float positions[many][3];
    static shared_index alone, together;
    points_stream stream = {7};
    rt_flann_index *index = NULL;
    rt_error error;
    (void)state;
    for (size_t i = 0; i < many; i++)
        place(positions[i], i % 2 ? SCATTERED : DUPLICATED, i, &stream);
    expect_ok(rt_flann_index_create(&index, positions[0], many, NULL, &error), &error);
    alone.index = together.index = index;
    alone.positions = together.positions = positions[0];
    rt_parallel(1, jobs, ask_share, &alone);
    rt_parallel(4, jobs, ask_share, &together);
    assert_memory_equal(alone.indices, together.indices, sizeof alone.indices);
    assert_memory_equal(alone.squared, together.squared, sizeof alone.squared);
    assert_true(alone.squared[0][2 * neighbours - 1] > 0);
    rt_flann_index_destroy(index);
}

/* Builds an index and asks it, with the call of operator new of that number failing. */
static rt_status build_and_ask(const float *positions, size_t k, unsigned failing, rt_error *error)
{
    int indices[queries * 300];
    float squared[queries * 300];
    rt_flann_index *index = NULL;
    failing_new_at(failing);
    rt_status status = rt_flann_index_create(&index, positions, many, NULL, error);
    if (status == RT_OK)
        status = rt_flann_index_nearest(index, positions, queries, k, indices, squared, error);
    rt_flann_index_destroy(index);
    return status;
}

/* For lists of both kinds: up to 250 and more. */
static void each_failure_of_memory_is_an_error(void **state)
{
    static const size_t ks[] = {60, 300};
    static float positions[many][3];
    points_stream stream = {11};
    rt_error error;
    (void)state;
    for (size_t i = 0; i < many; i++)
        place(positions[i], SCATTERED, i, &stream);
    for (size_t n = 0; n < sizeof ks / sizeof *ks; n++) {
        const long before = failing_new_blocks();
        unsigned failing = 0, is_over = 0;
        while (!is_over) {
            const rt_status status = build_and_ask(positions[0], ks[n], ++failing, &error);
            is_over = !failing_new_failed();
            assert_int_equal(status, is_over ? RT_OK : RT_ERROR_MEMORY);
            assert_true(is_over || strstr(error.message, "out of memory"));
            assert_int_equal(failing_new_blocks(), before);
        }
        failing_new_at(0);
        assert_true(failing > 20);
    }
}

static void what_it_takes_is_counted(void **state)
{
    static float positions[many][3];
    points_stream stream = {13};
    rt_flann_index *index = NULL;
    rt_memory *memory = NULL;
    rt_memory_info info;
    rt_error error;
    (void)state;
    for (size_t i = 0; i < many; i++)
        place(positions[i], SCATTERED, i, &stream);
    expect_ok(rt_memory_create(&memory, 1 << 24, &error), &error);
    expect_ok(rt_flann_index_create(&index, positions[0], many, memory, &error), &error);
    rt_memory_get_info(memory, &info);
    /* two copies of a point, its number and its pointer; and a node for each some points */
    assert_in_range(info.used, many * (2 * 12 + 12), many * (2 * 12 + 12 + 48));
    rt_flann_index_destroy(index);
    rt_memory_get_info(memory, &info);
    assert_int_equal(info.used, 0);
    rt_memory_destroy(memory);
}

/* All points are one, as where a dense medium stops light at once: as quick as of others. */
static void one_point_many_times_is_searched_quickly(void **state)
{
    enum { same = 100000, asked = 2000, k = 20 };
    static float positions[same][3], squared[asked * k];
    static int indices[asked * k];
    rt_flann_index *index = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_flann_index_create(&index, positions[0], same, NULL, &error), &error);
    const clock_t began = clock();
    expect_ok(rt_flann_index_nearest(index, positions[0], asked, k, indices, squared, &error),
              &error);
    assert_true((double)(clock() - began) / CLOCKS_PER_SEC < 2);
    assert_nearest(positions[0], same, positions[0], k, indices, squared);
    rt_flann_index_destroy(index);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nearest_equal_brute_force),
        cmocka_unit_test(all_points_can_be_asked_for),
        cmocka_unit_test(an_empty_set_is_an_index),
        cmocka_unit_test(results_do_not_depend_on_threads),
        cmocka_unit_test(each_failure_of_memory_is_an_error),
        cmocka_unit_test(what_it_takes_is_counted),
        cmocka_unit_test(one_point_many_times_is_searched_quickly),
    };
    return cmocka_run_group_tests_name("lib/photon/flann_index", tests, NULL, NULL);
}
