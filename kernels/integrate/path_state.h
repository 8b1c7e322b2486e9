/* path_state.h - what a path from the eye carries from vertex to vertex. */
#ifndef RT_KERNELS_INTEGRATE_PATH_STATE_H
#define RT_KERNELS_INTEGRATE_PATH_STATE_H

#include "accel/boxes.h"
#include "count.h"
#include "integrate/record_scatter.h"
#include "math/ray.h"
#include "sample/rng.h"
#include "scene.h"
#include "surface/vertex.h"
#include "types.h"

/* Which light a path collects. */
enum purpose {
    FOLLOW_ALL,       /* all of it */
    FOLLOW_DIRECT,    /* emission, and light scattered once; delta events do not count */
    FOLLOW_TO_GATHER, /* what photon maps do not hold; the path ends at its last gather point */
};

/* A path under way. */
struct path {
    struct sampler sampler;
    struct ray ray;  /* of unit direction */
    float3 from;     /* the vertex before: where the ray began */
    float3 radiance; /* gathered so far */
    float3 beta;     /* throughput without eta_scale */
    /*
     * product of (eta_i/eta_t)^2 at refractions, and of a path that was split the part that it has;
     * roulette ignores it
     */
    float eta_scale;
    /*
     * density of the ray's direction; 0: no light sample could have taken the same path, as after
     * the camera, a delta event or a skipped boundary
     */
    float pdf_w;
    float cut_off;       /* throughput at the end of the longest paths, else 0 */
    uint4 media;         /* the solids it is inside of */
    uint depth;          /* segments, the one under way included */
    uint hidden;         /* boundaries skipped inside a medium of higher priority */
    uint diffuse_events; /* counted by paths that gather */
    bool alive;          /* false: it has ended */
    bool scattered;      /* by an event other than a delta one */
    bool rough;   /* by a rough event since the last gathered one; told by paths that gather */
    bool whole;   /* not split so far: split.h */
    bool resumes; /* it goes on from the vertex that it was split at, which is known */
    DISPERSED(float wavelength;) /* of the run of delta events under way, micrometres; 0: none */
#ifdef RT_RECORD_PATHS
    rt_path_vertex vertex; /* that it is at */
#endif
};

/* Counts the ray that the path is about to follow. */
static inline void count_path_ray(const struct scene *scene, const struct path *path)
{
    COUNT(scene, path->depth == 1u ? RT_COUNTER_CAMERA : RT_COUNTER_BOUNCE, path->ray.direction.x);
}

/* A vertex joined with a sampled point of a light, before visibility is tested. */
struct connection {
    struct ray ray;
    float3 radiance; /* that the light adds to the path's if nothing is in between; 0: no light */
};

/* Begins a path with this ray; one that cannot be followed ends at once. */
static inline void path_begin(struct path *path, const struct scene *scene,
                              const struct sampler *sampler, struct ray ray)
{
    path->sampler = *sampler;
    path->ray = ray;
    path->from = ray.origin;
    path->radiance = (float3)(0.0f);
    path->beta = (float3)(1.0f);
    path->eta_scale = 1.0f;
    path->pdf_w = 0.0f;
    path->cut_off = 0.0f;
    path->media = vload4(0, scene->header->eye_media) - 1u;
    path->depth = 1u;
    path->hidden = 0u;
    path->diffuse_events = 0u;
    path->alive = can_follow(&ray);
    path->scattered = false;
    path->rough = false;
    path->whole = true;
    path->resumes = false;
    DISPERSED(path->wavelength = 0.0f);
}

/* The sample values of the next vertex: those of light sampling, then those of the BSDF. */
static inline float8 path_numbers(const struct path *path)
{
    return sampler_pair(&path->sampler, set_light(path->depth - 1u));
}

/*
 * Ends a path at its longest length, at this material: what it would have scattered, without its
 * textures, is the throughput that is cut off.
 */
static inline void path_cut_off(struct path *path, global const rt_material_data *material)
{
    path->alive = false;
    RECORD(path->vertex.event = RT_PATH_CUT_OFF);
    path->cut_off = mean3(path->beta * untextured_albedo(material));
}

/* Finds the wavelength of a boundary that the path meets; returns what it weighs. */
static inline float3 path_disperse(struct path *path, const struct scene *scene,
                                   struct meeting *met)
{
#ifdef RT_DISPERSION
    return meet_dispersion(met, &path->wavelength, scene, path->media.x, path->beta, &path->sampler,
                           path->depth - 1u);
#else
    return (float3)(1.0f);
#endif
}

/* Goes on through a boundary that has no effect; ends a path that meets too many of them. */
static inline void path_pass(struct path *path, struct meeting *met)
{
    path->alive =
        pass_boundary(&path->ray, &path->media, &path->hidden, &met->surface, met->boundary.beyond);
}

/* Samples the chosen event, gathered or not, with u in [0,1)^3 and spawns the next ray. */
static inline void path_scatter(struct path *path, const struct vertex *vertex, uint event,
                                const bool gathered, float3 u)
{
    const struct scatter scatter = vertex_scatter(vertex, event, u);
    RECORD(record_scatter(&path->vertex, event, scatter.through, scatter.pdf_w));
    path->beta *= scatter.weight;
    path->eta_scale *= scatter.eta_scale;
    path->pdf_w = scatter.pdf_w;
    path->alive = largest3(path->beta) > 0.0f;
    path->depth++;
    path->scattered |= path->pdf_w > 0.0f;
    DISPERSED(path->wavelength = path->pdf_w > 0.0f ? 0.0f : path->wavelength);
    path->rough = !gathered && (path->rough || !event_is_delta(event));
    path->from = vertex->position;
    if (scatter.through)
        path->media = vertex->beyond;
    path->ray = make_ray(vertex_off(vertex, scatter.through), scatter.wi, 0.0f, INFINITY);
}

#endif
