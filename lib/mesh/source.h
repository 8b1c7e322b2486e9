/* source.h - the file that a mesh is read from, and its readers' errors, log and progress. */
#ifndef RT_LIB_MESH_SOURCE_H
#define RT_LIB_MESH_SOURCE_H

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "base/memory.h"
#include "base/progress.h"

typedef struct rt_mesh_source {
    const char *path;
    const uint8_t *data; /* the whole file */
    size_t size;
    rt_stage_progress *progress;
    rt_error *error;   /* may be NULL */
    rt_memory *memory; /* that the mesh counts in; NULL: none */
} rt_mesh_source;

/*
 * Fails with RT_ERROR_INPUT at a line of the file, or at the file as a whole (line 0). The loader
 * adds its name.
 */
rt_status rt_mesh_fail(const rt_mesh_source *source, size_t line, const char *format, ...)
    RT_PRINTF(3, 4);

/*
 * Changes the size of an array, NULL at first, of the mesh or of its reader, as rt_memory_resize.
 * Freed by rt_memory_free.
 */
rt_status rt_mesh_resize(const rt_mesh_source *source, void **array, uint64_t count, size_t size);

/* A new array, all zero; the same otherwise. */
rt_status rt_mesh_zeroed(const rt_mesh_source *source, void **array, uint64_t count, size_t size);

/* A number in single precision, in which it may be none: NAN. */
static inline float rt_mesh_single(double value)
{
    return fabs(value) <= FLT_MAX ? (float)value : NAN;
}

/* Tells the log something about the file. */
void rt_mesh_log(const rt_mesh_source *source, const char *format, ...) RT_PRINTF(2, 3);

/* Adds a warning that names the file, and the line where it is not 0, where there is room. */
void rt_mesh_warnings_add(rt_mesh_warnings *warnings, const char *path, size_t line,
                          const char *message);

/* The same, which the log is told too. */
void rt_mesh_warn(rt_mesh_warnings *warnings, const rt_mesh_source *source, size_t line,
                  const char *format, ...) RT_PRINTF(4, 5);

/*
 * Reports progress, `done` of `all`; RT_CANCELLED when asked to stop. Cheap enough for every few
 * thousand elements.
 */
rt_status rt_mesh_step(const rt_mesh_source *source, uint64_t done, uint64_t all);

#endif
