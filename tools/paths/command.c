/* command.c - `rtc paths`: the camera paths of a pixel, as JSON, lines and a page. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../commands.h"
#include "../interrupt.h"
#include "../message.h"
#include "../number.h"
#include "../outputs.h"
#include "../scene_file.h"
#include "../session.h"
#include "../settings.h"
#include "../status.h"
#include "write.h"

/* Everything that the command holds. */
typedef struct paths_job {
    session session;
    pixel_paths pixel;
    rt_render_options options;
    input_list inputs;
    rt_scene *scene;
    rt_device *device;
    rt_renderer *renderer;
    rt_paths *paths;
    size_t written; /* outputs */
} paths_job;

typedef int (*path_writer)(const pixel_paths *pixel, text_file *out);

static const struct {
    const char *extension;
    path_writer write;
} formats[] = {{".json", paths_write_json}, {".ply", paths_write_ply}, {".html", paths_write_page}};

static path_writer writer_of(const char *path)
{
    const char *extension = outputs_extension(path);
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++)
        if (strcmp(extension, formats[i].extension) == 0)
            return formats[i].write;
    return NULL;
}

/* ---- What is asked for ----------------------------------------------------------------------- */

/* Reads two whole numbers with this character between them. */
static int read_two(uint32_t out[2], const char *text, char between)
{
    char first[32];
    uint64_t values[2];
    const char *at = strchr(text, between);
    if (!at || (size_t)(at - text) >= sizeof first)
        return 0;
    memcpy(first, text, (size_t)(at - text));
    first[at - text] = '\0';
    if (number_count(&values[0], first) || number_count(&values[1], at + 1) ||
        values[0] > UINT32_MAX || values[1] > UINT32_MAX)
        return 0;
    out[0] = (uint32_t)values[0];
    out[1] = (uint32_t)values[1];
    return 1;
}

static int read_pixel(paths_job *job)
{
    const option_value *value = session_value(&job->session, OPTION_PIXEL);
    uint32_t at[2];
    if (!value->given) {
        message_error("which pixel? --pixel X,Y, counted from the top left, from 0");
        return STATUS_USAGE;
    }
    if (!read_two(at, value->text, ',')) {
        message_error("--pixel takes X,Y, as in --pixel 320,200; not '%s'", value->text);
        return STATUS_USAGE;
    }
    job->pixel.x = at[0];
    job->pixel.y = at[1];
    return STATUS_DONE;
}

/* --sample N or A-B; without it those of the picture, as far as they can be traced at once. */
static int read_samples(paths_job *job)
{
    const option_value *value = session_value(&job->session, OPTION_SAMPLE);
    pixel_paths *p = &job->pixel;
    uint32_t range[2];
    uint64_t one;
    if (!value->given) {
        if (job->options.spp > RT_PATHS_MAX && !job->session.quiet)
            message_warning("the first %u of %u samples: --sample A-B takes others", RT_PATHS_MAX,
                            (unsigned)job->options.spp);
        return STATUS_DONE;
    }
    if (number_count(&one, value->text) == 0 && one < UINT32_MAX)
        range[0] = range[1] = (uint32_t)one;
    else if (!read_two(range, value->text, '-') || range[1] < range[0] ||
             range[1] - range[0] >= RT_PATHS_MAX || range[1] == UINT32_MAX) {
        message_error("--sample takes a sample, or the first and the last of at most %u, counted "
                      "from 0, as in 4-7; not '%s'",
                      RT_PATHS_MAX, value->text);
        return STATUS_USAGE;
    }
    if (range[1] >= job->options.spp && !job->session.quiet)
        message_warning(
            "the picture has %u samples of a pixel, 0 to %u; those beyond are what more "
            "--spp would add",
            (unsigned)job->options.spp, (unsigned)job->options.spp - 1);
    p->first = range[0];
    p->count = range[1] - range[0] + 1;
    return STATUS_DONE;
}

/* Whether all outputs have a form that there is and can be written. */
static int check_outputs(const command_line *arguments)
{
    int status = STATUS_DONE;
    for (size_t i = 0; i < arguments->output_count && status == STATUS_DONE; i++) {
        if (!writer_of(arguments->outputs[i])) {
            message_error("cannot tell what to write to %s: a name ends in .json, .ply or .html",
                          arguments->outputs[i]);
            return STATUS_USAGE;
        }
        status = outputs_check_writable(arguments->outputs[i]);
    }
    return status;
}

static int is_typed(const paths_job *job, const char *name)
{
    return settings_text(job->session.arguments, rt_setting_find(name)) != NULL;
}

/* The settings of the scene and the command line, but mode path where no other is asked for. */
static void merge_options(paths_job *job)
{
    rt_render_options *o = &job->options;
    rt_scene_get_options(job->scene, o);
    if (o->mode != RT_MODE_PATH && !is_typed(job, "mode") && !job->session.quiet)
        message_note("the paths are those of mode path, which the scene is not rendered by");
    o->mode = RT_MODE_PATH;
    o->variance = 0;
    o->target_error = o->time = 0;
    session_merge_options(&job->session, o);
}

