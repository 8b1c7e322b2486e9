/*
 * medium.h - which solids a path is inside of, and what happens at their boundaries (nested
 * dielectrics).
 *
 * A path carries up to four materials, that of highest priority first, and among equals the one
 * entered last; the first is the medium the path runs in. A boundary of lower priority than the
 * current medium is ignored: the path goes straight through and only the list changes (Schmidt and
 * Budge, "Simple Nested Dielectrics in Ray Traced Images", JGT 7(2), 2002). When a fifth solid is
 * entered, the last of the list is forgotten. A path that leaves a solid missing from its list must
 * have started inside it, or forgotten it: it is treated as having been inside.
 */
#ifndef RT_KERNELS_MATERIAL_MEDIUM_H
#define RT_KERNELS_MATERIAL_MEDIUM_H

#include "math/frame.h"
#include "math/ray.h"
#include "scene.h"
#include "shape/surface.h"
#include "types.h"

#define RT_VACUUM ((uint4)(RT_NONE)) /* the list of a path outside of all solids */
#define RT_HIDDEN_BOUNDARIES 64u     /* boundaries without effect that a path may cross */

/*
 * A boundary, as a path meets it. Behind an opaque surface nothing changes, and the index counts as
 * 1.
 */
struct boundary {
    uint4 beyond; /* the media list on its other side */
    float eta;    /* index on this side / index on the other */
    bool fresnel; /* dielectric, as one of the two media says; ks + kt is split Fr : 1 - Fr */
    /* false: both sides are the same medium, because another one or more of the same hides it */
    bool exists;
};

/* Whether it has one of these flags. A program for plain scenes knows at compile time which not. */
static inline bool has_flag(global const rt_material_data *material, uint flags)
{
#ifdef RT_PLAIN
    flags &= ~RT_MATERIAL_NOT_PLAIN;
#endif
    return (material->flags & flags) != 0u;
}

/* Whether it is a thin sheet: light that enters it leaves it on the other side as it came. */
static inline bool is_thin(global const rt_material_data *material)
{
    return has_flag(material, RT_MATERIAL_THIN);
}

/* Whether such a sheet is the boundary of a medium. */
static inline bool is_filled(global const rt_material_data *material)
{
    return has_flag(material, RT_MATERIAL_FILLED);
}

/* Whether it scatters light evenly to the other side, too, where the same medium lies. */
static inline bool is_translucent(global const rt_material_data *material)
{
    return has_flag(material, RT_MATERIAL_TRANSLUCENT);
}

/* Those inputs of a principled material that have places of their own, at a point. */
#define PRINCIPLED_NUMBER(TYPE, name, RANGE, NEED, unit, help) float name;
struct principled_numbers {
    RT_PRINCIPLED_NUMBERS(PRINCIPLED_NUMBER)
};

/* Whether it is principled: bsdf/principled_solid.h. */
static inline bool is_principled(global const rt_material_data *material)
{
    return has_flag(material, RT_MATERIAL_PRINCIPLED);
}

/* Whether its facets have a direction, along which they are rougher or smoother than across it. */
static inline bool is_anisotropic(global const rt_material_data *material)
{
    return has_flag(material, RT_MATERIAL_ANISOTROPIC);
}

/*
 * Whether the material's surface is the boundary of a solid, one that light can enter. A thin sheet
 * is none, for the same medium lies before and behind it, unless it is filled with one.
 */
static inline bool is_transparent(global const rt_material_data *material)
{
    const float3 kt = row3(material->kt), ks = row3(material->ks);
    return (material->flags & (RT_MATERIAL_THIN | RT_MATERIAL_FILLED)) != RT_MATERIAL_THIN &&
           (kt.x + kt.y + kt.z > 0.0f ||
            (has_flag(material, RT_MATERIAL_FRESNEL) && ks.x + ks.y + ks.z > 0.0f));
}

/* The list with one more material: before all that do not have a higher priority. */
static inline uint4 media_enter(const struct scene *scene, uint4 media, uint material)
{
    const uint priority = scene->materials[material].priority;
    if (media.x == RT_NONE || scene->materials[media.x].priority <= priority)
        return (uint4)(material, media.xyz);
    if (media.y == RT_NONE || scene->materials[media.y].priority <= priority)
        return (uint4)(media.x, material, media.yz);
    if (media.z == RT_NONE || scene->materials[media.z].priority <= priority)
        return (uint4)(media.xy, material, media.z);
    if (media.w == RT_NONE || scene->materials[media.w].priority <= priority)
        return (uint4)(media.xyz, material);
    return media;
}

