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
 * At the diffuse events before it, the caustic photons are asked for, which came there through delta
 * surfaces only: eye paths would find that light too seldom, and that of a point light never. A path that
 * goes from such a surface through delta surfaces to a lamp therefore leaves the lamp's light out.
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

/* Where an eye path asks photon maps. */
struct gather {
    global rt_gather_point *point; /* where it ends: position, normal, weight and material are filled in */
    global rt_gather_point *caustics; /* [params->final_gather], the diffuse events before that, */
    uint stride;                      /* so many points apart */
};

/* Which light is wanted of a path. */
enum purpose {
    FOLLOW_ALL,       /* all that comes by any way */
    FOLLOW_DIRECT,    /* emission, and light scattered once; delta events do not count */
    FOLLOW_TO_GATHER, /* what the photon map is not asked for; the path ends where it is */
};

/*
 * The weight of a sample that the other technique makes `ratio` times as often: the power heuristic
 * p^2 / (p^2 + q^2), ratio = q / p; or all or nothing, where one technique stands alone.
 */
static inline float mis_weight(const rt_params *params, uint technique, float ratio)
{
    if (params->estimator != RT_ESTIMATOR_MIS)
        return params->estimator == technique ? 1.0f : 0.0f;
    return 1.0f / (1.0f + ratio * ratio);
}

/*
 * The light that a surface emits along wo, weighted against the light sampling at the previous vertex
 * `from`, whose scattering had density pdf_w; 0: nothing to weigh against.
 */
static inline float3 emitted_light(const struct scene *scene, const rt_params *params, const struct surface *surface,
                                   float3 wo, float3 from, float pdf_w)
{
    const uint index = surface_light(scene, surface);
    if (index == RT_NONE)
        return (float3)(0.0f);
    global const rt_light_data *light = scene->lights + index;
    const float3 emitted = light_radiance(scene, light, surface, wo);
    if (pdf_w == 0.0f || largest3(emitted) <= 0.0f)
        return emitted;
    return emitted * mis_weight(params, RT_ESTIMATOR_BSDF, light_pdf_w(scene, light, from, surface) / pdf_w);
}

/* The same of the environment, for a ray in direction w that meets nothing. */
INLINE_NEVER float3 environment_light(const struct scene *scene, const rt_params *params, float3 from, float3 w,
                                      float pdf_w)
{
    const float3 radiance = sky_radiance(scene, w);
    if (pdf_w == 0.0f || largest3(radiance) <= 0.0f)
        return radiance;
    return radiance * mis_weight(params, RT_ESTIMATOR_BSDF, sky_light_pdf_w(scene, from, w) / pdf_w);
}

/* What counts of a lobe's light from a sampled point; `alone`: not weighted. */
static inline float3 counted(const rt_params *params, const struct light_sample *sample, struct lobe lobe, bool alone)
{
    if (alone || sample->delta)
        return lobe.value;
    return lobe.value * mis_weight(params, RT_ESTIMATOR_LIGHT, lobe.pdf_w * sample->spread);
}

/*
 * The light that one sampled point of a light sends by way of the surface to wo. Diffuse light stands alone at the
 * last vertex of a path, unless the photon map has it; rough events go on there.
 */
static inline float3 direct_light(const struct scene *scene, const rt_params *params, const struct surface *surface,
                                  const struct bsdf *bsdf, uint medium, uint beyond, float4 u, bool last)
{
    struct light_sample sample;
    if (!sample_light(scene, surface->position, u, &sample))
        return (float3)(0.0f);
    float3 scattered = (float3)(0.0f);
    if (!(last && params->direct == RT_DIRECT_PHOTONS))
        scattered = counted(params, &sample, bsdf_diffuse(bsdf, sample.wi), last);
    if (bsdf_is_rough(bsdf))
        scattered += counted(params, &sample, bsdf_rough(bsdf, sample.wi), false);
    if (largest3(scattered) <= 0.0f)
        return (float3)(0.0f);
    const bool through = dot(sample.wi, bsdf->normal) < 0.0f;
    const float lift = through ? -surface->error : surface->error;
    const struct ray ray = shadow_ray(surface->position + lift * bsdf->normal, &sample);
    if (occluded(scene, &ray))
        return (float3)(0.0f);
    const float distance = sample.distant ? INFINITY : length(ray.direction);
    const float3 arrived = medium_transmittance(scene->materials, through ? beyond : medium, distance);
    return scattered * arrived * sample.radiance * sample.spread;
}

/* The chance to go on after `depth` segments, from the throughput that would be left. */
static inline float survival_chance(const rt_params *params, uint depth, float3 throughput)
{
    return depth < params->roulette_depth ? 1.0f : min(1.0f, largest3(throughput));
}

/*
 * Whether caustic photons account for a light that the path meets: they come by delta events alone to a diffuse
 * surface, where the final gather asks for them.
 */
static inline bool left_to_photons(const uint purpose, uint diffuse_events, float pdf_w, bool rough)
{
    return purpose == FOLLOW_TO_GATHER && diffuse_events > 0u && pdf_w == 0.0f && !rough;
}

