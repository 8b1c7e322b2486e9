/*
 * direct_light.h - light sampling: joins a vertex of a path with a sampled point of a light.
 */
#ifndef RT_KERNELS_INTEGRATE_DIRECT_LIGHT_H
#define RT_KERNELS_INTEGRATE_DIRECT_LIGHT_H

#include "accel/traverse.h"
#include "integrate/path_state.h"
#include "light/light.h"
#include "material/medium.h"
#include "surface/vertex.h"

/*
 * Samples a light at a vertex: *scattered is fr |n.wi|, each event weighted by MIS against sampling
 * it; false where there is none. `held`: the events of which photon maps hold the light. `last`:
 * the path does not go on by these, so that light sampling counts fully for them, where the map
 * does not hold direct light, too.
 */
static inline bool sample_direct(struct light_sample *sample, float3 *scattered,
                                 const struct scene *scene, const rt_params *params,
                                 const struct vertex *vertex, uint held, bool last, float4 u)
{
    const bool in_photons = last && params->direct == RT_DIRECT_PHOTONS;
    const uint events = vertex_lit_events(vertex, in_photons ? held : 0u);
    if (!events || !sample_light(scene, vertex->position, u, sample))
        return false;
    const uint alone = sample->delta ? ~0u : last ? held : 0u;
    *scattered = vertex_direct(vertex, params, events, alone, sample->wi, sample->inv_pdf);
    return true;
}

/* Samples a light at a vertex and sets the connection: scattered radiance and shadow ray. */
static inline void connect_light(struct connection *connection, const struct scene *scene,
                                 const rt_params *params, RECORDED struct path *path,
                                 const struct vertex *vertex, uint held, bool last, float4 u)
{
    struct light_sample sample;
    float3 scattered;
    if (!sample_direct(&sample, &scattered, scene, params, vertex, held, last, u))
        return;
    RECORD(record_light(&path->vertex, &sample, scattered, vertex_value(vertex, sample.wi)));
    connection->ray = shadow_ray(vertex_leave(vertex, sample.wi), &sample);
    const float distance = sample.distant ? INFINITY : length(connection->ray.direction);
    const float3 arrived = vertex_transmittance(scene, vertex, sample.wi, distance);
    connection->radiance =
        path->eta_scale * path->beta * (scattered * arrived * sample.radiance * sample.inv_pdf);
}

/* Adds the light of a connection to the path if nothing is in between. */
static inline void add_connection(struct path *path, const struct scene *scene,
                                  const struct connection *connection)
{
    const struct ray ray = connection->ray; /* a copy: the connection lives in registers */
    if (!(largest3(connection->radiance) > 0.0f))
        return;
    COUNT(scene, RT_COUNTER_SHADOW, ray.direction.x);
    if (!occluded(scene, &ray)) {
        RECORD(record_arrival(&path->vertex, connection->radiance));
        path->radiance += connection->radiance;
    }
}

#endif
