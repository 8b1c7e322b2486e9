/* test_memory.c - counting memory against a limit. */
#include "base/memory.h"

#include <stdio.h>
#include <string.h>

#include "base/parallel.h"
#include "support.h"

static rt_memory *new_memory(uint64_t limit)
{
    rt_memory *memory = NULL;
    rt_error error;
    expect_ok(rt_memory_create(&memory, limit, &error), &error);
    return memory;
}

static uint64_t used(const rt_memory *memory)
{
    rt_memory_info info;
    rt_memory_get_info(memory, &info);
    return info.used;
}

static void expect_refused(rt_status status, const rt_error *error, const char *message)
{
    assert_int_equal(status, RT_ERROR_MEMORY);
    assert_int_equal(error->status, RT_ERROR_MEMORY);
    assert_string_equal(error->message, message);
}

/* The message tells what needs how much, the limit, and what is in use beside it. */
static void what_exceeds_the_limit_is_refused_and_told(void **state)
{
    rt_memory *memory = new_memory(UINT64_C(2) << 30);
    rt_memory_info info;
    rt_error error;
    (void)state;
    expect_refused(rt_memory_take(memory, UINT64_C(1) << 41, "the moon", &error), &error,
                   "the moon needs 2 TiB, more than the limit of 2 GiB");
    expect_refused(rt_memory_take(memory, (UINT64_C(2) << 30) + 5, "a moon", &error), &error,
                   "a moon needs 2147483653 bytes, more than the limit of 2 GiB");
    expect_ok(rt_memory_take(memory, 429496730, "the scene", &error), &error);
    expect_refused(rt_memory_take(memory, UINT64_C(3435973837), "the photon map", &error), &error,
                   "the photon map needs 3.2 GiB, more than the limit of 2 GiB with 410 MiB in "
                   "use");
    assert_int_equal(rt_memory_foresee(memory, 1e300, "the film", NULL), RT_ERROR_MEMORY);
    expect_ok(rt_memory_foresee(memory, 1, "the film", &error), &error);
    expect_ok(rt_memory_take(memory, (UINT64_C(2) << 30) - 429496730, "the rest", &error), &error);
    expect_refused(rt_memory_take(memory, 1, "a byte", &error), &error,
                   "a byte needs 1 byte, more than the limit of 2 GiB with 2 GiB in use");
    rt_memory_give(memory, 429496730, "the scene");
    rt_memory_get_info(memory, &info);
    assert_true(info.used == (UINT64_C(2) << 30) - 429496730 && info.most == UINT64_C(2) << 30 &&
                info.limit == UINT64_C(2) << 30);
    rt_memory_give(memory, info.used, "the rest");
    rt_memory_destroy(memory);
}

static void without_a_limit_all_is_counted_and_nothing_refused(void **state)
{
    rt_memory *memory = new_memory(0);
    rt_error error;
    (void)state;
    expect_ok(rt_memory_take(memory, UINT64_C(1) << 60, "much", &error), &error);
    assert_true(used(memory) == UINT64_C(1) << 60);
    rt_memory_give(memory, UINT64_C(1) << 60, "much");
    expect_ok(rt_memory_take(memory, 5, "little", &error), &error);
    expect_ok(rt_memory_take(memory, 100, "another", &error), &error);
    rt_memory_give(memory, 9, "little");
    rt_memory_give(memory, 1, "nobody");
    assert_true(used(memory) == 100);
    rt_memory_owner owners[4];
    assert_int_equal(rt_memory_get_owners(memory, owners, 4), 3);
    assert_string_equal(owners[2].what, "another");
    expect_refused(rt_memory_take(memory, UINT64_MAX, "all", &error), &error,
                   "all needs 16 EiB, more than can be counted");
    rt_memory_give(memory, 100, "another");
    rt_memory_destroy(memory);
    expect_ok(rt_memory_take(NULL, UINT64_MAX, "nowhere", &error), &error);
    rt_memory_give(NULL, UINT64_MAX, "nothing");
    rt_memory_destroy(NULL);
}

