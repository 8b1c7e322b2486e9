/*
 * dispatch.h - calls a lobe by its number: one case a lobe, made from the list of lobes.
 */
#ifndef RT_KERNELS_BSDF_DISPATCH_H
#define RT_KERNELS_BSDF_DISPATCH_H

#include "bsdf/ggx.h"
#include "bsdf/lambert.h"
#include "bsdf/lobe.h"
#include "bsdf/specular_reflection.h"
#include "bsdf/specular_transmission.h"

#define EVAL_CASE(NAME, name, is_delta, is_gathered)                                               \
    case RT_LOBE_##NAME:                                                                           \
        return name##_eval(bsdf, wi);

/* fr |n.wi| of a lobe, and its density of wi. */
static inline struct lobe_value lobe_eval(const struct bsdf *bsdf, uint lobe, float3 wi)
{
    switch (lobe) {
        RT_LOBES(EVAL_CASE)
    }
    return no_light();
}

#define PDF_CASE(NAME, name, is_delta, is_gathered)                                                \
    case RT_LOBE_##NAME:                                                                           \
        return name##_pdf_w(bsdf, wi);

static inline float lobe_pdf_w(const struct bsdf *bsdf, uint lobe, float3 wi)
{
    switch (lobe) {
        RT_LOBES(PDF_CASE)
    }
    return 0.0f;
}

#define SAMPLE_CASE(NAME, name, is_delta, is_gathered)                                             \
    case RT_LOBE_##NAME:                                                                           \
        return name##_sample(bsdf, u);

static inline struct lobe_sample lobe_sample(const struct bsdf *bsdf, uint lobe, float3 u)
{
    switch (lobe) {
        RT_LOBES(SAMPLE_CASE)
    }
    struct lobe_sample none;
    none.wi = bsdf->normal;
    none.weight = (float3)(0.0f);
    none.pdf_w = 0.0f;
    none.through = false;
    return none;
}

#define ALBEDO_CASE(NAME, name, is_delta, is_gathered)                                             \
    case RT_LOBE_##NAME:                                                                           \
        return name##_albedo(bsdf);

static inline float3 lobe_albedo(const struct bsdf *bsdf, uint lobe)
{
    switch (lobe) {
        RT_LOBES(ALBEDO_CASE)
    }
    return (float3)(0.0f);
}

#endif
