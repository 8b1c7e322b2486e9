/* eye_kernels.h - the kernels of the camera's half of photon mapping. */
#ifndef RT_LIB_MODE_PHOTON_EYE_KERNELS_H
#define RT_LIB_MODE_PHOTON_EYE_KERNELS_H

#include "mode/mode.h"
#include "photon/gather.h"

/* The kernels of the camera's half. */
typedef struct rt_eye_kernels {
    cl_kernel camera;     /* of rt_camera_kernel_name */
    cl_kernel gather;     /* that of rt_gather_kernel_prepare */
    cl_kernel irradiance; /* likewise, where rt_eye_paths_take_irradiance; else NULL */
    cl_kernel film;       /* photon_film, and the others of its program: */
    cl_kernel join, count, moments;
    cl_kernel sectors, test; /* of photon_radius, where the radius is tested; else NULL */
} rt_eye_kernels;

/* Whether the final gather takes precomputed irradiance. */
int rt_eye_paths_take_irradiance(const rt_render_options *options);

/* The kernel of camera paths for a scene, and the program of the same name. */
const char *rt_camera_kernel_name(const rt_renderer *renderer);

/* Builds the kernels, as part of the stage `compile`. Release with rt_eye_kernels_release. */
rt_status rt_eye_kernels_prepare(rt_eye_kernels *out, const rt_render_job *job,
                                 rt_photon_search search, rt_stage_progress *progress,
                                 rt_error *error);
void rt_eye_kernels_release(rt_eye_kernels *kernels);

#endif
