/*
 * emit.h - where light paths start: a light by its share of the paths, a point and a direction by
 * what it emits there. The flux of a start is what the light emits over the density of the choices.
 */
#ifndef RT_KERNELS_LIGHT_EMIT_H
#define RT_KERNELS_LIGHT_EMIT_H

#include "accel/coincident.h"
#include "light/light.h"
#include "surface/enclosing_media.h"
#include "shape/shapes.h"

/* The start of a light path. */
struct emission {
    /* position, normal and error only; that of a surface is off all faces that coincide there */
    struct surface at;
    float3 direction; /* unit */
    float3 flux;      /* W; the mean over all choices is the power of all lights */
    uint light;
};

/* Whether light comes from infinitely far. */
static inline bool is_far(global const rt_light_data *light)
{
    return light->kind == RT_LIGHT_DIRECTIONAL || light->kind == RT_LIGHT_ENVIRONMENT;
}

/* The media list on the side of a light's normal; of a light far away, that where a path starts. */
static inline uint4 media_before(const struct scene *scene, const struct emission *emission,
                                 global const rt_light_data *light)
{
    if (!(light->flags & RT_LIGHT_PARTLY_ENCLOSED))
        return (uint4)(vload3(0, light->media), 0u) - 1u;
    return is_far(light) ? half_spaces_around(scene, emission->at.position, emission->direction)
                         : media_around(scene, leave_surface(&emission->at, emission->at.normal));
}

/*
 * The solids in which a path starts: those before the light, or, where it emits on its back, those
 * behind: that of the shape itself, if it is transparent, and those that its faces touch.
 */
static inline uint4 emission_media(const struct scene *scene, const struct emission *emission)
{
    global const rt_light_data *light = scene->lights + emission->light;
    const uint4 media = media_before(scene, emission, light);
    if (light->prim == RT_NONE || !(dot(emission->direction, emission->at.normal) < 0.0f))
        return media;
    const uint shape = scene->prim_shape[light->prim];
    if (scene->shapes[shape].flags & RT_SHAPE_TOUCHES) {
        struct surface surface;
        surface.position = emission->at.position;
        surface.normal = emission->at.normal;
        surface.error = emission->at.error;
        surface.shape = shape;
        surface.prim = light->prim;
        return media_behind(scene, &surface, media);
    }
    const uint material = scene->shapes[shape].material;
    return is_transparent(scene->materials + material) ? media_enter(scene, media, material)
                                                       : media;
}

/* Starts in free space: there is no surface to offset the origin from. */
static inline void emit_from(struct emission *emission, float3 position, float3 direction)
{
    emission->at.position = position;
    emission->at.normal = direction;
    emission->at.error = 0.0f;
    emission->direction = direction;
}

/* How far from a point of a light rounding may lead. */
static inline float rounding_at(const struct scene *scene, float3 p)
{
    return gamma_bound(32.0f) * (fabs(p.x) + fabs(p.y) + fabs(p.z) + scene->header->radius);
}

/*
 * The same for a light that is a point. In the face of a solid it emits on both sides, as light
 * sampling has it, and its paths start beside the face.
 */
static inline void emit_from_point(const struct scene *scene, struct emission *emission,
                                   global const rt_light_data *light, float3 direction)
{
    const float3 p = row3(light->a);
    emit_from(emission, p, direction);
    if (light->flags & RT_LIGHT_PARTLY_ENCLOSED)
        emission->at.error = rounding_at(scene, p);
}

/*
 * The x in [0,1] at which the integral of the falloff 3x^2 - 2x^3 reaches the fraction u of the
 * whole: x^3 (2 - x) = u. Below x = 1 the left side is convex, so Newton's steps, after the first,
 * come down to the root.
 */
static inline float falloff_inverse(float u)
{
    float x = cbrt(0.5f * u);
    for (int i = 0; i < 5 && x > 0.0f; i++)
        x = min(1.0f, x - (x * x * x * (2.0f - x) - u) / (2.0f * x * x * (3.0f - 2.0f * x)));
    return x;
}

