/*
 * vdb_module.h - what the module that is linked with OpenVDB offers. It is opened at run time:
 * OpenVDB takes long to load and is needed by few.
 */
#ifndef RT_LIB_SCENE_VDB_MODULE_H
#define RT_LIB_SCENE_VDB_MODULE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* One grid of a file, as a box of voxels that holds all of its active ones and one more around. */
typedef struct rt_vdb_info {
    uint32_t size[4];      /* voxels along x, y and z, and channels: 1 or 3 */
    double to_world[3][4]; /* from voxels, the first of which is centred at (0.5, 0.5, 0.5) */
    float background;      /* the largest channel of what is outside */
} rt_vdb_info;

/*
 * Opens a file and reads its grid `name`, or where that is NULL "density", or the only one.
 * Returns a handle; NULL: it cannot, and `message` of `room` bytes says why.
 */
typedef void *rt_vdb_open_function(const char *path, const char *name, rt_vdb_info *info,
                                   char *message, size_t room);

/*
 * Copies the voxels to values, [size[2]][size[1]][size[0]][size[3]]. Returns 0, or -1 where OpenVDB
 * cannot, for want of memory.
 */
typedef int rt_vdb_copy_function(void *handle, float *values);
typedef void rt_vdb_close_function(void *handle);

/* The functions of the module, all of them under one name. */
typedef struct rt_vdb_module {
    rt_vdb_open_function *open;
    rt_vdb_copy_function *copy;
    rt_vdb_close_function *close;
} rt_vdb_module;

#define RT_VDB_MODULE_NAME "rt_vdb_module_1" /* another number where any of this changes */

#ifdef __cplusplus
}
#endif
#endif
