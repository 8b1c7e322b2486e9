/*
 * test_tree_builder.c - the tree that the device builds has the bytes of the one that the host
 * builds, whatever the photons; and prefix sums and sums of accounts are those of a loop.
 */
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/photon/points.h"
#include "photon/photon_tree.h"
#include "photon/path_sums.h"
#include "photon/gather_tree.h"
#include "photon/tree_builder.h"

/* How photons lie. */
typedef enum lie { EVENLY, IN_A_POINT, ON_A_LINE, FAR_OUT, IN_CLUSTERS } lie;

static void place(float position[3], lie how, points_stream *stream)
{
    float u[3];
    for (int axis = 0; axis < 3; axis++)
        u[axis] = points_uniform(stream);
    for (int axis = 0; axis < 3; axis++)
        switch (how) {
        case EVENLY:
            position[axis] = 4 * u[axis] - 2;
            break;
        case IN_A_POINT:
            position[axis] = 0.3f;
            break;
        case ON_A_LINE:
            position[axis] = axis == 1 ? u[axis] : -0.0f;
            break;
        case FAR_OUT: /* one in 64 lies up to 10^12 m away */
            position[axis] = u[0] < 1.0f / 64 ? 1e12f * (u[axis] - 0.5f) : u[axis];
            break;
        case IN_CLUSTERS: /* few different places: ties keep the order of the list */
            position[axis] = floorf(3 * u[axis]) + 1e-7f * floorf(2 * u[(axis + 1) % 3]);
            break;
        }
}

static rt_photon_list make_list(size_t count, lie how)
{
    rt_photon_list list = {.photons = calloc(count ? count : 1, sizeof(rt_photon)),
                           .count = count,
                           .capacity = count,
                           .emitted = count};
    points_stream stream = {count};
    assert_non_null(list.photons);
    for (size_t i = 0; i < count; i++) {
        rt_photon *p = list.photons + i;
        place(p->position, how, &stream);
        p->normal[i % 3] = 1;
        p->wi[i % 3] = 1;
        p->flux[i % 3] = points_uniform(&stream);
        p->shading = 1 + points_uniform(&stream);
    }
    return list;
}

/* Builds a tree on the device, and fails unless it is that of the host. */
static void check_tree(rt_tree_builder *builder, size_t count, lie how)
{
    rt_device *device = test_device();
    rt_photon_list list = make_list(count, how);
    rt_photon_tree_data tree;
    rt_photon_tree shape;
    cl_mem photons, nodes, blocks;
    size_t node_count;
    rt_error error;
    expect_ok(rt_photon_tree_build(&tree, &list, 2, NULL, &error), &error);
    expect_ok(rt_photon_tree_lay_out(&shape, &node_count, count, &error), &error);
    assert_memory_equal(&shape, &tree.shape, sizeof shape);
    assert_int_equal(node_count, tree.node_count);

    const size_t node_bytes = node_count * sizeof *tree.nodes,
                 block_bytes = shape.block_count * sizeof *tree.blocks;
    char *read = calloc(node_bytes + block_bytes + 1, 1);
    assert_non_null(read);
    expect_ok(rt_buffer_create(device, &photons, CL_MEM_READ_ONLY, count * sizeof *list.photons,
                               count ? list.photons : NULL, "photons", &error),
              &error);
    expect_ok(
        rt_buffer_create(device, &nodes, CL_MEM_READ_WRITE, node_bytes, NULL, "nodes", &error),
        &error);
    expect_ok(
        rt_buffer_create(device, &blocks, CL_MEM_READ_WRITE, block_bytes, NULL, "blocks", &error),
        &error);
    expect_ok(rt_tree_builder_run(builder, photons, &shape, node_count, nodes, blocks, &error),
              &error);
    expect_ok(rt_buffer_read(device, nodes, 0, node_bytes, read, &error), &error);
    expect_ok(rt_buffer_read(device, blocks, 0, block_bytes, read + node_bytes, &error), &error);
    if (count > 0 && memcmp(read, tree.nodes, node_bytes) != 0)
        fail_msg("the nodes of %zu photons differ, of kind %d", count, (int)how);
    if (count > 0 && memcmp(read + node_bytes, tree.blocks, block_bytes) != 0)
        fail_msg("the blocks of %zu photons differ, of kind %d", count, (int)how);
    rt_buffer_release(device, photons);
    rt_buffer_release(device, nodes);
    rt_buffer_release(device, blocks);
    free(read);
    free(list.photons);
    rt_photon_tree_free(&tree);
}

