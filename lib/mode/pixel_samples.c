/* pixel_samples.c - launches over the film, sized for frequent progress and a prompt cancel. */
#include "mode/pixel_samples.h"

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "render/prepare.h"

/* Target duration of a launch: short enough for frequent progress and a prompt cancel. */
static const double launch_seconds = 0.2;

/* Of a launch. Few at first: a sample may take long, as in a dense medium on a grid. */
enum { least_samples = 256, first_samples = 2048 };

/* Adapts the samples of a launch to the time that the last one took. */
static void adapt(double *samples, double seconds)
{
    if (seconds < 0.5 * launch_seconds)
        *samples *= 2;
    else if (seconds > 2 * launch_seconds)
        *samples = fmax(*samples * launch_seconds / seconds, least_samples);
}

/* The samples of a pixel in some units of one block, or in whole blocks. */
static rt_sample_block samples_of(const rt_units *units, rt_unit_range range)
{
    rt_sample_block all = rt_units_block(units, range.first);
    for (uint64_t i = units->items; i < range.count; i += units->items)
        all.count += rt_units_block(units, range.first + i).count;
    return all;
}

/* Launches the samples of some units, as rt_work_extend has them, and waits for them. */
static rt_status launch(const rt_render_job *job, const rt_pixel_samples *state, rt_params *params,
                        rt_unit_range units, rt_error *error)
{
    rt_device *device = job->renderer->device;
    const uint32_t items = job->film->units.items;
    const rt_sample_block block = samples_of(&job->film->units, units);
    rt_status status = RT_OK;
    if (block.count == 0)
        return RT_OK;
    params->first_item = (uint32_t)(units.first % items);
    params->item_count = units.count < items ? (uint32_t)units.count : items;
    params->replicate = params->plane = block.replicate;
    params->first_sample = block.first;
    params->sample_count = block.count;
    params->pixels_an_item = state->kernel ? state->pixels_an_item : 1;

    if (state->kernel) {
        uint32_t each = state->pixels_an_item;
        rt_arg first = {sizeof *params, params};
        status = rt_kernel_args(state->kernel, &first, 1, error);
        if (status == RT_OK)
            status =
                rt_launch(device, state->kernel, (params->item_count + each - 1) / each, error);
    }
    if (status == RT_OK)
        status = rt_first_hit_layers_add(job->layers, params, error);
    return status == RT_OK ? rt_device_finish(device, error) : status;
}

/* Reads the sums from the device, those of the layers too. */
static rt_status read_sums(const rt_render_job *job, const rt_pixel_samples *state, rt_error *error)
{
    rt_film *film = job->film;
    rt_status status = RT_OK;
    rt_profile_begin(job->renderer->device->profile, "read film");
    if (state->kernel)
        status =
            rt_mirror_read(state->device, state->pixels, rt_film_bytes(film), film->pixels, error);
    if (status == RT_OK)
        status = rt_first_hit_layers_read(job->layers, film, error);
    rt_profile_end(job->renderer->device->profile);
    return status;
}

/* Writes the sums to the device. */
static rt_status write_sums(const rt_render_job *job, const rt_pixel_samples *state,
                            rt_error *error)
{
    const rt_film *film = job->film;
    rt_status status = RT_OK;
    if (state->kernel)
        status =
            rt_mirror_write(state->device, state->pixels, rt_film_bytes(film), film->pixels, error);
    return status == RT_OK ? rt_first_hit_layers_write(job->layers, film, error) : status;
}

/* Tests the error, shows a preview and makes a checkpoint where these are due. */
static rt_status look(const rt_render_job *job, const rt_pixel_samples *state, rt_work *work,
                      rt_stage_progress *progress, rt_error *error)
{
    const int test = rt_work_test_is_due(work), show = rt_work_preview_is_due(work),
              save = rt_work_save_is_due(work);
    const double began = rt_clock();
    rt_status status = RT_OK;
    if (test || show || save)
        status = read_sums(job, state, error);
    if (status == RT_OK && test)
        rt_work_test(work);
    if (status == RT_OK && show)
        rt_work_preview(work, began);
    if (status == RT_OK && save && rt_work_save(work))
        status = write_sums(job, state, error);
    progress->error = rt_noise_last(&work->noise);
    return status;
}

