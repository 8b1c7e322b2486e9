/* rays.h - scenes, rays and their hits, for the tests of intersection and traversal. */
#ifndef RT_TESTS_KERNELS_RAYS_H
#define RT_TESTS_KERNELS_RAYS_H

#include <stddef.h>
#include <stdint.h>

#include "rt.h"

/* A stream of random numbers: O'Neill's PCG, 32 bits of output from 64 of state. */
typedef struct rays_stream {
    uint64_t state;
} rays_stream;

float rays_uniform(rays_stream *stream);                        /* in [0, 1) */
float rays_between(rays_stream *stream, float lo, float hi);    /* in [lo, hi) */
void rays_point(rays_stream *stream, float half, float out[3]); /* in the cube [-half, half)^3 */
void rays_direction(rays_stream *stream, float out[3]);         /* near unit length, never 0 */

rt_ray rays_make(const float origin[3], const float direction[3], float t_min, float t_max);

/* A scene with one material, 0. Any failure fails the test. */
rt_scene *rays_scene(void);
void rays_add_triangles(rt_scene *scene, const float *positions, size_t vertices,
                        const uint32_t *indices, size_t triangles);
void rays_add_quad(rt_scene *scene, const float corner[3], const float edge1[3],
                   const float edge2[3]);
void rays_add_sphere(rt_scene *scene, const float centre[3], float radius);
void rays_add_plane(rt_scene *scene, const float point[3], const float normal[3]);

/* The scene on test_device(). */
rt_renderer *rays_renderer(const rt_scene *scene, rt_accel accel);

/* Hits of count rays, to be freed by the caller. */
rt_hit *rays_trace(rt_renderer *renderer, rt_trace_kind kind, const rt_ray *rays, size_t count);

/*
 * Follows each ray to a surface and leaves that in the direction away[i]: how far the next hit is;
 * infinity: none; -1: the ray met nothing. Destroys the scene. The caller frees the result.
 */
float *rays_leave(rt_scene *scene, const rt_ray *rays, float (*away)[4], uint32_t count);

#endif
