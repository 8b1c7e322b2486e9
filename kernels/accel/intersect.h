/*
 * intersect.h - rays against triangles and parallelograms.
 *
 * They come eight to a block and are tested at once, at width 1 one by one, by the watertight test
 * of Woop, Benthin and Wald ("Watertight Ray/Triangle Intersection", JCGT 2(1), 2013): the
 * edge functions of a shared edge are computed from the same numbers for both triangles, so no
 * ray passes between them.
 *
 * t, u and v are those of the ray as given: its direction need not be of unit length.
 */
#ifndef RT_KERNELS_ACCEL_INTERSECT_H
#define RT_KERNELS_ACCEL_INTERSECT_H

#include "math/lanes.h"
#include "math/ray.h"
#include "scene.h"
#include "types.h"

/*
 * The ray's frame for triangles: axis z is the direction's largest component, x and y are sheared
 * along it.
 */
struct ray_frame {
    uint x, y, z; /* axes of the world that are x, y, z of the frame */
    float origin_x, origin_y, origin_z;
    float shear_x, shear_y; /* direction x/z, y/z */
    float scale_z;          /* 1 / direction z */
};

static inline float component(float3 v, uint axis)
{
    return axis == 0u ? v.x : axis == 1u ? v.y : v.z;
}

static inline struct ray_frame make_ray_frame(const struct ray *ray)
{
    const float3 size = fabs(ray->direction);
    struct ray_frame frame;
    frame.z = size.x >= size.y ? (size.x >= size.z ? 0u : 2u) : (size.y >= size.z ? 1u : 2u);
    frame.x = frame.z == 2u ? 0u : frame.z + 1u;
    frame.y = frame.x == 2u ? 0u : frame.x + 1u;
    frame.origin_x = component(ray->origin, frame.x);
    frame.origin_y = component(ray->origin, frame.y);
    frame.origin_z = component(ray->origin, frame.z);
    frame.scale_z = 1.0f / component(ray->direction, frame.z);
    frame.shear_x = component(ray->direction, frame.x) * frame.scale_z;
    frame.shear_y = component(ray->direction, frame.y) * frame.scale_z;
    return frame;
}

#if RT_WIDTH > 1
/*
 * Where the ray meets the lanes of a block, each multiplied by det; meaningful in the lanes that
 * are hit.
 */
struct block_hits {
    float8 t, u, v;
    float8 det; /* above 0 */
};

/* The same divided by det, to be read lane by lane. */
struct lane_hits {
    struct lane_array t, u, v;
};

INLINE_ALWAYS struct lane_hits lane_hits(const struct block_hits *found)
{
    const float8 scale = 1.0f / found->det;
    struct lane_hits hits;
    hits.t = lane_array(found->t * scale);
    hits.u = lane_array(found->u * scale);
    hits.v = lane_array(found->v * scale);
    return hits;
}

/*
 * One product rounded before the other is subtracted: exactly opposite when the factors change
 * sides.
 */
INLINE_ALWAYS float8 edge_function(float8 ax, float8 ay, float8 bx, float8 by)
{
#pragma OPENCL FP_CONTRACT OFF
    const float8 left = ax * by;
    const float8 right = ay * bx;
    return left - right;
}

/*
 * Tests the block's lanes; returns a bit for each that is hit with t in [t_min, t_max]. Both
 * sides count, and edges belong to the lane. The division by det is left to those that are hit. A
 * parallelogram's two far edges are moved out by 1e-6
 * of its size, because its fourth corner is not stored.
 */
