/* space.h - directions and coordinates in double precision. */
#ifndef RT_TESTS_STATISTICS_SPACE_H
#define RT_TESTS_STATISTICS_SPACE_H

#include <math.h>

#include "base/vec.h"
#include "statistics/chi_square.h"

static inline double dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void wide(double out[3], const float v[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = v[i];
}

static inline void normalise(double v[3])
{
    const double scale = 1 / rt_vec_length(v);
    for (int i = 0; i < 3; i++)
        v[i] *= scale;
}

/* hypot, without its care for overflow. */
static inline double distance(double x, double y)
{
    return sqrt(x * x + y * y);
}

/*
 * The angle of (x, y) in turns, from 0 to 1, within 1e-8, which is far finer than a cell. By
 * Abramowitz and Stegun, Handbook of Mathematical Functions, 4.4.49, in the first eighth of a turn;
 * without branches, as samples come in any order.
 */
static inline double turns_of(double x, double y)
{
    const double across = fabs(x), up = fabs(y), off = fabs(across - up), sum = across + up;
    const double t = (sum - off) / (sum + off + 1e-300), q = t * t;
    double arc = 0.0028662257;
    arc = arc * q - 0.0161657367;
    arc = arc * q + 0.0429096138;
    arc = arc * q - 0.0752896400;
    arc = arc * q + 0.1065626393;
    arc = arc * q - 0.1420889944;
    arc = arc * q + 0.1999355085;
    arc = arc * q - 0.3333314528;
    double turn = (t + t * q * arc) / (2 * PI);
    turn = 0.125 - copysign(0.125 - turn, across - up);
    turn = 0.25 - copysign(0.25 - turn, x);
    return 0.5 - copysign(0.5 - turn, y);
}

/* Two axes that with the unit vector n are orthonormal. */
static inline void axes_about(const double n[3], double s[3], double t[3])
{
    const double other[3] = {fabs(n[0]) < 0.6, fabs(n[0]) >= 0.6, 0};
    rt_vec_cross(s, n, other);
    normalise(s);
    rt_vec_cross(t, n, s);
}

/* Height along and angle around the unit vector n of a direction. */
static inline void polar_about(const double n[3], const double w[3], double *height, double *turn)
{
    double s[3], t[3];
    axes_about(n, s, t);
    *height = dot3(w, n);
    *turn = turns_of(dot3(w, s), dot3(w, t));
}

#endif
