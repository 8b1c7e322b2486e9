/*
 * facet_loss.h - the light that microfacets lose where they scatter it once: what would meet a
 * second one.
 */
#ifndef RT_LIB_PACK_FACET_LOSS_H
#define RT_LIB_PACK_FACET_LOSS_H

/* Microfacets, with alpha along x and along y. */
typedef struct rt_facets {
    double alpha_u, alpha_v; /* above 0 */
    int is_beckmann;         /* else GGX */
    double eta;              /* index on the side of the view over the other; 0: all is reflected */
} rt_facets;

/*
 * The part of the light that is lost, seen at this cosine above 0 from a direction that is turned
 * by this angle from x, in radians. Its error is below 0.002.
 */
double rt_facet_loss(const rt_facets *facets, double cosine, double turn);

#endif
