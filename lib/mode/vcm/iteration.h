/*
 * iteration.h - one iteration of vertex connection and merging: a light path and a camera path for
 * every pixel of the film, joined by the techniques that the setting `techniques` names.
 */
#ifndef RT_LIB_MODE_VCM_ITERATION_H
#define RT_LIB_MODE_VCM_ITERATION_H

#include "mode/mode.h"
#include "mode/shrink.h"
#include "mode/vcm/merge_moments.h"
#include "mode/vcm/vertex_grid.h"
#include "photon/light_sources.h"
#include "setting/techniques.h"
#include "types.h"

/* All zero is none. */
typedef struct rt_vcm {
    const rt_render_job *job;
    rt_device *device;
    cl_kernel light, camera, splat, black, join;
    rt_light_sources lights;
    cl_mem shares;       /* rt_light_share, one a light of the kernels' table */
    rt_u32 slots;        /* vertices that a light path can have */
    rt_u32 paths;        /* a batch at most, */
    rt_u32 batch;        /* and the next one, by the time that the last took */
    cl_mem vertices;     /* rt_light_vertex [slots][paths], those of a batch */
    cl_mem counts;       /* rt_u32 [height * width], how many the paths of all batches have, */
    cl_mem places;       /* [paths], and those of a batch, with room for their sums */
    cl_mem splats;       /* rt_splat [slots][paths] */
    cl_mem heads;        /* rt_u32 [height][width], the lists of splats */
    cl_mem pass;         /* rt_film_pixel [height][width], the film of an iteration */
    cl_mem film;         /* the film on the device */
    rt_vertex_grid grid; /* where merging is used, and the radius of the first iteration */
    double radius;
    cl_mem own;       /* float [height][width], squared radii of pixels that are smaller, or NULL */
    rt_shrink shrink; /* of its square */
    rt_merge_moments moments; /* where the light of merging is added */
    float unit;               /* of lengths in the weights, m */
    rt_work work;
} rt_vcm;

/* Whether weights count merging; rt_vcm_merges: whether its light is added, too. */
int rt_vcm_uses_merging(const rt_vcm *vcm);

/* The programs of light and camera paths, with kernels vcm_light and vcm_camera. */
const char *rt_vcm_light_program(const rt_render_job *job);
const char *rt_vcm_camera_program(const rt_render_job *job);

/* Compiles the kernels, as part of the stage `compile`. */
rt_status rt_vcm_prepare(rt_vcm *vcm, rt_stage_progress *progress, rt_error *error);

/* Makes memory for iterations, and the film on the device. */
rt_status rt_vcm_begin(rt_vcm *vcm, rt_error *error);

/* Frees all that there is, also after a failure. */
void rt_vcm_free(rt_vcm *vcm);

/*
 * Chooses the radius of the first iteration and those of pixels by a pilot, where none is given and
 * merging is shown.
 */
rt_status rt_vcm_choose_radii(rt_vcm *vcm, rt_stage_progress *progress, rt_error *error);

/*
 * Adds the iteration of this number to the film, and to the layers of the first hit. Where it fails
 * or is cancelled, the film has no part of it.
 */
rt_status rt_vcm_iterate(rt_vcm *vcm, uint32_t number, rt_stage_progress *progress,
                         rt_error *error);

/* Reads the film from the device, and the layers of the first hit; writes them. */
rt_status rt_vcm_read(const rt_vcm *vcm, rt_error *error);
rt_status rt_vcm_write(const rt_vcm *vcm, rt_error *error);

#endif
