/* photon_packer.c - packs photons on the device, a part of a batch at a time, and reads them. */
#include "photon/photon_packer.h"

#include <string.h>

#include "base/memory.h"

/* Photons that are read at a time: 32 MiB. */
enum { ROOM = 1 << 19 };

rt_status rt_photon_packer_create(rt_photon_packer *out, rt_device *device, size_t paths,
                                  size_t slots, rt_error *error)
{
    memset(out, 0, sizeof *out);
    out->device = device;
    /* Room for any one path. */
    out->room = paths * slots < ROOM ? paths * slots : slots < ROOM ? ROOM : slots;
    rt_status status =
        rt_device_kernel(device, &out->kernel, "photon_pack", "photon_pack", NULL, error);
    if (status == RT_OK)
        status =
            rt_device_kernel(device, &out->counts, "photon_pack", "photon_counts", NULL, error);
    if (status == RT_OK)
        status = rt_prefix_sum_create(&out->prefix, device, error);
    if (status == RT_OK)
        status = rt_buffer_create(device, &out->places, CL_MEM_READ_WRITE,
                                  rt_prefix_sum_room(paths + 1) * sizeof(rt_u32), NULL,
                                  "the places of packed photons", error);
    if (status == RT_OK)
        status =
            rt_buffer_create(device, &out->packed, CL_MEM_READ_WRITE, out->room * sizeof(rt_photon),
                             NULL, "the buffer of packed photons", error);
    if (status == RT_OK) {
        out->host = rt_memory_alloc(device->memory, paths + 1, sizeof *out->host,
                                    "the places of packed photons", error);
        status = out->host ? RT_OK : RT_ERROR_MEMORY;
    }
    if (status != RT_OK)
        rt_photon_packer_release(out);
    return status;
}

void rt_photon_packer_release(rt_photon_packer *packer)
{
    rt_kernel_release(packer->kernel);
    rt_kernel_release(packer->counts);
    rt_prefix_sum_release(&packer->prefix);
    rt_buffer_release(packer->device, packer->places);
    rt_buffer_release(packer->device, packer->packed);
    rt_memory_free(packer->host);
    memset(packer, 0, sizeof *packer);
}

/* Finds where the photons of each path go; returns how many photons were left out. */
static uint64_t find_places(rt_u32 *places, const rt_path_account *accounts, size_t count)
{
    uint64_t rejected = 0;
    places[0] = 0;
    for (size_t i = 0; i < count; i++) {
        places[i + 1] = places[i] + accounts[i].photons;
        rejected += accounts[i].rejected;
    }
    return rejected;
}

/* Packs the paths from `first` to before `end`, behind `at` photons. */
static rt_status pack(rt_photon_packer *packer, cl_mem out, size_t at, cl_mem slots, size_t row,
                      size_t first, size_t end, rt_error *error)
{
    rt_u32 first_path = (rt_u32)first, end_path = (rt_u32)end, row_paths = (rt_u32)row,
           at_photon = (rt_u32)at;
    rt_arg args[] = {
        RT_ARG(first_path), RT_ARG(end_path),  RT_ARG(row_paths), RT_ARG(packer->places),
        RT_ARG(slots),      RT_ARG(at_photon), RT_ARG(out)};
    return rt_run(packer->device, packer->kernel, args, sizeof args / sizeof *args, end - first,
                  error);
}

/* Packs such paths, and reads their photons. */
static rt_status take(rt_photon_packer *packer, rt_photon *out, cl_mem slots, size_t row,
                      size_t first, size_t end, rt_error *error)
{
    size_t photons = packer->host[end] - packer->host[first];
    rt_status status = pack(packer, packer->packed, 0, slots, row, first, end, error);
    return status == RT_OK ? rt_buffer_read(packer->device, packer->packed, 0,
                                            photons * sizeof *out, out, error)
                           : status;
}

rt_status rt_photon_packer_append(rt_photon_packer *packer, rt_photon_list *list, cl_mem slots,
                                  size_t row, const rt_path_account *accounts, size_t path_count,
                                  rt_error *error)
{
    rt_u32 *places = packer->host;
    uint64_t rejected = find_places(places, accounts, path_count);
    rt_status status = rt_photon_list_reserve(list, places[path_count], error);
    if (status == RT_OK && places[path_count] > 0)
        status = rt_buffer_write(packer->device, packer->places, 0,
                                 (path_count + 1) * sizeof *places, places, error);
    rt_photon *out = list->photons + list->count;
    for (size_t first = 0, end = 0; first < path_count && status == RT_OK; first = end) {
        while (end < path_count && places[end + 1] - places[first] <= packer->room)
            end++;
        if (places[end] > places[first])
            status = take(packer, out + places[first], slots, row, first, end, error);
    }
    if (status == RT_OK) {
        list->count += places[path_count];
        list->emitted += path_count;
        list->rejected += rejected;
    }
    return status;
}

rt_status rt_photon_packer_keep(rt_photon_packer *packer, const rt_photon_list *list, cl_mem slots,
                                size_t row, cl_mem accounts, size_t path_count, rt_error *error)
{
    rt_u32 paths = (rt_u32)path_count;
    rt_arg args[] = {RT_ARG(paths), RT_ARG(accounts), RT_ARG(packer->places)};
    rt_status status = rt_run(packer->device, packer->counts, args, 3, path_count + 1, error);
    if (status == RT_OK)
        status = rt_prefix_sum_run(&packer->prefix, packer->places, path_count + 1, error);
    return status == RT_OK
               ? pack(packer, list->buffer, list->count, slots, row, 0, path_count, error)
               : status;
}
