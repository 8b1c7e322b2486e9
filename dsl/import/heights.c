/* heights.c - height fields, as meshes of two triangles for each cell. */
#include "dsl/import/heights.h"

#include <stdlib.h>
#include <string.h>

static void put_cell(uint32_t *out, uint32_t first, uint32_t columns)
{
    const uint32_t corners[6] = {first, first + 1,           first + columns + 1,
                                 first, first + columns + 1, first + columns};
    memcpy(out, corners, sizeof corners);
}

int rt_import_heights(importer *import, const double *z, size_t columns, size_t rows, double from,
                      import_mesh *out)
{
    const size_t cells = (columns - 1) * (rows - 1);
    memset(out, 0, sizeof *out);
    out->vertex_count = columns * rows;
    out->triangle_count = 2 * cells;
    out->positions = malloc(3 * out->vertex_count * sizeof *out->positions);
    out->uv = malloc(2 * out->vertex_count * sizeof *out->uv);
    out->indices = malloc(6 * cells * sizeof *out->indices);
    if (!out->positions || !out->uv || !out->indices)
        return rt_import_fail_memory(import);
    for (size_t i = 0; i < out->vertex_count; i++) {
        const double u = (double)(i % columns) / (double)(columns - 1),
                     v = (double)(i / columns) / (double)(rows - 1);
        out->uv[2 * i] = (float)u;
        out->uv[2 * i + 1] = (float)v;
        out->positions[3 * i] = (float)(from + (1 - from) * u);
        out->positions[3 * i + 1] = (float)(from + (1 - from) * v);
        out->positions[3 * i + 2] = (float)z[i];
    }
    for (size_t i = 0; i < cells; i++) {
        const size_t row = i / (columns - 1), column = i % (columns - 1);
        put_cell(out->indices + 6 * i, (uint32_t)(row * columns + column), (uint32_t)columns);
    }
    return 1;
}
