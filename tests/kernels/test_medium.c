/* test_medium.c - nested solids, and what their media absorb. */
#include "support.h"

#include <math.h>
#include <string.h>

#include "types.h"

/*
 * Boundaries crossed in turn, by materials of index 1.1 + material / 10 and priority 0, 0, 1, 2, 0,
 * 0, of which the last one has a relative index.
 */
static void cross(const uint32_t (*steps)[2], uint32_t count, float (*out)[4])
{
    static const rt_u32 priorities[6] = {0, 0, 1, 2, 0, 0};
    struct {
        rt_scene_header header;
        rt_material_data materials[6];
    } scene;
    memset(&scene, 0, sizeof scene);
    scene.header.materials = sizeof scene.header / RT_SCENE_ROW;
    for (int i = 0; i < 6; i++) {
        scene.materials[i].ior = 1.1f + (float)i / 10;
        scene.materials[i].priority = priorities[i];
    }
    scene.materials[5].flags = RT_MATERIAL_RELATIVE;
    cl_kernel kernel = test_kernel("medium", "cross_boundaries");
    cl_mem s = test_buffer(sizeof scene, &scene), in = test_buffer(count * sizeof *steps, steps);
    cl_mem made = test_buffer(count * sizeof *out, NULL);
    rt_arg args[] = {RT_ARG(s), RT_ARG(count), RT_ARG(in), RT_ARG(made)};
    test_run(kernel, args, 4, 1);
    test_read(made, count * sizeof *out, out);
    rt_buffer_release(test_device(), s);
    rt_buffer_release(test_device(), in);
    rt_buffer_release(test_device(), made);
    rt_kernel_release(kernel);
}

static void expect_crossing(const float made[4], double eta, int exists, int medium)
{
    assert_float_equal(made[0], eta, 1e-6);
    assert_int_equal((int)made[1], exists);
    assert_int_equal((int)made[2], medium);
}

static void solids_nest_and_overlap_by_priority(void **state)
{
    /* Into 2, into 0 which it hides, out of 2 into 0, out of 0. */
    static const uint32_t overlap[4][2] = {{2, 1}, {0, 1}, {2, 0}, {0, 0}};
    /* Into 0, a bubble of 1 in it, out of both. */
    static const uint32_t bubble[4][2] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    float made[4][4];
    (void)state;
    cross(overlap, 4, made);
    expect_crossing(made[0], 1 / 1.3, 1, 2);
    expect_crossing(made[1], 1, 0, 2);
    expect_crossing(made[2], 1.3 / 1.1, 1, 0);
    expect_crossing(made[3], 1.1, 1, -1);
    cross(bubble, 4, made);
    expect_crossing(made[0], 1 / 1.1, 1, 0);
    expect_crossing(made[1], 1.1 / 1.2, 1, 1);
    expect_crossing(made[2], 1.2 / 1.1, 1, 0);
    expect_crossing(made[3], 1.1, 1, -1);
}

static void a_path_that_starts_inside_leaves_as_from_that_solid(void **state)
{
    static const uint32_t steps[2][2] = {{3, 0}, {3, 1}};
    float made[2][4];
    (void)state;
    cross(steps, 2, made);
    expect_crossing(made[0], 1.4, 1, -1);
    expect_crossing(made[1], 1 / 1.4, 1, 3);
}

static void the_fifth_solid_makes_the_last_forgotten(void **state)
{
    static const uint32_t steps[8][2] = {{0, 1}, {1, 1}, {2, 1}, {3, 1},
                                         {4, 1}, {3, 0}, {2, 0}, {4, 0}};
    float made[8][4];
    (void)state;
    cross(steps, 8, made);
    expect_crossing(made[3], 1.3 / 1.4, 1, 3);
    expect_crossing(made[4], 1, 0, 3);
    expect_crossing(made[5], 1.4 / 1.3, 1, 2);
    expect_crossing(made[6], 1.3 / 1.5, 1, 4);
    expect_crossing(made[7], 1.5 / 1.2, 1, 1);
}

/*
 * The index 1.6 is over that outside, in 0 as in the air, and the boundary is there inside of its
 * own material, too, and below another; a higher priority hides it.
 */
static void a_relative_index_holds_whatever_lies_outside(void **state)
{
    static const uint32_t nested[6][2] = {{0, 1}, {5, 1}, {5, 1}, {5, 0}, {5, 0}, {0, 0}},
                          crossed[4][2] = {{5, 1}, {0, 1}, {5, 0}, {0, 0}},
                          hidden[4][2] = {{2, 1}, {5, 1}, {5, 0}, {2, 0}};
    float made[6][4];
    (void)state;
    cross(nested, 6, made);
    expect_crossing(made[1], 1 / 1.6, 1, 5);
    expect_crossing(made[2], 1 / 1.6, 1, 5);
    expect_crossing(made[3], 1.6, 1, 5);
    expect_crossing(made[4], 1.6, 1, 0);
    expect_crossing(made[5], 1.1, 1, -1);
    cross(crossed, 4, made);
    expect_crossing(made[0], 1 / 1.6, 1, 5);
    expect_crossing(made[1], 1.6 / 1.1, 1, 0);
    expect_crossing(made[2], 1.6, 1, 0);
    expect_crossing(made[3], 1.1, 1, -1);
    cross(hidden, 4, made);
    assert_int_equal((int)made[1][1], 0);
    assert_int_equal((int)made[2][1], 0);
    expect_crossing(made[3], 1.3, 1, -1);
}

static void absorption_follows_beer_and_lambert(void **state)
{
    enum { count = 5 };
    static const float distances[count] = {0, 0.25f, 1, 7, INFINITY}, absorption[3] = {0, 0.5f, 3};
    struct {
        rt_scene_header header;
        rt_material_data material;
    } scene;
    float out[count][4];
    uint32_t number = count;
    (void)state;
    memset(&scene, 0, sizeof scene);
    scene.header.materials = sizeof scene.header / RT_SCENE_ROW;
    memcpy(scene.material.absorption, absorption, sizeof absorption);
    cl_kernel kernel = test_kernel("medium", "transmit");
    cl_mem s = test_buffer(sizeof scene, &scene), in = test_buffer(sizeof distances, distances);
    cl_mem made = test_buffer(sizeof out, NULL);
    rt_arg args[] = {RT_ARG(s), RT_ARG(number), RT_ARG(in), RT_ARG(made)};
    test_run(kernel, args, 4, count);
    test_read(made, sizeof out, out);
    for (int i = 0; i < count; i++)
        for (int c = 0; c < 3; c++)
            assert_float_equal(out[i][c],
                               absorption[c] > 0 ? exp(-absorption[c] * distances[i]) : 1, 1e-6);
    rt_buffer_release(test_device(), s);
    rt_buffer_release(test_device(), in);
    rt_buffer_release(test_device(), made);
    rt_kernel_release(kernel);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solids_nest_and_overlap_by_priority),
        cmocka_unit_test(a_path_that_starts_inside_leaves_as_from_that_solid),
        cmocka_unit_test(the_fifth_solid_makes_the_last_forgotten),
        cmocka_unit_test(a_relative_index_holds_whatever_lies_outside),
        cmocka_unit_test(absorption_follows_beer_and_lambert),
    };
    return cmocka_run_group_tests_name("kernels/medium", tests, NULL, NULL);
}
