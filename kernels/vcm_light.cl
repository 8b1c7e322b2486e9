/*
 * vcm_light.cl - light paths of vertex connection and merging: each work-item follows one, stores
 * its vertices, and joins them with the camera.
 *
 * A path has at most max_depth - 1 segments, as one more joins it with the camera. Vertices go to
 * slots of the path's own, so that their order depends on nothing. What they add to pixels is kept
 * in a list for each pixel, which may come in any order: sums of the film are exact.
 */
#include "entry.h"
#include "vcm/light_path.h"

/* Where a path leaves its vertices and what they add to pixels. */
struct light_store {
    global rt_light_vertex *vertices; /* its column */
    global rt_splat *splats;          /* all of them, */
    volatile global uint *heads;      /* and the first of each pixel */
    uint column, slots;
};

/* Puts what a vertex adds to a pixel in front of that pixel's list. */
static inline void add_splat(const struct light_store *store, uint row, uint pixel, float3 radiance)
{
    const uint slot = row * store->slots + store->column;
    global rt_splat *splat = store->splats + slot;
    vstore3(radiance, 0, splat->radiance);
    splat->next = atomic_xchg(store->heads + pixel, slot + 1u);
}

/* Stores a vertex to which this flux comes where it is read, and joins it with the camera. */
static inline void use_vertex(const struct scene *scene, const rt_params *params,
                              const struct technique_weights *all,
                              const struct vcm_light_path *path, const struct surface *surface,
                              const struct vertex *vertex, float3 flux, float4 u, uint row,
                              const struct light_store *store)
{
    if (all->shown & (RT_TECHNIQUE_CONNECTION | RT_TECHNIQUE_MERGING))
        store_vertex(store->vertices + (size_t)row * store->slots, scene, vertex, surface, flux,
                     &path->partial, path->depth);
    uint pixel;
    float3 radiance;
    if ((all->shown & RT_TECHNIQUE_CAMERA) && !is_hidden(scene, surface) &&
        connect_camera(scene, params, all, path, vertex, u, &pixel, &radiance))
        add_splat(store, row, pixel, radiance);
}

/* Follows a path to its end; returns how many vertices it stored. */
INLINE_NEVER uint follow_light_path(struct vcm_light_path *path, const struct scene *scene,
                                    const rt_params *params, const struct technique_weights *all,
                                    const struct sampler *sampler, const struct light_store *store)
{
    uint stored = 0u;
    bool alive = true;
    while (alive && path->depth < params->max_depth) {
        /* Draw the numbers of the next vertex. */
        const float8 u = sampler_pair(sampler, set_light(path->depth - 1u));

        /* Find the nearest surface, and lose what the medium absorbs until there. */
        struct hit hit;
        COUNT(scene, RT_COUNTER_PHOTON, path->ray.direction.x);
        if (!closest_hit(scene, &path->ray, &hit))
            break;
        struct meeting met;
        meet_surface(&met, scene, &path->ray, &hit, path->media);
        path->flux *= medium_transmittance(scene->materials, path->media.x, hit.t);

        /* Skip a boundary suppressed by a medium of higher priority. */
        if (!met.boundary.exists) {
            path->straight = false;
            pass_weights(&path->partial);
            alive = pass_boundary(&path->ray, &path->media, &path->hidden, &met.surface,
                                  met.boundary.beyond);
            continue;
        }

        /* Go on with the partial weights to here. */
        const float cosine = grazing_cosine(met.wo, met.surface.normal);
        if (path->depth == 1u)
            begin_weights(path, scene, all, met.surface.position, hit.t, cosine);
        else
            arrive_weights(&path->partial, all, hit.t, cosine);

        /* Store the vertex and join it with the camera. */
        const float3 flux = path->flux;
        DISPERSED(path->flux *= meet_dispersion(&met, &path->wavelength, scene, path->media.x, flux,
                                                sampler, path->depth - 1u));
        struct vertex vertex;
        make_bidir_vertex(&vertex, scene, &met, path->media.x, CARRY_FLUX);
        if (vertex_receives(&vertex))
            use_vertex(scene, params, all, path, &met.surface, &vertex, flux, u.lo, stored++,
                       store);

        /* Choose an event, or absorption, and go on, unless that vertex would be too far. */
        alive =
            path->depth + 1u < params->max_depth && scatter_path(path, scene, all, &vertex, u.hi);
    }
    return stored;
}

/*
 * shares: [light_count]; vertices: [params.max_depth - 1][vcm.slots], a column a path, of which
 * each fills as many as counts [height * width] then says, and places [item_count]; splats: as
 * vertices; heads: [height][width], 1 + a slot, or 0.
 */
KERNEL vcm_light(const rt_params params, global const rt_scene_header *header,
                 const rt_vcm_params vcm, global const rt_light_share *shares,
                 global rt_light_vertex *vertices, global uint *counts, global uint *places,
                 global rt_splat *splats, volatile global uint *heads)
{
    const uint item = item_number();
    if (item >= params.item_count)
        return;
    const struct scene scene = scene_open(header);
    const struct technique_weights all = technique_weights_of(&vcm);
    rt_params of_light = params;
    of_light.seed = vcm.light_seed;
    const struct sampler sampler = sampler_start(&scene, &of_light, RT_STREAM_PHOTONS,
                                                 vcm.first_path + params.first_item + item);
    const struct light_store store = {vertices + item, splats, heads, item, vcm.slots};
    struct vcm_light_path path;
    uint stored = 0u;
    if (begin_light_path(&path, &scene, shares, &sampler))
        stored = follow_light_path(&path, &scene, &params, &all, &sampler, &store);
    counts[params.first_item + item] = stored;
    places[item] = stored;
}
