/*
 * delta.h - lights that no ray can meet: point, spot and directional, and those of table.h. From
 * any point there is one direction to each.
 */
#ifndef RT_KERNELS_LIGHT_DELTA_H
#define RT_KERNELS_LIGHT_DELTA_H

#include "math/frame.h"
#include "light/sample.h"
#include "types.h"

/*
 * The fraction of its intensity that a spot light emits at this cosine to its axis: between inner
 * and outer 3x^2 - 2x^3 of the cosine, or linear in the angle.
 */
static inline float spot_falloff(global const rt_light_data *light, float cosine)
{
    if (light->flags & RT_LIGHT_LINEAR) {
        const float angle = acos(clamp(cosine, -1.0f, 1.0f));
        return clamp((light->height - angle) / (light->height - light->width), 0.0f, 1.0f);
    }
    const float inner = light->c[0], outer = light->c[1];
    const float x = clamp((cosine - outer) / (inner - outer), 0.0f, 1.0f);
    return x * x * (3.0f - 2.0f * x);
}

/* The only direction to the light; false when nothing arrives. */
static inline bool sample_delta_light(struct light_sample *sample,
                                      global const rt_light_data *light, float3 from)
{
    sample->delta = true;
    sample->distant = light->kind == RT_LIGHT_DIRECTIONAL;
    sample->inv_pdf = 1.0f;
    sample->lift = 0.0f;
    sample->at.position = row3(light->a);
    sample->radiance = row3(light->emission);
    if (sample->distant) {
        sample->wi = -row3(light->b);
        sample->at.normal = row3(light->b);
        return true;
    }
    const float3 towards = sample->at.position - from;
    const float d2 = dot(towards, towards);
    sample->wi = towards * (1.0f / sqrt(d2));
    sample->at.normal = -sample->wi;
    const float shown =
        light->kind == RT_LIGHT_SPOT ? spot_falloff(light, -dot(sample->wi, row3(light->b))) : 1.0f;
    sample->radiance *= shown / d2;
    return shown > 0.0f;
}

#endif
