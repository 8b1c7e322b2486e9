/*
 * vdb.c - opens the module that reads files of OpenVDB, and calls it.
 *
 * Where none is named it is looked for by its name alone, as the system finds libraries; then
 * beside the library or the program that this is a part of, and in the folder lib beside that.
 */
#define _GNU_SOURCE /* dladdr */
#include "scene/vdb.h"

#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "scene/grid_file.h"
#include "scene/vdb_module.h"

#define MODULE "librt-render-vdb.so.0"

int rt_vdb_is_named(const char *path)
{
    const char *end = strrchr(path, '.');
    return end && (strcasecmp(end, ".vdb") == 0 || strcasecmp(end, ".nvdb") == 0);
}

/* Opens the module in a folder beside what this function is in. */
static void *open_beside(const char *folder)
{
    char path[4096];
    Dl_info self;
    if (!dladdr(MODULE, &self) || !self.dli_fname)
        return NULL;
    const char *slash = strrchr(self.dli_fname, '/');
    const int length = slash ? (int)(slash + 1 - self.dli_fname) : 0;
    const int size = snprintf(path, sizeof path, "%.*s%s%s", length, slash ? self.dli_fname : "./",
                              folder, MODULE);
    return size < (int)sizeof path ? dlopen(path, RTLD_NOW | RTLD_LOCAL) : NULL;
}

/* The module, which stays open: OpenVDB keeps tables for as long as the process runs. */
static const rt_vdb_module *find_module(const char *path)
{
    void *library = dlopen(path ? path : MODULE, RTLD_NOW | RTLD_LOCAL);
    if (!library && !path)
        library = open_beside("");
    if (!library && !path)
        library = open_beside("../lib/");
    return library ? dlsym(library, RT_VDB_MODULE_NAME) : NULL;
}

/* Takes what was opened over into `out`. */
static rt_status take(rt_vdb *out, const rt_vdb_module *module, void *handle,
                      const rt_vdb_info *info, rt_memory *memory, rt_error *error)
{
    size_t count;
    memcpy(out->size, info->size, sizeof out->size);
    memcpy(out->to_world.m, info->to_world, sizeof out->to_world.m);
    out->background = info->background;
    rt_status status = rt_grid_count(&count, out->size, error);
    if (status != RT_OK)
        return status;
    out->values = rt_memory_alloc(memory, count, sizeof *out->values, "a grid", error);
    if (!out->values)
        return RT_ERROR_MEMORY;
    if (module->copy(handle, out->values) != 0)
        status = rt_fail(error, RT_ERROR_MEMORY, "OpenVDB lacks memory for its voxels");
    else
        status = rt_grid_check(out->values, out->size, error);
    if (status != RT_OK) {
        rt_memory_free(out->values);
        out->values = NULL;
    }
    return status;
}

/* Whether there is a regular file that can be opened. */
static rt_status check_readable(const char *path, rt_error *error)
{
    char cause[RT_CAUSE_SIZE];
    rt_status status = rt_file_check_regular(path, error);
    FILE *file = status == RT_OK ? fopen(path, "rb") : NULL;
    if (file)
        fclose(file);
    else if (status == RT_OK)
        status =
            rt_fail(error, RT_ERROR_INPUT, "cannot read %.300s: %s", path, rt_cause(cause, errno));
    return status;
}

rt_status rt_vdb_read(rt_vdb *out, const char *path, const char *name, const char *module_path,
                      rt_memory *memory, rt_error *error)
{
    rt_vdb_info info;
    char message[384];
    memset(out, 0, sizeof *out);
    memset(&info, 0, sizeof info);
    rt_status status = check_readable(path, error);
    if (status == RT_OK && module_path && !*module_path)
        status = rt_fail(error, RT_ERROR_INPUT,
                         "files of OpenVDB are read by a module, and none may be opened here");
    const rt_vdb_module *module = status == RT_OK ? find_module(module_path) : NULL;
    if (status == RT_OK && !module)
        status = rt_fail(error, RT_ERROR_INPUT,
                         "files of OpenVDB are read by its library: install libopenvdb-dev, then "
                         "build and install librt anew for the module " MODULE
                         "; or write the voxels as RTGRID");
    void *handle = module ? module->open(path, name, &info, message, sizeof message) : NULL;
    if (module && !handle)
        status = rt_fail(error, RT_ERROR_INPUT, "%s", message);
    if (handle) {
        status = take(out, module, handle, &info, memory, error);
        module->close(handle);
    }
    return rt_at_file(status, path, error);
}
