/*
 * mode.h - the interface of a mode of rendering. Each mode has a folder here, and modes.c lists
 * them.
 */
#ifndef RT_LIB_MODE_MODE_H
#define RT_LIB_MODE_MODE_H

#include "base/progress.h"
#include "film/film.h"
#include "mode/first_hit/layers.h"
#include "mode/work.h"
#include "render/compile.h"
#include "render/renderer.h"

/* A render under way, as rt_render hands it to a mode. */
typedef struct rt_render_job {
    rt_renderer *renderer;
    const rt_render_options *options; /* complete */
    rt_film *film;
    rt_first_hit_layers *layers; /* summed beside the picture; without a kernel: none */
} rt_render_job;

/* The class of a mode. Its name and help are in RT_MODES, beside the enum. */
typedef struct rt_mode_class {
    int has_noise;     /* it renders independent replicates, whose variance gives the error */
    int knows_media;   /* it renders scenes that rt_scene_has_media is true of */
    int knows_grids;   /* and that rt_scene_has_grids is true of */
    size_t state_size; /* bytes of what prepare, run and release share; zero before prepare */

    /* Fails where complete options do not fit together in this mode; or NULL. */
    rt_status (*check)(const rt_render_options *options, rt_error *error);

    /*
     * What light of the scene complete options leave out, however many samples they take; NULL:
     * none. Or NULL, where none ever is.
     */
    const char *(*leaves_out)(const rt_renderer *renderer, const rt_render_options *options);

    /* Adds the programs that prepare makes kernels of; or NULL. */
    void (*programs)(rt_program_list *list, const rt_render_job *job);

    /* Compiles the kernels, as part of the stage `compile`; or NULL. */
    rt_status (*prepare)(const rt_render_job *job, void *state, rt_stage_progress *progress,
                         rt_error *error);

    /*
     * Fills film->pixels, the layers and the film's stats, adding to job->layers the samples that
     * the picture has, and film->done. On RT_CANCELLED the film holds the samples so far.
     */
    rt_status (*run)(const rt_render_job *job, void *state, rt_error *error);

    /* Frees what the state holds, also after a failure; or NULL. */
    void (*release)(void *state);

    /* For modes that show a layer of the first hit: what a pixel with samples has; else NULL. */
    void (*show)(float rgb[3], const rt_first_hits *sums);
} rt_mode_class;

/* What paths that do not begin at lights, or are not joined with those, leave out. */
#define RT_DELTA_CAUSTICS                                                                          \
    "caustics of point, spot and directional lights and beams (through smooth mirrors or glass)"

/* Whether the scene may have such caustics, on surfaces of these RT_CAUSTICS_*. */
int rt_mode_has_caustics(const rt_renderer *renderer, const rt_render_options *options,
                         int surfaces);

/* The class of a mode, which must be one of rt_mode. */
const rt_mode_class *rt_mode_class_of(rt_mode mode);

#endif
