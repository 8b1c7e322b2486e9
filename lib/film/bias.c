/* bias.c - sums the squares of bias and noise over the pixels of a film. */
#include "film/bias.h"

#include <math.h>

#include "film/student_t.h"

enum { most_block_side = 16, blocks_a_side = 4 };

/* What D_2^2 is of B^2 at edges, and D_4^2 of D_2^2 there and in smooth light. */
static const double part_at_edges = 0.0967, growth_at_edges = 4.47, growth_in_smooth_light = 9;

/* By how much B_s^2 and B_e^2 grow with four times the area. */
static const double quadruple_in_smooth_light = 16, quadruple_at_edges = 2;

/* Between 2.86 of a line of light and 2.25 of a point, or of all light, with a disc around it. */
static const double least_growth = 2.5;

/* Sums over pixels; the squares of three channels together. */
typedef struct squares {
    double twice, four_times; /* D^2 */
    double noise, radiance;
    uint32_t pixels;
} squares;

/* Three times D^2 of a pixel: the sum of squares of a square is that of all channels. */
static double square_of(const rt_film_pixel *difference, double sum_of_squares)
{
    const double n = difference->count;
    double square = -sum_of_squares;
    for (int c = 0; c < 3; c++)
        square += pow(rt_film_sum(difference, c), 2);
    return square / (n * (n - 1));
}

/* Iterations of mode vcm, of which some are measured, in a pixel; passes are all. */
static double passes_of(const rt_film *film, size_t i, double measured)
{
    double count = 0;
    if (film->options.mode != RT_MODE_VCM)
        return measured;
    for (uint32_t plane = 0; plane < film->units.replicates; plane++)
        count += film->pixels[plane * rt_film_pixels(film) + i].count;
    return count;
}

static void add_pixel(squares *sums, const rt_film *film, size_t i)
{
    const size_t pixels = rt_film_pixels(film);
    const rt_film_pixel *twice = film->moments + i, *four_times = twice + pixels,
                        *second = four_times + pixels;
    const double passes = second->count;
    double noise = rt_film_sum(second, 0);
    float mean[3];
    if (twice->count < 2 || four_times->count < 2)
        return;
    rt_film_mean(mean, film, i);
    for (int c = 0; c < 3; c++) {
        noise -= passes * mean[c] * mean[c];
        sums->radiance += mean[c];
    }
    sums->twice += square_of(twice, rt_film_sum(second, 1));
    sums->four_times += square_of(four_times, rt_film_sum(second, 2));
    sums->noise += fmax(noise, 0) / ((passes - 1) * passes_of(film, i, passes));
    sums->pixels++;
}

/* ---- Blocks ------------------------------------------------------------------- */

static void add_block(squares *block, const rt_film *film, uint32_t x0, uint32_t y0, uint32_t side)
{
    const uint32_t width = film->options.width, height = film->options.height;
    *block = (squares){0, 0, 0, 0, 0};
    for (uint32_t y = y0; y < height && y < y0 + side; y++)
        for (uint32_t x = x0; x < width && x < x0 + side; x++)
            add_pixel(block, film, (size_t)y * width + x);
}

/* Sums over blocks of products. */
typedef struct products {
    double count, twice, both, four_times;
} products;

static void add_to_sums(squares *all, products *of_blocks, const squares *block)
{
    all->twice += block->twice;
    all->four_times += block->four_times;
    all->noise += block->noise;
    all->radiance += block->radiance;
    all->pixels += block->pixels;
    of_blocks->count++;
    of_blocks->twice += block->twice * block->twice;
    of_blocks->both += block->twice * block->four_times;
    of_blocks->four_times += block->four_times * block->four_times;
}

/* The standard error of a sum over blocks, from that of the squares of what they bring. */
static double standard_error(double blocks, double sum, double sum_of_squares)
{
    return blocks > 1 ? sqrt(fmax(sum_of_squares - sum * sum / blocks, 0) * blocks / (blocks - 1))
                      : INFINITY;
}

/* ---- Edges and smooth light ---------------------------------------------------- */

/* By how much the sum of D_4^2 is above growth times that of D_2^2, and its standard error. */
static double excess_of(double growth, const squares *all, const products *of_blocks, double *error)
{
    const double excess = all->four_times - growth * all->twice;
    *error = standard_error(of_blocks->count, excess,
                            of_blocks->four_times - 2 * growth * of_blocks->both +
                                growth * growth * of_blocks->twice);
    return excess;
}

/* The sum of B_s^2: as much of it as noise does not explain. */
static double smooth_part(const squares *all, const products *of_blocks)
{
    double error;
    const double excess = excess_of(growth_at_edges, all, of_blocks, &error),
                 part = (excess - RT_NORMAL_ONE_SIDE * error) /
                        (growth_in_smooth_light - growth_at_edges);
    return part > 0 ? fmin(part, fmax(all->twice, 0)) : 0;
}

/* Whether discs are larger than what is lit, so that they tell nothing of it. */
static int is_too_large(const squares *all, const products *of_blocks)
{
    double error;
    const double excess = excess_of(least_growth, all, of_blocks, &error);
    return excess + RT_NORMAL_ONE_SIDE * error < 0;
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
    squares all = {0, 0, 0, 0, 0};
    products of_blocks = {0, 0, 0, 0};
    if (!film->moments)
        return none;
    if (film->moments->count < RT_BIAS_FEWEST)
        return unknown;
    for (uint32_t y = 0; y < height; y += side)
        for (uint32_t x = 0; x < width; x += side) {
            squares block;
            add_block(&block, film, x, y, side);
            add_to_sums(&all, &of_blocks, &block);
        }
    const double values = 3.0 * all.pixels, mean = fabs(all.radiance) / values;
    /* In mode vcm the differences are those to a quarter of the area of the discs. */
    const int is_vcm = film->options.mode == RT_MODE_VCM;
    const double s = is_vcm ? quadruple_in_smooth_light : 1,
                 e = (is_vcm ? quadruple_at_edges : 1) / part_at_edges;
    const double smooth = smooth_part(&all, &of_blocks), edges = fmax(all.twice - smooth, 0),
                 error = RT_NORMAL_ONE_SIDE *
                         standard_error(of_blocks.count, all.twice, of_blocks.twice);
    const double noise = sqrt(all.noise / values) / mean;
    if (!(mean > 0))
        return none;
    if (is_too_large(&all, &of_blocks))
        return (rt_film_bias){INFINITY, INFINITY, noise};
    return (rt_film_bias){sqrt((s * smooth + e * edges) / values) / mean,
                          sqrt((s * smooth + e * (edges + error)) / values) / mean, noise};
}
