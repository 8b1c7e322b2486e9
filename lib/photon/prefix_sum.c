/* prefix_sum.c - sums of runs, and sums of those, up to one run; then places from there down. */
#include "photon/prefix_sum.h"

#include <string.h>

/* Levels of the tables: 64^6 is more than 2^32. */
enum { LEVELS = 6 };

static size_t runs_of(size_t count)
{
    return (count + RT_SUM_RUN - 1) / RT_SUM_RUN;
}

rt_status rt_prefix_sum_create(rt_prefix_sum *out, rt_device *device, rt_error *error)
{
    memset(out, 0, sizeof *out);
    out->device = device;
    rt_status status = rt_device_kernel(device, &out->sum, "prefix_sum", "sum_runs", NULL, error);
    if (status == RT_OK)
        status = rt_device_kernel(device, &out->place, "prefix_sum", "place_runs", NULL, error);
    if (status != RT_OK)
        rt_prefix_sum_release(out);
    return status;
}

void rt_prefix_sum_release(rt_prefix_sum *prefix)
{
    rt_kernel_release(prefix->sum);
    rt_kernel_release(prefix->place);
    memset(prefix, 0, sizeof *prefix);
}

size_t rt_prefix_sum_room(size_t count)
{
    size_t room = count;
    for (size_t level = count; level > RT_SUM_RUN; room += level)
        level = runs_of(level);
    return room;
}

rt_status rt_prefix_sum_run(const rt_prefix_sum *p, cl_mem table, size_t count, rt_error *error)
{
    rt_u32 firsts[LEVELS] = {0}, counts[LEVELS] = {(rt_u32)count};
    int level = 0;
    rt_status status = RT_OK;
    for (; counts[level] > RT_SUM_RUN && status == RT_OK; level++) {
        firsts[level + 1] = firsts[level] + counts[level];
        counts[level + 1] = (rt_u32)runs_of(counts[level]);
        rt_arg args[] = {RT_ARG(counts[level]), RT_ARG(firsts[level]), RT_ARG(firsts[level + 1]),
                         RT_ARG(table)};
        status = rt_run(p->device, p->sum, args, 4, counts[level + 1], error);
    }
    for (rt_u32 from = RT_NONE; level >= 0 && status == RT_OK; from = firsts[level--]) {
        rt_arg args[] = {RT_ARG(counts[level]), RT_ARG(firsts[level]), RT_ARG(from), RT_ARG(table)};
        status = rt_run(p->device, p->place, args, 4, runs_of(counts[level]), error);
    }
    return status;
}
