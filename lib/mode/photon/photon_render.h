/*
 * photon_render.h - a render by photon mapping under way: the map in use, its gatherers, and the
 * sampling of the film with them.
 */
#ifndef RT_LIB_MODE_PHOTON_PHOTON_RENDER_H
#define RT_LIB_MODE_PHOTON_PHOTON_RENDER_H

#include "mode/mode.h"
#include "mode/photon/eye_paths.h"
#include "mode/shrink.h"
#include "photon/emit.h"
#include "photon/photon_map.h"

typedef struct rt_photon_render {
    const rt_render_job *job;
    int in_passes;
    rt_photon_search search;
    int keeps; /* the photons that it emits stay on the device */
    cl_kernel emit;
    cl_kernel starts; /* photon_starts, for the pilot of visual importance; else NULL */
    rt_eye_kernels eye_kernels;
    rt_emitter *emitter;
    rt_photon_map map;           /* the map that is emitted */
    const rt_photon_map *in_use; /* that map, or the one of the options */
    /* for the final gather, copies out of the global list where there is no caustic list */
    rt_photon_list caustics;
    rt_photon_list irradiances; /* by rt_irradiance_points_make; empty where photons are gathered */
    rt_eye_paths eye_paths;
    /* how each query gathers without passes; each pass has a radius of its own */
    rt_gather_options options[RT_QUERIES];
    rt_queries queries;
    rt_volume_gather volume; /* of scenes with media */
    rt_tree_builder builder; /* where photons stay on the device, as are: */
    /* the trees of each query's gatherer and of the finer one, kept from pass to pass */
    rt_tree_place places[RT_QUERIES][2];
    double first_radius[RT_QUERIES]; /* of the passes, the largest; 0 while unknown */
    uint32_t passes_tried;           /* for first radii: passes 0 to this one, without it */
    rt_shrink shrink;                /* of the square of that radius */
    /* squared, of each pixel, float; NULL where one holds for all */
    cl_mem first_radii[RT_QUERIES];
    rt_work work;   /* begun when emission begins, for options->time */
    rt_error error; /* of the thread that builds search trees */
} rt_photon_render;

/*
 * Whether the photons of a render stay on the device, where their tree is built: those of a map
 * that is given, or that neighbour lists are made of, lie on the host.
 */
int rt_photon_render_keeps(const rt_render_job *job, rt_photon_search search);

/* Starts the clock, and makes the emitter and the memory for eye paths. */
rt_status rt_photon_render_begin(rt_photon_render *r, rt_error *error);

/* Frees all that the render holds. */
void rt_photon_render_free(rt_photon_render *r);

/* How many replicates passes take turns at, so that the error can be estimated. */
uint32_t rt_photon_render_replicates(const rt_photon_render *r);

/* The photons that a query searches; NULL when the render does not make the query. */
const rt_photon_list *rt_photon_render_list(const rt_photon_render *r, rt_query query);

/* Makes the gatherer of a query. */
rt_status rt_photon_render_open(rt_photon_render *r, rt_query query,
                                const rt_gather_options *options, rt_error *error);

/*
 * Makes the volume photons of the map ready for camera rays, their squared radii times a factor; in
 * scenes without media, does nothing.
 */
rt_status rt_photon_render_open_volume(rt_photon_render *r, double squared_factor, rt_error *error);

/* Forgets the gatherers and the volume photons. */
void rt_photon_render_close(rt_photon_render *r);

/* Where layers are asked for, makes the finer gatherer beside that of a query. */
rt_status rt_photon_render_open_finer(rt_photon_render *r, rt_query query,
                                      const rt_gather_options *options, rt_error *error);

/* In passes, gives every pixel the samples of one, from `first` on. */
rt_status rt_photon_render_sample(rt_photon_render *r, uint32_t first, rt_stage_progress *progress,
                                  rt_error *error);

#endif
