/*
 * light.h - the lights: choosing one, sampling it from a point, its density, what it emits.
 *
 * A rectangle is sampled by the solid angle it fills, a sphere by its visible cap, a triangle or
 * a skewed parallelogram by area. Below RT_SMALL_SOLID_ANGLE, where float32 no longer resolves the
 * difference of angles, a rectangle is sampled by area as well: seen so small, both densities are
 * nearly the same, and each is used with its own pdf, so the mean has no seam.
 *
 * light_pdf_w is the density with which light_sample makes a direction, the choice of the
 * light included: what multiple importance sampling needs when a ray meets the light.
 */
#ifndef RT_LIGHT_H
#define RT_LIGHT_H

#include "frame.h"
#include "sample.h"
#include "scene.h"
#include "surface.h"
#include "types.h"

#define RT_SMALL_SOLID_ANGLE 1e-2f /* sr; there the rounding of the solid angle is below 1e-4 of it */
#define RT_NEAR_SPHERE 1.001f      /* distance / radius under which a sphere is sampled by area */

/* A point on a light, chosen from a point in the scene. */
struct light_sample {
    struct surface at; /* position, normal and error only */
    float3 wi;         /* unit, towards the light */
    float3 radiance;   /* that arrives if nothing is in between; point light: intensity / distance^2 */
    float pdf_w;       /* of the direction, choice of the light included; point light: of the choice */
    bool delta;        /* no ray can meet it by chance: multiple importance sampling must leave it alone */
};

/* The start of a light path. */
struct emission {
    struct surface at; /* position, normal and error only */
    float3 direction;  /* unit */
    float3 flux;       /* W; the mean over all choices is the power of all lights */
    uint light;
};

/* ---- Choice and geometry --------------------------------------------------- */

/* The light at u of the cumulative distribution: chosen in proportion to its power. */
static inline uint choose_light(const struct scene *scene, float u)
{
    uint low = 0u, high = scene->header->light_count - 1u;
    while (low < high) {
        const uint middle = (low + high) >> 1;
        if (u < scene->lights[middle].cdf)
            high = middle;
        else
            low = middle + 1u;
    }
    return low;
}

/* The light that a surface is part of, or RT_NONE. */
static inline uint surface_light(const struct scene *scene, const struct surface *surface)
{
    global const rt_shape *shape = scene->shapes + surface->shape;
    return shape->first_light == RT_NONE ? RT_NONE : shape->first_light + (surface->prim - shape->first_prim);
}

/* The point a + x b + y c of a quad or triangle; its error bound covers a, the edges and the sum. */
static inline void flat_point(struct surface *at, global const rt_light_data *light, float2 where)
{
    const float3 a = row3(light->a), b = row3(light->b), c = row3(light->c);
    at->position = a + (where.x * b + where.y * c);
    at->normal = unit(cross(b, c));
    at->error = gamma_bound(8.0f) * dot(fabs(a) + fabs(b) + fabs(c), (float3)(1.0f));
}

static inline void sphere_point(struct surface *at, global const rt_light_data *light, float3 normal)
{
    const float3 a = row3(light->a);
    at->normal = normal;
    at->position = a + light->size * normal;
    at->error = gamma_bound(8.0f) * (dot(fabs(a), (float3)(1.0f)) + light->size);
}

/* A point of the light, uniform in area. */
static inline void sample_area(struct surface *at, global const rt_light_data *light, float2 u)
{
    if (light->kind == RT_LIGHT_SPHERE)
        sphere_point(at, light, sample_sphere(u));
    else
        flat_point(at, light, light->kind == RT_LIGHT_TRIANGLE ? sample_triangle(u) : u);
}

/* Density in solid angle of sampling by area, seen along `towards` (not of unit length). */
static inline float area_pdf_w(global const rt_light_data *light, float3 towards, float3 normal)
{
    const float d2 = dot(towards, towards);
    return d2 * sqrt(d2) / (fabs(dot(towards, normal)) * light->area);
}

/* Whether the light is a rectangle, and if so, how it is seen from a point. */
static inline bool see_rectangular_light(global const rt_light_data *light, float3 from, struct seen_rectangle *seen,
                                         float2 *size)
{
    const float3 b = row3(light->b), c = row3(light->c);
    *size = sqrt((float2)(dot(b, b), dot(c, c)));
    if (light->kind != RT_LIGHT_QUAD || fabs(dot(b, c)) > 1e-5f * size->x * size->y)
        return false;
    const float2 rate = 1.0f / *size;
    *seen = see_rectangle(row3(light->a) - from, b * rate.x, c * rate.y, *size);
    return seen->solid_angle >= RT_SMALL_SOLID_ANGLE;
}

