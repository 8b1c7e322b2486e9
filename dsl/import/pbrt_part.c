/*
 * pbrt_part.c - parts of spheres, cylinders and discs, which the language has whole alone, as
 * meshes with the normals and the u and v of pbrt-v4.
 *
 * Reference:
 *   Pharr, Jakob, Humphreys: "Physically Based Rendering", 4th ed., sections 6.2 to 6.4.
 */
#include <math.h>
#include <stdlib.h>

#include "dsl/import/pbrt.h"

/* Faces around a whole turn, which are off by 8e-5 of the radius at most, and along half of it. */
enum { AROUND = 256, ALONG = 128 };

/* The point at the angle phi and the part v of the length, its normal outwards. */
static void point_at(const pbrt_part *part, double phi, double v, double point[3], double normal[3])
{
    const double r = part->radius;
    double across = r, height = part->z[0] + v * (part->z[1] - part->z[0]), tilt = 0;
    if (part->kind == PBRT_PART_SPHERE) {
        const double from = acos(fmin(fmax(part->z[0] / r, -1), 1)),
                     to = acos(fmin(fmax(part->z[1] / r, -1), 1)), theta = from + v * (to - from);
        across = r * sin(theta);
        height = r * cos(theta);
        tilt = cos(theta);
    } else if (part->kind == PBRT_PART_DISK) {
        across = r + v * (part->inner - r);
        tilt = 1;
    }
    const double level = sqrt(1 - tilt * tilt), x = cos(phi), y = sin(phi);
    const double p[3] = {across * x, across * y, height}, n[3] = {level * x, level * y, tilt};
    for (int c = 0; c < 3; c++) {
        point[c] = p[c];
        normal[c] = n[c];
    }
}

static int reserve(pbrt *p, import_mesh *mesh, size_t columns, size_t rows)
{
    mesh->vertex_count = (columns + 1) * (rows + 1);
    mesh->triangle_count = 2 * columns * rows;
    mesh->positions = malloc(3 * mesh->vertex_count * sizeof *mesh->positions);
    mesh->normals = malloc(3 * mesh->vertex_count * sizeof *mesh->normals);
    mesh->uv = malloc(2 * mesh->vertex_count * sizeof *mesh->uv);
    mesh->indices = malloc(3 * mesh->triangle_count * sizeof *mesh->indices);
    return (mesh->positions && mesh->normals && mesh->uv && mesh->indices) ||
           rt_import_fail_memory(p->import);
}

static void fill(import_mesh *mesh, const pbrt_part *part, size_t columns, size_t rows, double side)
{
    uint32_t *to = mesh->indices;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const double u = (double)(i % (columns + 1)) / (double)columns,
                     v = (double)(i / (columns + 1)) / (double)rows;
        double point[3], normal[3];
        point_at(part, u * part->phi, v, point, normal);
        for (int c = 0; c < 3; c++) {
            mesh->positions[3 * i + (size_t)c] = (float)point[c];
            mesh->normals[3 * i + (size_t)c] = (float)(side * normal[c]);
        }
        mesh->uv[2 * i] = (float)u;
        mesh->uv[2 * i + 1] = (float)v;
    }
    for (size_t y = 0; y < rows; y++)
        for (size_t x = 0; x < columns; x++) {
            const uint32_t a = (uint32_t)(y * (columns + 1) + x), b = a + 1,
                           c = a + (uint32_t)columns + 1, d = c + 1;
            const uint32_t corners[6] = {a, b, d, a, d, c};
            for (int k = 0; k < 6; k++)
                *to++ = corners[k];
        }
}

void rt_pbrt_make_part(pbrt *p, int line, const pbrt_part *part, pbrt_item *item)
{
    const size_t columns = (size_t)fmax(ceil(AROUND * part->phi / (2 * IMPORT_PI)), 1),
                 rows = part->kind == PBRT_PART_SPHERE ? ALONG : 1;
    import_mesh mesh = {0};
    if (reserve(p, &mesh, columns, rows)) {
        fill(&mesh, part, columns, rows, p->state.is_reversed ? -1 : 1);
        rt_pbrt_face_normals(&mesh);
        item->mesh = rt_pbrt_add_mesh(p, line, &mesh, item);
    }
    rt_import_mesh_free(&mesh);
}
