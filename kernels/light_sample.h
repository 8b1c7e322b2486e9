/* light_sample.h - a light as it is seen from a point in the scene, and the ray that asks whether it is. */
#ifndef RT_LIGHT_SAMPLE_H
#define RT_LIGHT_SAMPLE_H

#include "intersect.h"
#include "surface.h"

/* A point on a light, chosen from a point in the scene. */
struct light_sample {
    struct surface at; /* position, normal and error only */
    float lift;        /* along at.normal, takes the position off the light by its error, to the side of the viewer */
    float3 wi;         /* unit, towards the light */
    float3 radiance; /* that arrives if nothing is in between; delta lights: irradiance on a surface that faces them */
    float spread;      /* sr: 1 / pdf_w of the direction, choice of the light included; delta lights: of the choice */
    bool delta;        /* no ray can meet it by chance: multiple importance sampling must leave it alone */
    bool distant;      /* infinitely far: wi says all of where it is */
};

/* The ray from a point that is off its surface to a sampled point of a light, ending just before it. */
static inline struct ray shadow_ray(float3 origin, const struct light_sample *sample)
{
    if (sample->distant)
        return make_ray(origin, sample->wi, 0.0f, INFINITY);
    const float3 target = sample->at.position + sample->lift * sample->at.normal;
    return make_ray(origin, target - origin, 0.0f, 0.9999f);
}

#endif
