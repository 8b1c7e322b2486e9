/*
 * integrate.h - follows a path from the eye: the rendering equation by Monte Carlo.
 *
 *   Lo(x, wo) = Le(x, wo) + integral of fr(x, wo, wi) Li(x, wi) |n.wi| dwi            Kajiya 1986
 *
 * At each vertex, light that comes straight from a lamp is estimated twice, by a point sampled on a
 * light and by the direction sampled from the surface, combined by multiple importance sampling with
 * the power heuristic (Veach and Guibas 1995). Delta events and point lights leave only one of the
 * two, which then counts fully.
 *
 * The same function serves photon mapping, whose eye paths end where the photon map is asked: at the
 * diffuse event after `final_gather` others. There the path is not continued, so light sampling
 * stands alone at that vertex and counts fully (or not at all, where the map holds direct light too).
 *
 * References:
 *   Kajiya: "The Rendering Equation", SIGGRAPH 1986.
 *   Veach, Guibas: "Optimally Combining Sampling Techniques for Monte Carlo Rendering", SIGGRAPH 1995.
 *   Arvo, Kirk: "Particle Transport and Image Synthesis", SIGGRAPH 1990 (Russian roulette).
 */
#ifndef RT_INTEGRATE_H
#define RT_INTEGRATE_H

#include "bsdf.h"
#include "light.h"
#include "medium.h"
#include "rng.h"
#include "traverse.h"

/*
 * The first vertex of a path, counted from 0, at which roulette may end it. Measured variance times time in closed
 * rooms of albedo 0.7: under an area lamp 1 and 2 are equal and 3 is a tenth worse, under a point light 2 and 3 are
 * 15 to 25 % better. 1 gives the most samples a second.
 */
#define RT_ROULETTE_VERTEX 1u

/* Where an eye path asks the photon map; found is false when the path ended before. */
struct gather {
    bool found;
    float3 position;
    float3 normal; /* geometric, on the side of wo */
    float3 wo;
    float3 weight; /* of the reflected radiance, kd excluded */
    uint material;
};

/*
 * The power heuristic's weight of a sample that another technique makes `ratio` times as often:
 * p^2 / (p^2 + q^2), ratio = q / p.
 */
static inline float mis_weight(float ratio)
{
    return 1.0f / (1.0f + ratio * ratio);
}

/*
 * The light that a surface emits along wo, weighted against the light sampling at the previous vertex
 * `from`, whose scattering had density pdf_w; 0: nothing to weigh against.
 */
static inline float3 emitted_light(const struct scene *scene, const struct surface *surface, float3 wo, float3 from,
                                   float pdf_w)
{
    const uint index = surface_light(scene, surface);
    if (index == RT_NONE)
        return (float3)(0.0f);
    global const rt_light_data *light = scene->lights + index;
    const float3 emitted = light_radiance(light, surface->normal, wo);
    if (pdf_w == 0.0f || largest3(emitted) <= 0.0f)
        return emitted;
    return emitted * mis_weight(light_pdf_w(light, from, surface) / pdf_w);
}

/* The light that one sampled point of a light sends by way of the surface to wo; `alone`: not weighted. */
static inline float3 direct_light(const struct scene *scene, const struct surface *surface, const struct bsdf *bsdf,
                                  float4 u, bool alone)
{
    struct light_sample sample;
    if (!sample_light(scene, surface->position, u, &sample))
        return (float3)(0.0f);
    const float3 scattered = bsdf_eval(bsdf, sample.wi);
    if (largest3(scattered) <= 0.0f)
        return (float3)(0.0f);
    /* Light that is scattered comes from the side of wo. */
    const struct ray ray = shadow_ray(surface->position + surface->error * bsdf->normal, &sample);
    if (occluded(scene, &ray))
        return (float3)(0.0f);
    const float weight = alone || sample.delta ? 1.0f : mis_weight(bsdf_pdf_w(bsdf, sample.wi) * sample.spread);
    return scattered * sample.radiance * (weight * sample.spread);
}

static inline struct gather gather_at(const struct surface *surface, const struct bsdf *bsdf, float3 weight,
                                      uint material)
{
    struct gather gather;
    gather.found = true;
    gather.position = surface->position;
    gather.normal = bsdf->normal;
    gather.wo = bsdf->wo;
    gather.weight = weight;
    gather.material = material;
    return gather;
}

