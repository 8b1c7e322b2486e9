/* grid.c - files of grids: a word, counts along x, y and z, and voxels, x first. */
#include <stdlib.h>
#include <string.h>

#include "dsl/import/import.h"

enum { GRID_HEAD = 20 };

static void put_number(char *bytes, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        bytes[i] = (char)(value >> 8 * i & 0xff);
}

int rt_import_write_grid(importer *import, char out[512], const uint32_t counts[3], size_t channels,
                         const float *voxels)
{
    const size_t count = (size_t)counts[0] * counts[1] * counts[2] * channels;
    char *const bytes = malloc(GRID_HEAD + 4 * count);
    if (!bytes)
        return rt_import_fail_memory(import);
    memcpy(bytes, channels == 3 ? "RTGRID3\n" : "RTGRID1\n", 8);
    for (int i = 0; i < 3; i++)
        put_number(bytes + 8 + 4 * i, counts[i]);
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, voxels + i, sizeof bits);
        put_number(bytes + GRID_HEAD + 4 * i, bits);
    }
    const int is_written =
        rt_import_write(import, out, "grid", ".grid", bytes, GRID_HEAD + 4 * count);
    free(bytes);
    return is_written;
}
