/* ggx.cl - the lobes of one rough boundary and the reflectance of metals, for their tests. */
#include "entry.h"
#include "sample/rng.h"
#include "bsdf/ggx.h"

/* A boundary: ks, kt, alpha and eta; of anisotropic facets the material has alpha_v. */
static struct specular boundary_of(global const rt_material_data *material, float4 numbers)
{
    struct specular specular;
    specular.ks = (float3)(numbers.x);
    specular.kt = (float3)(numbers.y);
    specular.alpha = numbers.z;
    specular.alpha_v = material->roughness_v;
    specular.tangent = (float3)(material->facet_turn[0], material->facet_turn[1], 0.0f);
    specular.normal = (float3)(0.0f, 0.0f, 1.0f);
    specular.eta = numbers.w;
    specular.fresnel = (material->flags & RT_MATERIAL_FRESNEL) != 0u;
    specular.material = material;
    return specular;
}

/* Three rows an item: wi and the density sampled, weight, light and density by evaluation at wi. */
kernel void sample_ggx(uint seed, uint count, global const rt_material_data *material,
                       const float4 numbers, const float4 wo, global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct specular specular = boundary_of(material, numbers);
    const float4 u = convert_float4(pcg4d((uint4)(i, seed, 7u, 2u)) >> 8) * 0x1p-24f;
    float3 wi;
    float pdf_w;
    const float3 weight = facets_sample(&specular, wo.xyz, u.xyz, &wi, &pdf_w);
    const struct facets_value facets = facets_eval(&specular, wo.xyz, wi);
    out[3u * i] = (float4)(wi, pdf_w);
    out[3u * i + 1u] = (float4)(weight, 0.0f);
    out[3u * i + 2u] = (float4)(facets.value, facets.pdf_w);
}

/* The weight of a direction sampled, an item, by points that are even in the cube. */
kernel void weigh_ggx(uint count, global const rt_material_data *material, const float4 numbers,
                      const float4 wo, global float *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct specular specular = boundary_of(material, numbers);
    const uint4 point = (uint4)(3518319155u, 2882110345u, 2360945575u, 0u) * i + (1u << 31);
    const float4 u = convert_float4(point >> 8) * 0x1p-24f;
    float3 wi;
    float pdf_w;
    out[i] = facets_sample(&specular, wo.xyz, u.xyz, &wi, &pdf_w).x;
}

/* A row an item: light from directions[i] to wo, with its density. */
kernel void evaluate_ggx(uint count, global const rt_material_data *material, const float4 numbers,
                         const float4 wo, global const float4 *directions, global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct specular specular = boundary_of(material, numbers);
    const struct facets_value facets = facets_eval(&specular, wo.xyz, directions[i].xyz);
    out[i] = (float4)(facets.value, facets.pdf_w);
}

/*
 * The same with the directions exchanged, seen from the side of what was wi; the density is that of
 * directions[i] still, on the way back.
 */
kernel void evaluate_back(uint count, global const rt_material_data *material, const float4 numbers,
                          const float4 wo, global const float4 *directions, global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const float3 wi = directions[i].xyz;
    const float side = wi.z < 0.0f ? -1.0f : 1.0f;
    struct specular specular = boundary_of(material, numbers);
    if (side < 0.0f)
        specular.eta = 1.0f / specular.eta;
    const struct facets_value facets = facets_eval(&specular, side * wi, side * wo.xyz);
    out[i] = (float4)(facets.value, facets.back_pdf_w);
}

/* Reflectance of a metal at each cosine. */
kernel void reflect_metal(uint count, global const rt_material_data *material,
                          global const float *cosine, global float4 *out)
{
    const uint i = item_number();
    if (i < count)
        out[i] = (float4)(reflected_in(material, row3(material->ks), cosine[i], 1.0f), 0.0f);
}

/* A normal of a facet that wo sees, an item. */
kernel void visible_normals(uint seed, uint count, global const rt_material_data *material,
                            const float4 numbers, const float4 wo, global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const float4 u = convert_float4(pcg4d((uint4)(i, seed, 7u, 2u)) >> 8) * 0x1p-24f;
    const struct specular specular = boundary_of(material, numbers);
    out[i] = (float4)(sample_facet(&specular, wo.xyz, u.xy), 0.0f);
}
