/* bsdf.cl - scattering of one surface, for its test. */
#include "entry.h"
#include "bsdf/bsdf.h"
#include "sample/rng.h"

/* What a test wants of a surface: rows of four floats. */
struct situation {
    float4 normal, shading, wo, beta; /* wo.w: eta; beta.w: survival */
};

/* A surface of the first shape and the first material. */
static struct bsdf situated(global const rt_scene_header *header, const struct situation *at,
                            uint transport)
{
    const struct scene scene = scene_open(header);
    struct surface surface;
    surface.normal = at->normal.xyz;
    surface.shading = at->shading.xyz;
    surface.shape = 0u;
    surface.slot = RT_SLOT_ANALYTIC;
    struct boundary boundary;
    boundary.eta = at->wo.w;
    boundary.beyond = at->wo.w > 1.0f ? RT_VACUUM : (uint4)(0u, RT_NONE, RT_NONE, RT_NONE);
    boundary.fresnel = (scene.materials->flags & RT_MATERIAL_FRESNEL) != 0u;
    return bsdf_at(&scene, scene.materials, &surface, at->wo.xyz, &boundary, at->beta.xyz,
                   transport);
}

/* Reflectance and cosine beyond, for each (cosine, eta). */
kernel void reflectance(uint count, global const float2 *in, global float2 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    float cos_t;
    const float r = fresnel(in[i].x, in[i].y, &cos_t);
    out[i] = (float2)(r, cos_t);
}

/* Rough lobes are one event, whichever of them it is. */
static uint event_of(uint lobe)
{
    return lobe == RT_LOBE_PHONG || lobe == RT_LOBE_LACQUER ? RT_LOBE_GGX : lobe;
}

/*
 * Four rows an item: wi and event, weight over survival and eta_scale, light and density of the
 * event's lobe at wi, and albedo with the density that was sampled.
 */
kernel void scatter(uint seed, uint count, global const rt_scene_header *header,
                    global const struct situation *situation, uint transport, global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct situation at = *situation;
    const struct bsdf bsdf = situated(header, &at, transport);
    const float4 u = convert_float4(pcg4d((uint4)(i, seed, 1u, 4u)) >> 8) * 0x1p-24f;
    const uint event = bsdf_choose(&bsdf, at.beta.w, u.z);
    struct scatter made;
    made.wi = bsdf.normal;
    made.weight = (float3)(0.0f);
    made.eta_scale = 1.0f;
    made.pdf_w = 0.0f;
    made.through = false;
    if (event != RT_LOBE_NONE)
        made = bsdf_scatter(&bsdf, event, u.xyw);
    out[4u * i] = (float4)(made.wi, (float)event_of(event));
    out[4u * i + 1u] = (float4)(made.weight / at.beta.w, made.eta_scale);
    const struct lobe_value lobe = event_of(event) == RT_LOBE_GGX ? bsdf_eval(&bsdf, 1u, made.wi)
                                                                  : bsdf_eval(&bsdf, 0u, made.wi);
    out[4u * i + 2u] = (float4)(lobe.value, lobe.pdf_w);
    out[4u * i + 3u] = (float4)(bsdf_albedo(&bsdf), made.pdf_w);
}

/*
 * Four rows an item, of one lobe by itself: wi and its density, weight and side, light and density
 * evaluated at wi, albedo and density alone.
 */
kernel void sample_lobe(uint seed, uint count, global const rt_scene_header *header,
                        global const struct situation *situation, uint lobe, global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct situation at = *situation;
    const struct bsdf bsdf = situated(header, &at, CARRY_RADIANCE);
    const float4 u = convert_float4(pcg4d((uint4)(i, seed, 1u, 9u)) >> 8) * 0x1p-24f;
    const struct lobe_sample made = lobe_sample(&bsdf, lobe, u.xyz);
    const struct lobe_value value = lobe_eval(&bsdf, lobe, made.wi);
    out[4u * i] = (float4)(made.wi, made.pdf_w);
    out[4u * i + 1u] = (float4)(made.weight, made.through ? 1.0f : 0.0f);
    out[4u * i + 2u] = (float4)(value.value, value.pdf_w);
    out[4u * i + 3u] = (float4)(lobe_albedo(&bsdf, lobe), lobe_pdf_w(&bsdf, lobe, made.wi));
}

/* A row an item: light and density of one lobe by itself, in situations[i] at wi[i]. */
kernel void evaluate_lobe(uint count, global const rt_scene_header *header,
                          global const struct situation *situations, global const float4 *wi,
                          uint lobe, global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct situation at = situations[i];
    const struct bsdf bsdf = situated(header, &at, CARRY_RADIANCE);
    const struct lobe_value value = lobe_eval(&bsdf, lobe, wi[i].xyz);
    out[i] = (float4)(value.value, value.pdf_w);
}

