/* vcm.cl - the weights of all techniques for paths of light, by the recursion of vcm/weights.h. */
#include "entry.h"
#include "vcm/weights.h"

/*
 * A path of light from the camera, vertex 0, to a light, vertex `length`. Vertex i is joined with i
 * + 1 by segment i + 1.
 */
struct light_of_path {
    uint length;
    uint delta;                /* a bit for each vertex */
    float camera, emit, light; /* densities of the camera, of emission and of light sampling */
    float reserved[3];
    float distance[8];               /* of segment i */
    float near_cosine[8];            /* at vertex i, on the side of the camera, */
    float far_cosine[8];             /* and of the light */
    float to_light[8], to_camera[8]; /* densities at vertex i; at delta vertices probabilities */
};

static bool is_delta(global const struct light_of_path *p, uint i)
{
    return p->delta >> i & 1u;
}

/* The partial weights of the light path at its vertices, those of the camera path. */
static void light_partials(global const struct light_of_path *p,
                           const struct technique_weights *all, struct partial_weights *at)
{
    const uint first = p->length - 1u;
    const float emitted = p->emit * p->far_cosine[first], c = p->near_cosine[p->length];
    at[first] = begin_light_weights(all, p->light * c / emitted, c / emitted);
    for (uint i = first; i > 1u; i--) {
        struct partial_weights w = at[i];
        const float used = used_dVCM(all, &w, i == first, RT_TECHNIQUE_NEE);
        if (is_delta(p, i))
            scatter_delta_weights(&w, p->far_cosine[i], p->to_light[i] / p->to_camera[i]);
        else
            scatter_weights(&w, all, used, p->near_cosine[i], p->to_camera[i], p->to_light[i]);
        arrive_weights(&w, all, p->distance[i], p->far_cosine[i - 1u]);
        at[i - 1u] = w;
    }
}

static void camera_partials(global const struct light_of_path *p,
                            const struct technique_weights *all, struct partial_weights *at)
{
    at[1] = begin_camera_weights(all, p->camera * p->near_cosine[1]);
    for (uint i = 1u; i < p->length; i++) {
        struct partial_weights w = at[i];
        const float used = used_dVCM(all, &w, i == 1u, RT_TECHNIQUE_CAMERA);
        if (is_delta(p, i))
            scatter_delta_weights(&w, p->near_cosine[i], p->to_camera[i] / p->to_light[i]);
        else
            scatter_weights(&w, all, used, p->far_cosine[i], p->to_light[i], p->to_camera[i]);
        arrive_weights(&w, all, p->distance[i + 1u], p->near_cosine[i + 1u]);
        at[i + 1u] = w;
    }
}

/* The weight where vertices `near` and `near` + 1 are joined by a segment. */
static float joined(global const struct light_of_path *p, const struct technique_weights *all,
                    const struct partial_weights *light, const struct partial_weights *camera,
                    uint near)
{
    const uint far = near + 1u;
    const float d2 = p->distance[far] * p->distance[far];
    const float light_used = used_dVCM(all, light + far, far == p->length - 1u, RT_TECHNIQUE_NEE);
    const float camera_used = used_dVCM(all, camera + near, near == 1u, RT_TECHNIQUE_CAMERA);
    return 1.0f /
           (connection_weight(all, light_used, light[far].dVC,
                              p->to_light[near] * p->near_cosine[far] / d2, p->to_light[far]) +
            1.0f +
            connection_weight(all, camera_used, camera[near].dVC,
                              p->to_camera[far] * p->far_cosine[near] / d2, p->to_camera[near]));
}

/* weights: of emission, light sampling, joining i and i + 1 at 1 + i, and of merging at 8 + i. */
kernel void weigh(uint count, const rt_vcm_params vcm, global const struct light_of_path *paths,
                  global float *weights)
{
    const uint item = item_number();
    if (item >= count)
        return;
    global const struct light_of_path *p = paths + item;
    global float *out = weights + 16u * item;
    const struct technique_weights all = technique_weights_of(&vcm);
    const uint k = p->length, last = k - 1u;
    struct partial_weights light[8], camera[8];
    for (uint i = 0u; i < 16u; i++)
        out[i] = 0.0f;
    if (k == 1u) {
        out[0] = 1.0f / (1.0f + emission_weight(&all, 0.0f, 0.0f, p->emit));
        return;
    }
    light_partials(p, &all, light);
    camera_partials(p, &all, camera);
    out[0] = 1.0f / (1.0f + emission_weight(&all, camera[k].dVC,
                                            is_delta(p, last) ? 0.0f : p->light / p->to_light[last],
                                            p->emit));
    if (!is_delta(p, last)) {
        const float met =
            all.techniques & RT_TECHNIQUE_EMISSION ? mis(p->to_light[last] / p->light) : 0.0f;
        const float used = used_dVCM(&all, camera + last, last == 1u, RT_TECHNIQUE_CAMERA);
        const float ratio = p->emit * p->far_cosine[last] / (p->light * p->near_cosine[k]);
        out[1] =
            1.0f / (met + 1.0f +
                    connection_weight(&all, used, camera[last].dVC, ratio, p->to_camera[last]));
    }
    if (!is_delta(p, 1u)) {
        const float used = used_dVCM(&all, light + 1, last == 1u, RT_TECHNIQUE_NEE);
        out[7] = 1.0f / (1.0f + connection_weight(&all, used, light[1].dVC,
                                                  p->camera * p->near_cosine[1] / all.light_paths,
                                                  p->to_light[1]));
    }
    for (uint i = 1u; i < last; i++)
        if (!is_delta(p, i) && !is_delta(p, i + 1u))
            out[1u + i] = joined(p, &all, light, camera, i);
    for (uint i = 1u; i <= last; i++)
        if (!is_delta(p, i)) {
            const float light_used = used_dVCM(&all, light + i, i == last, RT_TECHNIQUE_NEE);
            const float camera_used = used_dVCM(&all, camera + i, i == 1u, RT_TECHNIQUE_CAMERA);
            out[8u + i] =
                1.0f / (merging_weight(&all, light_used, light[i].dVC, p->to_light[i]) + 1.0f +
                        merging_weight(&all, camera_used, camera[i].dVC, p->to_camera[i]));
        }
}
