/*
 * emission.h - emission found by BSDF sampling, of surfaces and of the environment, weighted by MIS
 * against light sampling at the previous vertex.
 */
#ifndef RT_KERNELS_INTEGRATE_EMISSION_H
#define RT_KERNELS_INTEGRATE_EMISSION_H

#include "integrate/gather.h"
#include "sample/mis.h"
#include "integrate/path_state.h"
#include "light/light.h"
#include "material/medium.h"

/*
 * What a surface emits along wo to the vertex `from`, which was scattered with density pdf_w; 0:
 * light sampling could not have found it.
 */
static inline float3 emitted_light(const struct scene *scene, const rt_params *params,
                                   const struct surface *surface, float3 wo, float3 from,
                                   float pdf_w)
{
    const uint index = surface_light(scene, surface);
    if (index == RT_NONE)
        return (float3)(0.0f);
    global const rt_light_data *light = scene->lights + index;
    const float3 emitted = light_radiance(scene, light, surface, wo);
    if (pdf_w == 0.0f || largest3(emitted) <= 0.0f)
        return emitted;
    return emitted *
           mis_weight(params, RT_ESTIMATOR_BSDF, light_pdf_w(scene, light, from, surface) / pdf_w);
}

/* The same of the environment, for a ray in direction w that escapes. */
INLINE_NEVER float3 environment_light(const struct scene *scene, const rt_params *params,
                                      float3 from, float3 w, float pdf_w)
{
    const float3 radiance = environment_radiance(scene, w);
    if (pdf_w == 0.0f || largest3(radiance) <= 0.0f)
        return radiance;
    return radiance *
           mis_weight(params, RT_ESTIMATOR_BSDF, environment_light_pdf_w(scene, from, w) / pdf_w);
}

/* Adds what a surface emits towards the path, unless caustic photons account for it. */
static inline void add_emission(struct path *path, const struct scene *scene,
                                const rt_params *params, const struct meeting *met,
                                const uint purpose)
{
    RECORD(const float3 before = path->radiance);
    if (!left_to_photons(path, purpose))
        path->radiance +=
            path->eta_scale * path->beta *
            emitted_light(scene, params, &met->surface, met->wo, path->from, path->pdf_w);
    RECORD(record_surface_emission(path, scene, params, &met->surface, path->radiance - before));
}

/* Adds the environment's radiance to a path whose ray escapes, and ends the path. */
static inline void add_environment(struct path *path, const struct scene *scene,
                                   const rt_params *params, const uint purpose)
{
    path->alive = false;
    RECORD(record_escape(path));
    if (!meets_environment(scene, path->depth) || left_to_photons(path, purpose))
        return;
    RECORD(const float3 before = path->radiance);
    path->radiance +=
        path->eta_scale * path->beta *
        medium_transmittance(scene->materials, path->media.x, INFINITY) *
        environment_light(scene, params, path->from, path->ray.direction, path->pdf_w);
    RECORD(record_environment(path, scene, params, path->radiance - before));
}

#endif
