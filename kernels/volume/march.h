/*
 * march.h - the optical depth along a ray through a grid of densities, by marching from cell to
 * cell.
 *
 * In a cell, the box between the centres of eight voxels, density is trilinear, and so along a ray
 * a cubic of the distance. Its values at the ends and the thirds of the ray's part there are enough
 * to know it, and its integral: by Simpson's 3/8 rule, which is exact for cubics, up to the end. So
 * transmittance has no noise and no error but that of rounding. Bricks without density are passed
 * at once.
 *
 * Where it is asked for at many distances of one ray, the march stops after a number of parts, and
 * keeps the polynomials of these: a run.
 *
 * A density of three channels is marched through three times, for one channel each.
 */
#ifndef RT_KERNELS_VOLUME_MARCH_H
#define RT_KERNELS_VOLUME_MARCH_H

#include "math/lanes.h"
#include "volume/grid.h"

/* A ray on its way through the cells of a grid. */
struct march {
    struct walk walk; /* through the bricks */
    bool inside;      /* it is in the box */
    int3 cell;        /* between the centres of the voxels of this index and of the next ones */
    float3 exit;      /* distance at which the ray leaves the cell along each axis */
    float at;         /* where it is, m */
    float density;    /* there, where a part ended */
    uint channel;     /* of a density of three, that which is marched through */
    bool is_coloured; /* whether it is one */
};

/* The part of a ray in one cell. */
struct part {
    float begin, end; /* m, from the ray's origin */
    float length;     /* m */
    float4 density;   /* at the begin, the thirds, and the end */
};

static inline float smallest3(float3 v)
{
    return fmin(fmin(v.x, v.y), v.z);
}

/* Where the ray leaves the cell. */
static inline float3 cell_exit(const struct march *march)
{
    const struct walk *walk = &march->walk;
    const float3 offset = select((float3)(0.5f), (float3)(1.5f), walk->direction > 0.0f);
    return (convert_float3(march->cell) + offset - walk->origin) / walk->direction;
}

/* The density at a distance along the ray. */
static inline float density_along(const struct march *march, float t)
{
    const struct walk *walk = &march->walk;
    const float3 p = walk->origin + t * walk->direction;
    if (!march->is_coloured)
        return density_at(walk->scene, walk->grid, p);
    const float3 density = colour_at(walk->scene, walk->grid, p);
    return march->channel == 0u ? density.x : march->channel == 1u ? density.y : density.z;
}

/* Begins with the cells of the brick that the walk has come to, if there is density in it. */
static inline void enter_cells(struct march *march)
{
    const struct walk *walk = &march->walk;
    if (!(walk->density > 0.0f))
        return;
    march->at = walk->t;
    march->cell = convert_int3(floor(walk->origin + walk->t * walk->direction - 0.5f));
    march->exit = cell_exit(march);
    march->density = density_along(march, walk->t);
}

static inline void march_begin(struct march *march, const struct scene *scene,
                               const struct medium *medium, float3 origin, float3 direction,
                               float length, uint channel)
{
    march->channel = channel;
    march->is_coloured = is_coloured(medium);
    march->inside = walk_begin(&march->walk, scene, medium, origin, direction, length);
    if (march->inside)
        enter_cells(march);
}

/* Leaves the cell for the next along the ray. */
static inline void next_cell(struct march *march)
{
    const float exit = smallest3(march->exit);
    const int3 step = select((int3)(-1), (int3)(1), march->walk.direction > 0.0f);
    if (exit == march->exit.x)
        march->cell.x += step.x;
    else if (exit == march->exit.y)
        march->cell.y += step.y;
    else
        march->cell.z += step.z;
    march->exit = cell_exit(march);
}

/* Goes on to the end of the next part that has density; false where there is none. */
static inline bool next_part(struct march *march, struct part *part)
{
    struct walk *walk = &march->walk;
    while (march->inside) {
        const float brick_exit = smallest3(walk->exit);
        const float last = fmin(brick_exit, walk->end);
        if (walk->density > 0.0f && march->at < last) {
            const float begin = march->at;
            const float end = clamp(smallest3(march->exit), begin, last);
            next_cell(march);
            if (end == begin)
                continue;
            const float third = (end - begin) * (1.0f / 3.0f);
            const float before = march->density;
            march->at = end;
            march->density = density_along(march, end);
            part->begin = walk->start + begin;
            part->end = walk->start + end;
            part->length = end - begin;
            part->density = (float4)(before, density_along(march, begin + third),
                                     density_along(march, end - third), march->density);
            return true;
        }
        march->inside = next_brick(walk, brick_exit);
        if (march->inside)
            enter_cells(march);
    }
    return false;
}