/* The chance to go on after a vertex, from the throughput that would be left. */
static inline float survival_chance(uint vertex, float3 throughput)
{
    return vertex < RT_ROULETTE_VERTEX ? 1.0f : min(1.0f, largest3(throughput));
}

/*
 * Follows the path that begins with `ray` (of unit direction) and returns the radiance it brings.
 * to_gather is a constant at each call: false for path tracing, true to end the path at a gather point.
 */
static inline float3 follow_path(const struct scene *scene, const rt_params *params, const struct sampler *sampler,
                                 struct ray ray, const bool to_gather, struct gather *gather)
{
    float3 radiance = (float3)(0.0f); /* so far */
    float3 beta = (float3)(1.0f);     /* throughput, without the change of radiance at refraction */
    float squeeze = 1.0f;             /* which is kept here, and means nothing to roulette */
    float pdf_w = 0.0f;               /* density of the ray's direction, 0 for the camera and delta events */
    float3 from = ray.origin;         /* the previous vertex */
    uint4 media = RT_VACUUM;
    uint hidden = 0u;
    uint diffuse_events = 0u;

    if (!can_follow(&ray))
        return radiance;
    for (uint depth = 1u; depth <= params->max_depth;) {
        /* Draw the numbers of the next vertex: they hang on nothing, so a processor makes them while it waits below. */
        const uint vertex = depth - 1u;
        const float8 u = sampler_pair(sampler, set_light(vertex));

        /* Find the nearest surface. */
        struct hit hit;
        if (!closest_hit(scene, &ray, &hit))
            break;
        const struct surface surface = surface_at(scene, &ray, &hit);
        const uint material_index = scene->shapes[surface.shape].material;
        global const rt_material_data *material = scene->materials + material_index;
        const float3 wo = -ray.direction;

        /* Go straight on through a boundary that a stronger medium hides. */
        struct boundary boundary;
        boundary.eta = 1.0f;
        if (is_transparent(material)) {
            boundary = media_cross(scene, media, material_index, dot(wo, surface.normal) > 0.0f);
            if (!boundary.exists) {
                if (++hidden > RT_HIDDEN_BOUNDARIES)
                    break;
                ray.origin = leave_surface(&surface, ray.direction);
                media = boundary.beyond;
                pdf_w = 0.0f;
                continue;
            }
        }

        /* Add what the surface emits. */
        radiance += squeeze * beta * emitted_light(scene, &surface, wo, from, pdf_w);
        if (depth == params->max_depth)
            break;

        /* Add direct light, except where the photon map holds it. */
        const struct bsdf bsdf = bsdf_at(material, &surface, wo, boundary.eta, beta);
        const bool last = to_gather && diffuse_events == params->final_gather;
        if (bsdf_is_diffuse(&bsdf) && !(last && params->direct == RT_DIRECT_PHOTONS))
            radiance += squeeze * beta * direct_light(scene, &surface, &bsdf, u.lo, last);

        /* Choose an event, or the end of the path by roulette. */
        const float survival = survival_chance(vertex, beta * bsdf_albedo(&bsdf));
        const uint event = bsdf_choose(&bsdf, survival, u.hi.z);
        if (event == EVENT_ABSORBED)
            break;
        beta *= 1.0f / survival;

        /* In photon mapping, report the last diffuse event. */
        if (to_gather && event == EVENT_DIFFUSE) {
            if (last) {
                *gather = gather_at(&surface, &bsdf, squeeze * beta * (1.0f / bsdf.diffuse), material_index);
                break;
            }
            diffuse_events++;
        }

        /* Take the event's direction and go on. */
        const struct scatter scatter = bsdf_scatter(&bsdf, event, u.hi.xy, CARRY_RADIANCE);
        beta *= scatter.weight;
        if (largest3(beta) <= 0.0f)
            break;
        squeeze *= scatter.squeeze;
        pdf_w = scatter.pdf_w;
        from = surface.position;
        if (event == EVENT_REFRACTED)
            media = boundary.beyond;
        const float lift = event == EVENT_REFRACTED ? -surface.error : surface.error;
        ray = make_ray(surface.position + lift * bsdf.normal, scatter.wi, 0.0f, INFINITY);
        depth++;
    }
    return radiance;
}

#endif
