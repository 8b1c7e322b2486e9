/* overlap.h - where two solids overlap or touch, found by samples in double precision. */
#ifndef RT_LIB_SCENE_OVERLAP_H
#define RT_LIB_SCENE_OVERLAP_H

#include "scene/scene.h"

typedef enum rt_meeting {
    RT_APART,       /* or one inside the other, or too little to be found */
    RT_OVERLAPPING, /* part of each lies in the other, and part does not */
    RT_TOUCHING     /* a face of one lies on a face of the other */
} rt_meeting;

/*
 * How two closed shapes meet, by points of their bounds and lines out of the smaller one; *place
 * becomes a point where they do.
 * *work, in evaluations of a triangle or of an equation, is what may still be spent, and falls.
 */
rt_meeting rt_shapes_meeting(const rt_scene *scene, const rt_scene_shape *a,
                             const rt_scene_shape *b, double place[3], size_t *work);

/*
 * Whether all of a closed shape lies in another, as far as points inside of it, ends of lines out
 * of it and the vertices of a mesh tell; 0 too where that would take more than *work.
 */
int rt_shape_is_within(const rt_scene *scene, const rt_scene_shape *inner,
                       const rt_scene_shape *outer, size_t *work);

/* Point i of a sequence that fills the bounds of a shape evenly. */
void rt_shape_sample(double p[3], const rt_scene_shape *shape, int i);

/* Evaluations of a triangle or of an equation that one test of a point takes. */
size_t rt_shape_cost(const rt_scene *scene, const rt_scene_shape *shape);

#endif
