/* rays.c - reads the counters of rays from the device. */
#include "base/error.h"
#include "render/renderer.h"

/* Reads the place of the counters, and these. */
static rt_status read_slots(const rt_renderer *renderer,
                            rt_u32 slots[RT_COUNTER_SLOTS][RT_SCENE_ROW / 4], rt_error *error)
{
    rt_scene_header header;
    rt_device *device = renderer->device;
    rt_status status = rt_buffer_read(device, renderer->scene, 0, sizeof header, &header, error);
    return status == RT_OK
               ? rt_buffer_read(device, renderer->scene, (size_t)header.counters * RT_SCENE_ROW,
                                RT_COUNTER_SLOTS * RT_SCENE_ROW, slots, error)
               : status;
}

rt_status rt_renderer_get_rays(const rt_renderer *renderer, rt_ray_counts *out, rt_error *error)
{
    rt_u32 slots[RT_COUNTER_SLOTS][RT_SCENE_ROW / 4];
    uint64_t sums[RT_COUNTERS] = {0};
    if (rt_is_missing(renderer, "renderer", error))
        return RT_ERROR_USAGE;
    if (!renderer->device->count_rays)
        return rt_fail(error, RT_ERROR_USAGE, "the device counts no rays");
    rt_status status = read_slots(renderer, slots, error);
    if (status != RT_OK)
        return status;
    for (int slot = 0; slot < RT_COUNTER_SLOTS; slot++)
        for (int c = 0; c < RT_COUNTERS; c++)
            sums[c] += slots[slot][2 * c] + ((uint64_t)slots[slot][2 * c + 1] << 32);
    *out = (rt_ray_counts){.camera = sums[RT_COUNTER_CAMERA],
                           .bounce = sums[RT_COUNTER_BOUNCE],
                           .shadow = sums[RT_COUNTER_SHADOW],
                           .photon = sums[RT_COUNTER_PHOTON],
                           .nodes = sums[RT_COUNTER_NODES],
                           .leaves = sums[RT_COUNTER_LEAVES],
                           .shadow_nodes = sums[RT_COUNTER_SHADOW_NODES],
                           .shadow_leaves = sums[RT_COUNTER_SHADOW_LEAVES]};
    return RT_OK;
}