/* Whether the sphere is far enough to be sampled by its visible cap; *d2 is the squared distance of its centre. */
static inline bool see_cap(global const rt_light_data *light, float3 from, float *d2)
{
    const float3 towards = row3(light->a) - from;
    *d2 = dot(towards, towards);
    return light->kind == RT_LIGHT_SPHERE && *d2 > square(RT_NEAR_SPHERE * light->size);
}

/* ---- Seen from a point ----------------------------------------------------- */

/* What the light emits at a point with this normal in direction w. */
static inline float3 light_radiance(global const rt_light_data *light, float3 normal, float3 w)
{
    const bool lit = (light->flags & RT_MATERIAL_TWO_SIDED) || dot(normal, w) > 0.0f;
    return lit ? row3(light->emission) : (float3)(0.0f);
}

/* The density of light_sample, from this point, for a direction in which the light's point `at` is met. */
static inline float light_pdf_w(global const rt_light_data *light, float3 from, const struct surface *at)
{
    struct seen_rectangle seen;
    float2 size;
    float d2;
    if (see_rectangular_light(light, from, &seen, &size))
        return light->pmf * seen_rectangle_pdf_w(&seen);
    if (see_cap(light, from, &d2))
        return light->pmf * cap_pdf_w(light->size, d2);
    return light->pmf * area_pdf_w(light, at->position - from, at->normal);
}

/* Samples a point of an area light; returns its density in solid angle, without the choice. */
static inline float sample_area_light(struct surface *at, global const rt_light_data *light, float3 from, float2 u)
{
    struct seen_rectangle seen;
    float2 size;
    float d2;
    if (see_rectangular_light(light, from, &seen, &size)) {
        flat_point(at, light, sample_seen_rectangle(&seen, u) / size);
        return seen_rectangle_pdf_w(&seen);
    }
    if (see_cap(light, from, &d2)) {
        const struct frame frame = frame_about(unit(from - row3(light->a)));
        sphere_point(at, light, frame_to_world(frame, sample_cap(light->size, d2, u)));
        return cap_pdf_w(light->size, d2);
    }
    sample_area(at, light, u);
    return area_pdf_w(light, at->position - from, at->normal);
}

/*
 * Samples the lights from a point: u.xy the point on the light, u.z the choice. False when there is
 * nothing to arrive.
 */
static inline bool sample_light(const struct scene *scene, float3 from, float4 u, struct light_sample *sample)
{
    if (scene->header->light_count == 0u)
        return false;
    global const rt_light_data *light = scene->lights + choose_light(scene, u.z);
    sample->delta = light->kind == RT_LIGHT_POINT;
    if (sample->delta) {
        sample->at.position = row3(light->a);
        sample->at.error = 0.0f;
        sample->pdf_w = light->pmf;
    } else {
        sample->pdf_w = light->pmf * sample_area_light(&sample->at, light, from, u.xy);
    }
    const float3 towards = sample->at.position - from;
    const float d2 = dot(towards, towards);
    sample->wi = towards * (1.0f / sqrt(d2));
    if (sample->delta) {
        sample->at.normal = -sample->wi;
        sample->radiance = row3(light->emission) / d2;
    } else {
        sample->radiance = light_radiance(light, sample->at.normal, -sample->wi);
    }
    return largest3(sample->radiance) > 0.0f;
}

/* The ray from a surface to a sampled point of a light, ending just before it. */
static inline struct ray shadow_ray(const struct surface *from, const struct light_sample *sample)
{
    const float3 origin = leave_surface(from, sample->wi);
    return make_ray(origin, leave_surface(&sample->at, -sample->wi) - origin, 0.0f, 0.9999f);
}

/* ---- Light paths ------------------------------------------------------------- */

/*
 * Starts a light path: light in proportion to power (start.z), point uniform in area (start.xy),
 * direction by the cosine, or over the sphere for a point light (way.xy); way.z chooses the side of
 * a two-sided light. False when there is no light.
 */
static inline bool light_emit(const struct scene *scene, float4 start, float4 way, struct emission *emission)
{
    if (scene->header->light_count == 0u)
        return false;
    emission->light = choose_light(scene, start.z);
    global const rt_light_data *light = scene->lights + emission->light;
    if (light->kind == RT_LIGHT_POINT) {
        emission->direction = sample_sphere(way.xy);
        emission->at.position = row3(light->a);
        emission->at.normal = emission->direction;
        emission->at.error = 0.0f;
        emission->flux = 4.0f * RT_PI / light->pmf * row3(light->emission);
        return true;
    }
    const bool two_sided = light->flags & RT_MATERIAL_TWO_SIDED;
    sample_area(&emission->at, light, start.xy);
    const float3 normal = two_sided && way.z < 0.5f ? -emission->at.normal : emission->at.normal;
    emission->direction = frame_to_world(frame_about(normal), sample_cosine(way.xy));
    emission->flux = (two_sided ? 2.0f : 1.0f) * RT_PI * light->area / light->pmf * row3(light->emission);
    return true;
}

#endif
