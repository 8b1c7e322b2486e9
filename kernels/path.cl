/*
 * path.cl - path tracing: each work-item takes the samples of a few pixels, RT_PATH_BATCH at a
 * time, those of a pixel in order.
 */
#include "camera/camera.h"
#include "entry.h"
#include "camera/film.h"
#include "integrate/integrate.h"

/* The sample that a path is of. */
struct sample {
    uint2 at;   /* pixel */
    uint index; /* of the pixel in the film */
    uint number;
    float weight;
};

/*
 * Begins the next sample of the pixel, or the first of the next item in line; false when there is
 * none.
 */
static inline bool next_sample(const struct scene *scene, const rt_params *params, uint *item,
                               uint end, struct sample *sample, struct path *path)
{
    if (++sample->number - params->first_sample >= params->sample_count) {
        if (*item == end)
            return false;
        sample->at = pixel_of_item(params, params->first_item + (*item)++);
        sample->index = sample->at.y * params->width + sample->at.x;
        sample->number = params->first_sample;
    }
    const struct sampler sampler = sampler_start(scene, params, sample->index, sample->number);
    const struct ray ray =
        pixel_ray(&scene->header->camera, params, &sampler, sample->at, &sample->weight);
    path_begin(path, scene, &sampler, ray);
    return true;
}

/* Adds a launch's samples to the pixels of the items from `item` to before `end`. */
INLINE_NEVER void sample_pixels(const struct scene *scene, const rt_params *params, uint item,
                                uint end, global rt_film_pixel *film)
{
    struct sample samples[RT_PATH_BATCH];
    struct path paths[RT_PATH_BATCH];
    uint going = 0u; /* a bit for each path under way */

    for (uint i = 0u; i < RT_PATH_BATCH; i++) {
        samples[i].number = params->first_sample + params->sample_count - 1u;
        paths[i].depth = 0u;
        if (next_sample(scene, params, &item, end, &samples[i], &paths[i]))
            going |= 1u << i;
    }
    while (going) {
        follow_paths(scene, params, paths, RT_PATH_BATCH, FOLLOW_ALL, 0);
        for (uint i = 0u; i < RT_PATH_BATCH; i++) {
            if (paths[i].depth || !(going >> i & 1u))
                continue;
            rt_film_pixel pixel = film[samples[i].index];
            film_add(&pixel, paths[i].radiance, samples[i].weight);
            film[samples[i].index] = pixel;
            if (!next_sample(scene, params, &item, end, &samples[i], &paths[i]))
                going ^= 1u << i;
        }
    }
}

KERNEL path(const rt_params params, global const rt_scene_header *header,
            global rt_film_pixel *film)
{
    const uint item = (uint)get_global_id(0) * params.pixels_an_item;
    if (item >= params.item_count)
        return;
    const struct scene scene = scene_open(header);
    sample_pixels(&scene, &params, item, min(item + params.pixels_an_item, params.item_count),
                  film);
}
