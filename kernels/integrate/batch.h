/*
 * batch.h - a vectorised path integrator: eight paths at a time, whose vertices on common surfaces
 * (surface/vertex_batch.h) are shaded together, one path per lane. In photon mapping, those are the
 * gather points at which paths end, of SIMPLE surfaces alone.
 *
 * Most vertices of most scenes lie on such surfaces, outside of all solids. There path_vertex comes
 * down to a light sample, roulette and a direction. These are done here by the same code (*.inc.h),
 * included a second time at width 8: the same estimate from the same random numbers, equal but for
 * rounding, with hardly a branch. Flat triangles and parallelograms, and flat lights sampled by
 * area, are handled in lanes; other surfaces and lights are evaluated one by one. All other
 * vertices go to path_vertex itself. Lanes are independent, so a path's result does not depend on
 * the other paths; lanes without a path hold undefined values.
 *
 * path.cl and photon_camera.cl include this file where RT_WIDTH is 8. Without it the scalar
 * integrator serves.
 */
#ifndef RT_KERNELS_INTEGRATE_BATCH_H
#define RT_KERNELS_INTEGRATE_BATCH_H

#include "integrate/path.h"
#include "surface/vertex_batch.h"
#include "math/width8.inc.h"
#include "sample/rng_lanes.h"
#include "sample/triangle.inc.h"
#define ANGLES float8
#define ANGLE_TESTS int8
#define ANGLE(name) name##_x8
#include "sample/angle.inc.h"
#include "sample/rectangle.inc.h"
#include "light/area.inc.h"
#include "sample/roulette.inc.h"

/* ---- Numbers ----------------------------------------------------------------------- */

/* As path_numbers, of all paths; those of lanes without one may be anything. */
static inline void draw_numbers(struct numbers_x8 *numbers, const struct path *paths)
{
    uint4 keys[8];
    for (uint i = 0u; i < 8u; i++)
        keys[i] = paths[i].sampler.key;
    const struct words_x8 key = words_of(keys);
    const uint8 index = LANES_OF(uint8, paths, .sampler.index);
    const uint8 set = 2u * LANES_OF(uint8, paths, .depth);
    sampler_sets(numbers->row, paths[0].sampler.sobol, &key, index, set);
    sampler_sets(numbers->row + 4, paths[0].sampler.sobol, &key, index, set + 1u);
}

/* ---- Vertices ------------------------------------------------------------------ */

/*
 * Whether lanes do what paths of this purpose do at a vertex: they estimate by MIS, and gather
 * photons where the path ends alone.
 */
static inline bool lanes_serve(const struct path *path, const rt_params *params, const uint purpose)
{
    return purpose == FOLLOW_TO_GATHER ? ends_at_gather_point(path, params, purpose)
                                       : params->estimator == RT_ESTIMATOR_MIS;
}

/* The shapes that lanes shade, SIMPLE ones and, where paths scatter, MIXED ones. */
static inline uint served_shapes(const uint purpose)
{
    return purpose == FOLLOW_TO_GATHER ? RT_SHAPE_SIMPLE : RT_SHAPE_SIMPLE | RT_SHAPE_MIXED;
}

/*
 * Collects a path's vertex if lanes shade what is met there, which emits nothing; where the path
 * could collect such light alone, ends it.
 */
static inline bool collect_vertex(struct vertex_batch *batch, uint lane, const struct scene *scene,
                                  const rt_params *params, struct path *path, const struct hit *hit,
                                  const uint purpose)
{
    const uint served = served_shapes(purpose);
    global const rt_shape *shape = scene->shapes + scene->prim_shape[hit->prim];
    if (!(shape->flags & served) || path->media.x != RT_NONE || path->depth == params->max_depth)
        return false;
    if (UNLIKELY(shape->flags & RT_SHAPE_TOUCHES) && is_shared(scene, &path->ray, hit))
        return false;
    if (purpose == FOLLOW_DIRECT && path->scattered) {
        path->alive = (shape->flags & RT_SHAPE_BACKED) != 0u; /* the back may emit */
        return !path->alive;
    }
    const bool is_mixed = (shape->flags & served & RT_SHAPE_MIXED) != 0u;
    return collect_surface(batch, lane, scene, shape, &path->ray, hit, is_mixed);
}

