/* test_photon_list.c - a map is its paths' photons, one path after the other. */
#include "support.h"

#include <math.h>
#include <string.h>

#include "photon/photon_list.h"

enum { slots_per_path = 4, path_count = 10000 };

/* Path i leaves i % 5 photons at most slots_per_path, numbered by path and slot. */
static void fill(rt_photon slots[path_count * slots_per_path], rt_path_account counts[path_count])
{
    memset(slots, 0, path_count * slots_per_path * sizeof *slots);
    for (rt_u32 i = 0; i < path_count; i++) {
        counts[i].photons = i % (slots_per_path + 1);
        for (rt_u32 j = 0; j < slots_per_path; j++) {
            slots[j * path_count + i].path = i;
            slots[j * path_count + i].flags = j;
        }
    }
}

static void photons_follow_in_the_order_of_paths(void **state)
{
    static rt_photon slots[path_count * slots_per_path];
    static rt_path_account counts[path_count];
    rt_photon_list whole = {0}, parts = {0};
    rt_error error;
    size_t at = 0;
    (void)state;
    fill(slots, counts);
    expect_ok(rt_photon_list_append(&whole, slots, path_count, counts, path_count, 2, &error),
              &error);
    for (rt_u32 i = 0; i < path_count; i++)
        for (rt_u32 j = 0; j < counts[i].photons; j++, at++) {
            assert_int_equal(whole.photons[at].path, i);
            assert_int_equal(whole.photons[at].flags, j);
        }
    assert_int_equal(whole.count, at);
    assert_int_equal(whole.emitted, path_count);

    /* Appending part by part makes the same map. */
    for (size_t first = 0; first < path_count; first += 2500)
        expect_ok(rt_photon_list_append(&parts, slots + first, path_count, counts + first, 2500, 1,
                                        &error),
                  &error);
    assert_int_equal(parts.count, whole.count);
    assert_memory_equal(parts.photons, whole.photons, whole.count * sizeof *whole.photons);
    rt_photon_list_clear(&parts);
    rt_photon_list_clear(&whole);
    assert_int_equal(whole.count, 0);
    assert_null(whole.photons);
}

static void photons_left_out_are_counted(void **state)
{
    static rt_photon slots[path_count * slots_per_path];
    static rt_path_account counts[path_count];
    rt_photon_list map = {0};
    rt_error error;
    (void)state;
    fill(slots, counts);
    counts[1].rejected = 1;
    counts[5000].rejected = 2;
    expect_ok(rt_photon_list_append(&map, slots, path_count, counts, path_count, 2, &error),
              &error);
    assert_int_equal(map.rejected, 3);
    assert_int_equal(map.count, 2 * path_count);
    rt_photon_list_clear(&map);
}

static void numbers_that_are_not_finite_are_seen(void **state)
{
    rt_photon photon;
    (void)state;
    memset(&photon, 0, sizeof photon);
    assert_true(rt_photon_is_finite(&photon));
    float *const members[] = {photon.position + 2, photon.wi, photon.flux + 1, &photon.shading,
                              photon.normal + 2};
    for (size_t i = 0; i < sizeof members / sizeof *members; i++) {
        *members[i] = NAN;
        assert_false(rt_photon_is_finite(&photon));
        *members[i] = -INFINITY;
        assert_false(rt_photon_is_finite(&photon));
        *members[i] = 1;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(photons_follow_in_the_order_of_paths),
        cmocka_unit_test(photons_left_out_are_counted),
        cmocka_unit_test(numbers_that_are_not_finite_are_seen),
    };
    return cmocka_run_group_tests_name("lib/photon/photon_list", tests, NULL, NULL);
}
