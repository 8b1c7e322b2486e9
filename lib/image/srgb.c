/* srgb.c - the sRGB transfer function and its inverse. */
#include "image/srgb.h"

#include <math.h>

double rt_srgb_encode(double linear)
{
    if (!(linear > 0.0))
        return 0.0;
    if (linear >= 1.0)
        return 1.0;
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
}

double rt_srgb_decode(double encoded)
{
    if (!(encoded > 0.0))
        return 0.0;
    if (encoded >= 1.0)
        return 1.0;
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

uint8_t rt_srgb_quantise(double linear)
{
    return (uint8_t)(255.0 * rt_srgb_encode(linear) + 0.5);
}
