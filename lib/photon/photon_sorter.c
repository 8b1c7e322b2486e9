/* photon_sorter.c - launches the kernels that find keys, and sorts by them digit for digit. */
#include "photon/photon_sorter.h"

#include <string.h>

#include "photon/point_order.h"

enum { DIGIT_BITS = 4, DIGITS = 3 * RT_CURVE_BITS / DIGIT_BITS, BINS = 1 << DIGIT_BITS };

/* Bytes of struct cells of kernels/photon_order.cl. */
enum { CELL_BYTES = 8 * 8 };

static const char what[] = "the order of photons";

static size_t runs_of(size_t count)
{
    return (count + RT_SUM_RUN - 1) / RT_SUM_RUN;
}

static rt_status create_kernels(rt_photon_sorter *s, rt_error *error)
{
    const struct {
        cl_kernel *out;
        const char *name;
    } kernels[] = {{&s->bounds, "photon_bounds"},  {&s->join_bounds, "join_bounds"},
                   {&s->sample, "sample_photons"}, {&s->most, "find_most"},
                   {&s->cells, "set_cells"},       {&s->keys, "photon_keys"},
                   {&s->count, "count_digits"},    {&s->move, "move_items"}};
    rt_status status = RT_OK;
    for (size_t i = 0; i < sizeof kernels / sizeof *kernels && status == RT_OK; i++)
        status = rt_device_kernel(s->device, kernels[i].out, "photon_order", kernels[i].name, NULL,
                                  error);
    return status;
}

rt_status rt_photon_sorter_create(rt_photon_sorter *out, rt_device *device, rt_error *error)
{
    unsigned char curve[RT_CURVE_BYTES];
    memset(out, 0, sizeof *out);
    out->device = device;
    rt_point_order_curve(curve);
    rt_status status = create_kernels(out, error);
    if (status == RT_OK)
        status = rt_prefix_sum_create(&out->prefix, device, error);
    if (status == RT_OK)
        status = rt_buffer_create(device, &out->curve, CL_MEM_READ_ONLY, sizeof curve, curve, what,
                                  error);
    if (status == RT_OK)
        status = rt_buffer_create(device, &out->samples, CL_MEM_READ_WRITE,
                                  3 * RT_ORDER_SAMPLE * sizeof(float), NULL, what, error);
    if (status == RT_OK)
        status = rt_buffer_create(device, &out->extremes, CL_MEM_READ_WRITE, 6 * sizeof(float),
                                  NULL, what, error);
    if (status == RT_OK)
        status =
            rt_buffer_create(device, &out->grid, CL_MEM_READ_WRITE, CELL_BYTES, NULL, what, error);
    if (status != RT_OK)
        rt_photon_sorter_release(out);
    return status;
}

void rt_photon_sorter_release(rt_photon_sorter *s)
{
    const cl_kernel kernels[] = {s->bounds, s->join_bounds, s->sample, s->most,
                                 s->cells,  s->keys,        s->count,  s->move};
    const cl_mem buffers[] = {s->curve, s->samples, s->extremes, s->grid,
                              s->boxes, s->items,   s->spare,    s->places};
    for (size_t i = 0; i < sizeof kernels / sizeof *kernels; i++)
        rt_kernel_release(kernels[i]);
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++)
        rt_buffer_release(s->device, buffers[i]);
    rt_prefix_sum_release(&s->prefix);
    memset(s, 0, sizeof *s);
}

/* Finds the box around all photons; *at: where it is among the boxes. */
static rt_status find_box(const rt_photon_sorter *s, rt_u32 *at, cl_mem photons, rt_u32 count,
                          rt_error *error)
{
    rt_u32 first = 0, boxes = (rt_u32)runs_of(count);
    rt_arg args[] = {RT_ARG(count), RT_ARG(photons), RT_ARG(s->boxes)};
    rt_status status = rt_run(s->device, s->bounds, args, 3, boxes, error);
    while (boxes > 1 && status == RT_OK) {
        rt_u32 to = first + boxes;
        rt_arg joined[] = {RT_ARG(boxes), RT_ARG(first), RT_ARG(to), RT_ARG(s->boxes)};
        status = rt_run(s->device, s->join_bounds, joined, 4, runs_of(boxes), error);
        first = to;
        boxes = (rt_u32)runs_of(boxes);
    }
    *at = first;
    return status;
}

