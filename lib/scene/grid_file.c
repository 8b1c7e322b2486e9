/* grid_file.c - reads files of grids of densities and albedos. */
#include "scene/grid_file.h"

#include <math.h>
#include <string.h>

#include "base/file.h"
#include "base/memory.h"
#include "base/wire.h"

static const char magic[] = "RTGRID"; /* then the number of channels, as a digit, and a line feed */

rt_status rt_grid_count(size_t *out, const rt_u32 size[4], rt_error *error)
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
    *out = (size_t)count * size[3];
    return RT_OK;
}

rt_status rt_grid_check(const float *values, const rt_u32 size[4], rt_error *error)
{
    static const char *const word[] = {"density", "red", "green", "blue"};
    for (rt_u32 z = 0; z < size[2]; z++)
        for (rt_u32 y = 0; y < size[1]; y++)
            for (rt_u32 i = 0; i < size[0] * size[3]; i++, values++)
                if (!(*values >= 0 && *values <= 1e28f))
                    return rt_fail_field(error, RT_ERROR_INPUT, "values",
                                         "voxel (%u, %u, %u) has the %s %g; it must lie from 0 to "
                                         "1e+28",
                                         i / size[3], y, z,
                                         word[size[3] == 1 ? 0 : 1 + i % size[3]], *values);
    return RT_OK;
}

/* The channels that the beginning of a file announces; 0: it is no grid. */
static rt_u32 channels_of(const uint8_t *header, size_t size)
{
    const size_t at = sizeof magic - 1;
    if (size < at + 2 || memcmp(header, magic, at) != 0)
        return 0;
    return header[at] == '1' ? 1 : header[at] == '3' ? 3 : 0;
}

/* The numbers of voxels and of channels, by a header that is whole. */
static void read_size(rt_u32 size[4], const uint8_t *header)
{
    rt_reader reader = {header + sizeof magic + 1};
    for (int i = 0; i < 3; i++)
        size[i] = rt_get32(&reader);
    size[3] = channels_of(header, RT_GRID_HEADER);
}

/* The size of the file that a header announces. */
static rt_status size_of_file(uint64_t *out, const uint8_t *header, size_t size, const char *path,
                              rt_error *error)
{
    rt_u32 voxels[4];
    size_t count;
    (void)path;
    const rt_u32 channels = channels_of(header, size);
    if (channels == 0)
        return rt_fail(error, RT_ERROR_INPUT,
                       "not a grid: it does not begin with 'RTGRID1' or 'RTGRID3'");
    if (header[sizeof magic] != '\n')
        return rt_fail(error, RT_ERROR_INPUT,
                       "not a grid: 'RTGRID%u' is followed by byte 0x%02x, and not by a line feed",
                       channels, header[sizeof magic]);
    if (size < RT_GRID_HEADER)
        return rt_fail(error, RT_ERROR_INPUT, "a header of %zu bytes; that of a grid has %u", size,
                       RT_GRID_HEADER);
    read_size(voxels, header);
    rt_status status = rt_grid_count(&count, voxels, error);
    if (status == RT_OK)
        *out = RT_GRID_HEADER + (uint64_t)count * sizeof(float);
    return status;
}

rt_status rt_grid_decode(float **values, rt_u32 size[4], const rt_bytes *file, rt_memory *memory,
                         rt_error *error)
{
    uint64_t whole;
    rt_u32 voxels[4];
    rt_status status = size_of_file(&whole, file->data, file->size, "", error);
    if (status != RT_OK)
        return status;
    rt_reader reader = {file->data + RT_GRID_HEADER};
    read_size(voxels, file->data);
    if (file->size != whole)
        return rt_fail(error, RT_ERROR_INPUT, "%zu bytes; a grid of %u x %u x %u voxels%s has %llu",
                       file->size, voxels[0], voxels[1], voxels[2],
                       voxels[3] == 1 ? "" : " of three channels", (unsigned long long)whole);
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

rt_status rt_grid_read(float **values, rt_u32 size[4], const char *path, rt_memory *memory,
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
