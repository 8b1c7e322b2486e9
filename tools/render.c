/* render.c - `rtc SCENE`: a scene becomes image files. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "command_line.h"
#include "commands.h"
#include "denoise.h"
#include "film_note.h"
#include "interrupt.h"
#include "light_shares.h"
#include "message.h"
#include "no_effect.h"
#include "other_work.h"
#include "part.h"
#include "photons.h"
#include "preview/preview.h"
#include "recorded.h"
#include "render_say.h"
#include "status.h"
#include "scene_file.h"
#include "settings.h"
#include "stats.h"
#include "timing.h"
#include "untrusted.h"
#include "watch.h"

/* Whether another process leads the render, and writes what comes of it. */
static int is_worker(const render_job *job)
{
    return job->session.arguments->team && job->session.arguments->team->is_worker;
}

static const option_value *value(const render_job *job, option_id id)
{
    return session_value(&job->session, id);
}

/* ---- Options -------------------------------------------------------------- */

/* Reads the map of --photon-map, which decides what depends on how it was made. */
static int load_photon_map(render_job *job)
{
    rt_photon_map_info info;
    rt_error error;
    const char *path = value(job, OPTION_PHOTON_MAP)->text;
    if (!value(job, OPTION_PHOTON_MAP)->given)
        return STATUS_DONE;
    rt_profile *const profile = job->session.arguments->profile;
    rt_profile_begin(profile, "read map");
    const rt_status loaded =
        rt_photon_map_load_in(&job->photon_map, path, job->session.arguments->memory, &error);
    rt_profile_end(profile);
    if (loaded != RT_OK)
        return session_fail(&error);
    inputs_add(&job->inputs, path);
    rt_photon_map_get_info(job->photon_map, &info);
    job->own.photon_map = job->photon_map;
    job->own.mode = RT_MODE_PHOTON;
    job->own.direct = info.direct;
    job->own.gather_roughness = info.gather_roughness;
    return STATUS_DONE;
}

/* What the command line says goes before what the map says, and that before what the scene says. */
static int set_options(render_job *job)
{
    rt_scene_get_options(job->scene, &job->own);
    int status = load_photon_map(job);
    job->options = job->own;
    session_merge_options(&job->session, &job->options);
    job->options.light_shares = job->shares;
    job->options.light_share_count = job->share_count;
    job->options.part = job->part;
    job->options.parts = job->parts;
    job->options.note = job->note;
    return status == STATUS_DONE && !is_worker(job)
               ? checkpoint_plan(&job->checkpoint, &job->options, job->session.arguments)
               : status;
}

/* ---- The steps ------------------------------------------------------------ */

static int load(render_job *job)
{
    rt_error error;
    int status = scene_file_load(&job->scene, job->scene_path,
                                 job->session.quiet ? SCENE_QUIETLY : SCENE_TO_RENDER, NULL,
                                 &job->inputs, &job->session.progress, job->session.arguments);
    if (status != STATUS_DONE)
        return status;
    status = set_options(job);
    for (size_t i = 0; i < job->outputs.count && status == STATUS_DONE; i++)
        status = inputs_check(&job->inputs, job->outputs.paths[i]);
    if (status == STATUS_DONE && value(job, OPTION_PROFILE)->given)
        status = inputs_check(&job->inputs, value(job, OPTION_PROFILE)->text);
    if (status != STATUS_DONE)
        return status;
    if (!job->session.quiet && !job->is_again)
        no_effect_warn(job->session.arguments, &job->options, job->scene, &job->outputs);
    /* Options that cannot be are told before any work. */
    status = session_check_options(&job->session, &job->own, &job->options);
    if (status == STATUS_DONE && !is_worker(job))
        status = denoise_check(&job->session, &job->options);
    if (status != STATUS_DONE)
        return status;
    return rt_scene_set_options(job->scene, &job->options, &error) == RT_OK ? STATUS_DONE
                                                                            : session_fail(&error);
}

