/*
 * vcm_sums.cl - follows paths through a scene as mode vcm does, and takes the weights of all
 * techniques that could have made each of them, by the functions that the kernels of the mode use.
 * Vertices of light paths go through the store where that is asked for.
 */
#include "entry.h"
#include "vcm/camera_path.h"
#include "vcm/light_path.h"

#define LONGEST 6

/* A vertex of a camera path; those of delta events are passed by one lobe alone. */
struct station {
    struct vertex vertex;
    struct surface surface;
    global rt_light_vertex *store;  /* where it is put as one of a light path, or NULL */
    struct vcm_camera_path arrived; /* with the weights to here */
    float3 wi;                      /* in which the path goes on, */
    float distance;                 /* and how far */
    uint lobe;
    bool is_delta;
};

/* Where a whole path ends at a light. */
struct light_end {
    uint light;
    struct surface at; /* of the environment: its direction is the normal */
    float distance;
    bool is_delta, distant;
};

/* The weights of all techniques that make a path together, and how many these are. */
struct sum {
    float weights;
    float techniques;
    bool grazes; /* a surface, so that its weights are those of a cosine of RT_GRAZING */
};

static void add(struct sum *sum, float weight)
{
    sum->weights += weight;
    sum->techniques += 1.0f;
}

/* The vertex as a path from the light has it, that comes along -wi. */
static struct vertex seen_from_light(const struct scene *scene, const struct vertex *vertex,
                                     float3 wi)
{
    struct vertex other = *vertex;
    make_bsdf_back(&other.bsdf, scene, vertex, wi);
    if (vertex_crosses(vertex, wi)) {
        other.params.shading = -vertex->params.shading;
        other.medium = vertex->beyond.x;
        other.beyond.x = other.behind = vertex->medium;
    }
    return other;
}

/* A vertex of a light path with its weights, as connections and merging take it. */
struct stored {
    struct vertex vertex;
    struct partial_weights partial;
    float3 wo;
};

static struct stored through_store(const struct scene *scene, const struct station *station,
                                   const struct vcm_light_path *path, const struct vertex *vertex)
{
    struct stored stored = {*vertex, path->partial, vertex->bsdf.wo};
    if (!station->store)
        return stored;
    store_vertex(station->store, scene, vertex, &station->surface, (float3)(1.0f), &path->partial,
                 path->depth);
    load_vertex(&stored.vertex, scene, station->store);
    stored.partial = stored_weights(station->store);
    stored_normal(station->store, &stored.wo);
    return stored;
}

static uint used_by(const struct technique_weights *all, uint technique)
{
    return all->techniques & technique;
}

/* Goes on from a vertex of the light path to the one before it on the camera path, along wi. */
static void go_back(struct vcm_light_path *path, const struct vcm_scene *vcm,
                    const struct station *station, const struct vertex *from, float3 wi)
{
    if (station->is_delta) {
        scatter_delta_weights(&path->partial, grazing_cosine(from->bsdf.wo, from->bsdf.normal),
                              delta_ratio(&vcm->scene, from, station->lobe, wi));
    } else {
        const struct scattering s = bidir_eval(&vcm->scene, from, wi);
        scatter_weights(&path->partial, &vcm->all,
                        used_dVCM(&vcm->all, &path->partial, path->depth == 1u, RT_TECHNIQUE_NEE),
                        fabs(dot(wi, from->bsdf.normal)), s.pdf_w, s.back_pdf_w);
    }
    path->straight = false;
    path->depth++;
}

/* The technique that joins a vertex with the next one, of the light path. */
static void add_joins(struct sum *sum, const struct vcm_scene *vcm, const struct station *here,
                      uint depth, uint light_depth, const struct stored *light)
{
    const struct technique_weights *all = &vcm->all;
    const float used = used_dVCM(all, &here->arrived.partial, depth == 1u, RT_TECHNIQUE_CAMERA);
    const float light_used = used_dVCM(all, &light->partial, light_depth == 1u, RT_TECHNIQUE_NEE);
    const float3 wi = here->wi;
    const float d2 = square(here->distance);
    const struct scattering s = bidir_eval(&vcm->scene, &here->vertex, wi),
                            there = bidir_eval(&vcm->scene, &light->vertex, -wi);
    add(sum, joined_weight(&here->arrived, vcm, used, &light->partial, light_used, &s,
                           there.pdf_w * fabs(dot(wi, here->vertex.bsdf.normal)) / d2, &there,
                           s.pdf_w * fabs(dot(wi, light->vertex.bsdf.normal)) / d2));
}

