/* render.c - `rtc SCENE`: a scene becomes image files. */
#include <stdlib.h>
#include <string.h>

#include "interrupt.h"
#include "message.h"
#include "nearest.h"
#include "outputs.h"
#include "progress.h"
#include "rt.h"
#include "rtc.h"
#include "scene_file.h"
#include "stats.h"

/* Everything that one render holds. */
typedef struct render_job {
    const command_line *arguments;
    const char *scene_path;
    int quiet;
    output_list outputs;
    progress_display progress;
    rt_hooks hooks;
    rt_render_options options;
    rt_scene *scene;
    rt_device *device;
    rt_renderer *renderer;
    rt_film *film;
} render_job;

static const option_value *value(const render_job *job, option_id id)
{
    return &job->arguments->options[id];
}

/* ---- Hooks ---------------------------------------------------------------- */

static int on_progress(void *user, const rt_progress *report)
{
    render_job *job = user;
    int stop = interrupt_pending();
    if (!stop)
        progress_show(&job->progress, report);
    return stop;
}

static void on_log(void *user, const char *line)
{
    render_job *job = user;
    progress_clear(&job->progress);
    message_note("%s", line);
}

static void begin_hooks(render_job *job)
{
    const option_value *style = value(job, OPTION_PROGRESS);
    job->progress = progress_begin(style->given ? (progress_style)style->choice
                                   : job->quiet ? PROGRESS_NONE
                                                : PROGRESS_AUTO);
    job->hooks.progress = on_progress;
    job->hooks.log = value(job, OPTION_VERBOSE)->given ? on_log : NULL;
    job->hooks.user = job;
}

/* ---- Options -------------------------------------------------------------- */

static void set_u32(uint32_t *out, const option_value *value)
{
    if (value->given)
        *out = (uint32_t)value->count;
}

/* What the command line says goes before what the scene says. */
static void merge_options(render_job *job)
{
    rt_render_options *options = &job->options;
    rt_scene_get_options(job->scene, options);
    options->hooks = &job->hooks;
    set_u32(&options->width, value(job, OPTION_WIDTH));
    set_u32(&options->height, value(job, OPTION_HEIGHT));
    set_u32(&options->spp, value(job, OPTION_SPP));
    set_u32(&options->max_depth, value(job, OPTION_MAX_DEPTH));
    set_u32(&options->seed, value(job, OPTION_SEED));
    set_u32(&options->k, value(job, OPTION_K));
    set_u32(&options->final_gather, value(job, OPTION_FINAL_GATHER));
    if (value(job, OPTION_PHOTONS)->given)
        options->photons = value(job, OPTION_PHOTONS)->count;
    if (value(job, OPTION_TIME)->given)
        options->time = value(job, OPTION_TIME)->real;
    if (value(job, OPTION_RADIUS)->given)
        options->radius = (float)value(job, OPTION_RADIUS)->real;
    if (value(job, OPTION_CONE_K)->given)
        options->cone_k = (float)value(job, OPTION_CONE_K)->real;
    if (value(job, OPTION_MODE)->given)
        options->mode = (rt_mode)value(job, OPTION_MODE)->choice;
    if (value(job, OPTION_SAMPLER)->given)
        options->sampler = (rt_sampler)value(job, OPTION_SAMPLER)->choice;
    if (value(job, OPTION_FILTER)->given)
        options->filter = (rt_filter)value(job, OPTION_FILTER)->choice;
    if (value(job, OPTION_ESTIMATOR)->given)
        options->estimator = (rt_estimator)value(job, OPTION_ESTIMATOR)->choice;
    if (value(job, OPTION_AOV)->given)
        options->aov = 1;
    if (value(job, OPTION_KERNEL)->given)
        options->kernel = (rt_density)value(job, OPTION_KERNEL)->choice;
    if (value(job, OPTION_DIRECT)->given)
        options->direct = (rt_direct)value(job, OPTION_DIRECT)->choice;
}

