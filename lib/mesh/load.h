/* load.h - reads a triangle mesh from a file: PLY, OBJ, OFF or STL. */
#ifndef RT_LIB_MESH_LOAD_H
#define RT_LIB_MESH_LOAD_H

#include "mesh/mesh.h"
#include "rt.h"

/*
 * Reads a mesh. The format is detected from the content, else from the extension. Reports
 * RT_STAGE_LOAD to the hooks (may be NULL), and to the log what was left out or made up. Fails with
 * RT_ERROR_INPUT, error->file and, in a text file, error->line set; RT_ERROR_MEMORY; or
 * RT_CANCELLED. The caller destroys *out.
 */
rt_status rt_mesh_load(rt_mesh **out, const char *path, const rt_hooks *hooks, rt_error *error);

/* The same, with a mesh that counts in `memory`, as does its file while it is read. */
rt_status rt_mesh_load_in(rt_mesh **out, const char *path, rt_memory *memory, const rt_hooks *hooks,
                          rt_error *error);

#endif
