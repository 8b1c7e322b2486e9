/*
 * path.c - the mode path: path tracing with next-event estimation, by the kernel path.cl or, where
 * media scatter, path_media.cl or path_grids.cl.
 */
#include "mode/modes.h"
#include "mode/pixel_samples.h"

/* The shortest path of a caustic: from the eye to a diffuse surface, to a mirror and to a light. */
enum { caustic_depth = 3 };

static void warn_of_missing_caustics(const rt_render_job *job)
{
    if (job->renderer->casts_hidden_caustics && job->options->max_depth >= caustic_depth)
        rt_warn(
            job->options->hooks,
            "mode path leaves out caustics of point, spot and directional lights (through smooth "
            "mirrors or glass); the modes photon and vcm show them");
}

static const char *program_of(const rt_render_job *job)
{
    return job->renderer->has_grids   ? "path_grids"
           : job->renderer->has_media ? "path_media"
                                      : "path";
}

static void programs(rt_program_list *list, const rt_render_job *job)
{
    rt_program_list_add(list, program_of(job));
}

static rt_status prepare(const rt_render_job *job, void *state, rt_stage_progress *progress,
                         rt_error *error)
{
    warn_of_missing_caustics(job);
    return rt_pixel_samples_prepare(state, job, program_of(job), job->renderer->device->path_pixels,
                                    progress, error);
}

const rt_mode_class rt_mode_path = {
    .has_noise = 1,
    .knows_media = 1,
    .knows_grids = 1,
    .state_size = sizeof(rt_pixel_samples),
    .check = rt_pixel_samples_check,
    .programs = programs,
    .prepare = prepare,
    .run = rt_pixel_samples_run,
    .release = rt_pixel_samples_release,
};
