/*
 * facet_loss.h - the light that microfacets reflect, refract and lose where they scatter it once:
 * what would meet a second one.
 */
#ifndef RT_LIB_PACK_FACET_LOSS_H
#define RT_LIB_PACK_FACET_LOSS_H

/* Microfacets, with alpha along x and along y. */
typedef struct rt_facets {
    double alpha_u, alpha_v; /* above 0 */
    int is_beckmann;         /* else GGX */
    double eta;              /* index on the side of the view over the other; 0: all is reflected */
    int is_separable;        /* masking and shadowing are multiplied, else of the same heights */
} rt_facets;

/*
 * The part of the light that is lost, seen at this cosine above 0 from a direction that is turned
 * by this angle from x, in radians. Its error is below 0.002.
 */
double rt_facet_loss(const rt_facets *facets, double cosine, double turn);

/* The part that they reflect, and that they refract, likewise. */
double rt_facet_reflected(const rt_facets *facets, double cosine);
double rt_facet_refracted(const rt_facets *facets, double cosine);

/* The part of the light that enters or leaves a coat at this cosine outside. */
typedef double rt_coat_passes(const void *coat, double cosine);

/*
 * The part of the light that leaves a coat over such facets, which reflect all, by
 * kernels/bsdf/lacquer.h; eta: the index before the coat over its own; cosine: that outside.
 */
double rt_facet_covered(const rt_facets *facets, double eta, double cosine, double turn,
                        rt_coat_passes *passes, const void *coat);

/* The reflectance of a smooth surface between two media, for a cosine and eta as above. */
double rt_smooth_reflectance(double cosine, double eta);

#endif