/* An option that cannot change anything in this render is probably a mistake. */
static void warn_idle_options(const render_job *job)
{
    for (int i = 0; i < OPTION_COUNT; i++)
        if (option_table[i].group == GROUP_PHOTON && job->options.mode != RT_MODE_PHOTON &&
            value(job, (option_id)i)->given)
            message_warning("--%s has no effect in %s mode; --mode photon asks for photon mapping",
                            option_table[i].name, rt_mode_name(job->options.mode));
    if (value(job, OPTION_CONE_K)->given && job->options.mode == RT_MODE_PHOTON &&
        job->options.kernel != RT_DENSITY_CONE)
        message_warning("--cone-k has no effect without --kernel cone");
    if (!outputs_have_8bit(&job->outputs) && (value(job, OPTION_EXPOSURE)->given || value(job, OPTION_TONEMAP)->given))
        message_warning("--exposure and --tonemap have no effect on .exr and .pfm, which hold radiance");
}

/* A failure of the library; where an option is at fault, by its name on the command line. */
static int fail(const rt_error *error)
{
    if (error->status != RT_ERROR_USAGE || !error->field[0] || error->line)
        return message_failure(error);
    char name[sizeof error->field];
    snprintf(name, sizeof name, "%s", error->field);
    for (char *c = name; *c; c++)
        if (*c == '_')
            *c = '-';
    message_error("--%s: %s", name, error->message);
    return STATUS_USAGE;
}

/* ---- The steps ------------------------------------------------------------ */

static int load(render_job *job)
{
    rt_error error;
    int status = scene_file_load(&job->scene, job->scene_path, job->quiet, NULL);
    if (status != STATUS_DONE)
        return status;
    merge_options(job);
    if (!job->quiet)
        warn_idle_options(job);
    /* Options out of range are told before any work. */
    return rt_scene_set_options(job->scene, &job->options, &error) == RT_OK ? STATUS_DONE : fail(&error);
}

static int open_device(render_job *job)
{
    rt_device_options options = {0};
    rt_error error;
    options.select = value(job, OPTION_DEVICE)->text;
    set_u32(&options.threads, value(job, OPTION_THREADS));
    set_u32(&options.work_group, value(job, OPTION_WORK_GROUP));
    if (rt_device_open(&job->device, &options, &error) != RT_OK)
        return fail(&error);
    if (value(job, OPTION_VERBOSE)->given) {
        rt_device_info info;
        rt_device_get_info(job->device, &info);
        message_note("device %s, %s, %u compute unit%s", info.name, info.platform, (unsigned)info.compute_units,
                     info.compute_units == 1 ? "" : "s");
    }
    return STATUS_DONE;
}

static int make_film(render_job *job)
{
    rt_renderer_options options = {0};
    rt_error error;
    options.hooks = &job->hooks;
    if (value(job, OPTION_ACCEL)->given)
        options.accel = (rt_accel)value(job, OPTION_ACCEL)->choice;
    rt_status result = rt_renderer_create(&job->renderer, job->scene, job->device, &options, &error);
    if (result == RT_OK)
        result = rt_render(&job->film, job->renderer, &job->options, &error);
    progress_clear(&job->progress);
    if (result == RT_CANCELLED)
        return STATUS_INTERRUPTED;
    return result == RT_OK ? STATUS_DONE : fail(&error);
}

/* "a", "a and b", "a, b and c". */
static void join_outputs(char *out, size_t size, const output_list *outputs)
{
    out[0] = '\0';
    for (size_t i = 0; i < outputs->count; i++) {
        size_t used = strlen(out);
        const char *before = i == 0 ? "" : i + 1 == outputs->count ? " and " : ", ";
        snprintf(out + used, size - used, "%s%s", before, outputs->paths[i]);
    }
}

static void say_what_was_written(const render_job *job, int interrupted)
{
    char names[1024], seconds[32];
    uint32_t width, height;
    rt_film_stats stats;
    rt_film_get_stats(job->film, &stats);
    rt_film_get_size(job->film, &width, &height);
    join_outputs(names, sizeof names, &job->outputs);
    progress_format_time(seconds, sizeof seconds, stats.emit_seconds + stats.gather_seconds + stats.render_seconds);
    message_note("%swrote %s: %u x %u, %u sample%s a pixel, rendered in %s", interrupted ? "interrupted; " : "", names,
                 (unsigned)width, (unsigned)height, (unsigned)stats.spp, stats.spp == 1 ? "" : "s", seconds);
}

