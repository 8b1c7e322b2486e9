/* lead_map.c - the photon map of a render, emitted in parts by all processes. */
#include <stdlib.h>

#include "../interrupt.h"
#include "lead.h"

/* Waits for the parts of all others; returns whether they are there. */
static int wait_for_parts(lead *l)
{
    for (;;) {
        pthread_mutex_lock(&l->lock);
        const int parts = l->parts, failed = l->status != 0;
        pthread_mutex_unlock(&l->lock);
        if (parts == l->ranks - 1 || failed || interrupt_pending())
            return parts == l->ranks - 1 && !failed;
        wire_rest();
    }
}

/* Makes the bytes of the map, for the thread that talks. */
static rt_status publish(lead *l, const rt_photon_map *map, rt_error *error)
{
    size_t size;
    rt_status status = rt_photon_map_encode(map, NULL, 0, &size, error);
    void *data = status == RT_OK ? malloc(size) : NULL;
    if (status == RT_OK && data)
        status = rt_photon_map_encode(map, data, size, &size, error);
    else if (status == RT_OK)
        status =
            (*error = (rt_error){.status = RT_ERROR_MEMORY, .message = "out of memory"}).status;
    if (status != RT_OK) {
        free(data);
        return status;
    }
    pthread_mutex_lock(&l->lock);
    l->map = data;
    l->map_size = size;
    pthread_mutex_unlock(&l->lock);
    return RT_OK;
}

rt_status lead_share_map(lead *l, rt_photon_map **out, rt_renderer *renderer,
                         const rt_render_options *options, rt_error *error)
{
    rt_render_options o = *options;
    rt_hooks hooks = *options->hooks;
    const rt_emit_options emit = {.render = &o, .part = 0, .parts = (uint32_t)l->ranks};
    hooks.warning = NULL; /* a part has fewer photons than the map */
    o.hooks = &hooks;
    rt_status status = rt_photon_map_emit(&l->members[0].part, renderer, &emit, error);
    if (status != RT_OK)
        return status;
    if (!wait_for_parts(l))
        return RT_CANCELLED;
    const rt_photon_map **parts = calloc((size_t)l->ranks, sizeof *parts);
    if (!parts) {
        *error = (rt_error){.status = RT_ERROR_MEMORY, .message = "out of memory"};
        return RT_ERROR_MEMORY;
    }
    for (int i = 0; i < l->ranks; i++)
        parts[i] = l->members[i].part;
    status = rt_photon_map_merge(out, parts, (size_t)l->ranks, error);
    free(parts);
    for (int i = 0; i < l->ranks; i++) {
        rt_photon_map_destroy(l->members[i].part);
        l->members[i].part = NULL;
    }
    return status == RT_OK && l->ranks > 1 ? publish(l, *out, error) : status;
}
