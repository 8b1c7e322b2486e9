/*
 * vertex.h - a vertex of a path at a surface: what the integrators ask of it.
 *
 *   meet_surface     the surface and the boundary that a ray meets
 *   make_vertex      the vertex there, of which the rest asks
 *   vertex_albedo    the part of the light that is scattered
 *   vertex_choose    one of its events, or that the path ends
 *   vertex_scatter   a direction of that event
 *   vertex_direct    what it scatters from a sampled light
 *   vertex_held      the events of which photon maps hold the light
 *   vertex_stores    whether photons are stored
 *
 * An event is scattering by one lobe of the BSDF (bsdf/bsdf.h), a set of events has a bit for each;
 * what lobes there are is known here and below alone. bidirectional.h has the densities of both
 * directions of a path, gather_point.h what photons scatter at a vertex.
 */
#ifndef RT_KERNELS_SURFACE_VERTEX_H
#define RT_KERNELS_SURFACE_VERTEX_H

#include "bsdf/bsdf.h"
#include "sample/mis.h"
#include "surface/contact.h"
#include "surface/dispersion.h"
#include "surface/parts.h"

#define RT_NO_EVENT RT_LOBE_NONE

/* What a ray meets. */
struct meeting {
    struct surface surface; /* of faces that coincide that which light meets */
    struct boundary boundary;
    float3 wo; /* unit; where the ray came from */
    uint material;
    uint part;   /* of the material (parts.h), which is all of it where that has none */
    uint lobes;  /* of a material with parts: lobes_of_parts on the side of wo; else 0 */
    uint behind; /* the medium on the other side, whatever part is met */
    DISPERSED(float wavelength;) /* of the boundary, micrometres; 0: any */
};

struct vertex {
    float3 position;
    float error; /* how far along the normal a ray must start to be off the surface */
    struct bsdf bsdf;
    struct bsdf_params params;   /* the shading normal on the side of wo, too */
    uint material;               /* the part that was met */
    uint lobes, behind;          /* as in struct meeting */
    uint medium;                 /* on the side of wo: a material, or RT_NONE */
    uint4 beyond;                /* the media on the other side */
    DISPERSED(float wavelength;) /* as in struct meeting */
    DISPERSED(float3 drawn;)     /* of a light vertex: what that weighs */
};

/* ---- Making it ------------------------------------------------------------------------ */

/*
 * Chooses the part that is met. The boundary is that of the whole material; an opaque part hides
 * it, and what lies behind.
 */
static inline void meet_part(struct meeting *met, const struct scene *scene, const struct ray *ray,
                             uint4 media)
{
    global const rt_material_data *whole = scene->materials + met->material;
    const bool behind = dot(met->wo, met->surface.normal) < 0.0f;
    met->part = part_at(scene->header, met->material, behind, surface_place(scene, &met->surface),
                        chance_of_ray(ray, met->surface.prim));
    met->lobes = lobes_of_parts(whole, behind);
    if (met->boundary.exists && is_transparent(whole) &&
        !is_transparent(scene->materials + met->part))
        met->boundary = media_meet(scene, media, met->part, false);
}

static inline void meet_surface(struct meeting *met, const struct scene *scene,
                                const struct ray *ray, const struct hit *hit, uint4 media)
{
    surface_at(&met->surface, scene, ray, hit);
    met->wo = -ray->direction;
    met->boundary = meet_boundary(scene, media, &met->surface, met->wo);
    met->material = met->part = scene->shapes[met->surface.shape].material;
    met->lobes = 0u;
    met->behind = met->boundary.beyond.x;
    DISPERSED(met->wavelength = 0.0f);
    if (UNLIKELY(has_parts(scene->materials + met->material)))
        meet_part(met, scene, ray, media);
}

#ifdef RT_DISPERSION
/*
 * Finds the wavelength of a boundary that a path of throughput beta meets in this medium, and its
 * index; *run: the wavelength of the path. Returns what the wavelength weighs.
 */
static inline float3 meet_dispersion(struct meeting *met, float *run, const struct scene *scene,
                                     uint medium, float3 beta, const struct sampler *sampler,
                                     uint vertex)
{
    const uint beyond = met->boundary.beyond.x;
    if (!disperses(scene, met->part, medium, beyond))
        return (float3)(1.0f);
    const float u = sampler_set(sampler, set_wavelength(vertex)).x;
    const float3 weight =
        meet_wavelength(run, &met->wavelength, scene->materials + met->part, beta, u);
    disperse(&met->boundary, scene, met->part, medium, beyond, met->wavelength);
    return weight;
}
#endif

/* For a path of throughput beta that carries `transport`, in this medium. */
static inline void make_vertex(struct vertex *vertex, const struct scene *scene,
                               const struct meeting *met, uint medium, float3 beta, uint transport)
{
    global const rt_material_data *material = scene->materials + met->part;
    const float side = dot(met->wo, met->surface.normal) < 0.0f ? -1.0f : 1.0f;
    vertex->position = met->surface.position;
    vertex->error = met->surface.error;
    evaluate_material(&vertex->params, scene, material, &met->surface);
    vertex->params.shading = side * vertex->params.shading;
    vertex->material = met->part;
    vertex->lobes = met->lobes;
    vertex->behind = met->behind;
    vertex->medium = medium;
    vertex->beyond = met->boundary.beyond;
    DISPERSED(vertex->wavelength = met->wavelength);
    make_bsdf(&vertex->bsdf, &vertex->params, material, side * met->surface.normal, met->wo,
              &met->boundary, beta, transport);
}

/* ---- Where rays start ------------------------------------------------------------------ */

