/* queries.h - the queries of photon maps that an eye path makes, each with its own gatherer. */
#ifndef RT_LIB_MODE_PHOTON_QUERIES_H
#define RT_LIB_MODE_PHOTON_QUERIES_H

#include "mode/photon/bias.h"
#include "photon/gather.h"

typedef enum rt_query {
    RT_QUERY_GLOBAL,  /* the global map, where the path ends */
    RT_QUERY_CAUSTIC, /* the caustic map, at the same points, where there is one */
    RT_QUERY_EARLIER, /* caustic photons alone, at the earlier vertices of a final gather */
    RT_QUERIES
} rt_query;

/* The gatherers; NULL for queries that are not made. All zero is none. */
typedef struct rt_queries {
    rt_gatherer *gatherers[RT_QUERIES];
    rt_finer finer[RT_QUERIES]; /* for the layer photon.bias */
} rt_queries;

/* Frees all gatherers. */
void rt_queries_close(rt_queries *queries);

/* The number of points that all gatherers can take at once, at most `capacity`. */
size_t rt_queries_capacity(const rt_queries *queries, size_t capacity);

#endif
