/*
 * project.h - where the camera sees a point, for light paths that are joined with it, and the
 * density of its rays. Through a given point of the lens every camera is a pinhole or,
 * orthographic, a bundle of parallel rays.
 */
#ifndef RT_KERNELS_CAMERA_PROJECT_H
#define RT_KERNELS_CAMERA_PROJECT_H

#include "camera/camera.h"

/* How the camera sees a point. */
struct projection {
    float2 raster; /* pixels from the left and the top of the film */
    float3 origin; /* of the ray */
    float3 wi;     /* unit, from the point to there */
    /* density of a pixel's rays over area, 1/m^2, where it faces the ray: over the cosine, that of
     * points on the surface */
    float pdf_a;
};

/* Metres squared of a pixel where its size is measured: in focus, or of an orthographic film. */
static inline float pixel_area(global const rt_camera_data *camera, const rt_params *params)
{
    return length(row3(camera->across)) * length(row3(camera->down)) /
           ((float)params->width * (float)params->height);
}

/* Where a point of the lens lies, relative to its middle. */
static inline float3 lens_shift(global const rt_camera_data *camera, float2 u)
{
    if (!(camera->aperture > 0.0f))
        return (float3)(0.0f);
    const float2 p = camera->aperture * lens_point(camera, u);
    return p.x * row3(camera->lens_u) + p.y * row3(camera->lens_v);
}

/*
 * The density of a pixel's rays over area that faces them, at this distance along a ray of unit
 * direction w; the lens has no part in it.
 */
static inline float camera_pdf_a(global const rt_camera_data *camera, const rt_params *params,
                                 float3 w, float distance)
{
    const float3 axis = row3(camera->axis);
    const float cosine = dot(w, axis);
    if (camera->kind == RT_CAMERA_KIND_ORTHOGRAPHIC)
        return 1.0f / (pixel_area(camera, params) * cosine);
    if (camera->kind == RT_CAMERA_KIND_ENVIRONMENT) {
        const float up = dot(w, row3(camera->lens_v));
        const float sine = sqrt(fmax(1.0f - up * up, 1e-12f));
        return (float)params->width * (float)params->height /
               (2.0f * RT_PI * RT_PI * sine * distance * distance);
    }
    const float depth = dot(row3(camera->corner), axis);
    return square(depth / distance) / (pixel_area(camera, params) * cosine * cosine * cosine);
}

/* The film point of a direction from the eye, of an environment camera. */
static inline float2 panorama_point(global const rt_camera_data *camera, float3 w)
{
    const float turn = atan2(dot(w, row3(camera->lens_u)), dot(w, row3(camera->axis)));
    return (float2)(0.5f + turn / (2.0f * RT_PI),
                    acos(clamp(dot(w, row3(camera->lens_v)), -1.0f, 1.0f)) / RT_PI);
}

/* The film point of a place in the plane of focus, or of the film, relative to its corner. */
static inline float2 film_point(global const rt_camera_data *camera, float3 place)
{
    const float3 across = row3(camera->across), down = row3(camera->down);
    return (float2)(dot(place, across) / dot(across, across), dot(place, down) / dot(down, down));
}

/*
 * Sees a point, which may lie beyond the edge of the film, through a point of the lens, by u in
 * [0,1)^2; false: it lies behind the camera.
 */
static inline bool camera_project(global const rt_camera_data *camera, const rt_params *params,
                                  float3 position, float2 u, struct projection *out)
{
    const float3 eye = row3(camera->eye), axis = row3(camera->axis), corner = row3(camera->corner);
    const float2 size = (float2)(params->width, params->height);
    float2 film;
    float3 origin = eye, w;
    float distance;
    if (camera->kind == RT_CAMERA_KIND_ENVIRONMENT) {
        w = unit(position - eye);
        film = panorama_point(camera, w);
    } else if (camera->kind == RT_CAMERA_KIND_ORTHOGRAPHIC) {
        const float3 shift = lens_shift(camera, u);
        w = unit(camera->focal_distance * axis - shift);
        origin = position - dot(position - eye, axis) / dot(w, axis) * w;
        film = film_point(camera, origin - eye - shift - corner);
    } else {
        origin = eye + lens_shift(camera, u);
        w = unit(position - origin);
        const float along = dot(corner, axis) / dot(position - origin, axis);
        film = film_point(camera, origin + along * (position - origin) - eye - corner);
    }
    distance = dot(position - origin, w);
    out->raster = film * size;
    out->origin = origin;
    out->wi = -w;
    if (!(distance > 0.0f) ||
        (camera->kind != RT_CAMERA_KIND_ENVIRONMENT && !(dot(w, axis) > 0.0f)))
        return false;
    out->pdf_a = camera_pdf_a(camera, params, w, distance);
    return true;
}

#endif
