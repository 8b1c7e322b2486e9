/*
 * srgb.h - the sRGB transfer function.
 *
 * Reference: IEC 61966-2-1:1999, "Default RGB colour space - sRGB".
 */
#ifndef RT_LIB_IMAGE_SRGB_H
#define RT_LIB_IMAGE_SRGB_H

#include <stdint.h>

/* The sRGB value, 0 to 1, of a linear value; what lies outside 0 to 1 is clamped, NaN is 0. */
double rt_srgb_encode(double linear);

/* The linear value of an sRGB value; what lies outside 0 to 1 is clamped, NaN is 0. */
double rt_srgb_decode(double encoded);

/* The sRGB value of a linear one as the nearest of 256 steps. */
uint8_t rt_srgb_quantise(double linear);

#endif