static void device_tree_has_the_bytes_of_the_host_tree(void **state)
{
    static const size_t counts[] = {0, 1, 7, 8, 9, 63, 64, 65, 513, 5000, 120000};
    rt_tree_builder builder;
    rt_error error;
    (void)state;
    expect_ok(rt_tree_builder_create(&builder, test_device(), &error), &error);
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        for (int how = EVENLY; how <= IN_CLUSTERS; how++)
            if (counts[i] < 100000 || how == EVENLY || how == FAR_OUT)
                check_tree(&builder, counts[i], (lie)how);
    rt_tree_builder_release(&builder);
}

static void note_host(void *user, const char *line)
{
    *(int *)user += strstr(line, "built on the host: the device has no room") != NULL;
}

/* A device for which every buffer of the builder is too large. */
static void a_tree_without_room_is_built_on_the_host(void **state)
{
    rt_device *device = test_device(), full = *device;
    rt_photon_list list = make_list(5000, EVENLY), on = list;
    const rt_density_params estimate = {.k = 20, .squared_limit = 1};
    int notes = 0;
    const rt_hooks hooks = {.log = note_host, .user = &notes};
    rt_tree_builder builder;
    rt_tree_place place = {.builder = &builder};
    rt_photon_tree_data tree;
    rt_tree_gather gather;
    rt_error error;
    (void)state;
    expect_ok(rt_photon_tree_build(&tree, &list, 2, NULL, &error), &error);
    on.photons = NULL;
    on.device = device;
    expect_ok(rt_buffer_create(device, &on.buffer, CL_MEM_READ_ONLY, 5000 * sizeof *list.photons,
                               list.photons, "photons", &error),
              &error);
    expect_ok(rt_tree_builder_create(&builder, device, &error), &error);
    full.info.largest_buffer = 1;
    for (int has_room = 0; has_room < 2; has_room++) {
        size_t capacity = 100;
        builder.sorter.device = has_room ? device : &full;
        notes = 0;
        expect_ok(rt_tree_gather_prepare(&gather, device, &on, &estimate, &place, &capacity, &hooks,
                                         &error),
                  &error);
        assert_int_equal(notes, !has_room);
        assert_int_equal(capacity, 100);
        assert_memory_equal(&gather.tree.shape, &tree.shape, sizeof tree.shape);
        if (!has_room && device->info.is_cpu)
            assert_memory_equal(gather.tree.nodes, tree.nodes,
                                tree.node_count * sizeof *tree.nodes);
        rt_tree_gather_release(&gather, device);
        rt_tree_place_release(&place, device);
    }
    builder.sorter.device = device;
    rt_tree_builder_release(&builder);
    rt_buffer_release(device, on.buffer);
    rt_photon_tree_free(&tree);
    free(list.photons);
}

static void prefix_sums_are_those_of_a_loop(void **state)
{
    static const size_t counts[] = {1, 2, 63, 64, 65, 4096, 4097, 300000};
    rt_device *device = test_device();
    rt_prefix_sum prefix;
    rt_error error;
    (void)state;
    expect_ok(rt_prefix_sum_create(&prefix, device, &error), &error);
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        const size_t count = counts[i], room = rt_prefix_sum_room(count);
        rt_u32 *numbers = calloc(room, 2 * sizeof *numbers), *sums = numbers + room, sum = 0;
        points_stream stream = {i};
        cl_mem table;
        assert_non_null(numbers);
        for (size_t j = 0; j < count; j++)
            numbers[j] = (rt_u32)(100 * points_uniform(&stream));
        expect_ok(rt_buffer_create(device, &table, CL_MEM_READ_WRITE, room * sizeof *numbers,
                                   numbers, "a table", &error),
                  &error);
        expect_ok(rt_prefix_sum_run(&prefix, table, count, &error), &error);
        expect_ok(rt_buffer_read(device, table, 0, count * sizeof *sums, sums, &error), &error);
        for (size_t j = 0; j < count; sum += numbers[j++])
            if (sums[j] != sum)
                fail_msg("number %zu of %zu: %u instead of %u", j, count, sums[j], sum);
        rt_buffer_release(device, table);
        free(numbers);
    }
    rt_prefix_sum_release(&prefix);
}

/* ---- Accounts ------------------------------------------------------------------------ */

