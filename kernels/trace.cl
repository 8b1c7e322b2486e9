/*
 * trace.cl - single rays for the public rt_trace.
 */
#define RT_LOCATE_ALL /* hits tell their u and v */
#include "entry.h"
#include "accel/traverse.h"
#if RT_WIDTH > 1
#include "accel/turns.h"
#endif
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

static rt_hit hit_of(const struct scene *scene, const struct ray *ray, const struct hit *found)
{
    struct surface surface;
    surface_at(&surface, scene, ray, found);
    rt_hit hit;
    hit.t = found->t;
    hit.u = surface.u;
    hit.v = surface.v;
    hit.prim = surface.triangle;
    vstore3(surface.normal, 0, hit.normal);
    hit.shape = surface.shape;
    return hit;
}

#if RT_WIDTH > 1
/* The nearest hits of up to RT_TRACE_RAYS rays. */
INLINE_NEVER void trace_rays(const struct scene *scene, global const rt_ray *rays, uint count,
                             global rt_hit *hits)
{
    struct ray some[RT_TRACE_RAYS];
    struct hit found[RT_TRACE_RAYS];
    uint wanted = 0u;
    for (uint i = 0u; i < count; i++) {
        some[i] = load_ray(rays + i);
        wanted |= can_follow(&some[i]) ? 1u << i : 0u;
    }
    const uint hit = closest_hits(scene, some, wanted, found);
    for (uint i = 0u; i < count; i++)
        hits[i] = hit >> i & 1u ? hit_of(scene, &some[i], &found[i]) : no_hit();
}
#endif

/* The nearest hit of each ray; at width 8 a work-item takes RT_TRACE_RAYS of them. */
KERNEL trace_closest(global const rt_scene_header *scene_data, global const rt_ray *rays,
                     uint count, global rt_hit *hits)
{
    const uint i = item_number();
#if RT_WIDTH > 1
    if (i >= (count + RT_TRACE_RAYS - 1u) / RT_TRACE_RAYS)
        return;
    const struct scene scene = scene_open(scene_data);
    const uint first = i * RT_TRACE_RAYS;
    trace_rays(&scene, rays + first, min(count - first, RT_TRACE_RAYS), hits + first);
#else
    if (i >= count)
        return;
    const struct scene scene = scene_open(scene_data);
    const struct ray ray = load_ray(rays + i);
    struct hit found;
    hits[i] = can_follow(&ray) && closest_hit(&scene, &ray, &found) ? hit_of(&scene, &ray, &found)
                                                                    : no_hit();
#endif
}

/* Whether each ray hits anything: shape 0 if so, else RT_NONE. */
KERNEL trace_any(global const rt_scene_header *scene_data, global const rt_ray *rays, uint count,
                 global rt_hit *hits)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct scene scene = scene_open(scene_data);
    const struct ray ray = load_ray(rays + i);
    rt_hit hit = no_hit();
    if (can_follow(&ray) && occluded(&scene, &ray))
        hit.shape = 0u;
    hits[i] = hit;
}
