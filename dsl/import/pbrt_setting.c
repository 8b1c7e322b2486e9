/* pbrt_setting.c - what stands before the world of a pbrt-v4 scene: camera, film and sampling. */
#include <math.h>
#include <string.h>

#include "dsl/import/pbrt.h"

static const double degrees = 180 / IMPORT_PI;

/* Tells a type that pbrt has not. */
static void note_type(pbrt *p, pbrt_params *params, const char *what, const char *type,
                      const char *const *types)
{
    while (*types && strcmp(*types, type) != 0)
        types++;
    if (!*types)
        rt_import_note_at(p->import, params->line,
                          "there is no %s '%.40s': it is taken as the usual one", what, type);
}

/* The halves of a screen window, and where its middle lies. */
static void read_window(pbrt *p, pbrt_params *params)
{
    const pbrt_param *window = rt_pbrt_find(params, "float", "screenwindow");
    if (!window)
        return;
    const double *v = window->numbers;
    if (window->number_count != 4 || !(v[0] < v[1] && v[2] < v[3])) {
        rt_import_note_at(p->import, window->line,
                          "screenwindow is left out: it takes 4 numbers: x from, to, y from, to");
    } else {
        for (int i = 0; i < 2; i++) {
            p->window[i] = (v[2 * i + 1] - v[2 * i]) / 2;
            p->view.shift[i] = (v[2 * i + 1] + v[2 * i]) / 2 / (v[2 * i + 1] - v[2 * i]);
        }
    }
}

static void read_camera(pbrt *p, pbrt_params *params, const char *type)
{
    static const double origin[3] = {0, 0, 0}, forward[3] = {0, 0, 1}, up[3] = {0, 1, 0};
    matrix to_world;
    if (!rt_matrix_invert(&to_world, &p->state.ctm)) {
        rt_import_fail(p->import, params->line, "the camera's transform has no inverse");
        return;
    }
    rt_pbrt_keep_frame(p, "camera", &to_world);
    p->view = (import_camera){0};
    p->window[0] = p->window[1] = 0;
    p->mirror = rt_matrix_identity();
    if (rt_matrix_determinant(&to_world) > 0)
        p->mirror = rt_matrix_scale(-1, 1, 1);
    matrix place = rt_matrix_multiply(&p->mirror, &to_world);
    rt_matrix_point(p->view.eye, &place, origin);
    rt_matrix_vector(p->view.direction, &place, forward);
    rt_matrix_vector(p->view.up, &place, up);
    p->view.is_orthographic = strcmp(type, "orthographic") == 0;
    p->view.aperture = rt_pbrt_number(params, "lensradius", 0);
    p->view.focal_distance = rt_pbrt_number(params, "focaldistance", 0);
    if (p->view.aperture < 0 || p->view.focal_distance < 0) {
        rt_import_note_at(p->import, params->line,
                          "the lens of lensradius %g and focaldistance %g is left out",
                          p->view.aperture, p->view.focal_distance);
        p->view.aperture = p->view.focal_distance = 0;
    }
    p->fov = rt_pbrt_number(params, "fov", 90);
    if (!(p->fov > 0 && p->fov < 180)) {
        rt_import_note_at(p->import, params->line, "a field of view of %g degrees became 90",
                          p->fov);
        p->fov = 90;
    }
    p->view.width = rt_matrix_axis_length(&to_world, 0);
    read_window(p, params);
    p->shutter =
        rt_pbrt_number(params, "shutterclose", 1) - rt_pbrt_number(params, "shutteropen", 0);
    if (strcmp(type, "perspective") != 0 && strcmp(type, "orthographic") != 0)
        rt_import_note_at(p->import, params->line, "a camera '%.40s' became perspective", type);
    rt_pbrt_note_unused(params, "the camera");
    p->camera_place = rt_pbrt_here(&p->tokens);
    p->camera_medium = p->state.outside;
    p->camera_place.line = params->line;
    p->has_camera = 1;
}

void rt_pbrt_finish_camera(pbrt *p)
{
    const double aspect = (double)p->width / p->height, *const crop = p->crop;
    double half = aspect > 1 ? aspect : 1;
    const char *const usual = p->tokens.is_v3 ? "box" : "gaussian";
    rt_import_set_film(p->import, (uint32_t)(crop[1] - crop[0]), (uint32_t)(crop[3] - crop[2]),
                       p->filter ? p->filter : usual, p->filter_radius);
    rt_import_put(p->import, &p->import->settings, "render { max_depth %d spp %d", p->max_depth,
                  p->samples);
    const double seed = p->has_seed ? p->seed : p->option_seed;
    if (seed > 0)
        rt_import_put(p->import, &p->import->settings, " seed %.0f", seed);
    rt_import_put(p->import, &p->import->settings, " }\n");
    if (!p->has_camera || p->import->failed)
        return;
    const int line = rt_pbrt_at(p->import, p->camera_place);
    if (!(p->shutter > 0) && !p->tokens.is_v3)
        rt_import_note_at(p->import, line, "a shutter that is open for %g counts as open for 1",
                          p->shutter);
    if (!rt_import_takes_camera(p->import, line, NULL, NULL))
        return;
    if (p->window[0] > 0) {
        half = p->window[0];
        if (fabs(p->window[0] / p->window[1] / aspect - 1) > 1e-3)
            rt_import_note_at(p->import, line,
                              "a screen window of another shape than the film is not "
                              "stretched to it: its width counts");
    }
    p->view.fov = 2 * atan(tan(p->fov / 2 / degrees) * half) * degrees;
    p->view.width *= 2 * half;
    const double part[4] = {crop[0] / p->width, crop[2] / p->height, (crop[1] - crop[0]) / p->width,
                            (crop[3] - crop[2]) / p->height};
    rt_import_crop_camera(&p->view, part);
    rt_import_set_camera(p->import, line, &p->view);
}

