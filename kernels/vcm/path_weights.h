/*
 * path_weights.h - a camera path of mode vcm, and the weights of the techniques that end at one of
 * its vertices, from its partial weights and from densities at the joint.
 */
#ifndef RT_KERNELS_VCM_PATH_WEIGHTS_H
#define RT_KERNELS_VCM_PATH_WEIGHTS_H

#include "integrate/path_state.h"
#include "light/emit_pdf.h"
#include "surface/bidirectional.h"
#include "vcm/weights.h"

/* What all camera paths of a launch use. */
struct vcm_scene {
    struct scene scene;
    const rt_params *params;
    struct technique_weights all;
    global const rt_light_share *shares;
    float radius; /* of merging */
    uint bucket_bits;
};

/* A camera path under way, and its weights. */
struct vcm_camera_path {
    struct path eye;
    struct partial_weights partial;
    /* of merging at the next vertex: the pixel's own as long as no event but delta ones came */
    float squared_radius;
    /* [2][3], what discs of half and a quarter of the area find more; or NULL */
    global float *parts;
    global rt_merge_query *query; /* asked for instead of light, or NULL */
};

/* The weight of a light that is met. */
static inline float weight_of_met(const struct vcm_scene *vcm, const struct vcm_camera_path *path,
                                  float direct_pdf_w, float emission_pdf)
{
    const float ratio = path->eye.pdf_w > 0.0f ? direct_pdf_w / path->eye.pdf_w : 0.0f;
    return 1.0f / (1.0f + emission_weight(&vcm->all, path->partial.dVC, ratio, emission_pdf));
}

/* That of an emitter at a surface. */
static inline float emitter_weight(const struct vcm_camera_path *path, const struct vcm_scene *vcm,
                                   uint index, const struct surface *surface, float3 wo)
{
    const struct scene *scene = &vcm->scene;
    global const rt_light_data *light = scene->lights + index;
    const float pdf =
        vcm->shares[index].pmf * emit_area_pdf(scene, light, surface, dot(surface->normal, wo));
    return weight_of_met(vcm, path, light_pdf_w(scene, light, path->eye.from, surface), pdf);
}

/* That of the environment in the direction w. */
static inline float sky_weight(const struct vcm_camera_path *path, const struct vcm_scene *vcm,
                               float3 w)
{
    const struct scene *scene = &vcm->scene;
    const float pdf = vcm->shares[scene->environment->light].pmf * environment_pdf_w(scene, w) *
                      emit_distant_pdf_a(scene, path->eye.from, w);
    return weight_of_met(vcm, path, environment_light_pdf_w(scene, path->eye.from, w), pdf);
}

/*
 * The density of a light path that starts with a sampled point and goes to a vertex, over that of
 * light sampling, but for what both have in common; cosine: at the vertex.
 */
static inline float emission_ratio(const struct vcm_scene *vcm, uint index,
                                   const struct light_sample *sample, float3 position, float cosine)
{
    const struct scene *scene = &vcm->scene;
    global const rt_light_data *light = scene->lights + index;
    const float3 w = -sample->wi, towards = sample->at.position - position;
    const float d2 = dot(towards, towards);
    const float cos_light = dot(sample->at.normal, w);
    const float start = vcm->shares[index].pmf * cosine * sample->inv_pdf;
    switch ((rt_light_kind)light->kind) {
    case RT_LIGHT_POINT:
    case RT_LIGHT_SPOT:
    case RT_LIGHT_TABLE:
        return start * emit_point_pdf_w(scene, light, w) / d2;
    case RT_LIGHT_DIRECTIONAL:
    case RT_LIGHT_BEAM:
        return start * emit_parallel_pdf_a(scene, light, position, w);
    case RT_LIGHT_ENVIRONMENT:
        return start * emit_distant_pdf_a(scene, position, w) *
               environment_pdf_w(scene, sample->wi);
    case RT_LIGHT_QUAD:
    case RT_LIGHT_TRIANGLE:
    case RT_LIGHT_SPHERE:
    case RT_LIGHT_SHAPE:
        return start * emit_area_pdf(scene, light, &sample->at, cos_light) / fabs(cos_light);
    }
    return 0.0f;
}

/* The weight of a sampled point of a light, for what a vertex scatters from there. */
static inline float sampled_light_weight(const struct vcm_camera_path *path,
                                         const struct vcm_scene *vcm, const struct vertex *vertex,
                                         float used, uint light, const struct light_sample *sample,
                                         const struct scattering *s)
{
    const float cosine = fabs(dot(sample->wi, vertex->bsdf.normal));
    const float met = sample->delta || !(vcm->all.techniques & RT_TECHNIQUE_EMISSION)
                          ? 0.0f
                          : mis(s->pdf_w * sample->inv_pdf);
    const float ratio = emission_ratio(vcm, light, sample, vertex->position, cosine);
    return 1.0f / (met + 1.0f +
                   connection_weight(&vcm->all, used, path->partial.dVC, ratio, s->back_pdf_w));
}

/*
 * The weight of the vertices of a camera and a light path that are joined: here, there, what they
 * scatter of each other, pdf_there: the density over area with which the camera path would sample
 * the other, and the reverse. light_used: used_dVCM of the light path.
 */
static inline float joined_weight(const struct vcm_camera_path *path, const struct vcm_scene *vcm,
                                  float used, const struct partial_weights *light, float light_used,
                                  const struct scattering *here, float pdf_here,
                                  const struct scattering *there, float pdf_there)
{
    return 1.0f /
           (connection_weight(&vcm->all, light_used, light->dVC, pdf_there, there->back_pdf_w) +
            1.0f +
            connection_weight(&vcm->all, used, path->partial.dVC, pdf_here, here->back_pdf_w));
}

/* The weight of a vertex of a camera path and one of a light path that are merged. */
static inline float merged_weight(const struct vcm_camera_path *path, const struct vcm_scene *vcm,
                                  float used, const struct partial_weights *light, float light_used,
                                  const struct scattering *s)
{
    return 1.0f / (merging_weight(&vcm->all, light_used, light->dVC, s->pdf_w) + 1.0f +
                   merging_weight(&vcm->all, used, path->partial.dVC, s->back_pdf_w));
}

#endif
