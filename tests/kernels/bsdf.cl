/* bsdf.cl - scattering of one surface, for its test. */
#include "bsdf.h"
#include "medium.h"
#include "rng.h"

/* What a test wants of a surface: rows of four floats. */
struct situation {
    float4 normal, shading, wo, beta; /* wo.w: eta; beta.w: survival */
};

static struct bsdf situated(global const rt_material_data *material, const struct situation *at)
{
    struct surface surface;
    surface.normal = at->normal.xyz;
    surface.shading = at->shading.xyz;
    return bsdf_at(material, &surface, at->wo.xyz, at->wo.w, at->beta.xyz);
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

/* Four rows an item: wi and event, weight over survival and squeeze, eval at wi and pdf_w, and what was sampled. */
kernel void scatter(uint count, global const rt_material_data *material, global const struct situation *situation,
                    uint transport, global float4 *out)
{
    const uint i = (uint)get_global_id(0);
    if (i >= count)
        return;
    const struct situation at = *situation;
    const struct bsdf bsdf = situated(material, &at);
    const float4 u = convert_float4(pcg4d((uint4)(i, 3u, 1u, 4u)) >> 8) * 0x1p-24f;
    const uint event = bsdf_choose(&bsdf, at.beta.w, u.z);
    struct scatter made;
    made.wi = bsdf.normal;
    made.weight = (float3)(0.0f);
    made.squeeze = 1.0f;
    made.pdf_w = 0.0f;
    if (event != EVENT_ABSORBED)
        made = bsdf_scatter(&bsdf, event, u.xy, transport);
    out[4u * i] = (float4)(made.wi, (float)event);
    out[4u * i + 1u] = (float4)(made.weight / at.beta.w, made.squeeze);
    out[4u * i + 2u] = (float4)(bsdf_eval(&bsdf, made.wi), bsdf_pdf_w(&bsdf, made.wi));
    out[4u * i + 3u] = (float4)(bsdf_albedo(&bsdf), made.pdf_w);
}

/* Crosses boundaries in turn: in: material and 1 for entering; out: eta, exists, and the medium after. */
kernel void cross_boundaries(global const rt_scene_header *header, uint count, global const uint2 *in, global float4 *out)
{
    if (get_global_id(0) != 0)
        return;
    const struct scene scene = scene_open(header);
    uint4 media = RT_VACUUM;
    for (uint i = 0; i < count; i++) {
        const struct boundary boundary = media_cross(&scene, media, in[i].x, in[i].y != 0u);
        media = boundary.beyond;
        out[i] = (float4)(boundary.eta, boundary.exists ? 1.0f : 0.0f, media.x == RT_NONE ? -1.0f : (float)media.x, 0.0f);
    }
}
