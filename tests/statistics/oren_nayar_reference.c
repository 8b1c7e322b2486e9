/* oren_nayar_reference.c - the lobe of oren_nayar_reference.h. */
#include "statistics/oren_nayar_reference.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/* Fujii's lobe over kd; s: wo.wi less the product of the cosines. */
static double fujii(double r, double cos_o, double cos_i, double s)
{
    const double scale = 1 / (1 + (0.5 - 2 / (3 * pi)) * r);
    const double t = s > 0 ? fmax(cos_o, cos_i) : 1;
    return scale / pi * (1 + r * s / t);
}

/* Its albedo for one direction, by the midpoint rule over the hemisphere. */
static double fujii_albedo(double r, double cos_o)
{
    enum { rings = 128, sectors = 64 };
    const double sin_o = sqrt(1 - cos_o * cos_o);
    double sum = 0;
    for (int i = 0; i < rings; i++)
        for (int j = 0; j < sectors; j++) {
            const double cos_i = (i + 0.5) / rings, sin_i = sqrt(1 - cos_i * cos_i);
            const double s = sin_o * sin_i * cos(pi * (j + 0.5) / sectors);
            sum += fujii(r, cos_o, cos_i, s) * cos_i * 2 * pi / (rings * sectors);
        }
    return sum;
}

/* The mean of that over directions by the cosine; kept, for it takes long. */
static double mean_albedo(double r)
{
    enum { steps = 64 };
    static double last_r = -1, last;
    if (r != last_r) {
        double sum = 0;
        for (int i = 0; i < steps; i++)
            sum += fujii_albedo(r, sqrt((i + 0.5) / steps)) / steps;
        last_r = r;
        last = sum;
    }
    return last;
}

double oren_nayar_fr(double kd, double r, double cos_o, double cos_i, double cos_between)
{
    const double once = kd * fujii(r, cos_o, cos_i, cos_between - cos_o * cos_i);
    const double mean = mean_albedo(r), often = kd * kd * mean / (1 - kd * (1 - mean));
    return once +
           often / pi * (1 - fujii_albedo(r, cos_o)) * (1 - fujii_albedo(r, cos_i)) / (1 - mean);
}
