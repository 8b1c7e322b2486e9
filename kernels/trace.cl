/*
 * trace.cl - single rays for the public rt_trace.
 */
#include "entry.h"
#include "accel/traverse.h"
#include "types.h"

static struct ray load_ray(global const rt_ray *ray)
{
    return make_ray(vload3(0, ray->origin), vload3(0, ray->direction), ray->t_min, ray->t_max);
}

static rt_hit no_hit(void)
{
    rt_hit hit;
    hit.t = INFINITY;
    hit.u = hit.v = 0.0f;
    hit.prim = RT_NONE;
    hit.normal[0] = hit.normal[1] = hit.normal[2] = 0.0f;
    hit.shape = RT_NONE;
    return hit;
}

/* The nearest hit of each ray. */
KERNEL trace_closest(global const rt_scene_header *scene_data, global const rt_ray *rays,
                     uint count, global rt_hit *hits)
{
    const uint i = (uint)get_global_id(0);
    if (i >= count)
        return;
    const struct scene scene = scene_open(scene_data);
    const struct ray ray = load_ray(rays + i);
    struct hit found;
    rt_hit hit = no_hit();
    if (can_follow(&ray) && closest_hit(&scene, &ray, &found)) {
        struct surface surface = surface_at(&scene, &ray, &found);
        surface_uv(&surface, &scene);
        hit.t = found.t;
        hit.u = surface.u;
        hit.v = surface.v;
        hit.prim = surface.triangle;
        vstore3(surface.normal, 0, hit.normal);
        hit.shape = surface.shape;
    }
    hits[i] = hit;
}

/* Whether each ray hits anything: shape 0 if so, else RT_NONE. */
KERNEL trace_any(global const rt_scene_header *scene_data, global const rt_ray *rays, uint count,
                 global rt_hit *hits)
{
    const uint i = (uint)get_global_id(0);
    if (i >= count)
        return;
    const struct scene scene = scene_open(scene_data);
    const struct ray ray = load_ray(rays + i);
    rt_hit hit = no_hit();
    if (can_follow(&ray) && occluded(&scene, &ray))
        hit.shape = 0u;
    hits[i] = hit;
}
