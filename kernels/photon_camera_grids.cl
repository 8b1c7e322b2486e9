/*
 * photon_camera_grids.cl - as photon_camera_media.cl, of scenes where the density of a medium lies
 * on a grid.
 */
#define RT_RADIANCE_ALONE
#define RT_GRIDS
#include "entry.h"
#include "integrate/media_gather_items.h"

KERNEL ENTRY(photon_camera_grids)(const rt_params params, global const rt_scene_header *header,
                                  global rt_gather_point *points, global rt_gather_point *caustics,
                                  uint stride, const rt_volume_params volume,
                                  const rt_photon_tree shape, global const rt_photon_node *nodes,
                                  global const rt_photon_block *blocks)
{
    follow_eye_paths(&params, header, points, caustics, stride, &volume, &shape, nodes, blocks);
}
