/*
 * merge_moments.h - what iterations leave of themselves beside their mean, for the estimates of the
 * bias of merging and of the noise (film/bias.h): they merge over half and a quarter of the area of
 * their discs as well, which takes no other search.
 */
#ifndef RT_LIB_MODE_VCM_MERGE_MOMENTS_H
#define RT_LIB_MODE_VCM_MERGE_MOMENTS_H

#include "film/film.h"

/* All zero is none. */
typedef struct rt_merge_moments {
    rt_device *device;
    cl_kernel kernel; /* add_merge_moments */
    size_t pixels;
    cl_mem parts; /* float [pixels][2][3], of an iteration, what parts of the discs find more */
    cl_mem sums;  /* rt_film_pixel [RT_MOMENTS][pixels], those of the film */
} rt_merge_moments;

/* rt_merge_moments_release undoes it, also after a failure. */
rt_status rt_merge_moments_create(rt_merge_moments *out, rt_device *device, const rt_film *film,
                                  rt_error *error);
void rt_merge_moments_release(rt_merge_moments *moments);

/* Whether the iteration of this number is measured. */
int rt_merge_is_measured(uint32_t number);

/* Adds a measured iteration, whose film is `pass`. */
rt_status rt_merge_moments_add(rt_merge_moments *moments, cl_mem pass, rt_error *error);

#endif
