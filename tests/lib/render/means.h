/* means.h - the means of small pictures, by which renders of materials are judged. */
#ifndef RT_TESTS_LIB_RENDER_MEANS_H
#define RT_TESTS_LIB_RENDER_MEANS_H

#include "rt.h"

/* Renders a scene text, 16 x 16 pixels, by these options; means: of the picture, by channel. */
void render_means(double means[3], const char *text, rt_render_options options);

/*
 * That vertex connection and merging have the means of paths to 1.5 %, and photons those to 3 %,
 * without and with a final gather; in a room, say, of a material.
 */
void expect_modes_agree(const char *text);

/*
 * That rough facets, seen where a lamp lights them directly, gather photons to the mean of paths,
 * to 3 %.
 */
void expect_gathered_means(const char *text);

#endif
