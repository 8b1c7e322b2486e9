/* command.c - `rtc study`: studies of settings, on a page and in tables. */
#define _XOPEN_SOURCE 700 /* mkdir */

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "../commands.h"
#include "../message.h"
#include "../outputs.h"
#include "../scene_file.h"
#include "../status.h"
#include "check.h"
#include "list.h"
#include "study.h"

typedef struct study_job {
    const command_line *arguments;
    session session;
    study_renderer renderer;
    study_list list; /* of --list */
    study *studies;
    size_t count;
    char *stem; /* of all paths: without .html */
    int has_made_folder;
    study_count pictures;
} study_job;

static int fail_memory(void)
{
    message_error("out of memory");
    return STATUS_DEVICE;
}

/* ---- Paths ------------------------------------------------------------------------ */

/* "a/box.rts" -> "box". */
static char *stem_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    char *stem = malloc(strlen(name) + 1);
    if (!stem)
        return NULL;
    strcpy(stem, name);
    stem[strlen(stem) - strlen(outputs_extension(stem))] = '\0';
    return stem;
}

/* The stem, the name of a study of a list, and what it ends in; to be freed. */
static char *path_of(const study_job *job, const char *id, const char *end)
{
    const size_t size = strlen(job->stem) + strlen(id) + strlen(end) + 2;
    char *path = malloc(size);
    if (path)
        snprintf(path, size, "%s%s%s%s", job->stem, *id ? "." : "", id, end);
    return path;
}

static int plan_paths(study_job *job)
{
    const command_line *arguments = job->arguments;
    const char *out = arguments->output_count > 0 ? arguments->outputs[0] : NULL;
    const char *from = arguments->options[OPTION_LIST].given ? arguments->options[OPTION_LIST].text
                       : job->studies[0].scene ? scene_file_name(job->studies[0].scene)
                                               : "study";
    if (arguments->output_count > 1 || (out && strcmp(outputs_extension(out), ".html") != 0)) {
        message_error("rtc study writes one page: --out NAME.html");
        return STATUS_USAGE;
    }
    job->stem = out ? malloc(strlen(out) + 1) : stem_of(from);
    if (!job->stem)
        return fail_memory();
    if (out)
        strcpy(job->stem, out)[strlen(out) - strlen(".html")] = '\0';
    char *page = path_of(job, "", ".html");
    const int status = page ? outputs_check_writable(page) : fail_memory();
    free(page);
    return status;
}

/* The folder that keeps the films. */
static int make_folder(study_job *job)
{
    job->renderer.folder = path_of(job, "", ".films/");
    if (!job->renderer.folder)
        return fail_memory();
    struct stat entry;
    job->has_made_folder = mkdir(job->renderer.folder, 0777) == 0;
    if (job->has_made_folder || (errno == EEXIST && stat(job->renderer.folder, &entry) == 0))
        return STATUS_DONE;
    message_error("cannot make the folder %s: %s", job->renderer.folder, strerror(errno));
    return STATUS_OUTPUT;
}

/* ---- The studies ------------------------------------------------------------------ */

/* What the command line of `rtc study` says goes before what stands in the list. */
static void override(command_line *listed, const command_line *typed)
{
    size_t settings;
    rt_settings(&settings);
    for (size_t i = 0; i < settings; i++)
        if (typed->settings[i])
            listed->settings[i] = typed->settings[i];
    for (int i = 0; i < OPTION_COUNT; i++)
        if (typed->options[i].given)
            listed->options[i] = typed->options[i];
    listed->memory = typed->memory;
}

/* What a study is called on its page: the scene's file, without folders. */
static const char *name_of(const char *scene)
{
    const char *slash = scene ? strrchr(scene, '/') : NULL;
    return slash ? slash + 1 : scene ? scene : "study";
}

