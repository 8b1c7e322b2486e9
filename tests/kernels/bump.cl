/* bump.cl - tangents and bumped normals of surfaces, for their test. */
#include "entry.h"
#include "material/material.h"
#include "accel/traverse.h"

/*
 * Five rows an item: position and u, normal and v, derivatives by u and v, and the bumped normal;
 * the first w is -1 where nothing is hit.
 */
kernel void follow_parameters(uint count, global const rt_scene_header *header,
                              global const rt_ray *rays, global float8 *out, global float4 *bumped)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct scene scene = scene_open(header);
    const struct ray ray =
        make_ray(vload3(0, rays[i].origin), vload3(0, rays[i].direction), 0.0f, INFINITY);
    struct hit hit;
    out[2u * i] = (float8)(-1.0f);
    if (!closest_hit(&scene, &ray, &hit))
        return;
    struct surface surface;
    surface_at(&surface, &scene, &ray, &hit);
    const struct tangents along = tangents_at(&scene, &surface);
    struct bsdf_params params;
    evaluate_material(&params, &scene, scene.materials + scene.shapes[surface.shape].material,
                      &surface);
    out[2u * i] = (float8)(surface.position, surface.u, surface.normal, surface.v);
    out[2u * i + 1u] = (float8)(along.u, 0.0f, along.v, 0.0f);
    bumped[i] = (float4)(params.shading, 0.0f);
}
