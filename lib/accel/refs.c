/* refs.c - fills the references from the input's arrays. */
#include "accel/refs.h"

#include "base/parallel.h"
#include "types.h"

enum { CHUNK = 16384 };

typedef struct fill_job {
    rt_ref *refs;
    const rt_bvh_input *input;
    const rt_bvh_mesh *mesh;
    uint32_t source;
} fill_job;

uint64_t rt_refs_count(const rt_bvh_input *input)
{
    uint64_t count = (uint64_t)input->quad_count + input->analytic_count;
    for (uint32_t i = 0; i < input->mesh_count; i++)
        count += input->meshes[i].triangle_count;
    return count;
}

static void set_ref(rt_ref *ref, box4 box, uint32_t source, uint32_t index)
{
    memcpy(ref->lo, &box.lo, sizeof ref->lo);
    memcpy(ref->hi, &box.hi, sizeof ref->hi);
    ref->index = index;
    ref->source = source;
}

static vec4 load3(const float *p)
{
    return vec4_set(p[0], p[1], p[2]);
}

static void fill_triangles(void *user, uint32_t chunk)
{
    const fill_job *job = user;
    const rt_bvh_mesh *mesh = job->mesh;
    const uint32_t first = chunk * CHUNK;
    const uint32_t left = mesh->triangle_count - first;
    const uint32_t end = first + (left < CHUNK ? left : CHUNK);

    for (uint32_t i = first; i < end; i++) {
        const uint32_t *corner = mesh->indices + 3 * (size_t)i;
        const vec4 a = load3(mesh->positions + 3 * (size_t)corner[0]);
        const vec4 b = load3(mesh->positions + 3 * (size_t)corner[1]);
        const vec4 c = load3(mesh->positions + 3 * (size_t)corner[2]);
        const box4 box = {vec4_min(a, vec4_min(b, c)), vec4_max(a, vec4_max(b, c))};
        set_ref(&job->refs[i], box, job->source, i);
    }
}

/*
 * A parallelogram's box, with room for the 1e-6 by which the intersection moves its far edges, and
 * for rounding.
 */
static box4 quad_box(const rt_bvh_quad *quad)
{
    const vec4 corner = load3(quad->corner), e1 = load3(quad->edge1), e2 = load3(quad->edge2);
    const vec4 b = corner + e1, c = corner + e2, d = corner + (e1 + e2);
    box4 box = {vec4_min(vec4_min(corner, b), vec4_min(c, d)),
                vec4_max(vec4_max(corner, b), vec4_max(c, d))};
    const vec4 edges = vec4_max(e1, -e1) + vec4_max(e2, -e2), reach = vec4_max(-box.lo, box.hi);
    const vec4 room = vec4_all(4e-6f) * edges + vec4_all(0x1p-22f) * reach;
    box.lo -= room;
    box.hi += room;
    return box;
}

void rt_refs_fill(rt_ref *refs, const rt_bvh_input *input, uint32_t threads)
{
    for (uint32_t m = 0; m < input->mesh_count; m++) {
        fill_job job = {refs, input, &input->meshes[m], m};
        const uint32_t count = job.mesh->triangle_count;
        rt_parallel(threads, (count + CHUNK - 1) / CHUNK, fill_triangles, &job);
        refs += count;
    }
    for (uint32_t i = 0; i < input->quad_count; i++)
        set_ref(refs++, quad_box(&input->quads[i]), RT_SOURCE_QUADS, i);
    for (uint32_t i = 0; i < input->analytic_count; i++) {
        const rt_bvh_analytic *entry = &input->analytic[i];
        set_ref(refs++, (box4){load3(entry->lo), load3(entry->hi)}, RT_SOURCE_ANALYTIC, i);
    }
}

uint32_t rt_ref_vertices(const rt_bvh_input *input, uint32_t source, uint32_t index, float v[3][3])
{
    if (source == RT_SOURCE_QUADS) {
        const rt_bvh_quad *quad = &input->quads[index];
        for (int a = 0; a < 3; a++) {
            v[0][a] = quad->corner[a];
            v[1][a] = quad->corner[a] + quad->edge1[a];
            v[2][a] = quad->corner[a] + quad->edge2[a];
        }
        return quad->prim | RT_BLOCK_QUAD;
    }
    const rt_bvh_mesh *mesh = &input->meshes[source];
    const uint32_t *corner = mesh->indices + 3 * (size_t)index;
    for (int i = 0; i < 3; i++)
        memcpy(v[i], mesh->positions + 3 * (size_t)corner[i], sizeof v[i]);
    return mesh->first_prim + index;
}
