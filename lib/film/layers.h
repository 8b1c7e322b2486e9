/* layers.h - the layers of a film besides its radiance: one list of their names and channels. */
#ifndef RT_LIB_FILM_LAYERS_H
#define RT_LIB_FILM_LAYERS_H

#include <stddef.h>

#include "rt.h"

/*
 * X(id, name, channels, the channels' names in an .exr, group). The name is the one that
 * rt_film_layer takes; lib/rt/film.h says what each layer holds. A group is the layers that are
 * made together.
 */
#define RT_FILM_LAYERS(X)                                                                          \
    X(ALBEDO, "albedo", 3, "albedo.R", "albedo.G", "albedo.B", FIRST_HIT)                          \
    X(NORMAL, "normal", 3, "normal.X", "normal.Y", "normal.Z", FIRST_HIT)                          \
    X(DEPTH, "depth", 1, "depth.Z", NULL, NULL, FIRST_HIT)                                         \
    X(POSITION, "position", 3, "position.X", "position.Y", "position.Z", FIRST_HIT)                \
    X(UV, "uv", 2, "uv.U", "uv.V", NULL, FIRST_HIT)                                                \
    X(SHAPE, "shape", 1, "shape.Id", NULL, NULL, FIRST_HIT)                                        \
    X(MATERIAL, "material", 1, "material.Id", NULL, NULL, FIRST_HIT)                               \
    X(VARIANCE, "variance", 3, "variance.R", "variance.G", "variance.B", ERROR)                    \
    X(ERROR_BOUND, "error_bound", 3, "error_bound.R", "error_bound.G", "error_bound.B", BOUND)     \
    X(DENOISED, "denoised", 3, "denoised.R", "denoised.G", "denoised.B", DENOISED)                 \
    X(PHOTON_COUNT, "photon.count", 1, "photon.count", NULL, NULL, PHOTON)                         \
    X(PHOTON_RADIUS, "photon.radius", 1, "photon.radius", NULL, NULL, PHOTON)                      \
    X(PHOTON_DENSITY, "photon.density", 1, "photon.density", NULL, NULL, PHOTON)                   \
    X(PHOTON_VARIANCE, "photon.variance", 1, "photon.variance", NULL, NULL, PHOTON)                \
    X(PHOTON_BIAS, "photon.bias", 1, "photon.bias", NULL, NULL, PHOTON)

enum { RT_LAYER_CHANNELS_MAX = 3 };

typedef enum rt_layer_group {
    RT_LAYERS_FIRST_HIT, /* with rt_render_options.aov, and in the modes that show one of them */
    RT_LAYERS_ERROR,     /* with rt_render_options.variance or target_error */
    RT_LAYERS_DENOISED,  /* by rt_film_denoise */
    RT_LAYERS_BOUND,     /* with rt_render_options.variance or target_error in photon passes */
    RT_LAYERS_PHOTON     /* with rt_render_options.photon_layers */
} rt_layer_group;

typedef enum rt_film_layer_id {
#define RT_FILM_LAYER_ID(id, name, channels, a, b, c, group) RT_FILM_##id,
    RT_FILM_LAYERS(RT_FILM_LAYER_ID)
#undef RT_FILM_LAYER_ID
        RT_FILM_LAYER_COUNT
} rt_film_layer_id;

/* What is known of a layer. */
typedef struct rt_layer_info {
    const char *name;
    uint32_t channels;
    const char *channel[RT_LAYER_CHANNELS_MAX]; /* their names in an .exr */
    rt_layer_group group;
} rt_layer_info;
extern const rt_layer_info rt_layer_infos[RT_FILM_LAYER_COUNT];

/* The layers of a film, each [pixels][channels] or NULL. All zero is none. */
typedef struct rt_film_layers {
    float *data[RT_FILM_LAYER_COUNT];
} rt_film_layers;

/*
 * Makes room for the layers of a group, all zero, in place of those that are there;
 * rt_film_layers_free undoes it.
 */
rt_status rt_film_layers_add(rt_film_layers *layers, rt_layer_group group, size_t pixels,
                             rt_error *error);
void rt_film_layers_free(rt_film_layers *layers);

#endif
