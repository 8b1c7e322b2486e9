/*
 * path_media.cl - path tracing of scenes with media that scatter, all of them homogeneous: each
 * work-item takes the samples of a few pixels.
 */
#define RT_RADIANCE_ALONE
#include "entry.h"
#include "integrate/media_samples.h"

KERNEL path_media(const rt_params params, global const rt_scene_header *header,
                  global rt_film_pixel *film, global const uint *rates)
{
    sample_items(&params, header, film, rates);
}
