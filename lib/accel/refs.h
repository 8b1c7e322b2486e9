/* refs.h - the builder's references to primitives: bounds and source. */
#ifndef RT_LIB_ACCEL_REFS_H
#define RT_LIB_ACCEL_REFS_H

#include <stdint.h>

#include "accel/input.h"
#include "accel/vec4.h"

/* Sources that are not a mesh; below them, the number of the mesh. */
#define RT_SOURCE_QUADS 0xfffffffeu
#define RT_SOURCE_ANALYTIC 0xffffffffu

/* One primitive: 32 bytes, so that two fill a cache line. */
typedef struct rt_ref {
    float lo[3];
    uint32_t index; /* triangle of the mesh, quad, or analytic entry */
    float hi[3];
    uint32_t source; /* mesh or RT_SOURCE_* */
} rt_ref;

static inline box4 rt_ref_box(const rt_ref *ref)
{
    return (box4){vec4_load(ref->lo), vec4_load(ref->hi)};
}

/* Twice the centre of the reference's box; the fourth lane is 0. */
static inline vec4 rt_ref_centre(const rt_ref *ref)
{
    const vec4 sum = vec4_load(ref->lo) + vec4_load(ref->hi);
    const ivec4 keep = {-1, -1, -1, 0};
    return (vec4)((ivec4)sum & keep);
}

/* Primitives of the input. */
uint64_t rt_refs_count(const rt_bvh_input *input);

/* Fills refs[rt_refs_count(input)], in the order meshes, quads, analytic entries. */
void rt_refs_fill(rt_ref *refs, const rt_bvh_input *input, uint32_t threads);

/*
 * The reference's vertices v0, v1, v2 as rt_tri_block holds them; not for analytic entries. Returns
 * its prim word.
 */
uint32_t rt_ref_vertices(const rt_bvh_input *input, uint32_t source, uint32_t index, float v[3][3]);

#endif
