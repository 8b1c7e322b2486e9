/*
 * principled_solid.h - the rough lobe of a principled material that is no sheet: what its surface
 * reflects and refracts by facets, and its clearcoat.
 *
 *   reflected   fr |n.wi| = R(wo.h) D(h) G1(wo) G1(wi) / (4 n.wo)
 *   refracted   fr |n.wi| = T(wo.h) D(h) G1(wo) G1(wi) |wo.h| |wi.h| / (n.wo (eta wo.h + wi.h)^2)
 *   clearcoat   fr |n.wi| = clearcoat/4 mix(0.04, 1, W) Dc(h) Gc(wo) Gc(wi) n.wi
 *
 * with D the facets of GGX, of alpha = roughness^2, stretched by `anisotropic`, G1 = 1 / (1 +
 * Lambda) their masking, of which the product is taken, and W = (1 - cos)^5 Schlick's weight, where
 * cos is wo.h, or where the index beyond is the lower one the cosine there. With F Fresnel's
 * reflectance, b = base_color, m = metallic, s = spec_trans, t = spec_tint and b' = b over its
 * luminance:
 *
 *   R = a F + mix(B, 1 - a, W),   a = (1 - m) (1 - t)
 *   B = m b + (1 - m) t b' ((eta - 1) / (eta + 1))^2
 *   T = sqrt(b) (1 - m) s (1 - F)
 *
 * From inside R = (1 - m) s F, and there is no clearcoat. The facets of the clearcoat are
 *
 *   Dc(h) = (c^2 - 1) / (pi ln(c^2) (1 + (c^2 - 1) (n.h)^2))
 *
 * with c = mix(0.1, 0.001, clearcoat_gloss), and Gc is the masking of GGX of alpha 1/4. The lobe is
 * reciprocal. R and T take no more than arrives; the clearcoat and the diffuse lobe
 * (principled_diffuse.h) come on top, as Disney has it (theory.md). A principled sheet is in
 * principled_thin.h. A direction is sampled by the clearcoat, or by the facets, of which a visible
 * one reflects or refracts in proportion to R and T.
 *
 * References:
 *   Burley: "Physically Based Shading at Disney", SIGGRAPH 2012 courses (facets, clearcoat).
 *   Burley: "Extending the Disney BRDF to a BSDF with Integrated Subsurface Scattering", SIGGRAPH
 *     2015 courses (refraction).
 *   Jakob et al.: Mitsuba 3, principled.cpp and principledhelpers.h, 2022 (how R and T are mixed,
 *     and the range of the clearcoat's alpha).
 */
#ifndef RT_KERNELS_BSDF_PRINCIPLED_SOLID_H
#define RT_KERNELS_BSDF_PRINCIPLED_SOLID_H

#include "bsdf/ggx.h"
#include "bsdf/principled_diffuse.h"

/* ---- Making it ------------------------------------------------------------------- */

/* What light meets as the index on its side over the other; of a sheet that in it. */
static inline float principled_index(const struct specular *specular)
{
    return is_thin(specular->material) ? specular->sheet : specular->eta;
}

/* alpha along u and along v. */
static inline float2 principled_alphas(float roughness, float anisotropic)
{
    const float aspect = sqrt(1.0f - 0.9f * anisotropic);
    return fmax(square(roughness) * (float2)(1.0f / aspect, aspect), RT_SMOOTH_ALPHA);
}

/*
 * Makes kd, ks, kt and the facets of base_color, metallic and spec_trans, which stand there, and of
 * these numbers.
 */
