/*
 * media_gather_items.h - the camera paths that a work-item of photon_camera_media.cl or
 * photon_camera_grids.cl follows.
 */
#ifndef RT_KERNELS_INTEGRATE_MEDIA_GATHER_ITEMS_H
#define RT_KERNELS_INTEGRATE_MEDIA_GATHER_ITEMS_H

#include "entry.h"
#include "integrate/gather_item.h"
#include "integrate/media_gather.h"

/* Follows the path of an item, and what it is split into. */
static inline void follow_eye_path(const struct gather *first, const struct scene *scene,
                                   const rt_params *params, const struct volume_map *map, uint item)
{
    struct fork fork;
    struct gather gather = gather_of_item(first, params, item, &fork);
    struct media_path p;
    begin_eye_path(&p.path, &gather, scene, params, item);
    p.in_medium = false;
    do {
        while (p.path.alive)
            media_gather_extend(scene, params, map, &p, &gather);
        end_eye_path(&p.path, &gather, params);
    } while (begin_continuation(&p.path, &gather, params));
}

/*
 * Follows a launch's paths of a work-item, as photon_camera; shape, nodes [], blocks []: the tree
 * of volume photons, gathered as `volume` says.
 */
static inline void follow_eye_paths(const rt_params *params, global const rt_scene_header *header,
                                    global rt_gather_point *points,
                                    global rt_gather_point *caustics, uint stride,
                                    const rt_volume_params *volume, const rt_photon_tree *shape,
                                    global const rt_photon_node *nodes,
                                    global const rt_photon_block *blocks)
{
    const uint begin = item_number() * params->pixels_an_item;
    const uint end = min(begin + params->pixels_an_item, params->item_count);
    const struct scene scene = scene_open(header);
    struct volume_map map;
    struct gather first;
    first.point = points;
    first.caustics = caustics;
    first.stride = stride;
    map.tree.shape = *shape;
    map.tree.nodes = nodes;
    map.tree.blocks = blocks;
    map.params = *volume;
    first.fork = 0;
    for (uint item = begin; item < end; item++)
        follow_eye_path(&first, &scene, params, &map, item);
}

#endif
