/* source.c - errors, log and progress of the mesh readers. */
#include "mesh/source.h"

#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

rt_status rt_mesh_fail(const rt_mesh_source *source, size_t line, const char *format, ...)
{
    char message[512];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    rt_fail(source->error, RT_ERROR_INPUT, "%s", message);
    if (source->error)
        source->error->line = line <= INT_MAX ? (int)line : 0;
    return RT_ERROR_INPUT;
}

static const char what[] = "a mesh";

/* As many as a size_t holds: more do not fit anyway. */
static size_t clamp(uint64_t count)
{
    return count < SIZE_MAX ? (size_t)count : SIZE_MAX;
}

rt_status rt_mesh_resize(const rt_mesh_source *source, void **array, uint64_t count, size_t size)
{
    void *block = rt_memory_resize(source->memory, *array, clamp(count), size, what, source->error);
    if (!block)
        return RT_ERROR_MEMORY;
    *array = block;
    return RT_OK;
}

rt_status rt_mesh_zeroed(const rt_mesh_source *source, void **array, uint64_t count, size_t size)
{
    *array = rt_memory_zeroed(source->memory, clamp(count), size, what, source->error);
    return *array ? RT_OK : RT_ERROR_MEMORY;
}

void rt_mesh_log(const rt_mesh_source *source, const char *format, ...)
{
    char line[512];
    va_list args;
    va_start(args, format);
    vsnprintf(line, sizeof line, format, args);
    va_end(args);
    rt_log(source->progress->hooks, "%s: %s", source->path, line);
}

void rt_mesh_warnings_add(rt_mesh_warnings *warnings, const char *path, size_t line,
                          const char *message)
{
    const char *slash = strrchr(path, '/');
    char place[32] = "";
    if (warnings->count == RT_MESH_WARNINGS)
        return;
    if (line)
        snprintf(place, sizeof place, ":%zu", line);
    snprintf(warnings->text[warnings->count++], sizeof *warnings->text, "%.60s%s: %.160s",
             slash ? slash + 1 : path, place, message);
}

void rt_mesh_warn(rt_mesh_warnings *warnings, const rt_mesh_source *source, size_t line,
                  const char *format, ...)
{
    char message[sizeof *warnings->text];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    if (line)
        rt_mesh_log(source, "line %zu: %s", line, message);
    else
        rt_mesh_log(source, "%s", message);
    rt_mesh_warnings_add(warnings, source->path, line, message);
}

rt_status rt_mesh_step(const rt_mesh_source *source, uint64_t done, uint64_t all)
{
    /* OpenMesh has the second half. */
    return rt_stage_update(source->progress, all ? 0.5 * (double)done / (double)all : 0.0);
}