static inline void set_principled(struct bsdf *bsdf, const struct principled_numbers *numbers,
                                  bool is_inside)
{
    global const rt_material_data *material = bsdf->specular.material;
    struct specular *specular = &bsdf->specular;
    const bool thin = is_thin(material);
    const float3 base = bsdf->kd;
    const float spec_trans = fmin(mean3(specular->kt), 1.0f);
    const float metallic = thin ? 0.0f : fmin(mean3(specular->ks), 1.0f);
    const float diffuse = (1.0f - metallic) * (1.0f - spec_trans);
    const float glass = (1.0f - metallic) * spec_trans, tint = numbers->spec_tint;
    const float dielectric = thin ? spec_trans : 1.0f - metallic;
    const float2 alphas = principled_alphas(bsdf->roughness, numbers->anisotropic);
    if (!is_transparent(material) && !thin)
        specular->eta /= material->ior;
    const float eta = principled_index(specular);
    const float normal_reflectance = square((1.0f - eta) / (1.0f + eta));
    specular->alpha = alphas.x;
    specular->alpha_v = alphas.y;
    specular->kt = thin ? glass * base : glass * sqrt(base);
    specular->principled.dielectric = is_inside ? glass : dielectric * (1.0f - tint);
    specular->principled.edge = is_inside ? 0.0f : metallic + dielectric * tint;
    specular->ks = is_inside
                       ? (float3)(0.0f)
                       : metallic * base + dielectric * tint * normal_reflectance * tint_of(base);
    specular->principled.clearcoat = is_inside || thin ? 0.0f : numbers->clearcoat;
    specular->principled.sheen =
        diffuse > 0.0f && !is_inside ? (thin ? diffuse : 1.0f - metallic) * numbers->sheen : 0.0f;
    specular->principled.sheen_tint = numbers->sheen_tint;
    specular->principled.flatness = numbers->flatness;
    specular->principled.clearcoat_gloss = numbers->clearcoat_gloss;
    specular->principled.diff_trans = numbers->diff_trans;
    /* Also black surfaces have sheen. */
    const float least = specular->principled.sheen > 0.0f ? 1e-20f : 0.0f;
    bsdf->kd = is_inside ? (float3)(0.0f) : fmax(diffuse * base, least);
}

/* R and T at a facet that is met with this cosine. */
static inline struct split principled_split(const struct specular *specular, float cos_i)
{
    const float eta = principled_index(specular);
    const struct principled part = specular->principled;
    struct split split;
    float cos_t;
    const float reflectance = fresnel(cos_i, eta, &cos_t);
    const float weight = schlick_weight(eta < 1.0f ? cos_i : cos_t);
    split.reflected =
        part.dielectric * reflectance + mix(specular->ks, (float3)(part.edge), weight);
    split.refracted = (1.0f - reflectance) * specular->kt;
    split.cos_t = cos_t;
    const float r = mean3(split.reflected), t = mean3(split.refracted);
    split.probability = r > 0.0f ? r / (r + t) : 0.0f;
    return split;
}

/* ---- Clearcoat ------------------------------------------------------------------- */

#define RT_CLEARCOAT_MASKING 0.25f /* alpha of GGX */

static inline float clearcoat_alpha(const struct specular *specular)
{
    return mix(0.1f, 1e-3f, specular->principled.clearcoat_gloss);
}

/* 1 / (1 + Lambda), the part of the facets of GGX that is not masked. */
static inline float clearcoat_seen(float3 w)
{
    return fabs(w.z) / ggx_facing(RT_CLEARCOAT_MASKING, w);
}

static inline float clearcoat_density(const struct specular *specular, float3 h)
{
    const float a2 = square(clearcoat_alpha(specular));
    /* 1 - (1 - a2) z^2, which would cancel. */
    const float across = a2 * h.z * h.z + h.x * h.x + h.y * h.y;
    return (a2 - 1.0f) / (RT_PI * log(a2) * across);
}

static inline float clearcoat_reflectance(const struct specular *specular, float cos_i)
{
    float cos_t;
    const float unused = fresnel(cos_i, specular->eta, &cos_t);
    (void)unused;
    return mix(0.04f, 1.0f, schlick_weight(specular->eta < 1.0f ? cos_i : cos_t));
}

/* About what it reflects of light along this cosine. */
static inline float clearcoat_albedo(const struct specular *specular, float cosine)
{
    if (!(specular->principled.clearcoat > 0.0f))
        return 0.0f;
    const float3 w = (float3)(sqrt(fmax(1.0f - cosine * cosine, 0.0f)), 0.0f, cosine);
    return specular->principled.clearcoat * clearcoat_reflectance(specular, cosine) *
           square(fmax(cosine, 0.1f) * clearcoat_seen(w));
}

/* How often it is sampled. */
static inline float clearcoat_share(const struct specular *specular, float3 wo)
{
    const float cosine = clamp(wo.z, 0.0f, 1.0f), coat = clearcoat_albedo(specular, cosine);
    if (!(coat > 0.0f))
        return 0.0f;
    const struct split split = principled_split(specular, cosine);
    return clamp(coat / (coat + mean3(split.reflected + split.refracted)), 0.1f, 0.9f);
}