/* Asks for the photons around a surface, whose diffuse reflection counts with this weight, kd included. */
static inline void ask_photons(global rt_gather_point *point, const struct surface *surface, const struct bsdf *bsdf,
                               uint material, float3 weight)
{
    vstore3(surface->position, 0, point->position);
    vstore3(bsdf->normal, 0, point->normal);
    vstore3(bsdf->wo, 0, point->wo);
    vstore3(weight, 0, point->weight);
    point->material = material;
}

/*
 * Follows the path that begins with `ray` (of unit direction) and returns the radiance it brings.
 * purpose is a constant at each call; *gather serves FOLLOW_TO_GATHER alone, and its points are left alone when the
 * path ends before.
 */
static inline float3 follow_path(const struct scene *scene, const rt_params *params, const struct sampler *sampler,
                                 struct ray ray, const uint purpose, const struct gather *gather)
{
    float3 radiance = (float3)(0.0f); /* so far */
    float3 beta = (float3)(1.0f);     /* throughput, without the change of radiance at refraction */
    float squeeze = 1.0f;             /* which is kept here, and means nothing to roulette */
    float pdf_w = 0.0f;               /* density of the ray's direction, 0 for the camera and delta events */
    float3 from = ray.origin;         /* the previous vertex */
    uint4 media = vload4(0, scene->header->eye_media) - 1u;
    uint hidden = 0u;
    uint diffuse_events = 0u;
    bool scattered = false; /* by an event other than a delta one */
    bool rough = false;     /* by a rough event since the last diffuse one */

    if (!can_follow(&ray))
        return radiance;
    for (uint depth = 1u; depth <= params->max_depth;) {
        /* Draw the numbers of the next vertex: they hang on nothing, so a processor makes them while it waits below. */
        const uint vertex = depth - 1u;
        const float8 u = sampler_pair(sampler, set_light(vertex));

        /* Find the nearest surface. */
        struct hit hit;
        if (!closest_hit(scene, &ray, &hit)) {
            if (has_sky(scene) && !left_to_photons(purpose, diffuse_events, pdf_w, rough))
                radiance += squeeze * beta * medium_transmittance(scene->materials, media.x, INFINITY) *
                            environment_light(scene, params, from, ray.direction, pdf_w);
            break;
        }
        const struct surface surface = surface_at(scene, &ray, &hit);
        const uint material_index = scene->shapes[surface.shape].material;
        global const rt_material_data *material = scene->materials + material_index;
        const float3 wo = -ray.direction;

        /* Lose what the medium absorbs on the way. */
        beta *= medium_transmittance(scene->materials, media.x, hit.t);

        /* Go straight on through a boundary that a stronger medium hides. */
        struct boundary boundary;
        boundary.beyond = media;
        boundary.eta = media_ior(scene, media);
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

        /* Add what the surface emits, unless caustic photons account for it. */
        if (!left_to_photons(purpose, diffuse_events, pdf_w, rough))
            radiance += squeeze * beta * emitted_light(scene, params, &surface, wo, from, pdf_w);
        if (depth == params->max_depth || (purpose == FOLLOW_DIRECT && scattered))
            break;

        /* Add direct light. */
        const struct bsdf bsdf = bsdf_at(scene, material, &surface, wo, boundary.eta, beta);
        const bool last = purpose == FOLLOW_TO_GATHER && diffuse_events == params->final_gather;
        if (bsdf_is_diffuse(&bsdf) || bsdf_is_rough(&bsdf))
            radiance += squeeze * beta *
                        direct_light(scene, params, &surface, &bsdf, media.x, boundary.beyond.x, u.lo, last);

        /* Choose an event, or the end of the path by roulette, which spares nothing where the path ends anyway. */
        const float survival = last ? 1.0f : survival_chance(params, depth, beta * bsdf_albedo(&bsdf));
        const uint event = bsdf_choose(&bsdf, survival, u.hi.z);
        if (event == EVENT_ABSORBED)
            break;
        beta *= 1.0f / survival;

        /* In photon mapping, ask for photons at each diffuse event: all of them at the last, caustic ones before. */
        if (purpose == FOLLOW_TO_GATHER && event == EVENT_DIFFUSE) {
            ask_photons(last ? gather->point : gather->caustics + diffuse_events * gather->stride, &surface, &bsdf,
                        material_index, squeeze * beta * bsdf_event_weight(&bsdf, EVENT_DIFFUSE));
            if (last)
                break;
            diffuse_events++;
        }
        rough = event == EVENT_ROUGH || (rough && event != EVENT_DIFFUSE);

        /* Take the event's direction and go on. */
        const struct scatter scatter = bsdf_scatter(&bsdf, event, u.hi.xyw, CARRY_RADIANCE);
        beta *= scatter.weight;
        if (largest3(beta) <= 0.0f)
            break;
        squeeze *= scatter.squeeze;
        pdf_w = scatter.pdf_w;
        scattered |= pdf_w > 0.0f;
        from = surface.position;
        if (scatter.through)
            media = boundary.beyond;
        const float lift = scatter.through ? -surface.error : surface.error;
        ray = make_ray(surface.position + lift * bsdf.normal, scatter.wi, 0.0f, INFINITY);
        depth++;
    }
    return radiance;
}

#endif
