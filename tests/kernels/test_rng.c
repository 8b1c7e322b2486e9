/* test_rng.c - the random numbers: stratification, and streams without correlation. */
#include "rng_draw.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pack/sobol.h"
#include "statistics.h"
#include "types.h"

/* count samples, from `first` on, of one set of one stream. */
static void draw(rt_sampler kind, uint32_t seed, uint32_t stream, uint32_t set, uint32_t first,
                 uint32_t count, float (*out)[4])
{
    rt_params params;
    memset(&params, 0, sizeof params);
    params.sampler = kind;
    params.seed = test_seed(seed);
    params.first_sample = first;
    cl_kernel kernel = test_kernel("rng", "sets");
    cl_mem scene = rng_scene(), buffer = test_buffer(count * sizeof *out, NULL);
    rt_arg args[] = {RT_ARG(params), RT_ARG(scene), RT_ARG(stream),
                     RT_ARG(set),    RT_ARG(count), RT_ARG(buffer)};
    test_run(kernel, args, 6, count);
    test_read(buffer, count * sizeof *out, out);
    rt_buffer_release(test_device(), buffer);
    rt_buffer_release(test_device(), scene);
    rt_kernel_release(kernel);
}

static uint32_t reverse(uint32_t x)
{
    uint32_t reversed = 0;
    for (int i = 0; i < 32; i++)
        reversed |= (x >> i & 1u) << (31 - i);
    return reversed;
}

static void the_table_holds_the_first_points_of_the_sobol_sequence(void **state)
{
    /* By hand from the direction numbers: the columns of index bits 0, 1 and 2, in eighths. */
    static const uint32_t column[3][4] = {{4, 4, 4, 4}, {2, 6, 6, 6}, {1, 5, 3, 1}};
    static uint32_t table[RT_SOBOL_WORDS];
    (void)state;
    rt_sobol_table(table);
    for (uint32_t i = 0; i < 8; i++)
        for (int d = 0; d < 4; d++) {
            uint32_t point = 0, expected = 0, r = reverse(i);
            for (int b = 0; b < 4; b++)
                point ^= table[(b * 256 + (r >> (8 * b) & 255u)) * 4 + d];
            for (int bit = 0; bit < 3; bit++)
                expected ^= i >> bit & 1u ? column[bit][d] : 0;
            assert_int_equal(reverse(point), expected << 29);
        }
}

/* Whether each of the 2^a x 2^b cells of the square holds exactly one of 2^(a+b) points. */
static int fills_cells(const float (*points)[4], int x, int y, int a, int b)
{
    static unsigned char seen[4096];
    memset(seen, 0, sizeof seen);
    for (int i = 0; i < 1 << (a + b); i++) {
        int cell = (int)ldexpf(points[i][x], a) << b | (int)ldexpf(points[i][y], b);
        if (seen[cell]++)
            return 0;
    }
    return 1;
}

static void every_coordinate_of_sobol_sets_is_stratified(void **state)
{
    static float points[4096][4];
    (void)state;
    for (uint32_t trial = 0; trial < 8; trial++) {
        draw(RT_SAMPLER_SOBOL, trial, 977 * trial + 5, 3 * trial, 0, 4096, points);
        for (int m = 0; m <= 12; m++)
            for (int d = 0; d < 4; d++)
                assert_true(fills_cells((const float(*)[4])points, d, d, m, 0));
    }
}

static void the_first_two_coordinates_fill_all_elementary_intervals(void **state)
{
    static float points[1024][4];
    (void)state;
    for (uint32_t trial = 0; trial < 8; trial++)
        for (int m = 4; m <= 10; m += 3) {
            /* Any aligned block of 2^m samples is a net, not the first alone. */
            draw(RT_SAMPLER_SOBOL, trial, trial * 31, trial, (trial & 3u) << m, 1u << m, points);
            for (int a = 0; a <= m; a++)
                assert_true(fills_cells((const float(*)[4])points, 0, 1, a, m - a));
        }
}

static void numbers_lie_in_the_unit_interval_with_the_right_mean(void **state)
{
    enum { n = 1 << 16 };
    static float points[n][4];
    static double values[n];
    (void)state;
    for (int kind = RT_SAMPLER_SOBOL; kind <= RT_SAMPLER_INDEPENDENT; kind++) {
        draw((rt_sampler)kind, 1, 7, 2, 0, n, points);
        for (int d = 0; d < 4; d++) {
            for (int i = 0; i < n; i++) {
                assert_true(points[i][d] >= 0 && points[i][d] < 1);
                values[i] = points[i][d];
            }
            expect_mean(values, n, 0.5, 0, "mean of a coordinate");
        }
    }
}

