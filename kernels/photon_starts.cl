/*
 * photon_starts.cl - the lights of photon paths and the cells of their starts, for a pilot that
 * fills the tables of photon/importance.h.
 */
#include "entry.h"
#include "photon/importance.h"
#include "sample/rng.h"

/*
 * starts: [item_count], the light and the cell, of 16^levels, of each path of photon_emit with
 * these params and shares; RT_NONE: no light.
 */
KERNEL photon_starts(const rt_params params, global const rt_scene_header *header,
                     global const rt_light_share *shares, uint levels, global uint2 *starts)
{
    const uint item = item_number();
    if (item >= params.item_count)
        return;
    const struct scene scene = scene_open(header);
    const struct sampler sampler =
        sampler_start(&scene, &params, RT_STREAM_PHOTONS, params.first_item + item);
    const float8 u = sampler_pair(&sampler, SET_START);
    float4 start = u.lo, turn = u.hi;
    uint2 found = (uint2)(RT_NONE, 0u);
    if (header->light_count > 0u) {
        warp_start(&scene, shares, &start, &turn);
        found.x = choose_emitter(shares, header->light_count, start.z);
        found.y =
            start_cell(start_widths(scene.lights + found.x), levels, (float4)(start.xy, turn.xy));
    }
    starts[item] = found;
}
