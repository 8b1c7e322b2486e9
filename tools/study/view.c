/* view.c - references, read or rendered. */
#include "view.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../message.h"
#include "../recorded.h"
#include "../status.h"

/* Samples and error at which a reference that is made here ends; a seed that pictures rarely have,
 * so that their noise has nothing to do with that of the reference. */
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

const char *views_mode(const char *reference)
{
    static const char *const modes[][2] = {{"auto", "path"}, {"vcm", "vcm"}};
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++)
        if (strcmp(reference, modes[i][0]) == 0)
            return modes[i][1];
    return NULL;
}

int views_check_files(const sweep *views, const char *reference)
{
    const size_t count = sweep_cells(views);
    size_t files = 1;
    for (const char *at = reference; *at; at++)
        files += *at == ',';
    if (count == 1 || views_mode(reference) || files == count)
        return STATUS_DONE;
    message_error("--reference names %zu image%s, but scenes, constants or sizes are swept: each "
                  "has a reference of its own, %zu in all",
                  files, files == 1 ? "" : "s", count);
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

/* The error that an image states of itself, by its layer variance. */
static int take_error(const study_view *view, study_cell *shown)
{
    const size_t count = (size_t)3 * view->width * view->height;
    double sum = 0;
    float *variance = malloc(count * sizeof *variance);
    if (!variance)
        return fail_memory();
    /* Most images have no such layer. */
    const rt_status result = rt_image_get_rgb(variance, view->reference, "variance", NULL);
    for (size_t i = 0; result == RT_OK && i < count; i++)
        sum += isfinite(variance[i]) ? variance[i] : 0.0;
    free(variance);
    if (result == RT_OK && view->mean > 0)
        shown->rmse = sqrt(sum / (double)count) / view->mean;
    return result == RT_ERROR_MEMORY ? fail_memory() : STATUS_DONE;
}

/* Leaves those settings alone that decide what the picture converges to. */
static void strip(study_picture *picture, const command_line *arguments, const char *mode)
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
    study_picture_set(picture, "mode", mode);
    study_picture_set(picture, "spp", reference_spp);
    study_picture_set(picture, "target_error", error->given ? error->text : reference_error);
    study_picture_set(picture, "seed", reference_seed);
}

/* Renders the view until its error is small. */
static int render(study_view *view, study_cell *shown, study_renderer *renderer,
                  study_picture *picture)
{
    rt_film *film = NULL;
    rt_film_info info;
    rt_film_stats stats;
    rt_image *image = NULL;
    rt_error error;
    uint32_t width, height;
    int status = study_render(&film, renderer, picture);
    if (status != STATUS_DONE)
        return status;
    rt_film_get_info(film, &info);
    rt_film_get_stats(film, &stats);
    rt_film_get_size(film, &width, &height);
    shown->seconds = info.seconds;
    shown->rmse = stats.relative_error;
    shown->command = recorded_command(&picture->line, picture->scene, NULL);
    if (!shown->command)
        status = fail_memory();
    else if (rt_image_from_rgb(&image, rt_film_rgb(film), width, height, &error) != RT_OK)
        status = message_failure(&error);
    rt_film_destroy(film);
    return status == STATUS_DONE ? take(view, shown, image) : status;
}

int study_view_open(study_view *out, study_cell *shown, study_renderer *renderer,
                    const command_line *arguments, const sweep *views, size_t view,
                    const char *scene)
{
    const char *path = arguments->options[OPTION_REFERENCE].text, *mode = views_mode(path);
    study_picture picture;
    rt_image *image = NULL;
    rt_error error;
    *shown = STUDY_CELL_UNKNOWN;
    if (!mode) {
        char file[4096];
        views_file(file, sizeof file, views, view, path);
        if (rt_image_read(&image, file, &error) != RT_OK)
            return message_failure(&error);
        const int taken = take(out, shown, image);
        return taken == STATUS_DONE ? take_error(out, shown) : taken;
    }
    int status = study_picture_make(&picture, arguments, views, view, scene, "reference");
    if (status == STATUS_DONE) {
        strip(&picture, arguments, mode);
        status = study_picture_share(&picture);
    }
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
