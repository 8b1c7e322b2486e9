/*
 * record_vertex.h - fills in the vertex that a path is at, where paths are recorded (record.h).
 */
#ifndef RT_KERNELS_INTEGRATE_RECORD_VERTEX_H
#define RT_KERNELS_INTEGRATE_RECORD_VERTEX_H

#include "sample/mis.h"
#include "integrate/path_state.h"
#include "light/light.h"

/* Begins a vertex of the path, of which nothing is known but how the path came to it. */
static inline void record_begin(struct path *path, uint event, float3 position)
{
    rt_path_vertex *vertex = &path->vertex;
    const float3 none = (float3)(0.0f);
    vstore3(position, 0, vertex->position);
    vertex->event = event;
    vstore3(none, 0, vertex->normal);
    vertex->depth = path->depth;
    vstore3(path->eta_scale * path->beta, 0, vertex->throughput);
    vstore3(none, 0, vertex->emitted);
    vstore3(none, 0, vertex->direct);
    vstore3(none, 0, vertex->light_position);
    vertex->pdf_w = vertex->emitted_weight = vertex->direct_weight = vertex->light_pdf_w = 0.0f;
    vertex->shape = vertex->material = vertex->emitter = vertex->light = RT_NONE;
    vertex->raster[0] = vertex->raster[1] = INFINITY;
    vertex->light_raster[0] = vertex->light_raster[1] = INFINITY;
    vertex->flags = 0u;
    vertex->survival = 1.0f;
    vertex->reserved[0] = vertex->reserved[1] = 0u;
}

/* The path meets a surface, or a boundary that has no effect; absorbed, until it goes on. */
static inline void record_surface(struct path *path, const struct meeting *met)
{
    const float3 normal = met->surface.normal;
    record_begin(path, met->boundary.exists ? RT_PATH_ABSORBED : RT_PATH_PASSED,
                 met->surface.position);
    vstore3(dot(met->wo, normal) < 0.0f ? -normal : normal, 0, path->vertex.normal);
    path->vertex.shape = met->surface.shape;
    path->vertex.material = met->material;
}

/* It met a light, whose MIS weight is `weight`, and `emitted` was added to its radiance. */
static inline void record_emission(struct path *path, uint light, float weight, float3 emitted)
{
    path->vertex.emitter = light;
    path->vertex.emitted_weight = weight;
    vstore3(emitted, 0, path->vertex.emitted);
}

/* The MIS weight of a light that the path meets, as emission.h has it. */
static inline float record_emission_weight(const struct path *path, const rt_params *params,
                                           float light_pdf_w)
{
    return path->pdf_w == 0.0f ? 1.0f
                               : mis_weight(params, RT_ESTIMATOR_BSDF, light_pdf_w / path->pdf_w);
}

/* It met the emissive surface, if that emits towards it. */
static inline void record_surface_emission(struct path *path, const struct scene *scene,
                                           const rt_params *params, const struct surface *surface,
                                           float3 emitted)
{
    const uint light = surface_light(scene, surface);
    if (light == RT_NONE || largest3(emitted) <= 0.0f)
        return;
    const float pdf_w = light_pdf_w(scene, scene->lights + light, path->from, surface);
    record_emission(path, light, record_emission_weight(path, params, pdf_w), emitted);
}

/* It leaves the scene. */
static inline void record_escape(struct path *path)
{
    record_begin(path, RT_PATH_ESCAPED, path->ray.direction);
}

/* And meets the environment. */
static inline void record_environment(struct path *path, const struct scene *scene,
                                      const rt_params *params, float3 emitted)
{
    const float pdf_w = environment_light_pdf_w(scene, path->from, path->ray.direction);
    record_emission(path, scene->environment->light, record_emission_weight(path, params, pdf_w),
                    emitted);
}

/*
 * A light was sampled: `weighted` is the BSDF times the MIS weights of its events, `plain` without
 * them. Until the light is known to arrive, it is occluded.
 */
static inline void record_light(rt_path_vertex *vertex, const struct light_sample *sample,
                                float3 weighted, float3 plain)
{
    vertex->light = sample->light;
    vertex->flags = RT_PATH_LIGHT_OCCLUDED | (sample->delta ? RT_PATH_LIGHT_DELTA : 0u) |
                    (sample->distant ? RT_PATH_LIGHT_DISTANT : 0u);
    vstore3(sample->distant ? sample->wi : sample->at.position, 0, vertex->light_position);
    vertex->light_pdf_w = sample->delta ? 0.0f : 1.0f / sample->inv_pdf;
    const float sum = mean3(plain);
    vertex->direct_weight = sum > 0.0f ? mean3(weighted) / sum : 0.0f;
}

/* What was sampled arrives. */
static inline void record_arrival(rt_path_vertex *vertex, float3 direct)
{
    vertex->flags &= ~RT_PATH_LIGHT_OCCLUDED;
    vstore3(direct, 0, vertex->direct);
}

/* ---- Where the camera sees a point ----------------------------------------------------------- */

/* The film point of a direction from the eye, of an environment camera. */
static inline float2 record_panorama(global const rt_camera_data *camera, float3 away)
{
    const float3 w = unit(away);
    const float turn = atan2(dot(w, row3(camera->lens_u)), dot(w, row3(camera->axis)));
    return (float2)(0.5f + turn / (2.0f * RT_PI),
                    acos(clamp(dot(w, row3(camera->lens_v)), -1.0f, 1.0f)) / RT_PI);
}

/* Where a pinhole camera in the place of this one sees a point, in pixels; infinite: nowhere. */
static inline float2 record_raster(global const rt_camera_data *camera, const rt_params *params,
                                   float3 position)
{
    const float2 size = (float2)(params->width, params->height);
    const float3 axis = row3(camera->axis), away = position - row3(camera->eye);
    const float depth = dot(away, axis);
    float3 place;
    if (camera->kind == RT_CAMERA_KIND_ENVIRONMENT)
        return size * record_panorama(camera, away);
    if (camera->kind == RT_CAMERA_KIND_ORTHOGRAPHIC)
        place = away - depth * axis - row3(camera->corner);
    else if (depth > 0.0f)
        place = away * (dot(row3(camera->corner), axis) / depth) - row3(camera->corner);
    else
        return (float2)(INFINITY);
    const float3 across = row3(camera->across), down = row3(camera->down);
    return size *
           (float2)(dot(place, across) / dot(across, across), dot(place, down) / dot(down, down));
}

/* Sets both, where they are points. */
static inline void record_rasters(rt_path_vertex *vertex, global const rt_camera_data *camera,
                                  const rt_params *params)
{
    if (vertex->event != RT_PATH_ESCAPED && vertex->event != RT_PATH_CAMERA)
        vstore2(record_raster(camera, params, vload3(0, vertex->position)), 0, vertex->raster);
    if (vertex->light != RT_NONE && !(vertex->flags & RT_PATH_LIGHT_DISTANT))
        vstore2(record_raster(camera, params, vload3(0, vertex->light_position)), 0,
                vertex->light_raster);
}

#endif
