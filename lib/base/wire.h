/*
 * wire.h - numbers in files: little-endian, signed ones in two's complement, floats as IEEE 754,
 * whatever the machine.
 */
#ifndef RT_LIB_BASE_WIRE_H
#define RT_LIB_BASE_WIRE_H

#include <stdint.h>
#include <string.h>

/* Where the next number goes; the memory is known to suffice. */
typedef struct rt_writer {
    uint8_t *at;
} rt_writer;

/* Written out byte by byte, to a place of its own: compilers make one store of that. */
static inline void rt_put32(rt_writer *w, uint32_t value)
{
    uint8_t *to = w->at;
    to[0] = (uint8_t)value;
    to[1] = (uint8_t)(value >> 8);
    to[2] = (uint8_t)(value >> 16);
    to[3] = (uint8_t)(value >> 24);
    w->at = to + 4;
}

static inline void rt_put64(rt_writer *w, uint64_t value)
{
    uint8_t *to = w->at;
    to[0] = (uint8_t)value;
    to[1] = (uint8_t)(value >> 8);
    to[2] = (uint8_t)(value >> 16);
    to[3] = (uint8_t)(value >> 24);
    to[4] = (uint8_t)(value >> 32);
    to[5] = (uint8_t)(value >> 40);
    to[6] = (uint8_t)(value >> 48);
    to[7] = (uint8_t)(value >> 56);
    w->at = to + 8;
}

static inline void rt_put_double(rt_writer *w, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    rt_put64(w, bits);
}

static inline void rt_put_floats(rt_writer *w, const float *values, int count)
{
    for (int i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, values + i, sizeof bits);
        rt_put32(w, bits);
    }
}

/* What is read next; enough is known to be left for it. */
typedef struct rt_reader {
    const uint8_t *at;
} rt_reader;

static inline uint32_t rt_get32(rt_reader *r)
{
    const uint8_t *b = r->at;
    r->at += 4;
    return b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static inline int32_t rt_get_signed32(rt_reader *r)
{
    uint32_t bits = rt_get32(r);
    int32_t value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline uint64_t rt_get64(rt_reader *r)
{
    uint64_t low = rt_get32(r);
    return low | (uint64_t)rt_get32(r) << 32;
}

static inline int64_t rt_get_signed64(rt_reader *r)
{
    uint64_t bits = rt_get64(r);
    int64_t value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline double rt_get_double(rt_reader *r)
{
    uint64_t bits = rt_get64(r);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline void rt_get_floats(rt_reader *r, float *out, int count)
{
    for (int i = 0; i < count; i++) {
        uint32_t bits = rt_get32(r);
        memcpy(out + i, &bits, sizeof bits);
    }
}

#endif
