/* light.cl - samples of lights and starts of light paths, for their test. */
#include "entry.h"
#include "light/emit_pdf.h"
#include "sample/rng.h"

static float4 numbers(uint seed, uint i)
{
    return convert_float4(pcg4d((uint4)(i, seed, 29u, 2u)) >> 8) * 0x1p-24f;
}

/*
 * Four rows an item: position and 1 / pdf_w, wi and delta, radiance and light_pdf_w at the same
 * point, of the first `told` items alone, normal and lift.
 */
kernel void sample(global const rt_scene_header *header, uint seed, uint count, uint told,
                   float4 from, global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct scene scene = scene_open(header);
    const float4 u = numbers(seed, i);
    struct light_sample made;
    made.at.position = made.at.normal = made.wi = made.radiance = (float3)(0.0f);
    made.lift = made.inv_pdf = 0.0f;
    made.delta = false;
    float again = 0.0f, pmf;
    if (!sample_light(&scene, from.xyz, u, &made))
        made.radiance = (float3)(0.0f);
    else if (i < told && made.distant && !made.delta)
        again = environment_light_pdf_w(&scene, from.xyz, made.wi);
    else if (i < told && !made.delta)
        again = light_pdf_w(&scene, scene.lights + choose_light(&scene, from.xyz, u.z, &pmf),
                            from.xyz, &made.at);
    out[4u * i] = (float4)(made.at.position, made.inv_pdf);
    out[4u * i + 1u] = (float4)(made.wi, made.delta ? 1.0f : 0.0f);
    out[4u * i + 2u] = (float4)(made.radiance, again);
    out[4u * i + 3u] = (float4)(made.at.normal, made.lift);
}

/*
 * Light sampling beside BSDF sampling, two rows an item: wi and 1 / pdf_w, 0 without a sample; the
 * environment's density there, and in a direction uniform over the sphere.
 */
kernel void compensated(global const rt_scene_header *header, uint seed, uint count, float4 from,
                        global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    rt_params params;
    params.estimator = RT_ESTIMATOR_MIS;
    const struct scene scene = scene_open_compensated(header, &params);
    const float4 u = numbers(seed, i);
    struct light_sample made;
    made.wi = sample_sphere(u.xy);
    const float anywhere = environment_light_pdf_w(&scene, from.xyz, made.wi);
    if (!sample_light(&scene, from.xyz, u, &made))
        made.inv_pdf = 0.0f;
    const float again = environment_light_pdf_w(&scene, from.xyz, made.wi);
    out[2u * i] = (float4)(made.wi, made.inv_pdf);
    out[2u * i + 1u] = (float4)(again, anywhere, 0.0f, 0.0f);
}

/* Which light the number i + 1/2 of count chooses, and with which probability. */
kernel void choose(global const rt_scene_header *header, uint count, float4 from,
                   global float2 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct scene scene = scene_open(header);
    float pmf;
    const uint light = choose_light(&scene, from.xyz, ((float)i + 0.5f) / (float)count, &pmf);
    out[i] = (float2)((float)light, pmf);
}

/* The probability of each of the first `count` lights. */
kernel void chances(global const rt_scene_header *header, float4 from, uint count,
                    global float *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct scene scene = scene_open(header);
    out[i] = light_pmf(&scene, i, from.xyz);
}

/* The density that a start has by emit_pdf.h, and by the environment's own of its direction. */
static float emission_density(const struct scene *scene, const struct emission *made)
{
    global const rt_light_data *light = scene->lights + made->light;
    const float3 w = made->direction;
    switch ((rt_light_kind)light->kind) {
    case RT_LIGHT_POINT:
    case RT_LIGHT_SPOT:
    case RT_LIGHT_TABLE:
        return emit_point_pdf_w(scene, light, w);
    case RT_LIGHT_DIRECTIONAL:
    case RT_LIGHT_BEAM:
        return emit_parallel_pdf_a(scene, light, made->at.position, w);
    case RT_LIGHT_ENVIRONMENT:
        return emit_distant_pdf_a(scene, made->at.position, w) * environment_pdf_w(scene, -w);
    case RT_LIGHT_QUAD:
    case RT_LIGHT_TRIANGLE:
    case RT_LIGHT_SPHERE:
    case RT_LIGHT_SHAPE:
        break;
    }
    return emit_area_pdf(scene, light, &made->at, dot(made->at.normal, w));
}

/*
 * Four rows an item: position and density, direction, flux and light, normal and error; all 0 where
 * nothing starts.
 */
kernel void emit(global const rt_scene_header *header, uint seed, uint count,
                 global const rt_light_share *shares, global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct scene scene = scene_open(header);
    struct emission made;
    if (!light_emit(&scene, shares, numbers(seed, 2u * i), numbers(seed, 2u * i + 1u), false,
                    &made)) {
        for (uint row = 0u; row < 4u; row++)
            out[4u * i + row] = (float4)(0.0f);
        return;
    }
    out[4u * i] = (float4)(made.at.position, emission_density(&scene, &made));
    out[4u * i + 1u] = (float4)(made.direction, 0.0f);
    out[4u * i + 2u] = (float4)(made.flux, (float)made.light);
    out[4u * i + 3u] = (float4)(made.at.normal, made.at.error);
}

/*
 * What is sampled at the edges of the one portal: the flux of light along -w that starts there,
 * by area across; and of the sky from a point, 1 / pdf_w and what comes from there.
 */
kernel void portal_edges(global const rt_scene_header *header, float4 from, float4 w, uint count,
                         global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct scene scene = scene_open(header);
    const float edge = i & 1u ? RT_BELOW_ONE : 0.0f, along = ((float)i + 0.5f) / (float)count;
    const float2 at = i & 2u ? (float2)(edge, along) : (float2)(along, edge);
    const float2 u = (float2)(RT_PORTAL_PART * at.x, at.y);
    struct emission made;
    float3 wi, radiance;
    made.flux = (float3)(1.0f);
    emit_distant(&scene, &made, w.xyz, u, false);
    const float inv_pdf = sample_through_portals(&scene, from.xyz, u, &wi, &radiance);
    out[i] = (float4)(made.flux.x / portals_across(&scene, w.xyz), inv_pdf, radiance.x, 0.0f);
}
