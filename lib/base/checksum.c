/* checksum.c - the checksum of large files; checksum.h has its formulas. */
#include "base/checksum.h"

#include "base/wire.h"

enum { STEP = 8 * RT_CHECKSUM_LANES };

static const uint64_t factor = UINT64_C(0x9e3779b97f4a7c15);

rt_checksum rt_checksum_begin(void)
{
    return (rt_checksum){.lanes = {0, 1, 2, 3}};
}

/* A word for each lane, so many times. */
static void add_steps(rt_checksum *sum, const uint8_t *data, size_t steps)
{
    rt_reader r = {data};
    uint64_t lanes[RT_CHECKSUM_LANES];
    memcpy(lanes, sum->lanes, sizeof lanes);
    for (; steps > 0; steps--)
        for (int i = 0; i < RT_CHECKSUM_LANES; i++) {
            const uint64_t lane = (lanes[i] ^ rt_get64(&r)) * factor;
            lanes[i] = lane << 29 | lane >> 35;
        }
    memcpy(sum->lanes, lanes, sizeof lanes);
}

void rt_checksum_add(rt_checksum *sum, const void *data, size_t size)
{
    const uint8_t *at = data;
    const size_t held = (size_t)(sum->bytes % STEP);
    if (size == 0) /* data may be NULL */
        return;
    sum->bytes += size;
    if (held > 0) {
        const size_t some = size < STEP - held ? size : STEP - held;
        memcpy(sum->held + held, at, some);
        at += some;
        size -= some;
        if (held + some < STEP)
            return;
        add_steps(sum, sum->held, 1);
    }
    add_steps(sum, at, size / STEP);
    memcpy(sum->held, at + size / STEP * STEP, size % STEP);
}

uint64_t rt_checksum_end(const rt_checksum *sum)
{
    rt_checksum all = *sum;
    uint64_t result = sum->bytes;
    const size_t held = (size_t)(sum->bytes % STEP);
    if (held > 0) {
        memset(all.held + held, 0, STEP - held);
        add_steps(&all, all.held, 1);
    }
    for (int i = 0; i < RT_CHECKSUM_LANES; i++) {
        result = (result ^ all.lanes[i]) * factor;
        result ^= result >> 32;
    }
    return result;
}

uint64_t rt_checksum_of(const void *data, size_t size)
{
    rt_checksum sum = rt_checksum_begin();
    rt_checksum_add(&sum, data, size);
    return rt_checksum_end(&sum);
}
