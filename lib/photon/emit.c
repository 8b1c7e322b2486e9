#include "photon/emit.h"

#include "error.h"

/* Bounds of a batch: the memory of its slots, and its length, so that progress moves. */
enum { SLOT_BYTES_A_BATCH = 1 << 26, PATHS_A_BATCH = 1 << 16 };

/* What a batch of paths leaves on the device. */
typedef struct batch {
    size_t paths;  /* at most */
    cl_mem slots;  /* rt_photon [paths][params.slots] */
    cl_mem counts; /* u32 [paths] */
} batch;

static rt_status create_batch(batch *b, rt_device *device, size_t slots, uint64_t paths, rt_error *error)
{
    size_t most = SLOT_BYTES_A_BATCH / (slots * sizeof(rt_photon));
    *b = (batch){most < 1 ? 1 : most > PATHS_A_BATCH ? PATHS_A_BATCH : most, NULL, NULL};
    if (b->paths > paths)
        b->paths = paths;
    rt_status status = rt_buffer_create(device, &b->slots, CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR,
                                        b->paths * slots * sizeof(rt_photon), NULL, "photon slots", error);
    if (status == RT_OK)
        status = rt_buffer_create(device, &b->counts, CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR,
                                  b->paths * sizeof(rt_u32), NULL, "photon counts", error);
    return status;
}

static void *map_for_reading(rt_device *device, cl_mem buffer, size_t bytes, rt_status *status, rt_error *error)
{
    cl_int code = CL_SUCCESS;
    void *memory = NULL;
    if (*status == RT_OK) {
        memory = clEnqueueMapBuffer(device->queue, buffer, CL_TRUE, CL_MAP_READ, 0, bytes, 0, NULL, NULL, &code);
        *status = rt_cl_check(code, "reading photons from the device", error);
    }
    return *status == RT_OK ? memory : NULL;
}

static void unmap(rt_device *device, cl_mem buffer, void *memory, rt_status *status, rt_error *error)
{
    if (!memory)
        return;
    cl_int code = clEnqueueUnmapMemObject(device->queue, buffer, memory, 0, NULL, NULL);
    if (*status == RT_OK)
        *status = rt_cl_check(code, "returning memory to the device", error);
}

/* Takes the photons of `paths` paths into the map; mapped memory is not copied where it is shared. */
static rt_status take_batch(rt_photon_map *map, rt_device *device, const batch *b, size_t paths, size_t slots,
                            rt_error *error)
{
    rt_status status = RT_OK;
    rt_u32 *counts = map_for_reading(device, b->counts, paths * sizeof *counts, &status, error);
    rt_photon *photons = map_for_reading(device, b->slots, paths * slots * sizeof *photons, &status, error);
    if (status == RT_OK)
        status = rt_photon_map_append(map, photons, counts, paths, slots, error);
    unmap(device, b->slots, photons, &status, error);
    unmap(device, b->counts, counts, &status, error);
    return status;
}

rt_status rt_photon_emit(rt_photon_map *map, rt_device *device, cl_kernel kernel, cl_mem scene, const rt_params *params,
                         uint64_t paths, rt_stage_progress *progress, rt_error *error)
{
    rt_params p = *params;
    batch b = {0};

    if (paths > UINT32_MAX)
        return rt_fail_field(error, RT_ERROR_USAGE, "photons", "%llu photon paths are more than the %lu possible",
                             (unsigned long long)paths, (unsigned long)UINT32_MAX);
    p.emitted = (float)paths;
    p.slots = p.max_depth > 1 ? p.max_depth - 1 : 1; /* one photon a segment at most */
    rt_status status = create_batch(&b, device, p.slots, paths, error);
    rt_arg args[] = {RT_ARG(p), RT_ARG(scene), RT_ARG(b.slots), RT_ARG(b.counts)};
    for (uint64_t done = 0; done < paths && status == RT_OK; done += p.item_count) {
        p.first_item = (rt_u32)done;
        p.item_count = (rt_u32)(paths - done < b.paths ? paths - done : b.paths);
        status = rt_kernel_args(kernel, args, 4, error);
        if (status == RT_OK)
            status = rt_launch(device, kernel, p.item_count, error);
        if (status == RT_OK)
            status = take_batch(map, device, &b, p.item_count, p.slots, error);
        if (status == RT_OK)
            status = rt_stage_update(progress, (double)(done + p.item_count) / (double)paths);
    }
    rt_buffer_release(b.slots);
    rt_buffer_release(b.counts);
    return status;
}
