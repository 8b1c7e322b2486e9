/* facets.c - Fresnel's equations, and the distribution and masking of microfacets. */
#include "statistics/facets.h"

#include <complex.h>

#include "statistics/space.h"

double dielectric_reflectance(double cosine, double eta)
{
    const double sine2 = eta * eta * (1 - cosine * cosine);
    if (sine2 >= 1)
        return 1;
    const double beyond = sqrt(1 - sine2);
    const double s = (eta * cosine - beyond) / (eta * cosine + beyond);
    const double p = (eta * beyond - cosine) / (eta * beyond + cosine);
    return (s * s + p * p) / 2;
}

/* |z|^2 */
static double square_of(double complex z)
{
    return creal(z) * creal(z) + cimag(z) * cimag(z);
}

double metal_reflectance(double cosine, double eta, double k)
{
    const double complex index = eta + k * I, beyond = csqrt(index * index - (1 - cosine * cosine));
    const double complex steep = index * index * cosine;
    const double s2 = square_of(cosine - beyond) / square_of(cosine + beyond);
    const double p2 = square_of(steep - beyond) / square_of(steep + beyond);
    return (s2 + p2) / 2;
}

/* What ks reflects of one channel in a medium of this index. */
static double base_reflectance(const rt_material_data *m, int channel, double cosine, double index)
{
    if (m->flags & RT_MATERIAL_SCHLICK)
        return m->ks[channel] + (1 - m->ks[channel]) * pow(1 - cosine, 5);
    const double metal =
        m->flags & RT_MATERIAL_CONDUCTOR
            ? metal_reflectance(cosine, m->eta[channel] / index, m->k[channel] / index)
            : 1;
    return m->ks[channel] * metal;
}

/* By Snell's law, below a coat. */
static double cosine_below(const rt_material_data *m, double cosine, double eta)
{
    const double across = eta / m->coat_ior;
    return sqrt(1 - across * across * (1 - cosine * cosine));
}

/* What a lacquer reflects as a mirror, and what its facets do: kernels/bsdf/lacquer.h. */
static void lacquer_split(const rt_material_data *m, int channel, double cosine, double eta,
                          double *mirror, double *facets)
{
    const double f = dielectric_reflectance(cosine, eta / m->coat_ior);
    const double b = base_reflectance(m, channel, cosine_below(m, cosine, eta), m->coat_ior);
    const double below = m->coat * (1 - f) * (1 - f) * b / (1 - f * (b + m->kd[channel])),
                 bare = (1 - m->coat) * base_reflectance(m, channel, cosine, eta);
    const int is_coat_rough = m->coat_roughness > 0, is_rough = m->roughness > 0;
    *mirror = (is_coat_rough ? 0 : m->coat * f) + (is_coat_rough || is_rough ? 0 : below) +
              (is_rough ? 0 : bare);
    *facets = m->coat * f + below + bare - *mirror;
}

void boundary_split(const rt_material_data *material, int channel, double cosine, double eta,
                    double *reflected, double *refracted)
{
    if (material->flags & RT_MATERIAL_LACQUER) {
        lacquer_split(material, channel, cosine, eta, reflected, refracted);
        return;
    }
    const double ks = material->ks[channel], kt = material->kt[channel];
    if (material->flags & RT_MATERIAL_CONDUCTOR) {
        *reflected = base_reflectance(material, channel, cosine, eta);
        *refracted = 0;
        return;
    }
    const double share = dielectric_reflectance(cosine, eta);
    const int is_split = (material->flags & RT_MATERIAL_FRESNEL) || share >= 1;
    *reflected = is_split ? share * (ks + kt) : ks;
    *refracted = is_split ? (1 - share) * (ks + kt) : kt;
}

microfacets microfacets_of(const rt_material_data *material, double alpha)
{
    microfacets facets = {.alpha_u = alpha,
                          .alpha_v = alpha,
                          .is_beckmann = (material->flags & RT_MATERIAL_BECKMANN) != 0,
                          .is_separable = (material->flags & RT_MATERIAL_SEPARABLE) != 0};
    if (material->flags & RT_MATERIAL_ANISOTROPIC) {
        facets.alpha_v = material->roughness_v;
        facets.turn = atan2(material->facet_turn[1], material->facet_turn[0]);
    }
    return facets;
}

/* Coordinates along the two directions of roughness. */
static void turn_to_facets(const microfacets *facets, const double w[3], double *along,
                           double *across)
{
    *along = cos(facets->turn) * w[0] + sin(facets->turn) * w[1];
    *across = cos(facets->turn) * w[1] - sin(facets->turn) * w[0];
}

double facet_distribution(const microfacets *facets, const double h[3])
{
    double along, across;
    turn_to_facets(facets, h, &along, &across);
    const double cos2 = h[2] * h[2], area = PI * facets->alpha_u * facets->alpha_v * cos2 * cos2;
    const double x = along / facets->alpha_u, y = across / facets->alpha_v,
                 slope2 = (x * x + y * y) / cos2;
    if (!(h[2] > 0))
        return 0;
    return facets->is_beckmann ? exp(-slope2) / area : 1 / (area * (1 + slope2) * (1 + slope2));
}

