/*
 * boundary.h - the specular part of a material at a point: how much light its boundary reflects and
 * how much it refracts.
 */
#ifndef RT_KERNELS_BSDF_BOUNDARY_H
#define RT_KERNELS_BSDF_BOUNDARY_H

#include "bsdf/fresnel.h"
#include "material/medium.h"
#include "math/lanes.h"
#include "types.h"

/* What the surface of a principled material has beside its colours: principled_solid.h. */
struct principled {
    float dielectric; /* the part of its reflectance that is Fresnel's; ks is Schlick's part, */
    float edge;       /* and this at grazing angles */
    float clearcoat;  /* amount, seen from this side */
    float sheen;      /* weight of its sheen */
    float sheen_tint, flatness, clearcoat_gloss, diff_trans; /* as at the point */
};

/* The coat of a material, and what lies bare beside it. */
struct coat {
    float amount;     /* the part of the surface that it covers */
    float alpha;      /* of its facets; 0: smooth */
    float bare_alpha; /* lacquer: of the facets where there is none; 0: smooth */
    float bare_alpha_v;
    float3 diffuse;    /* lacquer: kd, which lies below beside ks */
    float3 absorption; /* its optical depth along the normal */
};

struct specular {
    float3 ks, kt;
    float eta;                               /* index on the side of wo over that on the other */
    float sheet;                             /* of a thin sheet: over that of the sheet; eta is 1 */
    float alpha;                             /* of facets, or exponent of Phong; 0: smooth */
    float alpha_v;                           /* of anisotropic ones, across the tangent */
    float3 tangent;                          /* of those: unit, along which alpha is; 0: any */
    float3 normal;                           /* of reflection and refraction; on the side of wo */
    bool fresnel;                            /* whether those of dielectrics hold */
    global const rt_material_data *material; /* and those of a metal */
    struct principled principled;            /* only where the material is */
    struct coat coat;                        /* only where the material has one */
};

/* Whether the boundary is a coat: what it does not reflect is left to the lobe below. */
static inline bool is_coated(global const rt_material_data *material)
{
    return has_flag(material, RT_MATERIAL_COAT);
}

/* Whether it lies over ks: then that, and alpha, are of what lies below it. */
static inline bool is_lacquered(global const rt_material_data *material)
{
    return has_flag(material, RT_MATERIAL_LACQUER);
}

/*
 * What a sheet reflects, with F the reflectance of one of its two sides: the sum over the light
 * that goes to and fro in it, F + (1 - F)^2 F (1 + F^2 + F^4 + ...).
 */
static inline float sheet_reflectance(float cos_i, float eta)
{
    float unused;
    const float reflectance = fresnel(cos_i, eta, &unused);
    return 2.0f * reflectance / (1.0f + reflectance);
}

/* What ks reflects at this cosine, in a medium of this index. */
static inline float3 reflected_in(global const rt_material_data *material, float3 ks, float cos_i,
                                  float index)
{
    const float inverse = 1.0f / index;
    if (material->flags & RT_MATERIAL_SCHLICK)
        return fresnel_schlick(cos_i, ks);
    return material->flags & RT_MATERIAL_CONDUCTOR
               ? ks * fresnel_conductor(cos_i, row3(material->eta) * inverse,
                                        row3(material->k) * inverse)
               : ks;
}

/* What a boundary, or a facet of one, does with light. */
struct split {
    float3 reflected, refracted;
    float cos_t;       /* of the refracted direction */
    float probability; /* of reflection, where one of the two is chosen */
};

/*
 * Splits light between reflection and refraction at a boundary met with this cosine. A metal's
 * index is relative to the medium it lies in, whose index eta then is. Called, it takes 2 % of the
 * time of the Cornell box: its arguments would have to be stored.
 */
INLINE_ALWAYS struct split split_light(const struct specular *specular, float cos_i)
{
    global const rt_material_data *material = specular->material;
    const float3 both = specular->ks + specular->kt;
    struct split split;
    float reflectance = fresnel(cos_i, specular->eta, &split.cos_t);
    if (material->flags & RT_MATERIAL_CONDUCTOR) {
        split.reflected = reflected_in(material, specular->ks, cos_i, specular->eta);
        split.refracted = (float3)(0.0f);
    } else if (specular->fresnel) {
        if (is_thin(material))
            reflectance = sheet_reflectance(cos_i, specular->sheet);
        split.reflected = reflectance * both;
        split.refracted = is_coated(material) ? (float3)(0.0f) : (1.0f - reflectance) * both;
    } else {
        const bool total = reflectance >= 1.0f;
        split.reflected = total ? both : specular->ks;
        split.refracted = total ? (float3)(0.0f) : specular->kt;
    }
    const float r = mean3(split.reflected), t = mean3(split.refracted);
    split.probability = r > 0.0f ? r / (r + t) : 0.0f;
    return split;
}

/* What a lacquer's ks reflects below the coat, and where there is none. */
static inline float3 reflected_below(const struct specular *specular, float cos_i)
{
    return reflected_in(specular->material, specular->ks, cos_i, specular->material->coat_ior);
}

static inline float3 reflected_bare(const struct specular *specular, float cos_i)
{
    return reflected_in(specular->material, specular->ks, cos_i,
                        specular->eta * specular->material->coat_ior);
}

/* What the coat leaves of light that crosses it with this cosine inside. */
static inline float3 left_by_coat(float3 absorption, float cosine)
{
    return largest3(absorption) > 0.0f ? exp(absorption * (-1.0f / fmax(cosine, 1e-6f)))
                                       : (float3)(1.0f);
}

/*
 * What a lacquer reflects as a mirror at this cosine, as `reflected`, and about what its facets do,
 * as `refracted`: bsdf/lacquer.h.
 */
static inline struct split lacquer_split(const struct specular *specular, float cos_i)
{
    const struct coat coat = specular->coat;
    float cos_t;
    const float outer = fresnel(cos_i, specular->eta, &cos_t), bare = 1.0f - coat.amount;
    const float3 left = left_by_coat(coat.absorption, cos_t),
                 base = reflected_below(specular, cos_t);
    const float3 thrown_back = outer * left * left * (base + coat.diffuse);
    const float3 below =
        coat.amount * square(1.0f - outer) * left * left * base / (1.0f - thrown_back);
    const float3 beside = bare * reflected_bare(specular, cos_i);
    const bool is_rough = specular->alpha > 0.0f, is_bare_rough = coat.bare_alpha > 0.0f;
    struct split split;
    split.reflected = (coat.alpha > 0.0f ? 0.0f : coat.amount * outer) +
                      (is_rough ? (float3)(0.0f) : below) +
                      (is_bare_rough ? (float3)(0.0f) : beside);
    split.refracted = (coat.alpha > 0.0f ? coat.amount * outer : 0.0f) +
                      (is_rough ? below : (float3)(0.0f)) +
                      (is_bare_rough ? beside : (float3)(0.0f));
    split.cos_t = 0.0f;
    split.probability = 1.0f;
    return split;
}

/* What the boundary of a material does as a whole, met with this cosine. */
static inline struct split split_boundary(const struct specular *specular, float cos_i)
{
    return is_lacquered(specular->material) ? lacquer_split(specular, cos_i)
                                            : split_light(specular, cos_i);
}

/* The probability of reflection alone: a metal does nothing else. */
static inline float reflection_probability(const struct specular *specular, float cos_i)
{
    return specular->material->flags & RT_MATERIAL_CONDUCTOR
               ? 1.0f
               : split_light(specular, cos_i).probability;
}

#endif