INLINE_ALWAYS uint intersect_block(global const rt_tri_block *block, const struct ray_frame *frame,
                                   float t_min, float t_max, struct block_hits *hits)
{
    /* Move the vertices to the ray's frame: origin at 0, ray along +-z. */
    const float8 az = vload8(0, block->v0[frame->z]) - frame->origin_z;
    const float8 bz = vload8(0, block->v1[frame->z]) - frame->origin_z;
    const float8 cz = vload8(0, block->v2[frame->z]) - frame->origin_z;
    const float8 ax =
        lane_mad(az, (float8)(-frame->shear_x), vload8(0, block->v0[frame->x]) - frame->origin_x);
    const float8 ay =
        lane_mad(az, (float8)(-frame->shear_y), vload8(0, block->v0[frame->y]) - frame->origin_y);
    const float8 bx =
        lane_mad(bz, (float8)(-frame->shear_x), vload8(0, block->v1[frame->x]) - frame->origin_x);
    const float8 by =
        lane_mad(bz, (float8)(-frame->shear_y), vload8(0, block->v1[frame->y]) - frame->origin_y);
    const float8 cx =
        lane_mad(cz, (float8)(-frame->shear_x), vload8(0, block->v2[frame->x]) - frame->origin_x);
    const float8 cy =
        lane_mad(cz, (float8)(-frame->shear_y), vload8(0, block->v2[frame->y]) - frame->origin_y);

    /* Edge functions are the weights of v0, v1 and v2, scaled by det; make det positive. */
    float8 a = edge_function(cx, cy, bx, by);
    float8 b = edge_function(ax, ay, cx, cy);
    float8 c = edge_function(bx, by, ax, ay);
    float8 det = a + b + c;
    float8 depth = lane_mad(a, az, lane_mad(b, bz, c * cz));
    const int8 sign = as_int8(det) & (int)0x80000000;
    a = as_float8(as_int8(a) ^ sign);
    b = as_float8(as_int8(b) ^ sign);
    c = as_float8(as_int8(c) ^ sign);
    det = as_float8(as_int8(det) ^ sign);
    depth = as_float8(as_int8(depth) ^ sign);

    /* A quad requires b <= det and c <= det instead of a >= 0, that is a + min(b, c) >= 0. */
    const float8 least = lane_min(b, c);
    const int8 quad = as_int8(vload8(0, block->prim)) >> 31;
    const float8 third = a + as_float8(quad & as_int8(lane_mad(det, (float8)(1e-6f), least)));

    hits->t = depth * frame->scale_z;
    hits->u = b;
    hits->v = c;
    hits->det = det;
    return lane_mask((lane_min(least, third) >= 0.0f) & (det > 0.0f) & (hits->t >= t_min * det) &
                     (hits->t <= t_max * det));
}
#else
/*
 * One product rounded before the other is subtracted: exactly opposite when the factors change
 * sides.
 */
INLINE_ALWAYS float edge_function(float ax, float ay, float bx, float by)
{
#pragma OPENCL FP_CONTRACT OFF
    const float left = ax * by;
    const float right = ay * bx;
    return left - right;
}

/* A vertex of a lane in the ray's frame: origin at 0, ray along +-z. */
INLINE_ALWAYS float3 vertex_in_frame(global const float rows[3][RT_BVH_WIDTH], uint lane,
                                     const struct ray_frame *frame)
{
    const float z = rows[frame->z][lane] - frame->origin_z;
    const float x = rows[frame->x][lane] - frame->origin_x;
    const float y = rows[frame->y][lane] - frame->origin_y;
    return (float3)(mad_once(z, -frame->shear_x, x), mad_once(z, -frame->shear_y, y), z);
}

/*
 * Tests a lane of a block as intersect_block does; where it is hit with t in [t_min, t_max], sets
 * t, u and v of *hit.
 */
INLINE_ALWAYS bool intersect_lane(global const rt_tri_block *block, uint lane,
                                  const struct ray_frame *frame, float t_min, float t_max,
                                  struct hit *hit)
{
    const float3 p = vertex_in_frame(block->v0, lane, frame);
    const float3 q = vertex_in_frame(block->v1, lane, frame);
    const float3 r = vertex_in_frame(block->v2, lane, frame);
    const float a = edge_function(r.x, r.y, q.x, q.y);
    const float b = edge_function(p.x, p.y, r.x, r.y);
    const float c = edge_function(q.x, q.y, p.x, p.y);
    const float sum = a + b + c, sign = copysign(1.0f, sum);
    const float det = fabs(sum), u = sign * b, v = sign * c, least = fmin(u, v);
    const float depth = sign * mad_once(a, p.z, mad_once(b, q.z, c * r.z));
    const bool is_quad = (block->prim[lane] & RT_BLOCK_QUAD) != 0u;
    const float third = sign * a + (is_quad ? mad_once(det, 1e-6f, least) : 0.0f);
    const float t = depth * frame->scale_z, scale = 1.0f / det;
    hit->t = t * scale;
    hit->u = u * scale;
    hit->v = v * scale;
    return fmin(least, third) >= 0.0f && det > 0.0f && t >= t_min * det && t <= t_max * det;
}
#endif

#endif
