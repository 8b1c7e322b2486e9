/*
 * grid.h - media whose density lies on a grid: where rays collide with them, and transmittance.
 *
 * Both coefficients are a colour times one density rho(x). Fictitious particles that change
 * nothing, null collisions, are added up to a majorant: the largest density of a brick of voxels
 * times sigma_max, the largest sigma_t,c for a density of 1. In that medium distances are
 * exponential from brick to brick (Woodcock et al. 1965; Szirmay-Kalos et al. 2011), and a
 * collision is a real one of channel c with probability
 *
 *   a_c = rho(x) sigma_t,c / (rho_max sigma_max)
 *
 * Delta tracking goes on until the collision is a real one of channel h, chosen with probability
 * q_h. Let w_c be the product over null collisions of 1 - a_c. The density of a chain of collisions
 * that ends with a real one is proportional to w_c sigma_t,c if h is c, and what it carries to
 * w_c sigma_s,c, with the same factor (Miller, Georgiev, Jarosz 2019). The balance heuristic over
 * the channels (Wilkie et al. 2014) weights it by
 *
 *   w_c sigma_s,c / sum over k of q_k w_k sigma_t,k     where it ends by scattering
 *   w_c / sum over k of q_k w_k                         where it leaves the medium
 *
 * which are those of a homogeneous medium (medium.h) with w in place of the transmittance. Where no
 * real collision ends the chain, the mean of w is the transmittance: ratio tracking (Novak, Selle,
 * Jarosz 2014). march.h integrates the density instead.
 *
 * A density of three channels rho_c(x) stands in the place of rho(x) in a_c, its largest channel in
 * that of rho_max; and sigma_t,k of the weights is multiplied by rho_k(x) over its largest channel.
 * An albedo on a grid multiplies sigma_s by what it has at a point; the rest of that is absorbed.
 * All of that leaves distances as they are.
 *
 * References:
 *   Woodcock, Murphy, Hemmings, Longworth: "Techniques Used in the GEM Code for Monte Carlo
 *     Neutronics Calculations in Reactors and Other Systems of Complex Geometry", ANL-7050, 1965.
 *   Szirmay-Kalos, Toth, Magdics: "Free Path Sampling in High Resolution Inhomogeneous
 *     Participating Media", Computer Graphics Forum 30(1), 2011.
 *   Novak, Selle, Jarosz: "Residual Ratio Tracking for Estimating Attenuation in Participating
 *     Media", ACM Transactions on Graphics 33(6), 2014.
 *   Wilkie, Nawaz, Droske, Weidlich, Hanika: "Hero Wavelength Spectral Sampling", EGSR 2014.
 *   Miller, Georgiev, Jarosz: "A Null-Scattering Path Integral Formulation of Light Transport", ACM
 *     Transactions on Graphics 38(4), 2019.
 *   Amanatides, Woo: "A Fast Voxel Traversal Algorithm for Ray Tracing", Eurographics 1987.
 */
#ifndef RT_KERNELS_VOLUME_GRID_H
#define RT_KERNELS_VOLUME_GRID_H

#include "sample/rng.h"
#include "volume/medium.h"

/* Below this transmittance, roulette ends half of the rays that track it. */
#define RT_TRACKING_ROULETTE 0.1f

/* Whether a program knows densities on grids: the others have nothing of their code. */
#ifdef RT_GRIDS
#define KNOWS_GRIDS true
#else
#define KNOWS_GRIDS false
#endif

/* Whether the medium's density lies on a grid. */
static inline bool is_on_grid(const struct medium *medium)
{
    return KNOWS_GRIDS && medium->grid != 0u;
}

/* ---- Density ------------------------------------------------------------------------- */

static inline global const float *grid_table(const struct scene *scene, uint row)
{
    return (global const float *)((global const uchar *)scene->header + (size_t)row * RT_SCENE_ROW);
}

/* Where the grid has a point of the world, or with w = 0 a direction, in voxels. */
static inline float3 to_voxels(global const rt_grid_data *grid, float3 p, float w)
{
    const float4 at = (float4)(p, w);
    return (float3)(dot(vload4(0, grid->to_voxels[0]), at), dot(vload4(0, grid->to_voxels[1]), at),
                    dot(vload4(0, grid->to_voxels[2]), at));
}

