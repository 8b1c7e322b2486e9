/* half.h - 16-bit floating point numbers (IEEE 754 binary16), which OpenCL reads by vload_half. */
#ifndef RT_LIB_BASE_HALF_H
#define RT_LIB_BASE_HALF_H

#include <stdint.h>

#define RT_HALF_MAX 65504.0f

/*
 * The bits of the half nearest to value, of two equally near the even one; |value| <= RT_HALF_MAX.
 */
uint16_t rt_half_from_float(float value);

#endif
