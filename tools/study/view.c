/* view.c - references, read or rendered. */
#include "view.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../message.h"
#include "../recorded.h"
#include "../status.h"

/*
 * Samples and error at which a reference that is made here ends; a seed that pictures rarely have,
 * so that their noise has nothing to do with that of the reference.
 */
static const char reference_spp[] = "16384", reference_error[] = "0.01",
                  reference_seed[] = "4294967295";

/* The settings that decide what a picture converges to, whatever its mode. */
static const char *const of_the_picture[] = {"width",  "height",        "max_depth",
                                             "filter", "filter_radius", NULL};

static int fail_memory(void)
{
    message_error("out of memory");
    return STATUS_DEVICE;
}

/* ---- Which view ------------------------------------------------------------------- */

static int decides_view(const sweep_axis *axis)
{
    switch (axis->kind) {
    case SWEEP_SCENE:
    case SWEEP_CONSTANT:
        return 1;
    case SWEEP_SETTING:
        return strcmp(axis->name, "width") == 0 || strcmp(axis->name, "height") == 0;
    case SWEEP_ACCEL:
        break;
    }
    return 0;
}

sweep views_of(const sweep *all)
{
    sweep views = {0};
    for (size_t i = 0; i < all->count; i++)
        if (decides_view(&all->axes[i]))
            views.axes[views.count++] = all->axes[i];
    return views;
}

size_t view_of_cell(const sweep *all, size_t cell)
{
    size_t view = 0;
    for (size_t i = 0; i < all->count; i++)
        if (decides_view(&all->axes[i]))
            view = view * all->axes[i].count + sweep_place(all, cell, i);
    return view;
}

/* ---- Files ------------------------------------------------------------------------ */

static const char *const rendered[] = {"auto", "path", "vcm"};
enum { rendered_count = sizeof rendered / sizeof *rendered };

int views_are_rendered(const char *reference)
{
    for (size_t i = 0; i < rendered_count; i++)
        if (strcmp(reference, rendered[i]) == 0)
            return 1;
    return 0;
}

/* A word that is nearly one of those may be meant where there is no such file. */
static void hint_word(const char *reference)
{
    rt_nearest search;
    rt_nearest_begin(&search, reference, strlen(reference));
    for (size_t i = 0; i < rendered_count; i++)
        rt_nearest_offer(&search, rendered[i], strlen(rendered[i]));
    if (search.best)
        message_hint("did you mean --reference %s?", search.best);
}

int views_check_files(const sweep *views, const char *reference)
{
    const size_t count = sweep_cells(views);
    size_t files = 1;
    for (const char *at = reference; *at; at++)
        files += *at == ',';
    if (count == 1 || views_are_rendered(reference) || files == count)
        return STATUS_DONE;
    if (strcmp(reference, "none") == 0) {
        message_error("--reference takes auto, path, vcm or images; not 'none'");
        message_hint("leave --reference out to compare with nothing");
        return STATUS_USAGE;
    }
    message_error("a sweep of scenes, constants or the size needs one reference for each value, "
                  "%zu in all; --reference names %zu image%s",
                  count, files, files == 1 ? "" : "s");
    message_hint("--reference A,B,... names them in the order of the values, the last --sweep "
                 "fastest; --reference auto renders them");
    return STATUS_USAGE;
}

const char *views_file(char *out, size_t size, const sweep *views, size_t view,
                       const char *reference)
{
    size_t length = strlen(reference);
    for (size_t i = 0; i < view; i++)
        reference = strchr(reference, ',') + 1;
    if (sweep_cells(views) > 1)
        length = strcspn(reference, ",");
    snprintf(out, size, "%.*s", (int)length, reference);
    return out;
}

/* ---- The reference ---------------------------------------------------------------- */

static double mean_of(const float *rgb, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < 3 * count; i++)
        sum += isfinite(rgb[i]) ? rgb[i] : 0.0;
    return count > 0 ? sum / (3.0 * (double)count) : 0;
}

/* Takes an image, which it owns from now on. */
static int take(study_view *view, study_cell *shown, rt_image *image)
{
    rt_error error;
    view->reference = image;
    rt_image_get_size(image, &view->width, &view->height);
    view->rgb = malloc(3 * sizeof *view->rgb * view->width * view->height);
    if (!view->rgb)
        return fail_memory();
    if (rt_image_get_rgb(view->rgb, image, NULL, &error) != RT_OK)
        return message_failure(&error);
    view->mean = mean_of(view->rgb, (size_t)view->width * view->height);
    return study_cell_set_pixels(shown, view->rgb, view->width, view->height) ? STATUS_DONE
                                                                              : fail_memory();
}

/*
 * The error that a reference states of itself by the variance of its pixels [3 * count]: its
 * relative RMSE, and the root of its relMSE.
 */
static void take_variance(const study_view *view, study_cell *shown, const float *variance)
{
    const size_t count = (size_t)3 * view->width * view->height;
    double sum = 0, weighted = 0;
    for (size_t i = 0; i < count; i++) {
        const double r = view->rgb[i];
        if (!isfinite(variance[i]) || !isfinite(r))
            continue;
        sum += variance[i];
        weighted += variance[i] / (r * r + STUDY_RELMSE_FLOOR);
    }
    shown->noise = sqrt(weighted / (double)count);
    if (view->mean > 0)
        shown->rmse = sqrt(sum / (double)count) / view->mean;
}

