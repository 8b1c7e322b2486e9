/* serialized.h - meshes in the compressed binary files of Mitsuba. */
#ifndef RT_DSL_IMPORT_SERIALIZED_H
#define RT_DSL_IMPORT_SERIALIZED_H

#include "dsl/import/import.h"

/*
 * One of the meshes of a file that the scene names, the first is 0; *is_flat: it has the normals of
 * its faces. Returns 0 after a failure; a mesh is to be freed by rt_import_mesh_free in any case.
 */
int rt_serialized_read(importer *import, int line, const char *name, size_t index, import_mesh *out,
                       int *is_flat);

#endif
