/* vdb.h - densities and albedos from files of OpenVDB and NanoVDB. */
#ifndef RT_LIB_SCENE_VDB_H
#define RT_LIB_SCENE_VDB_H

#include "scene/transform.h"
#include "types.h"

/* A grid of a file; its values are [size[2]][size[1]][size[0]][size[3]]. */
typedef struct rt_vdb {
    float *values;
    rt_u32 size[4];
    rt_affine to_world; /* from voxels, the first of which reaches from (0, 0, 0) to (1, 1, 1) */
    float background;   /* of the outside */
} rt_vdb;

/* Whether a file is one of OpenVDB or NanoVDB, by its name. */
int rt_vdb_is_named(const char *path);

/*
 * Reads the grid `name` of a file; NULL: "density", or the only one. By a module that
 * rt_scene_set_vdb_module explains. out->values count in `memory`,
 * are freed by rt_memory_free. Fails with RT_ERROR_INPUT, also where the module that reads such
 * files is not there.
 */
rt_status rt_vdb_read(rt_vdb *out, const char *path, const char *name, const char *module_path,
                      rt_memory *memory, rt_error *error);

#endif
