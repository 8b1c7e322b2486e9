/* test_replicates.c - the order of samples in replicates. */
#include "support.h"

#include "film/replicates.h"

/*
 * Every replicate goes through its samples without a gap, and all samples are given out, as evenly
 * as can be.
 */
static void sample_ranges_share_all_samples_evenly(void **state)
{
    (void)state;
    for (uint32_t all = 1; all < 500; all++) {
        uint32_t has[RT_REPLICATES] = {0}, given = 0;
        for (rt_sample_range s = rt_sample_range_first(all, 1); given < all;
             s = rt_sample_range_next(s)) {
            assert_true(s.replicate < RT_REPLICATES);
            assert_int_equal(s.first, s.count ? has[s.replicate] : s.first);
            has[s.replicate] += s.count;
            given += s.count;
        }
        assert_int_equal(given, all);
        for (int r = 0; r < RT_REPLICATES; r++)
            assert_true(has[r] == all / RT_REPLICATES || has[r] == all / RT_REPLICATES + 1);
    }
}

static void replicates_grow_by_powers_of_two_and_one_step_between(void **state)
{
    static const uint32_t lengths[] = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48};
    rt_sample_range s = rt_sample_range_first(1u << 24, 1);
    (void)state;
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++)
        for (uint32_t r = 0; r < RT_REPLICATES; r++, s = rt_sample_range_next(s)) {
            assert_int_equal(s.replicate, r);
            assert_int_equal(s.first + s.count, lengths[i]);
        }
}

static void one_sequence_is_one_sample_range(void **state)
{
    rt_sample_range s = rt_sample_range_first(100, 0);
    (void)state;
    assert_true(s.replicate == 0 && s.first == 0 && s.count == 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sample_ranges_share_all_samples_evenly),
        cmocka_unit_test(replicates_grow_by_powers_of_two_and_one_step_between),
        cmocka_unit_test(one_sequence_is_one_sample_range),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