/* The pixels that are rendered: columns from and to, rows from and to. */
static void read_crop(pbrt *p, pbrt_params *params)
{
    const pbrt_param *const bounds = rt_pbrt_find(params, "integer", "pixelbounds"),
                            *const window = rt_pbrt_find(params, "float", "cropwindow"),
                            *const crop = bounds ? bounds : window;
    const double size[4] = {p->width, p->width, p->height, p->height};
    for (int i = 0; i < 4; i++)
        p->crop[i] = i % 2 ? size[i] : 0;
    if (!crop)
        return;
    double v[4];
    for (int i = 0; i < 4 && crop->number_count == 4; i++)
        v[i] = bounds ? crop->numbers[i] : ceil(crop->numbers[i] * size[i]);
    if (crop->number_count != 4 || !(v[0] >= 0 && v[0] < v[1] && v[1] <= size[0] && v[2] >= 0 &&
                                     v[2] < v[3] && v[3] <= size[2]))
        rt_import_note_at(p->import, crop->line,
                          "%s is not within the film: the whole film is rendered",
                          bounds ? "pixelbounds" : "cropwindow");
    else
        memcpy(p->crop, v, sizeof v);
}

static void read_film(pbrt *p, pbrt_params *params, const char *type)
{
    static const char *const types[] = {"rgb", "gbuffer", "spectral", "image", NULL};
    note_type(p, params, "film", type, types);
    p->tokens.is_v3 |= strcmp(type, "image") == 0;
    p->gain = p->tokens.is_v3 ? rt_pbrt_number(params, "scale", 1)
                              : rt_pbrt_number(params, "iso", 100) / 100;
    if (!(p->gain > 0)) {
        rt_import_note_at(p->import, params->line,
                          "the %s of a film, which is above 0, counts as not given",
                          p->tokens.is_v3 ? "scale" : "iso");
        p->gain = 1;
    }
    if (strcmp(rt_pbrt_string(params, "sensor", "cie1931"), "cie1931") != 0)
        rt_import_note_at(p->import, params->line, "the sensor of a film is left out");
    double width = rt_pbrt_number(params, "xresolution", 1280),
           height = rt_pbrt_number(params, "yresolution", 720);
    rt_pbrt_string(params, "filename", "");
    if (!(width >= 1 && width <= 65536 && height >= 1 && height <= 65536 &&
          width * height <= 268435456)) {
        rt_import_note_at(p->import, params->line, "a film of %g x %g pixels became 1280 x 720",
                          width, height);
        width = 1280;
        height = 720;
    }
    p->width = (uint32_t)width;
    p->height = (uint32_t)height;
    read_crop(p, params);
    rt_pbrt_note_unused(params, "the film");
}

static void read_filter(pbrt *p, pbrt_params *params, const char *type)
{
    /* Radii in pixels: pbrt's default, and the one of the language, which stretches but the box. */
    static const struct {
        const char *type, *filter;
        double usual, radius;
    } filters[] = {{"box", "box", 0.5, 0.5},
                   {"triangle", "tent", 2, 1},
                   {"mitchell", "mitchell", 2, 2},
                   {"gaussian", "gaussian", 1.5, 1.5}};
    size_t i = 0;
    while (i < 3 && strcmp(filters[i].type, type) != 0)
        i++;
    p->filter = filters[i].filter;
    if (strcmp(filters[i].type, type) != 0)
        rt_import_note_at(p->import, params->line, "the filter '%.40s' became gaussian", type);
    const double usual = filters[i].usual;
    double x = rt_pbrt_number(params, "xradius", rt_pbrt_number(params, "xwidth", usual)),
           y = rt_pbrt_number(params, "yradius", rt_pbrt_number(params, "ywidth", usual));
    /* A gaussian is as wide as its deviation says; its radius cuts it, here at three of these. */
    const int is_gaussian = strcmp(type, "gaussian") == 0;
    const double alpha = is_gaussian ? rt_pbrt_number(params, "alpha", 2) : 2; /* of v3 */
    const double usual_sigma = alpha > 0 ? sqrt(1 / (2 * alpha)) : 0.5;
    const double sigma = is_gaussian ? rt_pbrt_number(params, "sigma", usual_sigma) : 0.5;
    const double reach = i == 3 ? 3 * sigma : x;
    const int is_stretched = i != 0 && reach >= 0.01 && reach <= 64 && (i == 3 || x == y);
    p->filter_radius = is_stretched && fabs(reach - filters[i].radius) > 1e-6 ? reach : 0;
    if (i == 3 ? !is_stretched || x < reach - 1e-6 || y < reach - 1e-6
               : !is_stretched && (x != filters[i].radius || y != filters[i].radius))
        rt_import_note_at(p->import, params->line,
                          "a filter of radius %g x %g became the %s of the language", x, y,
                          filters[i].filter);
    rt_pbrt_note_unused(params, "the filter");
}