/* Makes the scene ready on the devices. */
static int prepare(render_job *job)
{
    rt_renderer_options options = {0};
    rt_error error;
    options.hooks = &job->session.hooks;
    if (value(job, OPTION_ACCEL)->given)
        options.accel = (rt_accel)value(job, OPTION_ACCEL)->choice;
    const rt_status result = crew_prepare(&job->crew, job->scene, &options, &error);
    if (session_was_interrupted(result))
        return STATUS_INTERRUPTED;
    if (result != RT_OK)
        return session_fail(&error);
    return is_worker(job) ? STATUS_DONE
                          : other_work_check(&job->outputs, job->crew.renderers[0], &job->options,
                                             job->session.arguments);
}

/*
 * With --watch and --preview a picture of a quarter of the width and height comes first, of few
 * samples and photons.
 */
static int show_coarsely(render_job *job)
{
    enum { SCALE = 4, SPP = 4, PHOTONS = 16, PHOTONS_LEAST = 2000 };
    rt_render_options o = job->options;
    rt_film *film = NULL;
    rt_error error;
    if (!job->session.watch || !job->session.preview)
        return STATUS_DONE;
    preview_begin(job->session.preview, &o, SCALE, o.width, o.height);
    o.width = (o.width + SCALE - 1) / SCALE;
    o.height = (o.height + SCALE - 1) / SCALE;
    o.spp = o.spp < SPP ? o.spp : SPP;
    o.passes = o.passes < 2 ? o.passes : 2;
    o.photons = o.photons / PHOTONS > PHOTONS_LEAST ? o.photons / PHOTONS : o.photons;
    o.variance = o.variance || o.target_error > 0;
    o.target_error = o.time = 0;
    const rt_status result =
        crew_render(&film, &job->crew, &o, job->session.arguments->team, &error);
    if (result == RT_OK)
        preview_show(job->session.preview, film);
    rt_film_destroy(film);
    if (session_was_interrupted(result))
        return STATUS_INTERRUPTED;
    return result == RT_OK ? STATUS_DONE : session_fail(&error);
}

/* The width or the height, where it is given and is not that of the film of --resume; or NULL. */
static const rt_setting *find_other_size(const render_job *job)
{
    static const char *const sizes[] = {"width", "height"};
    const command_line *arguments = job->session.arguments;
    rt_render_options film;
    if (!arguments->film)
        return NULL;
    rt_film_get_options(arguments->film, &film);
    for (int i = 0; i < 2; i++)
        if (settings_text(arguments, rt_setting_find(sizes[i])) &&
            (i == 0 ? film.width != job->options.width : film.height != job->options.height))
            return rt_setting_find(sizes[i]);
    return NULL;
}

/* The camera of a scene has the shape of the picture: another size is not another scene. */
static int fail_size(const render_job *job, const rt_setting *size)
{
    char asked[64], has[64];
    rt_render_options film;
    rt_film_get_options(job->session.arguments->film, &film);
    rt_setting_get(asked, sizeof asked, size, &job->options);
    rt_setting_get(has, sizeof has, size, &film);
    message_error("--%s: %s is %s, and %s in the film to be continued", size->field.name,
                  size->field.name, asked, has);
    return STATUS_USAGE;
}

/*
 * Says why the film cannot be made: a checkpoint or a map that does not fit the scene is named, and
 * so is the scene.
 */
static int fail_film(const render_job *job, const rt_error *error)
{
    const char *resume = value(job, OPTION_RESUME)->text,
               *map = value(job, OPTION_PHOTON_MAP)->text;
    const char *scene = scene_file_name(job->scene_path);
    char word[RECORDED_WORD_SIZE];
    if (error->field[0] || error->file[0])
        return session_fail(error);
    if (resume && error->status == RT_ERROR_USAGE && find_other_size(job))
        return fail_size(job, find_other_size(job));
    if (resume && error->status == RT_ERROR_USAGE) {
        message_error("%s does not fit %s: %s", resume, scene, error->message);
        message_hint(
            "it goes on with the scene that `rtc info %s` names, as that was when the film "
            "was begun; without --resume the picture is begun anew",
            recorded_word(word, resume));
        return STATUS_INPUT;
    }
    if (map && error->status == RT_ERROR_INPUT) {
        message_error("%s does not fit %s: %s", map, scene, error->message);
        message_hint("`rtc photons %s --out NAME.rtp` makes a map of this scene",
                     recorded_word(word, scene));
        return STATUS_INPUT;
    }
    return session_fail(error);
}

