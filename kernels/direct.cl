/*
 * direct.cl - emission and direct light alone: each work-item takes the samples of a few pixels.
 */
#define RT_RADIANCE_ALONE
#include "integrate/path_samples.h"

KERNEL ENTRY(direct)(const rt_params params, global const rt_scene_header *header,
                     global rt_film_pixel *film, global const uint *rates)
{
    sample_items(&params, header, film, rates, FOLLOW_DIRECT);
}
