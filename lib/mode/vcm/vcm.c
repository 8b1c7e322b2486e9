/*
 * vcm.c - the mode vcm: paths from the lights and from the camera, joined by several techniques at
 * once, by the kernels vcm_light.cl and vcm_camera.cl; iteration after iteration.
 */
#include <math.h>

#include "base/error.h"
#include "mode/modes.h"
#include "mode/vcm/iteration.h"

static rt_status check(const rt_render_options *o, rt_error *error)
{
    const rt_u32 shown = rt_vcm_shown(o);
    if (shown == 0)
        return rt_fail_field(error, RT_ERROR_USAGE, "contribution",
                             "`techniques` leave all of this out");
    if (rt_noise_wanted(o) && o->spp < 2)
        return rt_fail_field(error, RT_ERROR_USAGE,
                             o->target_error > 0 ? "target_error" : "variance",
                             "one sample a pixel cannot tell its error");
    return RT_OK;
}

static void programs(rt_program_list *list, const rt_render_job *job)
{
    static const char *const merging[] = {"prefix_sum", "vcm_grid", "photon_order"};
    rt_program_list_add(list, rt_vcm_light_program(job));
    rt_program_list_add(list, rt_vcm_camera_program(job));
    rt_program_list_add(list, "vcm_film");
    rt_program_list_add(list, "photon_film");
    for (size_t i = 0; i < sizeof merging / sizeof *merging && rt_vcm_merges(job->options); i++)
        rt_program_list_add(list, merging[i]);
}

static rt_status prepare(const rt_render_job *job, void *state, rt_stage_progress *progress,
                         rt_error *error)
{
    rt_vcm *vcm = state;
    vcm->job = job;
    vcm->device = job->renderer->device;
    return rt_vcm_prepare(vcm, progress, error);
}

/* Tests the error, shows a preview and makes a checkpoint where these are due. */
static rt_status look(rt_vcm *vcm, rt_stage_progress *progress, rt_error *error)
{
    const int test = rt_work_test_is_due(&vcm->work), show = rt_work_preview_is_due(&vcm->work),
              save = rt_work_save_is_due(&vcm->work);
    const double began = rt_clock();
    rt_status status = RT_OK;
    if (test || show || save)
        status = rt_vcm_read(vcm, error);
    if (status == RT_OK && test)
        rt_work_test(&vcm->work);
    if (status == RT_OK && show)
        rt_work_preview(&vcm->work, began);
    if (status == RT_OK && save && rt_work_save(&vcm->work))
        status = rt_vcm_write(vcm, error);
    progress->error = rt_noise_last(&vcm->work.noise);
    return status;
}

/* Iteration after iteration, until there are enough, or time is up, or the error small. */
static rt_status iterate(rt_vcm *vcm, rt_stage_progress *progress, rt_error *error)
{
    const rt_render_options *o = vcm->job->options;
    double longest = 0;
    rt_unit_range run;
    rt_status status = RT_OK;
    while (status == RT_OK && rt_work_next(&vcm->work, &run)) {
        const double began = rt_clock(), from = rt_work_fraction(&vcm->work);
        const double to = from + fmax(1 / vcm->work.all, o->time > 0 ? longest / o->time : 0);
        rt_stage_part(progress, from, fmin(to, 1));
        if (run.count > 0)
            status = rt_vcm_iterate(vcm, (uint32_t)run.first, progress, error);
        if (status == RT_OK && run.count > 0)
            status = rt_work_done(&vcm->work, run, error);
        if (status == RT_OK)
            status = look(vcm, progress, error);
        longest = fmax(longest, rt_clock() - began);
    }
    return status;
}

static const char *leaves_out(const rt_renderer *renderer, const rt_render_options *o)
{
    if (!rt_mode_has_caustics(renderer, o, RT_CAUSTICS_DIFFUSE | RT_CAUSTICS_ROUGH))
        return NULL;
    return o->techniques == RT_TECHNIQUES_PT    ? RT_DELTA_CAUSTICS
           : o->techniques == RT_TECHNIQUES_BPT ? RT_DELTA_CAUSTICS
               " that are seen through such surfaces"
                                                : NULL;
}

/* Warns of light that the techniques do not find; single ones are known not to find all of it. */
static void warn(const rt_vcm *vcm)
{
    const rt_render_options *o = vcm->job->options;
    const rt_u32 used = rt_vcm_techniques(o->techniques);
    const char *const missing = leaves_out(vcm->job->renderer, o);
    if (missing)
        rt_warn(o->hooks, "the techniques %s leave out %s; the techniques vcm show them",
                o->techniques == RT_TECHNIQUES_BPT ? "bpt" : "pt", missing);
    if (vcm->lights.reach > 0 && !(used & RT_TECHNIQUE_NEE))
        rt_warn(o->hooks,
                "light paths of the sky and of directional lights fall on planes only within %.3g "
                "m of the %s, so that these techniques lose the light farther out; the techniques "
                "vcm and bpt find it",
                vcm->lights.reach, vcm->lights.reach_from);
}

static rt_status run(const rt_render_job *job, void *state, rt_error *error)
{
    rt_vcm *vcm = state;
    rt_stage_progress progress;
    rt_status status = rt_vcm_begin(vcm, error);
    if (status != RT_OK)
        return status;
    warn(vcm);
    status = rt_work_begin_stage(&vcm->work, &progress, RT_STAGE_RENDER);
    if (status != RT_OK)
        return status;
    rt_work_time(&vcm->work, &job->film->stats.render_seconds);
    rt_profile *const profile = vcm->work.profile;
    rt_profile_begin(profile, "trace");
    status = rt_vcm_choose_radii(vcm, &progress, error);
    if (status == RT_OK)
        status = iterate(vcm, &progress, error);
    rt_profile_end(profile);
    if (status == RT_OK || status == RT_CANCELLED) {
        const rt_status read = rt_vcm_read(vcm, error);
        const rt_status end = rt_stage_end(&progress, NULL);
        rt_work_end_time(&vcm->work);
        status = read != RT_OK ? read : status != RT_OK ? status : end;
    }
    return status;
}

static void release(void *state)
{
    rt_vcm_free(state);
}

const rt_mode_class rt_mode_vcm = {
    .has_noise = 1,
    .state_size = sizeof(rt_vcm),
    .check = check,
    .leaves_out = leaves_out,
    .programs = programs,
    .prepare = prepare,
    .run = run,
    .release = release,
};