/* Takes units until there are no more, a launch at a time. */
static rt_status sample_film(const rt_render_job *job, const rt_pixel_samples *state, rt_work *work,
                             rt_stage_progress *progress, rt_error *error)
{
    rt_params params = rt_params_make(job->options);
    double samples = first_samples; /* a launch */
    rt_status status = RT_OK;
    rt_unit_range run;

    while (status == RT_OK && rt_work_next(work, &run)) {
        const uint32_t each = rt_units_block(&job->film->units, run.first).count;
        /* Where a block takes little time, several make a launch. */
        while (2.0 * samples_of(&job->film->units, run).count * job->film->units.items <= samples &&
               rt_work_extend(work, &run))
            continue;
        if (run.count == 0)
            status = look(job, state, work, progress, error);
        while (status == RT_OK && run.count > 0 && !rt_work_is_out_of_time(work)) {
            const int is_short = each == 0 || run.count > job->film->units.items;
            const double most = is_short ? (double)run.count : samples / each + 1;
            const rt_unit_range now = {run.first,
                                       (double)run.count < most ? run.count : (uint64_t)most};
            const double began = rt_clock();
            status = launch(job, state, &params, now, error);
            if (each > 0)
                adapt(&samples, rt_clock() - began);
            if (status == RT_OK)
                status = rt_work_done(work, now, error);
            if (status == RT_OK)
                status = look(job, state, work, progress, error);
            if (status == RT_OK)
                status = rt_stage_update(progress, rt_work_fraction(work));
            run.first += now.count;
            run.count -= now.count;
        }
    }
    return status;
}

rt_status rt_pixel_samples_check(const rt_render_options *options, rt_error *error)
{
    if (rt_noise_wanted(options) && options->spp < 2)
        return rt_fail_field(error, RT_ERROR_USAGE,
                             options->target_error > 0 ? "target_error" : "variance",
                             "one sample a pixel cannot tell its error");
    return RT_OK;
}

rt_status rt_pixel_samples_prepare(rt_pixel_samples *out, const rt_render_job *job,
                                   const char *kernel, uint32_t pixels_an_item,
                                   rt_stage_progress *progress, rt_error *error)
{
    rt_device *device = job->renderer->device;
    rt_params none;

    memset(&none, 0, sizeof none);
    out->device = device;
    out->pixels_an_item = pixels_an_item;
    rt_status status = rt_mirror_create(device, &out->pixels, rt_film_bytes(job->film),
                                        job->film->pixels, "the film", error);
    rt_arg args[] = {RT_ARG(none), RT_ARG(job->renderer->scene), RT_ARG(out->pixels)};
    if (status == RT_OK)
        status = rt_kernel_prepare(device, &out->kernel, kernel, kernel, args, 3, progress, error);
    return status;
}

rt_status rt_pixel_samples_run(const rt_render_job *job, void *state, rt_error *error)
{
    const rt_pixel_samples *samples = state;
    rt_stage_progress progress;

    rt_work work = rt_work_begin(job->film, job->options);
    rt_status status = rt_work_begin_stage(&work, &progress, RT_STAGE_RENDER);
    if (status != RT_OK)
        return status;
    rt_work_time(&work, &job->film->stats.render_seconds);
    rt_profile *const profile = work.profile = job->renderer->device->profile;
    rt_profile_begin(profile, "trace");
    status = sample_film(job, samples, &work, &progress, error);
    rt_profile_end(profile);
    if (status == RT_OK || status == RT_CANCELLED) {
        rt_status read = read_sums(job, samples, error);
        rt_status end = rt_stage_end(&progress, NULL);
        rt_work_end_time(&work);
        status = read != RT_OK ? read : status != RT_OK ? status : end;
    }
    return status;
}

void rt_pixel_samples_release(void *state)
{
    rt_pixel_samples *samples = state;
    if (samples->device)
        rt_device_settle(samples->device); /* it may work on the film in place */
    rt_kernel_release(samples->kernel);
    rt_buffer_release(samples->device, samples->pixels);
}
