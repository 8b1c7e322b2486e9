/*
 * lobe.h - the interface of the lobes of a BSDF: their parameters and results.
 *
 * lobes.h lists the lobes. Each is a header X.h with four functions of a surface as seen from wo:
 *
 *   X_eval(bsdf, wi)    fr |n.wi|, and the density of wi
 *   X_sample(bsdf, u)   a direction by u in [0,1)^3, with fr |n.wi| over its density
 *   X_pdf_w(bsdf, wi)   the density of wi alone, per steradian
 *   X_albedo(bsdf)      the integral of fr |n.wi| over wi, or an upper bound of it (ggx)
 *
 * and two more of a diffuse one, by which gather points have it:
 *
 *   X_keep(bsdf, numbers)     keeps what X_eval reads beside wo, the normals and the material
 *   X_restore(bsdf, numbers)  has it read that again
 *
 * The probability that the lobe is chosen is no part of them; bsdf.h mixes it in. Delta lobes have
 * no X_eval, and evaluate to 0. Where wi lies on the wrong side of the geometric normal, a lobe
 * evaluates to 0, and samples of weight 0 are lost.
 *
 * wo and wi are unit vectors that point away from the surface; wi_local is wi in the frame of the
 * shading normal. X_eval is for a path that carries radiance; X_sample leaves out what scales
 * radiance, and not flux, where it crosses the surface: eta_scale of bsdf.h.
 */
#ifndef RT_KERNELS_BSDF_LOBE_H
#define RT_KERNELS_BSDF_LOBE_H

#include "bsdf/boundary.h"
#include "math/frame.h"
#include "math/lanes.h"
#include "sample/sample.h"
#include "types.h"

/*
 * What a path carries: radiance from the eye, or flux from a light; these differ where scattering
 * is not symmetric.
 */
enum transport { CARRY_RADIANCE, CARRY_FLUX };

/* A surface's scattering as seen from wo. */
struct bsdf {
    float3 kd;
    float3 second; /* colour of a diffuse lobe that has two, as translucent.h */
    /* specular parts, without the radiance's (eta_i/eta_t)^2 */
    float3 reflected, refracted;
    float3 normal;  /* geometric, on the side of wo */
    float3 shading; /* of diffuse lobes; on the side of wo as well */
    float3 wo;
    float cos_t; /* of the refracted direction, unless reflected totally */
    /* probabilities of the lobes, given survival; all 0: black */
    float diffuse, reflection, refraction;
    uint diffuse_lobe; /* RT_LOBE_* that scatters kd */
    float roughness;   /* that of the material at the point */
    uint transport;    /* enum transport */
    /* alpha 0: smooth */
    struct specular specular;
};

/* What a lobe scatters from wi to wo. */
struct lobe_value {
    float3 value; /* fr |n.wi| */
    float pdf_w;  /* density of wi by X_sample; 0 for delta lobes */
};

/* A direction made by a lobe. */
struct lobe_sample {
    float3 wi;     /* unit */
    float3 weight; /* fr |n.wi| / pdf_w; 0: the light is lost */
    float pdf_w;   /* 0 for delta lobes */
    bool through;  /* wi is on the other side of the surface */
};

static inline struct lobe_value no_light(void)
{
    struct lobe_value none;
    none.value = (float3)(0.0f);
    none.pdf_w = 0.0f;
    return none;
}

#endif
