/* bias.c - sums the squares of bias and noise over the pixels of a film. */
#include "film/bias.h"

#include <math.h>

#include "film/student_t.h"

enum { most_block_side = 16, blocks_a_side = 4 };

/* What the difference of a disc and twice of it is of the bias: 2^g - 1. */
static const double part_seen = 0.41421356237310;

/* Sums over pixels; the squares of three channels together. */
typedef struct squares {
    double bias, noise, radiance;
    uint32_t pixels;
} squares;

static void add_pixel(squares *sums, const rt_film *film, size_t i)
{
    const rt_film_pixel *first = film->moments + i, *second = first + rt_film_pixels(film);
    const double measured = first->count, passes = second->count;
    double bias = -rt_film_sum(second, 1), noise = rt_film_sum(second, 0);
    float mean[3];
    if (measured < 2)
        return;
    rt_film_mean(mean, film, i);
    for (int c = 0; c < 3; c++) {
        const double difference = rt_film_sum(first, c);
        bias += difference * difference;
        noise -= passes * mean[c] * mean[c];
        sums->radiance += mean[c];
    }
    sums->bias += bias / (measured * (measured - 1) * part_seen * part_seen);
    sums->noise += fmax(noise, 0) / (passes * (passes - 1));
    sums->pixels++;
}

/* The standard error of the mean of B^2 over pixels, from the blocks that make it up. */
static double standard_error(double blocks, double sum, double sum_of_squares)
{
    return blocks > 1 ? sqrt(fmax(sum_of_squares - sum * sum / blocks, 0) * blocks / (blocks - 1))
                      : INFINITY;
}

/* Of a film whose shorter side has so many pixels: a few blocks fit into any. */
static uint32_t side_of_blocks(uint32_t shorter)
{
    const uint32_t side = shorter / blocks_a_side;
    return side < 1 ? 1 : side > most_block_side ? most_block_side : side;
}

rt_film_bias rt_film_find_bias(const rt_film *film)
{
    const rt_film_bias none = {0, 0, 0}, unknown = {INFINITY, INFINITY, INFINITY};
    const uint32_t width = film->options.width, height = film->options.height;
    const uint32_t side = side_of_blocks(width < height ? width : height);
    squares all = {0, 0, 0, 0};
    double blocks = 0, of_blocks = 0;
    if (!film->moments)
        return none;
    if (film->moments->count < RT_BIAS_FEWEST)
        return unknown;
    for (uint32_t y = 0; y < height; y += side)
        for (uint32_t x = 0; x < width; x += side, blocks++) {
            const double before = all.bias;
            for (uint32_t v = y; v < height && v < y + side; v++)
                for (uint32_t u = x; u < width && u < x + side; u++)
                    add_pixel(&all, film, (size_t)v * width + u);
            of_blocks += (all.bias - before) * (all.bias - before);
        }
    const double values = 3.0 * all.pixels, mean = fabs(all.radiance) / values,
                 error = standard_error(blocks, all.bias, of_blocks);
    if (!(mean > 0))
        return none;
    return (rt_film_bias){sqrt(fmax(all.bias, 0) / values) / mean,
                          sqrt((fmax(all.bias, 0) + RT_NORMAL_ONE_SIDE * error) / values) / mean,
                          sqrt(all.noise / values) / mean};
}