/* Lambda, of masking by Smith's model. */
static double masked_per_seen(const microfacets *facets, const double w[3])
{
    double along, across;
    turn_to_facets(facets, w, &along, &across);
    const double alpha_tan = distance(facets->alpha_u * along, facets->alpha_v * across) / w[2];
    const double a = 1 / fabs(alpha_tan);
    if (facets->is_beckmann)
        return (erf(a) - 1) / 2 + exp(-a * a) / (2 * a * sqrt(PI));
    return (sqrt(1 + alpha_tan * alpha_tan) - 1) / 2;
}

double facet_masking(const microfacets *facets, const double w[3])
{
    return 1 / (1 + masked_per_seen(facets, w));
}

double facets_seen_from_both(const microfacets *facets, const double wo[3], const double wi[3])
{
    if (facets->is_separable)
        return facet_masking(facets, wo) * facet_masking(facets, wi);
    return 1 / (1 + masked_per_seen(facets, wo) + masked_per_seen(facets, wi));
}

double visible_density(const microfacets *facets, const double wo[3], const double h[3])
{
    return facet_masking(facets, wo) * fmax(0, dot3(wo, h)) * facet_distribution(facets, h) / wo[2];
}

/* The probability of reflection at a facet, by the mean of the channels. */
static double reflection_chance(const rt_material_data *material, double cosine, double eta)
{
    double r = 0, t = 0, reflected, refracted;
    if (material->flags & RT_MATERIAL_CONDUCTOR)
        return 1;
    for (int c = 0; c < 3; c++) {
        boundary_split(material, c, cosine, eta, &reflected, &refracted);
        r += reflected;
        t += refracted;
    }
    return r + t > 0 ? r / (r + t) : 0;
}

/* The density of wi by facets that reflect. */
static double mirror_density(const microfacets *facets, const double wo[3], const double wi[3])
{
    double h[3];
    for (int i = 0; i < 3; i++)
        h[i] = wo[i] + wi[i];
    normalise(h);
    return visible_density(facets, wo, h) / (4 * dot3(wo, h));
}

/* The direction of w below a coat. */
static void enter_coat(const rt_material_data *m, double eta, const double w[3], double below[3])
{
    below[0] = w[0] * eta / m->coat_ior;
    below[1] = w[1] * eta / m->coat_ior;
    below[2] = cosine_below(m, w[2], eta);
}

/* That of a lacquer: by its coat, by what lies below, or by what lies bare. */
static double lacquer_density(const rt_material_data *m, double eta, const double wo[3],
                              const double wi[3])
{
    const double f = dielectric_reflectance(wo[2], eta / m->coat_ior), across = eta / m->coat_ior;
    const double blur = (1 - across) * m->coat_roughness / sqrt(2);
    const microfacets coat = {.alpha_u = m->coat_roughness, .alpha_v = m->coat_roughness},
                      below = microfacets_of(m, hypot(m->roughness, blur)),
                      bare = microfacets_of(m, m->roughness);
    double parts[3] = {m->coat_roughness > 0 ? m->coat * f : 0, 0, 0}, in[3], out[3];
    enter_coat(m, eta, wo, out);
    enter_coat(m, eta, wi, in);
    for (int c = 0; c < 3; c++) {
        parts[1] += m->coat * (1 - f) * base_reflectance(m, c, out[2], m->coat_ior) / 3;
        parts[2] += (1 - m->coat) * base_reflectance(m, c, wo[2], eta) / 3;
    }
    const double sum = parts[0] + parts[1] + parts[2];
    const double spread = across * across * wi[2] / in[2];
    return wi[2] > 0 ? ((parts[0] > 0 ? parts[0] * mirror_density(&coat, wo, wi) : 0) +
                        parts[1] * spread * mirror_density(&below, out, in) +
                        parts[2] * mirror_density(&bare, wo, wi)) /
                           sum
                     : 0;
}

double rough_density(const rt_material_data *material, double eta, const double wo[3],
                     const double wi[3])
{
    if (material->flags & RT_MATERIAL_LACQUER)
        return lacquer_density(material, eta, wo, wi);
    const int reflects = wi[2] > 0;
    double h[3];
    for (int i = 0; i < 3; i++)
        h[i] = reflects ? wo[i] + wi[i] : eta * wo[i] + wi[i];
    if (h[2] < 0)
        for (int i = 0; i < 3; i++)
            h[i] = -h[i];
    normalise(h);
    const double cos_o = dot3(wo, h), cos_i = dot3(wi, h);
    if (cos_o <= 0 || wi[2] == 0 || (cos_i > 0) != reflects)
        return 0;
    const double chance = reflection_chance(material, cos_o, eta);
    /* How normals spread over directions: equations 14 and 17 of Walter et al. */
    const double bent = eta * cos_o + cos_i;
    const double spread = reflects ? 1 / (4 * cos_o) : fabs(cos_i) / (bent * bent);
    const microfacets facets = microfacets_of(material, material->roughness);
    return (reflects ? chance : 1 - chance) * spread * visible_density(&facets, wo, h);
}
