/* tube.h - tubes about curves, as meshes: rings of vertices that are joined. */
#ifndef RT_DSL_IMPORT_TUBE_H
#define RT_DSL_IMPORT_TUBE_H

#include "dsl/import/import.h"

/* All zero but `around` is one without rings. Its mesh is to be freed. */
typedef struct tube {
    import_mesh mesh;
    uint32_t around; /* sides, 3 or more */
    int is_u_along;  /* u along the curve and v around it; 0: v along and u around */
} tube;

/* A ring: lengths in the unit of the curve, directions of unit length. */
typedef struct tube_ring {
    double centre[3], radius;
    double along[3]; /* the direction of the curve */
    double zero[3];  /* where the coordinate around it is 0, at right angles to it */
    double lean;     /* the sine of the angle by which normals lean against the curve */
    double at;       /* the coordinate along the curve */
} tube_ring;

/* Makes room for as many vertices and triangles; returns 0 after a failure. */
int rt_tube_reserve(importer *import, tube *out, size_t vertices, size_t triangles);

/* A direction at right angles to a curve, which is level where the curve is not upright. */
void rt_tube_zero(const double along[3], double zero[3]);

/*
 * Adds a ring, for whose around + 1 vertices there is room, and joins it to the ring before, by
 * 2 * around triangles that face outward.
 */
void rt_tube_add_ring(tube *out, const tube_ring *ring, int is_joined);

#endif