/* The density at a point in the box, in voxels. */
static inline float density_at(const struct scene *scene, global const rt_grid_data *grid, float3 p)
{
    global const float *const values = grid_table(scene, grid->values);
    const int3 size = convert_int3(vload3(0, grid->size));
    const float3 base = floor(p - 0.5f);
    const float3 f = p - 0.5f - base;
    const int3 lo = clamp(convert_int3(base), (int3)(0), size - 1);
    const int3 hi = clamp(convert_int3(base) + 1, (int3)(0), size - 1);
    const uint4 row = (uint4)((uint)(lo.z * size.y + lo.y), (uint)(lo.z * size.y + hi.y),
                              (uint)(hi.z * size.y + lo.y), (uint)(hi.z * size.y + hi.y)) *
                      (uint)size.x;
    const float4 at_lo = (float4)(values[row.x + (uint)lo.x], values[row.y + (uint)lo.x],
                                  values[row.z + (uint)lo.x], values[row.w + (uint)lo.x]);
    const float4 at_hi = (float4)(values[row.x + (uint)hi.x], values[row.y + (uint)hi.x],
                                  values[row.z + (uint)hi.x], values[row.w + (uint)hi.x]);
    const float4 along_x = mix(at_lo, at_hi, f.x);
    const float2 along_y = mix(along_x.xz, along_x.yw, f.y);
    return mix(along_y.x, along_y.y, f.z);
}

/* ---- Colours ------------------------------------------------------------------------- */

/* The voxel next to the box along each axis: that within, or beyond the opposite face. */
static inline int3 voxel_within(int3 at, int3 size, bool repeats)
{
    const int3 above = select(at, at + size, at < 0);
    return repeats ? select(above, above - size, above >= size) : clamp(at, (int3)(0), size - 1);
}

/* The three numbers at a point, in voxels, which may lie outside of the box. */
static inline float3 colour_at(const struct scene *scene, global const rt_grid_data *grid, float3 p)
{
    global const float *const values = grid_table(scene, grid->values);
    const bool repeats = grid->repeats != 0u;
    const int3 size = convert_int3(vload3(0, grid->size));
    const float3 sides = convert_float3(size);
    const float3 inside = repeats ? p - floor(p / sides) * sides : clamp(p, (float3)(0.0f), sides);
    const float3 base = floor(inside - 0.5f), f = inside - 0.5f - base;
    const int3 lo = voxel_within(convert_int3(base), size, repeats),
               hi = voxel_within(convert_int3(base) + 1, size, repeats);
    float3 sum = (float3)(0.0f);
    for (uint corner = 0u; corner < 8u; corner++) {
        const bool x = corner & 1u, y = corner & 2u, z = corner & 4u;
        const uint row = (uint)((z ? hi.z : lo.z) * size.y + (y ? hi.y : lo.y));
        const uint voxel = row * (uint)size.x + (uint)(x ? hi.x : lo.x);
        const float weight =
            (x ? f.x : 1.0f - f.x) * (y ? f.y : 1.0f - f.y) * (z ? f.z : 1.0f - f.z);
        sum += weight * (grid->channels == 3u ? vload3(voxel, values) : (float3)(values[voxel]));
    }
    return sum;
}

/* Whether the density has three channels. */
static inline bool is_coloured(const struct medium *medium)
{
    return KNOWS_GRIDS && medium->is_coloured;
}

/* Whether the part of sigma_s that scatters lies on a grid. */
static inline bool has_albedo(const struct medium *medium)
{
    return KNOWS_GRIDS && medium->albedo != 0u;
}

/* The density of each channel over the largest of them, at a point of the world. */
static inline float3 density_colour(const struct scene *scene, const struct medium *medium,
                                    float3 p)
{
    if (!is_coloured(medium))
        return (float3)(1.0f);
    global const rt_grid_data *grid = scene->grids + (medium->grid - 1u);
    const float3 density = colour_at(scene, grid, to_voxels(grid, p, 1.0f));
    return density * (1.0f / fmax(largest3(density), FLT_MIN));
}

/* What part of sigma_s scatters at a point of the world. */
static inline float3 albedo_at(const struct scene *scene, const struct medium *medium, float3 p)
{
    if (!has_albedo(medium))
        return (float3)(1.0f);
    global const rt_grid_data *grid = scene->grids + (medium->albedo - 1u);
    return colour_at(scene, grid, to_voxels(grid, p, 1.0f));
}

/* sigma_s at a point of a homogeneous medium, 1/m. */
static inline float3 scattering_at(const struct scene *scene, const struct medium *medium, float3 p)
{
    return has_albedo(medium) ? medium->scattering * albedo_at(scene, medium, p)
                              : medium->scattering;
}

/* ---- Collisions, null ones included --------------------------------------------------- */

/*
 * A ray on its way through the bricks of a grid (Amanatides and Woo 1987). Distances count from
 * where it enters the box, which may be so far from its origin that steps would not change them.
 */
