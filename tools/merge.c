/* merge.c - `rtc merge`: joins the parts of a picture. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command_line.h"
#include "commands.h"
#include "film_note.h"
#include "inputs.h"
#include "message.h"
#include "other_work.h"
#include "outputs.h"
#include "recorded.h"
#include "session.h"
#include "status.h"

/* Everything that one merge holds. */
typedef struct merge_job {
    session session;
    const command_line *arguments;
    output_list outputs;
    input_list inputs;
    rt_film *film;         /* of all parts so far */
    command_line original; /* the command line of the render, from the film's note */
} merge_job;

/* A photon map has a command of its own. */
static void hint_maps(const char *path)
{
    if (strcmp(outputs_extension(path), ".rtp") == 0)
        message_hint("`rtc photons merge` joins photon maps");
}

static int fail_load(const char *path, const rt_error *error)
{
    int status = message_failure(error);
    hint_maps(path);
    return status;
}

/* Whether films that are to be joined are different files. */
static int check_films(const command_line *arguments)
{
    for (size_t i = 1; i < arguments->operand_count; i++)
        for (size_t j = 0; j < i; j++)
            if (inputs_are_same(arguments->operands[j], arguments->operands[i])) {
                message_error("%s is given twice: merged films must be of different parts",
                              arguments->operands[i]);
                return STATUS_USAGE;
            }
    return STATUS_DONE;
}

/* Adds the film at a path to the others. */
static int add(merge_job *job, const char *path)
{
    rt_film *film = NULL;
    rt_error error;
    if (rt_film_load(&film, path, job->arguments->memory, &error) != RT_OK)
        return fail_load(path, &error);
    inputs_add(&job->inputs, path);
    if (!job->film) {
        job->film = film;
        return STATUS_DONE;
    }
    rt_status added = rt_film_add(job->film, film, &error);
    rt_film_destroy(film);
    if (added == RT_OK)
        return STATUS_DONE;
    message_error("%s does not fit %s: %s", path, job->arguments->operands[0], error.message);
    message_hint(
        "`rtc info FILM...` tells what films hold, and of which parts samples are missing");
    return added == RT_ERROR_USAGE ? STATUS_INPUT : message_status(added);
}

/* "2, 5 and 7": the parts of which something is missing, as many as fit. */
static void list_missing(char *out, size_t size, const rt_film *film, uint32_t parts)
{
    uint32_t missing = 0, last = 0;
    size_t used = 0;
    out[0] = '\0';
    for (uint32_t part = 1; part <= parts; part++)
        if (rt_film_part_done(film, part, parts) < 1) {
            if (last && used + 32 < size)
                used += (size_t)snprintf(out + used, size - used, "%s%" PRIu32,
                                         used > 0 ? ", " : "", last);
            last = part;
            missing++;
        }
    if (last && used + 32 < size)
        snprintf(out + used, size - used, "%s%" PRIu32, used > 0 ? " and " : "", last);
    else if (last)
        snprintf(out + used, size - used, "..., %" PRIu32 " in all", missing);
}

/* Whether the film may become an image; says what is missing. */
static int check_complete(const merge_job *job)
{
    const int may_lack = job->arguments->options[OPTION_INCOMPLETE].given ||
                         outputs_films(&job->outputs) == job->outputs.count;
    char missing[256], what[384];
    rt_film_info info;
    rt_film_get_info(job->film, &info);
    if (info.units_done == info.units)
        return STATUS_DONE;
    const uint32_t parts = info.parts > 1 ? info.parts : 1;
    list_missing(missing, sizeof missing, job->film, parts);
    if (parts > 1)
        snprintf(
            what, sizeof what,
            "%.3g %% of the picture is there; missing, whole or in part, of parts 1 to %" PRIu32
            ": %s",
            100 * info.done, parts, missing);
    else
        snprintf(what, sizeof what, "%.3g %% of the picture is there", 100 * info.done);
    if (may_lack) {
        if (!job->session.quiet)
            message_warning("%s", what);
        return STATUS_DONE;
    }
    message_error("%s", what);
    message_hint("`rtc SCENE --part I/N` renders a part, `rtc --resume FILE` goes on with one; "
                 "--incomplete writes the image all the same");
    return STATUS_INPUT;
}

/* The command line that the picture was rendered with, for the attributes of an .exr. */
static int read_original(merge_job *job, char **text)
{
    char *none[] = {NULL};
    int status = arguments_parse(&job->original, 0, none);
    return status == STATUS_DONE ? film_note_give(&job->original, text, job->film) : status;
}

static int write_outputs(merge_job *job)
{
    const command_line *arguments = job->arguments;
    const option_value *exposure = &arguments->options[OPTION_EXPOSURE],
                       *tonemap = &arguments->options[OPTION_TONEMAP];
    rt_image_options options = {0};
    rt_error error;
    char *text = NULL, *command = NULL;
    int status = read_original(job, &text);
    if (status == STATUS_DONE && rt_film_resolve(job->film, &job->session.hooks, &error) != RT_OK)
        status = message_failure(&error);
    if (status != STATUS_DONE)
        goto out;
    if (exposure->given)
        options.exposure = (float)exposure->real;
    if (tonemap->given)
        options.tonemap = (rt_tonemap)tonemap->choice;
    options.scene = job->original.operand_count > 0 ? job->original.operands[0] : "unknown";
    options.command = command = recorded_command(&job->original, options.scene, job->film);
    status = outputs_write(&job->outputs, job->film, &options);
    if (status == STATUS_DONE && !job->session.quiet)
        message_note("wrote %s%s from %zu film%s", job->outputs.paths[0],
                     job->outputs.count > 1 ? " and others" : "", arguments->operand_count,
                     arguments->operand_count == 1 ? "" : "s");
out:
    arguments_free(&job->original);
    free(command);
    free(text);
    return status;
}

static int run(merge_job *job)
{
    const command_line *arguments = job->arguments;
    if (arguments->operand_count == 0 || arguments->output_count == 0) {
        message_error("usage: rtc merge FILM.rtpart... --out FILE [--out FILE]...");
        hint_maps(arguments->operand_count > 0 ? arguments->operands[0] : "");
        return STATUS_USAGE;
    }
    int status = outputs_plan(&job->outputs, arguments, NULL, 0, 0);
    if (status == STATUS_DONE)
        status = check_films(arguments);
    for (size_t i = 0; i < arguments->operand_count && status == STATUS_DONE; i++)
        status = add(job, arguments->operands[i]);
    for (size_t i = 0; i < job->outputs.count && status == STATUS_DONE; i++)
        status = inputs_check(&job->inputs, job->outputs.paths[i]);
    if (status == STATUS_DONE)
        status = check_complete(job);
    if (status == STATUS_DONE)
        status = other_work_check_film(&job->outputs, job->film, arguments);
    return status == STATUS_DONE ? write_outputs(job) : status;
}

int command_merge(const command_line *arguments)
{
    merge_job job = {.arguments = arguments};
    session_begin(&job.session, arguments);
    int status = run(&job);
    rt_film_destroy(job.film);
    outputs_free(&job.outputs);
    inputs_free(&job.inputs);
    return status;
}
