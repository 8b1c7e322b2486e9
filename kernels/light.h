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

#define RT_FAR_RECTANGLE 1.5f      /* distance / diagonal beyond which a rectangle is sampled by area */
#define RT_SMALL_SOLID_ANGLE 1e-2f /* sr; there the rounding of the solid angle is below 1e-4 of it */
#define RT_NEAR_SPHERE 1.001f      /* distance / radius under which a sphere is sampled by area */

/* A point on a light, chosen from a point in the scene. */
struct light_sample {
    struct surface at; /* position and normal only */
    float lift;        /* along at.normal, takes the position off the light by its error, to the side of the viewer */
    float3 wi;         /* unit, towards the light */
    float3 radiance;   /* that arrives if nothing is in between; point light: intensity / distance^2 */
    float spread;      /* sr: 1 / pdf_w of the direction, choice of the light included; point light: of the choice */
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

/*
 * The light at u of the cumulative distribution: chosen in proportion to its power. A bisection of which only
 * the length, not the way, depends on branches: those would be mispredicted. The mask of all ones or none
 * keeps compilers from making a branch of it after all.
 */
static inline uint choose_light(const struct scene *scene, float u)
{
    uint first = 0u;
    for (uint count = scene->header->light_count; count > 1u;) {
        const uint half_count = count >> 1;
        first += half_count & (0u - (uint)(u >= scene->lights[first + half_count - 1u].cdf));
        count -= half_count;
    }
    return first;
}

/* The light that a surface is part of, or RT_NONE. */
static inline uint surface_light(const struct scene *scene, const struct surface *surface)
{
    global const rt_shape *shape = scene->shapes + surface->shape;
    return shape->first_light == RT_NONE ? RT_NONE : shape->first_light + (surface->prim - shape->first_prim);
}

/* The point of a quad or triangle at these lengths along its edges; its error bound covers a, the edges and the sum. */
static inline void flat_point(struct surface *at, global const rt_light_data *light, float2 lengths)
{
    const float3 a = row3(light->a);
    at->position = a + (lengths.x * row3(light->b) + lengths.y * row3(light->c));
    at->normal = row3(light->normal);
    at->error = gamma_bound(8.0f) * (fabs(a.x) + fabs(a.y) + fabs(a.z) + 2.0f * (light->width + light->height));
}

static inline void sphere_point(struct surface *at, global const rt_light_data *light, float3 normal)
{
    const float3 a = row3(light->a);
    at->position = a + light->width * normal;
    at->normal = normal;
    at->error = gamma_bound(8.0f) * (fabs(a.x) + fabs(a.y) + fabs(a.z) + light->width);
}

/* A point of the light, uniform in area. */
static inline void sample_area(struct surface *at, global const rt_light_data *light, float2 u)
{
    if (light->kind == RT_LIGHT_SPHERE) {
        sphere_point(at, light, sample_sphere(u));
    } else {
        const float2 where = light->kind == RT_LIGHT_TRIANGLE ? sample_triangle(u) : u;
        flat_point(at, light, where * (float2)(light->width, light->height));
    }
}

/* 1 / pdf_w of sampling by area, seen along `towards` (not of unit length): the whole area's solid angle, were it all there. */
static inline float area_spread(global const rt_light_data *light, float3 towards, float3 normal)
{
    const float d2 = dot(towards, towards);
    return fabs(dot(towards, normal)) * light->area / (d2 * sqrt(d2));
}

/* How a rectangular light is seen from a point; false when it is none, or is better sampled by area. */
static inline bool see_rectangular_light(global const rt_light_data *light, float3 from, struct seen_rectangle *seen)
{
    if (!(light->flags & RT_LIGHT_RECTANGLE))
        return false;
    const float3 corner = row3(light->a) - from;
    const float x = dot(corner, row3(light->b)), y = dot(corner, row3(light->c)), z = dot(corner, row3(light->normal));
    const float distance2 = square(x + 0.5f * light->width) + square(y + 0.5f * light->height) + z * z;
    if (distance2 > square(RT_FAR_RECTANGLE) * (square(light->width) + square(light->height)))
        return false;
    *seen = see_rectangle(x, y, fabs(z), light->width, light->height);
    return seen->solid_angle >= RT_SMALL_SOLID_ANGLE;
}

/* Whether the light is a sphere far enough to be sampled by its visible cap; *d2 is its centre's squared distance. */
static inline bool see_spherical_light(global const rt_light_data *light, float3 from, float *d2)
{
    if (light->kind != RT_LIGHT_SPHERE)
        return false;
    const float3 towards = row3(light->a) - from;
    *d2 = dot(towards, towards);
    return *d2 > square(RT_NEAR_SPHERE * light->width);
}

/* ---- Seen from a point ----------------------------------------------------- */

/* What the light emits at a point with this normal in direction w. */
static inline float3 light_radiance(global const rt_light_data *light, float3 normal, float3 w)
{
    const bool lit = (light->flags & RT_LIGHT_TWO_SIDED) || dot(normal, w) > 0.0f;
    return lit ? row3(light->emission) : (float3)(0.0f);
}

/* The density with which sample_light, from this point, makes the direction in which the light's point `at` is met. */
static inline float light_pdf_w(global const rt_light_data *light, float3 from, const struct surface *at)
{
    struct seen_rectangle seen;
    float d2;
    if (see_rectangular_light(light, from, &seen))
        return light->pmf * seen_rectangle_pdf_w(&seen);
    if (see_spherical_light(light, from, &d2))
        return light->pmf * cap_pdf_w(light->width, d2);
    return light->pmf / area_spread(light, at->position - from, at->normal);
}

/* Samples a point of an area light; returns 1 / pdf_w, without the choice. */
static inline float sample_area_light(struct surface *at, global const rt_light_data *light, float3 from, float2 u)
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
    return area_spread(light, at->position - from, at->normal);
}

