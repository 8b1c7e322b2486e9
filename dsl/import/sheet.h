/* sheet.h - glass of meshes that do not close, for which other programs have no word. */
#ifndef RT_DSL_IMPORT_SHEET_H
#define RT_DSL_IMPORT_SHEET_H

#include "dsl/import/import.h"

/*
 * Sets out[i], of each triangle, to whether it lies in a sheet: those that corners at one place
 * join face as much to one side as to the other where they close a solid, and here do not.
 * positions: of vertices [..][3], indices [triangle_count][3]. Returns 0 after a failure.
 */
int rt_import_find_sheets(importer *import, const float *positions, const uint32_t *indices,
                          size_t triangle_count, unsigned char *out);

/* Brings the triangles that are in sheets behind the others; returns how many those are. */
size_t rt_import_part_sheets(importer *import, import_mesh *mesh, const unsigned char *is_sheet);

/*
 * Makes solid glass a thin sheet that reflects as one boundary of it does, and colours light as
 * that: as Cycles shows it, which refracts at a sheet, and scales no radiance there. It is told,
 * with its name unless that is NULL.
 */
void rt_import_make_sheet(importer *import, int line, const char *name, import_material *m);

#endif
