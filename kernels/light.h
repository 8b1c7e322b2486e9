/*
 * light.h - the lights: choosing one, sampling it from a point, its density, what it emits.
 *
 * light_pdf_w and sky_light_pdf_w are the densities with which sample_light makes a direction, the choice of the
 * light included: what multiple importance sampling needs when a ray meets the light.
 */
#ifndef RT_LIGHT_H
#define RT_LIGHT_H

#include "light_area.h"
#include "light_delta.h"
#include "light_sample.h"
#include "light_sky.h"

/*
 * The light at u of the cumulative distribution: chosen in proportion to its power. A bisection of which only
 * the length, not the way, depends on branches: those would be mispredicted. The sign bit of u - cdf keeps compilers
 * from making a branch of it after all.
 */
static inline uint choose_light(const struct scene *scene, float u)
{
    uint first = 0u;
    for (uint count = scene->header->light_count; count > 1u;) {
        const uint half_count = count >> 1;
        first += half_count & ((as_uint(u - scene->lights[first + half_count - 1u].cdf) >> 31) - 1u);
        count -= half_count;
    }
    return first;
}

/* The light that a surface is part of, or RT_NONE. */
static inline uint surface_light(const struct scene *scene, const struct surface *surface)
{
    global const rt_shape *shape = scene->shapes + surface->shape;
    return shape->first_light == RT_NONE ? RT_NONE : shape->first_light + (surface->prim - shape->first_prim);
}

/* ---- Density ----------------------------------------------------------------- */

/* The density with which sample_light, from this point, makes the direction in which the light's point `at` is met. */
static inline float light_pdf_w(const struct scene *scene, global const rt_light_data *light, float3 from,
                                const struct surface *at)
{
    struct seen_rectangle seen;
    float d2;
    if (see_rectangular_light(light, from, &seen))
        return light->pmf * seen_rectangle_pdf_w(&seen);
    if (see_spherical_light(light, from, &d2))
        return light->pmf * cap_pdf_w(light->width, d2);
    const float area = light->kind == RT_LIGHT_SHAPE ? 1.0f / shape_pdf_a(scene, at) : light->area;
    return light->pmf / area_spread(area, at->position - from, at->normal);
}

/* The same for a ray that meets nothing, in direction w; there is an environment. */
static inline float sky_light_pdf_w(const struct scene *scene, float3 w)
{
    return scene->lights[scene->header->environment.light].pmf * sky_pdf_w(scene, w);
}

/* ---- Sampling ---------------------------------------------------------------- */

/* Samples a light of a kind other than quad, triangle and sphere. */
INLINE_NEVER bool sample_other_light(const struct scene *scene, global const rt_light_data *light, float3 from,
                                     float2 u, struct light_sample *sample)
{
    if (light->kind == RT_LIGHT_ENVIRONMENT) {
        sample->distant = true;
        sample->lift = 0.0f;
        sample->spread = sample_sky(scene, u, &sample->wi, &sample->radiance) / light->pmf;
        sample->at.position = from;
        sample->at.normal = -sample->wi;
        return true;
    }
    if (light->kind != RT_LIGHT_SHAPE)
        return sample_delta_light(sample, light, from);

    const float pdf_a = shape_point(scene, scene->prim_shape[light->prim], u, &sample->at);
    const float3 towards = sample->at.position - from;
    sample->wi = unit(towards);
    sample->spread = area_spread(1.0f / pdf_a, towards, sample->at.normal) / light->pmf;
    sample->lift = dot(sample->wi, sample->at.normal) > 0.0f ? -sample->at.error : sample->at.error;
    sample->radiance = light_radiance(scene, light, &sample->at, -sample->wi);
    return true;
}

/*
 * Samples the lights from a point: u.xy the point on the light, u.z the choice. False when nothing
 * can arrive.
 */
static inline bool sample_light(const struct scene *scene, float3 from, float4 u, struct light_sample *sample)
{
    if (scene->header->light_count == 0u)
        return false;
    global const rt_light_data *light = scene->lights + choose_light(scene, u.z);
    if (light->pmf == 0.0f)
        return false;
    sample->delta = false;
    sample->distant = false;
    const bool sphere = light->kind == RT_LIGHT_SPHERE;
    if (!sphere && light->kind != RT_LIGHT_QUAD && light->kind != RT_LIGHT_TRIANGLE)
        return sample_other_light(scene, light, from, u.xy, sample);

    /* The side of a flat light is known at once, that of a sphere at the sampled point. */
    float height = dot(from - row3(light->a), row3(light->normal));
    if (!sphere && height <= 0.0f && !(light->flags & RT_LIGHT_TWO_SIDED))
        return false;
    sample->spread = sample_area_light(&sample->at, light, from, u.xy) / light->pmf;
    sample->wi = unit(sample->at.position - from);
    if (sphere)
        height = -dot(sample->wi, sample->at.normal);
    sample->lift = height < 0.0f ? -sample->at.error : sample->at.error;
    sample->radiance = row3(light->emission);
    if (light->texture != RT_NONE) {
        locate_on_light(scene, light, &sample->at);
        sample->radiance *= light_texture(scene, light, &sample->at);
    }
    return !sphere || height > 0.0f || (light->flags & RT_LIGHT_TWO_SIDED);
}

#endif