/* The mean of a falloff over the cosines of its edge: of x^n, 1 / (n + 1). */
static inline float spot_edge_mean(global const rt_light_data *light)
{
    return light->flags & RT_LIGHT_POWER ? 1.0f / (light->c[2] + 1.0f) : 0.5f;
}

/* The solid angle that a spot would fill with its full intensity. */
static inline float spot_solid_angle(global const rt_light_data *light)
{
    if (light->flags & RT_LIGHT_LINEAR)
        return light->c[2];
    const float inner = light->c[0], outer = light->c[1];
    return 2.0f * RT_PI * ((1.0f - inner) + spot_edge_mean(light) * (inner - outer));
}

/*
 * The integral of t sin(outer - t) from 0 to r: what a linear falloff emits within the angle r of
 * its outer edge, times its width, over 2 pi. sin(r) - r cos(r) by its series where r is small.
 */
static inline float linear_edge(float outer, float r)
{
    const float2 edge = sin_cos(outer), arc = sin_cos(r);
    const float half_sine = sin(0.5f * r), r2 = r * r;
    const float odd = r < 0.5f ? r * r2 * (1.0f / 3.0f - r2 * (1.0f / 30.0f - r2 * (1.0f / 840.0f)))
                               : arc.x - r * arc.y;
    return edge.x * (r * arc.x - 2.0f * half_sine * half_sine) - edge.y * odd;
}

/*
 * The r up to `width` at which that is `part`: Newton's steps, halvings where they leave the
 * interval.
 */
static inline float linear_edge_inverse(float outer, float width, float part)
{
    float lo = 0.0f, hi = width;
    float r = width * sqrt(min(part / linear_edge(outer, width), 1.0f));
    for (int i = 0; i < 8; i++) {
        const float over = linear_edge(outer, r) - part;
        lo = over < 0.0f ? r : lo;
        hi = over < 0.0f ? hi : r;
        const float next = r - over / (r * sin(outer - r));
        r = next >= lo && next <= hi ? next : 0.5f * (lo + hi);
    }
    return r;
}

/* 1 - cos of the angle about the axis within which a spot emits v / whole of its flux. */
static inline float spot_below(global const rt_light_data *light, float v, float whole)
{
    const float inner = light->c[0], outer = light->c[1];
    if (v < 1.0f - inner)
        return v;
    if (light->flags & RT_LIGHT_LINEAR) {
        const float width = light->height - light->width;
        const float s = sin(0.5f * (light->height - linear_edge_inverse(light->height, width,
                                                                        (whole - v) * width)));
        return 2.0f * s * s;
    }
    const float mean = spot_edge_mean(light);
    const float u = (whole - v) / (mean * (inner - outer));
    return 1.0f - mix(outer, inner,
                      light->flags & RT_LIGHT_POWER ? pow(clamp(u, 0.0f, 1.0f), mean)
                                                    : falloff_inverse(u));
}

/*
 * A direction in proportion to a spot's intensity.
 */
static inline void emit_spot(const struct scene *scene, struct emission *emission,
                             global const rt_light_data *light, float2 u)
{
    const float whole = spot_solid_angle(light) / (2.0f * RT_PI);
    const float below = spot_below(light, u.x * whole, whole);
    const float2 arc = sin_cos(2.0f * RT_PI * u.y);
    const float3 w_local = (float3)(sqrt(below * (2.0f - below)) * arc.yx, 1.0f - below);
    emit_from_point(scene, emission, light, frame_to_world(frame_about(row3(light->b)), w_local));
    emission->flux = spot_solid_angle(light) * row3(light->emission);
}

/* A direction by a table; the flux is 0 where rounding made it one that is never sampled. */
static inline void emit_table(const struct scene *scene, struct emission *emission,
                              global const rt_light_data *light, float2 u)
{
    const float3 w = sample_table(scene, light, u);
    const float pdf_w = table_pdf_w(scene, light, w);
    emit_from_point(scene, emission, light, w);
    emission->flux = pdf_w > 0.0f ? table_intensity(scene, light, w) / pdf_w : (float3)(0.0f);
}