static int make_film(render_job *job)
{
    rt_error error;
    preview_begin(job->session.preview, &job->options, 1, job->options.width, job->options.height);
    const rt_status result =
        crew_render(&job->film, &job->crew, &job->options, job->session.arguments->team, &error);
    job->seconds = session_seconds(&job->session);
    progress_clear(&job->session.progress);
    if (session_was_interrupted(result))
        return STATUS_INTERRUPTED;
    return result == RT_OK ? STATUS_DONE : fail_film(job, &error);
}

/* Writes the film; an interrupted one is written too, as far as it came. */
static int write_images(const render_job *job, int status)
{
    if (!job->film) {
        if (!job->session.quiet)
            render_say_nothing(&job->options);
        return STATUS_INTERRUPTED;
    }
    rt_image_options options = {0};
    options.exposure =
        value(job, OPTION_EXPOSURE)->given ? (float)value(job, OPTION_EXPOSURE)->real : 0.0f;
    options.tonemap = value(job, OPTION_TONEMAP)->given
                          ? (rt_tonemap)value(job, OPTION_TONEMAP)->choice
                          : RT_TONEMAP_NONE;
    options.scene = job->scene_path;
    char *const command = recorded_command(job->session.arguments, job->scene_path, job->film);
    options.command = command ? command : job->command;
    rt_profile *const profile = job->session.arguments->profile;
    rt_profile_begin(profile, "write images");
    /* A denoiser that fails costs its layer alone. */
    const int denoised = status == STATUS_DONE && job->parts <= 1
                             ? denoise_film(&job->session, job->film, job->crew.renderers[0])
                             : STATUS_DONE;
    int written = outputs_write(&job->outputs, job->film, &options);
    if (written == STATUS_DONE)
        written = denoise_write(&job->session, job->film, &job->outputs, &options);
    free(command);
    rt_profile_end(profile);
    if (written == STATUS_DONE)
        written = denoised;
    if (written != STATUS_DONE)
        return written;
    if (!job->session.quiet)
        render_say_written(job, status == STATUS_INTERRUPTED);
    if (!job->session.quiet)
        render_say_error(job);
    if (value(job, OPTION_STATS)->given && value(job, OPTION_JSON)->given)
        stats_print_json(job->scene, job->crew.devices[0], &job->options, job->film, &job->crew,
                         job->session.arguments);
    else if (value(job, OPTION_STATS)->given)
        stats_print(job->scene, job->crew.devices[0], &job->options, job->film, &job->crew,
                    job->session.arguments);
    return status;
}

/* With --untrusted, gives up the rights that the render does not need. */
static int confine(const render_job *job)
{
    size_t count = job->outputs.count;
    if (!value(job, OPTION_UNTRUSTED)->given)
        return STATUS_DONE;
    const char **paths = malloc((count + 2) * sizeof *paths);
    if (!paths) {
        message_error("out of memory");
        return STATUS_DEVICE;
    }
    for (size_t i = 0; i < count; i++)
        paths[i] = job->outputs.paths[i];
    if (value(job, OPTION_CHECKPOINT)->given)
        paths[count++] = value(job, OPTION_CHECKPOINT)->text;
    if (value(job, OPTION_PROFILE)->given)
        paths[count++] = value(job, OPTION_PROFILE)->text;
    const untrusted_needs needs = {.scene = job->scene_path,
                                   .also = value(job, OPTION_PHOTON_MAP)->text,
                                   .outputs = paths,
                                   .output_count = count,
                                   .device = 1};
    int status = untrusted_confine(&needs);
    free(paths);
    if (status == STATUS_DONE)
        session_catch(&job->session);
    return status;
}

/* Makes the command that the images record, now: a picture is not to be lost for it. */
static int record_command(render_job *job)
{
    job->command = recorded_command(job->session.arguments, job->scene_path, NULL);
    if (job->command)
        return STATUS_DONE;
    message_error("out of memory");
    return STATUS_DEVICE;
}

