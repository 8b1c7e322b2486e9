/* fuzz_reference.c - the lobe of fuzz_reference.h. */
#include "statistics/fuzz_reference.h"

#include <math.h>

static const double pi = 3.14159265358979323846, least_cosine = 0.005;

/* The exponent of the masking; x: the cosine, or 1 less it. */
static double exponent_of(double x, double alpha)
{
    static const double smooth[5] = {25.3245, 3.32435, 0.16801, -1.27393, -4.85967},
                        rough[5] = {21.5473, 3.82987, 0.19823, -1.97760, -4.32054};
    const double part = (1 - alpha) * (1 - alpha);
    double p[5];
    for (int i = 0; i < 5; i++)
        p[i] = part * smooth[i] + (1 - part) * rough[i];
    return p[0] / (1 + p[1] * pow(x, p[2])) + p[3] * x + p[4];
}

static double masking(double cosine, double alpha)
{
    const double u = fmax(cosine, least_cosine);
    return exp(u < 0.5 ? exponent_of(u, alpha)
                       : 2 * exponent_of(0.5, alpha) - exponent_of(1 - u, alpha));
}

/* What the fibres alone reflect; r from 0.1 on. */
static double fibres(double r, double cos_o, double cos_i, double between)
{
    const double alpha = r * r, least = least_cosine, turned = 2 + 2 * between;
    const double to_half = turned > 0 ? (cos_o + cos_i) / sqrt(turned) : 1;
    const double sine = sqrt(fmax(0, 1 - to_half * to_half));
    const double d = (2 + 1 / alpha) * pow(sine, 1 / alpha) / (2 * pi);
    const double v = 1 / (4 * fmax(cos_o, least) * fmax(cos_i, least) *
                          (1 + masking(cos_o, alpha) + masking(cos_i, alpha)));
    const double scale = 1 / (0.19 / r + 0.27);
    return (scale < 1 ? scale : 1) * d * v;
}

/* By the midpoint rule, with more points at grazing angles and about forward directions. */
double fuzz_reflectance(double r, double cosine)
{
    enum { rings = 96, sectors = 64 };
    double sum = 0;
    for (int i = 0; i < rings; i++)
        for (int j = 0; j < sectors; j++) {
            const double t = (i + 0.5) / rings, s = (j + 0.5) / sectors;
            const double z = t * t * t, turn = pi * (1 - s * s * s);
            const double between =
                sqrt((1 - cosine * cosine) * (1 - z * z)) * cos(turn) + cosine * z;
            sum += fibres(r, cosine, z, between) * z * (3 * t * t / rings) *
                   (2 * pi * 3 * s * s / sectors);
        }
    return sum;
}

static double mean_reflectance(double r)
{
    enum { steps = 32 };
    static double last_r, last;
    if (r == last_r)
        return last;
    last_r = r;
    last = 0;
    for (int i = 0; i < steps; i++) {
        const double t = (i + 0.5) / steps;
        last += fuzz_reflectance(r, t * t) * 2 * t * t * 2 * t / steps;
    }
    return last;
}

double fuzz_fr(double kd, double fuzz, double most, double r, double cos_o, double cos_i,
               double cos_between)
{
    const double enters = 1 - most * fuzz_reflectance(r, cos_o),
                 leaves = 1 - most * fuzz_reflectance(r, cos_i);
    return fuzz * fibres(r, cos_o, cos_i, cos_between) +
           kd / pi * enters * leaves / (1 - most * mean_reflectance(r));
}
