/*
 * light.h - the lights: choosing one, sampling it from a point, its density, what it emits.
 *
 * The kinds of light are listed in types.h, RT_LIGHTS; area lights are in area.h, delta lights in
 * delta.h, the environment in environment.h. light_pdf_w and environment_light_pdf_w are the
 * densities with which sample_light samples a direction, the choice of the light included: what
 * multiple importance sampling needs when a ray meets the light.
 */
#ifndef RT_KERNELS_LIGHT_LIGHT_H
#define RT_KERNELS_LIGHT_LIGHT_H

#include "light/area.h"
#include "light/delta.h"
#include "light/sample.h"
#include "light/portal.h"
#include "light/table.h"
#include "light/tree.h"

/* The light that a surface is part of, or RT_NONE. */
static inline uint surface_light(const struct scene *scene, const struct surface *surface)
{
    global const rt_shape *shape = scene->shapes + surface->shape;
    return shape->first_light == RT_NONE ? RT_NONE
                                         : shape->first_light + (surface->prim - shape->first_prim);
}

/* Whether the shape of a hit is a light, all of it. */
static inline bool emits(const struct scene *scene, const struct hit *hit)
{
    return scene->shapes[scene->prim_shape[hit->prim]].first_light != RT_NONE;
}

/* Whether the camera sees what lies behind the surface. */
static inline bool is_hidden(const struct scene *scene, const struct surface *surface)
{
    return scene->header->camera.hides_emitters && surface_light(scene, surface) != RT_NONE;
}

/* Whether a path of that depth, which escapes, meets the light of an environment. */
static inline bool meets_environment(const struct scene *scene, uint depth)
{
    return has_environment(scene) && !(depth == 1u && scene->header->camera.hides_emitters);
}

/* ---- Density ----------------------------------------------------------------- */

/*
 * pdf_w with which sample_light, from this point, samples the direction to the light's point `at`.
 */
static inline float light_pdf_w(const struct scene *scene, global const rt_light_data *light,
                                float3 from, const struct surface *at)
{
    const float pmf = light_pmf(scene, (uint)(light - scene->lights), from);
    struct seen_rectangle seen;
    float d2;
    if (see_rectangular_light(light, from, &seen))
        return pmf * seen_rectangle_pdf_w(&seen);
    if (see_spherical_light(light, from, &d2))
        return pmf * cap_pdf_w(light->width, d2);
    const float area = light->kind == RT_LIGHT_SHAPE ? 1.0f / shape_pdf_a(scene, at) : light->area;
    return pmf / area_inv_pdf(area, at->position - from, at->normal);
}

/* The same for a ray from there that escapes in direction w; there is an environment. */
static inline float environment_light_pdf_w(const struct scene *scene, float3 from, float3 w)
{
    return light_pmf(scene, scene->environment->light, from) * sky_pdf_w(scene, from, w);
}

/* ---- Sampling ---------------------------------------------------------------- */

/* Samples an analytic shape by its parameters. */
static inline bool sample_shape_light(const struct scene *scene, global const rt_light_data *light,
                                      float3 from, float2 u, struct light_sample *sample)
{
    const float pdf_a = shape_point(scene, scene->prim_shape[light->prim], u, &sample->at);
    const float3 towards = sample->at.position - from;
    sample->wi = unit(towards);
    sample->inv_pdf = area_inv_pdf(1.0f / pdf_a, towards, sample->at.normal);
    sample->lift = dot(sample->wi, sample->at.normal) > 0.0f ? -sample->at.error : sample->at.error;
    sample->radiance = light_radiance(scene, light, &sample->at, -sample->wi);
    if (light->flags & RT_LIGHT_CUTOUT)
        sample->radiance *= light_opacity(scene, light, &sample->at);
    return true;
}

