/*
 * multiple.h - light that meets more than one facet of a rough boundary.
 *
 * Facets that scatter light once lose the part l(w) of it, seen from w: what would meet another
 * facet (ggx.h). It leaves in directions of its own, in proportion to what is lost from there, so
 * that scattering is reciprocal, on both sides of a boundary in proportion to what they lose of
 * light that is as bright, n^2 L, with n the index of a side and L the mean of its l:
 *
 *   fr |n.wi| = c l(wo) l(wi) |n.wi| / pi  n_i^2 / (n_o^2 L_o + n_t^2 L_t),  L = 2 int l(u) u du
 *
 * as flux, with i the side of wi, o that of wo and t the other; of facets that reflect alone
 * n_t^2 L_t is 0. Over both sides that is c l(wo): a white surface is white. Of others c is the
 * colour of what meets two facets or more, of which the part E = 1 - (n_o^2 L_o + n_t^2 L_t) /
 * (n_o^2 + n_t^2) leaves each time, on average:
 *
 *   c = k^2 E / (1 - k (1 - E)),  k = ks + kt, times the mean reflectance of a metal
 *
 * The host tabulates l, of which types.h says more. Directions are sampled with probability l(wo),
 * but at most a half, near to where light is lost, on either side by what it gets, else by facets:
 * where these lose most light, the rest comes from few that are seen, whose weights are large.
 *
 * Reference:
 *   Kulla, Conty: "Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017 course
 *     "Physically Based Shading in Theory and Practice".
 */
#ifndef RT_KERNELS_BSDF_MULTIPLE_H
#define RT_KERNELS_BSDF_MULTIPLE_H

#include "bsdf/distribution.h"
#include "bsdf/lobe.h"
#include "math/width1.inc.h"
#include "bsdf/multiple.inc.h"

/* Relative difference up to which an index is that of a pair of media. */
#define RT_SAME_INDEX 1e-4f
#define RT_NEAR_INDEX 0.1f /* and up to which it is, of some wavelength */

/* What facets scatter from wi to wo. */
struct facets_value {
    float3 value;     /* fr |n.wi|, as flux */
    float pdf_w;      /* density of wi, */
    float back_pdf_w; /* and of wo on the way back, seen from wi */
};

/* What is scattered on of the light seen from wo. */
struct multiple {
    float loss;                /* l(wo); 0: none */
    float reflects, refracts;  /* n_i^2 / (n_o^2 L_o + n_t^2 L_t) above and below */
    float share;               /* the part that is reflected */
    float left;                /* E */
    global const float *above; /* the losses seen from there, */
    global const float *below; /* and from the other side; NULL: facets reflect alone */
};

static inline bool scatters_often(const struct specular *specular)
{
    return specular->material->facet_losses != 0u && !is_coated(specular->material);
}

static inline global const rt_facet_losses *losses_of(global const rt_material_data *material)
{
    return (global const rt_facet_losses *)((global const uchar *)material +
                                            material->facet_losses);
}

/* The table behind that of a lacquer's coat, or behind that again; NULL: there is none. */
static inline global const rt_facet_losses *next_losses(global const rt_facet_losses *table)
{
    return table && table->next > 0u
               ? (global const rt_facet_losses *)((global const uchar *)table + table->next)
               : NULL;
}

/* Of a lacquer, that of its facets below the coat. */
static inline global const rt_facet_losses *lacquer_losses(global const rt_material_data *material)
{
    return material->facet_losses != 0u ? next_losses(losses_of(material)) : NULL;
}

/* What facets of this k, ks + kt, reflect on the average. */
static inline float3 mean_of_facets(global const rt_facet_losses *table, float3 k)
{
    return k * row3(table->mean_reflectance) + table->black_reflectance;
}

/*
 * The loss seen from w, and the mean over its side. has_directions: facets are anisotropic; least:
 * 0, or RT_COAT_SPREAD of a table of coats.
 */
static inline float2 loss_seen(global const rt_facet_losses *table, bool has_directions,
                               float2 alpha, float least, global const float *losses, float3 w)
{
    const float sine = length(w.xy), last = (float)(table->rows - 1u);
    const float along = has_directions && sine > 0.0f ? length(alpha * w.xy) / sine : alpha.x;
    const float smaller = fmin(alpha.x, alpha.y), larger = fmax(alpha.x, alpha.y);
    const float part = has_directions ? sqrt(fmax(along - smaller, 0.0f) / (larger - smaller))
                                      : along / table->largest_alpha;
    const float y = table->rows > 1u ? clamp(part, 0.0f, 1.0f) * last : 0.0f;
    const float x =
        fmin(RT_LOSS_PLACE(fabs(w.z), fmax(along, least)), 1.0f) * (float)(RT_LOSS_COSINES - 1u);
    return loss_between(losses, table->rows, x, y);
}

/* The difference up to which eta is that of a pair; dispersion takes the nearest pair's losses. */
static inline float index_tolerance(global const float *pair, uint pairs, uint side, float eta)
{
    float tolerance = RT_SAME_INDEX;
#ifdef RT_DISPERSION
    tolerance = RT_NEAR_INDEX;
    for (uint i = 0u; i < pairs; i++, pair += 1u + 2u * side)
        tolerance =
            fmin(tolerance, 1.00001f * fmin(fabs(eta - pair[0]) / eta, fabs(eta * pair[0] - 1.0f)));
    tolerance = fmax(tolerance, RT_SAME_INDEX);
#endif
    return tolerance;
}