/* Whether a direction leads to the other side. */
static inline bool vertex_crosses(const struct vertex *vertex, float3 w)
{
    return dot(w, vertex->bsdf.normal) < 0.0f;
}

/* Off the surface, on the other side or on that of wo. */
static inline float3 vertex_off(const struct vertex *vertex, bool through)
{
    const float lift = through ? -vertex->error : vertex->error;
    return vertex->position + lift * vertex->bsdf.normal;
}

/* On the side of w. */
static inline float3 vertex_leave(const struct vertex *vertex, float3 w)
{
    return vertex_off(vertex, vertex_crosses(vertex, w));
}

/* The transmittance along a segment that leaves in direction w. */
static inline float3 vertex_transmittance(const struct scene *scene, const struct vertex *vertex,
                                          float3 w, float distance)
{
    return medium_transmittance(
        scene->materials, vertex_crosses(vertex, w) ? vertex->beyond.x : vertex->medium, distance);
}

/* ---- Events ----------------------------------------------------------------------------- */

static inline float3 vertex_albedo(const struct vertex *vertex)
{
    return bsdf_albedo(&vertex->bsdf);
}

/* That of radiance, by which light paths survive. */
static inline float3 vertex_radiance_albedo(const struct vertex *vertex)
{
    return radiance_albedo(&vertex->bsdf);
}

/* Whether light comes to it from other directions than delta events have. */
static inline bool vertex_connects(const struct vertex *vertex)
{
    return bsdf_lobes(&vertex->bsdf) != 0u;
}

/*
 * Whether light paths are joined with others there, by whatever part of its material these meet.
 */
static inline bool vertex_receives(const struct vertex *vertex)
{
    return vertex_connects(vertex) || vertex->lobes != 0u;
}

/* Whether it may be scattered by a rough event whose light no photon map holds. */
static inline bool vertex_splits(const struct vertex *vertex, const rt_params *params)
{
    return bsdf_is_rough(&vertex->bsdf) && !rough_is_gathered(&vertex->bsdf, params);
}

/* The event of a path that survives with this probability, by u in [0,1), or RT_NO_EVENT. */
static inline uint vertex_choose(const struct vertex *vertex, float survival, float u)
{
    return bsdf_choose(&vertex->bsdf, survival, u);
}

/* The probability that it is chosen, given survival. */
static inline float vertex_probability(const struct vertex *vertex, uint event)
{
    return bsdf_probability(&vertex->bsdf, event);
}

/* The albedo of the event over that probability. */
static inline float3 vertex_event_weight(const struct vertex *vertex, uint event)
{
    return bsdf_lobe_weight(&vertex->bsdf, event);
}

static inline bool event_is_delta(uint event)
{
    return lobe_is_delta(event);
}

/* A direction of the event, by u in [0,1)^3. */
static inline struct scatter vertex_scatter(const struct vertex *vertex, uint event, float3 u)
{
    return bsdf_scatter(&vertex->bsdf, event, u);
}

/* The set of events that photon maps hold the light of, and whether there may be any. */
static inline uint vertex_held(const struct vertex *vertex, const rt_params *params)
{
    return bsdf_gathered_lobes(&vertex->bsdf, params);
}

static inline bool vertex_stores(const struct vertex *vertex, const rt_params *params)
{
    const uint others = RT_PARTS_DIFFUSE | (params->gather_alpha > 0.0f ? RT_PARTS_ROUGH : 0u);
    return bsdf_is_stored(&vertex->bsdf, params) || (vertex->lobes & others) != 0u;
}

/* ---- Direct light ------------------------------------------------------------------------ */

/* The events that a sampled light may take, but those of a set. */
static inline uint vertex_lit_events(const struct vertex *vertex, uint but)
{
    return bsdf_lobes(&vertex->bsdf) & ~but;
}

/*
 * fr |n.wi| of a set of events for light from wi, which light sampling found with density
 * 1 / inv_pdf. Each event is weighted by itself against sampling that; in the set `alone` it
 * counts fully.
 */
static inline float3 vertex_direct(const struct vertex *vertex, const rt_params *params,
                                   uint events, uint alone, float3 wi, float inv_pdf)
{
    float3 scattered = (float3)(0.0f);
    for (uint i = 0u; i < RT_BSDF_LOBES; i++) {
        const uint event = bsdf_lobe(&vertex->bsdf, i);
        if (!(events >> event & 1u))
            continue;
        const struct lobe_value light = bsdf_eval(&vertex->bsdf, i, wi);
        scattered += alone >> event & 1u ? light.value
                                         : light.value * mis_weight(params, RT_ESTIMATOR_LIGHT,
                                                                    light.pdf_w * inv_pdf);
    }
    return scattered;
}

/* ---- Where paths are recorded (record.h) -------------------------------------------------- */

#ifdef RT_RECORD_PATHS
/* fr |n.wi| of all events. */
static inline float3 vertex_value(const struct vertex *vertex, float3 wi)
{
    return bsdf_eval_all(&vertex->bsdf, wi).value;
}

/* The word for an event, RT_PATH_*. */
static inline uint event_word(uint event, bool through)
{
    if (event == RT_LOBE_SPECULAR_REFLECTION)
        return RT_PATH_REFLECTION;
    if (event == RT_LOBE_SPECULAR_TRANSMISSION)
        return RT_PATH_REFRACTION;
    if (lobe_is_rough(event))
        return through ? RT_PATH_ROUGH_REFRACTION : RT_PATH_ROUGH_REFLECTION;
    return through ? RT_PATH_DIFFUSE_TRANSMISSION : RT_PATH_DIFFUSE;
}
#endif

#endif
