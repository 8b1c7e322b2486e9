/* camera.h - the thin-lens camera. */
#ifndef RT_CAMERA_H
#define RT_CAMERA_H

#include "frame.h"
#include "intersect.h"
#include "sample.h"

/*
 * The ray of the film point (s, t), s to the right, t down, both in [0,1], through a point of
 * the lens: all rays of one film point meet where its pinhole ray meets the plane in focus.
 */
static inline struct ray camera_ray(global const rt_camera_data *camera, float2 film, float2 lens)
{
    float3 origin = row3(camera->eye);
    float3 direction = row3(camera->corner) + film.x * row3(camera->across) + film.y * row3(camera->down);
    if (camera->aperture > 0.0f) {
        const float2 p = camera->aperture * sample_disc(lens);
        const float3 shift = p.x * row3(camera->lens_u) + p.y * row3(camera->lens_v);
        origin += shift;
        direction -= shift;
    }
    return make_ray(origin, unit(direction), 0.0f, INFINITY);
}

#endif
