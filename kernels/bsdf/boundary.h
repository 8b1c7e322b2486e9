/*
 * boundary.h - the specular part of a material at a point: how much light its boundary reflects and
 * how much it refracts.
 */
#ifndef RT_KERNELS_BSDF_BOUNDARY_H
#define RT_KERNELS_BSDF_BOUNDARY_H

#include "bsdf/fresnel.h"
#include "material/medium.h"
#include "types.h"

/* What the surface of a principled material has beside its colours: principled_solid.h. */
struct principled {
    float dielectric; /* the part of its reflectance that is Fresnel's; ks is Schlick's part, */
    float edge;       /* and this at grazing angles */
    float clearcoat;  /* amount, seen from this side */
    float sheen;      /* weight of its sheen */
    float sheen_tint, flatness, clearcoat_gloss, diff_trans; /* as at the point */
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
};

/* Whether the boundary is a coat: what it does not reflect is left to the lobe below. */
static inline bool is_coated(global const rt_material_data *material)
{
    return material->flags & RT_MATERIAL_COAT;
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

/* What a boundary, or a facet of one, does with light. */
struct split {
    float3 reflected, refracted;
    float cos_t;       /* of the refracted direction */
    float probability; /* of reflection, where one of the two is chosen */
};

/*
 * Splits light between reflection and refraction at a boundary met with this cosine. A metal's
 * index is relative to the medium it lies in, whose index eta then is.
 */
static inline struct split split_light(const struct specular *specular, float cos_i)
{
    global const rt_material_data *material = specular->material;
    const float3 both = specular->ks + specular->kt;
    struct split split;
    float reflectance = fresnel(cos_i, specular->eta, &split.cos_t);
    if (material->flags & RT_MATERIAL_CONDUCTOR) {
        const float inverse = 1.0f / specular->eta;
        split.reflected = specular->ks * fresnel_conductor(cos_i, row3(material->eta) * inverse,
                                                           row3(material->k) * inverse);
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

/* The probability of reflection alone: a metal does nothing else. */
static inline float reflection_probability(const struct specular *specular, float cos_i)
{
    return specular->material->flags & RT_MATERIAL_CONDUCTOR
               ? 1.0f
               : split_light(specular, cos_i).probability;
}

#endif
