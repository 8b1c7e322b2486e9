/* sheet.h - glass of meshes that do not close, for which other programs have no word. */
#ifndef RT_DSL_IMPORT_SHEET_H
#define RT_DSL_IMPORT_SHEET_H

#include "dsl/import/import.h"

/* What triangles that meet at places are part of. */
typedef enum import_piece {
    IMPORT_PIECE_CLOSED, /* they face as much to one side as to the other: a solid */
    IMPORT_PIECE_OPEN,   /* not so, as of a cup without a wall */
    IMPORT_PIECE_SHEET   /* most look to one side, so that light crosses it once */
} import_piece;

/*
 * Sets out[i] to the import_piece of each triangle. positions: of vertices [..][3], indices
 * [triangle_count][3]. Returns 0 after a failure.
 */
int rt_import_find_sheets(importer *import, const float *positions, const uint32_t *indices,
                          size_t triangle_count, unsigned char *out);

/*
 * Brings the triangles that are in sheets behind the others; returns how many those are. What is
 * open, but no sheet, is told.
 */
size_t rt_import_part_sheets(importer *import, import_mesh *mesh, const unsigned char *pieces);

/*
 * Makes solid glass a thin sheet that reflects as one boundary of it does, and colours light as
 * that: as Cycles shows it, which refracts at a sheet, and scales no radiance there. It is told,
 * with its name unless that is NULL.
 */
void rt_import_make_sheet(importer *import, int line, const char *name, import_material *m);

#endif
