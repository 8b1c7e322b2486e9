/*
 * shape_truth.h - the shapes of kernels/types.h that a transform places, once more in double
 * and extended precision, by other means than the kernels': what a ray meets.
 */
#ifndef RT_TESTS_KERNELS_SHAPE_TRUTH_H
#define RT_TESTS_KERNELS_SHAPE_TRUTH_H

#include "rt.h"
#include "shape/shapes.h"
#include "types.h"

/* A shape in object space and the map to the world. */
typedef struct truth_shape {
    rt_u32 kind;
    double p; /* disc: the hole; cone: radius at the top; torus: minor radius */
    int caps;
    rt_transform to_world;
    double to_object[3][4];
} truth_shape;

typedef struct truth_hit {
    double t;                      /* infinite: none */
    double position[3], normal[3]; /* in object space, unit */
} truth_hit;

/* Places the shape; the map must have an inverse. */
void truth_place(truth_shape *shape, const rt_transform *to_world);

/*
 * The ray's origin and direction in object space. Returns the length of the direction there.
 */
double truth_ray(const truth_shape *shape, const rt_ray *ray, double o[3], double d[3]);

/*
 * The nearest hit with t >= 0 of the shape with radii larger by `wider` and its length at both ends
 * by `longer`; the disc is raised by `wider`, and its hole smaller by `longer`.
 */
truth_hit truth_nearest(const truth_shape *shape, double wider, double longer, const rt_ray *ray);

/* The normal in the world, of unit length. */
void truth_normal(const truth_shape *shape, const double normal[3], double out[3]);

/* u and v as the public header states; 0 when they have no value there. */
int truth_parameters(const truth_shape *shape, const truth_hit *hit, double uv[2]);

#endif
