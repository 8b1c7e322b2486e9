/*
 * lambert.h - Lambert's lobe: the same radiance in all directions.
 *
 *   fr = kd / pi,   pdf_w = cos / pi,   albedo = kd
 *
 * Reference:
 *   Lambert: "Photometria", 1760.
 */
#ifndef RT_KERNELS_BSDF_LAMBERT_H
#define RT_KERNELS_BSDF_LAMBERT_H

#include "bsdf/lobe.h"
#include "math/width1.inc.h"
#include "bsdf/lambert.inc.h"

static inline float lambert_pdf_w(const struct bsdf *bsdf, float3 wi)
{
    return lambert_density(bsdf->normal, bsdf->shading, wi);
}

static inline struct lobe_value lambert_eval(const struct bsdf *bsdf, float3 wi)
{
    struct lobe_value lobe;
    lobe.pdf_w = lambert_pdf_w(bsdf, wi);
    lobe.value = bsdf->kd * lobe.pdf_w;
    return lobe;
}

static inline struct lobe_sample lambert_sample(const struct bsdf *bsdf, float3 u)
{
    const float3 wi_local = sample_cosine(u.xy);
    struct lobe_sample sample;
    sample.wi = frame_to_world(frame_about(bsdf->shading), wi_local);
    sample.pdf_w = cosine_pdf_w(wi_local.z);
    sample.weight =
        wi_local.z > 0.0f && dot(sample.wi, bsdf->normal) > 0.0f ? bsdf->kd : (float3)(0.0f);
    sample.through = false;
    return sample;
}

static inline float3 lambert_albedo(const struct bsdf *bsdf)
{
    return bsdf->kd;
}

static inline void lambert_keep(const struct bsdf *bsdf, global float *numbers)
{
    vstore3(bsdf->kd, 0, numbers);
}

static inline void lambert_restore(struct bsdf *bsdf, global const float *numbers)
{
    bsdf->kd = row3(numbers);
}

#endif
