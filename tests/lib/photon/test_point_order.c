/*
 * test_point_order.c - the order has every photon once and keeps neighbours together, however far
 * away some photons are.
 */
#include "support.h"

#include <math.h>
#include <string.h>

#include "lib/photon/points.h"
#include "photon/photon_list.h"
#include "photon/point_order.h"

enum { count = 20000 };

static uint64_t items[count], spare[count];
static rt_photon photons[count];

/*
 * Photons on a square of 1 m, but for each `far_out`-th, which lies up to 10^6 m away in its plane.
 */
static rt_photon_list make_photons(int far_out)
{
    points_stream stream = {7};
    memset(photons, 0, sizeof photons);
    for (int i = 0; i < count; i++) {
        double away = far_out && i % far_out == 0 ? pow(10, 6 * points_uniform(&stream)) : 1;
        photons[i].position[0] = (float)(away * points_uniform(&stream));
        photons[i].position[2] = (float)(away * points_uniform(&stream));
    }
    return (rt_photon_list){.photons = photons, .count = count};
}

/* The mean distance between photons of the square that follow each other in the order. */
static double mean_step(const rt_photon_list *list)
{
    const float *before = NULL;
    double sum = 0;
    size_t steps = 0;
    rt_error error;
    expect_ok(rt_point_order(items, spare, list->photons->position, sizeof *list->photons,
                             list->count, 2, &error),
              &error);
    for (size_t i = 0; i < count; i++) {
        const float *at = photons[items[i] & RT_POINT_ORDER_INDEX].position;
        if (at[0] > 1 || at[2] > 1)
            continue;
        if (before) {
            sum += hypot((double)at[0] - before[0], (double)at[2] - before[2]);
            steps++;
        }
        before = at;
    }
    assert_true(steps > 0.9 * count);
    return sum / (double)steps;
}

static void every_photon_has_one_place(void **state)
{
    static unsigned char seen[count];
    rt_photon_list list = make_photons(20);
    rt_error error;
    (void)state;
    expect_ok(rt_point_order(items, spare, list.photons->position, sizeof *list.photons, list.count,
                             2, &error),
              &error);
    for (size_t i = 0; i < count; i++) {
        size_t index = items[i] & RT_POINT_ORDER_INDEX;
        assert_true(index < count && !seen[index]);
        seen[index] = 1;
    }
}

/*
 * In no order, a step across the square is 0.52 m long in the mean; in the order, as the points'
 * distances, 1 / sqrt(count).
 */
static void neighbours_stay_together(void **state)
{
    rt_photon_list list = make_photons(0);
    (void)state;
    double near_only = mean_step(&list);
    list = make_photons(20);
    double with_far = mean_step(&list);
    print_message("%.3f and, with photons far out, %.3f of 1 / sqrt(count)\n",
                  near_only * sqrt(count), with_far * sqrt(count));
    assert_true(near_only < 1.4 / sqrt(count) && with_far < 1.4 / sqrt(count));
}

static void photons_in_one_place_and_none_are_ordered(void **state)
{
    rt_photon_list list = {.photons = photons, .count = count};
    rt_error error;
    (void)state;
    memset(photons, 0, sizeof photons);
    expect_ok(rt_point_order(items, spare, list.photons->position, sizeof *list.photons, list.count,
                             2, &error),
              &error);
    for (size_t i = 0; i < count; i++)
        assert_int_equal(items[i] & RT_POINT_ORDER_INDEX, i);
    list.count = 0;
    expect_ok(rt_point_order(items, spare, list.photons->position, sizeof *list.photons, list.count,
                             2, &error),
              &error);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_photon_has_one_place),
        cmocka_unit_test(neighbours_stay_together),
        cmocka_unit_test(photons_in_one_place_and_none_are_ordered),
    };
    return cmocka_run_group_tests_name("lib/photon/point_order", tests, NULL, NULL);
}
