/*
 * student_t.c - quantiles of Student's t distribution: closed forms for one and two degrees of
 * freedom, else an asymptotic expansion.
 *
 * Reference: Abramowitz, Stegun: "Handbook of Mathematical Functions", 1964, 26.7.5.
 */
#include "film/student_t.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

double rt_student_t_quantile(double z, double freedom)
{
    double above = 0.5 * erfc(z / sqrt(2)), z2 = z * z, v = 1 / freedom;
    if (freedom == 1)
        return 1 / tan(pi * above);
    if (freedom == 2)
        return (1 - 2 * above) / sqrt(2 * above * (1 - above));
    double g1 = (z2 + 1) / 4;
    double g2 = ((5 * z2 + 16) * z2 + 3) / 96;
    double g3 = (((3 * z2 + 19) * z2 + 17) * z2 - 15) / 384;
    double g4 = ((((79 * z2 + 776) * z2 + 1482) * z2 - 1920) * z2 - 945) / 92160;
    return z * (1 + v * (g1 + v * (g2 + v * (g3 + v * g4))));
}
