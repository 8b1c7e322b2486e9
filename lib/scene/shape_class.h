/*
 * shape_class.h - the interface of the shapes: the functions that each kind of shape has on the
 * host. lib/shape implements them, a file for each kind of kernels/shape/shapes.h.
 */
#ifndef RT_LIB_SCENE_SHAPE_CLASS_H
#define RT_LIB_SCENE_SHAPE_CLASS_H

#include "scene/scene.h"

/* Where the geometry of a shape is kept on the device. */
typedef enum rt_shape_storage {
    RT_STORED_MESH,     /* triangles in blocks, or an instance of the mesh's own tree */
    RT_STORED_QUAD,     /* one parallelogram in a block */
    RT_STORED_ANALYTIC, /* a leaf of the tree, found by its bounds */
    RT_STORED_INFINITE  /* beside the tree */
} rt_shape_storage;

/* What a shape bounds. */
typedef enum rt_shape_boundary {
    RT_BOUNDARY_SOLID,        /* a solid, by itself */
    RT_BOUNDARY_HALF_SPACE,   /* all that lies behind it */
    RT_BOUNDARY_FLAT,         /* nothing; three more flat shapes may close a solid with it */
    RT_BOUNDARY_CURVED,       /* nothing; one more shape may close a solid with it */
    RT_BOUNDARY_CURVED_CLOSED /* a solid, or part of one whose other shapes touch it */
} rt_shape_boundary;

/* The forms of faces: only faces of the same form can coincide. */
enum {
    RT_FACES_FLAT = 1,
    RT_FACES_BALL = 2,    /* of spheres and ellipsoids */
    RT_FACES_FRUSTUM = 4, /* the sides of cylinders and cones */
    RT_FACES_TORUS = 8
};

typedef struct rt_shape_class {
    const char *name; /* as messages name it */
    rt_shape_storage storage;
    unsigned faces; /* RT_FACES_*; flat ones of a frustum are its caps, where it has them */
    rt_shape_boundary (*boundary)(const rt_scene *scene, const rt_scene_shape *shape);
    /*
     * Whether a point of the world within its bounds lies inside; see rt_shape_contains. NULL: it
     * has no inside.
     */
    int (*contains)(const rt_scene *scene, const rt_scene_shape *shape, const double p[3]);
    /* Of shapes in object space: what the row of its placement maps it to, lo to hi. */
    void (*extent)(const rt_scene_shape *shape, const double row[4], double *lo, double *hi);
    /* Of shapes in object space: the area in the world, m^2, to 1e-6 of it. */
    double (*area)(const rt_scene_shape *shape, const rt_affine *to_world);
    /* Radius and centre of a bounding sphere; NULL: that of its bounding box. */
    double (*bounding_sphere)(const rt_scene *scene, const rt_scene_shape *shape, double centre[3]);
    /* Sets kind and geometry of the light that a primitive is; NULL: RT_LIGHT_SHAPE. */
    void (*light)(rt_light_data *light, const rt_scene *scene, const rt_scene_shape *shape,
                  size_t primitive);
} rt_shape_class;

/* The class of a kind. */
const rt_shape_class *rt_shape_class_of(rt_u32 kind);

/*
 * The bounding sphere of a shape: returns its radius, infinite for a plane, and writes the centre.
 * And that of a bounding box.
 */
double rt_shape_bounding_sphere(const rt_scene *scene, const rt_scene_shape *shape,
                                double centre[3]);
double rt_bounds_sphere(double centre[3], const float lo[3], const float hi[3]);

/* Distance between two points. */
double rt_point_distance(const double a[3], const float b[3]);

/* Boundary functions that do not depend on the shape. */
rt_shape_boundary rt_boundary_solid(const rt_scene *scene, const rt_scene_shape *shape);
rt_shape_boundary rt_boundary_flat(const rt_scene *scene, const rt_scene_shape *shape);

#endif
