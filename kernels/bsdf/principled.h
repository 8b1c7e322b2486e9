/*
 * principled.h - the rough lobe of a principled material: that of a solid (principled_solid.h), or
 * of a sheet (principled_thin.h).
 */
#ifndef RT_KERNELS_BSDF_PRINCIPLED_H
#define RT_KERNELS_BSDF_PRINCIPLED_H

#include "bsdf/principled_solid.h"
#include "bsdf/principled_thin.h"

static inline struct lobe_value principled_eval(const struct bsdf *bsdf, float3 wi)
{
    const struct frame frame = facet_frame(&bsdf->specular);
    const float3 wo_local = frame_to_local(frame, bsdf->wo), wi_local = frame_to_local(frame, wi);
    const bool above = wi_local.z > 0.0f;
    if (above != (dot(wi, bsdf->normal) > 0.0f))
        return no_light();
    struct lobe_value lobe = is_thin(bsdf->specular.material)
                                 ? thin_eval(bsdf, wo_local, wi_local)
                                 : solid_eval(&bsdf->specular, wo_local, wi_local);
    lobe.value *= above ? 1.0f : square(bsdf->specular.eta);
    return lobe;
}

static inline struct lobe_sample principled_sample(const struct bsdf *bsdf, float3 u)
{
    const struct frame frame = facet_frame(&bsdf->specular);
    const float3 wo_local = frame_to_local(frame, bsdf->wo);
    float3 wi_local;
    struct lobe_sample sample;
    const float3 weight =
        is_thin(bsdf->specular.material)
            ? thin_sample(bsdf, wo_local, u, &wi_local, &sample.pdf_w)
            : solid_sample(&bsdf->specular, wo_local, u, &wi_local, &sample.pdf_w);
    sample.wi = unit(frame_to_world(frame, wi_local));
    sample.through = wi_local.z < 0.0f;
    sample.weight =
        sample.through == (dot(sample.wi, bsdf->normal) < 0.0f) ? weight : (float3)(0.0f);
    return sample;
}

static inline float principled_pdf_w(const struct bsdf *bsdf, float3 wi)
{
    return principled_eval(bsdf, wi).pdf_w;
}

/* About that of a smooth one. */
static inline float3 principled_albedo(const struct bsdf *bsdf)
{
    return bsdf->reflected + bsdf->refracted;
}

#endif