/* ---- Direct light -------------------------------------------------------------- */

/* The lights that are chosen for the vertices. */
struct chosen_lights {
    global const rt_light_data *light[8]; /* those that are sampled in lanes */
    float pmf[8];                         /* of the choice */
    struct light_sample samples[8];       /* the others */
    uint flat;                            /* a bit for each lane whose light is sampled in lanes, */
    uint single;                          /* those that have a sample, */
    uint delta;                           /* and of these the delta lights */
};

/* Points on lights, as the lanes' vertices see them. */
struct light_sample_x8 {
    struct vec3_x8 wi, radiance;
    struct vec3_x8 target; /* on the light, off its surface by its error */
    float8 inv_pdf;        /* as in light_sample; 0 where nothing can arrive */
};

/* Chooses a light for each vertex, and samples those that lanes do not. */
static inline void choose_lights(struct chosen_lights *lights, const struct scene *scene,
                                 uint wanted, struct vec3_x8 from, const struct numbers_x8 *numbers)
{
    float3 positions[8];
    vec3_x8_rows(from, positions);
    lights->flat = lights->single = lights->delta = 0u;
    if (scene->light_nodes[1].weight == 0.0f)
        return;
    for (; wanted; wanted &= wanted - 1u) {
        const uint i = lane_first(wanted), bit = 1u << i;
        const float4 u = set_of_lane(numbers->row, i);
        const uint chosen = choose_light(scene, positions[i], u.z, &lights->pmf[i]);
        global const rt_light_data *light = scene->lights + chosen;
        if (light->flags & RT_LIGHT_PLAIN) {
            lights->light[i] = light;
            lights->flat |= bit;
        } else if (sample_chosen(scene, light, positions[i], u.xy, &lights->samples[i])) {
            lights->single |= bit;
            lights->delta |= lights->samples[i].delta ? bit : 0u;
        }
    }
}

/* As see_rectangle. */
static inline struct seen_rectangle_x8 see_rectangles(float8 x0, float8 y0, float8 z, float8 width,
                                                      float8 height)
{
    struct seen_rectangle_x8 seen = {x0, x0 + width, y0, y0 + height, z};
    const float8 left = corner_angles_x8(seen.y1, -seen.x0, z),
                 below = corner_angles_x8(-seen.x0, -seen.y0, z);
    seen.turn = left + below;
    seen.solid_angle =
        corner_angles_x8(-seen.y0, seen.x1, z) + corner_angles_x8(seen.x1, seen.y1, z) + seen.turn;
    return seen;
}

/*
 * Samples the lights that are rectangles and near enough by solid angle, as sample_area_light does:
 * changes lengths along their edges and, which is 0 elsewhere, *solid_angle.
 */
static inline void sample_rectangles(struct vec2_x8 *lengths, float8 *solid_angle,
                                     const struct flat_light_x8 *flat, int8 is_rectangle,
                                     struct vec3_x8 from, float8 height, struct vec2_x8 u)
{
    const struct vec3_x8 corner = sub_x8(flat->corner, from);
    const float8 x = dot_x8(corner, flat->edge1), y = dot_x8(corner, flat->edge2);
    const int8 is_near =
        is_rectangle && is_near_rectangle_x8(x, y, height, flat->width, flat->height);
    *solid_angle = 0.0f;
    if (!lane_mask(is_near))
        return;
    const struct seen_rectangle_x8 seen =
        see_rectangles(x, y, fabs(height), flat->width, flat->height);
    const int8 is_seen = is_near && seen.solid_angle >= RT_SMALL_SOLID_ANGLE;
    const struct vec2_x8 sampled = sample_seen_rectangle_x8(&seen, u);
    lengths->x = is_seen ? sampled.x : lengths->x;
    lengths->y = is_seen ? sampled.y : lengths->y;
    *solid_angle = is_seen ? seen.solid_angle : *solid_angle;
}

