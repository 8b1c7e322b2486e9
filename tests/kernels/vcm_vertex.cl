/* vcm_vertex.cl - scattering of a path at a vertex of mode vcm, for its test. */
#include "entry.h"
#include "sample/rng.h"
#include "vcm/vertex.h"

/* What a test wants of a surface: rows of four floats. */
struct situation {
    float4 normal, shading, wo, beta; /* wo.w: eta; beta.w: survival */
};

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
    const struct situation at = *situation;
    const struct scene scene = scene_open(header);
    struct surface surface;
    surface.position = (float3)(0.0f);
    surface.error = 0.0f;
    surface.normal = at.normal.xyz;
    surface.shading = at.shading.xyz;
    surface.shape = 0u;
    const struct boundary boundary = boundary_between(&scene, 0u, RT_NONE, RT_NONE);
    const struct vertex vertex = vertex_at(&scene, &surface, at.wo.xyz, &boundary, RT_NONE);
    const float4 u = convert_float4(pcg4d((uint4)(i, seed, 1u, 4u)) >> 8) * 0x1p-24f;
    const uint lobe = bsdf_choose(&vertex.bsdf, 1.0f, u.z);
    out[2u * i] = out[2u * i + 1u] = (float4)(0.0f, 0.0f, 0.0f, -1.0f);
    if (lobe == RT_LOBE_NONE)
        return;
    const struct event event = vertex_scatter(&scene, &vertex, lobe, u.xyw, transport);
    const struct scattering s = vertex_eval(&scene, &vertex, event.wi);
    out[2u * i] = (float4)(event.weight, (float)lobe);
    out[2u * i + 1u] = (float4)(s.value, s.pdf_w);
}
