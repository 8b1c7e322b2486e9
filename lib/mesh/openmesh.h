/* openmesh.h - from the canonical form, through OpenMesh, to a mesh. */
#ifndef RT_LIB_MESH_OPENMESH_H
#define RT_LIB_MESH_OPENMESH_H

#include "mesh/canonical.h"
#include "mesh/mesh.h"

/*
 * Lets OpenMesh read the canonical form and checks that it handed over every vertex and every
 * triangle. Takes colours and texture out of the canonical form. The caller destroys *out. Fails
 * with RT_ERROR_INPUT, RT_ERROR_MEMORY or RT_CANCELLED.
 */
rt_status rt_mesh_from_canonical(rt_mesh **out, rt_canonical *canonical, const char *path,
                                 rt_stage_progress *progress, rt_error *error);

#endif
