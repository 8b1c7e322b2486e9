/*
 * count.h - counts rays and what they visit, in kernels that are built for it (RT_COUNT_RAYS);
 * otherwise COUNT is nothing.
 *
 * The counters lie in the buffer of the scene, in slots of a row each: rays are spread over them by
 * the bits of a number of theirs, so that work-items seldom wait for each other. Each counter is
 * two words, as OpenCL 1.2 need not have atomics of 64 bits.
 */
#ifndef RT_COUNT_H
#define RT_COUNT_H

#include "scene.h"
#include "types.h"

#ifdef RT_COUNT_RAYS
static inline void count_one(const struct scene *scene, uint counter, float any)
{
    global const rt_scene_header *header = scene->header;
    volatile global uint *word =
        (volatile global uint *)header + (size_t)header->counters * (RT_SCENE_ROW / 4u) +
        (as_uint(any) >> 4 & (RT_COUNTER_SLOTS - 1u)) * (RT_SCENE_ROW / 4u) + 2u * counter;
    if (atomic_inc(word) == 0xffffffffu)
        atomic_inc(word + 1);
}
#define COUNT(scene, counter, any) count_one(scene, counter, any)
#else
#define COUNT(scene, counter, any)
#endif

#endif
