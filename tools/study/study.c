/* study.c - the pictures of a sweep, rendered and measured. */
#include "study.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../message.h"
#include "../recorded.h"
#include "../settings.h"
#include "../status.h"

typedef enum study_equal { EQUAL_SAMPLES, EQUAL_TIME } study_equal;

static int fail_memory(void)
{
    message_error("out of memory");
    return STATUS_DEVICE;
}

/* ---- Progress --------------------------------------------------------------------- */

/* Adds "; about 1:23 left" as far as it is known. */
static void put_remaining(char *out, size_t size, const study_count *count)
{
    double seconds = 0;
    char time[32];
    out[0] = '\0';
    if (count->done == count->all || count->rendered[0] + count->rendered[1] == 0)
        return;
    for (int i = 0; i < 2; i++)
        seconds += count->rendered[i] == 0
                       ? 0
                       : count->seconds[i] / (double)count->rendered[i] * (double)count->left[i];
    progress_format_time(time, sizeof time, seconds);
    snprintf(out, size, "; about %s left", time);
}

/* A picture is done, or a reference; rendered: how many had been before it. */
static void count_picture(study *s, study_count *count, const char *label, int is_reference,
                          const study_cell *cell, size_t rendered)
{
    const double now = session_seconds(s->renderer->session);
    const int is_new = s->renderer->rendered > rendered, which = is_reference;
    char error[48] = "", remaining[64];
    count->done++;
    count->left[which]--;
    if (is_new) {
        count->rendered[which]++;
        count->seconds[which] += now - count->at;
    }
    count->at = now;
    if (s->renderer->session->quiet)
        return;
    if (isfinite(cell->rmse))
        snprintf(error, sizeof error, ", relative RMSE %.3g %%", 100 * cell->rmse);
    put_remaining(remaining, sizeof remaining, count);
    message_note("%zu of %zu: %s: %.2f s%s%s%s", count->done, count->all, label,
                 isfinite(cell->seconds) ? cell->seconds : 0.0, error, is_new ? "" : ", kept",
                 remaining);
}

/* ---- Measures --------------------------------------------------------------------- */

/* Compares a picture with the reference. */
static int measure(const study_view *view, study_cell *cell, const float *rgb)
{
    rt_image *image = NULL;
    rt_comparison *comparison = NULL;
    rt_comparison_info info;
    rt_error error;
    rt_status result = rt_image_from_rgb(&image, rgb, cell->width, cell->height, &error);
    if (result == RT_OK)
        result = rt_image_compare(&comparison, (const rt_image *const *)&image, 1, view->reference,
                                  NULL, &error);
    rt_image_destroy(image);
    if (result != RT_OK)
        return message_failure(&error);
    rt_comparison_get_info(comparison, &info);
    rt_comparison_destroy(comparison);
    cell->rmse = view->mean > 0 ? info.rmse / view->mean : NAN;
    cell->relmse = info.relmse;
    cell->flip = info.flip;
    cell->ratio = info.ratio;
    return STATUS_DONE;
}

/* Sums of renders that differ by their seed alone, [height][width][3]. */
typedef struct repeat_sums {
    double *sum, *squares;
    size_t count;
} repeat_sums;

static int add_repeat(repeat_sums *sums, const rt_film *film)
{
    uint32_t width, height;
    rt_film_get_size(film, &width, &height);
    sums->count = (size_t)3 * width * height;
    if (!sums->sum) {
        sums->sum = calloc(2 * sums->count, sizeof *sums->sum);
        sums->squares = sums->sum ? sums->sum + sums->count : NULL;
    }
    for (size_t i = 0; sums->sum && i < sums->count; i++) {
        const double value = rt_film_rgb(film)[i];
        sums->sum[i] += value;
        sums->squares[i] += value * value;
    }
    return sums->sum ? STATUS_DONE : fail_memory();
}

/*
 * Splits the expected relMSE of one render into noise and bias: with n renders a, their variance v
 * and the reference r, means over the pixels of w v and of w ((mean a - r)^2 - v / n), where w is
 * 1 / (r^2 + 0.01). What the noise hides has no bias that could be told.
 */
