/*
 * irradiance.c - irradiance from a photon map, by the gathering that renders use.
 *
 * What a surface of kd = pi would reflect is irradiance: fr = kd/pi = 1. So the points are gather
 * points of weight pi.
 */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "photon/gather.h"
#include "photon/map_warnings.h"
#include "photon/photon_map.h"
#include "photon/point_order.h"
#include "scene/check.h"
#include "setting/options.h"

static const float pi = 3.14159265358979323846f;

/* Of rt_photon_kind, those of photons at surfaces. */
enum { SURFACE_KINDS = RT_PHOTONS_CAUSTIC + 1 };

/* Queries under way. */
typedef struct irradiance {
    rt_device *device;
    rt_render_options options; /* complete */
    rt_photon_search search;
    cl_kernel kernel;
    rt_gatherer *gatherers[SURFACE_KINDS];
    size_t capacity;       /* points a batch */
    cl_mem points;         /* rt_gather_point [capacity] */
    rt_gather_point *host; /* the same on the host */
    uint64_t *order;       /* [2][capacity]: which position each is, and scratch memory */
} irradiance;

static rt_status make_gatherer(irradiance *a, const rt_photon_map *map, rt_photon_kind kind,
                               rt_error *error)
{
    const rt_render_options *o = &a->options;
    rt_gather_options how = {o->k,    o->radius, o->kernel, o->cone_k,
                             o->area, a->search, 0,         o->hooks};
    if (kind == RT_PHOTONS_CAUSTIC) {
        how.k = o->caustic_k;
        how.max_radius = o->caustic_radius;
        how.density = o->caustic_kernel;
    }
    if (how.k == RT_K_ALL)
        how.k = 0;
    rt_status status = rt_gatherer_create(a->gatherers + kind, a->device, a->kernel,
                                          map->lists + kind, &how, NULL, error);
    if (status == RT_OK && rt_gatherer_capacity(a->gatherers[kind]) < a->capacity)
        a->capacity = rt_gatherer_capacity(a->gatherers[kind]);
    return status;
}

static rt_status prepare(irradiance *a, const rt_photon_map *map, size_t count, rt_error *error)
{
    const size_t most = rt_gather_points_max(a->device);
    a->capacity = count < most ? count : most;
    const char *name = rt_gather_kernel_name(a->search, 0);
    rt_status status = rt_device_kernel(a->device, &a->kernel, name, name, a->options.hooks, error);
    for (int kind = 0; kind < SURFACE_KINDS && status == RT_OK; kind++)
        if (map->lists[kind].count > 0)
            status = make_gatherer(a, map, (rt_photon_kind)kind, error);
    if (status == RT_OK)
        status = rt_buffer_create(a->device, &a->points, CL_MEM_READ_WRITE,
                                  a->capacity * sizeof *a->host, NULL,
                                  "the buffer of gather points", error);
    if (status != RT_OK)
        return status;
    static const char what[] = "a batch of gather points";
    a->host = rt_memory_zeroed(a->device->memory, a->capacity, sizeof *a->host, what, error);
    if (a->host)
        a->order =
            rt_memory_alloc(a->device->memory, a->capacity, 2 * sizeof *a->order, what, error);
    return a->order ? RT_OK : RT_ERROR_MEMORY;
}

/*
 * Takes the points in the order of a curve, because points near each other find their photons in
 * the same memory.
 */
