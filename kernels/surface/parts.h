/*
 * parts.h - materials made of others: a blend of two, and one whose back is another.
 *
 * At a vertex such a material is one of its parts, before anything else asks for it. The side of wo
 * decides between front and back; between the two parts of a blend, which has weight w at this
 * point, chance: the second is met with probability w. A path so has a label at each vertex, and
 * since a path of any technique gets a label with the same probability, MIS weights are those of
 * paths of these labels. The decision comes from a hash of the ray and the primitive, another than
 * that of cutouts (accel/cutout.h), so that whatever asks for the vertex again finds the same part.
 *
 * What arrives at a vertex does not depend on the label of the path that brings it: photons, and
 * light vertices for merging, are stored where any part on their side may scatter them.
 *
 * Reference:
 *   Pharr, Jakob, Humphreys: "Physically Based Rendering", 4th ed., section 10.5.1 (mix materials).
 */
#ifndef RT_KERNELS_SURFACE_PARTS_H
#define RT_KERNELS_SURFACE_PARTS_H

#include "material/texture.h"
#include "math/ray.h"
#include "sample/rng.h"
#include "scene.h"
#include "types.h"

/* Whether it is made of others. */
static inline bool has_parts(global const rt_material_data *material)
{
    return has_flag(material, RT_MATERIAL_PARTS);
}

/*
 * Which lobes other than delta lobes the parts have that light on a side meets: RT_PARTS_DIFFUSE,
 * RT_PARTS_ROUGH.
 */
static inline uint lobes_of_parts(global const rt_material_data *material, bool behind)
{
    return material->lobes_of_parts >> (behind ? RT_PARTS_BACK : 0u) &
           (RT_PARTS_DIFFUSE | RT_PARTS_ROUGH);
}

/* The part of the second of its two. */
static inline float blend_weight(const struct scene *scene, global const rt_material_data *material,
                                 const struct texture_place *place)
{
    if (material->weight_texture == RT_NONE)
        return material->weight;
    return material->weight *
           mean3(texture_value(scene, scene->textures + material->weight_texture, place));
}

/*
 * The part of a material that is met there, from behind or not; `chance`: the bits that it depends
 * on.
 */
RARELY_CALLED uint part_at(global const rt_scene_header *header, uint index, bool behind,
                           struct texture_place place, uint4 chance)
{
    const struct scene scene = scene_open(header);
    uint4 bits = chance;
    for (;;) {
        global const rt_material_data *material = scene.materials + index;
        if (behind && material->back != RT_NONE) {
            index = material->back;
            behind = false;
            continue;
        }
        if (material->blend[0] == RT_NONE)
            return index;
        bits = pcg4d(bits);
        const bool second =
            (float)(bits.x >> 8) * 0x1p-24f < blend_weight(&scene, material, &place);
        index = material->blend[second ? 1 : 0];
    }
}

/* The bits for a ray that meets this primitive. */
static inline uint4 chance_of_ray(const struct ray *ray, uint prim)
{
    const uint4 origin = (uint4)(as_uint3(ray->origin), prim);
    return pcg4d(origin) ^ (uint4)(as_uint3(ray->direction), 1u);
}

#endif
