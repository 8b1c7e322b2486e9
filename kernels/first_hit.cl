/*
 * first_hit.cl - the layers of the first hit, such as albedo, normal and depth; layers_of has each
 * of them. Each work-item takes the samples of one pixel, the same samples as the other modes.
 */
#include "bsdf/bsdf.h"
#include "camera/camera.h"
#include "entry.h"
#include "camera/film.h"
#include "accel/traverse.h"
#include "material/contact.h"

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

/* What a sample of this filter weight, which hit a surface, adds to each layer. */
static void layers_of(float3 *value, const struct scene *scene, const struct ray *ray,
                      const struct hit *hit, float weight)
{
    struct surface surface = surface_at(scene, ray, hit);
    const float3 wo = -ray->direction;
    /* Of faces that coincide, the one that light meets; the albedo is that in air. */
    struct boundary boundary =
        meet_boundary(scene, vload4(0, scene->header->eye_media) - 1u, &surface, wo);
    boundary.eta = 1.0f;
    global const rt_shape *shape = scene->shapes + surface.shape;
    const struct bsdf bsdf =
        bsdf_at(scene, scene->materials + shape->material, &surface, wo, &boundary, (float3)(1.0f));
    /* bsdf.shading is on the side of wo; the layer has it on the side of the shape's normal. */
    const float side = dot(wo, surface.normal) < 0.0f ? -1.0f : 1.0f;
    const float depth = depth_of(&scene->header->camera, surface.position);

    value[RT_LAYER_ALBEDO] = bsdf_albedo(&bsdf);
    value[RT_LAYER_NORMAL] = side * bsdf.shading;
    value[RT_LAYER_DEPTH] = (float3)(depth, 1.0f, weight);
    value[RT_LAYER_POSITION] = surface.position;
    surface_uv(&surface, scene);
    value[RT_LAYER_UV] = (float3)(surface.u, surface.v, 0.0f);
    value[RT_LAYER_IDS] = (float3)((float)surface.shape, (float)shape->material, 1.0f);
}

/* Keeps the ids of a sample unless those of one with a lower number are there already. */
static void keep_ids(rt_film_pixel *ids, float3 value, rt_i64 number)
{
    ids->count++;
    if (value.z == 0.0f || (ids->high[2] != 0 && ids->high[2] <= number))
        return;
    ids->high[0] = (rt_i64)value.x;
    ids->high[1] = (rt_i64)value.y;
    ids->high[2] = 1 + number;
}

/* layers: RT_LAYER_COUNT films one after the other; see RT_LAYER_ALBEDO for what they sum. */
KERNEL first_hit(const rt_params params, global const rt_scene_header *header,
                 global rt_film_pixel *layers)
{
    const uint item = (uint)get_global_id(0);
    if (item >= params.item_count)
        return;
    const struct scene scene = scene_open(header);
    const uint2 at = pixel_of_item(&params, params.first_item + item);
    const uint index = at.y * params.width + at.x;
    const size_t film_size = (size_t)params.width * params.height;

    rt_film_pixel sums[RT_LAYER_COUNT];
    for (uint layer = 0; layer < RT_LAYER_COUNT; layer++)
        sums[layer] = layers[layer * film_size + index];

    for (uint i = 0; i < params.sample_count; i++) {
        const struct sampler sampler =
            sampler_start(&scene, &params, index, params.first_sample + i);
        float3 value[RT_LAYER_COUNT];
        float weight;
        const struct ray ray = pixel_ray(&header->camera, &params, &sampler, at, &weight);
        struct hit hit;
        for (uint layer = 0; layer < RT_LAYER_COUNT; layer++)
            value[layer] = (float3)(0.0f);
        if (can_follow(&ray) && closest_hit(&scene, &ray, &hit))
            layers_of(value, &scene, &ray, &hit, weight);
        for (uint layer = 0; layer < RT_LAYER_IDS; layer++)
            film_add(&sums[layer], value[layer], layer < RT_LAYER_WEIGHTED ? weight : 1.0f, 0.0f);
        keep_ids(&sums[RT_LAYER_IDS], value[RT_LAYER_IDS],
                 (rt_i64)(params.first_sample + i) * RT_REPLICATES + params.replicate);
    }
    for (uint layer = 0; layer < RT_LAYER_COUNT; layer++)
        layers[layer * film_size + index] = sums[layer];
}
