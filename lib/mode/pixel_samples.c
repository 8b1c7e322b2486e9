/* pixel_samples.c - launches over the film, sized for frequent progress and a prompt cancel. */
#include "mode/pixel_samples.h"

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "film/rates.h"
#include "render/prepare.h"

/* Target duration of a launch: short enough for frequent progress and a prompt cancel. */
static const double launch_seconds = 0.2;

/* Of a launch. Few at first: a sample may take long, as in a dense medium on a grid. */
enum { least_samples = 256, first_samples = 2048 };

/* The place of the film among the arguments of the kernel. */
enum { FILM_ARGUMENT = 2 };

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

/* Launches the samples of some units, as rt_work_extend has them; those of the layers, too. */
static rt_status launch_units(const rt_render_job *job, const rt_pixel_samples *state,
                              rt_params *params, rt_unit_range units, int has_layers,
                              rt_error *error)
{
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
            status = rt_launch(state->device, state->kernel, (params->item_count + each - 1) / each,
                               error);
    }
    return status == RT_OK && has_layers ? rt_first_hit_layers_add(job->layers, params, error)
                                         : status;
}

/* Launches them and waits for them. */
static rt_status launch(const rt_render_job *job, const rt_pixel_samples *state, rt_params *params,
                        rt_unit_range units, rt_error *error)
{
    const rt_status status = launch_units(job, state, params, units, 1, error);
    return status == RT_OK ? rt_device_finish(job->renderer->device, error) : status;
}

/* Lets the kernel add to the film in this buffer. */
static rt_status set_film(const rt_pixel_samples *state, cl_mem pixels, rt_error *error)
{
    return rt_cl_check(clSetKernelArg(state->kernel, FILM_ARGUMENT, sizeof pixels, &pixels),
                       "setting the film of a kernel", error);
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

/* ---- Rates ----------------------------------------------------------------------------------- */

/* The options of a film that has the pilot of another alone. */
static rt_render_options pilot_of(const rt_render_options *options)
{
    rt_render_options o = *options;
    o.spp = RT_PILOT_SAMPLES;
    o.aov = 0;
    o.raised_from = 0;
    o.resume = NULL;
    o.note = NULL;
    return o;
}

/*
 * Renders the pilot of the whole picture into a film of its own, with the kernel of the render. The
 * render is no further by it.
 */
static rt_status render_pilot(rt_film *pilot, const rt_render_job *job,
                              const rt_pixel_samples *state, rt_stage_progress *progress,
                              double fraction, rt_error *error)
{
    const rt_render_job own = {
        .renderer = job->renderer, .options = &pilot->options, .film = pilot};
    const uint64_t count = pilot->units.count, items = pilot->units.items;
    double each = first_samples; /* units of a launch */
    rt_params params = rt_params_make(job->options);
    cl_mem pixels = NULL;
    rt_status status = rt_mirror_create(state->device, &pixels, rt_film_bytes(pilot), pilot->pixels,
                                        "the pilot's film", error);
    if (status == RT_OK)
        status = set_film(state, pixels, error);
    for (uint64_t at = 0; at < count && status == RT_OK;) {
        const uint64_t left = items - at % items;
        const rt_unit_range now = {at, each < (double)left ? (uint64_t)each : left};
        const double began = rt_clock();
        status = launch_units(&own, state, &params, now, 0, error);
        if (status == RT_OK)
            status = rt_device_finish(state->device, error);
        adapt(&each, rt_clock() - began);
        at += now.count;
        if (status == RT_OK)
            status = rt_stage_update(progress, fraction);
    }
    if (status == RT_OK)
        status = rt_mirror_read(state->device, pixels, rt_film_bytes(pilot), pilot->pixels, error);
    rt_buffer_release(state->device, pixels);
    const rt_status back = set_film(state, state->pixels, error);
    return status == RT_OK ? back : status;
}

/* Finds the rates by a pilot whose samples the film need not have. */
static rt_status find_rates(const rt_render_job *job, const rt_pixel_samples *state,
                            rt_stage_progress *progress, double fraction, rt_error *error)
{
    const rt_render_options o = pilot_of(job->options);
    rt_film *pilot = NULL;
    rt_status status = rt_film_create(&pilot, &o, state->device->memory, error);
    if (status == RT_OK)
        status = render_pilot(pilot, job, state, progress, fraction, error);
    if (status == RT_OK)
        status = rt_rates_find(job->film, pilot, error);
    rt_film_destroy(pilot);
    return status;
}

/* Makes the rates ready for a unit that needs them. */
static rt_status take_rates(const rt_render_job *job, rt_pixel_samples *state, uint64_t unit,
                            rt_stage_progress *progress, double fraction, rt_error *error)
{
    rt_film *film = job->film;
    rt_status status = RT_OK;
    if (state->rates_are_written || !rt_rates_are_needed(film, unit))
        return RT_OK;
    if (!rt_rates_are_known(film) && rt_rates_can_be_found(film)) {
        status = read_sums(job, state, error);
        if (status == RT_OK)
            status = rt_rates_find(film, film, error);
    } else if (!rt_rates_are_known(film)) {
        status = find_rates(job, state, progress, fraction, error);
    }
    if (status == RT_OK)
        status = rt_buffer_write(state->device, state->rates, 0,
                                 rt_film_pixels(film) * sizeof *film->rates, film->rates, error);
    state->rates_are_written = status == RT_OK;
    return status;
}

/* ---- The loop -------------------------------------------------------------------------------- */

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
static rt_status sample_film(const rt_render_job *job, rt_pixel_samples *state, rt_work *work,
                             rt_stage_progress *progress, rt_error *error)
{
    rt_params params = rt_params_make(job->options);
    params.pilot = job->film->units.pilot;
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
        else
            status = take_rates(job, state, run.first, progress, rt_work_fraction(work), error);
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
                             options->target_error > 0 ? "target_error"
                             : options->variance       ? "variance"
                                                       : "sampling",
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
    if (status == RT_OK && job->film->rates)
        status = rt_buffer_create(device, &out->rates, CL_MEM_READ_ONLY,
                                  rt_film_pixels(job->film) * sizeof *job->film->rates, NULL,
                                  "the rates of pixels", error);
    /* Without rates some buffer stands for them, which is not read. */
    const cl_mem rates = out->rates ? out->rates : job->renderer->scene;
    rt_arg args[] = {RT_ARG(none), RT_ARG(job->renderer->scene), RT_ARG(out->pixels),
                     RT_ARG(rates)};
    if (status == RT_OK)
        status = rt_kernel_prepare(device, &out->kernel, kernel, kernel, args, 4, progress, error);
    return status;
}

rt_status rt_pixel_samples_run(const rt_render_job *job, void *state, rt_error *error)
{
    rt_pixel_samples *samples = state;
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
    rt_buffer_release(samples->device, samples->rates);
}
