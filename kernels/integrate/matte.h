/*
 * matte.h - the commonest vertex, for eight paths at once: on a surface that is only diffuse,
 * outside of all solids.
 *
 * Most vertices of most scenes are matte. There path_vertex comes down to what stands here: the
 * same estimate by the same numbers, equal but for rounding, in eight lanes and with hardly a
 * branch. Where a vertex lies on a flat triangle or parallelogram, and where a flat lamp is sampled
 * by area, that is done in lanes as well; other surfaces and lights are asked for one by one.
 * Vertices that are not matte go to path_vertex. No lane looks at another, so that a path's bits do
 * not depend on those beside it; what stands in lanes that are not taken has no meaning.
 */
#ifndef RT_KERNELS_INTEGRATE_MATTE_H
#define RT_KERNELS_INTEGRATE_MATTE_H

#include "math/lanes3.h"
#include "light/light.h"
#include "material/material.h"
#include "integrate/path_state.h"
#include "shape/shapes.h"

/* What is noted of matte vertices before they are taken on together. */
struct matte {
    float3 kd[8];
    global const float *corner[8]; /* flat surface: the first vertex in its block */
    struct surface surfaces[8];    /* the others */
    uint taken;                    /* a bit for each path whose vertex is noted, */
    uint curved;                   /* those that have their surface in `surfaces` */
};

/* The lights that are chosen for the vertices. */
struct matte_lights {
    global const rt_light_data *light[8]; /* those that are sampled in lanes */
    float pmf[8];                         /* of the choice */
    struct light_sample samples[8];       /* the others */
    uint flat;                            /* a bit for each lane whose light is sampled in lanes, */
    uint single;                          /* those that have a sample */
    uint alone;                           /* those whose light no ray meets by chance */
};

/* Where the lanes' vertices are; the normals are on the side that the path comes from. */
struct matte_surface {
    struct lanes3 position, normal, shading;
    float8 error;
};

/* What the lanes' vertices see of a light. */
struct matte_light {
    struct lanes3 wi, radiance;
    struct lanes3 target; /* on the light, off its surface by its error */
    float8 spread;        /* as in light_sample; 0 where nothing can arrive */
};

/* Notes a path's vertex if it is matte. */
static inline bool matte_take(struct matte *matte, uint lane, const struct scene *scene,
                              const rt_params *params, const struct path *path,
                              const struct hit *hit)
{
    global const rt_shape *shape = scene->shapes + scene->prim_shape[hit->prim];
    if (!(shape->flags & RT_SHAPE_MATTE) || path->media.x != RT_NONE ||
        path->depth == params->max_depth)
        return false;
    global const rt_material_data *material = scene->materials + shape->material;
    if (shape->flags & RT_SHAPE_FLAT) {
        matte->corner[lane] = scene->blocks[hit->slot >> 3].v0[0] + (hit->slot & 7u);
        matte->kd[lane] = row3(material->kd);
    } else {
        struct surface *surface = &matte->surfaces[lane];
        *surface = surface_at(scene, &path->ray, hit);
        const struct bsdf_params values = evaluate_material(scene, material, surface);
        surface->shading = values.shading;
        matte->kd[lane] = values.kd;
        matte->curved |= 1u << lane;
    }
    matte->taken |= 1u << lane;
    return true;
}

/* The lane that lane i reads from: itself where it holds something, else the first that does. */
static inline uint held_lane(uint held, uint i)
{
    return held >> i & 1u ? i : lane_first(held);
}

