/*
 * delta.h - lights that no ray can meet: point, spot, directional and beam, and those of table.h.
 * From any point there is one direction to each.
 */
#ifndef RT_KERNELS_LIGHT_DELTA_H
#define RT_KERNELS_LIGHT_DELTA_H

#include "math/frame.h"
#include "light/sample.h"
#include "types.h"

/*
 * The fraction of its intensity that a spot light emits at this cosine to its axis: between inner
 * and outer 3x^2 - 2x^3, x^2 or x^4 of the cosine, or linear in the angle.
 */
static inline float spot_falloff(global const rt_light_data *light, float cosine)
{
    if (light->flags & RT_LIGHT_LINEAR) {
        const float angle = acos(clamp(cosine, -1.0f, 1.0f));
        return clamp((light->height - angle) / (light->height - light->width), 0.0f, 1.0f);
    }
    const float inner = light->c[0], outer = light->c[1];
    const float x = clamp((cosine - outer) / (inner - outer), 0.0f, 1.0f);
    if (light->flags & RT_LIGHT_POWER)
        return light->c[2] > 2.0f ? (x * x) * (x * x) : x * x;
    return x * x * (3.0f - 2.0f * x);
}

/*
 * The frame of a light with an axis, which is n. s is where u of a table's plane grows, or along
 * the width of a beam; the angles of a table grow counter-clockwise as seen along the axis.
 */
static inline struct frame light_frame(global const rt_light_data *light)
{
    struct frame frame;
    frame.s = row3(light->normal);
    frame.n = row3(light->b);
    frame.t = cross(frame.n, frame.s);
    return frame;
}

/* Whether a point of the plane that a beam starts from lies in its cross section. */
static inline bool beam_holds(global const rt_light_data *light, float2 at)
{
    const float2 part = fabs(at) / (float2)(light->width, light->height);
    return light->flags & RT_LIGHT_ROUND ? dot(part, part) <= 1.0f : fmax(part.x, part.y) <= 1.0f;
}

/* Where a beam starts that comes to a point; false where none does. */
static inline bool sample_beam(struct light_sample *sample, global const rt_light_data *light,
                               float3 from)
{
    const float3 axis = row3(light->b);
    const float3 at = frame_to_local(light_frame(light), from - row3(light->a));
    sample->wi = -axis;
    sample->at.normal = axis;
    sample->at.position = from - at.z * axis;
    return at.z > 0.0f && beam_holds(light, at.xy);
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
    if (light->kind == RT_LIGHT_BEAM)
        return sample_beam(sample, light, from);
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
