/* renderer.h - a scene made ready on a device, and the modes that render it. */
#ifndef RT_LIB_RENDER_RENDERER_H
#define RT_LIB_RENDER_RENDERER_H

#include "base/progress.h"
#include "device/device.h"
#include "pack/pack.h"
#include "render/film.h"
#include "rt.h"
#include "setting/options.h"
#include "types.h"

struct rt_renderer {
    rt_device *device;
    rt_scene_image image; /* on the host; freed when the device has its copy */
    cl_mem scene;         /* the same on the device */
    rt_camera camera;
    int has_camera, has_light, casts_hidden_caustics;
    rt_render_options options; /* the scene's own */
    double build_seconds;
};

/*
 * Whether the photons of a loaded map can be used in a render: they are of its scene and fit its
 * direct light.
 */
rt_status rt_photon_map_check(const rt_photon_map *map, const rt_renderer *renderer,
                              const rt_render_options *options, rt_error *error);

/* Parameters of a launch that follow from the options; items and samples are left to the caller. */
rt_params rt_params_make(const rt_render_options *options);

/*
 * Builds one of the library's kernels, and has the driver compile it for the device's work-group
 * size by a launch without items, so that the first true launch is not the slow one. args as for
 * rt_kernel_args; the first must be an rt_params, which is sent with item_count 0. Runs as part of
 * the stage `compile`.
 */
rt_status rt_kernel_prepare(rt_device *device, cl_kernel *out, const char *program,
                            const char *kernel, const rt_arg *args, cl_uint count,
                            rt_stage_progress *progress, rt_error *error);

/* Builds the kernel that emits photons: the same, with the arguments that it has. */
rt_status rt_emit_kernel_prepare(cl_kernel *out, const rt_renderer *renderer,
                                 rt_stage_progress *progress, rt_error *error);

/*
 * Finds the solids that the camera and the lights lie in and notes them in the scene on the device;
 * nothing where no material lets light in. Runs as part of a stage.
 */
rt_status rt_renderer_enclose(rt_renderer *renderer, const rt_scene *scene, size_t light_count,
                              rt_stage_progress *progress, rt_error *error);

/*
 * Photon mapping, and the modes that take samples of pixels one by one: all others. Each fills
 * film->pixels, the layers asked for and the film's stats; options are complete. On RT_CANCELLED
 * the film holds the samples so far.
 */
rt_status rt_render_samples(rt_renderer *renderer, const rt_render_options *options, rt_film *film,
                            rt_error *error);
rt_status rt_render_photon(rt_renderer *renderer, const rt_render_options *options, rt_film *film,
                           rt_error *error);

/* What the options of photon mode, completed, must be to each other. */
rt_status rt_photon_mode_check(const rt_render_options *options, rt_error *error);

#endif
