/*
 * crc32.c - the CRC by sixteen bytes a step, with as many tables made at each call.
 *
 * Reference:
 *   Kounavis, Berry: "A Systematic Approach to Building High Performance Software-Based CRC
 *     Generators", ISCC 2005 (slicing).
 */
#include "base/crc32.h"

#include "base/wire.h"

enum { SLICES = 16 };

static void make_tables(uint32_t table[SLICES][256], int slices)
{
    for (uint32_t i = 0; i < 256; i++) {
        uint32_t c = i;
        for (int bit = 0; bit < 8; bit++)
            c = (c >> 1) ^ (c & 1 ? 0xedb88320u : 0);
        table[0][i] = c;
    }
    for (int k = 1; k < slices; k++)
        for (uint32_t i = 0; i < 256; i++)
            table[k][i] = (table[k - 1][i] >> 8) ^ table[0][table[k - 1][i] & 255];
}

/* Four bytes, which so many others follow in the step, by their tables. */
static uint32_t four(uint32_t table[SLICES][256], uint32_t bytes, int behind)
{
    return table[behind + 3][bytes & 255] ^ table[behind + 2][bytes >> 8 & 255] ^
           table[behind + 1][bytes >> 16 & 255] ^ table[behind][bytes >> 24];
}

uint32_t rt_crc32_add(uint32_t sum, const void *data, size_t size)
{
    uint32_t table[SLICES][256], c = ~sum;
    rt_reader r = {data};
    make_tables(table, size >= SLICES ? SLICES : 1);
    for (; size >= SLICES; size -= SLICES) {
        const uint32_t first = c ^ rt_get32(&r);
        const uint32_t second = rt_get32(&r), third = rt_get32(&r), last = rt_get32(&r);
        c = four(table, first, 12) ^ four(table, second, 8) ^ four(table, third, 4) ^
            four(table, last, 0);
    }
    for (; size > 0; size--)
        c = c >> 8 ^ table[0][(c ^ *r.at++) & 255];
    return ~c;
}

uint32_t rt_crc32(const void *data, size_t size)
{
    return rt_crc32_add(0, data, size);
}
