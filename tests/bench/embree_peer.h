/*
 * embree_peer.h - the same work by Embree, for comparison. Built without RT_HAVE_EMBREE, there is
 * none.
 */
#ifndef RT_TESTS_BENCH_EMBREE_PEER_H
#define RT_TESTS_BENCH_EMBREE_PEER_H

#include <stddef.h>
#include <stdint.h>

#include "rt.h"

typedef struct embree_peer embree_peer;

/*
 * NULL when built without Embree, or when it does not start. Keeps the arrays: positions has 16
 * bytes behind it.
 */
embree_peer *embree_peer_create(const float *positions, uint32_t vertices, const uint32_t *indices,
                                uint32_t triangles, uint32_t threads);
void embree_peer_destroy(embree_peer *peer);

/* Builds at medium quality, anew each time. */
void embree_peer_build(embree_peer *peer);

/*
 * Follows the rays on the peer's threads by rtcIntersect1; fills t, prim, u, v and normal of each
 * hit.
 */
void embree_peer_trace(embree_peer *peer, const rt_ray *rays, size_t count, rt_hit *hits);

#endif
