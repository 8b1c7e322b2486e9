/*
 * microfacet.h - the GGX distribution of microfacets about +z, with Smith's masking.
 *
 * Directions are unit vectors in the frame of the surface. alpha > 0 is the roughness. All is
 * written so that it stays precise in float32 down to RT_SMOOTH_ALPHA.
 *
 * References:
 *   Walter, Marschner, Li, Torrance: "Microfacet Models for Refraction through Rough Surfaces",
 *     EGSR 2007.
 *   Heitz: "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2),
 *     2014.
 *   Dupuy, Benyoub: "Sampling Visible GGX Normals with Spherical Caps", HPG 2023.
 */
#ifndef RT_KERNELS_BSDF_MICROFACET_H
#define RT_KERNELS_BSDF_MICROFACET_H

#include "math/frame.h"
#include "sample/sample.h"
#include "math/width1.inc.h"
#include "bsdf/microfacet.inc.h"

#endif
