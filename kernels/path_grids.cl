/*
 * path_grids.cl - as path_media.cl, of scenes where the density of a medium lies on a grid.
 */
#define RT_RADIANCE_ALONE
#define RT_GRIDS
#include "entry.h"
#include "integrate/media_samples.h"

KERNEL ENTRY(path_grids)(const rt_params params, global const rt_scene_header *header,
                         global rt_film_pixel *film, global const uint *rates)
{
    sample_items(&params, header, film, rates);
}
