/*
 * light_path.h - light paths of mode vcm: their start, their vertices, and how these are joined
 * with the camera.
 */
#ifndef RT_KERNELS_VCM_LIGHT_PATH_H
#define RT_KERNELS_VCM_LIGHT_PATH_H

#include "accel/traverse.h"
#include "camera/project.h"
#include "camera/splat.h"
#include "count.h"
#include "light/emit_pdf.h"
#include "sample/rng.h"
#include "sample/roulette.h"
#include "vcm/store.h"

/* A light path under way. */
struct vcm_light_path {
    struct ray ray;
    float3 flux;
    uint4 media;
    uint depth;  /* segments, the one under way included */
    uint hidden; /* boundaries skipped inside a medium of higher priority */
    struct partial_weights partial;
    bool straight;               /* its first segment; no boundary was passed */
    DISPERSED(float wavelength;) /* of the run of delta events under way, micrometres; 0: none */
    /* where it began: light, share of the paths, point and direction */
    uint light;
    float pmf;
    struct surface start;
    float3 direction;
};

/* Begins a path; false when it has no flux. */
INLINE_NEVER bool begin_light_path(struct vcm_light_path *path, const struct scene *scene,
                                   global const rt_light_share *shares,
                                   const struct sampler *sampler)
{
    struct emission emission;
    const float8 u = sampler_pair(sampler, SET_START);
    if (!light_emit(scene, shares, u.lo, u.hi, false, &emission))
        return false;
    path->ray = make_ray(leave_surface(&emission.at, emission.direction), emission.direction, 0.0f,
                         INFINITY);
    path->flux = emission.flux;
    path->media = emission_media(scene, &emission);
    if (is_far(scene->lights + emission.light))
        path->flux *= medium_transmittance(scene->materials, path->media.x, INFINITY);
    path->depth = 1u;
    path->hidden = 0u;
    path->straight = true;
    path->partial.dVCM = path->partial.dVC = 0.0f;
    path->light = emission.light;
    path->pmf = shares[emission.light].pmf;
    path->start = emission.at;
    path->direction = emission.direction;
    DISPERSED(path->wavelength = 0.0f);
    return largest3(path->flux) > 0.0f && can_follow(&path->ray);
}

/* The weights at the first vertex, which begin with the light. */
static inline void begin_weights(struct vcm_light_path *path, const struct scene *scene,
                                 const struct technique_weights *all, float3 position,
                                 float distance, float cosine)
{
    global const rt_light_data *light = scene->lights + path->light;
    const float chosen = light_pmf(scene, path->light, position);
    /* Either side of the light has the same density, if it emits there. */
    const float cos_light = grazing_cosine(path->direction, path->start.normal);
    float direct = 0.0f, back = 0.0f, pdf;
    switch ((rt_light_kind)light->kind) {
    case RT_LIGHT_POINT:
    case RT_LIGHT_SPOT:
    case RT_LIGHT_TABLE:
        pdf = path->pmf * emit_point_pdf_w(scene, light, path->direction) * cosine;
        direct = chosen * square(distance) / pdf;
        break;
    case RT_LIGHT_DIRECTIONAL:
    case RT_LIGHT_BEAM:
        pdf = path->pmf * emit_parallel_pdf_a(scene, light, position, path->direction) * cosine;
        direct = chosen / pdf;
        break;
    case RT_LIGHT_ENVIRONMENT:
        /* The density of the direction is the same by both, but for portals. */
        pdf = path->pmf * emit_distant_pdf_a(scene, position, path->direction) * cosine;
        direct = chosen * portals_gain(scene, position, -path->direction) / pdf;
        back = 1.0f / (pdf * environment_pdf_w(scene, -path->direction));
        break;
    case RT_LIGHT_QUAD:
    case RT_LIGHT_TRIANGLE:
    case RT_LIGHT_SPHERE:
    case RT_LIGHT_SHAPE:
        pdf = path->pmf * emit_area_pdf(scene, light, &path->start, cos_light) * cosine;
        back = cos_light / pdf;
        direct = light_pdf_w(scene, light, position, &path->start) * back;
    }
    path->partial = begin_light_weights(all, path->straight ? direct : 0.0f, back);
}

