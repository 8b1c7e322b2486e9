/* loop.h - subdivision surfaces of triangles. */
#ifndef RT_DSL_IMPORT_LOOP_H
#define RT_DSL_IMPORT_LOOP_H

#include "dsl/import/import.h"

/* How often a mesh is subdivided at most, and to how many triangles. */
enum { LOOP_LEVELS_MAX = 6, LOOP_TRIANGLES_MAX = 4000000 };

/* The levels of those asked for that a mesh of so many triangles gets, within both limits. */
int rt_loop_levels(size_t triangle_count, double wanted);

/*
 * Subdivides a mesh of positions and indices by Loop's scheme, and moves its vertices to the limit
 * surface, whose normals they get, on the side from which its triangles run counter-clockwise.
 * Returns 0, and leaves the mesh as it is, where an edge has more than two triangles, or two that
 * run along it the same way, where a vertex has several fans of them, or a triangle has a vertex
 * twice; and after a failure.
 */
int rt_loop_subdivide(importer *import, int levels, import_mesh *mesh);

#endif
