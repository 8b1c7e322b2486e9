/*
 * paths.cl - the paths of a pixel, as path.cl follows them one at a time, with all their vertices:
 * for rt_paths_trace.
 */
#define RT_RADIANCE_ALONE
#define RT_RECORD_PATHS
#include "camera/camera.h"
#include "entry.h"
#include "integrate/record_vertex.h"
#include "integrate/path.h"

/* Where the vertices of a path go. */
struct record {
    global rt_path_vertex *vertices;
    uint capacity, count;
};

static void keep_vertex(struct record *record, const struct scene *scene, const rt_params *params,
                        rt_path_vertex *vertex)
{
    if (record->count < record->capacity) {
        record_rasters(vertex, &scene->header->camera, params);
        record->vertices[record->count] = *vertex;
    }
    record->count++;
}

/* Whether the path is to be followed after this vertex. */
static bool goes_on(uint event)
{
    return event != RT_PATH_ABSORBED && event != RT_PATH_CUT_OFF && event != RT_PATH_ESCAPED;
}

KERNEL paths(const rt_params params, global const rt_scene_header *header,
             const rt_record_params query, global rt_camera_path *paths,
             global rt_path_vertex *vertices)
{
    const uint item = item_number();
    if (item >= params.item_count)
        return;
    const struct scene scene = scene_open_compensated(header, &params);
    struct record record = {vertices + (size_t)item * query.capacity, query.capacity, 0u};
    const uint number = params.first_sample + item;
    const uint2 at = (uint2)(query.x, query.y);
    const struct sampler sampler =
        sampler_start(&scene, &params, at.y * params.width + at.x, number);
    struct path path;
    float weight;
    const struct ray ray = pixel_ray(&scene, &params, &sampler, at, &weight);
    path_begin(&path, &scene, &sampler, ray);

    path.depth = 0u;
    record_begin(&path, RT_PATH_CAMERA, ray.origin);
    path.depth = 1u;
    keep_vertex(&record, &scene, &params, &path.vertex);
    while (path.alive) {
        path_extend(&scene, &params, &path, FOLLOW_ALL, 0);
        /* The event was chosen, but its direction carries nothing. */
        if (!path.alive && goes_on(path.vertex.event))
            path.vertex.event = RT_PATH_ABSORBED;
        keep_vertex(&record, &scene, &params, &path.vertex);
    }
    global rt_camera_path *out = paths + item;
    out->sample = number;
    out->first_vertex = 0u;
    out->vertex_count = record.count;
    out->weight = all(isfinite(path.radiance)) ? weight : 0.0f;
    vstore3(path.radiance, 0, out->radiance);
    out->cut_off = path.cut_off;
}