/* Starts on the cross section of a beam, beside a surface that may lie there. */
static inline void emit_beam(const struct scene *scene, struct emission *emission,
                             global const rt_light_data *light, float2 u)
{
    const float2 unit_at = light->flags & RT_LIGHT_ROUND ? sample_disc(u) : 2.0f * u - 1.0f;
    const struct frame frame = light_frame(light);
    const float3 p =
        row3(light->a) + unit_at.x * light->width * frame.s + unit_at.y * light->height * frame.t;
    emit_from(emission, p, frame.n);
    emission->at.error = rounding_at(scene, p);
    emission->flux = light->area * row3(light->emission);
}

/*
 * How far it is from a point in direction w to the last of the planes, which have no end; 0 when
 * there is none.
 */
static inline float last_plane(const struct scene *scene, float3 from, float3 w)
{
    const struct ray ray = make_ray(from, w, 0.0f, INFINITY);
    float last = 0.0f;
    for (uint i = 0; i < scene->header->plane_count; i++) {
        uint part;
        const float t = plane_intersect(scene->shapes + scene->planes[i], &ray, &part);
        last = t < INFINITY ? max(last, t) : last;
    }
    return last;
}

/* The sphere around all finite shapes and a medium that ends; that of none is of unit size. */
static inline float distant_radius(const struct scene *scene)
{
    return scene->header->radius > 0.0f ? scene->header->radius : 1.0f;
}

static inline float3 distant_centre(const struct scene *scene)
{
    global const rt_scene_header *header = scene->header;
    return header->radius > 0.0f ? 0.5f * (row3(header->bounds_lo) + row3(header->bounds_hi))
                                 : (float3)(0.0f);
}

/*
 * Light from infinitely far in direction w comes through a disc that faces it and touches the
 * sphere around all finite shapes. Where it starts to go through a point: on the plane of the disc,
 * or twice as far as the last of the scene's planes that stands before it.
 */
static inline float3 distant_start(const struct scene *scene, float3 w, float3 through)
{
    const float up = dot(distant_centre(scene) - through, w) + distant_radius(scene);
    const float3 disc = through + up * w;
    return disc + 2.0f * last_plane(scene, disc, w) * w;
}

/*
 * The density of a ray from infinitely far through a point, over area that faces it, 1/m^2; w is
 * its direction or the opposite one. is_of_portal: the point is one of a portal's.
 */
static inline float distant_pdf_a(const struct scene *scene, float3 through, float3 w,
                                  bool is_of_portal)
{
    const float3 off = cross(through - distant_centre(scene), w);
    const float squared_radius = square(distant_radius(scene));
    if (dot(off, off) > squared_radius)
        return 0.0f;
    const float pdf_a = 1.0f / (RT_PI * squared_radius);
    const float across = has_portals(scene) ? portals_across(scene, w) : 0.0f;
    return across > 0.0f
               ? mix(pdf_a, portals_pdf_a(scene, through, w, across, is_of_portal), RT_PORTAL_PART)
               : pdf_a;
}

static inline float emit_distant_pdf_a(const struct scene *scene, float3 through, float3 w)
{
    return distant_pdf_a(scene, through, w, false);
}

/*
 * Starts on the disc. Light that misses the sphere and meets a plane farther out is not followed.
 * Where there are portals, a part of the starts is on the lines through these, but for what will be
 * aimed elsewhere.
 */
static inline void emit_distant(const struct scene *scene, struct emission *emission, float3 w,
                                float2 u, bool is_aimed)
{
    const float radius = distant_radius(scene);
    const float across = has_portals(scene) && !is_aimed ? portals_across(scene, w) : 0.0f;
    const bool is_of_portal = across > 0.0f && u.x < RT_PORTAL_PART;
    float3 through;
    if (is_of_portal) {
        through = portals_point(scene, w, (float2)(u.x / RT_PORTAL_PART, u.y), across);
    } else {
        if (across > 0.0f)
            u.x = fmin((u.x - RT_PORTAL_PART) / (1.0f - RT_PORTAL_PART), RT_BELOW_ONE);
        const float2 p = radius * sample_disc(u);
        const struct frame frame = frame_about(w);
        through = distant_centre(scene) + (p.x * frame.s + p.y * frame.t);
    }
    emit_from(emission, distant_start(scene, w, through), -w);
    if (across > 0.0f) {
        const float pdf_a = distant_pdf_a(scene, through, w, is_of_portal);
        emission->flux *= pdf_a > 0.0f ? 1.0f / pdf_a : 0.0f;
    } else {
        emission->flux *= RT_PI * radius * radius;
    }
}