/* Samples a light that no ray can meet: always the same point. */
static inline void sample_point_light(struct light_sample *sample, global const rt_light_data *light, float3 from)
{
    const float3 towards = row3(light->a) - from;
    const float d2 = dot(towards, towards);
    sample->at.position = row3(light->a);
    sample->wi = towards * (1.0f / sqrt(d2));
    sample->at.normal = -sample->wi;
    sample->lift = 0.0f;
    sample->radiance = row3(light->emission) * (1.0f / d2);
    sample->spread = 1.0f / light->pmf;
}

/*
 * Samples the lights from a point: u.xy the point on the light, u.z the choice. False when nothing
 * can arrive.
 */
static inline bool sample_light(const struct scene *scene, float3 from, float4 u, struct light_sample *sample)
{
    if (scene->header->light_count == 0u)
        return false;
    global const rt_light_data *light = scene->lights + choose_light(scene, u.z);
    const bool sphere = light->kind == RT_LIGHT_SPHERE;
    sample->delta = light->kind == RT_LIGHT_POINT;
    if (sample->delta) {
        sample_point_light(sample, light, from);
        return true;
    }

    /* The side of a flat light is known at once, that of a sphere at the sampled point. */
    float height = dot(from - row3(light->a), row3(light->normal));
    if (!sphere && height <= 0.0f && !(light->flags & RT_LIGHT_TWO_SIDED))
        return false;
    sample->spread = sample_area_light(&sample->at, light, from, u.xy) / light->pmf;
    sample->wi = unit(sample->at.position - from);
    if (sphere)
        height = -dot(sample->wi, sample->at.normal);
    sample->lift = height < 0.0f ? -sample->at.error : sample->at.error;
    sample->radiance = row3(light->emission);
    return !sphere || height > 0.0f || (light->flags & RT_LIGHT_TWO_SIDED);
}

/* The ray from a point that is off its surface to a sampled point of a light, ending just before it. */
static inline struct ray shadow_ray(float3 origin, const struct light_sample *sample)
{
    const float3 target = sample->at.position + sample->lift * sample->at.normal;
    return make_ray(origin, target - origin, 0.0f, 0.9999f);
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
    const bool two_sided = light->flags & RT_LIGHT_TWO_SIDED;
    sample_area(&emission->at, light, start.xy);
    const float3 normal = two_sided && way.z < 0.5f ? -emission->at.normal : emission->at.normal;
    emission->direction = frame_to_world(frame_about(normal), sample_cosine(way.xy));
    emission->flux = (two_sided ? 2.0f : 1.0f) * RT_PI * light->area / light->pmf * row3(light->emission);
    return true;
}

#endif
