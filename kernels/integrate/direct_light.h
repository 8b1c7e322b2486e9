/*
 * direct_light.h - light sampling: joins a vertex of a path with a sampled point of a light.
 */
#ifndef RT_KERNELS_INTEGRATE_DIRECT_LIGHT_H
#define RT_KERNELS_INTEGRATE_DIRECT_LIGHT_H

#include "accel/traverse.h"
#include "bsdf/bsdf.h"
#include "integrate/mis.h"
#include "integrate/path_state.h"
#include "light/light.h"
#include "material/medium.h"

/*
 * Samples a light at a surface: *scattered is fr |n.wi|, each lobe weighted by MIS against sampling
 * it; false where there is none. `held`: the lobes of which photon maps hold the light. `last`: the
 * path does not go on by these, so that light sampling counts fully for them, where the map does
 * not hold direct light, too.
 */
static inline bool sample_direct(struct light_sample *sample, float3 *scattered,
                                 const struct scene *scene, const rt_params *params,
                                 const struct surface *surface, const struct bsdf *bsdf, uint held,
                                 bool last, float4 u)
{
    const bool in_photons = last && params->direct == RT_DIRECT_PHOTONS;
    const uint lobes = bsdf_lobes(bsdf) & ~(in_photons ? held : 0u);
    if (!lobes || !sample_light(scene, surface->position, u, sample))
        return false;
    *scattered = (float3)(0.0f);
    for (uint i = 0u; i < RT_BSDF_LOBES; i++) {
        const uint lobe = bsdf_lobe(bsdf, i);
        if (!(lobes >> lobe & 1u))
            continue;
        const struct lobe_value light = bsdf_eval(bsdf, i, sample->wi);
        const bool alone = sample->delta || (last && held >> lobe & 1u);
        *scattered += alone ? light.value
                            : light.value * mis_weight(params, RT_ESTIMATOR_LIGHT,
                                                       light.pdf_w * sample->inv_pdf);
    }
    return true;
}

/*
 * Samples a light at a vertex and sets the connection: the scattered radiance and the shadow ray.
 * `beyond` is the medium behind the surface.
 */
static inline void connect_light(struct connection *connection, const struct scene *scene,
                                 const rt_params *params, RECORDED struct path *path,
                                 const struct surface *surface, const struct bsdf *bsdf,
                                 uint beyond, uint held, bool last, float4 u)
{
    struct light_sample sample;
    float3 scattered;
    if (!sample_direct(&sample, &scattered, scene, params, surface, bsdf, held, last, u))
        return;
    RECORD(record_light(&path->vertex, &sample, scattered, bsdf_eval_all(bsdf, sample.wi).value));
    const bool through = dot(sample.wi, bsdf->normal) < 0.0f;
    const float lift = through ? -surface->error : surface->error;
    connection->ray = shadow_ray(surface->position + lift * bsdf->normal, &sample);
    const float distance = sample.distant ? INFINITY : length(connection->ray.direction);
    const float3 arrived =
        medium_transmittance(scene->materials, through ? beyond : path->media.x, distance);
    connection->radiance =
        path->eta_scale * path->beta * (scattered * arrived * sample.radiance * sample.inv_pdf);
}

/* Adds the light of a connection to the path if nothing is in between. */
static inline void add_connection(struct path *path, const struct scene *scene,
                                  const struct connection *connection)
{
    const struct ray ray = connection->ray; /* a copy, as in path_extend */
    if (!(largest3(connection->radiance) > 0.0f))
        return;
    COUNT(scene, RT_COUNTER_SHADOW, ray.direction.x);
    if (!occluded(scene, &ray)) {
        RECORD(record_arrival(&path->vertex, connection->radiance));
        path->radiance += connection->radiance;
    }
}

#endif