/* The command line as far as it decides the pixels, so that two equal images are equal files. */
static char *recorded_command(const render_job *job)
{
    size_t size = strlen(job->scene_path) + 8;
    for (int i = 0; i < OPTION_COUNT; i++)
        if (option_table[i].decides_pixels && value(job, (option_id)i)->given)
            size += strlen(option_table[i].name) + strlen(value(job, (option_id)i)->text) + 4;
    char *line = malloc(size);
    if (!line)
        return NULL;
    size_t used = (size_t)snprintf(line, size, "rtc %s", job->scene_path);
    for (int i = 0; i < OPTION_COUNT; i++)
        if (option_table[i].decides_pixels && value(job, (option_id)i)->given)
            used += (size_t)snprintf(line + used, size - used, " --%s %s", option_table[i].name,
                                     value(job, (option_id)i)->text);
    return line;
}

/* Writes the film; an interrupted one is written too, as far as it came. */
static int write_images(const render_job *job, int status)
{
    if (!job->film) {
        message_note("interrupted before the first sample; nothing was written");
        return STATUS_INTERRUPTED;
    }
    rt_image_options options = {0};
    options.exposure = value(job, OPTION_EXPOSURE)->given ? (float)value(job, OPTION_EXPOSURE)->real : 0.0f;
    options.tonemap =
        value(job, OPTION_TONEMAP)->given ? (rt_tonemap)value(job, OPTION_TONEMAP)->choice : RT_TONEMAP_NONE;
    options.scene = job->scene_path;
    char *command = recorded_command(job);
    options.command = command;
    int written = outputs_write(&job->outputs, job->film, &options);
    free(command);
    if (written != STATUS_DONE)
        return written;
    if (!job->quiet || status == STATUS_INTERRUPTED)
        say_what_was_written(job, status == STATUS_INTERRUPTED);
    if (value(job, OPTION_STATS)->given)
        stats_print(job->scene, job->device, &job->options, job->film);
    return status;
}

static int run(render_job *job)
{
    int status = outputs_plan(&job->outputs, job->arguments, job->scene_path);
    if (status == STATUS_DONE)
        status = load(job);
    if (status == STATUS_DONE)
        status = open_device(job);
    if (status == STATUS_DONE)
        status = make_film(job);
    if (status == STATUS_DONE || status == STATUS_INTERRUPTED)
        status = write_images(job, status);
    return status;
}

/* Says that there is not one scene; a mistyped subcommand looks like a scene too many. */
static int fail_operands(const command_line *arguments)
{
    if (arguments->operand_count == 0) {
        message_error("which scene? usage: rtc SCENE.rts [OPTION]...");
        message_hint("`rtc --help` lists the options");
        return STATUS_USAGE;
    }
    message_error("one scene at a time: '%s' and '%s'", arguments->operands[0], arguments->operands[1]);
    nearest search = nearest_begin(arguments->operands[0]);
    for (int i = COMMAND_RENDER + 1; i < COMMAND_COUNT; i++)
        nearest_offer(&search, command_name((command_id)i));
    if (search.best)
        message_hint("did you mean `rtc %s`?", search.best);
    return STATUS_USAGE;
}

int command_render(const command_line *arguments)
{
    if (arguments->operand_count != 1)
        return fail_operands(arguments);
    render_job job = {0};
    job.arguments = arguments;
    job.scene_path = arguments->operands[0];
    job.quiet = arguments->options[OPTION_QUIET].given;
    begin_hooks(&job);
    interrupt_catch();
    int status = run(&job);
    rt_film_destroy(job.film);
    rt_renderer_destroy(job.renderer);
    rt_device_close(job.device);
    rt_scene_destroy(job.scene);
    outputs_free(&job.outputs);
    return status;
}