/* The techniques that end with light paths of one vertex or more. */
static void add_light_paths(struct sum *sum, const struct vcm_scene *vcm, const rt_params *params,
                            const struct station *stations, uint last, const struct light_end *end)
{
    const struct scene *scene = &vcm->scene;
    struct vcm_light_path path;
    const struct vertex *first = &stations[last].vertex;
    float3 wi = stations[last].wi;
    path.light = end->light;
    path.pmf = vcm->shares[end->light].pmf;
    path.start = end->at;
    path.direction = -wi;
    path.straight = true;
    path.depth = 1u;
    begin_weights(&path, scene, &vcm->all, first->position, end->distance,
                  fabs(dot(wi, first->bsdf.normal)));
    for (uint i = last; i >= 1u; i--) {
        const struct station *here = stations + i;
        const struct vertex vertex = seen_from_light(scene, &here->vertex, wi);
        const float light_used =
            used_dVCM(&vcm->all, &path.partial, path.depth == 1u, RT_TECHNIQUE_NEE);
        const struct stored stored = through_store(scene, here, &path, &vertex);
        if (!here->is_delta && used_by(&vcm->all, RT_TECHNIQUE_MERGING)) {
            const float used =
                used_dVCM(&vcm->all, &here->arrived.partial, i == 1u, RT_TECHNIQUE_CAMERA);
            const struct scattering s = bidir_eval(scene, &here->vertex, stored.wo);
            add(sum, merged_weight(&here->arrived, vcm, used, &stored.partial, light_used, &s));
        }
        if (i == 1u) {
            const float3 w = here->vertex.bsdf.wo;
            const float distance = length(here->vertex.position - here->arrived.eye.from);
            const float pdf_a = camera_pdf_a(&scene->header->camera, params, -w, distance) *
                                fabs(dot(w, vertex.bsdf.normal));
            const struct scattering s = bidir_eval(scene, &vertex, w);
            if (!here->is_delta && used_by(&vcm->all, RT_TECHNIQUE_CAMERA))
                add(sum, camera_weight(&vcm->all, &path, pdf_a, s.back_pdf_w));
            return;
        }
        const struct station *next = stations + i - 1u;
        if (!here->is_delta && !next->is_delta && used_by(&vcm->all, RT_TECHNIQUE_CONNECTION))
            add_joins(sum, vcm, next, i - 1u, path.depth, &stored);
        wi = next->wi;
        go_back(&path, vcm, here, &vertex, -wi);
        arrive_weights(&path.partial, &vcm->all, next->distance,
                       fabs(dot(wi, next->vertex.bsdf.normal)));
    }
}

/* The two techniques of a camera path alone: light sampling, and meeting the emitter. */
static void add_camera_paths(struct sum *sum, const struct vcm_scene *vcm,
                             const struct station *stations, uint last, const struct light_end *end,
                             const struct light_sample *sample)
{
    const struct station *here = stations + last;
    const float used =
        used_dVCM(&vcm->all, &here->arrived.partial, last == 1u, RT_TECHNIQUE_CAMERA);
    struct vcm_camera_path path = here->arrived;
    if (here->is_delta) {
        scatter_delta_weights(&path.partial,
                              grazing_cosine(here->vertex.bsdf.wo, here->vertex.bsdf.normal),
                              delta_ratio(&vcm->scene, &here->vertex, here->lobe, here->wi));
        path.eye.pdf_w = 0.0f;
    } else {
        const struct scattering s = bidir_eval(&vcm->scene, &here->vertex, here->wi);
        if (used_by(&vcm->all, RT_TECHNIQUE_NEE))
            add(sum, sampled_light_weight(&path, vcm, &here->vertex, used, end->light, sample, &s));
        scatter_weights(&path.partial, &vcm->all, used,
                        fabs(dot(here->wi, here->vertex.bsdf.normal)), s.pdf_w, s.back_pdf_w);
        path.eye.pdf_w = s.pdf_w;
    }
    path.eye.from = here->vertex.position;
    if (!used_by(&vcm->all, RT_TECHNIQUE_EMISSION) || end->is_delta)
        return;
    if (end->distant) {
        add(sum, sky_weight(&path, vcm, here->wi));
        return;
    }
    arrive_weights(&path.partial, &vcm->all, end->distance,
                   grazing_cosine(here->wi, end->at.normal));
    add(sum, emitter_weight(&path, vcm, end->light, &end->at, -here->wi));
}

