/* settle.c - positions of a mesh in single precision, relative to an origin of its own. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "mesh/canonical.h"
#include "mesh/origin.h"

static uint32_t corner_of(const rt_canonical *mesh, uint32_t triangle, int corner)
{
    uint32_t vertex;
    memcpy(&vertex, mesh->faces + (size_t)triangle * RT_CANONICAL_FACE + 1 + 4 * corner,
           sizeof vertex);
    return vertex;
}

/* The bounds of what is seen. */
static void measure(double lo[3], double hi[3], const rt_canonical *mesh)
{
    for (int i = 0; i < 3; i++) {
        lo[i] = INFINITY;
        hi[i] = -INFINITY;
    }
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (int corner = 0; corner < 3; corner++) {
            double p[3];
            rt_canonical_point(p, mesh, corner_of(mesh, t, corner));
            for (int i = 0; i < 3; i++) {
                lo[i] = p[i] < lo[i] ? p[i] : lo[i];
                hi[i] = p[i] > hi[i] ? p[i] : hi[i];
            }
        }
}

static int has_origin(const rt_canonical *mesh)
{
    return mesh->origin[0] != 0 || mesh->origin[1] != 0 || mesh->origin[2] != 0;
}

/* What no triangle has may lie anywhere, but is finite. */
static void round_all(rt_canonical *mesh)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        double p[3];
        float *out = rt_canonical_position(mesh, i);
        rt_canonical_point(p, mesh, i);
        for (int c = 0; c < 3; c++)
            out[c] = (float)fmax(fmin(p[c] - mesh->origin[c], FLT_MAX), -FLT_MAX);
    }
}

static void warn_of_rounding(rt_canonical *mesh, const rt_mesh_source *source)
{
    rt_rounding rounding = {0, 0, 0};
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        double exact[3][3], rounded[3][3];
        for (int corner = 0; corner < 3; corner++) {
            const uint32_t vertex = corner_of(mesh, t, corner);
            const float *position = rt_canonical_position(mesh, vertex);
            rt_canonical_point(exact[corner], mesh, vertex);
            for (int c = 0; c < 3; c++)
                rounded[corner][c] = position[c] + mesh->origin[c];
        }
        rt_rounding_add(&rounding, (const double(*)[3])exact, (const double(*)[3])rounded);
    }
    if (rounding.triangles)
        rt_mesh_warn(&mesh->warnings, source, 0,
                     "single precision moves vertices of %llu of %u triangles by up to %.2g, %.2g "
                     "of a triangle",
                     (unsigned long long)rounding.triangles, mesh->triangle_count, rounding.length,
                     rounding.part);
}

void rt_canonical_settle(rt_canonical *mesh, const rt_mesh_source *source)
{
    double lo[3], hi[3];
    if (mesh->triangle_count > 0 && !mesh->has_origin) {
        measure(lo, hi, mesh);
        rt_mesh_origin(mesh->origin, lo, hi);
    }
    if (mesh->exact || (!mesh->has_origin && has_origin(mesh)))
        round_all(mesh);
    if (mesh->exact)
        warn_of_rounding(mesh, source);
    rt_memory_free(mesh->exact);
    mesh->exact = NULL;
}
