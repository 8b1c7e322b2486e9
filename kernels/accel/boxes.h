/*
 * boxes.h - rays against the boxes of a node.
 *
 * The boxes are tested against the ray's slabs, eight at once or one by one, the near and far plane
 * of each axis chosen by the sign of the direction. The distance to a plane is one multiply-add,
 * plane * rate + shift; the bounds on its rounding are in rate and shift, so that no box that the
 * ray touches is missed (after Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013, who widens the far
 * distance only).
 */
#ifndef RT_KERNELS_ACCEL_BOXES_H
#define RT_KERNELS_ACCEL_BOXES_H

#include "math/lanes.h"
#include "math/ray.h"
#include "types.h"

/*
 * Whether the ray can be followed: its numbers are finite and small enough for what make_ray_slabs
 * does with them. A comparison with NaN fails, so without this the boxes of unused lanes would be
 * hit. closest_hit and occluded require such rays; it is checked where a path begins, for the
 * direction of a bounce is a unit vector.
 */
INLINE_ALWAYS bool can_follow(const struct ray *ray)
{
    const float3 size = fabs(ray->origin) + fabs(ray->direction);
    return size.x + size.y + size.z <= 0x1p53f;
}

/* The ray's constants for boxes: the distance to a plane is plane * rate + shift. */
struct ray_slabs {
    float3 near_rate, near_shift; /* never above the true distance */
    float3 far_rate, far_shift;   /* never below it */
    uint near_x, near_y, near_z;  /* rows of the bounds of a node */
    uint far_x, far_y, far_z;
};

/*
 * With e = 2^-24, the distance (plane - origin) rate is off by at most 4 e of itself and 4 e
 * |origin rate|; both are allowed for twice. Making rates smaller and larger widens what lies ahead
 * of the origin; what lies behind, where t_min allows it, is widened by as much through the slack.
 * A direction component near 0 is taken as 2^-74: then, for rays that can be followed, rates and
 * shifts are finite, and distances far beyond any other wherever the plane is not within rounding
 * of the origin.
 */
INLINE_ALWAYS struct ray_slabs make_ray_slabs(const struct ray *ray)
{
    const float least = 0x1p-74f, relative = 0x1p-21f, absolute = 0x1p-60f;
    const float3 direction = copysign(fmax(fabs(ray->direction), (float3)(least)), ray->direction);
    const float3 rate = 1.0f / direction;
    const float behind = fmax(-ray->t_min, 0.0f) * (2.0f * relative);
    const float3 slack = fabs(rate) * (fabs(ray->origin) * relative + absolute) + behind;
    struct ray_slabs slabs;
    slabs.near_rate = rate * (1.0f - relative);
    slabs.far_rate = rate * (1.0f + relative);
    slabs.near_shift = -(ray->origin * slabs.near_rate) - slack;
    slabs.far_shift = -(ray->origin * slabs.far_rate) + slack;
    slabs.near_x = rate.x < 0.0f ? 3u : 0u;
    slabs.near_y = rate.y < 0.0f ? 4u : 1u;
    slabs.near_z = rate.z < 0.0f ? 5u : 2u;
    slabs.far_x = 3u - slabs.near_x;
    slabs.far_y = 5u - slabs.near_y;
    slabs.far_z = 7u - slabs.near_z;
    return slabs;
}

#if RT_WIDTH > 1
INLINE_ALWAYS float8 plane_distance(global const rt_bvh_node *node, uint row, float rate,
                                    float shift)
{
    return lane_mad(vload8(0, node->bounds[row]), (float8)(rate), (float8)(shift));
}

/*
 * Tests the node's children; returns a bit for each whose box the ray enters in [t_min, t_max], and
 * where.
 */
INLINE_ALWAYS uint intersect_boxes(global const rt_bvh_node *node, const struct ray_slabs *slabs,
                                   float t_min, float t_max, float8 *entry)
{
    const float8 near_x =
        plane_distance(node, slabs->near_x, slabs->near_rate.x, slabs->near_shift.x);
    const float8 near_y =
        plane_distance(node, slabs->near_y, slabs->near_rate.y, slabs->near_shift.y);
    const float8 near_z =
        plane_distance(node, slabs->near_z, slabs->near_rate.z, slabs->near_shift.z);
    const float8 far_x = plane_distance(node, slabs->far_x, slabs->far_rate.x, slabs->far_shift.x);
    const float8 far_y = plane_distance(node, slabs->far_y, slabs->far_rate.y, slabs->far_shift.y);
    const float8 far_z = plane_distance(node, slabs->far_z, slabs->far_rate.z, slabs->far_shift.z);
    const float8 near = lane_max(lane_max(near_x, near_y), lane_max(near_z, (float8)(t_min)));
    const float8 far = lane_min(lane_min(far_x, far_y), lane_min(far_z, (float8)(t_max)));
    *entry = near;
    return lane_mask(near <= far);
}
#else
/* Whether the ray enters a box, low corner and high corner, in [t_min, t_max], and where. */
INLINE_ALWAYS bool enters_box(global const float bounds[6], const struct ray_slabs *slabs,
                              float t_min, float t_max, float *entry)
{
    const float near_x = mad_once(bounds[slabs->near_x], slabs->near_rate.x, slabs->near_shift.x);
    const float near_y = mad_once(bounds[slabs->near_y], slabs->near_rate.y, slabs->near_shift.y);
    const float near_z = mad_once(bounds[slabs->near_z], slabs->near_rate.z, slabs->near_shift.z);
    const float far_x = mad_once(bounds[slabs->far_x], slabs->far_rate.x, slabs->far_shift.x);
    const float far_y = mad_once(bounds[slabs->far_y], slabs->far_rate.y, slabs->far_shift.y);
    const float far_z = mad_once(bounds[slabs->far_z], slabs->far_rate.z, slabs->far_shift.z);
    *entry = fmax(fmax(near_x, near_y), fmax(near_z, t_min));
    return *entry <= fmin(fmin(far_x, far_y), fmin(far_z, t_max));
}
#endif

#endif