/* Samples flat lights, as sample_chosen does. */
static inline struct light_sample_x8 sample_flat_lights(global const rt_light_data *const lights[8],
                                                        struct vec3_x8 from,
                                                        const struct numbers_x8 *numbers)
{
    const struct flat_light_x8 flat = {
        VEC3_X8_OF_ROW(lights, ->a), VEC3_X8_OF_ROW(lights, ->b), VEC3_X8_OF_ROW(lights, ->c),
        LANES_OF(float8, lights, ->width), LANES_OF(float8, lights, ->height)};
    const struct vec3_x8 normal = VEC3_X8_OF_ROW(lights, ->normal),
                         emission = VEC3_X8_OF_ROW(lights, ->emission);
    const uint8 kind = LANES_OF(uint8, lights, ->kind), flags = LANES_OF(uint8, lights, ->flags);
    const struct vec2_x8 u = {numbers->row[0], numbers->row[1]};
    const struct vec2_x8 folded = sample_triangle_x8(u);
    const int8 quad = kind == RT_LIGHT_QUAD;
    struct vec2_x8 lengths = {(quad ? u.x : folded.x) * flat.width,
                              (quad ? u.y : folded.y) * flat.height};
    const float8 height = dot_x8(sub_x8(from, flat.corner), normal);
    float8 solid_angle;
    sample_rectangles(&lengths, &solid_angle, &flat, (flags & RT_LIGHT_RECTANGLE) != 0u, from,
                      height, u);
    const struct vec3_x8 point = flat_light_point_x8(&flat, lengths);
    const struct vec3_x8 towards = sub_x8(point, from);
    const float8 error = flat_light_error_x8(&flat);
    const int8 lit = height > 0.0f || (flags & RT_LIGHT_TWO_SIDED) != 0u;
    const float8 inv_pdf = solid_angle > 0.0f
                               ? solid_angle
                               : area_inv_pdf_x8(LANES_OF(float8, lights, ->area), towards, normal);
    struct light_sample_x8 sample;
    sample.wi = scale_x8(1.0f / length_x8(towards), towards);
    sample.radiance = emission;
    sample.target = along_x8(point, height < 0.0f ? -error : error, normal);
    sample.inv_pdf = lit ? inv_pdf : (float8)(0.0f);
    return sample;
}

/* Copies the lanes of samples that were drawn one by one. */
static inline void take_samples(struct light_sample_x8 *sample, const struct chosen_lights *lights)
{
    const struct vec3_x8 wi = VEC3_X8_OF(lights->samples, .wi),
                         radiance = VEC3_X8_OF(lights->samples, .radiance);
    const int8 single = lanes_of(lights->single);
    sample->wi = select_x8(single, wi, sample->wi);
    sample->radiance = select_x8(single, radiance, sample->radiance);
    sample->inv_pdf = single ? LANES_OF(float8, lights->samples, .inv_pdf) : sample->inv_pdf;
}

/* Samples the lights that are chosen for the vertices. */
static inline struct light_sample_x8
sample_lights(struct chosen_lights *lights, struct vec3_x8 from, const struct numbers_x8 *numbers)
{
    struct light_sample_x8 sample;
    if (lights->flat) {
        for (uint i = 0u; i < 8u; i++)
            lights->light[i] = lights->light[lane_or_first(lights->flat, i)];
        sample = sample_flat_lights(lights->light, from, numbers);
    }
    if (lights->single)
        take_samples(&sample, lights);
    return sample;
}

/*
 * As connect_light; `weight` is the throughput, `last` holds for all lanes, `lobes` are those of
 * MIXED vertices, NULL where there are none.
 */
static inline void connect_lights(const struct scene *scene, const struct surface_x8 *surface,
                                  uint taken, struct vec3_x8 weight, struct vec3_x8 albedo,
                                  const struct lobes_x8 *lobes, const struct numbers_x8 *numbers,
                                  struct connection *connections, const bool last)
{
    struct chosen_lights lights;
    choose_lights(&lights, scene, taken, surface->position, numbers);
    const struct light_sample_x8 sample = sample_lights(&lights, surface->position, numbers);

