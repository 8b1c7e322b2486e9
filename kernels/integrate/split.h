/*
 * split.h - splits a camera path of photon mapping where a rough event, the light of which is not
 * gathered, may scatter it for the first time.
 *
 * From that vertex on, params->split continuations share what came before. Each samples light,
 * chooses an event and goes on by numbers of its own, with 1 / split of the path's weight, so that
 * their sum has the mean of one whole path:
 *
 *   E[X Y] = E[X (Y_1 + ... + Y_n) / n]                             Arvo and Kirk 1990, splitting
 *
 * with X the throughput up to the vertex and Y_i what a continuation finds. The first one keeps
 * what the path found before. Continuation i of sample s takes the points s n + i of its sequences.
 *
 * References:
 *   Arvo, Kirk: "Particle Transport and Image Synthesis", SIGGRAPH 1990.
 */
#ifndef RT_KERNELS_INTEGRATE_SPLIT_H
#define RT_KERNELS_INTEGRATE_SPLIT_H

#include "integrate/gather.h"
#include "integrate/path_state.h"

/* Where a path was split: what the continuations to come begin with. */
struct fork {
    struct path path; /* at the vertex; resumes, and has found nothing yet */
    struct hit hit;   /* of the vertex */
    uint next;        /* continuation */
    /* of the first continuation that ended at the vertex itself, by a gathered event; or NULL */
    global rt_gather_point *ended;
};

/*
 * Copies by member: a copy as a whole, with the gaps between members, would keep both in the
 * private memory of a GPU.
 */
static inline void copy_hit(struct hit *to, const struct hit *from)
{
    to->t = from->t;
    to->u = from->u;
    to->v = from->v;
    to->prim = from->prim;
    to->slot = from->slot;
}

static inline void copy_path(struct path *to, const struct path *from)
{
    to->sampler.sobol = from->sampler.sobol;
    to->sampler.key = from->sampler.key;
    to->sampler.index = from->sampler.index;
    to->ray = from->ray;
    to->from = from->from;
    to->radiance = from->radiance;
    to->beta = from->beta;
    to->eta_scale = from->eta_scale;
    to->pdf_w = from->pdf_w;
    to->cut_off = from->cut_off;
    to->media = from->media;
    to->depth = from->depth;
    to->hidden = from->hidden;
    to->diffuse_events = from->diffuse_events;
    to->alive = from->alive;
    to->scattered = from->scattered;
    to->rough = from->rough;
    to->whole = from->whole;
    to->resumes = from->resumes;
    DISPERSED(to->wavelength = from->wavelength);
}

/* Whether the path is split at its next vertex. */
static inline bool is_split_at(const struct path *path, const rt_params *params,
                               const struct vertex *vertex)
{
    return path->whole && params->split > 1u && vertex_splits(vertex, params);
}

/* Lets a path go on as continuation i. */
static inline void aim_continuation(struct path *path, const rt_params *params, uint i)
{
    sampler_split(&path->sampler, params->first_sample, params->split, i);
}

/*
 * Splits a path at a vertex: keeps in gather->fork what the others begin with, and lets it go on as
 * the first continuation. Returns its sample values for the vertex.
 */
static inline float8 split_path(struct path *path, const struct gather *gather,
                                const rt_params *params, const struct hit *hit)
{
    struct fork *const fork = gather->fork;
    path->whole = false;
    path->eta_scale *= 1.0f / (float)params->split;
    copy_path(&fork->path, path);
    fork->path.radiance = (float3)(0.0f);
    fork->path.resumes = true;
    copy_hit(&fork->hit, hit);
    fork->next = 1u;
    fork->ended = 0;
    aim_continuation(path, params, 0u);
    return path_numbers(path);
}

/*
 * Continuations that end at the vertex have the same gather point there: the first one takes the
 * weights of all, so that photons are gathered once.
 */
static inline void join_gather_points(const struct path *path, const struct gather *gather)
{
    struct fork *const fork = gather->fork;
    global rt_gather_point *const point = gather->point;
    if (path->depth != fork->path.depth || path->diffuse_events == fork->path.diffuse_events)
        return;
    if (!fork->ended) {
        fork->ended = point;
        return;
    }
    vstore3(row3(fork->ended->weight) + row3(point->weight), 0, fork->ended->weight);
    clear_gather_point(point, point->pixel, point->sample, point->film_weight);
}

#endif
