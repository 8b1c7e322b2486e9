/* source.h - the file that a mesh is read from, and its readers' errors, log and progress. */
#ifndef RT_LIB_MESH_SOURCE_H
#define RT_LIB_MESH_SOURCE_H

#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "base/progress.h"

typedef struct rt_mesh_source {
    const char *path;
    const uint8_t *data; /* the whole file */
    size_t size;
    rt_stage_progress *progress;
    rt_error *error; /* may be NULL */
} rt_mesh_source;

/*
 * Fails with RT_ERROR_INPUT at a line of the file, or at the file as a whole (line 0). The loader
 * adds its name.
 */
rt_status rt_mesh_fail(const rt_mesh_source *source, size_t line, const char *format, ...)
    RT_PRINTF(3, 4);

/* Fails with RT_ERROR_MEMORY, naming what did not fit. */
rt_status rt_mesh_fail_memory(const rt_mesh_source *source, uint64_t count, const char *what);

/* Tells the log something about the file. */
void rt_mesh_log(const rt_mesh_source *source, const char *format, ...) RT_PRINTF(2, 3);

/*
 * Reports progress, `done` of `all`; RT_CANCELLED when asked to stop. Cheap enough for every few
 * thousand elements.
 */
rt_status rt_mesh_step(const rt_mesh_source *source, uint64_t done, uint64_t all);

#endif
