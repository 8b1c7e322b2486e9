/*
 * path.c - the mode path: path tracing with next-event estimation, by the kernel path.cl or, where
 * media scatter, path_media.cl or path_grids.cl.
 */
#include "mode/modes.h"
#include "mode/pixel_samples.h"
#include "scene/scene.h"

/* Which modes show the caustics that this one leaves out. */
static const char *modes_with_caustics(const rt_renderer *renderer)
{
    if (renderer->has_media)
        return "mode photon shows those on diffuse surfaces";
    if (renderer->hidden_caustics & RT_CAUSTICS_ROUGH)
        return "mode vcm shows them, and mode photon those on diffuse surfaces";
    return "the modes photon and vcm show them";
}

static const char *leaves_out(const rt_renderer *renderer, const rt_render_options *options)
{
    const int all = RT_CAUSTICS_DIFFUSE | RT_CAUSTICS_ROUGH;
    return rt_mode_has_caustics(renderer, options, all) ? RT_DELTA_CAUSTICS : NULL;
}

static void warn_of_missing_caustics(const rt_render_job *job)
{
    const char *const missing = leaves_out(job->renderer, job->options);
    if (missing)
        rt_warn(job->options->hooks, "mode path leaves out %s; %s", missing,
                modes_with_caustics(job->renderer));
}

static const char *program_of(const rt_render_job *job)
{
    static const char *const programs_of[] = RT_PROGRAMS("path");
    return rt_renderer_program(job->renderer, programs_of);
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
    .leaves_out = leaves_out,
    .state_size = sizeof(rt_pixel_samples),
    .check = rt_pixel_samples_check,
    .programs = programs,
    .prepare = prepare,
    .run = rt_pixel_samples_run,
    .release = rt_pixel_samples_release,
};
