/* ears.h - triangles of a polygon in the plane, by clipping ears. */
#ifndef RT_LIB_MESH_EARS_H
#define RT_LIB_MESH_EARS_H

#include <stddef.h>
#include <stdint.h>

#include "mesh/box_tree.h"

/* The corners of a polygon in the plane: finite, and counter-clockwise where it is simple. */
typedef struct rt_outline {
    const double (*points)[2];
    size_t count;
    double extent; /* the farthest that a corner is from the first along an axis of space */
    const rt_mesh_source *source; /* whose memory it takes, and which may cancel it */
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

/* Whether the tree has taken fewer than so many steps for each corner, and nobody cancels. */
int rt_outline_may_go_on(const rt_outline *outline, rt_box_tree *tree, uint64_t steps);

/*
 * Sets *found, RT_POLYGON_SIMPLE before, where edges cross at a point inside of both, or where
 * that took too many steps. Fails with RT_ERROR_MEMORY, and RT_CANCELLED.
 */
rt_status rt_outline_cross(rt_polygon *found, const rt_outline *outline);

/*
 * Cuts the polygon into count - 2 triangles, numbers of corners. Lowers *found, which begins as
 * what is known already. Fails as rt_outline_cross.
 *
 * Reference: D. Eberly, "Triangulation by Ear Clipping", 2002. Corners may touch edges and each
 * other, as those of a hole that a bridge joins to the outline do.
 */
rt_status rt_outline_cut(uint32_t (*triangles)[3], rt_polygon *found, const rt_outline *outline);

/* rt_polygon_cut for a polygon of a file; it may be cancelled. */
rt_status rt_polygon_cut_of(uint32_t *triangles, rt_polygon *found, const double *corners,
                            size_t count, const rt_mesh_source *source);

#endif