/* Flux of all magnitudes, some of it at a half of a unit. */
static float make_flux(points_stream *stream, int32_t exponent)
{
    const float u = points_uniform(stream), sign = points_uniform(stream) < 0.3f ? -1.0f : 1.0f;
    const int kind = (int)(6 * points_uniform(stream));
    if (kind == 0)
        return sign * (float)ldexp((int)(4 * u) + 0.5, exponent);
    if (kind == 1)
        return u < 0.5f ? 0.0f : sign * 1e-42f;
    return sign * (float)ldexp(u, exponent + (int)(50 * points_uniform(stream)) - 4);
}

static void make_account(rt_path_account *a, const int32_t exponents[2], points_stream *stream)
{
    const float u = points_uniform(stream);
    a->light = u < 0.1f ? RT_NONE : u < 0.5f ? 0 : u < 0.7f ? 1 : 2;
    const int32_t exponent = exponents[a->light == 2];
    for (int c = 0; c < 3; c++) {
        a->emitted[c] = make_flux(stream, exponent);
        a->absorbed[c] = make_flux(stream, exponent);
        a->left[c] = make_flux(stream, exponent);
        a->roulette[c] = make_flux(stream, exponent);
    }
    a->end = (rt_u32)(3 * points_uniform(stream));
    a->photons = (rt_u32)(20 * points_uniform(stream));
    a->rejected = points_uniform(stream) < 0.01f;
    if (points_uniform(stream) < 0.01f)
        a->left[1] = points_uniform(stream) < 0.5f ? NAN : INFINITY;
}

/* Books accounts by their sums and one by one, and fails unless the ledgers are the same. */
static void check_accounts(const rt_light_sources *lights, size_t paths)
{
    const int32_t exponents[2] = {rt_ledger_exponent(lights->sources),
                                  rt_ledger_exponent(lights->sources + 1)};
    rt_device *device = test_device();
    rt_path_account *accounts = calloc(paths, sizeof *accounts);
    rt_u64 photons = 0, rejected = 0;
    points_stream stream = {paths};
    rt_ledger by_sums, one_by_one;
    const rt_i64 *rows;
    rt_path_sums sums;
    cl_mem buffer;
    rt_error error;
    assert_non_null(accounts);
    for (size_t i = 0; i < paths; i++) {
        make_account(accounts + i, exponents, &stream);
        photons += accounts[i].photons;
        rejected += accounts[i].rejected;
    }
    expect_ok(rt_buffer_create(device, &buffer, CL_MEM_READ_ONLY, paths * sizeof *accounts,
                               accounts, "accounts", &error),
              &error);
    expect_ok(rt_ledger_create(&by_sums, lights, &error), &error);
    expect_ok(rt_ledger_create(&one_by_one, lights, &error), &error);
    expect_ok(rt_path_sums_create(&sums, device, lights, paths, &error), &error);
    expect_ok(rt_ledger_book(&one_by_one, lights, accounts, paths, 2, &error), &error);
    expect_ok(rt_path_sums_run(&sums, &rows, buffer, paths, 1, &error), &error);
    rt_ledger_book_sums(&by_sums, rows, paths);
    assert_true((rt_u64)rows[RT_TOTAL_PHOTONS] == photons);
    assert_true((rt_u64)rows[RT_TOTAL_REJECTED] == rejected);
    assert_memory_equal(by_sums.rows, one_by_one.rows, lights->count * sizeof *by_sums.rows);
    assert_true(by_sums.paths == paths && by_sums.rejected == one_by_one.rejected);
    expect_ok(rt_path_sums_run(&sums, &rows, buffer, paths, 0, &error), &error);
    assert_true((rt_u64)rows[RT_TOTAL_PHOTONS] == photons);
    rt_path_sums_release(&sums);
    rt_ledger_free(&by_sums);
    rt_ledger_free(&one_by_one);
    rt_buffer_release(device, buffer);
    free(accounts);
}

static void sums_of_accounts_make_the_ledger_of_the_accounts(void **state)
{
    static const size_t counts[] = {1, 63, 65, 4097, 30000};
    rt_u32 of_light[3] = {0, 0, 1};
    rt_light_source sources[2] = {{RT_NONE, 0, 2, {3, 2, 1}, 0.7}, {1, 2, 1, {1e-4, 0, 2e-3}, 0.3}};
    const rt_light_sources lights = {
        .sources = sources, .count = 2, .of_light = of_light, .light_count = 3};
    (void)state;
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        check_accounts(&lights, counts[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(device_tree_has_the_bytes_of_the_host_tree),
        cmocka_unit_test(a_tree_without_room_is_built_on_the_host),
        cmocka_unit_test(prefix_sums_are_those_of_a_loop),
        cmocka_unit_test(sums_of_accounts_make_the_ledger_of_the_accounts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
