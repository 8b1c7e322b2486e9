/*
 * plain.h - the commonest vertex, for eight paths at once.
 *
 * Most vertices of most scenes are plain: a flat triangle or parallelogram that is evenly diffuse and does not shine,
 * outside of all solids, joined with a flat lamp that is sampled by area. There path_vertex comes down to what stands
 * here, in eight lanes, without a branch. All other vertices go to path_vertex.
 */
#ifndef RT_PLAIN_H
#define RT_PLAIN_H

#include "lanes3.h"
#include "light.h"
#include "path_state.h"

/* What lanes need to know of plain vertices. */
struct plain {
    global const float *corner[8]; /* the triangle's first vertex in its block */
    global const float *kd[8];
    global const float *light[8];  /* rt_light_data, chosen for the vertex */
    float flat_quad[8]; /* 1 where the light is a parallelogram, 0 where it is a triangle */
    float both[8];      /* 1 where it shines to both sides, else 0 */
};

/* Where the lanes' vertices are. */
struct plain_surface {
    struct lanes3 position, normal; /* the normal is on the side that the path comes from */
    float8 error;
};

/* Takes note of a path's vertex if it is plain; u is the choice of the light. */
static inline bool plain_take(struct plain *plain, uint lane, const struct scene *scene, const rt_params *params,
                              const struct path *path, const struct hit *hit, float u)
{
    if ((hit->slot & RT_SLOT_ANALYTIC) || path->media.x != RT_NONE || path->depth == params->max_depth)
        return false;
    global const rt_shape *shape = scene->shapes + scene->prim_shape[hit->prim];
    if (!(shape->flags & RT_SHAPE_PLAIN))
        return false;
    global const rt_light_data *light = scene->lights + choose_light(scene, u);
    if (!(light->flags & RT_LIGHT_PLAIN))
        return false;
    plain->corner[lane] = scene->blocks[hit->slot >> 3].v0[0] + (hit->slot & 7u);
    plain->kd[lane] = scene->materials[shape->material].kd;
    plain->light[lane] = light->a;
    plain->flat_quad[lane] = light->kind == RT_LIGHT_QUAD ? 1.0f : 0.0f;
    plain->both[lane] = light->flags & RT_LIGHT_TWO_SIDED ? 1.0f : 0.0f;
    return true;
}

/* Fills the lanes that no plain vertex took with what one of them has, so that all can be read. */
static inline void plain_fill(struct plain *plain, uint taken)
{
    const uint first = lane_first(taken);
    for (uint i = 0u; i < 8u; i++) {
        const uint from = taken >> i & 1u ? i : first;
        plain->corner[i] = plain->corner[from];
        plain->kd[i] = plain->kd[from];
        plain->light[i] = plain->light[from];
        plain->flat_quad[i] = plain->flat_quad[from];
        plain->both[i] = plain->both[from];
    }
}

/* As triangle_surface. */
static inline struct plain_surface plain_surface_at(const struct plain *plain, const struct path *paths,
                                                    const struct hit *hits)
{
    const uint row = RT_BVH_WIDTH, vertex = 3u * RT_BVH_WIDTH;
    const float8 u = lanes_load(&hits[0].u, sizeof(struct hit) / 4u);
    const float8 v = lanes_load(&hits[0].v, sizeof(struct hit) / 4u);
    const struct lanes3 direction = lanes3_load((const float *)&paths[0].ray.direction, sizeof(struct path) / 4u);
    const struct lanes3 v0 = lanes3_gather(plain->corner, 0u, row);
    const struct lanes3 e1 = sub8(lanes3_gather(plain->corner, vertex, row), v0);
    const struct lanes3 e2 = sub8(lanes3_gather(plain->corner, 2u * vertex, row), v0);
    struct plain_surface surface;
    surface.position = along8(along8(v0, u, e1), v, e2);

    const struct lanes3 across = cross8(e1, e2);
    const float8 twice_area = length8(across);
    const struct lanes3 normal = scale8(1.0f / twice_area, across);
    const struct lanes3 reach = add8(fabs8(v0), add8(fabs8(e1), fabs8(e2)));
    const float8 size = length8(e1) + length8(e2);
    const float8 sliver = lane_min(size * size / twice_area, (float8)(64.0f));
    surface.error = gamma_bound(4.0f) * dot8(reach, fabs8(normal)) + gamma_bound(2.0f) * size * sliver;
    surface.normal = scale8(dot8(direction, normal) > 0.0f ? (float8)(-1.0f) : (float8)(1.0f), normal);
    return surface;
}

