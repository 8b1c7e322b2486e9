/*
 * area.h - lights that are surfaces: points on them, and the density with which those are made.
 *
 * A rectangle is sampled by the solid angle it fills, a sphere by its visible cap, a triangle or a
 * skewed parallelogram by area, any other shape by its parameters. Below RT_SMALL_SOLID_ANGLE,
 * where float32 no longer resolves the difference of angles, a rectangle is sampled by area as
 * well: seen so small, both densities are nearly the same, and each is used with its own pdf, so
 * the mean has no seam.
 */
#ifndef RT_KERNELS_LIGHT_AREA_H
#define RT_KERNELS_LIGHT_AREA_H

#include "shape/canonical.h"
#include "math/frame.h"
#include "math/lanes.h"
#include "shape/mesh.h"
#include "shape/placement.h"
#include "sample/sample.h"
#include "scene.h"
#include "shape/shape_sample.h"
#include "shape/surface.h"
#include "material/texture.h"
#include "types.h"

#define RT_FAR_RECTANGLE 1.5f /* distance / diagonal beyond which a rectangle is sampled by area */
#define RT_SMALL_SOLID_ANGLE                                                                       \
    1e-2f                     /* sr; there the rounding of the solid angle is below 1e-4 of it */
#define RT_NEAR_SPHERE 1.001f /* distance / radius under which a sphere is sampled by area */

/* ---- Points by area --------------------------------------------------------- */

/*
 * The point of a quad or triangle at these lengths along its edges; its error bound covers a, the
 * edges and the sum.
 */
static inline void flat_point(struct surface *at, global const rt_light_data *light, float2 lengths)
{
    const float3 a = row3(light->a);
    at->position = a + (lengths.x * row3(light->b) + lengths.y * row3(light->c));
    at->normal = row3(light->normal);
    at->error = gamma_bound(8.0f) *
                (fabs(a.x) + fabs(a.y) + fabs(a.z) + 2.0f * (light->width + light->height));
}

static inline void sphere_point(struct surface *at, global const rt_light_data *light,
                                float3 normal)
{
    const float3 a = row3(light->a);
    at->position = a + light->width * normal;
    at->normal = normal;
    at->error = gamma_bound(8.0f) * (fabs(a.x) + fabs(a.y) + fabs(a.z) + light->width);
}

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

/*
 * 1 / pdf_w of sampling an area evenly, seen along `towards` (not of unit length): its solid angle,
 * were it all there.
 */
static inline float area_spread(float area, float3 towards, float3 normal)
{
    const float d2 = dot(towards, towards);
    return fabs(dot(towards, normal)) * area / (d2 * sqrt(d2));
}

/* ---- Seen from a point ------------------------------------------------------ */

/*
 * How a rectangular light is seen from a point; false when it is none, or is better sampled by
 * area.
 */
static inline bool see_rectangular_light(global const rt_light_data *light, float3 from,
                                         struct seen_rectangle *seen)
{
    if (!(light->flags & RT_LIGHT_RECTANGLE))
        return false;
    const float3 corner = row3(light->a) - from;
    const float x = dot(corner, row3(light->b)), y = dot(corner, row3(light->c)),
                z = dot(corner, row3(light->normal));
    const float distance2 =
        square(x + 0.5f * light->width) + square(y + 0.5f * light->height) + z * z;
    if (distance2 > square(RT_FAR_RECTANGLE) * (square(light->width) + square(light->height)))
        return false;
    *seen = see_rectangle(x, y, fabs(z), light->width, light->height);
    return seen->solid_angle >= RT_SMALL_SOLID_ANGLE;
}

/*
 * Whether the light is a sphere far enough to be sampled by its visible cap; *d2 is its centre's
 * squared distance.
 */
static inline bool see_spherical_light(global const rt_light_data *light, float3 from, float *d2)
{
    if (light->kind != RT_LIGHT_SPHERE)
        return false;
    const float3 towards = row3(light->a) - from;
    *d2 = dot(towards, towards);
    return *d2 > square(RT_NEAR_SPHERE * light->width);
}

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
    return area_spread(light->area, at->position - from, at->normal);
}

/* ---- What it emits ---------------------------------------------------------- */

/* The colour of the light's texture at the surface's u and v. */
INLINE_NEVER float3 light_texture(const struct scene *scene, global const rt_light_data *light,
                                  const struct surface *at)
{
    return texture_value(scene->textures + light->texture, scene->texels, at->u, at->v);
}

/* What the light emits in direction w at a point of which u and v are known. */
static inline float3 light_radiance(const struct scene *scene, global const rt_light_data *light,
                                    const struct surface *at, float3 w)
{
    const bool lit = (light->flags & RT_LIGHT_TWO_SIDED) || dot(at->normal, w) > 0.0f;
    if (!lit)
        return (float3)(0.0f);
    const float3 emission = row3(light->emission);
    return light->texture == RT_NONE ? emission : emission * light_texture(scene, light, at);
}

/* Sets the u and v of a sampled point of a quad, triangle or sphere. */
static inline void locate_on_light(const struct scene *scene, global const rt_light_data *light,
                                   struct surface *at)
{
    global const rt_shape *shape = scene->shapes + scene->prim_shape[light->prim];
    if (light->kind == RT_LIGHT_SPHERE) {
        const bool turned = shape->transform != RT_NONE;
        const float2 uv = sphere_parameters(
            turned ? unit(map_vector(scene->transforms[shape->transform].to_object, at->normal))
                   : at->normal);
        at->u = uv.x;
        at->v = uv.y;
        return;
    }
    /* Lengths along edges that need not be at right angles. */
    const float3 away = at->position - row3(light->a);
    const float b = dot(away, row3(light->b)), c = dot(away, row3(light->c)),
                bc = dot(row3(light->b), row3(light->c));
    at->weights =
        (float2)((b - bc * c) / light->width, (c - bc * b) / light->height) / (1.0f - bc * bc);
    at->triangle = light->prim - shape->first_prim;
    mesh_parameters(at, scene, shape);
}

#endif