/* Samples a quad, a triangle or a sphere. */
static inline bool sample_plain_light(const struct scene *scene, global const rt_light_data *light,
                                      float3 from, float2 u, struct light_sample *sample)
{
    /* The side of a flat light is known at once, that of a sphere at the sampled point. */
    const bool sphere = light->kind == RT_LIGHT_SPHERE;
    float height = dot(from - row3(light->a), row3(light->normal));
    if (!sphere && height <= 0.0f && !(light->flags & RT_LIGHT_TWO_SIDED))
        return false;
    sample->inv_pdf = sample_area_light(&sample->at, light, from, u);
    sample->wi = unit(sample->at.position - from);
    if (sphere)
        height = -dot(sample->wi, sample->at.normal);
    sample->lift = height < 0.0f ? -sample->at.error : sample->at.error;
    sample->radiance = row3(light->emission);
    if (light_is_varied(light)) {
        locate_on_light(scene, light, &sample->at);
        sample->radiance *= light_pattern(scene, light, &sample->at);
    }
    return !sphere || height > 0.0f || (light->flags & RT_LIGHT_TWO_SIDED);
}

static inline bool sample_environment_light(const struct scene *scene, float3 from, float2 u,
                                            struct light_sample *sample)
{
    sample->distant = true;
    sample->lift = 0.0f;
    sample->inv_pdf = sample_sky(scene, from, u, &sample->wi, &sample->radiance);
    sample->at.position = from;
    sample->at.normal = -sample->wi;
    return true;
}

/* All other lights, out of line: they are rarer, and their code is large. */
INLINE_NEVER bool sample_other_light(const struct scene *scene, global const rt_light_data *light,
                                     float3 from, float2 u, struct light_sample *sample)
{
    switch ((rt_light_kind)light->kind) {
    case RT_LIGHT_QUAD:
    case RT_LIGHT_TRIANGLE:
    case RT_LIGHT_SPHERE:
        break;
    case RT_LIGHT_SHAPE:
        return sample_shape_light(scene, light, from, u, sample);
    case RT_LIGHT_POINT:
    case RT_LIGHT_SPOT:
    case RT_LIGHT_DIRECTIONAL:
    case RT_LIGHT_BEAM:
    case RT_LIGHT_TABLE:
        if (!sample_delta_light(sample, light, from))
            return false;
        if (light_has_table(light))
            sample->radiance *= table_pattern(scene, light, -sample->wi);
        return largest3(sample->radiance) > 0.0f;
    case RT_LIGHT_ENVIRONMENT:
        return sample_environment_light(scene, from, u, sample);
    }
    return false;
}

/* Samples a light that was chosen; the density of the choice is left out. */
static inline bool sample_chosen(const struct scene *scene, global const rt_light_data *light,
                                 float3 from, float2 u, struct light_sample *sample)
{
    sample->delta = false;
    sample->distant = false;
    switch ((rt_light_kind)light->kind) {
    case RT_LIGHT_QUAD:
    case RT_LIGHT_TRIANGLE:
    case RT_LIGHT_SPHERE:
        return sample_plain_light(scene, light, from, u, sample);
    case RT_LIGHT_SHAPE:
    case RT_LIGHT_POINT:
    case RT_LIGHT_SPOT:
    case RT_LIGHT_DIRECTIONAL:
    case RT_LIGHT_BEAM:
    case RT_LIGHT_TABLE:
    case RT_LIGHT_ENVIRONMENT:
        break;
    }
    return sample_other_light(scene, light, from, u, sample);
}

/*
 * Samples the lights from a point: u.xy the point on the light, u.z the choice. False when nothing
 * can arrive.
 */
static inline bool sample_light(const struct scene *scene, float3 from, float4 u,
                                struct light_sample *sample)
{
    float pmf;
    if (scene->light_nodes[1].weight == 0.0f)
        return false;
    const uint light = choose_light(scene, from, u.z, &pmf);
    if (pmf == 0.0f || !sample_chosen(scene, scene->lights + light, from, u.xy, sample))
        return false;
    sample->inv_pdf /= pmf;
    RECORD(sample->light = light);
    return true;
}

#endif