/* As connect_light, with a point by area; `weight` is that of the path, kd that of the surface. */
static inline void plain_connect(const struct plain *plain, const struct plain_surface *surface,
                                 struct lanes3 weight, struct lanes3 kd, const float8 *numbers, uint taken,
                                 struct connection *connections)
{
    const struct lanes3 a = lanes3_gather(plain->light, 0u, 1u);
    const struct lanes3 b = lanes3_gather(plain->light, 4u, 1u), c = lanes3_gather(plain->light, 8u, 1u);
    const struct lanes3 normal = lanes3_gather(plain->light, 12u, 1u);
    const struct lanes3 emission = lanes3_gather(plain->light, 16u, 1u);
    const float8 width = lanes_gather(plain->light, 7u), height = lanes_gather(plain->light, 11u);
    const float8 area = lanes_gather(plain->light, 15u), pmf = lanes_gather(plain->light, 19u);
    const float8 flat_quad = vload8(0, plain->flat_quad), both = vload8(0, plain->both);

    /* Sample a point of the light. */
    const float8 u = lanes_load((const float *)numbers, 8u), v = lanes_load((const float *)numbers + 1, 8u);
    const float8 fold = flat_quad > 0.0f ? (float8)(0.0f) : 0.5f * lane_min(u, v);
    const struct lanes3 on_light = along8(along8(a, (u - fold) * width, b), (v - fold) * height, c);
    const float8 size = fabs(a.x) + fabs(a.y) + fabs(a.z) + 2.0f * (width + height);
    const float8 above = dot8(sub8(surface->position, a), normal);
    const float8 lift = copysign(gamma_bound(8.0f) * size, above);

    /* Weigh it by the power heuristic. */
    const struct lanes3 towards = sub8(on_light, surface->position);
    const float8 d2 = dot8(towards, towards), distance = sqrt(d2);
    const float8 spread = fabs(dot8(towards, normal)) * area / (d2 * distance * pmf);
    const float8 cosine = dot8(towards, surface->normal) / distance;
    const float8 pdf_w = lane_max(cosine, (float8)(0.0f)) * (1.0f / RT_PI);
    const float8 ratio = pdf_w * spread;
    const float8 lit = above > 0.0f || both > 0.0f ? pdf_w * spread / (1.0f + ratio * ratio) : (float8)(0.0f);
    const struct lanes3 radiance = mul8(scale8(lit, weight), mul8(kd, emission));

    /* Ask for what is in between. */
    const struct lanes3 origin = along8(surface->position, surface->error, surface->normal);
    const struct lanes3 direction = sub8(along8(on_light, lift, normal), origin);
    float3 origins[8], directions[8], radiances[8];
    lanes3_rows(origin, origins);
    lanes3_rows(direction, directions);
    lanes3_rows(radiance, radiances);
    for (uint i = 0u; i < 8u; i++)
        if (taken >> i & 1u) {
            connections[i].ray = make_ray(origins[i], directions[i], 0.0f, 0.9999f);
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
    const float8 s = angle + angle * a2 * (-1.6666654611e-1f + a2 * (8.3321608736e-3f + a2 * -1.9515295891e-4f));
    const float8 c = 1.0f - 0.5f * a2 + a2 * a2 * (4.166664568298827e-2f + a2 * (-1.388731625493765e-3f + a2 * 2.443315711809948e-5f));
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
static inline void plain_scatter(const struct plain_surface *surface, struct lanes3 beta, struct lanes3 kd,
                                 const float8 *numbers, uint taken, struct path *paths)
{
    const float *first = (const float *)numbers;
    struct lanes3 kept = mul8(beta, kd);
    const float8 depth = lanes_load((const float *)&paths[0].depth, sizeof(struct path) / 4u);
    const float8 chance = lane_min(largest8(kept), (float8)(1.0f));
    const float8 survival = as_int8(depth) <= (int)RT_ROULETTE_VERTEX ? (float8)(1.0f) : chance;
    kept = scale8(1.0f / survival, kept);
    const struct lanes3 way = sample_cosine8(lanes_load(first + 4, 8u), lanes_load(first + 5, 8u));
    const struct lanes3 wi = frame_to_world8(surface->normal, way);
    const struct lanes3 origin = along8(surface->position, surface->error, surface->normal);
    const uint going = lane_mask(lanes_load(first + 6, 8u) < survival && way.z > 0.0f &&
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

/* Takes the paths whose bits are set in `taken` through their plain vertices. */
INLINE_NEVER void plain_vertices(struct plain *plain, uint taken, struct path *paths, const struct hit *hits,
                                 const float8 *numbers, struct connection *connections)
{
    const uint stride = sizeof(struct path) / 4u;
    plain_fill(plain, taken);
    const struct plain_surface surface = plain_surface_at(plain, paths, hits);
    const struct lanes3 beta = lanes3_load((const float *)&paths[0].beta, stride);
    const struct lanes3 weight = scale8(lanes_load(&paths[0].squeeze, stride), beta);
    const struct lanes3 kd = lanes3_gather(plain->kd, 0u, 1u);
    plain_connect(plain, &surface, weight, kd, numbers, taken, connections);
    plain_scatter(&surface, beta, kd, numbers, taken, paths);
}

#endif
