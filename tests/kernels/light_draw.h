/*
 * light_draw.h - samples of a scene's lights and starts of its light paths, for the tests of
 * lights.
 */
#ifndef RT_TESTS_KERNELS_LIGHT_DRAW_H
#define RT_TESTS_KERNELS_LIGHT_DRAW_H

#include "support.h"

#include "render/renderer.h"

enum { light_draws = 1 << 16 };

typedef struct light_draw {
    float position[3], inv_pdf; /* sr, 1 / pdf_w */
    float wi[3], delta;
    float radiance[3], again_pdf_w; /* of the same direction, asked for afterwards */
    float normal[3], lift;
} light_draw;

typedef struct emission_draw {
    float position[3], pdf; /* 1/m^2 and 1/sr, as far as the light leaves both open */
    float direction[3], unused;
    float flux[3], light;
    float normal[3], error;
} emission_draw;

/* A scene whose material 0 is black. */
rt_scene *light_scene(void);

/* Makes it ready on the test device, and destroys it. */
rt_renderer *light_renderer(rt_scene *scene);

/* Fill out[count]. */
void draw_many_lights(rt_renderer *renderer, uint32_t seed, const float from[3], uint32_t count,
                      light_draw *out);
void draw_many_emissions(rt_renderer *renderer, uint32_t seed, uint32_t count, emission_draw *out);

/* Fills out[light_draws] with samples of the lights seen from a point. */
void draw_lights(rt_renderer *renderer, uint32_t seed, const float from[3], light_draw *out);

/* Samples of the lights beside BSDF sampling, in a scene whose lights are all distant. */
typedef struct compensated_draw {
    float wi[3], inv_pdf;         /* sr; 0: no sample */
    float again_pdf_w, any_pdf_w; /* of wi, and of a direction uniform over the sphere */
    float unused[2];
} compensated_draw;

/* Fills out[light_draws], as draw_lights. */
void draw_compensated(rt_renderer *renderer, uint32_t seed, const float from[3],
                      compensated_draw *out);

/* Fills out[light_draws] with starts of light paths. */
void draw_emissions(rt_renderer *renderer, uint32_t seed, emission_draw *out);

/* The probabilities with which the scene's lights, `count` of them, are chosen for a point. */
void light_chances(rt_renderer *renderer, const float from[3], uint32_t count, float *out);

#endif
