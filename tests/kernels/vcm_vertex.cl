/* vcm_vertex.cl - scattering of a path at a vertex of mode vcm, for its test. */
#include "entry.h"
#include "sample/rng.h"
#include "surface/bidirectional.h"

/* What a test wants of a surface: rows of four floats. */
struct situation {
    float4 normal, shading, wo, beta; /* wo.w: eta; beta.w: survival */
};

/*
 * The vertex that a path which came along -wo has at the origin, with the normals of a situation,
 * on shape 0, between these media.
 */
static struct vertex vertex_of(const struct scene *scene, global const struct situation *situation,
                               float3 wo, uint medium, uint beyond, uint transport)
{
    struct meeting met;
    met.surface.position = (float3)(0.0f);
    met.surface.error = 0.0f;
    met.surface.normal = situation->normal.xyz;
    met.surface.shading = situation->shading.xyz;
    met.surface.shape = 0u;
    met.surface.slot = RT_SLOT_ANALYTIC;
    met.boundary = boundary_between(scene, 0u, medium, beyond);
    met.wo = wo;
    met.material = met.part = met.lobes = 0u;
    met.behind = beyond;
    struct vertex vertex;
    make_bidir_vertex(&vertex, scene, &met, medium, transport);
    return vertex;
}

/*
 * Two rows an item: weight and lobe; value of all lobes at the direction, of radiance for a given
 * survival, and their density.
 */
kernel void scatter(uint seed, uint count, global const rt_scene_header *header,
                    global const struct situation *situation, uint transport, global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct scene scene = scene_open(header);
    const struct vertex vertex =
        vertex_of(&scene, situation, situation->wo.xyz, RT_NONE, RT_NONE, transport);
    const float4 u = convert_float4(pcg4d((uint4)(i, seed, 1u, 4u)) >> 8) * 0x1p-24f;
    const uint lobe = bsdf_choose(&vertex.bsdf, 1.0f, u.z);
    out[2u * i] = out[2u * i + 1u] = (float4)(0.0f, 0.0f, 0.0f, -1.0f);
    if (lobe == RT_LOBE_NONE)
        return;
    const struct bidir_event event = bidir_scatter(&scene, &vertex, lobe, u.xyw);
    const struct scattering s = bidir_eval(&scene, &vertex, event.wi);
    out[2u * i] = (float4)(event.weight, (float)lobe);
    out[2u * i + 1u] = (float4)(s.value, s.pdf_w);
}

/*
 * Three rows an item, for random directions c and l at a vertex where light comes from l and leaves
 * to c: what a camera path has per projected solid angle, and its density of l; the same of a light
 * path, and its density of c; the densities of the other path, as each of the two has them, and the
 * cosines of c and l. Outside of the solid is nothing.
 */
kernel void both_ways(uint seed, uint count, global const rt_scene_header *header,
                      global const struct situation *situation, uint unused, global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct scene scene = scene_open(header);
    const float4 u = convert_float4(pcg4d((uint4)(i, seed, 1u, 14u)) >> 8) * 0x1p-24f;
    const float2 z = 2.0f * u.xz - 1.0f, r = sqrt(1.0f - z * z), turn = 2.0f * RT_PI * u.yw;
    const float3 c = (float3)(r.x * cos(turn.x), r.x * sin(turn.x), z.x),
                 l = (float3)(r.y * cos(turn.y), r.y * sin(turn.y), z.y);
    const bool is_solid = is_transparent(scene.materials);
    const uint inside = is_solid ? 0u : RT_NONE;
    const uint at_c = c.z < 0.0f ? inside : RT_NONE, at_l = l.z < 0.0f ? inside : RT_NONE;
    const uint beyond_c = c.z < 0.0f ? RT_NONE : inside, beyond_l = l.z < 0.0f ? RT_NONE : inside;
    const struct vertex camera = vertex_of(&scene, situation, c, at_c, beyond_c, CARRY_RADIANCE),
                        light = vertex_of(&scene, situation, l, at_l, beyond_l, CARRY_FLUX);
    const struct scattering radiance = bidir_eval(&scene, &camera, l),
                            flux = bidir_eval(&scene, &light, c);
    out[3u * i] = (float4)(radiance.value / fabs(z.y), radiance.pdf_w);
    out[3u * i + 1u] = (float4)(flux.value / fabs(z.x), flux.pdf_w);
    out[3u * i + 2u] = (float4)(radiance.back_pdf_w, flux.back_pdf_w, z);
}

/*
 * Two rows an item, for a random c above a surface without refraction: the delta event of a camera
 * path from c, and the ratio of its density on the way back, by a light path, to that on the way;
 * the same of a light path from there, with w 0 where it goes elsewhere. w -1: no event.
 */
kernel void delta_ratios(uint seed, uint count, global const rt_scene_header *header,
                         global const struct situation *situation, uint unused, global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct scene scene = scene_open(header);
    const float4 u = convert_float4(pcg4d((uint4)(i, seed, 3u, 15u)) >> 8) * 0x1p-24f;
    const float3 c = sample_cosine(u.xy);
    const struct vertex camera = vertex_of(&scene, situation, c, RT_NONE, RT_NONE, CARRY_RADIANCE);
    const struct bidir_event event =
        bidir_scatter(&scene, &camera, RT_LOBE_SPECULAR_REFLECTION, (float3)(u.z, 0.0f, 0.0f));
    out[2u * i] = out[2u * i + 1u] = (float4)(0.0f, 0.0f, 0.0f, -1.0f);
    if (!(largest3(event.weight) > 0.0f))
        return;
    const struct vertex light =
        vertex_of(&scene, situation, event.wi, RT_NONE, RT_NONE, CARRY_FLUX);
    out[2u * i] = (float4)(event.wi, event.back_pdf_w);
    out[2u * i + 1u] = (float4)(c, delta_ratio(&scene, &light, RT_LOBE_SPECULAR_REFLECTION, c));
}
