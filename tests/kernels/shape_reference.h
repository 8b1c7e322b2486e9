/*
 * shape_reference.h - the hits of rays on the placed shapes of kernels/shape/shapes.h, in double
 * and extended precision and by other methods than the kernels'.
 */
#ifndef RT_TESTS_KERNELS_SHAPE_REFERENCE_H
#define RT_TESTS_KERNELS_SHAPE_REFERENCE_H

#include "rt.h"
#include "shape/shapes.h"
#include "types.h"

/* A shape in object space and the map to the world. */
typedef struct reference_shape {
    rt_u32 kind;
    double p; /* disc: the hole; cone: radius at the top; torus: minor radius */
    int caps;
    rt_transform to_world;
    double to_object[3][4];
} reference_shape;

typedef struct reference_hit {
    double t;                      /* infinite: none */
    double position[3], normal[3]; /* in object space, unit */
} reference_hit;

/* Places the shape; the map must have an inverse. */
void reference_place(reference_shape *shape, const rt_transform *to_world);

/*
 * The ray's origin and direction in object space. Returns the length of the direction there.
 */
double reference_ray(const reference_shape *shape, const rt_ray *ray, double o[3], double d[3]);

/*
 * The nearest hit with t >= 0 of the shape with radii larger by `wider` and its length at both ends
 * by `longer`; the disc is raised by `wider`, and its hole smaller by `longer`.
 */
reference_hit reference_nearest(const reference_shape *shape, double wider, double longer,
                                const rt_ray *ray);

/* The normal in the world, of unit length. */
void reference_normal(const reference_shape *shape, const double normal[3], double out[3]);

/* u and v as the public header states; 0 when they have no value there. */
int reference_parameters(const reference_shape *shape, const reference_hit *hit, double uv[2]);

#endif
