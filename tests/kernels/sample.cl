/* sample.cl - the sampling routines over independent numbers, for their test. */
#include "entry.h"
#include "sample/rng.h"
#include "sample/sample.h"

/* Two independent numbers for item i. */
static float2 pair(uint seed, uint i)
{
    return convert_float2(pcg4d((uint4)(i, seed, 17u, 5u)).xy >> 8) * 0x1p-24f;
}

kernel void disc(uint seed, uint count, global float4 *out)
{
    const uint i = item_number();
    if (i < count)
        out[i] = (float4)(sample_disc(pair(seed, i)), 0.0f, disc_pdf_a());
}

kernel void cosine(uint seed, uint count, global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const float3 w = sample_cosine(pair(seed, i));
    out[i] = (float4)(w, cosine_pdf_w(w.z));
}

kernel void sphere(uint seed, uint count, global float4 *out)
{
    const uint i = item_number();
    if (i < count)
        out[i] = (float4)(sample_sphere(pair(seed, i)), sphere_pdf_w());
}

kernel void triangle(uint seed, uint count, global float4 *out)
{
    const uint i = item_number();
    if (i < count)
        out[i] = (float4)(sample_triangle(pair(seed, i)), 0.0f,
                          triangle_pdf_a((float3)(2.0f, 0.0f, 0.0f), (float3)(1.0f, 0.0f, 3.0f)));
}

/* shape: x0, y0, width, height. */
kernel void rectangle(uint seed, uint count, float4 shape, float z, global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct seen_rectangle seen = see_rectangle(shape.x, shape.y, z, shape.z, shape.w);
    out[i] = (float4)(sample_seen_rectangle(&seen, pair(seed, i)), seen.solid_angle,
                      seen_rectangle_pdf_w(&seen));
}

kernel void cap(uint seed, uint count, float radius, float distance2, global float4 *out)
{
    const uint i = item_number();
    if (i < count)
        out[i] =
            (float4)(sample_cap(radius, distance2, pair(seed, i)), cap_pdf_w(radius, distance2));
}

/* sin, cos and atan of y / x for each (x, y). */
kernel void functions(uint count, global const float2 *in, global float4 *out)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const float angle = atan_ratio((float4)(in[i].y), (float4)(in[i].x)).x;
    out[i] = (float4)(sin_cos(in[i].y), angle, 0.0f);
}

kernel void polygon(uint seed, uint count, uint corners, float turn, global float4 *out)
{
    const uint i = item_number();
    if (i < count)
        out[i] = (float4)(sample_polygon(corners, turn, pair(seed, i)), 0.0f, 0.0f);
}
