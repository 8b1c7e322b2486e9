/*
 * lobes.h - the list of the lobes that a BSDF is made of, and the functions that call a lobe by its
 * number, with one case per lobe made from the list. The host reads the list alone.
 */
#ifndef RT_KERNELS_BSDF_LOBES_H
#define RT_KERNELS_BSDF_LOBES_H

/*
 * X(NAME, name, is_delta, is_diffuse, is_large) for each lobe: name.h holds RT_LOBE_NAME. A delta
 * lobe scatters into one direction. A diffuse lobe varies slowly enough with direction for photon
 * density estimation: photons are stored, and gathered, where a surface has one. Whether they are
 * where it has another depends on the surface: bsdf.h. The code of large lobes is out of line.
 * RT_LOBES are those of the program: of plain scenes (types.h) the first few.
 */
#define RT_PLAIN_LOBES(X)                                                                          \
    X(LAMBERT, lambert, 0, 1, 0)                                                                   \
    X(SPECULAR_REFLECTION, specular_reflection, 1, 0, 0)                                           \
    X(SPECULAR_TRANSMISSION, specular_transmission, 1, 0, 0)                                       \
    X(GGX, ggx, 0, 0, 0)
#define RT_ALL_LOBES(X)                                                                            \
    RT_PLAIN_LOBES(X)                                                                              \
    X(OREN_NAYAR, oren_nayar, 0, 1, 0)                                                             \
    X(PRINCIPLED_DIFFUSE, principled_diffuse, 0, 1, 0)                                             \
    X(COATED, coated, 0, 1, 0)                                                                     \
    X(TRANSLUCENT, translucent, 0, 1, 0)                                                           \
    X(FUZZ, fuzz, 0, 1, 0)                                                                         \
    X(PRINCIPLED, principled, 0, 0, 1)                                                             \
    X(PHONG, phong, 0, 0, 0)                                                                       \
    X(LACQUER, lacquer, 0, 0, 1)
#ifdef RT_PLAIN
#define RT_LOBES RT_PLAIN_LOBES
#else
#define RT_LOBES RT_ALL_LOBES
#endif

#define RT_LOBE_ENUMERATOR(NAME, name, is_delta, is_diffuse, is_large) RT_LOBE_##NAME,
enum rt_lobe { RT_ALL_LOBES(RT_LOBE_ENUMERATOR) RT_LOBE_COUNT, RT_LOBE_NONE = RT_LOBE_COUNT };

#ifdef __OPENCL_VERSION__

#include "bsdf/coated.h"
#include "bsdf/fuzz.h"
#include "bsdf/ggx.h"
#include "bsdf/lacquer.h"
#include "bsdf/lambert.h"
#include "bsdf/lobe.h"
#include "bsdf/oren_nayar.h"
#include "bsdf/phong.h"
#include "bsdf/principled.h"
#include "bsdf/principled_diffuse.h"
#include "bsdf/specular_reflection.h"
#include "bsdf/specular_transmission.h"
#include "bsdf/translucent.h"

