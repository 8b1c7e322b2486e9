/*
 * importance.h - how often photon paths start where, by what a pilot found: the shares of the
 * lights, and the tables of their starts (kernels/photon/importance.h).
 *
 * A path counts where it leaves a photon that the camera may gather. Of independent paths with a
 * chance p to count, those that a cell gets for the least variance go as sqrt(p), the root of the
 * mean square of what counts, as for strata of one size (Neyman 1934). p is estimated from the
 * pilot's paths, and drawn towards that of the 16 cells around, theirs towards that of the 256, and
 * so on, where paths are few. A quarter of all paths follows the distribution without importance,
 * so that no weight is above four.
 *
 * References:
 *   Neyman: "On the Two Different Aspects of the Representative Method", Journal of the Royal
 *     Statistical Society 97, 1934.
 */
#ifndef RT_LIB_PHOTON_IMPORTANCE_H
#define RT_LIB_PHOTON_IMPORTANCE_H

#include "photon/light_sources.h"
#include "rt.h"

/* Part of the paths that follow no importance. */
#define RT_IMPORTANCE_LEAST 0.25

typedef struct rt_importance {
    uint32_t levels; /* as rt_light_share has them; 0: no tables */
    float *sums;     /* [light_count][16^levels], of probabilities */
    double *factors; /* [source count], of the shares; their mean by share is 1 */
    double seen;     /* part of the pilot's paths that count, */
    double expected; /* and of those by these tables and shares */
} rt_importance;

/* Where a path of the pilot started, as photon_starts.cl makes it. */
typedef struct rt_path_start {
    rt_u32 light; /* RT_NONE: none */
    rt_u32 cell;
} rt_path_start;

/* A path of the pilot. */
typedef struct rt_pilot_path {
    rt_path_start start;
    float weight; /* of its start; 1 where it followed no importance */
    int counts;
} rt_pilot_path;

/* How often cells can be divided, so that so many paths leave enough to each of so many lights. */
uint32_t rt_importance_levels(size_t paths, size_t lights);

/*
 * By the paths of a pilot [count], whose cells were divided so often; lights: with their shares
 * without importance, which stay unless weighs_lights. Where none counts, out->seen is 0, and
 * nothing is to follow. Free with rt_importance_free.
 */
rt_status rt_importance_make(rt_importance *out, const rt_light_sources *lights, uint32_t levels,
                             int weighs_lights, const rt_pilot_path *paths, size_t count,
                             rt_error *error);
/* The weight of a start by this importance; lights: as above. */
float rt_importance_weight(const rt_importance *importance, const rt_light_sources *lights,
                           const rt_path_start *start);

void rt_importance_free(rt_importance *importance);

#endif
