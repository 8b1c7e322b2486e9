/*
 * compare_blocks.c - whether pictures agree block by block within their noise, by the rule of
 * rt_image_block.
 */
#include <math.h>
#include <stdlib.h>

#include "image/compare.h"

#define ERRORS_ALLOWED 4.0 /* standard errors that a block may be off */
#define PLANE_PARAMETERS 3.0

uint32_t rt_block_columns(const rt_pictures *pictures, uint32_t side)
{
    return (pictures->width - 1) / side + 1;
}

size_t rt_block_count(const rt_pictures *pictures, uint32_t side)
{
    return (size_t)rt_block_columns(pictures, side) * ((pictures->height - 1) / side + 1);
}

/* The place and the size of a block. */
static rt_image_block place_block(const rt_pictures *p, uint32_t side, uint32_t column,
                                  uint32_t row)
{
    rt_image_block b = {.x = column * side, .y = row * side, .width = side, .height = side};
    if (b.width > p->width - b.x)
        b.width = p->width - b.x;
    if (b.height > p->height - b.y)
        b.height = p->height - b.y;
    return b;
}

static size_t value_index(const rt_pictures *p, uint32_t x, uint32_t y, uint32_t channel)
{
    return 3 * ((size_t)y * p->width + x) + channel;
}

static double block_mean(const rt_pictures *p, const float *rgb, const rt_image_block *b,
                         uint32_t channel)
{
    double sum = 0.0;
    for (uint32_t y = b->y; y < b->y + b->height; y++)
        for (uint32_t x = b->x; x < b->x + b->width; x++)
            sum += rgb[value_index(p, x, y, channel)];
    return sum / ((double)b->width * b->height);
}

/*
 * V from the pixel differences: their variance about the plane that fits them best. On a full grid
 * the constant and the two centred coordinates are orthogonal, so that each is fitted by itself.
 * NaN of too few pixels.
 */
static double variance_about_plane(const rt_pictures *p, const rt_image_block *b, uint32_t channel)
{
    double n = (double)b->width * b->height;
    double centre_x = b->x + 0.5 * (b->width - 1), centre_y = b->y + 0.5 * (b->height - 1);
    double sum = 0.0, squares = 0.0, along_x = 0.0, along_y = 0.0, xx = 0.0, yy = 0.0;
    if (n <= PLANE_PARAMETERS)
        return NAN;
    for (uint32_t y = b->y; y < b->y + b->height; y++)
        for (uint32_t x = b->x; x < b->x + b->width; x++) {
            size_t index = value_index(p, x, y, channel);
            double d = (double)p->mean[index] - p->reference[index];
            double dx = x - centre_x, dy = y - centre_y;
            sum += d;
            squares += d * d;
            along_x += d * dx;
            along_y += d * dy;
            xx += dx * dx;
            yy += dy * dy;
        }
    double residual = squares - sum * sum / n;
    if (xx > 0.0)
        residual -= along_x * along_x / xx;
    if (yy > 0.0)
        residual -= along_y * along_y / yy;
    /* What is not a number stays so; rounding may fall below zero. */
    return residual < 0.0 ? 0.0 : residual / (n - PLANE_PARAMETERS);
}

/* V / n: the variance of the block's mean difference while its pixels are independent. */
static double pixel_part(const rt_pictures *p, const rt_image_block *b, uint32_t channel)
{
    double n = (double)b->width * b->height;
    return (p->variance ? block_mean(p, p->variance, b, channel)
                        : variance_about_plane(p, b, channel)) /
           n;
}

/* ---- The scatter of several renders ------------------------------------------ */

/* The variance of the mean of the renders' means of one block, from their scatter. */
static double scatter_of_block(const rt_pictures *p, const rt_image_block *b, uint32_t channel)
{
    double sum = 0.0, squares = 0.0, count = (double)p->count;
    for (size_t r = 0; r < p->count; r++) {
        double mean = block_mean(p, p->renders[r], b, channel);
        sum += mean;
        squares += mean * mean;
    }
    double residual = squares - sum * sum / count;
    return residual > 0.0 ? residual / (count - 1.0) / count : 0.0;
}

/*
 * S, averaged over the block and its neighbours, because a few renders estimate that of one block
 * poorly.
 */
static double scatter_around(double (*scatter)[3], uint32_t columns, uint32_t rows, uint32_t column,
                             uint32_t row, uint32_t channel)
{
    double sum = 0.0;
    int heard = 0;
    for (uint32_t j = row > 0 ? row - 1 : 0; j <= row + 1 && j < rows; j++)
        for (uint32_t i = column > 0 ? column - 1 : 0; i <= column + 1 && i < columns; i++, heard++)
            sum += scatter[(size_t)j * columns + i][channel];
    return sum / heard;
}

/* ---- The rule ----------------------------------------------------------------- */

/* The standard error of a block's mean difference; NaN: unknown. */
static double error_of_block(const rt_pictures *p, const rt_image_block *b, uint32_t channel,
                             double scatter)
{
    double pixels = pixel_part(p, b, channel);
    int too_few = !p->variance && (double)b->width * b->height <= PLANE_PARAMETERS;
    return too_few && p->count > 1 ? sqrt(scatter) : sqrt(pixels + scatter);
}

static void judge(rt_image_block *b, const rt_pictures *p, uint32_t channel, double scatter,
                  double tolerance)
{
    double mean = block_mean(p, p->mean, b, channel),
           reference = block_mean(p, p->reference, b, channel);
    double error = error_of_block(p, b, channel, scatter);
    /* An unknown standard error allows no deviation beyond the tolerance. */
    double allowed = fmax(tolerance * fabs(reference), ERRORS_ALLOWED * error);
    double difference = fabs(mean - reference);
    double excess = difference > 0.0 ? difference / allowed : 0.0;
    /* NaN counts as disagreement. */
    if (!isfinite(mean) || !isfinite(reference) || isnan(excess))
        excess = INFINITY;
    b->mean[channel] = mean;
    b->reference[channel] = reference;
    b->error[channel] = error;
    b->excess[channel] = excess;
}

rt_status rt_compare_blocks(rt_image_block *blocks, const rt_pictures *p, uint32_t side,
                            double tolerance, rt_error *error)
{
    size_t count = rt_block_count(p, side);
    uint32_t columns = rt_block_columns(p, side), rows = (uint32_t)(count / columns);
    double(*scatter)[3] = calloc(count, sizeof *scatter);
    if (!scatter)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory: %zu blocks", count);
    for (size_t i = 0; i < count; i++) {
        blocks[i] = place_block(p, side, (uint32_t)(i % columns), (uint32_t)(i / columns));
        for (uint32_t c = 0; c < 3 && p->count > 1; c++)
            scatter[i][c] = scatter_of_block(p, &blocks[i], c);
    }
    for (size_t i = 0; i < count; i++)
        for (uint32_t c = 0; c < 3; c++) {
            uint32_t column = (uint32_t)(i % columns), row = (uint32_t)(i / columns);
            judge(&blocks[i], p, c, scatter_around(scatter, columns, rows, column, row, c),
                  tolerance);
        }
    free(scatter);
    return RT_OK;
}