static void blocks_count_until_they_are_freed(void **state)
{
    rt_memory *memory = new_memory(10000);
    rt_error error;
    (void)state;
    unsigned char *zero = rt_memory_zeroed(memory, 1000, 2, "zeros", &error);
    unsigned char *block = rt_memory_alloc(memory, 100, 10, "a block", &error);
    assert_true(zero && block && used(memory) >= 3000 && used(memory) < 3200);
    for (int i = 0; i < 2000; i++)
        assert_int_equal(zero[i], 0);
    memset(block, 7, 1000);
    assert_null(rt_memory_resize(memory, block, 9000, 1, "a block", &error));
    expect_refused(error.status, &error,
                   "a block needs 8.82 KiB, more than the limit of 9.77 KiB with 1.98 KiB in use");
    block = rt_memory_resize(memory, block, 5000, 1, "a block", &error);
    assert_true(block && block[999] == 7 && used(memory) >= 7000);
    block = rt_memory_resize(memory, block, 1, 1, "a block", &error);
    assert_true(block && block[0] == 7 && used(memory) < 2200);
    rt_memory_free(block);
    rt_memory_free(zero);
    rt_memory_free(NULL);
    assert_int_equal(used(memory), 0);
    rt_memory_destroy(memory);
}

/* Nothing of a request that no size_t holds is taken. */
static void requests_beyond_all_memory_are_refused(void **state)
{
    rt_memory *memory = new_memory(0);
    rt_error error;
    (void)state;
    assert_null(rt_memory_alloc(memory, SIZE_MAX, SIZE_MAX, "too much", &error));
    assert_int_equal(error.status, RT_ERROR_MEMORY);
    assert_null(rt_memory_alloc(memory, SIZE_MAX / 2, 1, "too much", &error));
    assert_int_equal(error.status, RT_ERROR_MEMORY);
    assert_null(rt_memory_alloc(NULL, SIZE_MAX / 2, 1, "too much", &error));
    assert_non_null(strstr(error.message, "out of memory: too much needs"));
    assert_int_equal(used(memory), 0);
    rt_memory_destroy(memory);
}

/* By half as much again where there is room for it; near the limit by less, up to the last byte. */
static void an_array_grows_up_to_the_limit(void **state)
{
    rt_memory *memory = new_memory(100000);
    rt_error error;
    uint32_t *array = NULL;
    size_t room = 0, count = 0, steps = 0, before = 0;
    (void)state;
    while (rt_memory_grow(memory, (void **)&array, &room, count + 1, sizeof *array, "it", &error) ==
           RT_OK) {
        array[count] = (uint32_t)count;
        count++;
        steps += room != before;
        before = room;
    }
    assert_true(4 * count > 99900 && 4 * count <= 100000 && steps < 200);
    assert_non_null(strstr(error.message, " KiB, more than the limit of 97.6562 KiB"));
    for (size_t i = 0; i < count; i++)
        assert_int_equal(array[i], i);
    rt_memory_free(array);
    assert_int_equal(used(memory), 0);
    rt_memory_destroy(memory);
}

/* What is given back last frees it, should a driver be late. */
static void it_may_be_destroyed_before_all_is_given_back(void **state)
{
    rt_memory *memory = new_memory(1000);
    rt_error error;
    (void)state;
    void *block = rt_memory_alloc(memory, 10, 10, "a block", &error);
    expect_ok(rt_memory_take(memory, 5, "a bit", &error), &error);
    rt_memory_destroy(memory);
    rt_memory_free(block);
    rt_memory_give(memory, 5, "a bit");
}

/* The limit holds for what is added later; the last of those that were given it ends it. */
static void it_may_be_destroyed_before_what_was_given_it(void **state)
{
    rt_memory *memory = new_memory(400);
    rt_scene *scenes[2];
    rt_error error;
    (void)state;
    for (int i = 0; i < 2; i++) {
        expect_ok(rt_scene_create(scenes + i, &error), &error);
        rt_scene_set_memory(scenes[i], memory);
        rt_scene_set_memory(scenes[i], memory);
    }
    rt_memory_destroy(memory);
    rt_scene_destroy(scenes[0]);
    rt_memory_drop(rt_memory_hold(memory)); /* it is still there */
    const rt_material white = {.kd = {1, 1, 1}};
    rt_status status = RT_OK;
    for (int i = 0; i < 100 && status == RT_OK; i++)
        status = rt_scene_add_material(scenes[1], NULL, NULL, &white, &error);
    assert_int_equal(status, RT_ERROR_MEMORY);
    assert_non_null(strstr(error.message, "more than the limit of 400 bytes"));
    rt_scene_destroy(scenes[1]);
}

