/* bsdf.cl - scattering of one surface, for its test. */
#include "bsdf.h"
#include "rng.h"

/* What a test wants of a surface: rows of four floats. */
struct situation {
    float4 normal, shading, wo, beta; /* wo.w: eta; beta.w: survival */
};

/* A surface of the first shape and the first material. */
static struct bsdf situated(global const rt_scene_header *header, const struct situation *at)
{
    const struct scene scene = scene_open(header);
    struct surface surface;
    surface.normal = at->normal.xyz;
    surface.shading = at->shading.xyz;
    surface.shape = 0u;
    return bsdf_at(&scene, scene.materials, &surface, at->wo.xyz, at->wo.w, at->beta.xyz);
}

/* Reflectance and cosine beyond, for each (cosine, eta). */
kernel void reflectance(uint count, global const float2 *in, global float2 *out)
{
    const uint i = (uint)get_global_id(0);
    if (i >= count)
        return;
    float cos_t;
    const float r = fresnel(in[i].x, in[i].y, &cos_t);
    out[i] = (float2)(r, cos_t);
}

/*
 * Four rows an item: wi and event, weight over survival and squeeze, light and density of the event's lobe at wi, and
 * albedo with the density that was sampled.
 */
kernel void scatter(uint count, global const rt_scene_header *header, global const struct situation *situation,
                    uint transport, global float4 *out)
{
    const uint i = (uint)get_global_id(0);
    if (i >= count)
        return;
    const struct situation at = *situation;
    const struct bsdf bsdf = situated(header, &at);
    const float4 u = convert_float4(pcg4d((uint4)(i, 3u, 1u, 4u)) >> 8) * 0x1p-24f;
    const uint event = bsdf_choose(&bsdf, at.beta.w, u.z);
    struct scatter made;
    made.wi = bsdf.normal;
    made.weight = (float3)(0.0f);
    made.squeeze = 1.0f;
    made.pdf_w = 0.0f;
    made.through = false;
    if (event != EVENT_ABSORBED)
        made = bsdf_scatter(&bsdf, event, u.xyw, transport);
    out[4u * i] = (float4)(made.wi, (float)event);
    out[4u * i + 1u] = (float4)(made.weight / at.beta.w, made.squeeze);
    const struct lobe lobe = event == EVENT_ROUGH ? bsdf_rough(&bsdf, made.wi) : bsdf_diffuse(&bsdf, made.wi);
    out[4u * i + 2u] = (float4)(lobe.value, lobe.pdf_w);
    out[4u * i + 3u] = (float4)(bsdf_albedo(&bsdf), made.pdf_w);
}
