/* study.c - the pictures of a sweep, rendered and measured. */
#include "study.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../message.h"
#include "../recorded.h"
#include "../status.h"

typedef enum study_equal { EQUAL_SAMPLES, EQUAL_TIME } study_equal;

static int fail_memory(void)
{
    message_error("out of memory");
    return STATUS_DEVICE;
}

/* ---- The reference ---------------------------------------------------------------- */

/* Samples and error at which a reference that is made here ends. */
static const char reference_spp[] = "16384", reference_error[] = "0.005";

static double mean_of(const float *rgb, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < 3 * count; i++)
        sum += isfinite(rgb[i]) ? rgb[i] : 0.0;
    return count > 0 ? sum / (3.0 * (double)count) : 0;
}

/* Takes an image as the reference, and shows it. */
static int take_reference(study *s, rt_image *image)
{
    uint32_t width, height;
    rt_error error;
    study_cell *cell = &s->result.reference;
    rt_image_destroy(s->reference);
    s->reference = image;
    rt_image_get_size(image, &width, &height);
    float *rgb = malloc(3 * sizeof *rgb * width * height);
    if (!rgb)
        return fail_memory();
    int status = STATUS_DONE;
    if (rt_image_get_rgb(rgb, image, NULL, &error) != RT_OK)
        status = message_failure(&error);
    s->mean = mean_of(rgb, (size_t)width * height);
    free(cell->pixels);
    if (status == STATUS_DONE && !study_cell_set_pixels(cell, rgb, width, height))
        status = fail_memory();
    free(rgb);
    cell->rmse = cell->relmse = cell->flip = cell->ratio = NAN;
    s->result.has_reference = 1;
    return status;
}

static int read_reference(study *s, const char *path)
{
    rt_image *image = NULL;
    rt_error error;
    if (rt_image_read(&image, path, &error) != RT_OK)
        return message_failure(&error);
    s->result.reference.seconds = NAN;
    return take_reference(s, image);
}

/* Path traces the picture of a cell until its error is small. */
static int render_reference(study *s)
{
    static const sweep none = {0};
    study_picture picture;
    rt_film *film = NULL;
    rt_image *image = NULL;
    rt_error error;
    uint32_t width, height;
    int status = study_picture_make(&picture, s->arguments, &none, 0, s->scene);
    if (status == STATUS_DONE) {
        study_picture_set(&picture, "mode", "path");
        study_picture_set(&picture, "spp", reference_spp);
        study_picture_set(&picture, "target_error", reference_error);
        study_picture_set(&picture, "time", NULL);
        status = study_render(&film, s->renderer, &picture);
    }
    if (status == STATUS_DONE) {
        rt_film_info info;
        rt_film_get_info(film, &info);
        rt_film_get_size(film, &width, &height);
        s->result.reference.command = recorded_command(&picture.line, picture.scene);
        s->result.reference.seconds = info.seconds;
        if (rt_image_from_rgb(&image, rt_film_rgb(film), width, height, &error) != RT_OK)
            status = message_failure(&error);
    }
    study_picture_free(&picture);
    rt_film_destroy(film);
    return status == STATUS_DONE ? take_reference(s, image) : status;
}

/* ---- Cells ------------------------------------------------------------------------ */

/* Compares a picture with the reference. */
static int measure(study *s, study_cell *cell, const float *rgb, uint32_t width, uint32_t height)
{
    rt_image *image = NULL;
    rt_comparison *comparison = NULL;
    rt_comparison_info info;
    rt_error error;
    cell->rmse = cell->relmse = cell->flip = cell->ratio = NAN;
    if (!s->reference)
        return STATUS_DONE;
    rt_status result = rt_image_from_rgb(&image, rgb, width, height, &error);
    if (result == RT_OK)
        result = rt_image_compare(&comparison, (const rt_image *const *)&image, 1, s->reference,
                                  NULL, &error);
    rt_image_destroy(image);
    if (result != RT_OK)
        return message_failure(&error);
    rt_comparison_get_info(comparison, &info);
    rt_comparison_destroy(comparison);
    cell->rmse = s->mean > 0 ? info.rmse / s->mean : NAN;
    cell->relmse = info.relmse;
    cell->flip = info.flip;
    cell->ratio = info.ratio;
    return STATUS_DONE;
}

