/* cell.c - renders the pictures of a study. */
#include "cell.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../message.h"
#include "../recorded.h"
#include "../scene_file.h"
#include "../settings.h"
#include "../status.h"
#include "forecast.h"

static const rt_word accels[] = {RT_ACCELS(RT_WORD) RT_WORD_END};

static int fail_memory(void)
{
    message_error("out of memory");
    return STATUS_DEVICE;
}

/* ---- Pictures ------------------------------------------------------------------- */

/* Puts a value of an axis into the command line. */
static void put_value(study_picture *picture, const sweep_axis *axis, const char *value)
{
    switch (axis->kind) {
    case SWEEP_SETTING:
        study_picture_set(picture, axis->setting->field.name, value);
        break;
    case SWEEP_SCENE:
        picture->scene = value;
        break;
    case SWEEP_ACCEL:
        picture->line.options[OPTION_ACCEL] = (option_value){
            .given = 1, .text = value, .choice = rt_word_find(accels, value, strlen(value))->value};
        break;
    case SWEEP_CONSTANT:
        picture->line.definitions[picture->line.definition_count++] =
            (rt_definition){axis->constant, value};
        break;
    }
}

/* FNV-1a of 32 bits. */
static unsigned hash_of(const char *text)
{
    uint32_t hash = 2166136261u;
    for (; *text; text++)
        hash = (hash ^ (unsigned char)*text) * 16777619u;
    return (unsigned)hash;
}

char *study_label(const sweep *sweep, size_t cell, const char *name)
{
    size_t size = strlen(name) + 1;
    for (size_t i = 0; i < sweep->count; i++)
        size += strlen(sweep->axes[i].name) + strlen(sweep_value(sweep, cell, i)) + 2;
    char *label = malloc(size);
    int used = label ? snprintf(label, size, "%s", name) : 0;
    for (size_t i = 0; label && i < sweep->count; i++)
        used += snprintf(label + used, size - (size_t)used, "%s%s=%s", used > 0 ? "," : "",
                         sweep->axes[i].name, sweep_value(sweep, cell, i));
    return label;
}

/* A label as a name that any file system takes; where that loses something, with its hash. */
static char *file_name_of(const char *label)
{
    enum { LONGEST = 100 };
    const size_t size = LONGEST + sizeof "-01234567";
    char *name = malloc(size);
    int is_same = strlen(label) <= LONGEST;
    if (!name)
        return NULL;
    snprintf(name, LONGEST + 1, "%s", label);
    for (char *at = name; *at; at++)
        if (!isalnum((unsigned char)*at) && !strchr("=,.-+_", *at)) {
            *at = '_';
            is_same = 0;
        }
    if (!is_same)
        sprintf(name + strlen(name), "-%08x", hash_of(label));
    return name;
}

int study_picture_make(study_picture *out, const command_line *arguments, const sweep *sweep,
                       size_t cell, const char *scene, const char *name)
{
    size_t settings;
    rt_settings(&settings);
    *out = (study_picture){.line = *arguments, .scene = scene};
    command_line *line = &out->line;
    line->settings = malloc(settings * sizeof *line->settings);
    line->definitions = malloc((line->definition_count + SWEEP_AXES) * sizeof *line->definitions);
    out->label = study_label(sweep, cell, name);
    out->file = out->label ? file_name_of(out->label) : NULL;
    if (!line->settings || !line->definitions || !out->file)
        return fail_memory();
    memcpy(line->settings, arguments->settings, settings * sizeof *line->settings);
    if (line->definition_count > 0)
        memcpy(line->definitions, arguments->definitions,
               line->definition_count * sizeof *line->definitions);
    for (size_t i = 0; i < sweep->count; i++)
        put_value(out, &sweep->axes[i], sweep_value(sweep, cell, i));
    return STATUS_DONE;
}

void study_picture_free(study_picture *picture)
{
    free(picture->line.settings);
    free(picture->line.definitions);
    free(picture->label);
    free(picture->file);
}

int study_picture_share(study_picture *picture)
{
    char *key = recorded_command(&picture->line, picture->scene, NULL);
    const size_t size = strlen(picture->file) + sizeof "-01234567";
    char *file = realloc(picture->file, size);
    picture->file = file ? file : picture->file;
    if (key && file)
        sprintf(file + strlen(file), "-%08x", hash_of(key));
    free(key);
    picture->is_shared = 1;
    return key && file ? STATUS_DONE : fail_memory();
}