#define DELTA_BIT(NAME, name, is_delta, is_diffuse, is_large) | (is_delta##u << RT_LOBE_##NAME)
#define DIFFUSE_BIT(NAME, name, is_delta, is_diffuse, is_large) | (is_diffuse##u << RT_LOBE_##NAME)
#define LARGE_BIT(NAME, name, is_delta, is_diffuse, is_large) | (is_large##u << RT_LOBE_##NAME)
#define ROUGH_BIT(NAME, name, is_delta, is_diffuse, is_large)                                      \
    | ((is_delta##u | is_diffuse##u) ^ 1u) << RT_LOBE_##NAME

static inline bool lobe_is_delta(uint lobe)
{
    return (0u RT_LOBES(DELTA_BIT)) >> lobe & 1u;
}

static inline bool lobe_is_diffuse(uint lobe)
{
    return (0u RT_LOBES(DIFFUSE_BIT)) >> lobe & 1u;
}

static inline bool lobe_is_large(uint lobe)
{
    return (0u RT_LOBES(LARGE_BIT)) >> lobe & 1u;
}

/* Of a rough boundary: neither of the two, and not RT_LOBE_NONE. */
#define ROUGH_LOBES (0u RT_LOBES(ROUGH_BIT))
static inline bool lobe_is_rough(uint lobe)
{
    return ROUGH_LOBES >> lobe & 1u;
}

static inline struct lobe_sample no_sample(const struct bsdf *bsdf)
{
    struct lobe_sample none;
    none.wi = bsdf->normal;
    none.weight = (float3)(0.0f);
    none.pdf_w = 0.0f;
    none.through = false;
    return none;
}

/* A case of a lobe that calls its function, by its flags. */
#define LOBE_CASE(NAME, name, function, last)                                                      \
    case RT_LOBE_##NAME:                                                                           \
        return name##_##function(bsdf, last);
#define IF_0(NAME, name, function, last)
#define IF_1(NAME, name, function, last) LOBE_CASE(NAME, name, function, last)
#define IF_NOT_0(NAME, name, function, last) LOBE_CASE(NAME, name, function, last)
#define IF_NOT_1(NAME, name, function, last)
#define IF_ROUGH_000(NAME, name, function, last) LOBE_CASE(NAME, name, function, last)
#define IF_ROUGH_001(NAME, name, function, last)
#define IF_ROUGH_010(NAME, name, function, last)
#define IF_ROUGH_100(NAME, name, function, last)

/* ---- Large lobes ----------------------------------------------------------------- */

/* They are handed copies of a BSDF, so that what these are copied from can live in registers. */

#define LARGE_EVAL(NAME, name, is_delta, is_diffuse, is_large) IF_##is_large(NAME, name, eval, wi)
RARELY_CALLED struct lobe_value large_eval(const struct bsdf *bsdf, uint lobe, float3 wi)
{
    switch (lobe) {
        RT_LOBES(LARGE_EVAL)
    }
    return no_light();
}

#define LARGE_SAMPLE(NAME, name, is_delta, is_diffuse, is_large)                                   \
    IF_##is_large(NAME, name, sample, u)
RARELY_CALLED struct lobe_sample large_sample(const struct bsdf *bsdf, uint lobe, float3 u)
{
    switch (lobe) {
        RT_LOBES(LARGE_SAMPLE)
    }
    return no_sample(bsdf);
}

static inline struct lobe_value copied_eval(const struct bsdf *bsdf, uint lobe, float3 wi)
{
    const struct bsdf copy = *bsdf;
    return large_eval(&copy, lobe, wi);
}

/* ---- Any ------------------------------------------------------------------------- */

/* fr |n.wi| of a diffuse lobe, and its density of wi. */
#define DIFFUSE_EVAL(NAME, name, is_delta, is_diffuse, is_large)                                   \
    IF_##is_diffuse(NAME, name, eval, wi)
INLINE_ALWAYS struct lobe_value diffuse_eval(const struct bsdf *bsdf, uint lobe, float3 wi)
{
    switch (lobe) {
        RT_LOBES(DIFFUSE_EVAL)
    }
    return no_light();
}

/* The same of a rough lobe. */
#define ROUGH_EVAL(NAME, name, is_delta, is_diffuse, is_large)                                     \
    IF_ROUGH_##is_delta##is_diffuse##is_large(NAME, name, eval, wi)
INLINE_ALWAYS struct lobe_value rough_eval(const struct bsdf *bsdf, uint lobe, float3 wi)
{
    switch (lobe) {
        RT_LOBES(ROUGH_EVAL)
    }
    return lobe_is_large(lobe) ? copied_eval(bsdf, lobe, wi) : no_light();
}

/* The same of any; delta lobes: 0. */
INLINE_NEVER struct lobe_value lobe_eval(const struct bsdf *bsdf, uint lobe, float3 wi)
{
    return lobe_is_diffuse(lobe) ? diffuse_eval(bsdf, lobe, wi) : rough_eval(bsdf, lobe, wi);
}

#define SMALL_PDF(NAME, name, is_delta, is_diffuse, is_large)                                      \
    IF_NOT_##is_large(NAME, name, pdf_w, wi)
static inline float lobe_pdf_w(const struct bsdf *bsdf, uint lobe, float3 wi)
{
    switch (lobe) {
        RT_LOBES(SMALL_PDF)
    }
    return lobe_is_large(lobe) ? copied_eval(bsdf, lobe, wi).pdf_w : 0.0f;
}

#define SMALL_SAMPLE(NAME, name, is_delta, is_diffuse, is_large)                                   \
    IF_NOT_##is_large(NAME, name, sample, u)
INLINE_ALWAYS struct lobe_sample lobe_sample(const struct bsdf *bsdf, uint lobe, float3 u)
{
    switch (lobe) {
        RT_LOBES(SMALL_SAMPLE)
    }
    if (!lobe_is_large(lobe))
        return no_sample(bsdf);
    const struct bsdf copy = *bsdf;
    return large_sample(&copy, lobe, u);
}

#define ALBEDO_CASE(NAME, name, is_delta, is_diffuse, is_large)                                    \
    case RT_LOBE_##NAME:                                                                           \
        return name##_albedo(bsdf);

INLINE_ALWAYS float3 lobe_albedo(const struct bsdf *bsdf, uint lobe)
{
    switch (lobe) {
        RT_LOBES(ALBEDO_CASE)
    }
    return (float3)(0.0f);
}

/* What a gather point keeps of a diffuse lobe. */
#define KEEP_0(NAME, name, function)
#define KEEP_1(NAME, name, function)                                                               \
    case RT_LOBE_##NAME:                                                                           \
        name##_##function(bsdf, numbers);                                                          \
        break;
#define DIFFUSE_KEEP(NAME, name, is_delta, is_diffuse, is_large) KEEP_##is_diffuse(NAME, name, keep)
static inline void diffuse_keep(const struct bsdf *bsdf, uint lobe, global float *numbers)
{
    switch (lobe) {
        RT_LOBES(DIFFUSE_KEEP)
    }
}

#define DIFFUSE_RESTORE(NAME, name, is_delta, is_diffuse, is_large)                                \
    KEEP_##is_diffuse(NAME, name, restore)
static inline void diffuse_restore(struct bsdf *bsdf, uint lobe, global const float *numbers)
{
    switch (lobe) {
        RT_LOBES(DIFFUSE_RESTORE)
    }
}

#endif
#endif
