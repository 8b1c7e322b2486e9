/* sky.h - an environment, uniform or an image of a few pixels, around a small sphere. */
#ifndef RT_TESTS_STATISTICS_SKY_H
#define RT_TESTS_STATISTICS_SKY_H

#include "rt.h"

/* The sphere is what the scene's extent comes from. */
#define SKY_SPHERE_CENTRE                                                                          \
    {                                                                                              \
        1, 2, 3                                                                                    \
    }
#define SKY_SPHERE_RADIUS 0.5

rt_scene *sky_scene(int has_picture);

/*
 * The picture: dim noise, a bright pixel, one beside the seam, and a dark row, counted from the
 * top.
 */
enum { sky_width = 16, sky_height = 8 };
double sky_texel(int x, int y);

/* Writes it to a file in the current directory; returns the file's name. */
const char *sky_write_picture(void);

/*
 * The point of the picture in a direction, and the solid angle that an area of the picture at
 * height v stands for.
 */
void sky_place(const float w[3], double *u, double *v);
double sky_element(double v);

/*
 * The density over the picture with which directions are to be sampled; that of a picture but for a
 * factor.
 */
double sky_density(int has_picture, double u, double v);

/* The radiance at a point of the picture. */
double sky_radiance(int has_picture, double u, double v);

#endif
