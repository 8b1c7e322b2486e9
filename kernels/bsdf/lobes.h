/*
 * lobes.h - the list of the lobes that a BSDF is made of, and the functions that call a lobe by its
 * number, with one case per lobe made from the list. The host reads the list alone.
 */
#ifndef RT_KERNELS_BSDF_LOBES_H
#define RT_KERNELS_BSDF_LOBES_H

/*
 * X(NAME, name, is_delta, is_diffuse) for each lobe: name.h holds RT_LOBE_NAME. A delta lobe
 * scatters into one direction. A diffuse lobe varies slowly enough with direction for photon
 * density estimation: photons are stored, and gathered, where a surface has one. Whether they are
 * where it has another depends on the surface: bsdf.h.
 */
#define RT_LOBES(X)                                                                                \
    X(LAMBERT, lambert, 0, 1)                                                                      \
    X(OREN_NAYAR, oren_nayar, 0, 1)                                                                \
    X(PRINCIPLED_DIFFUSE, principled_diffuse, 0, 1)                                                \
    X(COATED, coated, 0, 1)                                                                        \
    X(TRANSLUCENT, translucent, 0, 1)                                                              \
    X(SPECULAR_REFLECTION, specular_reflection, 1, 0)                                              \
    X(SPECULAR_TRANSMISSION, specular_transmission, 1, 0)                                          \
    X(GGX, ggx, 0, 0)                                                                              \
    X(PRINCIPLED, principled, 0, 0)                                                                \
    X(PHONG, phong, 0, 0)

#define RT_LOBE_ENUMERATOR(NAME, name, is_delta, is_diffuse) RT_LOBE_##NAME,
enum rt_lobe { RT_LOBES(RT_LOBE_ENUMERATOR) RT_LOBE_COUNT, RT_LOBE_NONE = RT_LOBE_COUNT };

#ifdef __OPENCL_VERSION__

#include "bsdf/coated.h"
#include "bsdf/ggx.h"
#include "bsdf/lambert.h"
#include "bsdf/lobe.h"
#include "bsdf/oren_nayar.h"
#include "bsdf/phong.h"
#include "bsdf/principled.h"
#include "bsdf/principled_diffuse.h"
#include "bsdf/specular_reflection.h"
#include "bsdf/specular_transmission.h"
#include "bsdf/translucent.h"

#define DELTA_BIT(NAME, name, is_delta, is_diffuse) | (is_delta##u << RT_LOBE_##NAME)
#define DIFFUSE_BIT(NAME, name, is_delta, is_diffuse) | (is_diffuse##u << RT_LOBE_##NAME)
#define ROUGH_BIT(NAME, name, is_delta, is_diffuse)                                                \
    | ((is_delta##u | is_diffuse##u) ^ 1u) << RT_LOBE_##NAME

static inline bool lobe_is_delta(uint lobe)
{
    return (0u RT_LOBES(DELTA_BIT)) >> lobe & 1u;
}

static inline bool lobe_is_diffuse(uint lobe)
{
    return (0u RT_LOBES(DIFFUSE_BIT)) >> lobe & 1u;
}

/* Of a rough boundary: neither of the two, and not RT_LOBE_NONE. */
#define ROUGH_LOBES (0u RT_LOBES(ROUGH_BIT))
static inline bool lobe_is_rough(uint lobe)
{
    return ROUGH_LOBES >> lobe & 1u;
}

#define EVAL_CASE(NAME, name)                                                                      \
    case RT_LOBE_##NAME:                                                                           \
        return name##_eval(bsdf, wi);
#define EVAL_0(NAME, name) /* of a flag that is not set */
#define EVAL_1(NAME, name) EVAL_CASE(NAME, name)
#define EVAL_00(NAME, name) EVAL_CASE(NAME, name) /* of neither flag */
#define EVAL_01(NAME, name)
#define EVAL_10(NAME, name)
#define DIFFUSE_CASE(NAME, name, is_delta, is_diffuse) EVAL_##is_diffuse(NAME, name)
#define ROUGH_CASE(NAME, name, is_delta, is_diffuse) EVAL_##is_delta##is_diffuse(NAME, name)

/* fr |n.wi| of a diffuse lobe, and its density of wi. */
INLINE_ALWAYS struct lobe_value diffuse_eval(const struct bsdf *bsdf, uint lobe, float3 wi)
{
    switch (lobe) {
        RT_LOBES(DIFFUSE_CASE)
    }
    return no_light();
}

/* The same of a rough lobe. */
INLINE_ALWAYS struct lobe_value rough_eval(const struct bsdf *bsdf, uint lobe, float3 wi)
{
    switch (lobe) {
        RT_LOBES(ROUGH_CASE)
    }
    return no_light();
}

/* The same of any; delta lobes: 0. */
INLINE_NEVER struct lobe_value lobe_eval(const struct bsdf *bsdf, uint lobe, float3 wi)
{
    return lobe_is_diffuse(lobe) ? diffuse_eval(bsdf, lobe, wi) : rough_eval(bsdf, lobe, wi);
}

#define PDF_CASE(NAME, name, is_delta, is_diffuse)                                                 \
    case RT_LOBE_##NAME:                                                                           \
        return name##_pdf_w(bsdf, wi);

static inline float lobe_pdf_w(const struct bsdf *bsdf, uint lobe, float3 wi)
{
    switch (lobe) {
        RT_LOBES(PDF_CASE)
    }
    return 0.0f;
}

#define SAMPLE_CASE(NAME, name, is_delta, is_diffuse)                                              \
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

#define ALBEDO_CASE(NAME, name, is_delta, is_diffuse)                                              \
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
#endif
