/*
 * media_path.h - the path integrator for scenes with media that scatter: estimates the equation of
 * transfer along one camera path.
 *
 *   L(x, w) = T(d) Lo(y, -w) + integral over t from 0 to d of
 *             T(t) sigma_s integral of p(w, wi) L(x + t w, wi) dwi         Chandrasekhar 1960
 *
 * with y the surface at distance d, T the transmittance exp(-sigma_t t), and p the phase function.
 * On each segment a distance is sampled by the transmittance, where the density lies on a grid by
 * delta tracking (volume/grid.h); beyond d, the path goes on to the surface. Surfaces scatter as in
 * path.h; scenes without such media are rendered by that.
 *
 * References:
 *   Chandrasekhar: "Radiative Transfer", 1960.
 */
#ifndef RT_KERNELS_INTEGRATE_MEDIA_PATH_H
#define RT_KERNELS_INTEGRATE_MEDIA_PATH_H

#include "integrate/media_light.h"
#include "integrate/path.h"

/* Eight numbers of the segment under way: the fourth is its equiangular distance. */
static inline float8 segment_numbers(const struct path *path)
{
    return sampler_pair(&path->sampler, set_segment(path->depth + path->hidden));
}

/* Adds what a surface emits towards the path. */
static inline void add_surface_emission(struct media_path *p, const struct scene *scene,
                                        const rt_params *params, const struct meeting *met)
{
    const uint index = surface_light(scene, &met->surface);
    if (index == RT_NONE)
        return;
    global const rt_light_data *light = scene->lights + index;
    const float3 emitted = light_radiance(scene, light, &met->surface, met->wo);
    if (largest3(emitted) <= 0.0f)
        return;
    float ratio = 0.0f;
    if (p->path.pdf_w > 0.0f)
        ratio = light_pdf_w(scene, light, p->path.from, &met->surface) / p->path.pdf_w;
    p->path.radiance += p->path.eta_scale * p->path.beta * emitted *
                        media_emission_weight(p, scene, params, index, ratio);
}

/* Adds the environment's radiance to a path whose ray escapes. */
static inline void add_escaped_light(struct media_path *p, const struct scene *scene,
                                     const rt_params *params)
{
    struct path *path = &p->path;
    if (!meets_environment(scene, path->depth))
        return;
    const float3 w = path->ray.direction;
    float ratio = 0.0f;
    if (path->pdf_w > 0.0f)
        ratio = environment_light_pdf_w(scene, path->from, w) / path->pdf_w;
    path->radiance += path->eta_scale * path->beta * environment_radiance(scene, w) *
                      media_emission_weight(p, scene, params, scene->environment->light, ratio);
}

/* Scatters the path in the medium, at the distance sampled on its segment. */
static inline void scatter_in_medium(struct media_path *p, const struct scene *scene,
                                     const rt_params *params, const struct medium *medium, float8 u)
{
    struct path *path = &p->path;
    p->in_medium = true;
    if (!(KNOWS_GRIDS && p->on_grid)) /* as cross_grid did */
        p->pdf = distance_pdf(medium, p->segment.pmf, p->distance);
    path->from = p->segment.origin + p->distance * p->segment.direction;
    if (!(KNOWS_GRIDS && p->on_grid))
        path->beta *= scattering_at(scene, medium, path->from) *
                      transmittance(medium, p->distance) * (1.0f / p->pdf);
    if (path->depth == params->max_depth) {
        path->alive = false;
        path->cut_off = mean3(path->beta);
        return;
    }
    add_vertex_light(p, scene, params, medium, false, u.lo);

    /* End the path by Russian roulette, or sample the phase function. */
    const float survival = eye_path_survival(params, path->depth, path->beta);
    path->beta *= 1.0f / survival;
    const float3 wi = phase_sample(medium->g, p->segment.direction, u.hi.xy);
    path->pdf_w = phase_pdf_w(medium->g, p->segment.direction, wi);
    path->ray = make_ray(path->from, wi, 0.0f, INFINITY);
    path->alive = u.hi.z < survival && largest3(path->beta) > 0.0f && can_follow(&path->ray);
    path->depth++;
    path->scattered = true;
    DISPERSED(path->wavelength = 0.0f);
}

/*
 * As path_vertex; `purpose` is FOLLOW_ALL or FOLLOW_TO_GATHER. *connection is black before, and
 * stays so where no light is sampled.
 */
