/* camera.h - the cameras: perspective and orthographic with a thin lens, and environment. */
#ifndef RT_KERNELS_CAMERA_CAMERA_H
#define RT_KERNELS_CAMERA_CAMERA_H

#include "camera/filter.h"
#include "math/frame.h"
#include "accel/traverse.h"
#include "light/light.h"
#include "sample/rng.h"
#include "sample/sample.h"

/* A point of the lens, radius 1: round, or a polygon with its corners on that circle. */
static inline float2 lens_point(global const rt_camera_data *camera, float2 u)
{
    return camera->blades
               ? sample_polygon(camera->blades, camera->blade_rotation * (0.5f / RT_PI), u)
               : sample_disc(u);
}

/* From the eye in the direction of that longitude and latitude of the film. */
static inline struct ray environment_ray(global const rt_camera_data *camera, float2 film)
{
    const float turn = film.x - 0.5f;
    const float2 longitude = sin_cos(2.0f * RT_PI * (turn - floor(turn)));
    const float2 polar = sin_cos(RT_PI * film.y);
    const float3 ahead = longitude.y * row3(camera->axis) + longitude.x * row3(camera->lens_u);
    return make_ray(row3(camera->eye), unit(polar.x * ahead + polar.y * row3(camera->lens_v)), 0.0f,
                    INFINITY);
}

/*
 * The ray of the film point (s, t), s to the right, t down, both in [0,1], through a point of
 * the lens: all rays of one film point meet where its pinhole ray meets the plane in focus.
 */
static inline struct ray camera_ray(global const rt_camera_data *camera, float2 film, float2 lens)
{
    if (camera->kind == RT_CAMERA_KIND_ENVIRONMENT)
        return environment_ray(camera, film);
    const float3 place =
        row3(camera->corner) + film.x * row3(camera->across) + film.y * row3(camera->down);
    float3 origin = row3(camera->eye);
    float3 direction = place;
    if (camera->kind == RT_CAMERA_KIND_ORTHOGRAPHIC) {
        origin += place;
        direction = camera->focal_distance * row3(camera->axis);
    }
    if (camera->aperture > 0.0f) {
        const float2 p = camera->aperture * lens_point(camera, lens);
        const float3 shift = p.x * row3(camera->lens_u) + p.y * row3(camera->lens_v);
        origin += shift;
        direction -= shift;
    }
    return make_ray(origin, unit(direction), 0.0f, INFINITY);
}

/* Where a ray from or to a camera that hides emitters begins: behind those that it meets first. */
RARELY_CALLED float past_emitters(const struct scene *scene, struct ray rest)
{
    struct hit hit;
    while (closest_hit(scene, &rest, &hit) && emits(scene, &hit))
        rest.t_min = nextafter(hit.t, INFINITY);
    return rest.t_min;
}

/* The ray of a sample of the pixel `at`, by its set SET_START, and its weight: see filter.h. */
static inline struct ray pixel_ray_by(const struct scene *scene, const rt_params *params, float4 u,
                                      uint2 at, float *weight)
{
    global const rt_camera_data *camera = &scene->header->camera;
    const float2 place =
        convert_float2(at) + sample_filter(camera->filter, camera->filter_radius, u.xy, weight);
    struct ray ray = camera_ray(camera, place / (float2)(params->width, params->height), u.zw);
    if (UNLIKELY(camera->hides_emitters))
        ray.t_min = past_emitters(scene, ray);
    return ray;
}

/* The ray of a sample of the pixel `at`, and its weight, 1 or -1. */
static inline struct ray pixel_ray(const struct scene *scene, const rt_params *params,
                                   const struct sampler *sampler, uint2 at, float *weight)
{
    return pixel_ray_by(scene, params, sampler_set(sampler, SET_START), at, weight);
}

#endif
