/* direct.c - the mode direct: emission and direct light at the first hit, by direct.cl. */
#include "mode/modes.h"
#include "mode/pixel_samples.h"

static const char *program_of(const rt_render_job *job)
{
    return job->renderer->has_dispersion ? "direct_dispersive"
           : job->renderer->is_plain     ? "direct_plain"
                                         : "direct";
}

static void programs(rt_program_list *list, const rt_render_job *job)
{
    rt_program_list_add(list, program_of(job));
}

static rt_status prepare(const rt_render_job *job, void *state, rt_stage_progress *progress,
                         rt_error *error)
{
    return rt_pixel_samples_prepare(state, job, program_of(job), job->renderer->device->path_pixels,
                                    progress, error);
}

const rt_mode_class rt_mode_direct = {
    .has_noise = 1,
    .state_size = sizeof(rt_pixel_samples),
    .check = rt_pixel_samples_check,
    .programs = programs,
    .prepare = prepare,
    .run = rt_pixel_samples_run,
    .release = rt_pixel_samples_release,
};