static inline float3 sample_clearcoat(const struct specular *specular, float2 u)
{
    const float a2 = square(clearcoat_alpha(specular));
    /* The square of the sine, which stays precise near the normal. */
    const float s2 = (exp(log(a2) * (1.0f - u.x)) - a2) / (1.0f - a2);
    const float r = sqrt(clamp(s2, 0.0f, 1.0f));
    const float2 arc = sin_cos(2.0f * RT_PI * u.y);
    return (float3)(r * arc.yx, sqrt(fmax(1.0f - s2, 0.0f)));
}

/* ---- The facets ------------------------------------------------------------------ */

/* 1 / (1 + Lambda) */
static inline float facets_seen(const struct specular *specular, float3 w)
{
    return fabs(w.z) / facing_area(specular, w);
}

/* What facets of normal h, and the clearcoat, reflect from wi to wo, and the density of wi. */
static inline struct lobe_value principled_reflection(const struct specular *specular, float3 wo,
                                                      float3 wi, float3 h)
{
    /* wo.h, which would cancel where both graze. */
    const float cos_h = 0.5f * length(wo + wi), coat = clearcoat_share(specular, wo);
    const struct split split = principled_split(specular, cos_h);
    const float facets = facet_pdf_w(specular, wo, wi, h);
    struct lobe_value lobe;
    lobe.value = split.reflected * (facets * facets_seen(specular, wi));
    lobe.pdf_w = (1.0f - coat) * split.probability * facets;
    if (coat > 0.0f) {
        const float density = 0.25f * clearcoat_density(specular, h);
        lobe.value += specular->principled.clearcoat * density *
                      clearcoat_reflectance(specular, cos_h) * clearcoat_seen(wo) *
                      clearcoat_seen(wi) * wi.z;
        lobe.pdf_w += coat * density * h.z / cos_h;
    }
    return lobe;
}

/* Light that crosses such facets; refracted light is given as flux. */
static inline struct lobe_value principled_refraction(const struct specular *specular, float3 wo,
                                                      float3 wi, float3 h)
{
    const struct split split = principled_split(specular, dot(wo, h));
    const float facets = facet_pdf_w(specular, wo, wi, h);
    struct lobe_value lobe;
    lobe.value = split.refracted * (facets * facets_seen(specular, wi));
    lobe.pdf_w = (1.0f - clearcoat_share(specular, wo)) * (1.0f - split.probability) * facets;
    return lobe;
}

static inline struct lobe_value solid_eval(const struct specular *specular, float3 wo, float3 wi)
{
    float3 h;
    if (!facet_between(specular, wo, wi, &h))
        return no_light();
    return wi.z > 0.0f ? principled_reflection(specular, wo, wi, h)
                       : principled_refraction(specular, wo, wi, h);
}

/* As facets_sample of ggx.h; u.z chooses the clearcoat, too. */
static inline float3 solid_sample(const struct specular *specular, float3 wo, float3 u, float3 *wi,
                                  float *pdf_w)
{
    const float coat = clearcoat_share(specular, wo);
    const bool is_coat = u.z < coat;
    const float3 h = is_coat ? sample_clearcoat(specular, u.xy) : sample_facet(specular, wo, u.xy);
    const float cos_o = dot(wo, h);
    const struct split split = principled_split(specular, cos_o);
    const bool reflects = is_coat || u.z - coat < (1.0f - coat) * split.probability;
    *wi = unit(reflects ? 2.0f * cos_o * h - wo
                        : (specular->eta * cos_o - split.cos_t) * h - specular->eta * wo);
    *pdf_w = 0.0f;
    if (cos_o <= 0.0f || (reflects ? wi->z <= 0.0f : wi->z >= 0.0f))
        return (float3)(0.0f);
    if (reflects) {
        const struct lobe_value lobe = principled_reflection(specular, wo, *wi, h);
        *pdf_w = lobe.pdf_w;
        return lobe.pdf_w > 0.0f ? lobe.value / lobe.pdf_w : (float3)(0.0f);
    }
    const float probability = (1.0f - coat) * (1.0f - split.probability);
    if (!is_matched(specular))
        *pdf_w = probability * facet_pdf_w(specular, wo, *wi, h);
    return split.refracted * (facets_seen(specular, *wi) / probability);
}

#endif
