/* coverage.c - sets of units of work. */
#include "film/coverage.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"

void rt_coverage_free(rt_coverage *coverage)
{
    free(coverage->ranges);
    *coverage = (rt_coverage){0};
}

/* The index of the first range that ends after this unit. */
static size_t find(const rt_coverage *coverage, uint64_t unit)
{
    size_t low = 0, high = coverage->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        const rt_unit_range *range = coverage->ranges + middle;
        if (range->first + range->count > unit)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

static rt_status reserve(rt_coverage *coverage, size_t count, rt_error *error)
{
    if (count <= coverage->capacity)
        return RT_OK;
    size_t capacity = 2 * count + 6;
    rt_unit_range *ranges = realloc(coverage->ranges, capacity * sizeof *ranges);
    if (!ranges)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for the list of what is rendered");
    coverage->ranges = ranges;
    coverage->capacity = capacity;
    return RT_OK;
}

rt_status rt_coverage_add(rt_coverage *coverage, rt_unit_range range, rt_error *error)
{
    const size_t i = find(coverage, range.first);
    const uint64_t end = range.first + range.count;
    if (range.count == 0)
        return RT_OK;
    if (i < coverage->count && coverage->ranges[i].first < end)
        return rt_fail(error, RT_ERROR_USAGE, "both hold some of the same samples");
    rt_status status = reserve(coverage, coverage->count + 1, error);
    if (status != RT_OK)
        return status;
    rt_unit_range *at = coverage->ranges + i;
    int joins_before = i > 0 && at[-1].first + at[-1].count == range.first;
    int joins_after = i < coverage->count && at->first == end;
    if (joins_before && joins_after) {
        at[-1].count += range.count + at->count;
        memmove(at, at + 1, (coverage->count - i - 1) * sizeof *at);
        coverage->count--;
    } else if (joins_before) {
        at[-1].count += range.count;
    } else if (joins_after) {
        at->first = range.first;
        at->count += range.count;
    } else {
        memmove(at + 1, at, (coverage->count - i) * sizeof *at);
        *at = range;
        coverage->count++;
    }
    return RT_OK;
}

int rt_coverage_overlaps(const rt_coverage *a, const rt_coverage *b)
{
    for (size_t i = 0, j = 0; i < a->count && j < b->count;) {
        const rt_unit_range *p = a->ranges + i, *q = b->ranges + j;
        if (p->first + p->count <= q->first)
            i++;
        else if (q->first + q->count <= p->first)
            j++;
        else
            return 1;
    }
    return 0;
}

int rt_coverage_includes(const rt_coverage *coverage, const rt_coverage *other)
{
    for (size_t i = 0; i < other->count; i++) {
        const rt_unit_range r = other->ranges[i];
        if (rt_coverage_gap(coverage, r.first, r.first + r.count).count > 0)
            return 0;
    }
    return 1;
}

rt_status rt_coverage_prepare(rt_coverage *coverage, const rt_coverage *other, rt_error *error)
{
    if (rt_coverage_overlaps(coverage, other))
        return rt_fail(error, RT_ERROR_USAGE, "both hold some of the same samples");
    return reserve(coverage, coverage->count + other->count, error);
}

rt_status rt_coverage_join(rt_coverage *coverage, const rt_coverage *other, rt_error *error)
{
    rt_status status = rt_coverage_prepare(coverage, other, error);
    for (size_t i = 0; i < other->count && status == RT_OK; i++)
        status = rt_coverage_add(coverage, other->ranges[i], error);
    return status;
}

uint64_t rt_coverage_units(const rt_coverage *coverage)
{
    uint64_t units = 0;
    for (size_t i = 0; i < coverage->count; i++)
        units += coverage->ranges[i].count;
    return units;
}

rt_unit_range rt_coverage_gap(const rt_coverage *coverage, uint64_t first, uint64_t end)
{
    size_t i = find(coverage, first);
    if (i < coverage->count && coverage->ranges[i].first <= first)
        first = coverage->ranges[i].first + coverage->ranges[i].count, i++;
    if (i < coverage->count && coverage->ranges[i].first < end)
        end = coverage->ranges[i].first;
    return (rt_unit_range){first, first < end ? end - first : 0};
}

uint64_t rt_coverage_prefix(const rt_coverage *coverage)
{
    return coverage->count > 0 && coverage->ranges[0].first == 0 ? coverage->ranges[0].count : 0;
}

rt_status rt_coverage_remove(rt_coverage *coverage, rt_unit_range range, rt_error *error)
{
    const uint64_t end = range.first + range.count;
    rt_coverage rest = {0};
    rt_status status = RT_OK;
    for (size_t i = 0; i < coverage->count && status == RT_OK; i++) {
        const rt_unit_range r = coverage->ranges[i];
        const uint64_t r_end = r.first + r.count;
        const uint64_t before = r_end < range.first ? r_end : range.first,
                       after = r.first > end ? r.first : end;
        if (r.first < before)
            status = rt_coverage_add(&rest, (rt_unit_range){r.first, before - r.first}, error);
        if (status == RT_OK && after < r_end)
            status = rt_coverage_add(&rest, (rt_unit_range){after, r_end - after}, error);
    }
    if (status != RT_OK) {
        rt_coverage_free(&rest);
        return status;
    }
    rt_coverage_free(coverage);
    *coverage = rest;
    return RT_OK;
}
