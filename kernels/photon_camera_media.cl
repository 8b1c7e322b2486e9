/*
 * photon_camera_media.cl - the camera paths of photon mapping in scenes with media that scatter,
 * all of them homogeneous, as photon_camera.cl: each work-item follows one sample of each of a few
 * pixels to its gather points, and gathers the volume photons along it.
 */
#define RT_RADIANCE_ALONE
#include "entry.h"
#include "integrate/media_gather_items.h"

KERNEL photon_camera_media(const rt_params params, global const rt_scene_header *header,
                           global rt_gather_point *points, global rt_gather_point *caustics,
                           uint stride, const rt_volume_params volume, const rt_photon_tree shape,
                           global const rt_photon_node *nodes, global const rt_photon_block *blocks)
{
    follow_eye_paths(&params, header, points, caustics, stride, &volume, &shape, nodes, blocks);
}
