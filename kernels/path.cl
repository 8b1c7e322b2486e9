/*
 * path.cl - path tracing: each work-item takes the samples of RT_PATH_BATCH pixels, those of a pixel in order.
 */
#include "camera.h"
#include "film.h"
#include "integrate.h"

/* A pixel of the work-item, and the path of its sample under way. */
struct pixel {
    uint2 at;
    uint index; /* in the film */
    uint sample;
    float weight;
};

static inline void begin_sample(const struct scene *scene, const rt_params *params, struct pixel *pixel,
                                struct path *path)
{
    const struct sampler sampler = sampler_start(scene, params, pixel->index, pixel->sample);
    const struct ray ray = pixel_ray(&scene->header->camera, params, &sampler, pixel->at, &pixel->weight);
    path_begin(path, scene, &sampler, ray);
}

/* Adds the samples of a launch to `count` pixels, one for each path. */
INLINE_NEVER void sample_pixels(const struct scene *scene, const rt_params *params, struct pixel *pixels, uint count,
                                global rt_film_pixel *film)
{
    struct path paths[RT_PATH_BATCH];
    const uint end = params->first_sample + params->sample_count;

    for (uint i = 0u; i < count; i++)
        begin_sample(scene, params, &pixels[i], &paths[i]);
    for (uint going = count; going;) {
        follow_paths(scene, params, paths, count, FOLLOW_ALL, 0);
        for (uint i = 0u; i < count; i++) {
            if (paths[i].depth || pixels[i].sample == end)
                continue;
            rt_film_pixel sum = film[pixels[i].index];
            film_add(&sum, paths[i].radiance, pixels[i].weight);
            film[pixels[i].index] = sum;
            if (++pixels[i].sample < end)
                begin_sample(scene, params, &pixels[i], &paths[i]);
            else
                going--;
        }
    }
}

kernel void path(const rt_params params, global const rt_scene_header *header, global rt_film_pixel *film)
{
    const uint item = (uint)get_global_id(0) * RT_PATH_BATCH;
    if (item >= params.item_count)
        return;
    const struct scene scene = scene_open(header);
    struct pixel pixels[RT_PATH_BATCH];
    const uint count = min(RT_PATH_BATCH, params.item_count - item);

    for (uint i = 0u; i < count; i++) {
        pixels[i].at = pixel_of_item(&params, params.first_item + item + i);
        pixels[i].index = pixels[i].at.y * params.width + pixels[i].at.x;
        pixels[i].sample = params.first_sample;
    }
    sample_pixels(&scene, &params, pixels, count, film);
}
