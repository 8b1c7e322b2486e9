/*
 * area.h - area lights: sampling points on them, and the pdf of the samples.
 *
 * A rectangle is sampled by the solid angle it fills (shape/quad.h), a sphere by its visible cap
 * (shape/sphere.h), a triangle or a skewed parallelogram by area, any other shape by its parameters
 * (shape_point).
 */
#ifndef RT_KERNELS_LIGHT_AREA_H
#define RT_KERNELS_LIGHT_AREA_H

#include "math/frame.h"
#include "math/lanes.h"
#include "sample/sample.h"
#include "scene.h"
#include "shape/shapes.h"
#include "accel/cutout.h"
#include "material/texture.h"
#include "types.h"
#include "math/width1.inc.h"
#include "light/area.inc.h"

/* ---- Points by area --------------------------------------------------------- */

/* A point of a quad, triangle or sphere, uniform in area. */
static inline void sample_area(struct surface *at, global const rt_light_data *light, float2 u)
{
    if (light->kind == RT_LIGHT_SPHERE) {
        sphere_point(at, light, sample_sphere(u));
    } else {
        const float2 where = light->kind == RT_LIGHT_TRIANGLE ? sample_triangle(u) : u;
        flat_point(at, light, where * (float2)(light->width, light->height));
    }
}

/* ---- Seen from a point ------------------------------------------------------ */

/* Samples a point of a quad, triangle or sphere; returns 1 / pdf_w, without the choice. */
static inline float sample_area_light(struct surface *at, global const rt_light_data *light,
                                      float3 from, float2 u)
{
    struct seen_rectangle seen;
    float d2;
    if (see_rectangular_light(light, from, &seen)) {
        flat_point(at, light, sample_seen_rectangle(&seen, u));
        return seen.solid_angle;
    }
    if (see_spherical_light(light, from, &d2)) {
        const struct frame frame = frame_about(unit(from - row3(light->a)));
        sphere_point(at, light, frame_to_world(frame, sample_cap(light->width, d2, u)));
        return 1.0f / cap_pdf_w(light->width, d2);
    }
    sample_area(at, light, u);
    return area_inv_pdf(light->area, at->position - from, at->normal);
}

/* ---- What it emits ---------------------------------------------------------- */

/* The place of a point on it, whose u and v are set. */
static inline struct texture_place
light_place(const struct scene *scene, global const rt_light_data *light, const struct surface *at)
{
    return texture_place_at(scene->shapes + scene->prim_shape[light->prim], at);
}

/* The colour of the light's texture: by a copy, so that no surface has to be in memory. */
INLINE_NEVER float3 light_texture(const struct scene *scene, global const rt_light_data *light,
                                  struct texture_place place)
{
    return texture_value(scene, scene->textures + light->texture, &place);
}

/* Radiance emitted in direction w at *at, whose u and v are set. */
static inline float3 light_radiance(const struct scene *scene, global const rt_light_data *light,
                                    const struct surface *at, float3 w)
{
    const bool lit = (light->flags & RT_LIGHT_TWO_SIDED) || dot(at->normal, w) > 0.0f;
    if (!lit)
        return (float3)(0.0f);
    const float3 emission = row3(light->emission);
    return light->texture == RT_NONE
               ? emission
               : emission * light_texture(scene, light, light_place(scene, light, at));
}

/* Sets the u and v of a sampled point of a quad, triangle or sphere. */
static inline void locate_on_light(const struct scene *scene, global const rt_light_data *light,
                                   struct surface *at)
{
    if (light->kind == RT_LIGHT_SPHERE) {
        const float2 uv =
            sphere_uv(scene, scene->shapes + scene->prim_shape[light->prim], at->normal);
        at->u = uv.x;
        at->v = uv.y;
        at->weights = (float2)(0.0f);
        at->triangle = 0u;
    } else {
        locate_flat_point(scene, light, at);
    }
}

/* Whether its radiance is another at each point that is sampled. */
static inline bool light_is_varied(global const rt_light_data *light)
{
    return light->texture != RT_NONE || (light->flags & RT_LIGHT_CUTOUT);
}

/* The opacity of a cutout at a point whose u and v are set. */
static inline float light_opacity(const struct scene *scene, global const rt_light_data *light,
                                  const struct surface *at)
{
    const struct texture_place place = light_place(scene, light, at);
    return opacity_at(scene, &place);
}

/*
 * What multiplies the radiance of a sampled point whose u and v are set: the texture; and the
 * opacity, as rays see all that a cutout emits where they meet it.
 */
INLINE_NEVER float3 light_pattern(const struct scene *scene, global const rt_light_data *light,
                                  const struct surface *at)
{
    float3 pattern = (float3)(1.0f);
    if (light->texture != RT_NONE)
        pattern = light_texture(scene, light, light_place(scene, light, at));
    if (light->flags & RT_LIGHT_CUTOUT)
        pattern *= light_opacity(scene, light, at);
    return pattern;
}

#endif