/* Finds the losses for a boundary of this eta; false: it is between other media. */
static inline bool find_losses(global const rt_facet_losses *table, float eta,
                               struct multiple *multiple)
{
    const uint side = table->rows * (RT_LOSS_COSINES + 1u);
    global const float *pair = (global const float *)(table + 1);
    const float tolerance = index_tolerance(pair, table->pairs, side, eta);
    for (uint i = 0u; i < table->pairs; i++, pair += 1u + 2u * side) {
        const bool is_inside = fabs(eta - pair[0]) <= tolerance * eta;
        if (pair[0] == 0.0f || is_inside || fabs(eta * pair[0] - 1.0f) <= tolerance) {
            multiple->above = pair + 1u + (is_inside ? side : 0u);
            multiple->below = pair[0] == 0.0f ? NULL : pair + 1u + (is_inside ? 0u : side);
            return true;
        }
    }
    return false;
}

/* The logarithm of lost_pdf_w, which the host knows where alpha is the same everywhere. */
static inline float lost_range(global const rt_facet_losses *table, float2 alpha)
{
    const float range = table->range;
    return range > 0.0f ? range : log(1.0f + 1.0f / (alpha.x * alpha.y));
}

static inline float3 sample_lost(float2 alpha, float range, float2 u)
{
    const float s2 = alpha.x * alpha.y;
    const float z2 = clamp(s2 * expm1(u.x * range), 0.0f, 1.0f);
    const float2 arc = sin_cos(2.0f * RT_PI * u.y);
    const float r = sqrt(1.0f - z2);
    return (float3)(r * arc.y, r * arc.x, sqrt(z2));
}

static inline struct multiple multiple_seen(global const rt_material_data *material, float2 alpha,
                                            float eta, float3 wo)
{
    struct multiple multiple;
    multiple.loss = multiple.reflects = multiple.refracts = multiple.left = 0.0f;
    multiple.share = 1.0f;
    global const rt_facet_losses *table = losses_of(material);
    if (!find_losses(table, eta, &multiple))
        return multiple;
    const bool reflects_alone = multiple.below == NULL, has_directions = is_anisotropic(material);
    const float2 here = loss_seen(table, has_directions, alpha, 0.0f, multiple.above, wo);
    const float there =
        reflects_alone ? 0.0f : loss_seen(table, has_directions, alpha, 0.0f, multiple.below, wo).y;
    const float area = reflects_alone ? 1.0f : eta * eta, mean = area * here.y + there;
    if (!(mean > 0.0f))
        return multiple;
    multiple.loss = here.x;
    multiple.reflects = area / mean;
    multiple.refracts = reflects_alone ? 0.0f : 1.0f / mean;
    multiple.share = multiple.reflects * here.y;
    multiple.left = 1.0f - mean / (reflects_alone ? 1.0f : area + 1.0f);
    return multiple;
}

/* These take values, as distribution.h says of others. */

RARELY_CALLED struct multiple multiple_from(global const rt_material_data *material, float2 alpha,
                                            float eta, float3 wo)
{
    return multiple_seen(material, alpha, eta, wo);
}

/*
 * Adds what is scattered on, as flux, to what facets scatter once, of these densities. k: ks + kt.
 * From wi the side of wo is chosen by share, on whichever side wi is.
 */
RARELY_CALLED struct facets_value add_multiple(global const rt_material_data *material,
                                               float2 alpha, float eta, float3 k, float3 wo,
                                               float3 wi, float3 value, float pdf_w,
                                               float back_pdf_w)
{
    struct facets_value once;
    once.value = value;
    once.pdf_w = pdf_w;
    once.back_pdf_w = back_pdf_w;
    const struct multiple multiple = multiple_seen(material, alpha, eta, wo);
    const bool above = wi.z > 0.0f;
    const float factor = above ? multiple.reflects : multiple.refracts;
    if (!(factor > 0.0f))
        return once;
    global const rt_facet_losses *table = losses_of(material);
    const float loss = loss_seen(table, is_anisotropic(material), alpha, 0.0f,
                                 above ? multiple.above : multiple.below, wi)
                           .x;
    const float3 colour = colour_of_lost(mean_of_facets(table, k), (float3)(multiple.left));
    const float cos_o = fabs(wo.z), cos_i = fabs(wi.z), range = lost_range(table, alpha);
    const float often = often_probability(multiple.loss), back = often_probability(loss);
    const float share = multiple.share;
    once.value += colour * (multiple.loss * loss * factor * cos_i / RT_PI);
    once.pdf_w = (1.0f - often) * once.pdf_w +
                 often * (above ? share : 1.0f - share) * lost_pdf_w(alpha, range, cos_i);
    once.back_pdf_w =
        (1.0f - back) * once.back_pdf_w + back * share * lost_pdf_w(alpha, range, cos_o);
    return once;
}

static inline struct multiple multiple_of(const struct specular *specular, float3 wo)
{
    return multiple_from(specular->material, both_alphas(specular), specular->eta, wo);
}

static inline struct facets_value with_multiple(const struct specular *specular, float3 wo,
                                                float3 wi, struct facets_value once)
{
    return add_multiple(specular->material, both_alphas(specular), specular->eta,
                        specular->ks + specular->kt, wo, wi, once.value, once.pdf_w,
                        once.back_pdf_w);
}

#endif