/* All techniques of the path through stations 1 to `last` to a light. */
static struct sum weigh(const struct vcm_scene *vcm, const rt_params *params,
                        const struct station *stations, uint last, const struct light_end *end,
                        const struct light_sample *sample)
{
    struct sum sum = {0.0f, 0.0f, false};
    for (uint i = 1u; i <= last; i++) {
        const struct vertex *here = &stations[i].vertex;
        sum.grazes |= fabs(dot(here->bsdf.wo, here->bsdf.normal)) < RT_GRAZING ||
                      fabs(dot(stations[i].wi, here->bsdf.normal)) < RT_GRAZING;
    }
    sum.grazes |= !end->is_delta && fabs(dot(stations[last].wi, end->at.normal)) < RT_GRAZING;
    add_camera_paths(&sum, vcm, stations, last, end, sample);
    add_light_paths(&sum, vcm, params, stations, last, end);
    return sum;
}

/* A path that meets an emitter or the sky, as light sampling would have drawn it. */
static struct sum weigh_met(const struct vcm_scene *vcm, const rt_params *params,
                            const struct station *stations, uint last, const struct light_end *end)
{
    const struct scene *scene = &vcm->scene;
    const float3 from = stations[last].vertex.position;
    struct light_sample sample;
    sample.delta = false;
    sample.distant = end->distant;
    sample.wi = stations[last].wi;
    sample.at = end->at;
    sample.inv_pdf =
        1.0f / (end->distant ? environment_light_pdf_w(scene, from, sample.wi)
                             : light_pdf_w(scene, scene->lights + end->light, from, &end->at));
    return weigh(vcm, params, stations, last, end, &sample);
}

/* A path that a sampled light completes; none where the light does not reach the vertex. */
static struct sum weigh_sampled(const struct vcm_scene *vcm, const rt_params *params,
                                struct station *stations, uint last, float4 u)
{
    const struct scene *scene = &vcm->scene;
    const struct sum none = {0.0f, 0.0f, false};
    struct station *here = stations + last;
    struct light_sample sample;
    struct light_end end;
    float pmf;
    end.light = choose_light(scene, here->vertex.position, u.z, &pmf);
    if (pmf == 0.0f ||
        !sample_chosen(scene, scene->lights + end.light, here->vertex.position, u.xy, &sample))
        return none;
    sample.inv_pdf /= pmf;
    const struct scattering s = bidir_eval(scene, &here->vertex, sample.wi);
    const struct ray ray = shadow_ray(vertex_leave(&here->vertex, sample.wi), &sample);
    if (!(s.pdf_w > 0.0f) || !(largest3(sample.radiance) > 0.0f) || occluded(scene, &ray))
        return none;
    here->wi = sample.wi;
    here->is_delta = false;
    end.at = sample.at;
    end.is_delta = sample.delta;
    end.distant = sample.distant;
    end.distance = sample.distant ? 1.0f : length(sample.at.position - here->vertex.position);
    return weigh(vcm, params, stations, last, &end, &sample);
}

/* A light that the camera sees is found by meeting it alone. */
static struct sum weigh_seen(const struct vcm_scene *vcm, float weight)
{
    struct sum sum = {0.0f, 0.0f, false};
    if (used_by(&vcm->all, RT_TECHNIQUE_EMISSION))
        add(&sum, weight);
    return sum;
}

/* The path that ends where the camera path escapes. */
static struct sum weigh_sky(const struct vcm_scene *vcm, const rt_params *params,
                            const struct vcm_camera_path *path, const struct station *stations,
                            uint last, float3 w)
{
    const struct sum none = {0.0f, 0.0f, false};
    struct light_end end;
    if (!has_environment(&vcm->scene))
        return none;
    if (last == 0u)
        return weigh_seen(vcm, sky_weight(path, vcm, w));
    end.light = vcm->scene.environment->light;
    end.is_delta = false;
    end.distant = true;
    end.distance = 1.0f;
    end.at.position = stations[last].vertex.position;
    end.at.normal = -w;
    return weigh_met(vcm, params, stations, last, &end);
}

