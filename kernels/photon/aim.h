/*
 * aim.h - photon paths aimed at specular shapes, as by a projection map.
 *
 * A path can leave a caustic photon only when it first meets a specular shape, so its start is
 * resampled towards the bounding spheres of these shapes: directions within the cones that the
 * spheres subtend, or, of light from infinitely far, points on their discs. A bounding sphere is
 * chosen in proportion to its solid angle or its disc, so the density is the number of spheres that
 * the start runs into over the sum of all. The flux is weighted by the density that the start had
 * by light_emit over this one: the expected caustic illumination is unchanged, and paths in other
 * directions are not traced. Where the bounding spheres fill no less than the directions that the
 * light emits into, as around an area light within one of them, the start is left as it is. So is
 * that of a beam, which one points at what it shall light.
 *
 * References:
 *   Jensen: "Realistic Image Synthesis Using Photon Mapping", 2001, chapter 5 (projection maps).
 *   Veach, Guibas: "Optimally Combining Sampling Techniques for Monte Carlo Rendering", SIGGRAPH
 *     1995 (the one-sample model: choosing in proportion makes the balance heuristic's density the
 *     sum of all).
 */
#ifndef RT_KERNELS_PHOTON_AIM_H
#define RT_KERNELS_PHOTON_AIM_H

#include "light/emit.h"

/* The cone of directions into which a light emits from a point. */
struct emission_cone {
    float3 from, axis;
    float cosine, sine; /* of the angle between the axis and the edge */
};

/* ---- Bounding spheres seen from a point ---------------------------------------- */

/*
 * The solid angle of a bounding sphere, 0 when it lies outside the light's cone; 4 pi when it holds
 * the point.
 */
static inline float target_solid_angle(global const rt_target *target,
                                       const struct emission_cone *cone)
{
    const float3 towards = row3(target->centre) - cone->from;
    const float radius2 = square(target->radius), d2 = dot(towards, towards);
    if (!(d2 > radius2))
        return 4.0f * RT_PI;
    /* They touch unless the angle to the sphere's centre is above the sum of both half-angles. */
    const float sine = target->radius / sqrt(d2), cosine = sqrt(1.0f - radius2 / d2);
    const float sum_sine = cone->sine * cosine + cone->cosine * sine;
    const float sum_cosine = cone->cosine * cosine - cone->sine * sine;
    const bool touches = sum_sine <= 0.0f || dot(towards, cone->axis) >= sum_cosine * sqrt(d2);
    return touches ? 2.0f * RT_PI * cap_height(target->radius, d2) : 0.0f;
}

/* Whether a ray in this direction runs into a bounding sphere that it starts outside of. */
static inline bool target_is_ahead(global const rt_target *target, float3 from, float3 direction)
{
    const float3 towards = row3(target->centre) - from;
    const float3 off = cross(towards, direction);
    return dot(towards, direction) > 0.0f && dot(off, off) <= square(target->radius);
}

/* A direction in the cone of a bounding sphere, uniform in solid angle. */
static inline float3 sample_target(global const rt_target *target, float3 from, float2 u)
{
    const float3 towards = row3(target->centre) - from;
    const float h = u.x * cap_height(target->radius, dot(towards, towards));
    const float2 arc = sin_cos(2.0f * RT_PI * u.y);
    return frame_to_world(frame_about(unit(towards)),
                          (float3)(sqrt(h * (2.0f - h)) * arc.yx, 1.0f - h));
}

/*
 * Samples a direction by all bounding spheres, of which u.z chooses. Returns 1 / pdf_w: 0 when none
 * is in the light's cone, and `limit` when they fill no less than that, which leaves the direction
 * as it is.
 */
static inline float aim_from_point(const struct scene *scene, const struct emission_cone *cone,
                                   float limit, float3 u, float3 *direction)
{
    const uint count = scene->header->target_count;
    float sum = 0.0f;
    for (uint i = 0; i < count; i++)
        sum += target_solid_angle(scene->targets + i, cone);
    if (sum == 0.0f || sum >= limit)
        return min(sum, limit);

    /* Choose a bounding sphere; rounding at the end leaves the last that can be seen. */
    uint chosen = 0;
    float before = 0.0f;
    for (uint i = 0; i < count && before <= u.z * sum; i++) {
        const float solid_angle = target_solid_angle(scene->targets + i, cone);
        before += solid_angle;
        chosen = solid_angle > 0.0f ? i : chosen;
    }
    *direction = sample_target(scene->targets + chosen, cone->from, u.xy);

    /* Count the bounding spheres that could have been chosen for it. */
    float covers = 1.0f;
    for (uint i = 0; i < count; i++)
        if (i != chosen && target_solid_angle(scene->targets + i, cone) > 0.0f &&
            target_is_ahead(scene->targets + i, cone->from, *direction))
            covers += 1.0f;
    return sum / covers;
}

