/*
 * responses.h - the responses of the three channels to wavelengths, for device and host.
 *
 * They are the colour-matching functions of CIE 1931 in linear sRGB, by the fit of Wyman, Sloan and
 * Shirley, without their negative parts, which no screen shows, then scaled to an integral of 1:
 * piecewise linear between knots 10 nm apart.
 *
 * References:
 *   Wyman, Sloan, Shirley: "Simple Analytic Approximations to the CIE XYZ Color Matching
 *     Functions", JCGT 2(2), 2013.
 */
#ifndef RT_KERNELS_SAMPLE_RESPONSES_H
#define RT_KERNELS_SAMPLE_RESPONSES_H

#define RT_KNOTS 34u /* of the responses: the first, and the distance between them, micrometres */
#define RT_FIRST_KNOT 0.38f
#define RT_KNOT_DISTANCE 0.01f

/* clang-format off */
/* X(red, green, blue): the integral about each knot, 1/10000; each channel sums to 10000. */
#define RT_RESPONSES(X)                                                                            \
    X(0, 0, 0) X(0, 0, 20) X(3, 0, 59) X(30, 0, 200) X(70, 0, 639) X(101, 0, 1354)                 \
    X(152, 0, 1692) X(99, 0, 1736) X(0, 0, 1621) X(0, 32, 1246) X(0, 171, 762) X(0, 336, 412)      \
    X(0, 541, 201) X(0, 806, 58) X(0, 1094, 0) X(0, 1280, 0) X(0, 1315, 0) X(0, 1253, 0)           \
    X(243, 1105, 0) X(593, 896, 0) X(933, 645, 0) X(1214, 382, 0) X(1390, 144, 0) X(1407, 0, 0)    \
    X(1245, 0, 0) X(978, 0, 0) X(684, 0, 0) X(426, 0, 0) X(237, 0, 0) X(117, 0, 0) X(51, 0, 0)     \
    X(20, 0, 0) X(7, 0, 0) X(0, 0, 0)
/* clang-format on */

#endif