/* Those of the list, or the one of the command line. */
static int plan(study_job *job)
{
    const command_line *arguments = job->arguments;
    const option_value *list = &arguments->options[OPTION_LIST];
    const option_value *only = &arguments->options[OPTION_ONLY];
    int status = list->given ? study_list_read(&job->list, list->text,
                                               arguments->options[OPTION_QUICK].given)
                             : STATUS_DONE;
    if (status != STATUS_DONE)
        return status;
    if (list->given && (arguments->operand_count > 0 || arguments->sweep_count > 0)) {
        message_error("--list names the studies; no scene or --sweep goes with it");
        return STATUS_USAGE;
    }
    if (!list->given && (arguments->options[OPTION_QUICK].given || only->given)) {
        message_error("--%s needs --list", only->given ? "only" : "quick");
        return STATUS_USAGE;
    }
    if (only->given)
        status = study_list_keep(&job->list, only->text);
    if (status != STATUS_DONE)
        return status;
    job->studies = calloc(list->given ? job->list.count : 1, sizeof *job->studies);
    if (!job->studies)
        return fail_memory();
    if (!list->given) {
        job->count = 1;
        status = study_begin(job->studies, arguments);
        job->studies[0].result.id = "study";
        job->studies[0].result.title = name_of(job->studies[0].scene);
    }
    for (size_t i = 0; i < job->list.count && status == STATUS_DONE; i++) {
        listed_study *listed = &job->list.studies[i];
        override(&listed->arguments, arguments);
        job->count++;
        status = study_begin(&job->studies[i], &listed->arguments);
        if (status != STATUS_DONE)
            message_note("in the study '%s' of %s", listed->id, list->text);
        job->studies[i].is_listed = 1;
        job->studies[i].result.id = listed->id;
        job->studies[i].result.title = listed->title;
        job->studies[i].result.text = listed->text;
    }
    return status;
}

/* Writes the page with the studies so far. */
static int write_page(const study_job *job, size_t done)
{
    study_result *results = malloc(done * sizeof *results);
    char *page = path_of(job, "", ".html");
    if (!results || !page) {
        free(results);
        free(page);
        return fail_memory();
    }
    for (size_t i = 0; i < done; i++)
        results[i] = job->studies[i].result;
    const char *title = job->list.title ? job->list.title : results[0].title;
    const int status = page_write(page, title, results, done);
    if (status == STATUS_DONE && done == job->count && !job->session.quiet)
        message_note("wrote %s; its films are kept beside it", page);
    free(results);
    free(page);
    return status;
}

static int run_study(study_job *job, size_t index)
{
    study *s = &job->studies[index];
    const char *id = job->list.count > 0 ? s->result.id : "";
    if (*id && !job->session.quiet)
        message_note("study %zu of %zu: %s", index + 1, job->count, s->result.title);
    job->renderer.study = id;
    int status = study_run(s, &job->renderer, &job->pictures);
    if (status == STATUS_DONE)
        study_warn_references(s);
    char *table = path_of(job, id, ".csv");
    if (status == STATUS_DONE)
        status = table ? table_write(table, &s->result) : fail_memory();
    free(table);
    return status == STATUS_DONE ? write_page(job, index + 1) : status;
}

/* Checks all studies before the first picture, which may take hours to come. */
static int check_studies(study_job *job)
{
    int status = STATUS_DONE;
    for (size_t i = 0; i < job->count && status == STATUS_DONE; i++) {
        study *const s = &job->studies[i];
        status = study_check(s, &job->renderer, &job->pictures);
        if (status != STATUS_DONE && s->is_listed)
            message_note("in the study '%s' of %s", s->result.id,
                         job->arguments->options[OPTION_LIST].text);
    }
    return status;
}

int command_study(const command_line *arguments)
{
    study_job job = {.arguments = arguments};
    session_begin(&job.session, arguments);
    if (!arguments->options[OPTION_PROGRESS].given)
        job.session.progress = progress_begin_on_terminal(!job.session.quiet);
    job.renderer.session = &job.session;
    int status = plan(&job);
    if (status == STATUS_DONE)
        status = plan_paths(&job);
    if (status == STATUS_DONE)
        status = session_open_device(&job.session, &job.renderer.device,
                                     arguments->options[OPTION_DEVICE].text);
    if (status == STATUS_DONE)
        status = make_folder(&job);
    for (size_t i = 0; i < job.count; i++)
        study_announce(&job.studies[i], &job.pictures);
    if (status == STATUS_DONE)
        status = check_studies(&job);
    for (size_t i = 0; i < job.count && status == STATUS_DONE; i++)
        status = run_study(&job, i);
    /* Only where it is empty: nothing was rendered. */
    if (status != STATUS_DONE && job.has_made_folder)
        rmdir(job.renderer.folder);
    for (size_t i = 0; i < job.count; i++)
        study_free(&job.studies[i]);
    free(job.studies);
    study_list_free(&job.list);
    study_renderer_free(&job.renderer);
    free(job.stem);
    return status;
}