/* Samples a pixel; how they are drawn is the language's own. */
static void read_sampler(pbrt *p, pbrt_params *params, const char *type)
{
    double samples = strcmp(type, "stratified") == 0 ? rt_pbrt_number(params, "xsamples", 4) *
                                                           rt_pbrt_number(params, "ysamples", 4)
                                                     : rt_pbrt_number(params, "pixelsamples", 16);
    static const char *const types[] = {
        "zsobol",  "halton", "independent", "paddedsobol",    "sobol",      "stratified",
        "pmj02bn", "random", "02sequence",  "lowdiscrepancy", "maxmindist", NULL};
    note_type(p, params, "sampler", type, types);
    p->samples = rt_import_bounded(p->import, params->line, "spp", samples, IMPORT_SAMPLES_MAX);
    const double seed = rt_pbrt_number(params, "seed", -1);
    p->has_seed = seed != -1;
    p->seed = seed >= 0 && seed <= UINT32_MAX ? seed : 0;
    if (p->has_seed && p->seed != seed)
        rt_import_note_at(p->import, params->line, "the seed %g is left out", seed);
    rt_pbrt_string(params, "randomization", "");
    rt_pbrt_flag(params, "jitter", 1);
    rt_pbrt_note_unused(params, "the sampler");
}

/* maxdepth counts the bounces. How lights are chosen and paths ended changes noise alone. */
static void read_integrator(pbrt *p, pbrt_params *params, const char *type)
{
    double bounces = rt_pbrt_number(params, "maxdepth", 5);
    if (bounces < 0) {
        rt_import_note_at(p->import, params->line, "a maxdepth of %g became 5", bounces);
        bounces = 5;
    }
    p->max_depth =
        rt_import_bounded(p->import, params->line, "max_depth", bounces + 1, IMPORT_SEGMENTS_MAX);
    rt_pbrt_string(params, "lightsampler", "");
    if (strcmp(type, "path") != 0 && strcmp(type, "volpath") != 0)
        rt_import_note_integrator(p->import, params->line, type);
    if (rt_pbrt_flag(params, "regularize", 0))
        rt_import_note_at(p->import, params->line, "regularize is left out");
    rt_pbrt_note_unused(params, "the integrator");
}

/* Option "name" value: of how pbrt runs. */
static void read_option(pbrt *p)
{
    char name[PBRT_TEXT];
    if (!rt_pbrt_take_string(p, "Option", name))
        return;
    const int line = rt_pbrt_line(&p->tokens);
    const pbrt_token *const next = rt_pbrt_peek(&p->tokens);
    if (next->kind == PBRT_END ||
        (next->kind == PBRT_WORD && !rt_pbrt_is_among(next->text, "true false"))) {
        rt_import_note_at(p->import, line, "Option \"%.40s\" has no value", name);
        return;
    }
    const pbrt_token value = rt_pbrt_take(&p->tokens);
    if (strcmp(name, "seed") == 0 && value.kind == PBRT_NUMBER && value.number > 0 &&
        value.number <= UINT32_MAX)
        p->option_seed = floor(value.number);
    else
        rt_import_note_at(p->import, line, "Option \"%.40s\" is left out", name);
}

int rt_pbrt_setting(pbrt *p, const char *word)
{
    static const char *const words[] = {"Camera", "Film", "PixelFilter", "Sampler", "Integrator"};
    static const char *const other[] = {"Accelerator", "ColorSpace", "Option"};
    pbrt_params params;
    char type[PBRT_TEXT] = "";
    size_t i = 0, k = 0;
    while (i < 5 && strcmp(words[i], word) != 0)
        i++;
    while (k < 3 && strcmp(other[k], word) != 0)
        k++;
    if (i == 5 && k == 3)
        return 0;
    if (k == 2) {
        read_option(p);
        return 1;
    }
    if (!rt_pbrt_take_string(p, word, type))
        return 1;
    rt_pbrt_read_params(&params, &p->tokens);
    if (p->settings_met & 1u << i)
        rt_import_note_at(p->import, params.line, "a second %s takes the place of the first", word);
    p->settings_met |= i < 5 ? 1u << i : 0;
    if (i == 0)
        read_camera(p, &params, type);
    else if (i == 1)
        read_film(p, &params, type);
    else if (i == 2)
        read_filter(p, &params, type);
    else if (i == 3)
        read_sampler(p, &params, type);
    else if (i == 4)
        read_integrator(p, &params, type);
    else if (k == 1 && strcmp(type, "srgb") != 0)
        rt_import_note_at(p->import, params.line, "the colour space '%.40s' became srgb", type);
    rt_pbrt_free_params(&params);
    return 1;
}