struct walk {
    const struct scene *scene;
    global const rt_grid_data *grid;
    float3 origin, direction; /* voxels, where it enters, and voxels a metre */
    int3 brick;
    float3 exit;    /* distance at which the ray leaves the brick along each axis */
    float start;    /* of the ray from its own origin to the box, m */
    float t, end;   /* where it is, and where it leaves the box, m */
    float density;  /* largest one of the brick */
    float majorant; /* of the extinction, for a density of 1, 1/m */
    struct stream stream;
    float decision; /* number in [0,1) that comes with the latest collision */
};

/* Reads what the walk has to know of its brick. */
static inline void enter_brick(struct walk *walk)
{
    const float3 beyond = convert_float3(
        (walk->brick + select((int3)(0), (int3)(1), walk->direction > 0.0f)) * (int)RT_GRID_BRICK);
    const int3 at = walk->brick;
    const uint index = ((uint)at.z * walk->grid->bricks[1] + (uint)at.y) * walk->grid->bricks[0];
    walk->exit = (beyond - walk->origin) / walk->direction;
    walk->density = grid_table(walk->scene, walk->grid->majorants)[index + (uint)at.x];
}

/*
 * Begins to walk along a ray of unit direction, but for the numbers of collisions; false where it
 * misses the box.
 */
static inline bool walk_begin(struct walk *walk, const struct scene *scene,
                              const struct medium *medium, float3 origin, float3 direction,
                              float length)
{
    walk->scene = scene;
    walk->grid = scene->grids + (medium->grid - 1u);
    walk->majorant = largest3(medium->extinction);
    walk->origin = to_voxels(walk->grid, origin, 1.0f);
    const float3 d = to_voxels(walk->grid, direction, 0.0f);
    walk->direction = select(d, (float3)(1e-25f), fabs(d) < 1e-25f); /* nothing is divided by 0 */
    const float3 size = convert_float3(vload3(0, walk->grid->size));
    const float3 a = -walk->origin / walk->direction, b = (size - walk->origin) / walk->direction;
    const float3 in = fmin(a, b), out = fmax(a, b);
    walk->start = fmax(fmax(in.x, in.y), fmax(in.z, 0.0f));
    walk->end = fmin(fmin(out.x, out.y), fmin(out.z, length)) - walk->start;
    if (!(walk->end > 0.0f))
        return false;
    walk->t = 0.0f;
    walk->origin = clamp(walk->origin + walk->start * walk->direction, (float3)(0.0f), size);
    walk->brick = clamp(convert_int3(walk->origin) / (int)RT_GRID_BRICK, (int3)(0),
                        convert_int3(vload3(0, walk->grid->bricks)) - 1);
    enter_brick(walk);
    return true;
}

/* Steps to the next brick along the ray; false where there is none. */
static inline bool next_brick(struct walk *walk, float exit)
{
    const int3 step = select((int3)(-1), (int3)(1), walk->direction > 0.0f);
    if (exit >= walk->end)
        return false;
    walk->t = exit;
    if (exit == walk->exit.x)
        walk->brick.x += step.x;
    else if (exit == walk->exit.y)
        walk->brick.y += step.y;
    else
        walk->brick.z += step.z;
    if (any(walk->brick < 0) || any(walk->brick >= convert_int3(vload3(0, walk->grid->bricks))))
        return false;
    enter_brick(walk);
    return true;
}

/* Goes on to the next collision; false where the ray leaves the medium before. */
static inline bool next_collision(struct walk *walk)
{
    const float2 u = stream_next(&walk->stream);
    float depth = -log(1.0f - u.x);
    for (;;) {
        const float exit = fmin(fmin(walk->exit.x, walk->exit.y), walk->exit.z);
        const float majorant = walk->density * walk->majorant;
        const float inside = majorant * fmax(fmin(exit, walk->end) - walk->t, 0.0f);
        if (depth < inside)
            break;
        depth -= inside;
        if (!next_brick(walk, exit))
            return false;
    }
    walk->t += depth / (walk->density * walk->majorant);
    walk->decision = u.y;
    return true;
}

/* How far from the ray's own origin the walk is, m. */
static inline float walked(const struct walk *walk)
{
    return walk->start + walk->t;
}

/* The density where the walk is, that of the largest channel; *colour: of each over that. */
static inline float density_here(const struct walk *walk, const struct medium *medium,
                                 float3 *colour)
{
    const float3 p = walk->origin + walk->t * walk->direction;
    *colour = (float3)(1.0f);
    if (!is_coloured(medium))
        return density_at(walk->scene, walk->grid, p);
    const float3 density = colour_at(walk->scene, walk->grid, p);
    *colour = density * (1.0f / fmax(largest3(density), FLT_MIN));
    return largest3(density);
}

