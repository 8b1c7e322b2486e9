/*
 * first_hit.cl - the layers of the first hit, such as albedo, normal and depth. Each item takes the
 * samples of one pixel, the same samples as the other modes.
 */
#define RT_RADIANCE_ALONE
#define RT_LOCATE_ALL /* for the layer of u and v */
#include "camera/camera.h"
#include "count.h"
#include "entry.h"
#include "camera/film.h"
#include "accel/traverse.h"
#include "surface/vertex.h"

/*
 * The distance along the view axis; an environment camera has none: there, the distance from the
 * eye.
 */
static float depth_of(global const rt_camera_data *camera, float3 position)
{
    const float3 away = position - row3(camera->eye);
    return camera->kind == RT_CAMERA_KIND_ENVIRONMENT ? length(away)
                                                      : dot(away, row3(camera->axis));
}

/* What a sample met first. */
struct first_hit {
    float3 albedo, normal, position, uv; /* uv.z is the depth */
    uint shape, material;
};

CALLED_ON_GPUS struct first_hit first_hit_of(const struct scene *scene, const struct meeting *met)
{
    struct vertex vertex;
    make_vertex(&vertex, scene, met, RT_NONE, (float3)(1.0f), CARRY_RADIANCE);
    /* bsdf.shading is on the side of wo; the layer has it on the side of the shape's normal. */
    const float side = dot(met->wo, met->surface.normal) < 0.0f ? -1.0f : 1.0f;
    struct first_hit first;
    first.albedo = vertex_albedo(&vertex);
    first.normal = side * vertex.bsdf.shading;
    first.position = met->surface.position;
    first.uv = (float3)(met->surface.u, met->surface.v,
                        depth_of(&scene->header->camera, met->surface.position));
    first.shape = met->surface.shape;
    first.material = met->material;
    return first;
}

static struct first_hit first_hit_at(const struct scene *scene, const struct ray *ray,
                                     const struct hit *hit)
{
    struct meeting met;
    meet_surface(&met, scene, ray, hit, vload4(0, scene->header->eye_media) - 1u);
    /* Of faces that coincide, the one that light meets; the albedo is that in air. */
    met.boundary.eta = 1.0f;
    return first_hit_of(scene, &met);
}

/* In fixed point; what rounding has put outside of [-1, 1] is brought back. */
static inline rt_i64 fixed_point(float value)
{
    return (rt_i64)rint(clamp(value, -1.0f, 1.0f) * RT_FIRST_HIT_UNIT);
}

/* Adds a hit of this filter weight, unless it is rejected; returns whether it was not. */
static bool add_hit(rt_first_hits *sums, const struct first_hit *hit, float weight)
{
    if (!all(isfinite(hit->albedo + hit->normal)) || !all(isfinite(hit->position)) ||
        !all(isfinite(hit->uv))) {
        sums->rejected = film_add_saturated(sums->rejected, 1u);
        return false;
    }
    const film_sums exact = film_sums_of_hits(sums);
    sums->albedo[0] += fixed_point(weight * hit->albedo.x);
    sums->albedo[1] += fixed_point(weight * hit->albedo.y);
    sums->albedo[2] += fixed_point(weight * hit->albedo.z);
    sums->normal[0] += fixed_point(weight * hit->normal.x);
    sums->normal[1] += fixed_point(weight * hit->normal.y);
    sums->normal[2] += fixed_point(weight * hit->normal.z);
    film_add_bits(exact, RT_HIT_POSITION, as_uint(hit->position.x));
    film_add_bits(exact, RT_HIT_POSITION + 1, as_uint(hit->position.y));
    film_add_bits(exact, RT_HIT_POSITION + 2, as_uint(hit->position.z));
    film_add_bits(exact, RT_HIT_UV, as_uint(hit->uv.x));
    film_add_bits(exact, RT_HIT_UV + 1, as_uint(hit->uv.y));
    film_add_bits(exact, RT_HIT_DEPTH, as_uint(hit->uv.z));
    sums->hits++;
    sums->hit_weight += weight < 0.0f ? -1 : 1;
    return true;
}

KERNEL ENTRY(first_hit)(const rt_params params, global const rt_scene_header *header,
                        global rt_first_hits *film)
{
    const uint item = item_number();
    if (item >= params.item_count)
        return;
    const struct scene scene = scene_open(header);
    const uint2 at = pixel_of_item(&params, params.first_item + item);
    const uint index = at.y * params.width + at.x;
    rt_first_hits sums = film[index];

    for (uint i = 0; i < params.sample_count; i++) {
        const uint number = params.first_sample + i;
        const struct sampler sampler = sampler_start(&scene, &params, index, number);
        float weight;
        const struct ray ray = pixel_ray(&scene, &params, &sampler, at, &weight);
        struct hit hit;
        COUNT(&scene, RT_COUNTER_CAMERA, ray.direction.x);
        if (can_follow(&ray) && closest_hit(&scene, &ray, &hit)) {
            const struct first_hit first = first_hit_at(&scene, &ray, &hit);
            if (!add_hit(&sums, &first, weight))
                continue;
            first_hits_keep(&sums, 1 + (rt_i64)number * RT_REPLICATES + params.replicate,
                            first.shape, first.material);
        }
        sums.count++;
        sums.weight += weight < 0.0f ? -1 : 1;
    }
    film[index] = sums;
}
