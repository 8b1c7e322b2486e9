/* film.cl - the pixel of each work-item, for its test. */
#include "film.h"

kernel void pixels(const rt_params params, global uint *out)
{
    const uint i = (uint)get_global_id(0);
    if (i >= params.item_count)
        return;
    const uint2 at = pixel_of_item(&params, i);
    out[i] = at.y * params.width + at.x;
}
