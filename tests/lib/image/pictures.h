/*
 * pictures.h - pictures that the tests of FLIP and SSIM compare, and how near their values are to
 * be.
 */
#ifndef RT_TESTS_IMAGE_PICTURES_H
#define RT_TESTS_IMAGE_PICTURES_H

/* Of each picture; its values are three a pixel. */
#define WIDTH 40u
#define HEIGHT 24u
#define VALUES (3u * WIDTH * HEIGHT)

/* A picture of many values in 0..1, the same in all three channels. */
void picture_texture(float *rgb);

/* The texture with a tint, with one white pixel, and with a darker right side. */
void picture_changed(float *tint, float *dot, float *step);

/* Fails the test unless what was found is that near. */
void expect_measure(double found, double expected, double tolerance);

#endif