/* Two rows for each of `count` events, `each` of them to an item: wi and its density, the event. */
kernel void events(uint seed, uint count, uint each, global const rt_scene_header *header,
                   global const struct situation *situation, global float4 *out)
{
    const uint first = item_number() * each;
    const struct situation at = *situation;
    const struct bsdf bsdf = situated(header, &at, CARRY_RADIANCE);
    for (uint i = first; i < min(first + each, count); i++) {
        const float4 u = convert_float4(pcg4d((uint4)(i, seed, 1u, 5u)) >> 8) * 0x1p-24f;
        const uint event = bsdf_choose(&bsdf, at.beta.w, u.z);
        struct scatter made;
        made.wi = bsdf.normal;
        made.pdf_w = 0.0f;
        if (event != RT_LOBE_NONE)
            made = bsdf_scatter(&bsdf, event, u.xyw);
        out[2u * i] = (float4)(made.wi, made.pdf_w);
        out[2u * i + 1u] = (float4)((float)event_of(event), 0.0f, 0.0f, 0.0f);
    }
}

/*
 * Two rows an item: light and density of diffuse, and of rough events, in situations[i] at wi[i].
 */
kernel void evaluate(uint count, global const rt_scene_header *header,
                     global const struct situation *situations, global const float4 *wi,
                     global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct situation at = situations[i];
    const struct bsdf bsdf = situated(header, &at, CARRY_RADIANCE);
    const struct lobe_value smooth = bsdf_eval(&bsdf, 0u, wi[i].xyz);
    const struct lobe_value rough =
        bsdf_is_rough(&bsdf) ? bsdf_eval(&bsdf, 1u, wi[i].xyz) : no_light();
    out[2u * i] = (float4)(smooth.value, smooth.pdf_w);
    out[2u * i + 1u] = (float4)(rough.value, rough.pdf_w);
}

/*
 * Two rows an item, for situations[i]: mean and mean square of the part of the light that a sample
 * keeps, with the largest part of all samples.
 */
kernel void albedo(uint seed, uint count, global const rt_scene_header *header,
                   global const struct situation *situations, uint samples, global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct situation at = situations[i];
    const struct bsdf bsdf = situated(header, &at, CARRY_FLUX);
    float3 sum = (float3)(0.0f), squares = (float3)(0.0f);
    float most = 0.0f;
    for (uint k = 0u; k < samples; k++) {
        const float4 u = convert_float4(pcg4d((uint4)(i, k, 8u, 6u + seed)) >> 8) * 0x1p-24f;
        const uint event = bsdf_choose(&bsdf, at.beta.w, u.z);
        if (event == RT_LOBE_NONE)
            continue;
        const float3 kept = bsdf_scatter(&bsdf, event, u.xyw).weight;
        sum += kept;
        squares += kept * kept;
        most = max(most, largest3(kept));
    }
    out[2u * i] = (float4)(sum / (float)samples, most);
    out[2u * i + 1u] = (float4)(squares / (float)samples, 0.0f);
}

/*
 * Two rows an item: wo, uniform over the sphere, and the weight of the event, with wo by the
 * projected solid angle about the geometric normal, which is +z; wi, and how far the weight
 * is from what the event's lobe is worth there over its density. wo.w of *situation: index above
 * the surface over that below.
 */
kernel void exchange(uint seed, uint count, global const rt_scene_header *header,
                     global const struct situation *situation, uint transport, global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const float4 u = convert_float4(pcg4d((uint4)(i, seed, 1u, 12u)) >> 8) * 0x1p-24f;
    const float4 v = convert_float4(pcg4d((uint4)(i, seed, 2u, 13u)) >> 8) * 0x1p-24f;
    const float z = 2.0f * v.x - 1.0f, angle = 2.0f * RT_PI * v.y;
    const float3 wo = (float3)(sqrt(1.0f - z * z) * (float2)(cos(angle), sin(angle)), z);
    struct situation at = *situation;
    at.wo = (float4)(wo, z < 0.0f ? 1.0f / at.wo.w : at.wo.w);
    const struct bsdf bsdf = situated(header, &at, transport);
    const uint lobe = bsdf_choose(&bsdf, 1.0f, u.z);
    out[2u * i] = (float4)(wo, 0.0f);
    out[2u * i + 1u] = (float4)(wo, 0.0f);
    if (lobe == RT_LOBE_NONE)
        return;
    const struct scatter made = bsdf_scatter(&bsdf, lobe, u.xyw);
    const struct lobe_value value =
        lobe_is_rough(lobe) ? bsdf_eval(&bsdf, 1u, made.wi) : bsdf_eval(&bsdf, 0u, made.wi);
    const bool evaluated = made.weight.x > 1e-12f && made.pdf_w > 1e-3f;
    /* Of radiance, also of a symmetric BSDF for flux, eval holds the scale at refraction. */
    const float scale = made.through && !is_adjoint(&bsdf) ? square(bsdf.specular.eta) : 1.0f;
    out[2u * i].w = 2.0f * fabs(z) * made.weight.x * made.eta_scale;
    out[2u * i + 1u] =
        (float4)(made.wi,
                 evaluated ? value.value.x / (scale * made.weight.x * value.pdf_w) - 1.0f : 0.0f);
}
