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

#endif
