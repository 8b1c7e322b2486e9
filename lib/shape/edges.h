/* edges.h - the geometry of emissive triangles and quads. */
#ifndef RT_LIB_SHAPE_EDGES_H
#define RT_LIB_SHAPE_EDGES_H

#include "rt.h"
#include "types.h"

/*
 * Splits two edges into direction and length, and sets what follows from them: the normal, and how
 * the light is sampled. Kind and texture of the light are set.
 */
void rt_light_set_edges(rt_light_data *light, const double b[3], const double c[3]);

#endif
