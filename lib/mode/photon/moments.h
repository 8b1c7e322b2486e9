/*
 * moments.h - what passes leave of themselves beside their mean, for the estimates of bias and
 * noise (film/bias.h): in one of eight passes the same photons are gathered twice more, from discs
 * of two and four times the area, and the squares of all passes are summed.
 */
#ifndef RT_LIB_MODE_PHOTON_MOMENTS_H
#define RT_LIB_MODE_PHOTON_MOMENTS_H

#include "film/film.h"
#include "mode/photon/queries.h"

/* Sizes of larger discs. */
enum { RT_LARGER = 2 };

typedef struct rt_pass_moments {
    rt_device *device;
    cl_kernel kernel; /* add_moments */
    size_t capacity, rows, pixels;
    int is_measured;          /* the pass under way */
    cl_mem points;            /* rt_gather_point [capacity], copies of the ends of paths */
    cl_mem earlier;           /* rt_gather_point [rows][capacity], of their earlier gather points */
    cl_mem larger[RT_LARGER]; /* rt_film_pixel [pixels], films of the pass by larger discs */
    cl_mem sums;              /* rt_film_pixel [RT_MOMENTS][pixels], those of the film */
} rt_pass_moments;

/* For batches of so many paths, each with so many earlier gather points. */
rt_status rt_pass_moments_create(rt_pass_moments *out, rt_device *device, cl_kernel kernel,
                                 const rt_film *film, size_t capacity, size_t rows,
                                 rt_error *error);
void rt_pass_moments_release(rt_pass_moments *moments);

/* Whether a pass is measured. */
int rt_pass_is_measured(uint32_t pass);

/* Copies the gather points of a batch, before anything is gathered for them. */
rt_status rt_pass_moments_copy(rt_pass_moments *moments, cl_mem points, cl_mem earlier,
                               size_t count, rt_error *error);

/* Gathers at the copies, from larger discs of a size, 0 to RT_LARGER - 1. */
rt_status rt_pass_moments_gather(rt_pass_moments *moments, const rt_queries *queries, int size,
                                 size_t count, rt_error *error);

/* Adds the film of a pass. Those of larger discs are empty then. */
rt_status rt_pass_moments_add(rt_pass_moments *moments, cl_mem pass, rt_error *error);

#endif
