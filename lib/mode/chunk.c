/* chunk.c - parts of a picture for schedulers of others. */
#include "base/error.h"
#include "film/units.h"
#include "setting/options.h"

/* The units of a picture; fails where the options are wrong. */
static rt_status units_of(rt_units *out, const rt_render_options *options, rt_error *error)
{
    rt_status status = rt_render_options_check(options, error);
    if (status != RT_OK)
        return status;
    rt_render_options complete = *options;
    rt_options_complete(&complete);
    *out = rt_units_of(&complete, 0);
    return RT_OK;
}

rt_status rt_chunk_count(uint64_t *out, const rt_render_options *options, rt_error *error)
{
    rt_units units;
    rt_status status = units_of(&units, options, error);
    if (status == RT_OK)
        *out = rt_units_chunks(&units);
    return status;
}

/* The units of `count` chunks from `chunk` on. */
static void join_chunks(uint64_t *first, uint64_t *units, const rt_units *all, uint64_t chunk,
                        uint64_t count)
{
    const rt_unit_range begin = rt_units_chunk(all, chunk),
                        last = rt_units_chunk(all, chunk + count - 1);
    *first = begin.first;
    *units = last.first + last.count - begin.first;
}

rt_status rt_chunk_units(uint64_t *first, uint64_t *units, const rt_render_options *options,
                         uint64_t chunk, uint64_t count, rt_error *error)
{
    rt_units all;
    rt_status status = units_of(&all, options, error);
    if (status != RT_OK)
        return status;
    const uint64_t chunks = rt_units_chunks(&all);
    if (chunk >= chunks || count == 0 || count > chunks - chunk)
        return rt_fail(error, RT_ERROR_USAGE, "%llu chunks from number %llu on, of %llu in all",
                       (unsigned long long)count, (unsigned long long)chunk,
                       (unsigned long long)chunks);
    join_chunks(first, units, &all, chunk, count);
    return RT_OK;
}

rt_status rt_chunk_task(uint64_t *first, uint64_t *units, const rt_render_options *options,
                        uint64_t task, uint64_t tasks, rt_error *error)
{
    rt_units all;
    rt_status status = units_of(&all, options, error);
    if (status != RT_OK)
        return status;
    if (task >= tasks)
        return rt_fail(error, RT_ERROR_USAGE, "task %llu, counted from 0, of %llu",
                       (unsigned long long)task, (unsigned long long)tasks);
    /* The first tasks have a chunk more where tasks do not divide the chunks. */
    const uint64_t chunks = rt_units_chunks(&all), each = chunks / tasks, rest = chunks % tasks;
    const uint64_t count = each + (task < rest);
    const uint64_t before = task * each + (task < rest ? task : rest);
    *first = *units = 0;
    if (count > 0)
        join_chunks(first, units, &all, chunks - before - count, count);
    return RT_OK;
}

/* One range, handed out once. */
typedef struct once {
    uint64_t first, count;
} once;

static rt_units_answer next(void *user, uint64_t *first, uint64_t *count)
{
    once *units = user;
    const rt_units_answer answer = units->count > 0 ? RT_UNITS_GIVEN : RT_UNITS_NONE;
    *first = units->first;
    *count = units->count;
    units->count = 0;
    return answer;
}

rt_status rt_chunk_render(rt_film **out, rt_renderer *renderer, const rt_render_options *options,
                          uint64_t chunk, uint64_t count, rt_error *error)
{
    if (rt_is_missing(renderer, "renderer", error) || rt_is_missing(options, "options", error))
        return RT_ERROR_USAGE;
    rt_render_options o = *options;
    once units;
    rt_status status = rt_chunk_units(&units.first, &units.count, options, chunk, count, error);
    if (status != RT_OK)
        return status;
    o.next_units = next;
    o.units_user = &units;
    return rt_render(out, renderer, &o, error);
}