/* Reads --part; a film that is kept whole is part 1 of 1. */
static int plan(render_job *job)
{
    const option_value *part = value(job, OPTION_PART);
    int status = part->given ? part_read(&job->part, &job->parts, part->text) : STATUS_DONE;
    if (status == STATUS_DONE && !is_worker(job))
        status = outputs_plan(&job->outputs, job->session.arguments, job->scene_path, job->part,
                              job->parts);
    if (status != STATUS_DONE)
        return status;
    if (job->parts == 0 && outputs_films(&job->outputs) > 0)
        job->part = job->parts = 1;
    job->checkpoint.progress = &job->session.progress;
    job->checkpoint.is_quiet = job->session.quiet;
    job->note = film_note_make(job->session.arguments, job->scene_path);
    if (!job->note) {
        message_error("out of memory");
        return STATUS_DEVICE;
    }
    return STATUS_DONE;
}

/* What there is before the first scene: the options that need none, the page, the rights. */
static int begin(render_job *job)
{
    int status = light_shares_read(&job->shares, &job->share_count, job->session.arguments);
    if (status == STATUS_DONE)
        status = plan(job);
    if (status == STATUS_DONE)
        status = record_command(job);
    if (status == STATUS_DONE && value(job, OPTION_WATCH)->given)
        status = watch_check(job->session.arguments, job->scene_path, outputs_films(&job->outputs));
    if (status == STATUS_DONE && value(job, OPTION_WATCH)->given)
        status = watch_open(&job->session.watch);
    if (status == STATUS_DONE && !is_worker(job))
        status = preview_open(&job->session.preview, job->session.arguments, job->scene_path,
                              job->session.watch != NULL);
    job->inputs.watch = job->session.watch;
    return status == STATUS_DONE ? confine(job) : status;
}

/* Reads the scene, renders it and writes what comes of that. */
static int render_scene(render_job *job)
{
    int status = load(job);
    if (status == STATUS_DONE && !job->crew.devices)
        status = crew_open(&job->crew, &job->session);
    if (status == STATUS_DONE)
        status = prepare(job);
    if (status == STATUS_DONE)
        status = show_coarsely(job);
    if (status == STATUS_DONE)
        status = make_film(job);
    /* What is stopped for a change of a file is not written. */
    if (status == STATUS_INTERRUPTED && job->session.watch && !interrupt_pending())
        return status;
    preview_show(job->session.preview, job->film);
    if ((status == STATUS_DONE || status == STATUS_INTERRUPTED) && !is_worker(job))
        status = write_images(job, status);
    return status;
}

/* Lets go of a scene and its film; devices and their kernels stay. */
static void forget(render_job *job)
{
    rt_film_destroy(job->film);
    rt_photon_map_destroy(job->photon_map);
    crew_forget(&job->crew);
    rt_scene_destroy(job->scene);
    inputs_free(&job->inputs);
    job->film = NULL;
    job->photon_map = NULL;
    job->scene = NULL;
    job->inputs = (input_list){.watch = job->session.watch};
    job->session.began = 0;
    job->is_again = 1;
}

/* Renders again and again; returns the status of the last render. */
static int render_watched(render_job *job)
{
    int status;
    interrupt_defer();
    for (;;) {
        preview_clear_messages(job->session.preview);
        preview_set_phase(job->session.preview, BOARD_LOADING);
        watch_begin(job->session.watch);
        inputs_add(&job->inputs, job->scene_path);
        status = render_scene(job);
        if (interrupt_pending())
            return status;
        progress_clear(&job->session.progress);
        if (status != STATUS_INTERRUPTED) {
            preview_set_phase(job->session.preview, BOARD_WAITING);
            if (!job->session.quiet)
                message_note("waiting for a change of a file; Ctrl-C ends");
        }
        watch_wait(job->session.watch);
        if (interrupt_pending())
            return status == STATUS_INTERRUPTED ? STATUS_DONE : status;
        forget(job);
    }
}

