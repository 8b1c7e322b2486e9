/* grid_scenes.h - scenes with media on grids, for photon mapping. */
#ifndef RT_TESTS_LIB_MODE_GRID_SCENES_H
#define RT_TESTS_LIB_MODE_GRID_SCENES_H

#include "lib/scene/uneven_grid.h"
#include "rt.h"

extern const float smoke_absorption[3], smoke_scattering[3]; /* 1/m, for a density of 1 */

/*
 * A renderer of a text, whose space outside of solids has a medium of these coefficients and this
 * grid; is_white: it absorbs nothing.
 */
rt_renderer *foggy_renderer(const char *text, const rt_grid *grid, int is_white);

/* The same with an albedo, and without a grid of densities where that is NULL. */
rt_renderer *coloured_renderer(const char *text, const rt_grid *grid, const rt_grid *albedo);

/*
 * A renderer of a text with a box of smoke, of twice these coefficients, from -0.7 0.2 -0.6 to 0.7
 * 1.2 0.6. grid: or NULL, of a density of 1.
 */
rt_renderer *smoky_renderer(const char *text, const rt_grid *grid);

/* A room with a lamp, and a glass ball that casts a caustic through the smoke under it. */
#define SMOKE_ROOM                                                                                 \
    "camera { eye 0 1 -2.9  look_at 0 0.7 0  fov 34 }\n"                                           \
    "material grey { kd 0.5 }\nmaterial glass { kt 1  fresnel dielectric  ior 1.5 }\n"             \
    "box { centre 0 1 -1  size 2.4 2 4.2  material grey }\n"                                       \
    "quad { corner -0.4 1.9 -0.4  edge1 0.8 0 0  edge2 0 0 0.8  material grey  radiance 6 }\n"     \
    "sphere { centre 0.3 1.5 0  radius 0.25  material glass }\n"

#endif
