#include "render/replicates.h"

/* What a stretch of the replicate takes, which has its share of all samples at most. */
static rt_stretch take(rt_stretch s)
{
    uint32_t share = s.all / s.replicates + (s.replicate < s.all % s.replicates);
    uint32_t end = s.to < share ? s.to : share;
    s.first = s.from;
    s.count = end > s.from ? end - s.from : 0;
    return s;
}

rt_stretch rt_stretch_first(uint32_t all, int replicated)
{
    rt_stretch s = {
        .all = all, .replicates = replicated ? RT_REPLICATES : 1, .to = replicated ? 1 : all};
    return take(s);
}

rt_stretch rt_stretch_next(rt_stretch s)
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