/* The integral of the density over a part, m. */
static inline float part_depth(const struct part *part)
{
    return part->length * dot(part->density, (float4)(0.125f, 0.375f, 0.375f, 0.125f));
}

/* The integral of the density of a channel along a ray of unit direction, m. */
static inline float marched_depth(const struct scene *scene, const struct medium *medium,
                                  float3 origin, float3 direction, float length, uint channel)
{
    struct march march;
    struct part part;
    float depth = 0.0f;
    march_begin(&march, scene, medium, origin, direction, length, channel);
    while (next_part(&march, &part))
        depth += part_depth(&part);
    return depth;
}

/* The transmittance of a medium along a ray of unit direction. */
static inline float3 marched_transmittance(const struct scene *scene, const struct medium *medium,
                                           float3 origin, float3 direction, float length)
{
    const uint channels = is_coloured(medium) ? 3u : 1u;
    float3 depths = (float3)(0.0f);
    for (uint channel = 0u; channel < channels; channel++) {
        const float depth = marched_depth(scene, medium, origin, direction, length, channel);
        depths = channel == 0u   ? (float3)(depth)
                 : channel == 1u ? (float3)(depths.x, depth, depth)
                                 : (float3)(depths.xy, depth);
    }
    return exp(-medium->extinction * depths);
}

/* ---- Runs ---------------------------------------------------------------------------- */

#define RT_RUN_PARTS 32u /* a power of two */

/* What the integral of the density is along a run of parts and the gaps between them. */
struct run {
    float from, to; /* distances; to: infinite of the last run */
    float depth;    /* the integral from the ray's origin to the end, m */
    uint count;
    float begins[RT_RUN_PARTS];
    float scales[RT_RUN_PARTS];  /* 1 over the length, or 0 of a gap */
    float depths[RT_RUN_PARTS];  /* the integral from the ray's origin to the begin, m */
    float4 powers[RT_RUN_PARTS]; /* what is added: coefficients of s to s^4, s from 0 to 1 */
};

/* A part without density, from here on. */
static inline void add_gap(struct run *run, float begin)
{
    run->begins[run->count] = begin;
    run->scales[run->count] = 0.0f;
    run->depths[run->count] = run->depth;
    run->powers[run->count++] = (float4)(0.0f);
}

/* The cubic through the four values, integrated. */
static inline void add_part(struct run *run, const struct part *part)
{
    const float4 f = part->density;
    const float4 cubic = (float4)(f.x, -5.5f * f.x + 9.0f * f.y - 4.5f * f.z + f.w,
                                  9.0f * f.x - 22.5f * f.y + 18.0f * f.z - 4.5f * f.w,
                                  4.5f * (f.w - f.x) + 13.5f * (f.y - f.z));
    run->begins[run->count] = part->begin;
    run->scales[run->count] = 1.0f / part->length;
    run->depths[run->count] = run->depth;
    run->powers[run->count++] = part->length * cubic * (float4)(1.0f, 0.5f, 1.0f / 3.0f, 0.25f);
    run->depth += part_depth(part);
}

/* Before the first run of a ray. */
static inline void run_begin(struct run *run)
{
    run->to = run->depth = 0.0f;
}

/* Marches on by a run, from where the one before ended; false when it is the last. */
static inline bool next_run(struct run *run, struct march *march)
{
    struct part part;
    bool more = true;
    run->from = run->to;
    run->count = 0u;
    while (more && run->count + 2u <= RT_RUN_PARTS) {
        more = next_part(march, &part);
        if (!more || part.begin > run->to)
            add_gap(run, run->to);
        if (more)
            add_part(run, &part);
        run->to = more ? part.end : INFINITY;
    }
    return more;
}

/* The integral of the density from the ray's origin to a distance in the run, m. */
static inline float run_depth(const struct run *run, float t)
{
    uint i = 0u;
    for (uint step = RT_RUN_PARTS / 2u; step > 0u; step /= 2u)
        if (i + step < run->count && run->begins[i + step] <= t)
            i += step;
    const float s = fmin((t - run->begins[i]) * run->scales[i], 1.0f);
    const float4 p = run->powers[i];
    return run->depths[i] + s * (p.x + s * (p.y + s * (p.z + s * p.w)));
}

/* The same of those of eight distances whose bits are set in `mask`. */
static inline float8 run_depth8(const struct run *run, float8 t, uint mask)
{
    float distances[8], depths[8];
    vstore8(t, 0, distances);
    vstore8((float8)(0.0f), 0, depths);
    for (; mask; mask &= mask - 1u) {
        const uint lane = lane_first(mask);
        depths[lane] = run_depth(run, distances[lane]);
    }
    return vload8(0, depths);
}

#endif