/* The list without the first entry of the material. */
static inline uint4 media_leave(uint4 media, uint material)
{
    if (media.x == material)
        return (uint4)(media.yzw, RT_NONE);
    if (media.y == material)
        return (uint4)(media.x, media.zw, RT_NONE);
    if (media.z == material)
        return (uint4)(media.xy, media.w, RT_NONE);
    if (media.w == material)
        return (uint4)(media.xyz, RT_NONE);
    return media;
}

static inline float media_ior(const struct scene *scene, uint4 media)
{
    return media.x == RT_NONE ? 1.0f : scene->materials[media.x].ior;
}

/*
 * The transmittance of a medium over a distance in metres, which may be infinite: the Beer-Lambert
 * law.
 */
static inline float3 medium_transmittance(global const rt_material_data *materials, uint medium,
                                          float distance)
{
    if (medium == RT_NONE)
        return (float3)(1.0f);
    const float3 absorption = row3(materials[medium].absorption);
    return largest3(absorption) > 0.0f ? exp(-absorption * fmin(distance, FLT_MAX))
                                       : (float3)(1.0f);
}

static inline bool media_fresnel(const struct scene *scene, uint4 media)
{
    const uint kinds = RT_MATERIAL_FRESNEL | RT_MATERIAL_THIN;
    return media.x != RT_NONE && (scene->materials[media.x].flags & kinds) == RT_MATERIAL_FRESNEL;
}

static inline bool has_relative_ior(const struct scene *scene, uint material)
{
    return (scene->materials[material].flags & RT_MATERIAL_RELATIVE) != 0u;
}

/*
 * The boundary of this material between two media lists, met from outside (entering) or from
 * inside. Fresnel's equations are those of both media: air without them, as a bubble in water that
 * has them, reflects as the water does.
 */
static inline struct boundary media_boundary(const struct scene *scene, uint material, uint4 media,
                                             uint4 beyond, bool entering)
{
    const float ior = scene->materials[material].ior;
    struct boundary boundary;
    boundary.beyond = beyond;
    boundary.fresnel = media_fresnel(scene, media) || media_fresnel(scene, beyond);
    boundary.eta = has_relative_ior(scene, material)
                       ? (entering ? 1.0f / ior : ior)
                       : media_ior(scene, media) / media_ior(scene, beyond);
    boundary.exists = beyond.x != media.x;
    return boundary;
}

/* The same where only the lists are known. */
static inline struct boundary media_between(const struct scene *scene, uint material, uint4 media,
                                            uint4 beyond)
{
    return media_boundary(scene, material, media, beyond, beyond.x == material);
}

/*
 * Crosses the boundary of a solid of this material, from outside (entering) or from inside. One of
 * a relative index is there whatever lies on both sides, but for what has a higher priority: also
 * where solids overlap, and around meshes that only others close.
 */
static inline struct boundary media_cross(const struct scene *scene, uint4 media, uint material,
                                          bool entering)
{
    if (!entering && !any(media == material))
        media = media_enter(scene, media, material);
    const uint4 beyond =
        entering ? media_enter(scene, media, material) : media_leave(media, material);
    struct boundary boundary = media_boundary(scene, material, media, beyond, entering);
    if (has_relative_ior(scene, material))
        boundary.exists = scene->materials[entering ? beyond.x : media.x].priority <=
                          scene->materials[material].priority;
    return boundary;
}

/* The boundary that a path meets at a surface of this material. */
static inline struct boundary media_meet(const struct scene *scene, uint4 media, uint material,
                                         bool entering)
{
    if (is_transparent(scene->materials + material))
        return media_cross(scene, media, material, entering);
    struct boundary boundary;
    boundary.beyond = media;
    boundary.eta = has_relative_ior(scene, material) ? 1.0f : media_ior(scene, media);
    boundary.fresnel = false;
    boundary.exists = true;
    return boundary;
}

/*
 * Continues straight through a boundary that does not exist; false when the path has crossed too
 * many of them, which `hidden` counts.
 */
static inline bool pass_boundary(struct ray *ray, uint4 *media, uint *hidden,
                                 const struct surface *surface, uint4 beyond)
{
    ray->origin = leave_surface(surface, ray->direction);
    *media = beyond;
    return ++*hidden <= RT_HIDDEN_BOUNDARIES;
}

#endif