/* From a surface by the cosine; `side` in [0,1) chooses that of a two-sided light. */
static inline void emit_area(const struct scene *scene, struct emission *emission,
                             global const rt_light_data *light, float2 start, float2 turn,
                             float side)
{
    const bool two_sided = light->flags & RT_LIGHT_TWO_SIDED;
    float area = light->area;
    if (light->kind == RT_LIGHT_SHAPE) {
        area = 1.0f / shape_point(scene, scene->prim_shape[light->prim], start, &emission->at);
    } else {
        sample_area(&emission->at, light, start);
        if (light_is_varied(light))
            locate_on_light(scene, light, &emission->at);
    }
    emission->at.error = lift_off_coincident(scene, &emission->at, light->prim);
    const float3 normal = two_sided && side < 0.5f ? -emission->at.normal : emission->at.normal;
    emission->direction = frame_to_world(frame_about(normal), sample_cosine(turn));
    emission->flux = (two_sided ? 2.0f : 1.0f) * RT_PI * area * row3(light->emission);
    if (light_is_varied(light))
        emission->flux *= light_pattern(scene, light, &emission->at);
}

/* Starts at a light that is chosen. The flux leaves out the choice. */
static inline void emit_chosen(const struct scene *scene, global const rt_light_data *light,
                               float4 start, float4 turn, bool is_aimed, struct emission *emission)
{
    float3 w, radiance;
    switch ((rt_light_kind)light->kind) {
    case RT_LIGHT_POINT:
        emit_from_point(scene, emission, light, sample_sphere(turn.xy));
        emission->flux = 4.0f * RT_PI * row3(light->emission);
        return;
    case RT_LIGHT_SPOT:
    case RT_LIGHT_TABLE:
        if (light_has_table(light))
            emit_table(scene, emission, light, turn.xy);
        else
            emit_spot(scene, emission, light, turn.xy);
        return;
    case RT_LIGHT_DIRECTIONAL:
        emission->flux = row3(light->emission);
        emit_distant(scene, emission, -row3(light->b), start.xy, is_aimed);
        return;
    case RT_LIGHT_BEAM:
        emit_beam(scene, emission, light, start.xy);
        return;
    case RT_LIGHT_ENVIRONMENT:
        emission->flux = sample_environment(scene, turn.xy, &w, &radiance);
        emission->flux *= radiance;
        emit_distant(scene, emission, w, start.xy, is_aimed);
        return;
    case RT_LIGHT_QUAD:
    case RT_LIGHT_TRIANGLE:
    case RT_LIGHT_SPHERE:
    case RT_LIGHT_SHAPE:
        emit_area(scene, emission, light, start.xy, turn.xy, turn.z);
    }
}

/* The light at u of the distribution of photon paths, which need not be that of power. */
static inline uint choose_emitter(global const rt_light_share *shares, uint count, float u)
{
    uint low = 0u, high = count - 1u;
    while (low < high) {
        const uint middle = (low + high) >> 1;
        if (u < shares[middle].cdf)
            high = middle;
        else
            low = middle + 1u;
    }
    return low;
}

/*
 * Starts a light path: start.z chooses the light, start.xy and turn.xy the point and the direction,
 * turn.z the side; is_aimed: it will be aimed at specular shapes (photon/aim.h). False when there
 * is no light.
 */
static inline bool light_emit(const struct scene *scene, global const rt_light_share *shares,
                              float4 start, float4 turn, bool is_aimed, struct emission *emission)
{
    if (scene->header->light_count == 0u)
        return false;
    emission->light = choose_emitter(shares, scene->header->light_count, start.z);
    const float pmf = shares[emission->light].pmf;
    if (pmf == 0.0f)
        return false;
    emit_chosen(scene, scene->lights + emission->light, start, turn, is_aimed, emission);
    emission->flux /= pmf;
    return true;
}

#endif
