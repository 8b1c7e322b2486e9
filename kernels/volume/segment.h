/*
 * segment.h - equiangular sampling: distances along a ray in proportion to the inverse square of
 * the distance to a light.
 *
 * Of a light, the point of sampling is the centre of its bounds, moved off the ray by their extent:
 * the light itself is sampled afterwards, from the point on the ray. Lights from infinitely far are
 * left to the other techniques.
 *
 * References:
 *   Kulla, Fajardo: "Importance Sampling Techniques for Path Tracing in Participating Media",
 *     EGSR 2012.
 */
#ifndef RT_KERNELS_VOLUME_SEGMENT_H
#define RT_KERNELS_VOLUME_SEGMENT_H

#include "light/tree.h"
#include "sample/sample.h"
#include "volume/medium.h"

/* The part of a ray that lies in one medium. */
struct segment {
    float3 origin, direction; /* unit */
    float length;             /* may be infinite */
    float3 pmf;               /* of the channels that distances are sampled by */
    float3 reference;         /* the point that a light is chosen for */
};

static inline struct segment make_segment(const struct medium *medium, float3 origin,
                                          float3 direction, float length, float3 beta)
{
    struct segment segment;
    segment.origin = origin;
    segment.direction = direction;
    segment.length = length;
    segment.pmf = channel_pmf(beta);
    /* Most light is scattered within a mean free path. */
    const float within = fmin(length, 1.0f / largest3(medium->extinction));
    segment.reference = origin + 0.5f * within * direction;
    return segment;
}

/* Kulla and Fajardo, section 3.1: the light's centre as seen from the ray. */
struct equiangular {
    float nearest; /* distance along the ray of the point nearest to it */
    float height;  /* its distance from the ray */
    float angle;   /* that the segment fills */
};

/*
 * The angle between the origin and the end of a segment, as seen from a point at these coordinates:
 * tan angle = height length / (height^2 - nearest (length - nearest)).
 */
static inline float segment_angle(float nearest, float height, float length)
{
    const float inverse = 1.0f / length; /* 0 of a segment without end */
    const float x = height * height * inverse - nearest * (1.0f - nearest * inverse);
    const float angle = atan_ratio((float4)(height), (float4)(fabs(x))).x;
    return x < 0.0f ? RT_PI - angle : angle;
}

/* False for a light from infinitely far. */
static inline bool see_equiangular(struct equiangular *seen, const struct scene *scene, uint light,
                                   const struct segment *segment)
{
    global const rt_light_node *node = scene->light_nodes + scene->light_nodes[light].leaf;
    const float3 towards = row3(node->centre) - segment->origin;
    const float nearest = dot(towards, segment->direction);
    const float3 off = towards - nearest * segment->direction;
    /* A ray that meets the centre has all of its angles in one point. */
    seen->height = sqrt(dot(off, off) + node->extent + 1e-8f * dot(towards, towards));
    seen->nearest = nearest;
    if (node->falloff == 0.0f || !(seen->height > 0.0f))
        return false;
    seen->angle = segment_angle(nearest, seen->height, segment->length);
    return seen->angle > 0.0f;
}

/* The density of a distance, 1/m. */
static inline float equiangular_pdf(const struct equiangular *seen, float distance)
{
    const float along = distance - seen->nearest;
    return seen->height / (seen->angle * (square(seen->height) + along * along));
}

/*
 * A distance of that density, by u in [0,1): that at which a part u of the angle is filled. With
 * the tangent of a sum written out, nothing cancels near the origin.
 */
static inline float equiangular_sample(const struct equiangular *seen, float u)
{
    const float2 arc = sin_cos(u * seen->angle);
    return (square(seen->nearest) + square(seen->height)) * arc.x /
           (seen->height * arc.y + seen->nearest * arc.x);
}

/* The density that a light is chosen for the segment and this distance sampled by it, 1/m. */
static inline float segment_light_pdf(const struct scene *scene, const struct segment *segment,
                                      uint light, float distance)
{
    struct equiangular seen;
    return see_equiangular(&seen, scene, light, segment)
               ? light_pmf(scene, light, segment->reference) * equiangular_pdf(&seen, distance)
               : 0.0f;
}

#endif
