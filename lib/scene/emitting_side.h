/*
 * emitting_side.h - what lies on the side of an area light that emits: nothing, where it faces away
 * from all there is, or a wall that it all but touches.
 */
#ifndef RT_LIB_SCENE_EMITTING_SIDE_H
#define RT_LIB_SCENE_EMITTING_SIDE_H

#include "scene/scene.h"

/* How an area light misses all there is. */
typedef enum rt_miss {
    RT_MISS_NONE,    /* it does not, or that was not decided */
    RT_MISS_FLAT,    /* flat: nothing is in front of it, or it emits into a wall */
    RT_MISS_OUTSIDE, /* it emits outwards, and all is inside of it, or behind each of its faces */
    RT_MISS_INSIDE   /* it emits inwards, and nothing is in it */
} rt_miss;

/* Where it emits from, and where to. */
typedef struct rt_emitting_side {
    rt_miss miss;
    double centre[3], normal[3]; /* of RT_MISS_FLAT */
    uint32_t wall;               /* RT_MISS_FLAT: the shape before it; RT_NONE: nothing is */
    double distance;             /* to that, m; 0: all of the light lies in it, or on its surface */
    double step;                 /* m, of rounding: what is not farther touches it */
} rt_emitting_side;

/*
 * Looks at one light. is_in_view: the camera, where it is in front of the light, sees it. What
 * would take long counts as lit. Adds what it looks at to *work.
 */
rt_emitting_side rt_emitting_side_of(const rt_scene *scene, const rt_scene_shape *light,
                                     int is_in_view, size_t *work);

#endif