static rt_status gather_batch(irradiance *a, float *rgb, const float *positions,
                              const float *normals, size_t count, rt_error *error)
{
    rt_status status = rt_point_order(a->order, a->order + count, positions, 3 * sizeof *positions,
                                      count, a->device->threads, error);
    if (status != RT_OK)
        return status;
    for (size_t i = 0; i < count; i++) {
        rt_gather_point *p = a->host + i;
        size_t at = 3 * (a->order[i] & RT_POINT_ORDER_INDEX);
        memset(p, 0, sizeof *p);
        memcpy(p->position, positions + at, sizeof p->position);
        memcpy(p->normal, normals + at, sizeof p->normal);
        for (int c = 0; c < 3; c++)
            p->weight[c] = pi;
    }
    status = rt_buffer_write(a->device, a->points, 0, count * sizeof *a->host, a->host, error);
    for (int kind = 0; kind < SURFACE_KINDS && status == RT_OK; kind++)
        if (a->gatherers[kind])
            status = rt_gatherer_add(a->gatherers[kind], a->points, 0, count, NULL, error);
    if (status == RT_OK)
        status = rt_buffer_read(a->device, a->points, 0, count * sizeof *a->host, a->host, error);
    for (size_t i = 0; i < count && status == RT_OK; i++)
        memcpy(rgb + 3 * (a->order[i] & RT_POINT_ORDER_INDEX), a->host[i].radiance,
               sizeof a->host[i].radiance);
    return status;
}

/* What options must be to each other, once complete. */
static rt_status check_options(const rt_render_options *o, rt_error *error)
{
    int all = o->k == RT_K_ALL, all_caustic = o->caustic_k == RT_K_ALL;
    if ((all && o->radius == 0) || (all_caustic && o->caustic_radius == 0))
        return rt_fail_field(error, RT_ERROR_USAGE, "radius",
                             "to gather all photons within a radius, give the radius");
    if ((all || all_caustic) && o->gather == RT_GATHER_FLANN)
        return rt_fail_field(error, RT_ERROR_USAGE, "gather",
                             "FLANN finds the k nearest photons only; for all within a radius, "
                             "gather on the device");
    return RT_OK;
}

static rt_status check_points(const float *positions, const float *normals, size_t count,
                              rt_error *error)
{
    for (size_t i = 0; i < count; i++) {
        const float *p = positions + 3 * i, *n = normals + 3 * i;
        for (int c = 0; c < 3; c++)
            if (!(fabsf(p[c]) <= RT_COORDINATE_MAX))
                return rt_fail_field(error, RT_ERROR_USAGE, "positions",
                                     "point %zu has the coordinate %g; it must lie within %g", i,
                                     p[c], RT_COORDINATE_MAX);
        if (!rt_is_unit(n))
            return rt_fail_field(error, RT_ERROR_USAGE, "normals",
                                 "the normal (%g, %g, %g) of point %zu is not of unit length", n[0],
                                 n[1], n[2], i);
    }
    return RT_OK;
}

rt_status rt_photon_map_irradiance(float *rgb, const rt_photon_map *map, rt_device *device,
                                   const float *positions, const float *normals, size_t count,
                                   const rt_render_options *options, rt_error *error)
{
    if (rt_is_missing(map, "map", error) || rt_is_missing(device, "device", error))
        return RT_ERROR_USAGE;
    static const rt_render_options defaults;
    irradiance a = {.device = device, .options = options ? *options : defaults};

    rt_status status = rt_options_check(&a.options, error);
    rt_options_complete(&a.options);
    if (status == RT_OK)
        status = check_options(&a.options, error);
    if (status == RT_OK)
        status = check_points(positions, normals, count, error);
    if (status != RT_OK || count == 0)
        return status;
    a.search = rt_photon_search_of(&a.options);
    rt_photon_map_warn_even(map, a.options.area, a.options.hooks);
    status = prepare(&a, map, count, error);
    for (size_t done = 0, now; done < count && status == RT_OK; done += now) {
        now = count - done < a.capacity ? count - done : a.capacity;
        status =
            gather_batch(&a, rgb + 3 * done, positions + 3 * done, normals + 3 * done, now, error);
    }
    for (int kind = 0; kind < SURFACE_KINDS; kind++)
        rt_gatherer_destroy(a.gatherers[kind]);
    rt_buffer_release(a.device, a.points);
    rt_kernel_release(a.kernel);
    rt_memory_free(a.host);
    rt_memory_free(a.order);
    return status;
}