void study_picture_set(study_picture *picture, const char *setting, const char *text)
{
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    picture->line.settings[rt_setting_find(setting) - settings] = text;
}

/* ---- Scenes --------------------------------------------------------------------- */

static void forget_scene(study_scene *ready)
{
    rt_renderer_destroy(ready->renderer);
    rt_scene_destroy(ready->scene);
    free(ready->key);
    *ready = (study_scene){0};
}

/* What tells a scene from others. */
static char *make_key(const study_picture *picture)
{
    const command_line *line = &picture->line;
    size_t size = strlen(picture->scene) + 32;
    for (size_t i = 0; i < line->definition_count; i++)
        size += strlen(line->definitions[i].name) + strlen(line->definitions[i].value) + 2;
    char *key = malloc(size), *at = key;
    if (!key)
        return NULL;
    at += sprintf(at, "%s\n%d", picture->scene, line->options[OPTION_ACCEL].choice);
    for (size_t i = 0; i < line->definition_count; i++)
        at += sprintf(at, "\n%s=%s", line->definitions[i].name, line->definitions[i].value);
    return key;
}

/* Reads the scene of a picture, unless it is there; its warnings are told at the check alone. */
static int read_scene(study_renderer *renderer, const study_picture *picture)
{
    study_scene *ready = &renderer->ready;
    const int is_quiet = renderer->session->quiet || renderer->is_checked;
    char *key = make_key(picture);
    if (key && ready->key && strcmp(key, ready->key) == 0) {
        free(key);
        return STATUS_DONE;
    }
    forget_scene(ready);
    if (!key)
        return fail_memory();
    int status =
        scene_file_load(&ready->scene, picture->scene, is_quiet ? SCENE_QUIETLY : SCENE_TO_RENDER,
                        NULL, NULL, &renderer->session->progress, &picture->line);
    if (status == STATUS_DONE) {
        ready->key = key;
        return STATUS_DONE;
    }
    free(key);
    forget_scene(ready);
    return status;
}

/* Makes the scene that was read ready on the device, unless it is. */
static int prepare(study_renderer *renderer, const study_picture *picture)
{
    study_scene *ready = &renderer->ready;
    rt_renderer_options options = {.hooks = &renderer->session->hooks};
    rt_error error;
    if (ready->renderer)
        return STATUS_DONE;
    if (picture->line.options[OPTION_ACCEL].given)
        options.accel = (rt_accel)picture->line.options[OPTION_ACCEL].choice;
    if (rt_renderer_create(&ready->renderer, ready->scene, renderer->device, &options, &error) ==
        RT_OK)
        return STATUS_DONE;
    forget_scene(ready);
    return session_fail(&error);
}

/* ---- Films ---------------------------------------------------------------------- */

static const char unfinished[] = ".unfinished.rtpart";

/* FOLDER/STUDY,k=50+1.rtpart, or with another end. */
static char *film_path(const study_renderer *renderer, const study_picture *picture,
                       const char *end)
{
    const char *study = picture->is_shared || !renderer->study ? "" : renderer->study;
    const size_t size = strlen(renderer->folder) + strlen(study) + strlen(picture->file) +
                        strlen(end) + sizeof ",+4294967295";
    char *path = malloc(size), repeat[16] = "";
    if (picture->repeat > 0)
        snprintf(repeat, sizeof repeat, "+%u", (unsigned)picture->repeat);
    if (path)
        snprintf(path, size, "%s%s%s%s%s%s", renderer->folder, study, *study ? "," : "",
                 picture->file, repeat, end);
    return path;
}

/*
 * The film that is kept at path, if it is of these options, or NULL; without means yet. A film
 * joins others whatever limits its time and its error, so that these are compared here.
 */
static rt_film *load_film(const char *path, rt_renderer *renderer, const rt_render_options *options)
{
    rt_film *kept = NULL, *film = NULL;
    rt_render_options limits;
    if (rt_film_load(&kept, path, NULL, NULL) != RT_OK)
        return NULL;
    rt_status status = rt_film_begin(&film, renderer, options, NULL);
    if (status == RT_OK)
        status = rt_film_add(film, kept, NULL);
    rt_film_get_options(kept, &limits);
    if (limits.time != options->time || limits.target_error != options->target_error)
        status = RT_ERROR_USAGE;
    rt_film_destroy(kept);
    if (status == RT_OK)
        return film;
    rt_film_destroy(film);
    return NULL;
}

