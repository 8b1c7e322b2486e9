/*
 * gather.h - the gather points of camera paths in photon mapping, and which emission is left to
 * photons.
 *
 * A diffuse event is here one that is gathered: a diffuse one, or a rough one if the setting says
 * so.
 *
 * An eye path ends at the diffuse event after `final_gather` others: there the photon map takes
 * over. At the diffuse events before, only caustic photons are gathered, which arrived through
 * delta events only: eye paths would find that light too seldom, and that of a point light never.
 */
#ifndef RT_KERNELS_INTEGRATE_GATHER_H
#define RT_KERNELS_INTEGRATE_GATHER_H

#include "integrate/path_state.h"
#include "surface/gather_point.h"

/* The gather points of one eye path. */
struct gather {
    /* where it ends: position, normal, weight and material are filled in */
    global rt_gather_point *point;
    /* [params->final_gather]: the diffuse events before, `stride` points apart */
    global rt_gather_point *caustics;
    uint stride;
    struct fork *fork; /* where it was split, if it was: split.h */
};

/* Whether a diffuse event at the next vertex is the last, where the path ends. */
static inline bool ends_at_gather_point(const struct path *path, const rt_params *params,
                                        const uint purpose)
{
    return purpose == FOLLOW_TO_GATHER && path->diffuse_events == params->final_gather;
}

/*
 * Whether caustic photons account for the emission that the path meets: they come by delta events
 * alone to a diffuse surface, where the final gather finds them.
 */
static inline bool left_to_photons(const struct path *path, const uint purpose)
{
    return purpose == FOLLOW_TO_GATHER && path->diffuse_events > 0u && path->pdf_w == 0.0f &&
           !path->rough;
}

/*
 * Makes a diffuse event a gather point: of all photons at the last, where the path ends, else of
 * caustic photons.
 */
static inline void add_gather_point(struct path *path, const struct gather *gather, bool last,
                                    const struct vertex *vertex, uint event)
{
    global rt_gather_point *point =
        last ? gather->point : gather->caustics + path->diffuse_events * gather->stride;
    set_gather_point(point, vertex->position, &vertex->bsdf, event,
                     vertex_probability(vertex, event), vertex->material,
                     path->eta_scale * path->beta);
    path->alive = !last;
    path->diffuse_events++;
}

#endif
