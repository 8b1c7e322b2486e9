/*
 * photon_camera.cl - the eye paths of photon mapping: each work-item follows one sample of each of
 * a few pixels to its gather points.
 */
#define RT_RADIANCE_ALONE
#include "camera/camera.h"
#include "entry.h"
#include "camera/film.h"
#include "integrate/path.h"
#include "integrate/gather_item.h"
#include "surface/gather_point.h"
#if RT_WIDTH > 1
#include "integrate/batch.h"
#endif

#if RT_WIDTH > 1
/* Follows the paths of the items from `item` to before `end`, eight at a time. */
INLINE_NEVER void follow_eye_paths(const struct scene *scene, const rt_params *params, uint item,
                                   uint end, const struct gather *first)
{
    struct gather gathers[8];
    struct path paths[8];
    struct fork forks[8];
    uint under_way = 0u; /* a bit for each path */

    for (uint i = 0u; i < 8u; i++) {
        gathers[i] = gather_of_item(first, params, min(item, end - 1u), &forks[i]);
        paths[i].alive = false;
        if (item < end) {
            begin_eye_path(&paths[i], &gathers[i], scene, params, item++);
            under_way |= 1u << i;
        }
    }
    while (under_way) {
        follow_batch(scene, params, paths, FOLLOW_TO_GATHER, gathers);
        for (uint i = 0u; i < 8u; i++) {
            if (paths[i].alive || !(under_way >> i & 1u))
                continue;
            end_eye_path(&paths[i], &gathers[i], params);
            if (begin_continuation(&paths[i], &gathers[i], params))
                continue;
            if (item < end) {
                gathers[i] = gather_of_item(first, params, item, &forks[i]);
                begin_eye_path(&paths[i], &gathers[i], scene, params, item++);
            } else
                under_way ^= 1u << i;
        }
    }
}
#else
/* Follows the paths of the items from `item` to before `end`. */
static inline void follow_eye_paths(const struct scene *scene, const rt_params *params, uint item,
                                    uint end, const struct gather *first)
{
    for (; item < end; item++) {
        struct fork fork;
        struct gather gather = gather_of_item(first, params, item, &fork);
        struct path path;
        begin_eye_path(&path, &gather, scene, params, item);
        do {
            while (path.alive)
                path_extend(scene, params, &path, FOLLOW_TO_GATHER, &gather);
            end_eye_path(&path, &gather, params);
        } while (begin_continuation(&path, &gather, params));
    }
}
#endif

/*
 * points: [item_count][params.split], in the order of items; caustics:
 * [params.final_gather][stride], a row for each diffuse event before that. The sample is
 * params.first_sample.
 */
KERNEL ENTRY(photon_camera)(const rt_params params, global const rt_scene_header *header,
                            global rt_gather_point *points, global rt_gather_point *caustics,
                            uint stride)
{
    const uint item = item_number() * params.pixels_an_item;
    if (item >= params.item_count)
        return;
    const struct scene scene = scene_open(header);
    struct gather first;
    first.point = points;
    first.caustics = caustics;
    first.stride = stride;
    first.fork = 0;
    follow_eye_paths(&scene, &params, item, min(item + params.pixels_an_item, params.item_count),
                     &first);
}
