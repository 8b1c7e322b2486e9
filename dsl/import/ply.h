/* ply.h - PLY files that an import copies. */
#ifndef RT_DSL_IMPORT_PLY_H
#define RT_DSL_IMPORT_PLY_H

#include "dsl/import/import.h"

/* Whether the header, in bytes[size], gives the vertices such a property. */
int rt_import_ply_has_property(char *bytes, size_t size, const char *name);

/*
 * Reads a PLY file that the scene names, as rt_import_read_text: some write a mark before an ASCII
 * one. To be freed; NULL after a failure.
 */
char *rt_import_ply_read(importer *import, int line, const char *name, size_t *size);

/*
 * Writes the file beside the scene as rt_import_write does. Other programs ignore a texture that a
 * comment names; this language would use it, so the comment is changed, with a note at `line`. The
 * same of colours, which are properties with other names then; those of a texture that shows them
 * in Mitsuba are told where it is left out.
 * `shown` are kept, and those that Mitsuba calls color_0 and so on have the names of colours then.
 */
int rt_import_ply_write(importer *import, int line, char out[512], char *bytes, size_t size,
                        import_colours shown);

#endif
