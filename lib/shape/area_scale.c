/* area_scale.c - the factor by which a placement scales areas. */
#include "shape/area_scale.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

enum { turn_steps_min = 32 };

double rt_area_scale(double c[3][3], double x, double y, double z)
{
    double square = 0;
    for (int i = 0; i < 3; i++) {
        double t = c[i][0] * x + c[i][1] * y + c[i][2] * z;
        square += t * t;
    }
    return sqrt(square);
}

double rt_area_scale_turn(double c[3][3], double r, double z, int steps_max)
{
    double sum = 0, before;
    int steps = turn_steps_min;
    for (int i = 0; i < steps; i++)
        sum += rt_area_scale(c, r * cos(2 * pi * i / steps), r * sin(2 * pi * i / steps), z);
    do {
        before = sum / steps;
        /* Twice the steps: the old ones and those between. */
        for (int i = 0; i < steps; i++) {
            double phi = 2 * pi * (i + 0.5) / steps;
            sum += rt_area_scale(c, r * cos(phi), r * sin(phi), z);
        }
        steps *= 2;
    } while (steps < steps_max && fabs(sum / steps - before) > RT_AREA_CONVERGED * before);
    return 2 * pi * sum / steps;
}
