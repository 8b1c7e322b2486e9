/* replicates.c - which samples of which replicate come next. */
#include "film/replicates.h"

/* Sets first and count of this replicate, up to its share of all samples. */
static rt_sample_range take(rt_sample_range s)
{
    uint32_t share = s.total / s.replicates + (s.replicate < s.total % s.replicates);
    uint32_t end = s.to < share ? s.to : share;
    s.first = s.from;
    s.count = end > s.from ? end - s.from : 0;
    return s;
}

rt_sample_range rt_sample_range_first(uint32_t total, int replicated)
{
    rt_sample_range s = {
        .total = total, .replicates = replicated ? RT_REPLICATES : 1, .to = replicated ? 1 : total};
    return take(s);
}

rt_sample_range rt_sample_range_next(rt_sample_range s)
{
    if (++s.replicate == s.replicates) {
        s.replicate = 0;
        s.from = s.to;
        s.to = rt_replicate_grow(s.to);
    }
    return take(s);
}

uint32_t rt_replicate_grow(uint32_t length)
{
    int is_power_of_two = (length & (length - 1)) == 0;
    if (length < 2)
        return length + 1;
    return is_power_of_two ? length + length / 2 : length / 3 * 4;
}
