/*
 * photon_render.h - a render by photon mapping under way: what the files photon_mode.c (the whole),
 * photon_pass.c (one emission, and the gathering after it) and photon_passes.c (progressive passes)
 * share.
 */
#ifndef RT_LIB_RENDER_PHOTON_RENDER_H
#define RT_LIB_RENDER_PHOTON_RENDER_H

#include "photon/emit.h"
#include "photon/photon_map.h"
#include "render/aov.h"
#include "render/photon_eye.h"
#include "render/renderer.h"

/* The ways in which photons are gathered, each with a radius of its own. */
typedef enum rt_photon_way {
    RT_WAY_GLOBAL,
    RT_WAY_CAUSTIC,
    RT_WAY_ON_THE_WAY,
    RT_PHOTON_WAYS
} rt_photon_way;

typedef struct rt_photon_render {
    rt_renderer *renderer;
    const rt_render_options *options;
    rt_film *film;
    int on_device, in_passes;
    cl_kernel emit;
    rt_eye_kernels eye_kernels;
    rt_emitter *emitter;
    rt_photon_map map;           /* what is emitted */
    const rt_photon_map *in_use; /* that, or the one of the options */
    /* for the final gather, copies out of the global list where there is no other */
    rt_photon_list caustics;
    rt_aov aov;
    rt_photon_eye eye;
    rt_gather_options how[RT_PHOTON_WAYS]; /* without passes; each pass has a radius of its own */
    double first_radius[RT_PHOTON_WAYS];   /* of the passes, the largest; 0 while unknown */
    /* squared, of each pixel, float; NULL where one holds for all */
    cl_mem first_radii[RT_PHOTON_WAYS];
    rt_gatherer *gatherers[RT_PHOTON_WAYS];
    rt_finer finer[RT_PHOTON_WAYS]; /* for the layer photon.bias */
    double began;                   /* rt_clock() at the start of emission, for options->time */
    rt_error error;                 /* of the search tree's thread */
} rt_photon_render;

/* How many independent sequences passes take turns at, so that the error can be known. */
uint32_t rt_photon_render_replicates(const rt_photon_render *r);

/* Fills the map, unless one is given, with the photons of a pass, and counts them. */
rt_status rt_photon_render_emit(rt_photon_render *r, uint32_t pass, rt_stage_progress *progress,
                                rt_error *error);

/* The photons that a way asks for; NULL when the render does not go that way. */
const rt_photon_list *rt_photon_render_list(const rt_photon_render *r, rt_photon_way way);

/* Makes a way's gatherer. */
rt_status rt_photon_render_open(rt_photon_render *r, rt_photon_way way,
                                const rt_gather_options *how, rt_error *error);

/* Where layers are asked for, makes the finer gatherer beside that of a way. */
rt_status rt_photon_render_open_finer(rt_photon_render *r, rt_photon_way way,
                                      const rt_gather_options *how, rt_error *error);

/* Frees the gatherers of all ways. */
void rt_photon_render_close(rt_photon_render *r);

/* Asks the map for samples from `first` on of every pixel, until there are enough or time is up. */
rt_status rt_photon_render_sample(rt_photon_render *r, uint32_t first, rt_stage_progress *progress,
                                  rt_error *error);

/* How much of the time that the options allow is gone, 0 to 1. */
double rt_photon_render_elapsed(const rt_photon_render *r);

/*
 * Pass after pass, as one stage, until there are enough, time is up or the error is small enough.
 */
rt_status rt_photon_render_passes(rt_photon_render *r, rt_error *error);

#endif