/* ---- Lights that emit from a point ---------------------------------------------- */

/*
 * The cone of directions into which the light emits from where this path starts, and its solid
 * angle.
 */
static inline struct emission_cone cone_at(const struct scene *scene,
                                           global const rt_light_data *light,
                                           const struct emission *emission, float *solid_angle)
{
    struct emission_cone cone;
    cone.from = emission->at.position;
    cone.axis = emission->direction;
    cone.cosine = -1.0f;
    if (light->kind == RT_LIGHT_TABLE) {
        cone.axis = row3(light->b);
        cone.cosine = light_table(scene, light)->cosine;
    } else if (light->kind == RT_LIGHT_SPOT) {
        cone.axis = row3(light->b);
        cone.cosine = light->c[1];
    } else if (light->kind != RT_LIGHT_POINT) {
        cone.axis = dot(emission->direction, emission->at.normal) < 0.0f ? -emission->at.normal
                                                                         : emission->at.normal;
        cone.cosine = 0.0f;
    }
    cone.sine = sqrt(1.0f - square(cone.cosine));
    *solid_angle = 2.0f * RT_PI * (1.0f - cone.cosine);
    return cone;
}

/* The density of light_emit's directions. */
static inline float emission_pdf_w(global const rt_light_data *light,
                                   const struct emission_cone *cone, float3 direction)
{
    const float cosine = dot(direction, cone->axis);
    if (light->kind == RT_LIGHT_POINT)
        return sphere_pdf_w();
    if (light->kind == RT_LIGHT_SPOT)
        return spot_falloff(light, cosine) / spot_solid_angle(light);
    return cosine_pdf_w(max(cosine, 0.0f));
}

/* pmf: of the choice of the light. */
static inline void aim_near(const struct scene *scene, global const rt_light_data *light, float pmf,
                            float3 u, struct emission *emission)
{
    float solid_angle;
    const struct emission_cone cone = cone_at(scene, light, emission, &solid_angle);
    const float inverse_pdf = aim_from_point(scene, &cone, solid_angle, u, &emission->direction);
    if (inverse_pdf < solid_angle && light_has_table(light))
        emission->flux = inverse_pdf / pmf * table_intensity(scene, light, emission->direction);
    else if (inverse_pdf < solid_angle)
        emission->flux *= inverse_pdf > 0.0f
                              ? inverse_pdf * emission_pdf_w(light, &cone, emission->direction)
                              : 0.0f;
    /* The path of a point starts off it along its direction; see emit_from_point. */
    if (RT_LIGHT_IS_POINT(light->kind))
        emission->at.normal = emission->direction;
}

/* ---- Light from infinitely far ----------------------------------------------------- */

/*
 * Points on the disc that light_emit uses, through the bounding spheres as they are seen along the
 * light.
 */
static inline void aim_far(const struct scene *scene, float3 u, struct emission *emission)
{
    const uint count = scene->header->target_count;
    const float3 w = -emission->direction;
    const float whole = square(distant_radius(scene));
    float sum = 0.0f;
    for (uint i = 0; i < count; i++)
        sum += square(scene->targets[i].radius);
    if (sum >= whole)
        return;
    emission->flux *= sum / whole;
    if (count == 0u)
        return;

    /* Choose a bounding sphere, and a point of its disc. */
    uint chosen = 0;
    for (float before = square(scene->targets[0].radius);
         before <= u.z * sum && chosen + 1u < count;)
        before += square(scene->targets[++chosen].radius);
    global const rt_target *target = scene->targets + chosen;
    const struct frame frame = frame_about(w);
    const float2 p = target->radius * sample_disc(u.xy);
    const float3 through = row3(target->centre) + (p.x * frame.s + p.y * frame.t);
    emit_from(emission, distant_start(scene, w, through), -w);

    /* Count the bounding spheres that could have been chosen for it. */
    float covers = 1.0f;
    for (uint i = 0; i < count; i++) {
        const float3 off = cross(row3(scene->targets[i].centre) - through, w);
        if (i != chosen && dot(off, off) <= square(scene->targets[i].radius))
            covers += 1.0f;
    }
    emission->flux /= covers;
}

/*
 * Aims a start that light_emit made of these numbers at the specular shapes; direction.w chooses
 * the bounding sphere. The start's flux becomes 0 where no caustic can come of it.
 */
static inline void aim_at_caustics(const struct scene *scene, global const rt_light_share *shares,
                                   float4 start, float4 direction, struct emission *emission)
{
    global const rt_light_data *light = scene->lights + emission->light;
    if (light->kind == RT_LIGHT_BEAM)
        return;
    if (is_far(light))
        aim_far(scene, (float3)(start.xy, direction.w), emission);
    else
        aim_near(scene, light, shares[emission->light].pmf, (float3)(direction.xy, direction.w),
                 emission);
}

#endif
