/*
 * film_layers.c - the layers of a film besides its radiance: one table of their names and shapes.
 */
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "render/film.h"

const rt_layer_kind rt_layer_kinds[RT_FILM_LAYERS] = {
    [RT_FILM_ALBEDO] = {"albedo", 3, {"albedo.R", "albedo.G", "albedo.B"}},
    [RT_FILM_NORMAL] = {"normal", 3, {"normal.X", "normal.Y", "normal.Z"}},
    [RT_FILM_DEPTH] = {"depth", 1, {"depth.Z"}},
    [RT_FILM_VARIANCE] = {"variance", 3, {"variance.R", "variance.G", "variance.B"}},
    [RT_FILM_PHOTON_COUNT] = {"photon.count", 1, {"photon.count"}},
    [RT_FILM_PHOTON_RADIUS] = {"photon.radius", 1, {"photon.radius"}},
    [RT_FILM_PHOTON_DENSITY] = {"photon.density", 1, {"photon.density"}},
    [RT_FILM_PHOTON_VARIANCE] = {"photon.variance", 1, {"photon.variance"}},
    [RT_FILM_PHOTON_BIAS] = {"photon.bias", 1, {"photon.bias"}},
};

rt_status rt_film_add_layers(rt_film *film, rt_film_layer_id first, rt_film_layer_id last,
                             rt_error *error)
{
    size_t pixels = (size_t)film->options.width * film->options.height;
    for (int i = (int)first; i <= (int)last; i++) {
        film->layers[i] = calloc(pixels, rt_layer_kinds[i].channels * sizeof **film->layers);
        if (!film->layers[i])
            return rt_fail(error, RT_ERROR_MEMORY, "out of memory for the layer %s of %zu pixels",
                           rt_layer_kinds[i].name, pixels);
    }
    return RT_OK;
}

const float *rt_film_layer(const rt_film *film, const char *name, uint32_t *channels)
{
    for (int i = 0; i < RT_FILM_LAYERS; i++)
        if (film->layers[i] && strcmp(name, rt_layer_kinds[i].name) == 0) {
            if (channels)
                *channels = rt_layer_kinds[i].channels;
            return film->layers[i];
        }
    return NULL;
}
