/* vertex_grid.c - packs light vertices, and sorts them by the kernels of vcm_grid.cl and
 * photon_order.cl. */
#include "mode/vcm/vertex_grid.h"

#include <string.h>

#include "base/error.h"

enum { DIGIT_BITS = 4, BINS = 1 << DIGIT_BITS, LEAST_BITS = 10, MOST_BITS = 24 };

static const char what[] = "the grid of light vertices";

rt_status rt_vertex_grid_create(rt_vertex_grid *g, rt_device *device, size_t paths, rt_error *error)
{
    memset(g, 0, sizeof *g);
    g->device = device;
    const struct {
        cl_kernel *out;
        const char *program, *name;
    } kernels[] = {{&g->pack, "vcm_grid", "vcm_pack"},
                   {&g->keys, "vcm_grid", "vcm_keys"},
                   {&g->points, "vcm_grid", "vcm_points"},
                   {&g->count, "photon_order", "count_digits"},
                   {&g->move, "photon_order", "move_items"}};
    rt_status status = rt_prefix_sum_create(&g->prefix, device, error);
    for (size_t i = 0; i < sizeof kernels / sizeof *kernels && status == RT_OK; i++)
        status = rt_device_kernel(device, kernels[i].out, kernels[i].program, kernels[i].name, NULL,
                                  error);
    if (status == RT_OK)
        status = rt_buffer_create(device, &g->firsts, CL_MEM_READ_WRITE, paths * sizeof(rt_u32),
                                  NULL, what, error);
    return status;
}

void rt_vertex_grid_release(rt_vertex_grid *g)
{
    if (!g->device)
        return;
    const cl_kernel kernels[] = {g->pack, g->keys, g->points, g->count, g->move};
    const cl_mem buffers[] = {g->list,   g->firsts, g->items,  g->spare,
                              g->places, g->order,  g->lights, g->begins};
    for (size_t i = 0; i < sizeof kernels / sizeof *kernels; i++)
        rt_kernel_release(kernels[i]);
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++)
        rt_buffer_release(g->device, buffers[i]);
    rt_prefix_sum_release(&g->prefix);
    memset(g, 0, sizeof *g);
}

void rt_vertex_grid_begin(rt_vertex_grid *g)
{
    g->filled = 0;
}

/* Makes room for so many more vertices, and keeps those that there are. */
static rt_status reserve(rt_vertex_grid *g, size_t more, rt_error *error)
{
    const size_t size = sizeof(rt_light_vertex), needed = g->filled + more;
    cl_mem larger = NULL;
    if (needed <= g->room && g->list)
        return RT_OK;
    const size_t room = needed + needed / 2 + 1;
    rt_status status =
        rt_buffer_create(g->device, &larger, CL_MEM_READ_WRITE, room * size, NULL, what, error);
    if (status == RT_OK && g->filled > 0)
        status = rt_buffer_copy(g->device, g->list, larger, 0, g->filled * size, error);
    if (status == RT_OK)
        status = rt_device_finish(g->device, error);
    rt_buffer_release(g->device, status == RT_OK ? g->list : larger);
    if (status == RT_OK) {
        g->list = larger;
        g->room = room;
    }
    return status;
}

rt_status rt_vertex_grid_add(rt_vertex_grid *g, cl_mem columns, cl_mem counts, cl_mem places,
                             rt_u32 slots, rt_u32 first, rt_u32 paths, rt_error *error)
{
    const size_t size = sizeof(rt_u32), last = paths - 1;
    rt_u32 place = 0, count = 0, base = (rt_u32)g->filled;
    rt_status status = rt_prefix_sum_run(&g->prefix, places, paths, error);
    if (status == RT_OK)
        status = rt_buffer_read(g->device, places, last * size, size, &place, error);
    if (status == RT_OK)
        status = rt_buffer_read(g->device, counts, (first + last) * size, size, &count, error);
    if (status == RT_OK && g->filled + place + count > RT_INDEX_MASK)
        status = rt_fail(error, RT_ERROR_MEMORY, "more than %u light vertices in an iteration",
                         RT_INDEX_MASK);
    if (status == RT_OK)
        status = reserve(g, (size_t)place + count, error);
    if (status != RT_OK)
        return status;
    rt_arg args[] = {RT_ARG(paths),   RT_ARG(first),     RT_ARG(slots),
                     RT_ARG(base),    RT_ARG(counts),    RT_ARG(places),
                     RT_ARG(columns), RT_ARG(g->firsts), RT_ARG(g->list)};
    g->filled += (size_t)place + count;
    return rt_run(g->device, g->pack, args, 9, paths, error);
}

