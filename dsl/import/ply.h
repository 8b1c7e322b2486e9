/* ply.h - PLY files that an import copies. */
#ifndef RT_DSL_IMPORT_PLY_H
#define RT_DSL_IMPORT_PLY_H

#include "dsl/import/import.h"

/*
 * Where the reading of a header is. Its first line says which character ends all: the other is
 * white space.
 */
typedef struct ply_lines {
    char *at, *end;
    char newline;
} ply_lines;
ply_lines rt_import_ply_lines(char *bytes, size_t size);

/* The length of the next word of the line, 0 where there is none; it is before lines->at then. */
size_t rt_import_ply_word(ply_lines *lines);

/* The same, and whether it is this one. */
int rt_import_ply_is(ply_lines *lines, const char *wanted);

/* Goes to the next line; returns 0 at the end. */
int rt_import_ply_next(ply_lines *lines);

/* Whether the header, in bytes[size], gives the vertices such a property. */
int rt_import_ply_has_property(char *bytes, size_t size, const char *name);

/*
 * Reads a PLY file that the scene names, as rt_import_read_text: some write a mark before an ASCII
 * one. To be freed; NULL after a failure.
 */
char *rt_import_ply_read(importer *import, int line, const char *name, size_t *size);

/*
 * Writes the file beside the scene as rt_import_write does. Other programs ignore a texture that a
 * comment names; this language would use it, so the comment is changed, with a note at `line`.
 * Colours get the names of an attribute, `color`, unless they are kept; a ramp, unless NULL or of
 * no weight, gives the vertices or faces others, which are seen.
 */
int rt_import_ply_write(importer *import, int line, char out[512], char *bytes, size_t size,
                        import_colours of, const import_ramp *ramp);

/*
 * What it has at its vertices and faces, as Mitsuba names it and as the language does, each between
 * blanks: " vertex_tint_color=tint face_heat=heat ". To be freed; NULL after a failure.
 */
char *rt_import_ply_attributes(importer *import, char *bytes, size_t size);

/*
 * The file, to be freed, with colours of its vertices or faces by a ramp of their weight:
 * ply_ramp.c. NULL where it has no such weight, with a note, or is damaged, or after a failure.
 */
char *rt_import_ply_ramp(importer *import, int line, char *bytes, size_t size, import_colours of,
                         const import_ramp *ramp, size_t *out_size);

#endif