static void split(study_cell *cell, const study_view *view, const repeat_sums *sums, double n)
{
    double noise = 0, bias = 0;
    size_t count = 0;
    for (size_t i = 0; i < sums->count; i++) {
        const double r = view->rgb[i], mean = sums->sum[i] / n;
        const double variance = (sums->squares[i] - n * mean * mean) / (n - 1);
        if (!isfinite(r) || !isfinite(variance))
            continue;
        noise += variance / (r * r + STUDY_RELMSE_FLOOR);
        bias += ((mean - r) * (mean - r) - variance / n) / (r * r + STUDY_RELMSE_FLOOR);
        count++;
    }
    cell->noise = count > 0 && noise > 0 ? sqrt(noise / (double)count) : NAN;
    cell->bias = count > 0 && bias > 0 ? sqrt(bias / (double)count) : NAN;
}

/* ---- Cells ------------------------------------------------------------------------ */

/* Describes and measures the first render of a picture. */
static int finish_cell(study *s, study_cell *cell, size_t index, const study_picture *picture,
                       const rt_film *film)
{
    uint32_t width, height;
    rt_film_info info;
    rt_render_options options;
    rt_film_get_info(film, &info);
    rt_film_get_size(film, &width, &height);
    *cell = STUDY_CELL_UNKNOWN;
    cell->seconds = info.seconds;
    cell->command = recorded_command(&picture->line, picture->scene, NULL);
    rt_film_get_options(film, &options);
    cell->leaves_out = rt_renderer_leaves_out(s->renderer->ready.renderer, &options);
    if (!cell->command || !study_cell_set_pixels(cell, rt_film_rgb(film), width, height))
        return fail_memory();
    return s->references ? measure(&s->references[s->view_of[index]], cell, rt_film_rgb(film))
                         : STATUS_DONE;
}

/* Renders a picture as often as it is to be. */
static int render_cell(study *s, size_t index, study_picture *picture)
{
    study_cell *cell = &s->result.cells[index];
    repeat_sums sums = {0};
    int status = STATUS_DONE;
    for (uint32_t i = 0; i < s->repeats && status == STATUS_DONE; i++) {
        rt_film *film = NULL;
        picture->repeat = i;
        status = study_render(&film, s->renderer, picture);
        if (status == STATUS_DONE && i == 0)
            status = finish_cell(s, cell, index, picture, film);
        if (status == STATUS_DONE && s->repeats > 1 && s->references)
            status = add_repeat(&sums, film);
        rt_film_destroy(film);
    }
    if (status == STATUS_DONE && sums.sum)
        split(cell, &s->references[s->view_of[index]], &sums, s->repeats);
    free(sums.sum);
    return status;
}

/* Gives a picture the time of the first one, and as many samples or passes as that takes. */
static void limit_time(const study *s, study_picture *picture)
{
    const rt_setting *passes = rt_setting_find("passes");
    study_picture_set(picture, "time", s->time);
    study_picture_set(picture, "target_error", NULL);
    if (settings_text(&picture->line, passes))
        study_picture_set(picture, "passes", "16777216");
    else
        study_picture_set(picture, "spp", "16777216");
}

int study_find_reference(study *s, size_t index, study_count *count)
{
    const size_t view = s->view_of[index], rendered = s->renderer->rendered;
    if (!s->references || s->references[view].reference)
        return STATUS_DONE;
    const int status = study_view_open(&s->references[view], &s->result.references[view],
                                       s->renderer, s->arguments, &s->views, view, s->scene);
    char *label = study_label(&s->views, view, "reference");
    if (status == STATUS_DONE)
        count_picture(s, count, label ? label : "reference", 1, &s->result.references[view],
                      rendered);
    free(label);
    return status;
}

static int do_cell(study *s, size_t index, study_count *count)
{
    study_picture picture;
    study_cell *cell = &s->result.cells[index];
    const option_value *equal = &s->arguments->options[OPTION_EQUAL];
    int status = study_picture_make(&picture, s->arguments, &s->sweep, index, s->scene, "");
    if (status == STATUS_DONE)
        status = study_find_reference(s, index, count);
    if (status == STATUS_DONE && s->time[0])
        limit_time(s, &picture);
    const size_t rendered = s->renderer->rendered;
    if (status == STATUS_DONE)
        status = render_cell(s, index, &picture);
    if (status == STATUS_DONE)
        count_picture(s, count, picture.label, 0, cell, rendered);
    if (status == STATUS_DONE && equal->given && equal->choice == EQUAL_TIME && !s->time[0])
        snprintf(s->time, sizeof s->time, "%.6g", cell->seconds);
    study_picture_free(&picture);
    return status;
}

/* ---- The whole -------------------------------------------------------------------- */

