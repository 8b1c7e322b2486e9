#include "photon/photon_map.h"

#include <math.h>
#include <stdlib.h>

#include "error.h"

static rt_status reserve(rt_photon_map *map, size_t more, rt_error *error)
{
    size_t needed = map->count + more;
    if (needed <= map->capacity)
        return RT_OK;
    size_t capacity = map->capacity + map->capacity / 2 > needed ? map->capacity + map->capacity / 2 : needed;
    rt_photon *photons = capacity <= SIZE_MAX / sizeof *photons ? realloc(map->photons, capacity * sizeof *photons) : NULL;
    if (!photons)
        return rt_fail(error, RT_ERROR_MEMORY, "no memory for a map of %zu photons", needed);
    map->photons = photons;
    map->capacity = capacity;
    return RT_OK;
}

static int finite3(const float v[3])
{
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

static int finite_photon(const rt_photon *p)
{
    return finite3(p->position) && finite3(p->wi) && finite3(p->flux) && isfinite(p->shading) &&
           finite3(p->normal);
}

rt_status rt_photon_map_append(rt_photon_map *map, const rt_photon *slots, const rt_u32 *counts, size_t path_count,
                               size_t slots_per_path, rt_error *error)
{
    size_t more = 0;
    for (size_t i = 0; i < path_count; i++)
        more += counts[i];
    rt_status status = reserve(map, more, error);
    if (status != RT_OK)
        return status;
    for (size_t i = 0; i < path_count; i++)
        for (size_t j = 0; j < counts[i]; j++) {
            const rt_photon *photon = slots + i * slots_per_path + j;
            if (finite_photon(photon))
                map->photons[map->count++] = *photon;
            else
                map->rejected++;
        }
    map->emitted += path_count;
    return RT_OK;
}

void rt_photon_map_clear(rt_photon_map *map)
{
    free(map->photons);
    *map = (rt_photon_map){0};
}
