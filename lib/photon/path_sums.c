/* path_sums.c - each work-item sums some of the paths; then runs of these sums are added. */
#include "photon/path_sums.h"

#include <string.h>

#include "base/memory.h"

static const char what[] = "the sums of photon paths";

static size_t runs_of(size_t rows)
{
    return (rows + RT_SUM_RUN - 1) / RT_SUM_RUN;
}

static size_t numbers_of(size_t sources)
{
    return (1 + sources) * RT_SUMS_A_ROW;
}

/* How many work-items sum the accounts of so many paths. */
static size_t items_of(size_t paths)
{
    return (paths + RT_PATH_SHARE - 1) / RT_PATH_SHARE;
}

/* How many rows all tables have together. */
static size_t room_of(size_t paths)
{
    size_t level = items_of(paths), room = level;
    for (; level > 1; room += level)
        level = runs_of(level);
    return room;
}

static rt_status create_tables(rt_path_sums *s, const rt_light_sources *lights, rt_error *error)
{
    rt_i32 exponents[RT_PATH_SUMS_SOURCES] = {0};
    for (size_t i = 0; i < s->sources; i++)
        exponents[i] = rt_ledger_exponent(lights->sources + i);
    const size_t entries = s->sources ? lights->light_count : 0;
    rt_status status = rt_buffer_create(s->device, &s->of_light, CL_MEM_READ_ONLY,
                                        entries * sizeof *lights->of_light,
                                        entries ? lights->of_light : NULL, what, error);
    return status == RT_OK ? rt_buffer_create(s->device, &s->exponents, CL_MEM_READ_ONLY,
                                              sizeof exponents, exponents, what, error)
                           : status;
}

rt_status rt_path_sums_create(rt_path_sums *out, rt_device *device, const rt_light_sources *lights,
                              size_t paths, rt_error *error)
{
    memset(out, 0, sizeof *out);
    out->device = device;
    out->sources = lights->count <= RT_PATH_SUMS_SOURCES ? lights->count : 0;
    const size_t numbers = numbers_of(out->sources);
    rt_status status = rt_device_kernel(device, &out->sums, "path_sums", "path_sums", NULL, error);
    if (status == RT_OK)
        status = rt_device_kernel(device, &out->join, "path_sums", "join_sums", NULL, error);
    if (status == RT_OK)
        status = create_tables(out, lights, error);
    if (status == RT_OK)
        status = rt_buffer_create(device, &out->rows, CL_MEM_READ_WRITE,
                                  room_of(paths) * numbers * sizeof *out->host, NULL, what, error);
    if (status == RT_OK) {
        out->host = rt_memory_alloc(device->memory, numbers, sizeof *out->host, what, error);
        status = out->host ? RT_OK : RT_ERROR_MEMORY;
    }
    if (status != RT_OK)
        rt_path_sums_release(out);
    return status;
}

void rt_path_sums_release(rt_path_sums *s)
{
    rt_kernel_release(s->sums);
    rt_kernel_release(s->join);
    rt_buffer_release(s->device, s->of_light);
    rt_buffer_release(s->device, s->exponents);
    rt_buffer_release(s->device, s->rows);
    rt_memory_free(s->host);
    memset(s, 0, sizeof *s);
}

/* Adds the tables to one row of sums. Returns where it is. */
static rt_status join(const rt_path_sums *s, rt_u32 *at, size_t count, rt_u32 numbers,
                      rt_error *error)
{
    rt_u32 first = 0, level = (rt_u32)count;
    rt_status status = RT_OK;
    while (level > 1 && status == RT_OK) {
        rt_u32 to = first + level;
        const size_t runs = runs_of(level);
        rt_arg args[] = {RT_ARG(level), RT_ARG(numbers), RT_ARG(first), RT_ARG(to),
                         RT_ARG(s->rows)};
        status = rt_run(s->device, s->join, args, 5, runs * numbers, error);
        first = to;
        level = (rt_u32)runs;
    }
    *at = first;
    return status;
}

rt_status rt_path_sums_run(rt_path_sums *s, const rt_i64 **out, cl_mem accounts, size_t paths,
                           int with_sources, rt_error *error)
{
    rt_u32 count = (rt_u32)paths, items = (rt_u32)items_of(paths), at = 0;
    rt_u32 rows = with_sources ? 1 + (rt_u32)s->sources : 1, numbers = rows * RT_SUMS_A_ROW;
    rt_arg args[] = {RT_ARG(count),       RT_ARG(items),        RT_ARG(rows),   RT_ARG(accounts),
                     RT_ARG(s->of_light), RT_ARG(s->exponents), RT_ARG(s->rows)};
    rt_status status = rt_run(s->device, s->sums, args, 7, (size_t)items * rows, error);
    if (status == RT_OK)
        status = join(s, &at, items, numbers, error);
    if (status == RT_OK)
        status = rt_buffer_read(s->device, s->rows, (size_t)at * numbers * sizeof *s->host,
                                numbers * sizeof *s->host, s->host, error);
    if (status == RT_OK)
        *out = s->host;
    return status;
}
