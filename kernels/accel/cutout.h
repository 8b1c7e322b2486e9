/*
 * cutout.h - surfaces that are not there for some rays: the opacity of a material.
 *
 * A ray meets a surface of opacity a with probability a, and passes it otherwise as if nothing were
 * there: paths, shadow rays, photons and connections alike, whose means are then those of a surface
 * that lets 1 - a of all light through. The decision comes from a hash of the ray and of the
 * primitive, so that the same ray always has the same hits, whatever asks for them. Where the
 * opacity is 0 or 1, or a cutoff makes it so, nothing is random.
 *
 * Reference:
 *   Pharr, Jakob, Humphreys: "Physically Based Rendering", 4th ed., section 7.1.1 (the alpha test).
 */
#ifndef RT_KERNELS_ACCEL_CUTOUT_H
#define RT_KERNELS_ACCEL_CUTOUT_H

#include "material/texture.h"
#include "math/lanes.h"
#include "math/ray.h"
#include "sample/rng.h"
#include "scene.h"
#include "shape/triangle.h"
#include "types.h"

/* Whether any shape has an opacity below 1. */
static inline bool has_cutouts(const struct scene *scene)
{
#ifdef RT_PLAIN
    return false;
#else
    return scene->header->has_cutouts != 0u;
#endif
}

/* The opacity at a place of a shape with RT_SHAPE_CUTOUT, from 0 to 1. */
static inline float opacity_at(const struct scene *scene, const struct texture_place *place)
{
    global const rt_material_data *material = scene->materials + place->shape->material;
    float opacity = material->opacity;
    if (material->opacity_texture != RT_NONE)
        opacity *= mean3(texture_value(scene, scene->textures + material->opacity_texture, place));
    if (material->opacity_cutoff > 0.0f)
        return opacity >= material->opacity_cutoff ? 1.0f : 0.0f;
    return opacity;
}

/*
 * Whether a ray passes such a shape where it would meet it; layer: a number that tells its hits on
 * the scene apart.
 */
static inline bool passes_at(const struct scene *scene, const struct texture_place *place,
                             const struct ray *ray, uint layer)
{
    const float opacity = opacity_at(scene, place);
    if (opacity >= 1.0f)
        return false;
    const uint4 origin = (uint4)(as_uint3(ray->origin), layer);
    const uint4 all = pcg4d(pcg4d(origin) ^ (uint4)(as_uint3(ray->direction), 0u));
    return (float)(all.x >> 8) * 0x1p-24f >= opacity;
}

/* The opacity of a surface whose u and v are set, if its shape is a cutout; else 1. */
static inline float surface_opacity(const struct scene *scene, const struct surface *surface)
{
    global const rt_shape *shape = scene->shapes + surface->shape;
    if (!UNLIKELY(shape->flags & RT_SHAPE_CUTOUT))
        return 1.0f;
    const struct texture_place place = texture_place_at(shape, surface);
    return opacity_at(scene, &place);
}

/*
 * Whether a ray passes a lane of a block, which is marked with RT_BLOCK_CUTOUT, where it would meet
 * it at the weights u and v; placed: the primitive of the instance that the block is of, or
 * RT_NONE.
 */
RARELY_CALLED bool passes_lane(global const rt_scene_header *header, const struct ray *ray,
                               uint slot, uint placed, float u, float v)
{
    const struct scene scene = scene_open(header);
    const uint own = scene.blocks[slot >> 3].prim[slot & 7u] & RT_BLOCK_PRIM;
    const uint index = scene.prim_shape[placed == RT_NONE ? own : placed];
    global const rt_shape *shape = scene.shapes + index;
    if (!(shape->flags & RT_SHAPE_CUTOUT))
        return false;
    struct texture_place place;
    place.weights = (float2)(u, v);
    place.shape = shape;
    place.triangle = placed == RT_NONE ? own - shape->first_prim : own;
    place.uv = mesh_uv(&scene, shape, place.triangle, place.weights);
    return passes_at(&scene, &place, ray, slot);
}

#endif