/* The same of a file's layer, which most images lack. */
static int take_error(const study_view *view, study_cell *shown)
{
    float *variance = malloc((size_t)3 * view->width * view->height * sizeof *variance);
    if (!variance)
        return fail_memory();
    const rt_status result = rt_image_get_rgb(variance, view->reference, "variance", NULL);
    if (result == RT_OK)
        take_variance(view, shown, variance);
    free(variance);
    return result == RT_ERROR_MEMORY ? fail_memory() : STATUS_DONE;
}

/* Leaves those settings alone that decide what the picture converges to. */
static void strip(study_picture *picture, const command_line *arguments)
{
    const option_value *error = &arguments->options[OPTION_REFERENCE_ERROR];
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    for (size_t i = 0; i < count; i++) {
        const char *const *name = of_the_picture;
        while (*name && strcmp(*name, settings[i].field.name) != 0)
            name++;
        if (!*name)
            picture->line.settings[i] = NULL;
    }
    study_picture_set(picture, "spp", reference_spp);
    study_picture_set(picture, "target_error", error->given ? error->text : reference_error);
    study_picture_set(picture, "seed", reference_seed);
    study_picture_set(picture, "variance", "true");
}

/* Whether mode vcm renders the scene that is ready, and leaves out none of its light. */
static int finds_all(const study_renderer *renderer, rt_render_options options)
{
    rt_film *film = NULL;
    options.mode = RT_MODE_VCM;
    const int is_rendered = rt_film_begin(&film, renderer->ready.renderer, &options, NULL) == RT_OK;
    rt_film_destroy(film);
    return is_rendered && !rt_renderer_leaves_out(renderer->ready.renderer, &options);
}

/* Sets the mode of a reference by the word of --reference. */
static int choose_mode(study_picture *picture, study_renderer *renderer, const char *word)
{
    rt_render_options options;
    const int is_auto = strcmp(word, "auto") == 0;
    study_picture_set(picture, "mode", is_auto ? "path" : word);
    const int status = study_prepare(&options, renderer, picture);
    if (status != STATUS_DONE || !is_auto)
        return status;
    const char *missing = rt_renderer_leaves_out(renderer->ready.renderer, &options);
    if (missing && finds_all(renderer, options)) {
        study_picture_set(picture, "mode", "vcm");
        if (!renderer->session->quiet)
            message_note(
                "the %s is by mode vcm, as mode path leaves out %s; --reference path takes "
                "that all the same",
                picture->label, missing);
    }
    return STATUS_DONE;
}

/* Describes a reference that was rendered. */
static int describe(study_view *view, study_cell *shown, const study_renderer *renderer,
                    const study_picture *picture, const rt_film *film)
{
    rt_film_info info;
    rt_film_stats stats;
    rt_render_options options;
    uint32_t channels;
    rt_film_get_info(film, &info);
    rt_film_get_stats(film, &stats);
    rt_film_get_options(film, &options);
    const float *variance = rt_film_layer(film, "variance", &channels);
    if (variance && channels == 3)
        take_variance(view, shown, variance);
    shown->seconds = info.seconds;
    shown->rmse = stats.relative_error;
    shown->leaves_out = rt_renderer_leaves_out(renderer->ready.renderer, &options);
    if (stats.relative_error > options.target_error) {
        shown->target = options.target_error;
        shown->limit = options.spp;
    }
    shown->command = recorded_command(&picture->line, picture->scene, NULL);
    return shown->command ? STATUS_DONE : fail_memory();
}

/* Renders the view until its error is small. */
static int render(study_view *view, study_cell *shown, study_renderer *renderer,
                  study_picture *picture)
{
    rt_film *film = NULL;
    rt_image *image = NULL;
    rt_error error;
    uint32_t width, height;
    int status = study_render(&film, renderer, picture);
    if (status != STATUS_DONE)
        return status;
    rt_film_get_size(film, &width, &height);
    status = rt_image_from_rgb(&image, rt_film_rgb(film), width, height, &error) == RT_OK
                 ? take(view, shown, image)
                 : message_failure(&error);
    if (status == STATUS_DONE)
        status = describe(view, shown, renderer, picture, film);
    rt_film_destroy(film);
    return status;
}

int study_view_open(study_view *out, study_cell *shown, study_renderer *renderer,
                    const command_line *arguments, const sweep *views, size_t view,
                    const char *scene)
{
    const char *path = arguments->options[OPTION_REFERENCE].text;
    study_picture picture;
    rt_image *image = NULL;
    rt_error error;
    *shown = STUDY_CELL_UNKNOWN;
    if (!views_are_rendered(path)) {
        char file[4096];
        views_file(file, sizeof file, views, view, path);
        if (rt_image_read(&image, file, &error) != RT_OK) {
            const int failed = message_failure(&error);
            hint_word(path);
            return failed;
        }
        const int taken = take(out, shown, image);
        return taken == STATUS_DONE ? take_error(out, shown) : taken;
    }
    int status = study_picture_make(&picture, arguments, views, view, scene, "reference");
    if (status == STATUS_DONE) {
        strip(&picture, arguments);
        status = choose_mode(&picture, renderer, path);
    }
    if (status == STATUS_DONE)
        status = study_picture_share(&picture);
    if (status == STATUS_DONE)
        status = render(out, shown, renderer, &picture);
    study_picture_free(&picture);
    return status;
}

void study_view_free(study_view *view)
{
    rt_image_destroy(view->reference);
    free(view->rgb);
    *view = (study_view){0};
}