static int load(paths_job *job)
{
    const command_line *arguments = job->session.arguments;
    rt_render_options own;
    rt_error error;
    int status = scene_file_load(&job->scene, job->pixel.scene,
                                 job->session.quiet ? SCENE_QUIETLY : SCENE_TO_RENDER, NULL,
                                 &job->inputs, &job->session.progress, arguments);
    for (size_t i = 0; i < arguments->output_count && status == STATUS_DONE; i++)
        status = inputs_check(&job->inputs, arguments->outputs[i]);
    if (status != STATUS_DONE)
        return status;
    rt_scene_get_options(job->scene, &own);
    merge_options(job);
    status = session_check_options(&job->session, &own, &job->options);
    /* What is left out takes its default. */
    if (status == STATUS_DONE && rt_scene_set_options(job->scene, &job->options, &error) != RT_OK)
        status = session_fail(&error);
    if (status != STATUS_DONE)
        return status;
    rt_scene_get_options(job->scene, &job->options);
    job->options.hooks = &job->session.hooks;
    job->pixel.width = job->options.width;
    job->pixel.height = job->options.height;
    return read_samples(job);
}

/* ---- The work -------------------------------------------------------------------------------- */

static int trace(paths_job *job)
{
    const rt_renderer_options options = {.hooks = &job->session.hooks};
    pixel_paths *p = &job->pixel;
    rt_error error;
    rt_status result =
        rt_renderer_create(&job->renderer, job->scene, job->device, &options, &error);
    if (result == RT_OK)
        result = rt_paths_trace(&job->paths, job->renderer, &job->options, p->x, p->y, p->first,
                                p->count, &error);
    progress_clear(&job->session.progress);
    if (session_was_interrupted(result))
        return STATUS_INTERRUPTED;
    if (result != RT_OK)
        return session_fail(&error);
    p->paths = rt_paths_list(job->paths, &p->path_count);
    p->vertices = rt_paths_vertices(job->paths, &p->vertex_count);
    return STATUS_DONE;
}

/* The picture that a page draws the paths over. */
static int render(paths_job *job)
{
    const command_line *arguments = job->session.arguments;
    int wanted = 0;
    rt_error error;
    for (size_t i = 0; i < arguments->output_count; i++)
        wanted |= writer_of(arguments->outputs[i]) == paths_write_page;
    if (!wanted)
        return STATUS_DONE;
    const rt_status result = rt_render(&job->pixel.film, job->renderer, &job->options, &error);
    progress_clear(&job->session.progress);
    if (session_was_interrupted(result))
        return STATUS_INTERRUPTED;
    return result == RT_OK ? STATUS_DONE : session_fail(&error);
}

/* Writes one output; NULL: JSON on stdout. */
static int write_one(paths_job *job, const char *path)
{
    text_file out;
    if (!text_file_begin(&out))
        return STATUS_DEVICE;
    const path_writer write = path ? writer_of(path) : paths_write_json;
    int status = write(&job->pixel, &out);
    if (status == STATUS_DONE && interrupt_pending())
        status = STATUS_INTERRUPTED;
    const int ended = text_file_end(&out, status == STATUS_DONE, path);
    job->written += status == STATUS_DONE && ended == STATUS_DONE;
    if (status == STATUS_DONE && ended == STATUS_DONE && path && !job->session.quiet)
        message_note("wrote %s: %zu paths, %zu vertices", path, job->pixel.path_count,
                     job->pixel.vertex_count);
    return status == STATUS_DONE ? ended : status;
}

static int write_all(paths_job *job)
{
    const command_line *arguments = job->session.arguments;
    int status = arguments->output_count > 0 ? STATUS_DONE : write_one(job, NULL);
    for (size_t i = 0; i < arguments->output_count && status == STATUS_DONE; i++)
        status = write_one(job, arguments->outputs[i]);
    return status;
}

int command_paths(const command_line *arguments)
{
    paths_job job = {0};
    if (arguments->operand_count != 1) {
        message_error("which scene? usage: rtc paths SCENE --pixel X,Y [OPTION]...");
        return STATUS_USAGE;
    }
    job.pixel.scene = arguments->operands[0];
    session_begin(&job.session, arguments);
    int status = read_pixel(&job);
    if (status == STATUS_DONE)
        status = check_outputs(arguments);
    if (status == STATUS_DONE)
        status = load(&job);
    if (status == STATUS_DONE)
        status = session_open_device(&job.session, &job.device,
                                     session_value(&job.session, OPTION_DEVICE)->text);
    if (status == STATUS_DONE)
        status = trace(&job);
    if (status == STATUS_DONE)
        status = render(&job);
    if (status == STATUS_DONE)
        status = write_all(&job);
    if (status == STATUS_INTERRUPTED && !job.session.quiet)
        message_note("interrupted; %s",
                     job.written > 0 ? "not all was written" : "nothing was written");
    rt_paths_destroy(job.paths);
    rt_film_destroy(job.pixel.film);
    rt_renderer_destroy(job.renderer);
    rt_device_close(job.device);
    rt_scene_destroy(job.scene);
    inputs_free(&job.inputs);
    return status;
}