/* As triangle_surface, without u and v. */
static inline struct matte_surface flat_surfaces(const struct matte *matte, const struct hit *hits)
{
    const uint row = RT_BVH_WIDTH, vertex = 3u * RT_BVH_WIDTH;
    const float8 u = LANES_OF(float8, hits, .u), v = LANES_OF(float8, hits, .v);
    const struct lanes3 v0 = lanes3_gather(matte->corner, 0u, row);
    const struct lanes3 e1 = sub8(lanes3_gather(matte->corner, vertex, row), v0);
    const struct lanes3 e2 = sub8(lanes3_gather(matte->corner, 2u * vertex, row), v0);
    const struct lanes3 across = cross8(e1, e2);
    const float8 twice_area = length8(across);
    struct matte_surface surface;
    surface.position = along8(along8(v0, u, e1), v, e2);
    surface.normal = surface.shading = scale8(1.0f / twice_area, across);

    const struct lanes3 reach = add8(fabs8(v0), add8(fabs8(e1), fabs8(e2)));
    const float8 size = length8(e1) + length8(e2);
    const float8 sliver = lane_min(size * size / twice_area, (float8)(64.0f));
    surface.error =
        gamma_bound(4.0f) * dot8(reach, fabs8(surface.normal)) + gamma_bound(2.0f) * size * sliver;
    return surface;
}

/* Takes those lanes from surfaces that were made one by one. */
static inline void take_curved(struct matte_surface *surface, const struct matte *matte)
{
    const struct lanes3 position = LANES3_OF(matte->surfaces, .position);
    const struct lanes3 normal = LANES3_OF(matte->surfaces, .normal);
    const struct lanes3 shading = LANES3_OF(matte->surfaces, .shading);
    const int8 curved = lanes_of(matte->curved);
    surface->position = select8(curved, position, surface->position);
    surface->normal = select8(curved, normal, surface->normal);
    surface->shading = select8(curved, shading, surface->shading);
    surface->error = curved ? LANES_OF(float8, matte->surfaces, .error) : surface->error;
}

static inline struct matte_surface matte_surfaces(struct matte *matte, const struct path *paths,
                                                  const struct hit *hits)
{
    struct matte_surface surface;
    const uint flat = matte->taken & ~matte->curved;
    if (flat) {
        for (uint i = 0u; i < 8u; i++)
            matte->corner[i] = matte->corner[held_lane(flat, i)];
        surface = flat_surfaces(matte, hits);
    }
    if (matte->curved)
        take_curved(&surface, matte);
    const struct lanes3 direction = LANES3_OF(paths, .ray.direction);
    const float8 side = dot8(direction, surface.normal) > 0.0f ? (float8)(-1.0f) : (float8)(1.0f);
    surface.normal = scale8(side, surface.normal);
    surface.shading = scale8(side, surface.shading);
    return surface;
}

/* Chooses a light for each vertex, and samples those that lanes do not. */
static inline void choose_lights(struct matte_lights *lights, const struct scene *scene,
                                 uint wanted, struct lanes3 from, const float8 *numbers)
{
    float3 positions[8];
    lanes3_rows(from, positions);
    lights->flat = lights->single = lights->alone = 0u;
    if (scene->light_nodes[1].power == 0.0f)
        return;
    for (; wanted; wanted &= wanted - 1u) {
        const uint i = lane_first(wanted), bit = 1u << i;
        const uint chosen = choose_light(scene, positions[i], numbers[i].s2, &lights->pmf[i]);
        global const rt_light_data *light = scene->lights + chosen;
        if (light->flags & RT_LIGHT_BY_AREA) {
            lights->light[i] = light;
            lights->flat |= bit;
        } else if (sample_chosen(scene, light, positions[i], numbers[i].s01, &lights->samples[i])) {
            lights->single |= bit;
            lights->alone |= lights->samples[i].delta ? bit : 0u;
        }
    }
}

/* As sample_chosen, for flat lights by area. */
static inline struct matte_light flat_lights(global const rt_light_data *const lights[8],
                                             struct lanes3 from, const float8 *numbers)
{
    const struct lanes3 a = LANES3_OF_ROW(lights, ->a), b = LANES3_OF_ROW(lights, ->b),
                        c = LANES3_OF_ROW(lights, ->c);
    const struct lanes3 normal = LANES3_OF_ROW(lights, ->normal),
                        emission = LANES3_OF_ROW(lights, ->emission);
    const uint8 kind = LANES_OF(uint8, lights, ->kind), flags = LANES_OF(uint8, lights, ->flags);
    const float8 width = LANES_OF(float8, lights, ->width),
                 height = LANES_OF(float8, lights, ->height);
    const float8 area = LANES_OF(float8, lights, ->area);
    const float8 u = LANES_OF(float8, numbers, .s0), v = LANES_OF(float8, numbers, .s1);
    const float8 fold = kind == RT_LIGHT_QUAD ? (float8)(0.0f) : 0.5f * lane_min(u, v);
    const struct lanes3 point = along8(along8(a, (u - fold) * width, b), (v - fold) * height, c);
    const float8 above = dot8(sub8(from, a), normal);
    const float8 size = fabs(a.x) + fabs(a.y) + fabs(a.z) + 2.0f * (width + height);