/* The probabilities a_c that the latest collision, at this density, is a real one of a channel. */
static inline float3 real_collision(const struct walk *walk, const struct medium *medium,
                                    float density, float3 colour)
{
    const float3 real = medium->extinction * (fmin(density / walk->density, 1.0f) / walk->majorant);
    return is_coloured(medium) ? real * colour : real;
}

/* ---- Tracking ------------------------------------------------------------------------- */

/* What ratio tracking estimates for the transmittance of a ray of unit direction. */
static inline float3 ratio_tracking(const struct scene *scene, const struct medium *medium,
                                    float3 origin, float3 direction, float length,
                                    const struct stream *stream)
{
    struct walk walk;
    float3 w = (float3)(1.0f);
    walk.stream = *stream;
    if (!walk_begin(&walk, scene, medium, origin, direction, length))
        return w;
    while (next_collision(&walk)) {
        float3 colour;
        const float density = density_here(&walk, medium, &colour);
        w *= 1.0f - real_collision(&walk, medium, density, colour);
        if (largest3(w) >= RT_TRACKING_ROULETTE)
            continue;
        if (walk.decision < 0.5f)
            return (float3)(0.0f);
        w *= 2.0f;
    }
    return w;
}

/* What delta tracking finds on a ray. */
struct tracked {
    float3 w;        /* product over the null collisions of 1 - a_c */
    float3 collided; /* an estimate of 1 - T_c without bias: the sum of a_c, each weighted */
    float3 passed;   /* the weight of a path that it let through */
    float distance;  /* of the real collision, m; undefined without one, as are the others: */
    float3 colour;   /* of the density there, ... */
    float density;   /* ... its largest channel, ... */
    float sampled;   /* ... and as it was sampled by a number of 24 bits, of which 0 is one */
};

/*
 * Delta tracking along a ray of unit direction, by one channel, chosen with these probabilities:
 * true where it ends by a real collision.
 */
static inline bool delta_tracking(struct tracked *tracked, const struct scene *scene,
                                  const struct medium *medium, float3 origin, float3 direction,
                                  float length, float3 pmf, struct stream *stream)
{
    struct walk walk;
    const float u = stream_next(stream).x;
    const float3 chosen = u < pmf.x           ? (float3)(1.0f, 0.0f, 0.0f)
                          : u < pmf.x + pmf.y ? (float3)(0.0f, 1.0f, 0.0f)
                                              : (float3)(0.0f, 0.0f, 1.0f);
    tracked->w = tracked->passed = (float3)(1.0f);
    tracked->collided = (float3)(0.0f);
    walk.stream = *stream;
    if (!walk_begin(&walk, scene, medium, origin, direction, length))
        return false;
    while (next_collision(&walk)) {
        const float density = density_here(&walk, medium, &tracked->colour);
        const float3 real = real_collision(&walk, medium, density, tracked->colour);
        tracked->collided += real * tracked->w * (1.0f / dot(pmf, tracked->w));
        if (walk.decision < dot(real, chosen)) {
            tracked->distance = walked(&walk);
            tracked->density = density;
            tracked->sampled = fmax(density, 0x1p-24f * walk.density);
            return true;
        }
        tracked->w *= 1.0f - real;
    }
    tracked->passed = tracked->w * (1.0f / dot(pmf, tracked->w));
    return false;
}

/* w times the density of each channel where delta tracking ended, over the largest of these. */
static inline float3 coloured_weight(const struct tracked *tracked, const struct medium *medium)
{
    return is_coloured(medium) ? tracked->w * tracked->colour : tracked->w;
}

/* The weight of a path that the medium scatters where delta tracking ended, at a point. */
static inline float3 scattered_weight(const struct tracked *tracked, const struct scene *scene,
                                      const struct medium *medium, float3 pmf, float3 p)
{
    const float3 w = coloured_weight(tracked, medium);
    const float3 weight = w * medium->scattering * (1.0f / dot(pmf, w * medium->extinction));
    return has_albedo(medium) ? weight * albedo_at(scene, medium, p) : weight;
}

/* The transmittance over the density of collisions there, m. */
static inline float3 collided_weight(const struct tracked *tracked, const struct medium *medium,
                                     float3 pmf)
{
    const float3 w = coloured_weight(tracked, medium);
    return tracked->w * (1.0f / (tracked->sampled * dot(pmf, w * medium->extinction)));
}

#endif
