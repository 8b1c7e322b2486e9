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
    const double length = rt_vec_length(v);
    for (int i = 0; i < 3; i++)
        v[i] /= length;
}

/* hypot, without its care for overflow. */
static inline double distance(double x, double y)
{
    return sqrt(x * x + y * y);
}

/* The angle of (x, y) in turns, from 0 to 1; float32 is far finer than a cell, and faster. */
static inline double turns_of(double x, double y)
{
    const double t = atan2f((float)y, (float)x) / (2 * PI);
    return t < 0 ? t + 1 : t;
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
