/*
 * study.h - what tests of convergence share: a scene on a device, renders, and their errors against
 * a reference.
 */
#ifndef RT_TESTS_STUDY_H
#define RT_TESTS_STUDY_H

#include "rt.h"

typedef struct study {
    const char *name; /* of the program, for messages */
    rt_scene *scene;
    rt_device *device; /* one for all of a program, so that kernels are built once */
    rt_renderer *renderer;
    rt_render_options options; /* the scene's own, with the size of the study's film */
} study;

/* Opens a scene for films of side x side pixels; ends the program with a message when it cannot. */
void study_open(study *s, const char *name, const char *scene, uint32_t side);
void study_close(study *s);

/*
 * Renders; the same on failure. *seconds, if not NULL, is the time of emission, gathering and
 * rendering.
 */
rt_film *study_render(const study *s, const rt_render_options *options, double *seconds);

/*
 * Mean squared difference of a film from a reference of the same size, without the pixels that see
 * an area light or border on one: those brighter than half the brightest where that is far above
 * the mean. Their noise is that of the pixel's coverage, whatever lights the scene.
 */
double study_mse(const rt_film *film, const rt_film *reference);

/*
 * The same from two references of independent noise: the mean product of the differences from each,
 * to which their noise adds nothing on average.
 */
double study_mse_of_two(const rt_film *film, const rt_film *a, const rt_film *b);
double study_mean(const rt_film *film);

/* The slope of the straight line that fits log y against log x best. */
double study_slope(const double *x, const double *y, int count);

#endif