static void independent_numbers_fill_the_hypercube_evenly(void **state)
{
    enum { n = 1 << 17, side = 8, cells = side * side * side * side };
    static float points[n][4];
    static uint32_t counts[cells];
    static double expected[cells];
    (void)state;
    for (uint32_t seed = 0; seed < 3; seed++) {
        memset(counts, 0, sizeof counts);
        draw(RT_SAMPLER_INDEPENDENT, seed, 11, 3, 0, n, points);
        for (int i = 0; i < n; i++) {
            int cell = 0;
            for (int d = 0; d < 4; d++)
                cell = cell * side + (int)(points[i][d] * side);
            counts[cell]++;
        }
        for (int i = 0; i < cells; i++)
            expected[i] = (double)n / cells;
        expect_counts(counts, expected, cells, "independent numbers");
    }
}

/*
 * Correlations of the coordinates over n samples. Of independent numbers they deviate by 1 /
 * sqrt(n); of Sobol points, over 8 seeds, by 1.1 to 1.4 times that.
 */
static void expect_unrelated(int kind, const float (*a)[4], const float (*b)[4], int n)
{
    for (int x = 0; x < 4; x++)
        for (int y = 0; y < 4; y++) {
            double sum = 0;
            for (int i = 0; i < n; i++)
                sum += (a[i][x] - 0.5) * (b[i][y] - 0.5);
            expect_deviate(12 * sum / sqrt(n) / (kind == RT_SAMPLER_SOBOL ? 1.5 : 1),
                           "correlation");
        }
}

static void streams_sets_and_seeds_are_unrelated(void **state)
{
    enum { n = 4096 };
    static float base[n][4], other[n][4];
    (void)state;
    for (int kind = RT_SAMPLER_SOBOL; kind <= RT_SAMPLER_INDEPENDENT; kind++) {
        draw((rt_sampler)kind, 5, 100, 2, 0, n, base);
        draw((rt_sampler)kind, 5, 101, 2, 0, n, other);
        expect_unrelated(kind, (const float(*)[4])base, (const float(*)[4])other, n);
        draw((rt_sampler)kind, 5, 100, 3, 0, n, other);
        expect_unrelated(kind, (const float(*)[4])base, (const float(*)[4])other, n);
        draw((rt_sampler)kind, 6, 100, 2, 0, n, other);
        expect_unrelated(kind, (const float(*)[4])base, (const float(*)[4])other, n);
    }
}

/*
 * What makes a mean unbiased: over all scramblings a single sample is uniform, and so are any two
 * of its coordinates.
 */
static void one_sample_is_even_over_the_streams(void **state)
{
    enum { n = 1 << 16, side = 16, cells = side * side };
    static float numbers[n][8];
    static uint32_t counts[cells];
    static double expected[cells];
    (void)state;
    for (int i = 0; i < cells; i++)
        expected[i] = (double)n / cells;
    for (int kind = RT_SAMPLER_SOBOL; kind <= RT_SAMPLER_INDEPENDENT; kind++) {
        rng_draw_pairs((rt_sampler)kind, test_seed(3), 0, 2, n, numbers);
        for (int x = 0; x < 8; x++)
            for (int y = x + 1; y < 8; y++) {
                memset(counts, 0, sizeof counts);
                for (int i = 0; i < n; i++)
                    counts[(int)(numbers[i][x] * side) * side + (int)(numbers[i][y] * side)]++;
                expect_counts(counts, expected, cells, "two coordinates of one sample");
            }
    }
}

static void lanes_draw_what_one_sampler_does(void **state)
{
    enum { items = 64 };
    static float drawn[items][2][8][4];
    const uint32_t count = items;
    (void)state;
    for (int kind = RT_SAMPLER_SOBOL; kind <= RT_SAMPLER_INDEPENDENT; kind++) {
        rt_params params;
        memset(&params, 0, sizeof params);
        params.sampler = (uint32_t)kind;
        params.seed = test_seed(5);
        cl_kernel kernel = test_kernel("rng", "lanes");
        cl_mem scene = rng_scene(), made = test_output(sizeof drawn, drawn);
        rt_arg args[] = {RT_ARG(params), RT_ARG(scene), RT_ARG(count), RT_ARG(made)};
        test_run(kernel, args, 4, count);
        test_read(made, sizeof drawn, drawn);
        rt_buffer_release(test_device(), made);
        rt_buffer_release(test_device(), scene);
        rt_kernel_release(kernel);
        for (int i = 0; i < items; i++)
            assert_memory_equal(drawn[i][0], drawn[i][1], sizeof drawn[i][0]);
        assert_true(drawn[1][0][1][0] != drawn[1][0][2][0]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_table_holds_the_first_points_of_the_sobol_sequence),
        cmocka_unit_test(every_coordinate_of_sobol_sets_is_stratified),
        cmocka_unit_test(the_first_two_coordinates_fill_all_elementary_intervals),
        cmocka_unit_test(lanes_draw_what_one_sampler_does),
        statistical_test(numbers_lie_in_the_unit_interval_with_the_right_mean),
        statistical_test(independent_numbers_fill_the_hypercube_evenly),
        statistical_test(streams_sets_and_seeds_are_unrelated),
        statistical_test(one_sample_is_even_over_the_streams),
    };
    return cmocka_run_group_tests_name("kernels/rng", tests, NULL, NULL);
}