/* Finds where most photons are, and sets the cells of the curve. */
static rt_status set_cells(const rt_photon_sorter *s, cl_mem photons, rt_u32 count, rt_error *error)
{
    rt_u32 samples = count < RT_ORDER_SAMPLE ? count : RT_ORDER_SAMPLE,
           aside = samples / RT_ORDER_FAR_OUT, box = 0;
    rt_arg sample[] = {RT_ARG(count), RT_ARG(samples), RT_ARG(photons), RT_ARG(s->samples)};
    rt_arg most[] = {RT_ARG(samples), RT_ARG(aside), RT_ARG(s->samples), RT_ARG(s->extremes)};
    rt_arg cells[] = {RT_ARG(s->extremes), RT_ARG(box), RT_ARG(s->boxes), RT_ARG(s->grid)};
    rt_status status = find_box(s, &box, photons, count, error);
    if (status == RT_OK)
        status = rt_run(s->device, s->sample, sample, 4, 3 * (size_t)samples, error);
    if (status == RT_OK)
        status = rt_run(s->device, s->most, most, 4, 3 * (size_t)samples, error);
    return status == RT_OK ? rt_run(s->device, s->cells, cells, 4, 1, error) : status;
}

/* One stable pass of the sort, by the digit from bit `shift` on. */
static rt_status sort_digit(rt_photon_sorter *s, rt_u32 count, rt_u32 shift, rt_error *error)
{
    const size_t shares = (count + RT_SORT_SHARE - 1) / RT_SORT_SHARE;
    rt_arg counts[] = {RT_ARG(count), RT_ARG(shift), RT_ARG(s->items), RT_ARG(s->places)};
    rt_arg moves[] = {RT_ARG(count), RT_ARG(shift), RT_ARG(s->items), RT_ARG(s->places),
                      RT_ARG(s->spare)};
    rt_status status = rt_run(s->device, s->count, counts, 4, shares, error);
    if (status == RT_OK)
        status = rt_prefix_sum_run(&s->prefix, s->places, BINS * shares, error);
    if (status == RT_OK)
        status = rt_run(s->device, s->move, moves, 5, shares, error);
    const cl_mem swap = s->items;
    s->items = s->spare;
    s->spare = swap;
    return status;
}

static rt_status reserve(rt_photon_sorter *s, size_t count, rt_error *error)
{
    const size_t shares = (count + RT_SORT_SHARE - 1) / RT_SORT_SHARE;
    size_t boxes = 0;
    for (size_t level = count; level > 1 || boxes == 0; boxes += level)
        level = runs_of(level);
    rt_status status = rt_buffer_reserve(s->device, &s->items, count * sizeof(rt_u64), what, error);
    if (status == RT_OK)
        status = rt_buffer_reserve(s->device, &s->spare, count * sizeof(rt_u64), what, error);
    if (status == RT_OK)
        status = rt_buffer_reserve(s->device, &s->boxes, boxes * 6 * sizeof(float), what, error);
    if (status == RT_OK)
        status = rt_buffer_reserve(s->device, &s->places,
                                   rt_prefix_sum_room(BINS * shares) * sizeof(rt_u32), what, error);
    return status;
}

rt_status rt_photon_sorter_run(rt_photon_sorter *s, cl_mem photons, size_t count, rt_error *error)
{
    rt_u32 n = (rt_u32)count;
    rt_status status = reserve(s, count, error);
    if (status == RT_OK)
        status = set_cells(s, photons, n, error);
    if (status == RT_OK) {
        rt_arg keys[] = {RT_ARG(n), RT_ARG(photons), RT_ARG(s->grid), RT_ARG(s->curve),
                         RT_ARG(s->items)};
        status = rt_run(s->device, s->keys, keys, 5, count, error);
    }
    for (int digit = 0; digit < DIGITS && status == RT_OK; digit++)
        status = sort_digit(s, n, (rt_u32)(RT_INDEX_BITS + digit * DIGIT_BITS), error);
    return status;
}
