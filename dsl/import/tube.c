/* tube.c - rings of vertices about curves, and the triangles between them. */
#include "dsl/import/tube.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int rt_tube_reserve(importer *import, tube *out, size_t vertices, size_t triangles)
{
    import_mesh *const mesh = &out->mesh;
    mesh->positions = malloc((3 * vertices + 1) * sizeof *mesh->positions);
    mesh->normals = malloc((3 * vertices + 1) * sizeof *mesh->normals);
    mesh->uv = malloc((2 * vertices + 1) * sizeof *mesh->uv);
    mesh->indices = malloc((3 * triangles + 1) * sizeof *mesh->indices);
    if (!mesh->positions || !mesh->normals || !mesh->uv || !mesh->indices)
        return rt_import_fail_memory(import);
    return 1;
}

void rt_tube_zero(const double along[3], double zero[3])
{
    zero[0] = -along[1];
    zero[1] = along[0];
    zero[2] = 0;
    if (!rt_vector_normalize(zero))
        zero[0] = 1;
}

void rt_tube_add_ring(tube *out, const tube_ring *ring, int is_joined)
{
    import_mesh *const mesh = &out->mesh;
    const uint32_t start = (uint32_t)mesh->vertex_count, n = out->around;
    const double upright = sqrt(1 - ring->lean * ring->lean);
    double quarter[3];
    rt_vector_cross(quarter, ring->along, ring->zero);
    for (uint32_t i = 0; i <= n; i++) {
        const double angle = 2 * IMPORT_PI * i / n;
        for (int c = 0; c < 3; c++) {
            const double out_wards = cos(angle) * ring->zero[c] + sin(angle) * quarter[c];
            mesh->positions[3 * (start + i) + (uint32_t)c] =
                (float)(ring->centre[c] + ring->radius * out_wards);
            mesh->normals[3 * (start + i) + (uint32_t)c] =
                (float)(upright * out_wards - ring->lean * ring->along[c]);
        }
        mesh->uv[2 * (start + i) + (out->is_u_along ? 1 : 0)] = (float)i / (float)n;
        mesh->uv[2 * (start + i) + (out->is_u_along ? 0 : 1)] = (float)ring->at;
    }
    mesh->vertex_count += n + 1;
    for (uint32_t i = start; is_joined && i < start + n; i++) {
        const uint32_t corners[6] = {i - n - 1, i - n, i + 1, i - n - 1, i + 1, i};
        memcpy(mesh->indices + 3 * mesh->triangle_count, corners, sizeof corners);
        mesh->triangle_count += 2;
    }
}
