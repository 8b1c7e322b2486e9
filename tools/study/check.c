/* check.c - what a study tells before its first picture, and of its references at the end. */
#include "check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../message.h"
#include "../settings.h"
#include "../status.h"

/* A name that is no setting is taken for a constant of the scene: says so where that fails. */
static void explain_constants(const study *s)
{
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    const sweep_axis *axis = sweep_find(&s->sweep, SWEEP_CONSTANT);
    rt_nearest nearest;
    if (!axis || axis->constant != axis->name)
        return;
    rt_nearest_begin(&nearest, axis->name, strlen(axis->name));
    for (size_t i = 0; i < count; i++)
        rt_nearest_offer(&nearest, settings[i].field.name, strlen(settings[i].field.name));
    /* What the scene has as a field is no misspelt setting. */
    const char *const meant = rt_field_block(axis->name) ? NULL : nearest.best;
    message_hint("no setting is called '%s', so that it is taken for a constant of the scene%s%s%s",
                 axis->name, meant ? "; did you mean " : "", meant ? meant : "", meant ? "?" : "");
}

/* ---- Settings without effect -------------------------------------------------------- */

/* Of each setting: what it lacks in a picture, and whether it has an effect in one. */
typedef struct effect {
    const rt_setting_need *lacks;
    int is_there;
} effect;

static void note_effects(effect *effects, const study_picture *picture,
                         const rt_render_options *options)
{
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    for (size_t i = 0; i < count; i++) {
        if (!settings_text(&picture->line, &settings[i]))
            continue;
        const rt_setting_need *lacks = rt_setting_missing(&settings[i], options);
        effects[i].is_there |= !lacks;
        effects[i].lacks = lacks ? lacks : effects[i].lacks;
    }
}

static void warn_effects(const study *s, const effect *effects)
{
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    for (size_t i = 0; i < count; i++) {
        char name[SETTING_NAME_SIZE], text[128];
        if (!effects[i].lacks || effects[i].is_there)
            continue;
        message_warning(
            "--%s has no effect %s%s%s%s", settings_name(name, &settings[i]),
            rt_setting_text(text, sizeof text, effects[i].lacks->otherwise, RT_NAME_OPTION),
            s->is_listed ? " in the study '" : "", s->is_listed ? s->result.id : "",
            s->is_listed ? "'" : "");
    }
}

/* ---- Before the pictures ------------------------------------------------------------ */

/* Whether the reference of a combination, if it is there, has the size of its picture. */
static int check_size(const study *s, size_t index, const rt_render_options *options)
{
    const study_view *view = s->references ? &s->references[s->view_of[index]] : NULL;
    char file[4096];
    if (!view || !view->reference ||
        (view->width == options->width && view->height == options->height))
        return STATUS_DONE;
    message_error("--reference %s has %ux%u pixels, but the pictures have %ux%u",
                  views_file(file, sizeof file, &s->views, s->view_of[index],
                             s->arguments->options[OPTION_REFERENCE].text),
                  (unsigned)view->width, (unsigned)view->height, (unsigned)options->width,
                  (unsigned)options->height);
    message_hint("--width %u --height %u renders them in the size of the reference",
                 (unsigned)view->width, (unsigned)view->height);
    return STATUS_USAGE;
}

static int check_cell(study *s, size_t index, effect *effects, study_count *count)
{
    const option_value *reference = &s->arguments->options[OPTION_REFERENCE];
    const size_t cells = sweep_cells(&s->sweep);
    rt_render_options options;
    study_picture picture;
    int status = study_picture_make(&picture, s->arguments, &s->sweep, index, s->scene, "");
    if (status == STATUS_DONE)
        status = study_read_options(&options, s->renderer, &picture);
    if (status != STATUS_DONE && cells > 1)
        message_hint("in the picture of %s", picture.label);
    if (status == STATUS_INPUT)
        explain_constants(s);
    if (status == STATUS_DONE)
        note_effects(effects, &picture, &options);
    if (status == STATUS_DONE && reference->given)
        status = views_check_files(&s->views, reference->text);
    if (status == STATUS_DONE && reference->given && !views_are_rendered(reference->text))
        status = study_find_reference(s, index, count);
    if (status == STATUS_DONE)
        status = check_size(s, index, &options);
    study_picture_free(&picture);
    return status;
}

int study_check(study *s, study_renderer *renderer, study_count *count)
{
    const size_t cells = sweep_cells(&s->sweep), views = sweep_cells(&s->views);
    size_t settings;
    int status = STATUS_DONE;
    rt_settings(&settings);
    effect *effects = calloc(settings, sizeof *effects);
    if (!effects) {
        message_error("out of memory");
        return STATUS_DEVICE;
    }
    s->renderer = renderer;
    renderer->is_checked = 0;
    /* Those of one scene one after the other, so that it is read once. */
    for (size_t view = 0; view < views; view++)
        for (size_t i = 0; i < cells && status == STATUS_DONE; i++)
            if (s->view_of[i] == view)
                status = check_cell(s, i, effects, count);
    renderer->is_checked = 1;
    if (status == STATUS_DONE && !renderer->session->quiet)
        warn_effects(s, effects);
    free(effects);
    return status;
}

/* ---- References ----------------------------------------------------------------------- */

/* The least of what was measured of the pictures of a view: relative RMSE, and bias. */
static void find_least(const study *s, size_t view, double *rmse, double *bias)
{
    *rmse = *bias = INFINITY;
    for (size_t i = 0; i < sweep_cells(&s->sweep); i++) {
        if (s->view_of[i] != view)
            continue;
        *rmse = fmin(*rmse, s->result.cells[i].rmse);
        *bias = fmin(*bias, s->result.cells[i].bias);
    }
}

static void warn_reference(const study_cell *reference, const char *label, double rmse, double bias)
{
    if (reference->leaves_out)
        message_warning("the %s leaves out %s: what pictures have of these counts as their error",
                        label, reference->leaves_out);
    if (reference->target > 0)
        message_warning("the %s ended at its limit of %u samples a pixel with an error of %.3g %%, "
                        "not %.3g %%",
                        label, (unsigned)reference->limit, 100 * reference->rmse,
                        100 * reference->target);
    if (reference->is_coarse)
        message_warning("the %s has an error of its own, %.3g %%, more than half of the least that "
                        "was measured, %.3g %%: errors so small are not those of the pictures",
                        label, 100 * reference->rmse, 100 * rmse);
    if (reference->hides_bias)
        message_warning("the %s is off by %.3g itself, root of relMSE, more than half of the least "
                        "bias, %.3g: biases so small are not those of the pictures",
                        label, reference->noise, bias);
}

void study_warn_references(study *s)
{
    for (size_t view = 0; view < s->result.views; view++) {
        study_cell *reference = &s->result.references[view];
        double rmse, bias;
        find_least(s, view, &rmse, &bias);
        reference->is_coarse = reference->rmse > 0.5 * rmse;
        reference->hides_bias = reference->noise > 0.5 * bias;
        if (s->renderer->session->quiet)
            continue;
        char *label = study_label(&s->views, view, "reference");
        warn_reference(reference, label ? label : "reference", rmse, bias);
        free(label);
    }
}
