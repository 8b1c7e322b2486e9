/* test_sums.c - exact sums: of pixels of the film, and of doubles. */
#include "support.h"

#include <math.h>
#include <string.h>

#include "base/exact_sum.h"
#include "camera/film_sum.h"
#include "film/film.h"

enum { COUNT = 1000 };

static uint32_t random_state = 7;

static uint32_t next_random(void)
{
    random_state = random_state * 1664525u + 1013904223u;
    return random_state >> 4;
}

static void add(rt_film_pixel *pixel, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int c = 0; c < 3; c++)
        film_add_bits(film_sums_of(pixel), c, bits);
    pixel->weight++;
    pixel->count++;
}

/* Of either sign, over `powers` powers of two, the middle one 2^middle. */
static void make_values(float *values, int powers, int middle)
{
    for (int i = 0; i < COUNT; i++) {
        const int power = (int)(next_random() % (uint32_t)powers) - powers / 2 + middle;
        values[i] = ldexpf((float)(1 + next_random() % 1000003) / 1000003, power);
        values[i] *= next_random() % 3 ? 1 : -1;
    }
}

static void shuffle(float *values)
{
    for (int i = COUNT - 1; i > 0; i--) {
        const int j = (int)(next_random() % (uint32_t)(i + 1));
        const float swapped = values[i];
        values[i] = values[j];
        values[j] = swapped;
    }
}

/* The sum in parts of random length, joined in random order. */
static rt_film_pixel sum_in_parts(const float *values)
{
    rt_film_pixel sum = {0}, after = {0};
    for (int i = 0; i < COUNT;) {
        rt_film_pixel part = {0};
        for (int end = i + 1 + (int)(next_random() % 100); i < end && i < COUNT; i++)
            add(&part, values[i]);
        film_join(next_random() % 2 ? &sum : &after, &part);
    }
    film_join(&sum, &after);
    return sum;
}

/* And it is that of doubles, as far as these are exact. */
static void the_sum_of_a_pixel_does_not_depend_on_order_or_parts(void **state)
{
    static const int powers[] = {1, 10, 40, 120, 250};
    float values[COUNT];
    (void)state;
    for (size_t p = 0; p < sizeof powers / sizeof *powers; p++)
        for (int middle = -20; middle <= 0; middle += 5) {
            rt_film_pixel whole = {0};
            double sum = 0, largest = 0;
            make_values(values, powers[p], middle);
            for (int i = 0; i < COUNT; i++) {
                add(&whole, values[i]);
                sum += values[i];
                largest = fmax(largest, fabs(values[i]));
            }
            assert_true(fabs(rt_film_sum(&whole, 1) - sum) < COUNT * largest * 1e-9);
            for (int turn = 0; turn < 5; turn++) {
                shuffle(values);
                const rt_film_pixel other = sum_in_parts(values);
                assert_memory_equal(&whole, &other, sizeof whole);
            }
        }
}

static void one_value_is_kept_to_the_bit(void **state)
{
    static const float values[] = {1,         -1,     0.1f,    3e38f,    -3e38f,
                                   1.18e-38f, 1e-45f, -5e-42f, 16777217, 0};
    (void)state;
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        rt_film_pixel pixel = {0};
        add(&pixel, values[i]);
        assert_true(rt_film_sum(&pixel, 0) == values[i]);
    }
}

/* 2^20 times the largest float: the bins have room for 2^31 of it. */
static void sums_do_not_overflow(void **state)
{
    rt_film_pixel pixel = {0};
    (void)state;
    add(&pixel, 3e38f);
    for (int i = 0; i < 20; i++) {
        const rt_film_pixel same = pixel;
        film_join(&pixel, &same);
    }
    assert_true(rt_film_sum(&pixel, 2) == ldexp((double)3e38f, 20));
    assert_int_equal(pixel.count, 1 << 20);
}

static void counts_of_losses_stop_at_their_end(void **state)
{
    rt_film_pixel pixel = {0};
    (void)state;
    for (int i = 0; i < 3; i++)
        film_reject(&pixel, 0x7ffff);
    assert_int_equal(pixel.bins >> RT_FILM_REJECTED, 0xfffff);
    assert_int_equal(pixel.bins & 0xfff, 0);
    assert_true(film_add_saturated(0xfffffff0u, 0x20u) == 0xffffffffu);
}

static void sums_of_doubles_do_not_depend_on_order_or_parts(void **state)
{
    static const int powers[] = {1, 60, 300, 1500};
    double values[COUNT];
    (void)state;
    for (size_t p = 0; p < sizeof powers / sizeof *powers; p++) {
        rt_exact_sum whole = {0}, parts[7] = {{0}}, joined = {0};
        double sum = 0, largest = 0;
        for (int i = 0; i < COUNT; i++) {
            values[i] = ldexp((double)next_random() / 7,
                              (int)(next_random() % (uint32_t)powers[p]) - powers[p] / 2);
            values[i] *= next_random() % 3 ? 1 : -1;
            rt_exact_sum_add(&whole, values[i]);
            sum += values[i];
            largest = fmax(largest, fabs(values[i]));
        }
        for (int i = COUNT; i-- > 0;)
            rt_exact_sum_add(parts + i % 7, values[i]);
        for (int i = 0; i < 7; i++)
            rt_exact_sum_join(&joined, parts + (3 * i) % 7);
        assert_memory_equal(&whole, &joined, sizeof whole);
        assert_true(fabs(rt_exact_sum_value(&whole) - sum) < COUNT * largest * 1e-9);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_sum_of_a_pixel_does_not_depend_on_order_or_parts),
        cmocka_unit_test(one_value_is_kept_to_the_bit),
        cmocka_unit_test(sums_do_not_overflow),
        cmocka_unit_test(counts_of_losses_stop_at_their_end),
        cmocka_unit_test(sums_of_doubles_do_not_depend_on_order_or_parts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
