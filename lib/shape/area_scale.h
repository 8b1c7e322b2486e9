/*
 * area_scale.h - the factor by which a placement scales areas: a linear map with cofactor matrix C
 * scales the area of a surface element of unit normal n by |C n|.
 */
#ifndef RT_LIB_SHAPE_AREA_SCALE_H
#define RT_LIB_SHAPE_AREA_SCALE_H

#include "scene/transform.h"

/* Relative change at which an integral has converged. */
#define RT_AREA_CONVERGED 1e-9

/* |C (x, y, z)| */
double rt_area_scale(double c[3][3], double x, double y, double z);

/*
 * The integral of |C (r cos phi, r sin phi, z)| over a turn, by the trapezium rule, which converges
 * faster than any power of the number of steps on a smooth periodic function.
 */
double rt_area_scale_turn(double c[3][3], double r, double z, int steps_max);

#endif
