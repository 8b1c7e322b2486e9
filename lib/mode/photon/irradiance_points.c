/* irradiance_points.c - estimates the irradiance at some of the photons. */
#include "mode/photon/irradiance_points.h"

#include <string.h>

#include "base/memory.h"

static const char what[] = "the irradiance at photons";

/* Writes the places of every step-th photon of a list to two arrays of [count][3]. */
static void choose_places(float *positions, float *normals, const rt_photon_list *list,
                          uint32_t step, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const rt_photon *photon = list->photons + i * step;
        memcpy(positions + 3 * i, photon->position, sizeof photon->position);
        memcpy(normals + 3 * i, photon->normal, sizeof photon->normal);
    }
}

static void append(rt_photon_list *out, const float *positions, const float *normals,
                   const float *rgb, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        rt_photon *p = out->photons + out->count++;
        memset(p, 0, sizeof *p);
        memcpy(p->position, positions + 3 * i, sizeof p->position);
        memcpy(p->normal, normals + 3 * i, sizeof p->normal);
        memcpy(p->flux, rgb + 3 * i, sizeof p->flux);
        p->shading = 1;
    }
    out->emitted = 1;
}

rt_status rt_irradiance_points_make(rt_photon_list *out, const rt_photon_map *map,
                                    rt_device *device, const rt_render_options *options,
                                    rt_error *error)
{
    const rt_photon_list *global = map->lists + RT_PHOTONS_GLOBAL;
    const uint32_t step = options->irradiance_step;
    const size_t count = (global->count + step - 1) / step;
    if (count == 0)
        return RT_OK;
    float *positions = rt_memory_alloc(device->memory, count, 9 * sizeof *positions, what, error);
    if (!positions)
        return RT_ERROR_MEMORY;
    float *normals = positions + 3 * count, *rgb = normals + 3 * count;
    choose_places(positions, normals, global, step, count);
    rt_status status =
        rt_photon_map_irradiance(rgb, map, device, positions, normals, count, options, error);
    if (status == RT_OK)
        status = rt_photon_list_reserve(out, count, error);
    if (status == RT_OK)
        append(out, positions, normals, rgb, count);
    rt_memory_free(positions);
    return status;
}