    /* Weight the light by MIS against BSDF sampling, except delta lights, and where paths end. */
    const float8 inv_pdf = sample.inv_pdf / vload8(0, lights.pmf);
    const int8 alone = last || lanes_of(lights.delta);
    const struct vec3_x8 radiance =
        light_vertices(surface, lobes, weight, albedo, sample.wi, sample.radiance, inv_pdf, alone);

    /* Hand each path its shadow ray and the light that may arrive along it. */
    const struct vec3_x8 origin = along_x8(surface->position, surface->error, surface->normal);
    float3 origins[8], directions[8], radiances[8];
    vec3_x8_rows(origin, origins);
    vec3_x8_rows(sub_x8(sample.target, origin), directions);
    vec3_x8_rows(radiance, radiances);
    for (uint i = 0u; i < 8u; i++)
        if ((lights.flat | lights.single) >> i & 1u) {
            connections[i].ray = lights.single >> i & 1u
                                     ? shadow_ray(origins[i], &lights.samples[i])
                                     : make_ray(origins[i], directions[i], 0.0f, RT_SHADOW_END);
            connections[i].radiance = radiances[i];
        }
}

/* ---- Roulette and scattering ---------------------------------------------------- */

/* Applies Russian roulette, and scatters the surviving paths as path_scatter. */
static inline void scatter_paths(const rt_params *params, const struct surface_x8 *surface,
                                 struct vec3_x8 beta, struct vec3_x8 albedo,
                                 const struct lobes_x8 *lobes, const struct numbers_x8 *numbers,
                                 uint taken, struct path *paths)
{
    struct scattered_x8 scattered = {.beta = mul_x8(beta, albedo)};
    const float8 survival =
        eye_path_survival_x8(params, LANES_OF(uint8, paths, .depth), scattered.beta);
    scatter_vertices(&scattered, surface, lobes, beta, survival, numbers);
    const struct vec3_x8 origin = along_x8(surface->position, surface->error, surface->normal);
    const uint alive = lane_mask(numbers->row[6] < survival && scattered.leaves &&
                                 largest_x8(scattered.beta) > 0.0f);

    float3 origins[8], directions[8], positions[8], betas[8];
    float pdf_w[8];
    vec3_x8_rows(origin, origins);
    vec3_x8_rows(scattered.wi, directions);
    vec3_x8_rows(surface->position, positions);
    vec3_x8_rows(scattered.beta, betas);
    vstore8(scattered.pdf_w, 0, pdf_w);
    for (uint i = 0u; i < 8u; i++)
        if (taken >> i & 1u) {
            paths[i].ray = make_ray(origins[i], directions[i], 0.0f, INFINITY);
            paths[i].from = positions[i];
            paths[i].beta = betas[i];
            paths[i].pdf_w = pdf_w[i];
            paths[i].scattered |= !lobes || pdf_w[i] > 0.0f;
            paths[i].rough = false;
            DISPERSED(paths[i].wavelength = !lobes || pdf_w[i] > 0.0f ? 0.0f : paths[i].wavelength);
            paths[i].depth++;
            paths[i].alive = alive >> i & 1u;
        }
}

/* ---- Gather points ---------------------------------------------------------------- */

/* Ends paths at gather points, as add_gather_point; weight: their throughput. */
static inline void end_paths(const struct scene *scene, const struct vertex_batch *batch,
                             const struct surface_x8 *surface, struct vec3_x8 weight,
                             const struct hit *hits, struct path *paths,
                             const struct gather *gathers)
{
    float3 positions[8], normals[8], shadings[8], weights[8];
    vec3_x8_rows(surface->position, positions);
    vec3_x8_rows(surface->normal, normals);
    vec3_x8_rows(surface->shading, shadings);
    vec3_x8_rows(weight, weights);
    for (uint left = batch->taken; left; left &= left - 1u) {
        const uint i = lane_first(left);
        const uint material = scene->shapes[scene->prim_shape[hits[i].prim]].material;
        set_simple_point(gathers[i].point, positions[i], normals[i], shadings[i],
                         -paths[i].ray.direction, batch->albedo[i], material, weights[i]);
        paths[i].diffuse_events++;
        paths[i].alive = false;
    }
}

