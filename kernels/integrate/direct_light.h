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
 * The light of one lobe from a sampled point, weighted by MIS against sampling the lobe. `alone`:
 * the path does not continue by this lobe, so light sampling counts fully.
 */
static inline float3 mis_weighted_lobe(const rt_params *params, const struct light_sample *sample,
                                       struct lobe_value lobe, bool alone)
{
    if (alone || sample->delta)
        return lobe.value;
    return lobe.value * mis_weight(params, RT_ESTIMATOR_LIGHT, lobe.pdf_w * sample->inv_pdf);
}

/*
 * Samples a light at a vertex and sets the connection: the scattered radiance and the shadow ray.
 * `last`: a gathered event here is a gather point, where the photon map may hold direct light too;
 * other GGX events continue the path. `beyond` is the medium behind the surface.
 */
static inline void connect_light(struct connection *connection, const struct scene *scene,
                                 const rt_params *params, RECORDED struct path *path,
                                 const struct surface *surface, const struct bsdf *bsdf,
                                 uint beyond, float4 u, bool last)
{
    const bool in_photons = last && params->direct == RT_DIRECT_PHOTONS;
    struct light_sample sample;
    const bool rough_last = last && rough_is_gathered(bsdf, params);
    if (in_photons && (rough_last || !bsdf_is_rough(bsdf)))
        return;
    if (!sample_light(scene, surface->position, u, &sample))
        return;
    float3 scattered = (float3)(0.0f);
    if (!in_photons)
        scattered = mis_weighted_lobe(params, &sample,
                                      bsdf_eval(bsdf, bsdf->diffuse_lobe, sample.wi), last);
    if (bsdf_is_rough(bsdf))
        scattered += mis_weighted_lobe(
            params, &sample, bsdf_eval(bsdf, bsdf_rough_lobe(bsdf), sample.wi), rough_last);
    RECORD(record_light(&path->vertex, &sample, scattered, record_unweighted(bsdf, sample.wi)));
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