    const struct lanes3 towards = sub8(point, from);
    const float8 d2 = dot8(towards, towards), distance = sqrt(d2);
    const int8 two_sided = (flags & RT_LIGHT_TWO_SIDED) != 0u;
    struct matte_light light;
    light.wi = scale8(1.0f / distance, towards);
    light.radiance = emission;
    light.target = along8(point, copysign(gamma_bound(8.0f) * size, above), normal);
    light.spread = fabs(dot8(towards, normal)) * area / (d2 * distance);
    light.spread = above > 0.0f || two_sided ? light.spread : (float8)(0.0f);
    return light;
}

/* Takes those lanes from samples. */
static inline void take_samples(struct matte_light *light, const struct matte_lights *lights)
{
    const struct lanes3 wi = LANES3_OF(lights->samples, .wi),
                        radiance = LANES3_OF(lights->samples, .radiance);
    const int8 single = lanes_of(lights->single);
    light->wi = select8(single, wi, light->wi);
    light->radiance = select8(single, radiance, light->radiance);
    light->spread = single ? LANES_OF(float8, lights->samples, .spread) : light->spread;
}

/* As connect_light; `weight` is that of the path. */
static inline void matte_connect(const struct scene *scene, const struct matte_surface *surface,
                                 uint taken, struct lanes3 weight, struct lanes3 kd,
                                 const float8 *numbers, struct connection *connections)
{
    struct matte_lights lights;
    struct matte_light light;
    choose_lights(&lights, scene, taken, surface->position, numbers);
    if (lights.flat) {
        for (uint i = 0u; i < 8u; i++)
            lights.light[i] = lights.light[held_lane(lights.flat, i)];
        light = flat_lights(lights.light, surface->position, numbers);
    }
    if (lights.single)
        take_samples(&light, &lights);

    /* Weigh it by the power heuristic. */
    const float8 spread = light.spread / vload8(0, lights.pmf);
    const float8 cosine =
        dot8(light.wi, surface->normal) > 0.0f ? dot8(light.wi, surface->shading) : (float8)(0.0f);
    const float8 pdf_w = lane_max(cosine, (float8)(0.0f)) * (1.0f / RT_PI);
    const float8 ratio = lanes_of(lights.alone) ? (float8)(0.0f) : pdf_w * spread;
    const float8 share = pdf_w * spread / (1.0f + ratio * ratio);
    const struct lanes3 radiance = mul8(scale8(share, weight), mul8(kd, light.radiance));

    /* Ask for what is in between. */
    const struct lanes3 origin = along8(surface->position, surface->error, surface->normal);
    float3 origins[8], directions[8], radiances[8];
    lanes3_rows(origin, origins);
    lanes3_rows(sub8(light.target, origin), directions);
    lanes3_rows(radiance, radiances);
    for (uint i = 0u; i < 8u; i++)
        if ((lights.flat | lights.single) >> i & 1u) {
            connections[i].ray = lights.single >> i & 1u
                                     ? shadow_ray(origins[i], &lights.samples[i])
                                     : make_ray(origins[i], directions[i], 0.0f, 0.9999f);
            connections[i].radiance = radiances[i];
        }
}

