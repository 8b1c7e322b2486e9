/*
 * wavelength.h - the wavelength of a path that meets a dispersive boundary, and what it weighs in
 * each channel.
 *
 * A channel c is a band of light, r_c(lambda) its response (responses.h), of integral 1. A
 * wavelength is drawn from the mixture of the three by the throughput beta of the path,
 *
 *   p(lambda) = sum over c of beta_c r_c(lambda) / sum over c of beta_c,   w_c = r_c(lambda) / p
 *
 * so that E[w] = 1 1 1, no weight is negative, and beta w is never larger than the sum of beta: the
 * second wavelength of a path that is red already is red, and its weight about 1.
 */
#ifndef RT_KERNELS_SAMPLE_WAVELENGTH_H
#define RT_KERNELS_SAMPLE_WAVELENGTH_H

#include "math/frame.h"
#include "sample/responses.h"
#include "types.h"

#define RESPONSE(red, green, blue) {1e-4f * red, 1e-4f * green, 1e-4f * blue, 0.0f},
constant float4 responses[RT_KNOTS] = {RT_RESPONSES(RESPONSE)};

/* The responses at a place, counted in knots. */
static inline float3 responses_at(float place)
{
    const uint i = min((uint)place, RT_KNOTS - 2u);
    return mix(responses[i].xyz, responses[i + 1u].xyz, place - (float)i);
}

/* A wavelength, micrometres, and its weight in each channel. */
struct wavelength {
    float length;
    float3 weight;
};

/*
 * Draws one for a path of throughput beta, by u in [0,1): a knot, then a place in the triangle
 * about it.
 */
static inline struct wavelength sample_wavelength(float3 beta, float u)
{
    const float3 share = beta * (1.0f / (beta.x + beta.y + beta.z));
    uint knot = 0u;
    float before = 0.0f, part = 0.0f;
    for (uint i = 1u; i < RT_KNOTS - 1u; i++) {
        const float next = dot(share, responses[i].xyz);
        if (next > 0.0f && u >= before + part) {
            before += part;
            part = next;
            knot = i;
        }
    }
    const float x = clamp((u - before) / part, 0.0f, 1.0f);
    const float off = x < 0.5f ? sqrt(2.0f * x) - 1.0f : 1.0f - sqrt(2.0f - 2.0f * x);
    const float place = (float)knot + off;
    const float3 response = responses_at(place);
    struct wavelength wavelength;
    wavelength.length = RT_FIRST_KNOT + RT_KNOT_DISTANCE * place;
    wavelength.weight = response / fmax(dot(share, response), FLT_MIN);
    return wavelength;
}

#endif
