#include "scene/environment.h"

#include <math.h>
#include <stddef.h>

static const double pi = 3.14159265358979323846;

/* Sine of the polar angle in the middle of a row. */
static double row_sine(uint32_t row, uint32_t height)
{
    return sin(pi * (row + 0.5) / height);
}

void rt_environment_mean(float mean[3], const float *texels, uint32_t width, uint32_t height)
{
    double sum[3] = {0, 0, 0}, weights = 0;
    for (uint32_t y = 0; y < height; y++) {
        double sine = row_sine(y, height);
        const float *texel = texels + 4 * (size_t)y * width;
        weights += sine * width;
        for (uint32_t x = 0; x < width; x++, texel += 4)
            for (int c = 0; c < 3; c++)
                sum[c] += sine * texel[c];
    }
    for (int c = 0; c < 3; c++)
        mean[c] = (float)(sum[c] / weights);
}

/* Turns a running sum into a cumulative distribution; a sum of 0 into the even one. */
static void normalise(float *cdf, uint32_t count, double total)
{
    for (uint32_t i = 0; i <= count; i++)
        cdf[i] = total > 0 ? (float)(cdf[i] / total) : (float)i / (float)count;
    cdf[count] = 1;
    /* Rounding up to 1 must not reach back beyond the last value that can be chosen. */
    for (uint32_t i = count; i-- > 0 && cdf[i] > 1;)
        cdf[i] = 1;
}

double rt_environment_tabulate(float *conditional, float *marginal, const float *texels,
                               uint32_t width, uint32_t height)
{
    double total = 0;
    marginal[0] = 0;
    for (uint32_t y = 0; y < height; y++) {
        float *row = conditional + (size_t)y * (width + 1);
        const float *texel = texels + 4 * (size_t)y * width;
        double sum = 0;
        row[0] = 0;
        for (uint32_t x = 0; x < width; x++, texel += 4) {
            sum += ((double)texel[0] + texel[1] + texel[2]) / 3;
            row[x + 1] = (float)sum;
        }
        normalise(row, width, sum);
        total += sum * row_sine(y, height) / width;
        marginal[y + 1] = (float)total;
    }
    normalise(marginal, height, total);
    return total / height;
}
