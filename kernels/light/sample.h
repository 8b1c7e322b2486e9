/*
 * sample.h - a sampled point of a light, and the shadow ray to it.
 */
#ifndef RT_KERNELS_LIGHT_SAMPLE_H
#define RT_KERNELS_LIGHT_SAMPLE_H

#include "accel/intersect.h"
#include "record.h"
#include "shape/surface.h"

/*
 * Where a shadow ray ends, as a part of the distance: just before a surface; or before the point of
 * a delta light by what rounding takes, so that a surface that the light lies in does not shade it.
 */
#define RT_SHADOW_END 0.9999f
#define RT_SHADOW_END_DELTA 0.999998f

/* A point on a light, chosen from a point in the scene. */
struct light_sample {
    struct surface at; /* position, normal and error only */
    /* along at.normal, takes the position off the light by its error, to the side of the viewer */
    float lift;
    float3 wi; /* unit, towards the light */
    /*
     * that arrives if nothing is in between; delta lights: irradiance on a surface that faces them
     */
    float3 radiance;
    /* sr: 1 / pdf_w of the direction, choice of the light included; delta lights: of the choice */
    float inv_pdf;
    /* a delta light: BSDF sampling never meets it, so no MIS weight applies */
    bool delta;
    bool distant; /* at infinity: only wi is defined, not at.position */
#ifdef RT_RECORD_PATHS
    uint light; /* its index */
#endif
};

static inline float shadow_end(const struct light_sample *sample)
{
    return sample->delta ? RT_SHADOW_END_DELTA : RT_SHADOW_END;
}

/* The ray from a point that is off its surface to a sampled point of a light. */
static inline struct ray shadow_ray(float3 origin, const struct light_sample *sample)
{
    if (sample->distant)
        return make_ray(origin, sample->wi, 0.0f, INFINITY);
    const float3 target = sample->at.position + sample->lift * sample->at.normal;
    return make_ray(origin, target - origin, 0.0f, shadow_end(sample));
}

#endif
