/*
 * emitters.h - area lights of every shape, with a parametrisation of each over the unit square.
 *
 * Shapes with three parts (side, base and top) have a third of x for each.
 */
#ifndef RT_TESTS_STATISTICS_EMITTERS_H
#define RT_TESTS_STATISTICS_EMITTERS_H

#include "render/renderer.h"

typedef enum emitter {
    EMIT_RECTANGLE, /* in the plane y = 2, emitting downwards */
    EMIT_TWO_SIDED, /* the same rectangle */
    EMIT_PARALLELOGRAM,
    EMIT_TRIANGLE,
    EMIT_MESH, /* a strip of triangles of different sizes */
    EMIT_SPHERE,
    EMIT_ELLIPSOID, /* this, the disc and the torus are placed by a skew transform */
    EMIT_DISC,      /* with a hole */
    EMIT_TORUS,
    EMIT_PIPE,
    EMIT_CYLINDER,
    EMIT_CONE,
    EMIT_FRUSTUM,
    EMIT_BOX /* a face for each sixth of x */
} emitter;

/* The radiance of all, in every channel. */
#define EMITTED_RADIANCE 2.0

/* A scene of nothing but the emitter. */
rt_scene *emitter_scene(emitter kind);

/* The point of the emitter with these parameters. */
void emitter_point(emitter kind, double x, double y, double out[3]);

/* Parameters of a point with this normal. */
void emitter_place(emitter kind, const float position[3], const float normal[3], double *x,
                   double *y);

/* Area of the world that an area of parameters around a point stands for. */
double emitter_element(emitter kind, double x, double y);

/* The normal of the parametrised surface, unit, on either side. */
void emitter_normal(emitter kind, double x, double y, double out[3]);

/*
 * The density over the parameters of points that are chosen by area: a mesh's and all of its
 * triangles', a cylinder's and cone's and all of its parts', and the ellipsoid's, disc's and torus'
 * own before the transform.
 */
double emitter_density(emitter kind, double x, double y);

/*
 * A renderer of the scene that `build` makes of a key; the last is kept, and is the same for the
 * same key.
 */
rt_renderer *kept_renderer(const void *key, rt_scene *(*build)(const void *key));

#endif