static int run(render_job *job)
{
    int status = begin(job);
    if (status == STATUS_DONE)
        status = job->session.watch ? render_watched(job) : render_scene(job);
    rt_profile_begin(job->session.arguments->profile, "checkpoint");
    checkpoint_finish(&job->checkpoint);
    rt_profile_end(job->session.arguments->profile);
    if ((status == STATUS_DONE || status == STATUS_INTERRUPTED) && !is_worker(job)) {
        const int written = timing_write(job->session.arguments);
        status = written == STATUS_DONE ? status : written;
    }
    if (job->checkpoint.failed && (status == STATUS_DONE || status == STATUS_INTERRUPTED))
        status = STATUS_OUTPUT;
    else if (!job->session.quiet && !is_worker(job))
        render_say_left(job);
    return status;
}

/* What is not there as a scene may be a mistyped subcommand. */
static void hint_command(const char *word)
{
    if (access(word, F_OK) == 0)
        return;
    const char *command = command_nearest(word), *form = photons_nearest_form(word);
    if (strcmp(word, "render") == 0)
        message_hint("rendering has no command word: rtc SCENE [OPTION]...");
    else if (form && (!command || strcmp(word, form) == 0))
        message_hint("did you mean `rtc photons %s`?", form);
    else if (command)
        message_hint("did you mean `rtc %s`?", command);
}

/* Says that there is not one scene; a mistyped subcommand looks like a scene too many. */
static int fail_operands(const command_line *arguments)
{
    if (arguments->operand_count == 0) {
        message_error("which scene? usage: rtc SCENE [OPTION]...");
        message_hint("`rtc --help` lists the options");
        return STATUS_USAGE;
    }
    if (!strpbrk(arguments->operands[0], "./") && access(arguments->operands[0], F_OK) != 0)
        message_error("there is no command '%s', and no scene", arguments->operands[0]);
    else
        message_error("one scene at a time: '%s' and '%s'", arguments->operands[0],
                      arguments->operands[1]);
    hint_command(arguments->operands[0]);
    return STATUS_USAGE;
}

/* --dump: the scene as the text has it, so that settings and options of a render are a mistake. */
static int dump(const command_line *arguments)
{
    static const int its_own[] = {OPTION_DUMP, OPTION_SET, OPTION_UNTRUSTED, OPTION_MEMORY,
                                  OPTION_QUIET};
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    for (int i = 0; i < OPTION_COUNT; i++) {
        int is_own = 0;
        for (size_t j = 0; j < sizeof its_own / sizeof *its_own; j++)
            is_own |= its_own[j] == i;
        if (arguments->options[i].given && !is_own) {
            message_error("--dump renders nothing, so that --%s has no effect: leave it out",
                          option_table[i].name);
            return STATUS_USAGE;
        }
    }
    for (size_t i = 0; i < count; i++)
        if (arguments->settings[i]) {
            message_error("--dump writes the scene as its text has it: --%s is left out, or "
                          "written into the scene",
                          settings[i].field.name);
            return STATUS_USAGE;
        }
    if (arguments->options[OPTION_UNTRUSTED].given) {
        const untrusted_needs needs = {.scene = arguments->operands[0],
                                       .memory = arguments->memory};
        const int status = untrusted_confine(&needs);
        if (status != STATUS_DONE)
            return status;
    }
    return scene_file_dump(arguments->operands[0], arguments);
}

int command_render(const command_line *arguments)
{
    if (arguments->operand_count != 1)
        return fail_operands(arguments);
    if (arguments->options[OPTION_DUMP].given)
        return dump(arguments);
    render_job job = {0};
    session_begin(&job.session, arguments);
    job.scene_path = arguments->operands[0];
    int status = run(&job);
    preview_end(job.session.preview, status);
    watch_close(job.session.watch);
    if (status == STATUS_INPUT && !job.scene)
        hint_command(job.scene_path);
    file_lock_release(&job.checkpoint.lock);
    rt_film_destroy(job.film);
    rt_photon_map_destroy(job.photon_map);
    crew_close(&job.crew);
    rt_scene_destroy(job.scene);
    free(job.shares);
    free(job.command);
    free(job.note);
    inputs_free(&job.inputs);
    outputs_free(&job.outputs);
    return status;
}
