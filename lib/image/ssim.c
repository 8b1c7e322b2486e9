/*
 * Reference: Z. Wang, A. Bovik, H. Sheikh, E. Simoncelli, "Image Quality Assessment: From Error
 * Visibility to
 *   Structural Similarity", IEEE Transactions on Image Processing 13(4), 2004, equations 13 to 16.
 *     The window is the
 *   paper's, a circular Gaussian of 11x11 pixels and deviation 1.5 whose weights sum to 1; windows
 *     that reach over
 *   the border are left out of the mean.
 */
#include "image/ssim.h"

#include <math.h>
#include <stdlib.h>

#include "image/srgb.h"

#define WINDOW 11u
#define DEVIATION 1.5
/* (K1 L)^2 and (K2 L)^2 for values in 0..L, L = 1. */
#define C1 (0.01 * 0.01)
#define C2 (0.03 * 0.03)

/* What is averaged over a window. */
enum { MEAN_A, MEAN_B, SQUARE_A, SQUARE_B, PRODUCT, MOMENTS };

/* Rows being filtered: across each as it comes, then down the last WINDOW of them. */
typedef struct filter {
    double weights[WINDOW];
    uint32_t width, columns; /* of pixels, and of windows */
    double *values[2];       /* the row's display luminance, [width] of a and of b */
    double *rows;            /* [WINDOW][columns][MOMENTS]; row y is at y % WINDOW */
} filter;

static void set_weights(double weights[WINDOW])
{
    double sum = 0.0;
    for (uint32_t i = 0; i < WINDOW; i++) {
        double x = ((double)i - (WINDOW - 1) / 2) / DEVIATION;
        sum += weights[i] = exp(-0.5 * x * x);
    }
    for (uint32_t i = 0; i < WINDOW; i++)
        weights[i] /= sum;
}

static void read_row(double *out, const float *rgb, uint32_t width, double scale)
{
    for (uint32_t x = 0; x < width; x++, rgb += 3)
        out[x] = rt_srgb_encode(scale * (0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]));
}

static void filter_across(double *row, const filter *f)
{
    for (uint32_t x = 0; x < f->columns; x++, row += MOMENTS) {
        for (int m = 0; m < MOMENTS; m++)
            row[m] = 0.0;
        for (uint32_t i = 0; i < WINDOW; i++) {
            double w = f->weights[i], a = f->values[0][x + i], b = f->values[1][x + i];
            row[MEAN_A] += w * a;
            row[MEAN_B] += w * b;
            row[SQUARE_A] += w * a * a;
            row[SQUARE_B] += w * b * b;
            row[PRODUCT] += w * a * b;
        }
    }
}

/* The similarity of the window whose left column is x and whose last row is y. */
static double similarity(const filter *f, uint32_t x, uint32_t y)
{
    double m[MOMENTS] = {0};
    for (uint32_t i = 0; i < WINDOW; i++) {
        const double *row = f->rows + ((size_t)((y + 1 + i) % WINDOW) * f->columns + x) * MOMENTS;
        for (int k = 0; k < MOMENTS; k++)
            m[k] += f->weights[i] * row[k];
    }
    double variances = m[SQUARE_A] - m[MEAN_A] * m[MEAN_A] + m[SQUARE_B] - m[MEAN_B] * m[MEAN_B];
    double covariance = m[PRODUCT] - m[MEAN_A] * m[MEAN_B];
    return (2.0 * m[MEAN_A] * m[MEAN_B] + C1) * (2.0 * covariance + C2) /
           ((m[MEAN_A] * m[MEAN_A] + m[MEAN_B] * m[MEAN_B] + C1) * (variances + C2));
}

static double mean_similarity(const filter *f, const float *a, const float *b, uint32_t height,
                              double scale)
{
    double sum = 0.0;
    for (uint32_t y = 0; y < height; y++) {
        read_row(f->values[0], a + 3 * (size_t)y * f->width, f->width, scale);
        read_row(f->values[1], b + 3 * (size_t)y * f->width, f->width, scale);
        filter_across(f->rows + (size_t)(y % WINDOW) * f->columns * MOMENTS, f);
        for (uint32_t x = 0; x < f->columns && y >= WINDOW - 1; x++)
            sum += similarity(f, x, y);
    }
    return sum / ((double)f->columns * (height - WINDOW + 1));
}

rt_status rt_ssim(double *out, const float *a, const float *b, uint32_t width, uint32_t height,
                  double exposure, rt_error *error)
{
    if (width < WINDOW || height < WINDOW) {
        *out = NAN;
        return RT_OK;
    }
    filter f = {.width = width, .columns = width - WINDOW + 1};
    double *memory =
        malloc((2 * (size_t)width + (size_t)WINDOW * f.columns * MOMENTS) * sizeof *memory);
    if (!memory)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory: rows of %u pixels", width);
    f.values[0] = memory;
    f.values[1] = memory + width;
    f.rows = memory + 2 * (size_t)width;
    set_weights(f.weights);
    *out = mean_similarity(&f, a, b, height, exp2(exposure));
    free(memory);
    return RT_OK;
}
