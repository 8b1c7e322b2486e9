/* path_state.h - paths from the eye: what one carries from vertex to vertex. */
#ifndef RT_KERNELS_INTEGRATE_PATH_STATE_H
#define RT_KERNELS_INTEGRATE_PATH_STATE_H

#include "math/ray.h"
#include "sample/rng.h"
#include "types.h"

/* A path under way: what it carries from one vertex to the next. */
struct path {
    struct sampler sampler;
    struct ray ray;  /* of unit direction */
    float3 from;     /* the vertex before: where the ray began */
    float3 radiance; /* gathered so far */
    float3 beta;     /* throughput, without the change of radiance at refraction */
    float eta_scale; /* which is kept here, and means nothing to roulette */
    float pdf_w;     /* density of the ray's direction, 0 for the camera and delta events */
    uint4 media;     /* the solids it is inside of */
    uint depth;      /* segments, the one under way included; 0: the path has ended */
    uint hidden;     /* boundaries crossed that a stronger medium hides */
    uint diffuse_events;
    bool scattered; /* by an event other than a delta one */
    bool rough;     /* by a rough event since the last diffuse one */
};

/*
 * A vertex joined with a sampled point of a light, before it is known whether anything is in
 * between.
 */
struct connection {
    struct ray ray;
    float3 radiance; /* that the light adds to the path's; 0: there is nothing to ask */
};

#endif