/* The path that ends at this surface, if that emits. */
static struct sum weigh_surface(const struct vcm_scene *vcm, const rt_params *params,
                                const struct vcm_camera_path *path, const struct station *stations,
                                uint last, const struct surface *surface, float3 wo)
{
    const struct sum none = {0.0f, 0.0f, false};
    struct light_end end;
    end.light = surface_light(&vcm->scene, surface);
    if (end.light == RT_NONE ||
        !(largest3(light_radiance(&vcm->scene, vcm->scene.lights + end.light, surface, wo)) > 0.0f))
        return none;
    if (last == 0u)
        return weigh_seen(vcm, emitter_weight(path, vcm, end.light, surface, wo));
    end.is_delta = false;
    end.distant = false;
    end.distance = length(surface->position - stations[last].vertex.position);
    end.at = *surface;
    return weigh_met(vcm, params, stations, last, &end);
}

static void put(global float2 *out, struct sum sum)
{
    *out = (float2)(sum.weights, sum.grazes ? -sum.techniques : sum.techniques);
}

/* Extends a path that is alive by its next vertex; sums: of the item. */
static void extend(struct vcm_camera_path *path, const struct vcm_scene *vcm,
                   const rt_params *params, struct station *stations, global float2 *sums)
{
    const uint depth = path->eye.depth;
    const float8 u = path_numbers(&path->eye);
    const float3 wo = -path->eye.ray.direction;
    struct station *here = stations + depth;
    struct hit hit;
    path->eye.alive = closest_hit(&vcm->scene, &path->eye.ray, &hit);
    if (!path->eye.alive) {
        put(sums + 2u * depth - 1u, weigh_sky(vcm, params, path, stations, depth - 1u, -wo));
        return;
    }
    struct meeting met;
    meet_surface(&met, &vcm->scene, &path->eye.ray, &hit, path->eye.media);
    stations[depth - 1u].distance = hit.t;
    arrive(path, vcm, &met.surface, hit.t);
    put(sums + 2u * depth - 1u,
        weigh_surface(vcm, params, path, stations, depth - 1u, &met.surface, wo));
    path->eye.alive = met.boundary.exists && depth < LONGEST;
    if (!path->eye.alive)
        return;
    make_bidir_vertex(&here->vertex, &vcm->scene, &met, path->eye.media.x, CARRY_RADIANCE);
    here->surface = met.surface;
    here->arrived = *path;
    if (vertex_connects(&here->vertex))
        put(sums + 2u * depth, weigh_sampled(vcm, params, stations, depth, u.lo));
    const float used = used_dVCM(&vcm->all, &path->partial, depth == 1u, RT_TECHNIQUE_CAMERA);
    here->lobe = bsdf_choose(&here->vertex.bsdf, 1.0f, u.hi.z);
    scatter_camera_path(path, vcm, &here->vertex, used, u.hi);
    here->wi = path->eye.ray.direction;
    here->is_delta = path->eye.pdf_w == 0.0f;
}

/*
 * One camera path an item, without Russian roulette; of each of its vertices two paths to lights,
 * one that it meets there and one that a sampled light completes. sums: [items][LONGEST][2], a path
 * of n segments in row n - 1: the sum of its weights, and how many techniques make it, negative
 * where it grazes a surface; 0: there is no path. stores: [items], used if is_stored says so.
 */
KERNEL vcm_sums(const rt_params params, global const rt_scene_header *header,
                const rt_vcm_params given, global const rt_light_share *shares, uint is_stored,
                global rt_light_vertex *stores, global float2 *sums)
{
    const uint item = item_number(), pixels = params.width * params.height;
    if (item >= params.item_count)
        return;
    const struct vcm_scene vcm = {scene_open(header), &params, technique_weights_of(&given), shares,
                                  given.radius,       0u};
    const uint pixel = item % pixels;
    const uint2 at = (uint2)(pixel % params.width, pixel / params.width);
    const struct sampler sampler = sampler_start(&vcm.scene, &params, pixel, item / pixels);
    struct station stations[LONGEST + 1];
    for (uint i = 0u; i <= LONGEST; i++)
        stations[i].store = is_stored ? stores + item : 0;
    struct vcm_camera_path path;
    float weight;
    begin_camera_path(&path, &vcm, &sampler, pixel_ray(&vcm.scene, &params, &sampler, at, &weight),
                      square(vcm.radius), 0);
    for (uint i = 0u; i < 2u * LONGEST; i++)
        sums[item * 2u * LONGEST + i] = (float2)(0.0f);
    while (path.eye.alive)
        extend(&path, &vcm, &params, stations, sums + item * 2u * LONGEST);
}
