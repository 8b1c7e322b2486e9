/*
 * path.cl - path tracing: each work-item takes the samples of a few pixels.
 */
#define RT_RADIANCE_ALONE
#include "integrate/path_samples.h"

KERNEL ENTRY(path)(const rt_params params, global const rt_scene_header *header,
                   global rt_film_pixel *film, global const uint *rates)
{
    sample_items(&params, header, film, rates, FOLLOW_ALL);
}
