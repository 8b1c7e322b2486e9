/* face.h - the flat faces of quads, discs and meshes, as lights emit from them. */
#ifndef RT_LIB_SCENE_FACE_H
#define RT_LIB_SCENE_FACE_H

#include "scene/scene.h"

/* A parallelogram, triangle or disc. */
typedef struct rt_face {
    rt_u32 kind;                 /* RT_SHAPE_QUAD, RT_SHAPE_TRIANGLES or RT_SHAPE_DISC */
    double corner[3];            /* of a disc the centre */
    double b[3], c[3];           /* edges there; of a disc two of its half-axes */
    double normal[3], centre[3]; /* of unit length, to the side that emits; the middle */
    double area;                 /* m^2; where it is 0 the normal is no number */
} rt_face;

/* How many there are: 0 of other shapes. */
size_t rt_face_count(const rt_scene *scene, const rt_scene_shape *shape);

rt_face rt_face_of(const rt_scene *scene, const rt_scene_shape *shape, size_t i);

/* The point at u, v, each of 0 to 1. */
void rt_face_point(double out[3], const rt_face *face, double u, double v);

#endif