/* Reads the axes, and whose scene it is. */
static int plan_axes(study *s)
{
    const command_line *arguments = s->arguments;
    int status = STATUS_DONE;
    for (size_t i = 0; i < arguments->sweep_count && status == STATUS_DONE; i++)
        status = sweep_add(&s->sweep, arguments->sweeps[i]);
    if (status != STATUS_DONE)
        return status;
    const int is_swept = sweep_find(&s->sweep, SWEEP_SCENE) != NULL;
    if (arguments->operand_count == (is_swept ? 0u : 1u) && s->sweep.count > 0) {
        s->scene = is_swept ? NULL : arguments->operands[0];
        return STATUS_DONE;
    }
    if (is_swept && arguments->operand_count > 0) {
        message_error("the scene is given twice: leave %s out", arguments->operands[0]);
        message_hint("--sweep scene=... names the scenes");
    } else {
        message_error("usage: rtc study SCENE --sweep NAME=VALUE,... [OPTION]...");
    }
    return STATUS_USAGE;
}

/* Reads what pictures are compared with, and how often each is rendered. */
static int plan_measures(study *s)
{
    const option_value *options = s->arguments->options;
    const option_value *reference = &options[OPTION_REFERENCE];
    s->repeats = options[OPTION_REPEAT].given ? (uint32_t)options[OPTION_REPEAT].count : 1;
    s->views = views_of(&s->sweep);
    if (!reference->given && s->repeats > 1) {
        message_error("--repeat tells noise from bias by a reference: add --reference auto");
        return STATUS_USAGE;
    }
    if (options[OPTION_REFERENCE_ERROR].given &&
        !(reference->given && views_are_rendered(reference->text))) {
        message_error("--reference-error is of a reference that is rendered: %s",
                      reference->given ? "--reference names images" : "add --reference auto");
        return STATUS_USAGE;
    }
    /* A name that may be a misspelt setting is looked up in the scene first: study_check. */
    const sweep_axis *constant = sweep_find(&s->sweep, SWEEP_CONSTANT);
    return reference->given && !(constant && constant->constant == constant->name)
               ? views_check_files(&s->views, reference->text)
               : STATUS_DONE;
}

static int plan_results(study *s)
{
    const size_t cells = sweep_cells(&s->sweep), views = sweep_cells(&s->views);
    s->result.axes = &s->sweep;
    s->result.cells = calloc(cells, sizeof *s->result.cells);
    s->view_of = calloc(cells, sizeof *s->view_of);
    if (!s->result.cells || !s->view_of)
        return fail_memory();
    for (size_t i = 0; i < cells; i++)
        s->view_of[i] = view_of_cell(&s->sweep, i);
    s->result.view = s->view_of;
    if (!s->arguments->options[OPTION_REFERENCE].given)
        return STATUS_DONE;
    s->result.references = calloc(views, sizeof *s->result.references);
    s->references = calloc(views, sizeof *s->references);
    if (!s->result.references || !s->references)
        return fail_memory();
    s->result.views = views;
    return STATUS_DONE;
}

int study_begin(study *out, const command_line *arguments)
{
    *out = (study){.arguments = arguments};
    int status = plan_axes(out);
    if (status == STATUS_DONE)
        status = plan_measures(out);
    return status == STATUS_DONE ? plan_results(out) : status;
}

void study_announce(const study *s, study_count *count)
{
    count->left[0] += sweep_cells(&s->sweep);
    count->left[1] += s->result.views;
    count->all += sweep_cells(&s->sweep) + s->result.views;
}

int study_run(study *s, study_renderer *renderer, study_count *count)
{
    const size_t cells = sweep_cells(&s->sweep);
    s->renderer = renderer;
    int status = STATUS_DONE;
    for (size_t i = 0; i < cells && status == STATUS_DONE; i++)
        status = do_cell(s, i, count);
    for (size_t i = 0; i < s->result.views; i++)
        study_view_free(&s->references[i]);
    return status;
}

void study_free(study *s)
{
    for (size_t i = 0; s->result.cells && i < sweep_cells(&s->sweep); i++)
        study_cell_free(&s->result.cells[i]);
    for (size_t i = 0; i < s->result.views; i++) {
        study_cell_free(&s->result.references[i]);
        study_view_free(&s->references[i]);
    }
    free(s->result.cells);
    free(s->result.references);
    free(s->references);
    free(s->view_of);
    sweep_free(&s->sweep);
}
