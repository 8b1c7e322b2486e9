/* vec.h - the few vector operations that the host needs, in double precision. */
#ifndef RT_LIB_BASE_VEC_H
#define RT_LIB_BASE_VEC_H

#include <math.h>

static inline void rt_vec_sub(double out[3], const float a[3], const float b[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = (double)a[i] - b[i];
}

static inline void rt_vec_cross(double out[3], const double a[3], const double b[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static inline double rt_vec_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double rt_vec_length(const double a[3])
{
    return sqrt(rt_vec_dot(a, a));
}

#endif
