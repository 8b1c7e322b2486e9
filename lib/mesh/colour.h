/*
 * colour.h - colours of mesh files: linear from 0 to 1, or whole numbers, which are sRGB like those
 * of images.
 *
 * `largest` is the whole number that stands for 1; 0 where the colour is linear.
 */
#ifndef RT_LIB_MESH_COLOUR_H
#define RT_LIB_MESH_COLOUR_H

#include <math.h>

#include "image/srgb.h"

/* Rounding may take a linear colour so far above 1. */
#define RT_MESH_COLOUR_MOST (1 + 1e-4)

/* Whether a finite number is no colour. */
static inline int rt_mesh_colour_is_bad(double value, double largest)
{
    return value < 0 || value > (largest > 0 ? largest : RT_MESH_COLOUR_MOST);
}

/* What is wrong with one, behind "the colour 7 is". */
static inline const char *rt_mesh_colour_fault(double value, double largest)
{
    return value < 0        ? "negative"
           : largest == 0   ? "above 1: colours go from 0 to 1; whole numbers to 255 are read in "
                              "PLY, of integer types, and in OFF"
           : largest == 255 ? "above 255: colours of whole numbers go from 0 to 255"
                            : "above the largest of its type";
}

/* The linear colour of a good one. */
static inline double rt_mesh_colour(double value, double largest)
{
    return largest > 0 ? rt_srgb_decode(value / largest) : fmin(value, 1) + 0.0;
}

#endif
