/* heights.h - height fields, as meshes. */
#ifndef RT_DSL_IMPORT_HEIGHTS_H
#define RT_DSL_IMPORT_HEIGHTS_H

#include "dsl/import/import.h"

/* The most of a field. */
enum { HEIGHTS_MAX = 1 << 24 };

/*
 * Makes the mesh of heights z[rows][columns], at least two of each and HEIGHTS_MAX in all, whose
 * first is at (from, from) and whose last at (1, 1); u and v go from 0 to 1. Its faces look to +z,
 * and are parted from their lowest to their highest corner in x and y. It has no normals, and is
 * freed in any case; 0 after a failure.
 */
int rt_import_heights(importer *import, const double *z, size_t columns, size_t rows, double from,
                      import_mesh *out);

#endif
