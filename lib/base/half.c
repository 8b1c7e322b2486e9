/* half.c - rounds a float to a half. */
#include "base/half.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#define NORMAL_MIN 0x38800000u /* bits of 2^-14, the least normal half, as float */
#define BIAS_GAP 0x38000000u   /* difference of the exponents' biases, 127 - 15, in place */

uint16_t rt_half_from_float(float value)
{
    uint32_t bits;
    assert(fabsf(value) <= RT_HALF_MAX);
    memcpy(&bits, &value, sizeof bits);
    uint32_t sign = bits >> 16 & 0x8000u, magnitude = bits & 0x7fffffffu;

    /*
     * A subnormal half counts steps of 2^-24. Rounding up to 1024 steps gives the least normal one.
     */
    if (magnitude < NORMAL_MIN)
        return (uint16_t)(sign | (uint32_t)lrintf(fabsf(value) * 0x1p24f));

    /*
     * Else 13 bits of the mantissa go, rounded to even; a carry runs into the exponent, where it
     * belongs.
     */
    magnitude -= BIAS_GAP;
    return (uint16_t)(sign | (magnitude + 0xfffu + (magnitude >> 13 & 1u)) >> 13);
}