static int finish_cell(study *s, study_cell *cell, const study_picture *picture,
                       const rt_film *film)
{
    uint32_t width, height;
    rt_film_info info;
    rt_film_get_info(film, &info);
    rt_film_get_size(film, &width, &height);
    cell->seconds = info.seconds;
    cell->command = recorded_command(&picture->line, picture->scene);
    if (!cell->command || !study_cell_set_pixels(cell, rt_film_rgb(film), width, height))
        return fail_memory();
    return measure(s, cell, rt_film_rgb(film), width, height);
}

/* Makes sure of the reference that all cells are compared with. */
static int find_reference(study *s)
{
    const option_value *reference = &s->arguments->options[OPTION_REFERENCE];
    if (!reference->given || s->reference)
        return STATUS_DONE;
    return strcmp(reference->text, "auto") == 0 ? render_reference(s)
                                                : read_reference(s, reference->text);
}

static int do_cell(study *s, size_t index, size_t count)
{
    study_picture picture;
    rt_film *film = NULL;
    study_cell *cell = &s->result.cells[index];
    int status = study_picture_make(&picture, s->arguments, &s->sweep, index, s->scene);
    if (status == STATUS_DONE)
        status = find_reference(s);
    if (status == STATUS_DONE && s->time[0]) {
        study_picture_set(&picture, "time", s->time);
        study_picture_set(&picture, "spp", NULL);
    }
    if (status == STATUS_DONE)
        status = study_render(&film, s->renderer, &picture);
    if (status == STATUS_DONE)
        status = finish_cell(s, cell, &picture, film);
    if (status == STATUS_DONE && !s->renderer->session->quiet)
        message_note("%zu of %zu: %s: %.2f s%s%.3g%s", index + 1, count, picture.label,
                     cell->seconds, isfinite(cell->rmse) ? ", relative RMSE " : "",
                     isfinite(cell->rmse) ? 100 * cell->rmse : 0.0,
                     isfinite(cell->rmse) ? " %" : "");
    const option_value *equal = &s->arguments->options[OPTION_EQUAL];
    if (status == STATUS_DONE && equal->given && equal->choice == EQUAL_TIME && !s->time[0])
        snprintf(s->time, sizeof s->time, "%.9g", cell->seconds);
    rt_film_destroy(film);
    study_picture_free(&picture);
    return status;
}

/* ---- The whole ------------------------------------------------------------------- */

/* Reads the axes, and whose scene it is. */
static int plan(study *s)
{
    const command_line *arguments = s->arguments;
    int status = STATUS_DONE;
    for (size_t i = 0; i < arguments->sweep_count && status == STATUS_DONE; i++)
        status = sweep_add(&s->sweep, arguments->sweeps[i]);
    if (status != STATUS_DONE)
        return status;
    const int is_swept = sweep_find(&s->sweep, SWEEP_SCENE) != NULL;
    if (arguments->operand_count != (is_swept ? 0u : 1u) || s->sweep.count == 0) {
        message_error("usage: rtc study SCENE.rts --sweep NAME=VALUE,... [OPTION]...");
        if (is_swept && arguments->operand_count > 0)
            message_hint("--sweep scene=... names the scenes");
        return STATUS_USAGE;
    }
    s->scene = is_swept ? NULL : arguments->operands[0];
    if ((is_swept || sweep_find(&s->sweep, SWEEP_CONSTANT)) &&
        arguments->options[OPTION_REFERENCE].given) {
        message_error("--reference is for one scene; a sweep of scenes or of their constants has "
                      "several");
        return STATUS_USAGE;
    }
    s->result.axes = &s->sweep;
    s->result.cells = calloc(sweep_cells(&s->sweep), sizeof *s->result.cells);
    return s->result.cells ? STATUS_DONE : fail_memory();
}

int study_begin(study *out, const command_line *arguments)
{
    *out = (study){.arguments = arguments};
    return plan(out);
}

int study_run(study *s, study_renderer *renderer)
{
    const size_t count = sweep_cells(&s->sweep);
    int status = STATUS_DONE;
    s->renderer = renderer;
    for (size_t i = 0; i < count && status == STATUS_DONE; i++)
        status = do_cell(s, i, count);
    rt_image_destroy(s->reference);
    s->reference = NULL;
    return status;
}

void study_free(study *s)
{
    for (size_t i = 0; s->result.cells && i < sweep_cells(&s->sweep); i++)
        study_cell_free(&s->result.cells[i]);
    free(s->result.cells);
    study_cell_free(&s->result.reference);
    rt_image_destroy(s->reference);
    sweep_free(&s->sweep);
}
