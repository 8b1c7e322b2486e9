/* direct.c - the mode direct: emission and direct light at the first hit, by direct.cl. */
#include "mode/modes.h"
#include "mode/pixel_samples.h"

static void programs(rt_program_list *list, const rt_render_job *job)
{
    (void)job;
    rt_program_list_add(list, "direct");
}

static rt_status prepare(const rt_render_job *job, void *state, rt_stage_progress *progress,
                         rt_error *error)
{
    return rt_pixel_samples_prepare(state, job, "direct", 1, progress, error);
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
