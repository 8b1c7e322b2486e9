/* vcm_store.cl - what the store of light vertices packs, unpacked again, for its test. */
#include "entry.h"
#include "accel/traverse.h"
#include "vcm/store.h"

/*
 * Three rows an item: direction 2 i and 2 i + 1 as the normal and wo of a vertex have them; 2 i as
 * its other direction, beside other words. The vertex is stores [i].
 */
kernel void directions(uint count, global const float4 *in, global rt_light_vertex *stores,
                       global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    float3 wo;
    const float3 normal = in[2u * i].xyz;
    vstore3(join24((uint4)(pack_direction(normal), pack_direction(in[2u * i + 1u].xyz))), 0,
            stores[i].normal_wo);
    out[3u * i].xyz = stored_normal(stores + i, &wo);
    out[3u * i + 1u].xyz = wo;
    const uint4 words =
        split24(join24((uint4)(i * 77u & 0xffffffu, pack_direction(normal), 0xffffffu - i)));
    out[3u * i + 2u] = (float4)(unpack_direction(words.yz),
                                words.x == (i * 77u & 0xffffffu) && words.w == 0xffffffu - i);
}

/* Four rows an item: in[i], as flux; of its x in 24 bits; rounded up in 12; a number of media. */
kernel void numbers(uint count, global const float4 *in, global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const float x = in[i].x;
    out[4u * i].xyz = unpack_flux(pack_flux(in[i].xyz));
    out[4u * i + 1u].x = of_upper_bits(upper_bits(x, 24u), 24u);
    out[4u * i + 2u].x = of_upper_bits(upper_bits_above(x, 12u), 12u);
    const uint medium = i == 0u ? RT_NONE : i * 15u;
    out[4u * i + 3u].x = medium_of(stored_medium(medium) | i << 20) == medium;
}

/*
 * The vertex where a ray, from in[2 i] along in[2 i + 1], meets the scene, and the same from the
 * store; false where it meets nothing.
 */
static bool meet_and_store(const struct scene *scene, uint i, global const float4 *in,
                           global rt_light_vertex *stores, struct vertex *vertex,
                           struct vertex *stored)
{
    const float3 w = in[2u * i + 1u].xyz;
    const struct ray ray = make_ray(in[2u * i].xyz, w, 0.0f, INFINITY);
    struct hit hit;
    if (!closest_hit(scene, &ray, &hit))
        return false;
    struct meeting met;
    meet_surface(&met, scene, &ray, &hit, RT_VACUUM);
    make_bidir_vertex(vertex, scene, &met, RT_NONE, CARRY_FLUX);
    const struct partial_weights partial = {1.0f, 1.0f};
    store_vertex(stores + i, scene, vertex, &met.surface, (float3)(1.0f), &partial, 1u);
    load_vertex(stored, scene, stores + i);
    return true;
}

/* Four rows an item: kd and the shading normal of both vertices; all 0 where there are none. */
kernel void colours(uint count, global const rt_scene_header *header, global const float4 *in,
                    global rt_light_vertex *stores, global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct scene scene = scene_open(header);
    struct vertex vertex, stored;
    for (uint k = 0u; k < 4u; k++)
        out[4u * i + k] = (float4)(0.0f);
    if (!meet_and_store(&scene, i, in, stores, &vertex, &stored))
        return;
    out[4u * i] = (float4)(vertex.params.kd, 1.0f);
    out[4u * i + 1u] = (float4)(vertex.params.shading, 0.0f);
    out[4u * i + 2u].xyz = stored.params.kd;
    out[4u * i + 3u].xyz = stored.params.shading;
}

/* Four rows an item likewise: the tangent with alpha along and across it, and the colour. */
kernel void tangents(uint count, global const rt_scene_header *header, global const float4 *in,
                     global rt_light_vertex *stores, global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct scene scene = scene_open(header);
    struct vertex vertex, stored;
    for (uint k = 0u; k < 4u; k++)
        out[4u * i + k] = (float4)(0.0f);
    if (!meet_and_store(&scene, i, in, stores, &vertex, &stored))
        return;
    out[4u * i] = (float4)(vertex.bsdf.specular.tangent, vertex.bsdf.specular.alpha);
    out[4u * i + 1u] = (float4)(vertex.params.ks, vertex.bsdf.specular.alpha_v);
    out[4u * i + 2u] = (float4)(stored.bsdf.specular.tangent, stored.bsdf.specular.alpha);
    out[4u * i + 3u] = (float4)(stored.params.ks, stored.bsdf.specular.alpha_v);
}
