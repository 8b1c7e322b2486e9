/*
 * pixel_samples.h - the loop of the modes that take samples of pixels one by one: one kernel,
 * launched over the film until there are enough samples, time is up or the error is small enough.
 */
#ifndef RT_LIB_MODE_PIXEL_SAMPLES_H
#define RT_LIB_MODE_PIXEL_SAMPLES_H

#include "mode/mode.h"

/* State of such a mode; all zero: there is no kernel, only the layers are summed. */
typedef struct rt_pixel_samples {
    rt_device *device;
    cl_kernel kernel;
    uint32_t pixels_an_item; /* pixels that a work-item of it takes */
    cl_mem pixels;           /* rt_film_pixel, the film on the device */
    cl_mem rates;            /* of the film, where it has such */
    int rates_are_written;
} rt_pixel_samples;

/* Prepares the program and kernel of this name, which takes rt_params, the scene, the film and
 * the rates of its pixels. */
rt_status rt_pixel_samples_prepare(rt_pixel_samples *out, const rt_render_job *job,
                                   const char *kernel, uint32_t pixels_an_item,
                                   rt_stage_progress *progress, rt_error *error);

/* For the check, run and release of rt_mode_class; the state is an rt_pixel_samples. */
rt_status rt_pixel_samples_check(const rt_render_options *options, rt_error *error);
rt_status rt_pixel_samples_run(const rt_render_job *job, void *state, rt_error *error);
void rt_pixel_samples_release(void *state);

#endif
