/* ears.h - triangles of a polygon in the plane, by clipping ears. */
#ifndef RT_LIB_MESH_EARS_H
#define RT_LIB_MESH_EARS_H

#include <stddef.h>
#include <stdint.h>

#include "rt.h"

/* The corners of a polygon in the plane: finite, and counter-clockwise where it is simple. */
typedef struct rt_outline {
    const double (*points)[2];
    size_t count;
    double extent; /* of the larger side of the box around them */
} rt_outline;

/*
 * Twice the area of a triangle, positive where a, b, c turn to the left; 0 where rounding of the
 * coordinates may have made all of it.
 */
double rt_outline_turn(const rt_outline *outline, const double a[2], const double b[2],
                       const double c[2]);

/*
 * Steps that a corner is worth: what takes more than that for each corner is given up. There are
 * fewer where it is known already that no cut is right.
 */
#define RT_OUTLINE_STEPS 1024
#define RT_OUTLINE_FEWER_STEPS 64

/*
 * Whether edges cross, at a point inside of both: 1 or 0; -1 where that took too many steps, -2
 * without memory.
 */
int rt_outline_crosses(const rt_outline *outline);

/*
 * Cuts the polygon into count - 2 triangles, numbers of corners. Lowers *found, which begins as
 * what is known already. Returns 0 without memory.
 *
 * Reference: D. Eberly, "Triangulation by Ear Clipping", 2002. Corners may touch edges and each
 * other, as those of a hole that a bridge joins to the outline do.
 */
int rt_outline_cut(uint32_t (*triangles)[3], rt_polygon *found, const rt_outline *outline);

#endif
