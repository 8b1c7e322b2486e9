/*
 * path_samples.h - the samples that a work-item of path.cl or direct.cl takes.
 */
#ifndef RT_KERNELS_INTEGRATE_PATH_SAMPLES_H
#define RT_KERNELS_INTEGRATE_PATH_SAMPLES_H

#include "camera/camera.h"
#include "entry.h"
#include "camera/film.h"
#include "integrate/path.h"

#if RT_WIDTH > 1
#include "integrate/batch.h"

/* The sample of the film that a path computes. */
struct sample {
    uint2 at;   /* pixel */
    uint index; /* of the pixel in the film */
    float weight;
};

/* The samples in line, of one pixel after the other; the next eight are made together. */
struct sample_line {
    global const uint *rates;
    uint item, end;         /* the pixels after the one under way */
    uint number, last;      /* of that, the next sample and the end of its samples */
    uint2 at;               /* it, */
    uint index;             /* where it is in the film, */
    struct sampler sampler; /* and a sampler of its stream */
    uint next, made;        /* of those made, the next to begin and how many there are */
    struct sample samples[8];
    struct sampler samplers[8];
    float8 starts[4]; /* their sets SET_START */
};

static inline struct sample_line line_of(global const uint *rates, uint item, uint end)
{
    struct sample_line line;
    line.rates = rates;
    line.item = item;
    line.end = end;
    line.number = line.last = 0u;
    line.next = line.made = 0u;
    return line;
}

/* Moves on to the next sample in line; false when there is none. */
static inline bool find_sample(struct sample_line *line, const struct scene *scene,
                               const rt_params *params)
{
    while (line->number == line->last) {
        if (line->item == line->end)
            return false;
        line->at = pixel_of_item(params, params->first_item + line->item++);
        line->index = line->at.y * params->width + line->at.x;
        line->number = samples_at(params, line->rates, line->index, params->first_sample);
        line->last = samples_at(params, line->rates, line->index,
                                params->first_sample + params->sample_count);
        line->sampler = sampler_start(scene, params, line->index, line->number);
    }
    return true;
}

/* Makes the next samples, at least one: find_sample was true. */
INLINE_NEVER void make_samples(struct sample_line *line, const struct scene *scene,
                               const rt_params *params)
{
    uint4 keys[8];
    uint made = 0u;
    do {
        line->samplers[made] = sampler_of_sample(&line->sampler, line->number++);
        line->samples[made].at = line->at;
        line->samples[made].index = line->index;
        keys[made++] = line->sampler.key;
    } while (made < 8u && find_sample(line, scene, params));
    line->next = 0u;
    line->made = made;
    const struct words_x8 key = words_of(keys);
    sampler_sets(line->starts, line->sampler.sobol, &key, LANES_OF(uint8, line->samplers, .index),
                 (uint8)(SET_START));
}

/* Begins the next sample in line; false when there is none. */
static inline bool next_sample(const struct scene *scene, const rt_params *params,
                               struct sample_line *line, struct sample *sample, struct path *path)
{
    if (line->next == line->made) {
        if (!find_sample(line, scene, params))
            return false;
        make_samples(line, scene, params);
    }
    const uint i = line->next++;
    *sample = line->samples[i];
    const struct ray ray =
        pixel_ray_by(scene, params, set_of_lane(line->starts, i), sample->at, &sample->weight);
    path_begin(path, scene, &line->samplers[i], ray);
    return true;
}

/* Adds a launch's samples to the pixels of the items from `item` to before `end`. */
INLINE_NEVER void sample_pixels(const struct scene *scene, const rt_params *params, uint item,
                                uint end, global const uint *rates, global rt_film_pixel *film,
                                const uint purpose)
{
    struct sample samples[8];
    struct path paths[8];
    struct sample_line line = line_of(rates, item, end);
    uint under_way = 0u; /* a bit for each path */

    for (uint i = 0u; i < 8u; i++) {
        paths[i].alive = false;
        if (next_sample(scene, params, &line, &samples[i], &paths[i]))
            under_way |= 1u << i;
    }
    while (under_way) {
        follow_batch(scene, params, paths, purpose, 0);
        for (uint i = 0u; i < 8u; i++) {
            if (paths[i].alive || !(under_way >> i & 1u))
                continue;
            rt_film_pixel pixel = film[samples[i].index];
            film_add(&pixel, paths[i].radiance, samples[i].weight, paths[i].cut_off);
            film[samples[i].index] = pixel;
            if (!next_sample(scene, params, &line, &samples[i], &paths[i]))
                under_way ^= 1u << i;
        }
    }
}
#else
/*
 * Adds a launch's samples to a pixel. One loop goes over the vertices of all its paths: where a
 * path ends the next begins at once, so that work-items in step need not wait for the longest of
 * their paths, sample by sample (Novak, Havran, Dachsbacher: "Path Regeneration for Interactive
 * Path Tracing", Eurographics 2010).
 */
static inline void sample_pixel(const struct scene *scene, const rt_params *params, uint2 at,
                                uint index, global const uint *rates, rt_film_pixel *pixel,
                                const uint purpose)
{
    const uint last = samples_at(params, rates, index, params->first_sample + params->sample_count);
    uint number = samples_at(params, rates, index, params->first_sample);
    struct path path;
    float weight = 0.0f;
    path.alive = false;
    for (bool has_begun = false;; has_begun = true) {
        if (!path.alive) {
            if (has_begun)
                film_add(pixel, path.radiance, weight, path.cut_off);
            if (number == last)
                return;
            const struct sampler sampler = sampler_start(scene, params, index, number++);
            path_begin(&path, scene, &sampler, pixel_ray(scene, params, &sampler, at, &weight));
        }
        if (path.alive)
            path_extend(scene, params, &path, purpose, 0);
    }
}

/* Adds a launch's samples to the pixels of the items from `item` to before `end`. */
static inline void sample_pixels(const struct scene *scene, const rt_params *params, uint item,
                                 uint end, global const uint *rates, global rt_film_pixel *film,
                                 const uint purpose)
{
    for (; item < end; item++) {
        const uint2 at = pixel_of_item(params, params->first_item + item);
        const uint index = at.y * params->width + at.x;
        rt_film_pixel pixel = film[index];
        sample_pixel(scene, params, at, index, rates, &pixel, purpose);
        film[index] = pixel;
    }
}
#endif

/* Adds a launch's samples to the pixels of a work-item; `purpose` is a constant. */
static inline void sample_items(const rt_params *params, global const rt_scene_header *header,
                                global rt_film_pixel *film, global const uint *rates,
                                const uint purpose)
{
    const uint item = item_number() * params->pixels_an_item;
    if (item >= params->item_count)
        return;
    const struct scene scene = scene_open_compensated(header, params);
    sample_pixels(&scene, params, item, min(item + params->pixels_an_item, params->item_count),
                  rates, film_plane(film, params), purpose);
}

#endif