CALLED_ON_GPUS void media_vertex(struct media_path *p, struct media_connection *connection,
                                 const struct scene *scene, const rt_params *params,
                                 const struct hit *hit, struct meeting *met, float8 u,
                                 const uint purpose, const struct gather *gather)
{
    struct path *path = &p->path;

    /* Add what the surface emits; go on through a boundary that has none. */
    if (purpose == FOLLOW_ALL)
        add_surface_emission(p, scene, params, met);
    else if (!path->resumes)
        add_emission(path, scene, params, met, purpose);
    path->resumes = false;
    if (is_passable(scene, &met->surface, &met->boundary)) {
        path_pass(path, met);
        return;
    }
    if (path->depth == params->max_depth) {
        path_cut_off(path, scene->materials + met->part);
        return;
    }

    /* Split the path at the first rough event that is left to it. */
    const float3 drawn = path_disperse(path, scene, met);
    struct vertex vertex;
    make_vertex(&vertex, scene, met, path->media.x, path->beta * drawn, CARRY_RADIANCE);
    if (purpose == FOLLOW_TO_GATHER && is_split_at(path, params, &vertex))
        u = split_path(path, gather, params, hit);
    path->beta *= drawn;

    /* Sample direct light; then an event, or end the path, but not at its gather point. */
    const uint held = purpose == FOLLOW_TO_GATHER ? vertex_held(&vertex, params) : 0u;
    const bool last = ends_at_gather_point(path, params, purpose);
    connect_surface(connection, path, scene, params, &vertex, held, last, u.lo);
    go_on(path, params, &vertex, held, last, u.hi, gather);
    p->in_medium = false;
}

/*
 * Shades the surface that the path's ray hits, extends the path, and adds the direct light that
 * arrives. `purpose` is a constant; *gather serves FOLLOW_TO_GATHER.
 */
static inline void media_surface(struct media_path *p, const struct scene *scene,
                                 const rt_params *params, const struct hit *hit, float8 u,
                                 const uint purpose, const struct gather *gather)
{
    struct media_connection connection;
    struct meeting met;
    connection.radiance = (float3)(0.0f);
    meet_surface(&met, scene, &p->path.ray, hit, p->path.media);
    media_vertex(p, &connection, scene, params, hit, &met, u, purpose, gather);
    add_arrival(&p->path, scene, &connection);
}

/* As cross_medium, where the density lies on a grid: by delta tracking, or ratio tracking. */
static inline bool cross_grid(struct media_path *p, const struct scene *scene,
                              const struct medium *medium, float length)
{
    struct path *path = &p->path;
    const struct ray *ray = &path->ray;
    struct stream stream = stream_of(&path->sampler, set_segment(path->depth + path->hidden));
    if (!medium_scatters(medium)) {
        path->beta *= ratio_tracking(scene, medium, ray->origin, ray->direction, length, &stream);
        return false;
    }
    const float3 pmf = channel_pmf(path->beta);
    struct tracked tracked;
    if (!delta_tracking(&tracked, scene, medium, ray->origin, ray->direction, length, pmf,
                        &stream)) {
        path->beta *= tracked.passed;
        return false;
    }
    p->segment.origin = ray->origin;
    p->segment.direction = ray->direction;
    p->distance = tracked.distance;
    p->pdf = 1.0f;
    p->on_grid = true;
    path->beta *= scattered_weight(&tracked, scene, medium, pmf,
                                   ray->origin + tracked.distance * ray->direction);
    return true;
}

/*
 * Brings the path to the end of its segment of this length: true where the medium scatters it
 * before.
 */
static inline bool cross_medium(struct media_path *p, const struct scene *scene,
                                const rt_params *params, const struct medium *medium, float length,
                                float8 u)
{
    struct path *path = &p->path;
    if (is_on_grid(medium))
        return cross_grid(p, scene, medium, length);
    if (!medium_scatters(medium)) {
        path->beta *= transmittance(medium, length);
        return false;
    }
    const struct segment segment =
        make_segment(medium, path->ray.origin, path->ray.direction, length, path->beta);
    add_segment_light(path, scene, params, medium, &segment, false, u.lo);
    const float distance = sample_distance(medium, segment.pmf, u.hi.xy);
    if (distance < length) {
        p->segment = segment;
        p->distance = distance;
        p->on_grid = false;
        return true;
    }
    path->beta *=
        transmittance(medium, length) * (1.0f / passing_probability(medium, segment.pmf, length));
    return false;
}

/* Extends a path that is alive by its next vertex, or through a boundary without a surface. */
static inline void media_path_extend(const struct scene *scene, const rt_params *params,
                                     struct media_path *p)
{
    struct path *path = &p->path;
    const float8 u = path_numbers(path);
    const struct ray ray = path->ray;
    const struct medium medium = medium_of(scene, path->media.x);
    struct hit hit;
    count_path_ray(scene, path);
    const bool found = closest_hit(scene, &ray, &hit);
    if (cross_medium(p, scene, params, &medium, found ? hit.t : INFINITY, segment_numbers(path))) {
        scatter_in_medium(p, scene, params, &medium, u);
        return;
    }
    path->alive = found && largest3(path->beta) > 0.0f;
    if (path->alive)
        media_surface(p, scene, params, &hit, u, FOLLOW_ALL, 0);
    else if (!found)
        add_escaped_light(p, scene, params);
}

#endif