/* One stable pass of the sort, by the digit from bit `shift` on. */
static rt_status sort_digit(rt_vertex_grid *g, rt_u32 count, rt_u32 shift, rt_error *error)
{
    const size_t shares = (count + RT_SORT_SHARE - 1) / RT_SORT_SHARE;
    rt_arg counts[] = {RT_ARG(count), RT_ARG(shift), RT_ARG(g->items), RT_ARG(g->places)};
    rt_arg moves[] = {RT_ARG(count), RT_ARG(shift), RT_ARG(g->items), RT_ARG(g->places),
                      RT_ARG(g->spare)};
    rt_status status = rt_run(g->device, g->count, counts, 4, shares, error);
    if (status == RT_OK)
        status = rt_prefix_sum_run(&g->prefix, g->places, BINS * shares, error);
    if (status == RT_OK)
        status = rt_run(g->device, g->move, moves, 5, shares, error);
    const cl_mem swap = g->items;
    g->items = g->spare;
    g->spare = swap;
    return status;
}

/* Room for what is sorted. */
static rt_status reserve_order(rt_vertex_grid *g, size_t buckets, rt_error *error)
{
    const size_t count = g->filled, shares = (count + RT_SORT_SHARE - 1) / RT_SORT_SHARE;
    const struct {
        cl_mem *buffer;
        size_t bytes;
    } rooms[] = {{&g->items, count * sizeof(rt_u64)},
                 {&g->spare, count * sizeof(rt_u64)},
                 {&g->places, rt_prefix_sum_room(BINS * shares) * sizeof(rt_u32)},
                 {&g->order, count * sizeof(rt_merge_point)},
                 {&g->lights, count * sizeof(rt_merge_light)},
                 {&g->begins, (buckets + 1) * sizeof(rt_u32)}};
    rt_status status = reserve(g, 0, error);
    for (size_t i = 0; i < sizeof rooms / sizeof *rooms && status == RT_OK; i++)
        status = rt_buffer_reserve(g->device, rooms[i].buffer,
                                   rooms[i].bytes > 0 ? rooms[i].bytes : 16, what, error);
    return status;
}

rt_status rt_vertex_grid_sort(rt_vertex_grid *g, cl_mem scene, rt_vcm_params *vcm, rt_error *error)
{
    rt_u32 count = (rt_u32)g->filled, bits = LEAST_BITS;
    while (bits < MOST_BITS && ((size_t)1 << bits) < 2 * g->filled)
        bits++;
    vcm->bucket_bits = bits;
    rt_status status = reserve_order(g, (size_t)1 << bits, error);
    rt_arg keys[] = {
        RT_ARG(count), RT_ARG(scene), {sizeof *vcm, vcm}, RT_ARG(g->list), RT_ARG(g->items)};
    if (status == RT_OK && count > 0)
        status = rt_run(g->device, g->keys, keys, 5, count, error);
    for (rt_u32 bit = 0; bit < bits && status == RT_OK && count > 0; bit += DIGIT_BITS)
        status = sort_digit(g, count, RT_INDEX_BITS + bit, error);
    rt_arg points[] = {RT_ARG(count),    {sizeof *vcm, vcm}, RT_ARG(g->items), RT_ARG(g->list),
                       RT_ARG(g->order), RT_ARG(g->lights),  RT_ARG(g->begins)};
    return status == RT_OK ? rt_run(g->device, g->points, points, 7, (size_t)count + 1, error)
                           : status;
}
