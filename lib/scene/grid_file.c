/* grid_file.c - reads files of grids of densities. */
#include "scene/grid_file.h"

#include <math.h>
#include <string.h>

#include "base/file.h"
#include "base/memory.h"
#include "base/wire.h"

static const char magic[9] = "RTGRID1\n";

rt_status rt_grid_count(size_t *out, const rt_u32 size[3], rt_error *error)
{
    uint64_t count = 1;
    for (int i = 0; i < 3; i++) {
        if (size[i] == 0)
            return rt_fail_field(error, RT_ERROR_INPUT, "size",
                                 "a grid of %u x %u x %u voxels has none", size[0], size[1],
                                 size[2]);
        if (size[i] > RT_GRID_VOXELS_MAX / count)
            return rt_fail_field(error, RT_ERROR_INPUT, "size",
                                 "a grid of %u x %u x %u voxels; at most %llu are read", size[0],
                                 size[1], size[2], (unsigned long long)RT_GRID_VOXELS_MAX);
        count *= size[i];
    }
    *out = (size_t)count;
    return RT_OK;
}

rt_status rt_grid_check(const float *values, const rt_u32 size[3], rt_error *error)
{
    for (rt_u32 z = 0; z < size[2]; z++)
        for (rt_u32 y = 0; y < size[1]; y++)
            for (rt_u32 x = 0; x < size[0]; x++, values++)
                if (!(*values >= 0 && *values <= 1e28f))
                    return rt_fail_field(error, RT_ERROR_INPUT, "values",
                                         "voxel (%u, %u, %u) has the density %g; it must lie from "
                                         "0 to 1e+28",
                                         x, y, z, *values);
    return RT_OK;
}

/* The size of the file that a header announces. */
static rt_status size_of_file(uint64_t *out, const uint8_t *header, size_t size, const char *path,
                              rt_error *error)
{
    rt_u32 voxels[3];
    size_t count;
    (void)path;
    if (size >= sizeof magic - 1 && memcmp(header, magic, sizeof magic - 2) == 0 &&
        header[sizeof magic - 2] != '\n')
        return rt_fail(error, RT_ERROR_INPUT,
                       "not a grid: 'RTGRID1' is followed by byte 0x%02x, and not by a line feed",
                       header[sizeof magic - 2]);
    if (size < sizeof magic - 1 || memcmp(header, magic, sizeof magic - 1) != 0)
        return rt_fail(error, RT_ERROR_INPUT, "not a grid: it does not begin with 'RTGRID1'");
    if (size < RT_GRID_HEADER)
        return rt_fail(error, RT_ERROR_INPUT, "a header of %zu bytes; that of a grid has %u", size,
                       RT_GRID_HEADER);
    rt_reader reader = {header + sizeof magic - 1};
    for (int i = 0; i < 3; i++)
        voxels[i] = rt_get32(&reader);
    rt_status status = rt_grid_count(&count, voxels, error);
    if (status == RT_OK)
        *out = RT_GRID_HEADER + (uint64_t)count * sizeof(float);
    return status;
}

rt_status rt_grid_decode(float **values, rt_u32 size[3], const rt_bytes *file, rt_memory *memory,
                         rt_error *error)
{
    uint64_t whole;
    rt_u32 voxels[3];
    rt_status status = size_of_file(&whole, file->data, file->size, "", error);
    if (status != RT_OK)
        return status;
    rt_reader reader = {file->data + sizeof magic - 1};
    for (int i = 0; i < 3; i++)
        voxels[i] = rt_get32(&reader);
    if (file->size != whole)
        return rt_fail(error, RT_ERROR_INPUT, "%zu bytes; a grid of %u x %u x %u voxels has %llu",
                       file->size, voxels[0], voxels[1], voxels[2], (unsigned long long)whole);
    const size_t count = (size_t)(whole - RT_GRID_HEADER) / sizeof(float);
    float *read = rt_memory_alloc(memory, count, sizeof *read, "a grid", error);
    if (!read)
        return RT_ERROR_MEMORY;
    for (size_t i = 0; i < count; i++)
        rt_get_floats(&reader, read + i, 1);
    status = rt_grid_check(read, voxels, error);
    if (status != RT_OK) {
        rt_memory_free(read);
        return status;
    }
    memcpy(size, voxels, sizeof voxels);
    *values = read;
    return RT_OK;
}

rt_status rt_grid_read(float **values, rt_u32 size[3], const char *path, rt_memory *memory,
                       rt_error *error)
{
    rt_bytes file = {.memory = memory};
    rt_status status = rt_file_check_regular(path, error);
    if (status == RT_OK)
        status = rt_file_read_sized(&file, path, RT_GRID_HEADER, size_of_file, 1, error);
    if (status == RT_OK)
        status = rt_grid_decode(values, size, &file, memory, error);
    rt_bytes_free(&file);
    return rt_at_file(status, path, error);
}
