/* shape_sample.cl - points of a scene's first shape, for their test. */
#define RT_LOCATE_ALL
#include "entry.h"
#include "shape/shapes.h"

/*
 * For each of u: position and pdf_a, normal and the pdf_a asked for afterwards, and the surface's u
 * and v.
 */
kernel void sample_points(global const rt_scene_header *header, global const float2 *u, uint count,
                          global float4 *positions, global float4 *normals,
                          global float2 *parameters)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct scene scene = scene_open(header);
    struct surface at;
    const float pdf_a = shape_point(&scene, 0u, u[i], &at);
    positions[i] = (float4)(at.position, pdf_a);
    normals[i] = (float4)(at.normal, shape_pdf_a(&scene, &at));
    parameters[i] = (float2)(at.u, at.v);
}
