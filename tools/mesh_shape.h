/* mesh_shape.h - surfaces given by formulas, as grids of any fineness. */
#ifndef RTC_MESH_SHAPE_H
#define RTC_MESH_SHAPE_H

#include <stdint.h>

typedef enum mesh_kind {
    MESH_SPHERE,
    MESH_TORUS,
    MESH_KNOT,
    MESH_TERRAIN,
    MESH_KIND_COUNT
} mesh_kind;

/* The word for each kind. */
extern const char *const mesh_kind_names[MESH_KIND_COUNT];

/* A point of a surface; the normal has length 1 and points outwards, or up. */
typedef struct mesh_point {
    double position[3], normal[3];
} mesh_point;

/*
 * The point at u, v, both in [0,1]. All fit in the cube from -1 to 1 and have y up.
 * sphere: radius 1; u longitude from +x towards +z, v latitude from the south pole.
 * torus: around the y axis, radii 0.7 and 0.3; u around the axis, v around the tube.
 * knot: a tube of radius 0.13 along the trefoil, the (2,3) torus knot; u along it, v around it.
 * terrain: hills over the square; u along x, v along -z.
 */
mesh_point mesh_shape_point(mesh_kind kind, double u, double v);

/* The grid of a surface: columns along u, rows along v. */
typedef struct mesh_grid {
    mesh_kind kind;
    uint64_t columns, rows;
    uint64_t vertices, triangles;
} mesh_grid;

/* The grid with about so many triangles, and about square cells. */
mesh_grid mesh_grid_plan(mesh_kind kind, uint64_t triangles);

/*
 * The triangles of a cell, counter-clockwise from outside, as vertices counted row by row. Returns
 * how many: two, or one at the poles of the sphere, where the other has no area.
 */
int mesh_grid_cell(const mesh_grid *grid, uint64_t column, uint64_t row, uint32_t triangles[2][3]);

#endif