/* The weight of a vertex that is joined with the camera, whose density over its area is pdf_a. */
static inline float camera_weight(const struct technique_weights *all,
                                  const struct vcm_light_path *path, float pdf_a, float back_pdf_w)
{
    const float used = used_dVCM(all, &path->partial, path->depth == 1u, RT_TECHNIQUE_NEE);
    return 1.0f / (1.0f + connection_weight(all, used, path->partial.dVC, pdf_a / all->light_paths,
                                            back_pdf_w));
}

/*
 * Joins a vertex with the camera; false: the camera does not see it. Writes the pixel and what it
 * gets. u: in [0,1)^4, for the lens and the pixel.
 */
static inline bool connect_camera(const struct scene *scene, const rt_params *params,
                                  const struct technique_weights *all,
                                  const struct vcm_light_path *path, const struct vertex *vertex,
                                  float4 u, uint *pixel, float3 *radiance)
{
    global const rt_camera_data *camera = &scene->header->camera;
    struct projection seen;
    if (!camera_project(camera, params, vertex->position, u.xy, &seen))
        return false;
    const int2 size = (int2)((int)params->width, (int)params->height);
    float share = splat_pixel(camera, size, seen.raster, u.zw, pixel);
    if (share == 0.0f)
        return false;
    if ((all->shown & ~RT_TECHNIQUE_CAMERA) == 0u) /* vcm_black adds the samples */
        share *= splat_scale(camera->filter);
    const struct scattering s = bidir_eval(scene, vertex, seen.wi);
    if (!(s.pdf_w > 0.0f))
        return false;
    const float cosine = fabs(dot(seen.wi, vertex->bsdf.normal));
    const float distance = length(seen.origin - vertex->position);
    const float weight = camera_weight(all, path, seen.pdf_a * cosine, s.back_pdf_w);
    *radiance = path->flux * s.value * vertex_transmittance(scene, vertex, seen.wi, distance) *
                (weight * seen.pdf_a / all->light_paths);
    if (!(largest3(*radiance) > 0.0f))
        return false;
    *radiance *= share;
    const float3 from = vertex_leave(vertex, seen.wi);
    struct ray ray = make_ray(from, seen.origin - from, 0.0f, 1.0f);
    if (UNLIKELY(camera->hides_emitters))
        ray.t_min = past_emitters(scene, ray);
    COUNT(scene, RT_COUNTER_SHADOW, ray.direction.x);
    return !occluded(scene, &ray);
}

/* Scatters the path at a vertex, by u of set_scatter; false when it ends. */
static inline bool scatter_path(struct vcm_light_path *path, const struct scene *scene,
                                const struct technique_weights *all, const struct vertex *vertex,
                                float4 u)
{
    const float survival =
        roulette_survival(path->flux * vertex_radiance_albedo(vertex), largest3(path->flux));
    const uint chosen = vertex_choose(vertex, survival, u.z);
    if (chosen == RT_NO_EVENT)
        return false;
    const struct bidir_event event = bidir_scatter(scene, vertex, chosen, u.xyw);
    path->flux *= event.weight / survival;
    if (!(largest3(path->flux) > 0.0f))
        return false;
    if (event.pdf_w > 0.0f)
        scatter_weights(&path->partial, all,
                        used_dVCM(all, &path->partial, path->depth == 1u, RT_TECHNIQUE_NEE),
                        event.cosine, event.pdf_w, event.back_pdf_w);
    else
        scatter_delta_weights(&path->partial, event.cosine, event.back_pdf_w);
    path->ray = make_ray(vertex_leave(vertex, event.wi), event.wi, 0.0f, INFINITY);
    if (event.through)
        path->media = vertex->beyond;
    path->straight = false;
    DISPERSED(path->wavelength = event.pdf_w > 0.0f ? 0.0f : path->wavelength);
    path->depth++;
    return true;
}

#endif
