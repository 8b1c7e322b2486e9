/*
 * microfacet.inc.h - the functions of the GGX distribution, width-generic (see math/width1.inc.h);
 * microfacet.h has their conventions and references.
 */

/* Density of normals: the integral of D(h) h.z over the hemisphere is 1. */
static inline REAL W(ggx_density)(REAL alpha, VEC3 h)
{
    const REAL a2 = alpha * alpha;
    const REAL p2 = a2 * h.z * h.z + h.x * h.x + h.y * h.y;
    return a2 / (RT_PI * (p2 * p2));
}

/*
 * Projected area, along w, of the microfacets facing w per unit of macrosurface area, masked ones
 * included: |w.z| (1 + Lambda(w)), with Smith's Lambda. |w.z| of it is visible. Unlike Lambda it is
 * finite for a w that only grazes the surface.
 */
static inline REAL W(ggx_facing)(REAL alpha, VEC3 w)
{
    return 0.5f * (fabs(w.z) + sqrt(w.z * w.z + alpha * alpha * (w.x * w.x + w.y * w.y)));
}

/*
 * The masked part of it, |w.z| Lambda(w); as a quotient, because the difference of the two would
 * cancel.
 */
static inline REAL W(ggx_hidden)(REAL alpha, VEC3 w)
{
    return 0.25f * alpha * alpha * (w.x * w.x + w.y * w.y) / W(ggx_facing)(alpha, w);
}

/*
 * G2 / G1, the probability that a microfacet visible from wo is not shadowed from wi; for
 * correlated heights, (1 + Lambda(wo)) / (1 + Lambda(wo) + Lambda(wi)), times |wo.z wi.z| above and
 * below. facing: the projected area of the facets that face wo; hidden: the masked part of those
 * that face wi
 */
static inline REAL W(unshadowed)(REAL facing, REAL hidden, VEC3 wo, VEC3 wi)
{
    const REAL seen = facing * fabs(wi.z);
    return seen / (seen + fabs(wo.z) * hidden);
}

/* The same where G2 is separable, the product of masking and shadowing: G1 of wi. */
static inline REAL W(unshadowed_alone)(REAL hidden, VEC3 wi)
{
    return fabs(wi.z) / (fabs(wi.z) + hidden);
}

/*
 * A normal among those that wo, wo.z >= 0, can see: density D(h) (wo.h) / ggx_facing(wo). Stretched
 * to roughness 1 the surface is a hemisphere of which wo sees a cap of mirror directions, uniform
 * in solid angle. alpha: along x and y.
 */
static inline VEC3 W(sample_visible_normal)(VEC2 alpha, VEC3 wo, VEC2 u)
{
    const VEC3 seen = W(unit)(VEC3_OF(alpha.x * wo.x, alpha.y * wo.y, wo.z));
    const REAL z = 1.0f - u.x * (1.0f + seen.z);
    const VEC2 arc = W(sin_cos)(2.0f * RT_PI * u.y);
    const REAL r2 = (1.0f - z) * (1.0f + z);
    const REAL r = sqrt(r2 > 0.0f ? r2 : (REAL)(0.0f));
    const VEC3 h = ADD3(VEC3_OF(r * arc.y, r * arc.x, z), seen);
    const REAL up = h.z > 1e-12f ? h.z : (REAL)(1e-12f);
    return W(unit)(VEC3_OF(alpha.x * h.x, alpha.y * h.y, up));
}
