/*
 * facets.h - Fresnel equations and microfacets, in double precision and by the papers' definitions.
 *
 * References:
 *   Walter, Marschner, Li, Torrance: "Microfacet Models for Refraction through Rough Surfaces",
 *     EGSR 2007.
 *   Heitz: "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2),
 *     2014.
 *   Born, Wolf: "Principles of Optics", 7th ed., sections 1.5.2 and 14.2.
 */
#ifndef RT_TESTS_STATISTICS_FACETS_H
#define RT_TESTS_STATISTICS_FACETS_H

#include "types.h"

/*
 * The share of light that is reflected at this cosine, by a dielectric (eta = n_i / n_t) or a
 * metal.
 */
double dielectric_reflectance(double cosine, double eta);
double metal_reflectance(double cosine, double eta, double k);

/*
 * What a material's boundary reflects and refracts of one channel, met at this cosine from the side
 * with index eta times that of the other.
 */
void boundary_split(const rt_material_data *material, int channel, double cosine, double eta,
                    double *reflected, double *refracted);

/* Microfacets: alpha along the direction of this angle to x, in radians, and across it. */
typedef struct microfacets {
    double alpha_u, alpha_v, turn;
    int is_beckmann;
    int is_separable; /* masked and shadowed apart, else as facets of the same heights are */
} microfacets;

/* Those of a material at alpha, about +z, x along u. */
microfacets microfacets_of(const rt_material_data *material, double alpha);

/*
 * Normals h about +z (Walter et al., equations 25 and 33; Heitz, equations 84 and 85), and the part
 * of them that w sees, by its Lambda (Heitz, equations 72, 81 and 86).
 */
double facet_distribution(const microfacets *facets, const double h[3]);
double facet_masking(const microfacets *facets, const double w[3]);

/* The part that both see, for correlated heights (Heitz, equation 99), or independent ones (98). */
double facets_seen_from_both(const microfacets *facets, const double wo[3], const double wi[3]);

/* The density of normals seen from wo (Heitz, equation 16). */
double visible_density(const microfacets *facets, const double wo[3], const double h[3]);

/* The density of wi by a rough boundary, given that the rough event was chosen. */
double rough_density(const rt_material_data *material, double eta, const double wo[3],
                     const double wi[3]);

#endif
