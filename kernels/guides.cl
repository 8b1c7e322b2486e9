/*
 * guides.cl - what guides a denoiser: albedo and normal of the first surface that is neither a
 * smooth mirror nor smooth glass, seen through those that are, as means over a few samples, the
 * same as other modes take.
 */
#define RT_RADIANCE_ALONE
#include "camera/camera.h"
#include "entry.h"
#include "camera/film.h"
#include "integrate/path.h"

struct guide {
    float3 albedo, normal;
};

/* At what the path met: sets the guide and ends the path, or sends it on by a delta event. */
CALLED_ON_GPUS void guide_of_meeting(struct guide *guide, struct path *path,
                                     const struct scene *scene, const rt_params *params,
                                     const struct meeting *met, float4 u)
{
    struct vertex vertex;
    make_vertex(&vertex, scene, met, path->media.x, path->beta, CARRY_RADIANCE);
    const uint event = vertex_choose(&vertex, 1.0f, u.z);
    const bool is_delta = event != RT_NO_EVENT && event_is_delta(event);
    /* What emits stands for itself. */
    const bool emits = surface_light(scene, &met->surface) != RT_NONE;
    path->alive = is_delta && !emits && path->depth < params->max_depth;
    if (!path->alive) {
        guide->albedo = path->beta * (emits ? (float3)(1.0f) : vertex_albedo(&vertex));
        guide->normal = vertex.bsdf.shading;
        return;
    }
    path_scatter(path, &vertex, event, false, u.xyw);
}

/* The same at a surface that it hits; or passes a boundary that has no effect. */
static void guide_at(struct guide *guide, struct path *path, const struct scene *scene,
                     const rt_params *params, const struct hit *hit, float8 u)
{
    struct meeting met;
    meet_surface(&met, scene, &path->ray, hit, path->media);
    path->beta *= medium_transmittance(scene->materials, path->media.x, hit->t);
    if (!met.boundary.exists) {
        path_pass(path, &met);
        return;
    }
    guide_of_meeting(guide, path, scene, params, &met, u.hi);
}

/* The guide of one sample: 0 where the path escapes to no environment. */
static struct guide guide_of(const struct scene *scene, const rt_params *params,
                             const struct sampler *sampler, struct ray ray)
{
    struct guide guide = {(float3)(0.0f), (float3)(0.0f)};
    struct path path;
    path_begin(&path, scene, sampler, ray);
    while (path.alive) {
        const float8 u = path_numbers(&path);
        const struct ray next = path.ray;
        struct hit hit;
        count_path_ray(scene, &path);
        if (!closest_hit(scene, &next, &hit)) {
            guide.albedo = meets_environment(scene, path.depth) ? path.beta : (float3)(0.0f);
            break;
        }
        guide_at(&guide, &path, scene, params, &hit, u);
    }
    guide.albedo = clamp(guide.albedo, 0.0f, 1.0f);
    return guide;
}

KERNEL ENTRY(guides)(const rt_params params, global const rt_scene_header *header,
                     global rt_guide *film)
{
    const uint item = item_number();
    if (item >= params.item_count)
        return;
    const struct scene scene = scene_open_compensated(header, &params);
    const uint2 at = pixel_of_item(&params, params.first_item + item);
    const uint index = at.y * params.width + at.x;
    float3 albedo = (float3)(0.0f), normal = (float3)(0.0f);
    for (uint i = 0u; i < params.sample_count; i++) {
        const struct sampler sampler = sampler_start(&scene, &params, index, i);
        float weight;
        const struct ray ray = pixel_ray(&scene, &params, &sampler, at, &weight);
        const struct guide guide = guide_of(&scene, &params, &sampler, ray);
        if (all(isfinite(guide.albedo + guide.normal))) {
            albedo += guide.albedo;
            normal += guide.normal;
        }
    }
    const float inverse = 1.0f / (float)params.sample_count;
    vstore3(inverse * albedo, 0, film[index].albedo);
    vstore3(inverse * normal, 0, film[index].normal);
    film[index].reserved0 = film[index].reserved1 = 0.0f;
}