/* Each by its name; the shares of the peak are those of the moment, not the owners' own peaks. */
static void owners_are_told_apart(void **state)
{
    rt_memory *memory = new_memory(0);
    rt_memory_owner owners[3];
    rt_error error;
    (void)state;
    expect_ok(rt_memory_take(memory, 100, "the scene", &error), &error);
    expect_ok(rt_memory_take(memory, 300, "the film", &error), &error);
    rt_memory_give(memory, 60, "the scene");
    void *block = rt_memory_alloc(memory, 500, 1, "the photon map", &error);
    rt_memory_give(memory, 300, "the film");
    assert_int_equal(rt_memory_get_owners(memory, NULL, 0), 3);
    assert_int_equal(rt_memory_get_owners(memory, owners, 3), 3);
    assert_string_equal(owners[0].what, "the scene");
    assert_true(owners[0].used == 40 && owners[0].most == 100 && owners[0].at_most == 40);
    assert_string_equal(owners[1].what, "the film");
    assert_true(owners[1].used == 0 && owners[1].most == 300 && owners[1].at_most == 300);
    assert_string_equal(owners[2].what, "the photon map");
    assert_true(owners[2].used >= 500 && owners[2].at_most == owners[2].used);
    rt_memory_free(block);
    rt_memory_give(memory, 40, "the scene");
    rt_memory_destroy(memory);
}

/* Those beyond the 64th count as one, and no byte is lost. */
static void very_many_owners_share_a_place(void **state)
{
    rt_memory *memory = new_memory(0);
    rt_memory_owner owners[65];
    rt_error error;
    char name[24];
    (void)state;
    for (int i = 0; i < 100; i++) {
        snprintf(name, sizeof name, "owner %d", i);
        expect_ok(rt_memory_take(memory, 10, name, &error), &error);
    }
    assert_int_equal(rt_memory_get_owners(memory, owners, 65), 64);
    assert_string_equal(owners[62].what, "owner 62");
    assert_string_equal(owners[63].what, "others");
    assert_true(owners[63].used == 370 && used(memory) == 1000);
    for (int i = 0; i < 100; i++) {
        snprintf(name, sizeof name, "owner %d", i);
        rt_memory_give(memory, 10, name);
    }
    rt_memory_get_owners(memory, owners, 64);
    assert_true(owners[0].used == 0 && owners[63].used == 0 && used(memory) == 0);
    rt_memory_destroy(memory);
}

static void take_and_give(void *user, uint32_t index)
{
    rt_memory *memory = user;
    rt_error error;
    for (uint32_t i = 0; i < 2000; i++) {
        void *block = rt_memory_alloc(memory, index + 1, 8, "a block", &error);
        rt_memory_free(block);
    }
}

static void threads_share_it(void **state)
{
    rt_memory *memory = new_memory(300);
    rt_memory_info info;
    (void)state;
    rt_parallel(8, 64, take_and_give, memory);
    rt_memory_get_info(memory, &info);
    assert_true(info.used == 0 && info.most > 0 && info.most <= 300);
    rt_memory_destroy(memory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_exceeds_the_limit_is_refused_and_told),
        cmocka_unit_test(without_a_limit_all_is_counted_and_nothing_refused),
        cmocka_unit_test(blocks_count_until_they_are_freed),
        cmocka_unit_test(requests_beyond_all_memory_are_refused),
        cmocka_unit_test(an_array_grows_up_to_the_limit),
        cmocka_unit_test(owners_are_told_apart),
        cmocka_unit_test(very_many_owners_share_a_place),
        cmocka_unit_test(it_may_be_destroyed_before_all_is_given_back),
        cmocka_unit_test(it_may_be_destroyed_before_what_was_given_it),
        cmocka_unit_test(threads_share_it),
    };
    return cmocka_run_group_tests_name("lib/base/memory", tests, NULL, NULL);
}