/* A finished film, with its means; or NULL. */
static rt_film *recall(const char *path, rt_renderer *renderer, const rt_render_options *options)
{
    rt_film *film = load_film(path, renderer, options);
    if (film && rt_film_resolve(film, NULL, NULL) == RT_OK)
        return film;
    rt_film_destroy(film);
    return NULL;
}

/*
 * Keeps an interrupted film as far as it came, and says what becomes of it. One that its time
 * limits begins anew, since what it would be after a pause is another picture.
 */
static void keep_unfinished(const study_renderer *renderer, const char *label, const rt_film *film,
                            const char *path)
{
    rt_film_info info = {.done = 0};
    rt_render_options options = {.time = 0};
    if (film) {
        rt_film_get_info(film, &info);
        rt_film_get_options(film, &options);
    }
    const int is_kept =
        info.units_done > 0 && options.time == 0 && rt_film_save(film, path, NULL) == RT_OK;
    if (renderer->session->quiet)
        return;
    if (is_kept)
        message_note("interrupted; %.3g %% of %s is kept: the study goes on from there when it "
                     "is run again",
                     100 * info.done, label);
    else
        message_note("interrupted; %s begins anew when the study is run again", label);
}

/* Renders and keeps the film, from where it was interrupted. */
static int render_new(rt_film **out, study_renderer *renderer, const study_picture *picture,
                      const char *path, const rt_render_options *options)
{
    const char *label = *picture->label ? picture->label : "the picture";
    rt_render_options o = *options;
    rt_error error;
    char *begun = film_path(renderer, picture, unfinished);
    if (!begun)
        return fail_memory();
    rt_film *film = load_film(begun, renderer->ready.renderer, options);
    o.resume = film;
    renderer->rendered++;
    rt_status result = rt_render(out, renderer->ready.renderer, &o, &error);
    progress_clear(&renderer->session->progress);
    rt_film_destroy(film);
    int status = session_was_interrupted(result) ? STATUS_INTERRUPTED : STATUS_DONE;
    if (status == STATUS_INTERRUPTED)
        keep_unfinished(renderer, label, *out, begun);
    else if (result != RT_OK || rt_film_save(*out, path, &error) != RT_OK)
        status = session_fail(&error);
    else
        remove(begun);
    free(begun);
    if (status != STATUS_DONE) {
        rt_film_destroy(*out);
        *out = NULL;
    }
    return status;
}

int study_read_options(rt_render_options *out, study_renderer *renderer,
                       const study_picture *picture)
{
    rt_render_options own;
    renderer->session->arguments = &picture->line;
    const int status = read_scene(renderer, picture);
    if (status != STATUS_DONE)
        return status;
    rt_scene_get_options(renderer->ready.scene, &own);
    *out = own;
    session_merge_options(renderer->session, out);
    out->part = out->parts = 1;
    out->seed += picture->repeat;
    return session_check_options(renderer->session, &own, out);
}

int study_prepare(rt_render_options *out, study_renderer *renderer, const study_picture *picture)
{
    const int status = study_read_options(out, renderer, picture);
    return status == STATUS_DONE ? prepare(renderer, picture) : status;
}

int study_render(rt_film **out, study_renderer *renderer, const study_picture *picture)
{
    rt_render_options options;
    const int status = study_prepare(&options, renderer, picture);
    if (status != STATUS_DONE)
        return status;
    char *path = film_path(renderer, picture, ".rtpart");
    if (!path)
        return fail_memory();
    int rendered = STATUS_DONE;
    if (!(*out = recall(path, renderer->ready.renderer, &options))) {
        if (picture->is_shared && !renderer->session->quiet)
            forecast_tell(renderer->ready.renderer, &renderer->session->progress, picture->label,
                          &options);
        rendered = render_new(out, renderer, picture, path, &options);
    }
    free(path);
    return rendered;
}

void study_renderer_free(study_renderer *renderer)
{
    forget_scene(&renderer->ready);
    rt_device_close(renderer->device);
    free(renderer->folder);
}
