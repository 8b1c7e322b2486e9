#include "compare.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/image_file.h"

/* What is being compared: the renders and the grid of blocks. */
typedef struct comparison {
    const float *const *renders;
    size_t count;
    const compare_image *reference;
    uint32_t columns, rows;
} comparison;

/* A block of one channel. */
typedef struct block {
    uint32_t x0, y0, x1, y1, channel; /* pixels x0 <= x < x1, y0 <= y < y1 */
} block;

static block block_at(const comparison *c, uint32_t column, uint32_t row, uint32_t channel)
{
    block b = {column * COMPARE_BLOCK, row * COMPARE_BLOCK, (column + 1) * COMPARE_BLOCK, (row + 1) * COMPARE_BLOCK,
               channel};
    if (b.x1 > c->reference->width)
        b.x1 = c->reference->width;
    if (b.y1 > c->reference->height)
        b.y1 = c->reference->height;
    return b;
}

static size_t value_index(const comparison *c, uint32_t x, uint32_t y, uint32_t channel)
{
    return 3 * ((size_t)y * c->reference->width + x) + channel;
}

/* The mean of the renders there. */
static double render_value(const comparison *c, size_t index)
{
    double sum = 0.0;
    for (size_t r = 0; r < c->count; r++)
        sum += c->renders[r][index];
    return sum / (double)c->count;
}

static double block_mean(const comparison *c, const float *rgb, const block *b)
{
    double sum = 0.0;
    for (uint32_t y = b->y0; y < b->y1; y++)
        for (uint32_t x = b->x0; x < b->x1; x++)
            sum += rgb[value_index(c, x, y, b->channel)];
    return sum / ((double)(b->x1 - b->x0) * (b->y1 - b->y0));
}

/*
 * The variance of the mean of the pixel differences: V / n of the header. On a full grid the constant
 * and the two centred coordinates are orthogonal, so each is fitted by itself.
 */