/* As sample_cosine. */
static inline struct lanes3 sample_cosine8(float8 u, float8 v)
{
    const float8 x = 2.0f * u - 1.0f, y = 2.0f * v - 1.0f;
    const int8 wide = fabs(x) > fabs(y);
    const float8 r = wide ? x : y;
    const float8 angle = 0.25f * RT_PI * (wide ? y : x) / (r == 0.0f ? (float8)(1.0f) : r);
    const float8 a2 = angle * angle;
    const float8 s =
        angle + angle * a2 * (-1.6666654611e-1f + a2 * (8.3321608736e-3f + a2 * -1.9515295891e-4f));
    const float8 c =
        1.0f - 0.5f * a2 +
        a2 * a2 *
            (4.166664568298827e-2f + a2 * (-1.388731625493765e-3f + a2 * 2.443315711809948e-5f));
    struct lanes3 way;
    way.x = r * (wide ? c : s);
    way.y = r * (wide ? s : c);
    way.z = sqrt(lane_max(1.0f - (way.x * way.x + way.y * way.y), (float8)(0.0f)));
    return way;
}

/* As frame_to_world(frame_about(n), v). */
static inline struct lanes3 frame_to_world8(struct lanes3 n, struct lanes3 v)
{
    const float8 sign = n.z < 0.0f ? (float8)(-1.0f) : (float8)(1.0f);
    const float8 a = -1.0f / (sign + n.z);
    const float8 b = n.x * n.y * a;
    const struct lanes3 s = {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x};
    const struct lanes3 t = {b, sign + n.y * n.y * a, -n.y};
    return along8(along8(scale8(v.x, s), v.y, t), v.z, n);
}

/* Roulette, and a diffuse event: as path_scatter. */
static inline void matte_scatter(const rt_params *params, const struct matte_surface *surface,
                                 struct lanes3 beta, struct lanes3 kd, const float8 *numbers,
                                 uint taken, struct path *paths)
{
    struct lanes3 kept = mul8(beta, kd);
    const uint8 depth = LANES_OF(uint8, paths, .depth);
    const float8 chance = lane_min(largest8(kept) / params->roulette_threshold, (float8)(1.0f));
    const float8 survival = depth < params->roulette_depth ? (float8)(1.0f) : chance;
    kept = scale8(1.0f / survival, kept);
    const struct lanes3 way =
        sample_cosine8(LANES_OF(float8, numbers, .s4), LANES_OF(float8, numbers, .s5));
    const struct lanes3 wi = frame_to_world8(surface->shading, way);
    const struct lanes3 origin = along8(surface->position, surface->error, surface->normal);
    const uint going = lane_mask(LANES_OF(float8, numbers, .s6) < survival && way.z > 0.0f &&
                                 dot8(wi, surface->normal) > 0.0f && largest8(kept) > 0.0f);

    float3 origins[8], directions[8], positions[8], betas[8];
    float pdf_w[8];
    lanes3_rows(origin, origins);
    lanes3_rows(wi, directions);
    lanes3_rows(surface->position, positions);
    lanes3_rows(kept, betas);
    vstore8(way.z * (1.0f / RT_PI), 0, pdf_w);
    for (uint i = 0u; i < 8u; i++)
        if (taken >> i & 1u) {
            paths[i].ray = make_ray(origins[i], directions[i], 0.0f, INFINITY);
            paths[i].from = positions[i];
            paths[i].beta = betas[i];
            paths[i].pdf_w = pdf_w[i];
            paths[i].scattered = true;
            paths[i].rough = false;
            paths[i].depth = going >> i & 1u ? paths[i].depth + 1u : 0u;
        }
}

/* Takes the paths that were noted through their vertices. */
INLINE_NEVER void matte_vertices(const struct scene *scene, const rt_params *params,
                                 struct matte *matte, struct path *paths, const struct hit *hits,
                                 const float8 *numbers, struct connection *connections)
{
    const struct matte_surface surface = matte_surfaces(matte, paths, hits);
    const struct lanes3 beta = LANES3_OF(paths, .beta), kd = LANES3_OF(matte->kd, );
    const struct lanes3 weight = scale8(LANES_OF(float8, paths, .eta_scale), beta);
    matte_connect(scene, &surface, matte->taken, weight, kd, numbers, connections);
    matte_scatter(params, &surface, beta, kd, numbers, matte->taken, paths);
}

#endif
