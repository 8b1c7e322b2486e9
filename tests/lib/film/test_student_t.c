/* test_student_t.c - quantiles of Student's t against the tables. */
#include "support.h"

#include <math.h>

#include "film/student_t.h"

/* The 0.975 and 0.95 quantiles, to the digits of the usual tables. */
static void quantiles_are_those_of_the_tables(void **state)
{
    static const struct {
        double freedom, both_sides, one_side;
    } rows[] = {{1, 12.7062, 6.3138}, {2, 4.3027, 2.9200},  {3, 3.1824, 2.3534},
                {4, 2.7764, 2.1318},  {7, 2.3646, 1.8946},  {10, 2.2281, 1.8125},
                {30, 2.0423, 1.6973}, {1e9, 1.9600, 1.6449}};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        assert_float_equal(rt_student_t_quantile(RT_NORMAL_BOTH_SIDES, rows[i].freedom) /
                               rows[i].both_sides,
                           1, 2e-3);
        assert_float_equal(
            rt_student_t_quantile(RT_NORMAL_ONE_SIDE, rows[i].freedom) / rows[i].one_side, 1, 2e-3);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(quantiles_are_those_of_the_tables)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