static double pixel_variance_of_mean(const comparison *c, const block *b)
{
    double n = (double)(b->x1 - b->x0) * (b->y1 - b->y0);
    double centre_x = 0.5 * (b->x0 + b->x1 - 1), centre_y = 0.5 * (b->y0 + b->y1 - 1);
    double sum = 0.0, squares = 0.0, along_x = 0.0, along_y = 0.0, xx = 0.0, yy = 0.0;
    if (n <= 3.0)
        return 0.0;
    for (uint32_t y = b->y0; y < b->y1; y++)
        for (uint32_t x = b->x0; x < b->x1; x++) {
            size_t index = value_index(c, x, y, b->channel);
            double d = render_value(c, index) - c->reference->rgb[index];
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
    return residual > 0.0 ? residual / (n - 3.0) / n : 0.0;
}

/* The variance of the mean of the renders' means of one block, from their scatter. */
static double scatter_of_block(const comparison *c, const block *b)
{
    double sum = 0.0, squares = 0.0, count = (double)c->count;
    for (size_t r = 0; r < c->count; r++) {
        double mean = block_mean(c, c->renders[r], b);
        sum += mean;
        squares += mean * mean;
    }
    double residual = squares - sum * sum / count;
    return residual > 0.0 ? residual / (count - 1.0) / count : 0.0;
}

/* S of the header: few renders say little about one block, so its neighbours are heard too. */
static double scatter_around(const comparison *c, const double *scatter, uint32_t column, uint32_t row,
                             uint32_t channel)
{
    double sum = 0.0;
    int heard = 0;
    for (uint32_t j = row > 0 ? row - 1 : 0; j <= row + 1 && j < c->rows; j++)
        for (uint32_t i = column > 0 ? column - 1 : 0; i <= column + 1 && i < c->columns; i++, heard++)
            sum += scatter[3 * ((size_t)j * c->columns + i) + channel];
    return sum / heard;
}

static double *scatter_of_blocks(const comparison *c)
{
    double *scatter = calloc((size_t)c->columns * c->rows * 3, sizeof *scatter);
    if (!scatter || c->count < 2)
        return scatter;
    for (uint32_t row = 0; row < c->rows; row++)
        for (uint32_t column = 0; column < c->columns; column++)
            for (uint32_t channel = 0; channel < 3; channel++) {
                block b = block_at(c, column, row, channel);
                scatter[3 * ((size_t)row * c->columns + column) + channel] = scatter_of_block(c, &b);
            }
    return scatter;
}

static void judge(compare_result *out, const comparison *c, const block *b, double scatter, double tolerance)
{
    double mean = 0.0;
    for (size_t r = 0; r < c->count; r++)
        mean += block_mean(c, c->renders[r], b) / (double)c->count;
    double reference_mean = block_mean(c, c->reference->rgb, b);
    double error = sqrt(pixel_variance_of_mean(c, b) + scatter);
    double allowed = fmax(tolerance * fabs(reference_mean), COMPARE_ERRORS * error);
    double difference = fabs(mean - reference_mean);
    double excess = difference > 0.0 ? difference / allowed : 0.0;
    /* What is not a number is no agreement. */
    if (!isfinite(mean) || !isfinite(reference_mean) || isnan(excess))
        excess = INFINITY;
    out->count++;
    out->failed += excess > 1.0 ? 1 : 0;
    if (out->count > 1 && !(excess > out->excess))
        return;
    out->x = b->x0;
    out->y = b->y0;
    out->channel = b->channel;
    out->mean = mean;
    out->reference_mean = reference_mean;
    out->error = error;
    out->excess = excess;
}

static void measure_whole(compare_result *out, const comparison *c)
{
    size_t count = (size_t)3 * c->reference->width * c->reference->height;
    double squares = 0.0, sum = 0.0, reference_sum = 0.0;
    for (size_t i = 0; i < count; i++) {
        double value = render_value(c, i), reference = c->reference->rgb[i];
        squares += (value - reference) * (value - reference);
        sum += value;
        reference_sum += reference;
    }
    out->rmse = sqrt(squares / (double)count);
    out->ratio = sum / reference_sum;
}

int compare_blocks(compare_result *out, const float *const *renders, size_t count, const compare_image *reference,
                   double tolerance)
{
    comparison c = {renders, count, reference, (reference->width + COMPARE_BLOCK - 1) / COMPARE_BLOCK,
                    (reference->height + COMPARE_BLOCK - 1) / COMPARE_BLOCK};
    double *scatter = scatter_of_blocks(&c);
    if (!scatter)
        return 0;
    memset(out, 0, sizeof *out);
    for (uint32_t row = 0; row < c.rows; row++)
        for (uint32_t column = 0; column < c.columns; column++)
            for (uint32_t channel = 0; channel < 3; channel++) {
                block b = block_at(&c, column, row, channel);
                judge(out, &c, &b, scatter_around(&c, scatter, column, row, channel), tolerance);
            }
    measure_whole(out, &c);
    free(scatter);
    return 1;
}

int compare_load(compare_image *out, const char *path)
{
    rt_image *image = NULL;
    rt_error error;
    uint32_t channels[3];
    if (rt_image_read(&image, path, &error) != RT_OK || rt_image_rgb_channels(channels, image, &error) != RT_OK) {
        fprintf(stderr, "%s\n", error.message);
        rt_image_destroy(image);
        return 0;
    }
    size_t pixel_count = (size_t)image->width * image->height;
    float *rgb = malloc(3 * pixel_count * sizeof *rgb);
    for (size_t i = 0; rgb && i < pixel_count; i++)
        for (int c = 0; c < 3; c++)
            rgb[3 * i + (size_t)c] = image->data[i * image->channel_count + channels[c]];
    out->width = image->width;
    out->height = image->height;
    out->rgb = rgb;
    rt_image_destroy(image);
    return rgb != NULL;
}

int compare_write_difference(const char *path, const float *const *renders, size_t count,
                             const compare_image *reference)
{
    static const char *const names[3] = {"R", "G", "B"};
    comparison c = {renders, count, reference, 0, 0};
    rt_image *image = NULL;
    rt_error error;
    if (rt_image_create(&image, reference->width, reference->height, names, 3, &error) == RT_OK) {
        size_t value_count = (size_t)3 * reference->width * reference->height;
        for (size_t i = 0; i < value_count; i++)
            image->data[i] = (float)(render_value(&c, i) - reference->rgb[i]);
        if (rt_image_write(image, path, NULL, &error) == RT_OK) {
            rt_image_destroy(image);
            return 1;
        }
    }
    fprintf(stderr, "%s\n", error.message);
    rt_image_destroy(image);
    return 0;
}
