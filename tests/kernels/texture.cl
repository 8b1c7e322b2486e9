/* texture.cl - evaluates textures at given coordinates. */
#include "entry.h"
#include "material/texture.h"

/* Somewhere on no mesh. */
static struct texture_place place_of(float2 uv)
{
    struct texture_place place;
    place.uv = uv;
    place.weights = (float2)(0.0f);
    place.shape = 0;
    place.triangle = 0u;
    return place;
}

/* One texture, whose texels the scene has, at many points. */
kernel void colours(uint count, global const rt_texture_data *texture,
                    global const rt_scene_header *header, global const float2 *uv,
                    global float4 *out)
{
    const struct scene scene = scene_open(header);
    const uint i = item_number();
    if (i >= count)
        return;
    const struct texture_place place = place_of(uv[i]);
    out[i] = (float4)(texture_value(&scene, texture, &place), 0.0f);
}

kernel void slopes(uint count, global const rt_texture_data *texture,
                   global const rt_scene_header *header, global const float2 *uv,
                   global float2 *out)
{
    const struct scene scene = scene_open(header);
    const uint i = item_number();
    if (i >= count)
        return;
    const struct texture_place place = place_of(uv[i]);
    out[i] = texture_slope(&scene, texture, &place);
}

/* A texture of a scene at points of its shape 0, a mesh: weights, and as z the triangle. */
kernel void on_mesh(uint count, global const rt_scene_header *header, uint texture,
                    global const float4 *points, global float4 *out)
{
    const struct scene scene = scene_open(header);
    const uint i = item_number();
    if (i >= count)
        return;
    struct texture_place place;
    place.weights = points[i].xy;
    place.shape = scene.shapes;
    place.triangle = (uint)points[i].z;
    place.uv = mesh_uv(&scene, place.shape, place.triangle, place.weights);
    out[i] = (float4)(texture_value(&scene, scene.textures + texture, &place), 0.0f);
}
