/*
 * merge_moments.h - what iterations leave of themselves beside their mean, for the estimates of the
 * bias of merging and of the noise (film/bias.h): each merges over half and a quarter of its discs'
 * area as well, which takes no other search.
 */
#ifndef RT_LIB_MODE_VCM_MERGE_MOMENTS_H
#define RT_LIB_MODE_VCM_MERGE_MOMENTS_H

#include "film/film.h"

/* All zero is none. */
typedef struct rt_merge_moments {
    rt_device *device;
    cl_kernel kernel; /* add_merge_moments */
    size_t pixels;
    cl_mem half, quarter; /* rt_film_pixel [pixels], films of the iteration by these discs */
    cl_mem sums;          /* rt_film_pixel [RT_MOMENTS][pixels], those of the film */
} rt_merge_moments;

/* rt_merge_moments_release undoes it, also after a failure. */
rt_status rt_merge_moments_create(rt_merge_moments *out, rt_device *device, const rt_film *film,
                                  rt_error *error);
void rt_merge_moments_release(rt_merge_moments *moments);

/* Before camera paths are followed: the films begin with what light paths added to `pass`. */
rt_status rt_merge_moments_begin(rt_merge_moments *moments, cl_mem pass, rt_error *error);

/* Adds the films of an iteration, that by whole discs being `pass`. */
rt_status rt_merge_moments_add(rt_merge_moments *moments, cl_mem pass, rt_error *error);

#endif
