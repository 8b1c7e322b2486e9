/* layers.c - the list of layers as a table, and their memory. */
#include "film/layers.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"

const rt_layer_info rt_layer_infos[RT_FILM_LAYER_COUNT] = {
#define LAYER_INFO(id, name, channels, a, b, c, group)                                             \
    {name, channels, {a, b, c}, RT_LAYERS_##group},
    RT_FILM_LAYERS(LAYER_INFO)
#undef LAYER_INFO
};

rt_status rt_film_layers_add(rt_film_layers *layers, rt_layer_group group, size_t pixels,
                             rt_error *error)
{
    for (int i = 0; i < RT_FILM_LAYER_COUNT; i++) {
        if (rt_layer_infos[i].group != group)
            continue;
        free(layers->data[i]);
        layers->data[i] = calloc(pixels, rt_layer_infos[i].channels * sizeof **layers->data);
        if (!layers->data[i])
            return rt_fail(error, RT_ERROR_MEMORY, "out of memory for the layer %s of %zu pixels",
                           rt_layer_infos[i].name, pixels);
    }
    return RT_OK;
}

void rt_film_layers_free(rt_film_layers *layers)
{
    for (int i = 0; i < RT_FILM_LAYER_COUNT; i++)
        free(layers->data[i]);
    memset(layers, 0, sizeof *layers);
}
