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

/*
 * GGX over normals h about +z (Walter et al., equation 33), and the part of them that w sees
 * (Heitz, equation 72).
 */
double facet_distribution(double alpha, const double h[3]);
double facet_masking(double alpha, const double w[3]);

/* The density of normals seen from wo (Heitz, equation 16). */
double visible_density(double alpha, const double wo[3], const double h[3]);

/* The density of wi by a rough boundary, given that the rough event was chosen. */
double rough_density(const rt_material_data *material, double eta, const double wo[3],
                     const double wi[3]);

#endif
