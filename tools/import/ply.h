/* ply.h - PLY files that an import copies. */
#ifndef RTC_IMPORT_PLY_H
#define RTC_IMPORT_PLY_H

#include "import.h"

/* Whether the header, in bytes[size], gives the vertices such a property. */
int ply_has_property(char *bytes, size_t size, const char *name);

/*
 * Writes the file beside the scene as import_write does. Other programs ignore a texture that a
 * comment names; this language would use it, so the comment is changed, with a note at `line`.
 */
int ply_write(importer *import, int line, char out[512], char *bytes, size_t size);

#endif