/* ---- Paths ----------------------------------------------------------------------- */

/*
 * Shades the collected vertices, and extends their paths or ends them at gather points. One text
 * serves batches with and without MIXED ones: with a text for each, paths take 4 % longer to
 * compile and no less to follow.
 */
INLINE_NEVER void shade_vertices(const struct scene *scene, const rt_params *params,
                                 struct vertex_batch *batch, struct path *paths,
                                 const struct hit *hits, const struct numbers_x8 *numbers,
                                 struct connection *connections, const uint purpose,
                                 const struct gather *gathers)
{
    const bool last = purpose == FOLLOW_TO_GATHER;
    const bool is_mixed = purpose != FOLLOW_TO_GATHER && UNLIKELY(batch->mixed.held);
    const struct vec3_x8 direction = VEC3_X8_OF(paths, .ray.direction);
    const struct surface_x8 surface = surfaces_of(batch, direction, hits);
    const struct vec3_x8 beta = VEC3_X8_OF(paths, .beta);
    struct vec3_x8 albedo = VEC3_X8_OF(batch->albedo, );
    struct lobes_x8 lobes;
    if (is_mixed) {
        see_lobes(&lobes, &batch->mixed, &surface, direction, beta, albedo);
        albedo = select_x8(lanes_of(lobes.held), lobes.albedo, albedo);
    }
    const struct vec3_x8 weight = scale_x8(LANES_OF(float8, paths, .eta_scale), beta);
    if (!(last && params->direct == RT_DIRECT_PHOTONS))
        connect_lights(scene, &surface, batch->taken, weight, albedo, is_mixed ? &lobes : 0,
                       numbers, connections, last);
    if (last)
        end_paths(scene, batch, &surface, weight, hits, paths, gathers);
    else
        scatter_paths(params, &surface, beta, albedo, is_mixed ? &lobes : 0, numbers, batch->taken,
                      paths);
}

/*
 * Extends eight paths by a vertex each: the steps of path_extend, each for all paths. Within
 * a step paths are independent, so an out-of-order processor overlaps them. gathers [8] serve
 * FOLLOW_TO_GATHER alone.
 */
static inline void follow_batch(const struct scene *scene, const rt_params *params,
                                struct path *paths, const uint purpose,
                                const struct gather *gathers)
{
    struct hit hits[8];
    struct numbers_x8 numbers;
    struct connection connections[8];

    /* Draw the sample values of the next vertices, and find these. */
    for (uint i = 0u; i < 8u; i++) {
        if (!paths[i].alive)
            continue;
        if (purpose == FOLLOW_TO_GATHER && paths[i].resumes) {
            copy_hit(&hits[i], &gathers[i].fork->hit);
            continue;
        }
        count_path_ray(scene, &paths[i]);
        if (!closest_hit(scene, &paths[i].ray, &hits[i]))
            add_environment(&paths[i], scene, params, purpose);
    }

    draw_numbers(&numbers, paths);

    /* Shade vertices together that lanes serve, the others one by one. */
    struct vertex_batch batch;
    batch.taken = batch.curved = batch.mixed.held = 0u;
    for (uint i = 0u; i < 8u; i++) {
        connections[i].radiance = (float3)(0.0f);
        if (!paths[i].alive)
            continue;
        if (lanes_serve(&paths[i], params, purpose) &&
            collect_vertex(&batch, i, scene, params, &paths[i], &hits[i], purpose))
            continue;
        struct meeting met;
        meet_surface(&met, scene, &paths[i].ray, &hits[i], paths[i].media);
        path_vertex(scene, params, &paths[i], &hits[i], &met, pair_of_lane(&numbers, i),
                    &connections[i], purpose, gathers ? gathers + i : 0);
    }
    if (batch.taken)
        shade_vertices(scene, params, &batch, paths, hits, &numbers, connections, purpose, gathers);

    /* Add the direct light that arrives. */
    for (uint i = 0u; i < 8u; i++)
        add_connection(&paths[i], scene, &connections[i]);
}

#endif
