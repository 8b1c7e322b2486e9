/*
 * crc32.c - the CRC by four bytes per step, with four tables made at each call.
 *
 * Reference:
 *   Kounavis, Berry: "A Systematic Approach to Building High Performance Software-Based CRC
 *     Generators", ISCC 2005 (slicing).
 */
#include "base/crc32.h"

static void make_tables(uint32_t table[4][256])
{
    for (uint32_t i = 0; i < 256; i++) {
        uint32_t c = i;
        for (int bit = 0; bit < 8; bit++)
            c = (c >> 1) ^ (c & 1 ? 0xedb88320u : 0);
        table[0][i] = c;
    }
    for (uint32_t i = 0; i < 256; i++)
        for (int k = 1; k < 4; k++)
            table[k][i] = (table[k - 1][i] >> 8) ^ table[0][table[k - 1][i] & 255];
}

uint32_t rt_crc32(const void *data, size_t size)
{
    const uint8_t *at = data;
    uint32_t table[4][256], c = 0xffffffffu;
    make_tables(table);
    for (; size >= 4; size -= 4, at += 4) {
        c ^= at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
        c = table[3][c & 255] ^ table[2][(c >> 8) & 255] ^ table[1][(c >> 16) & 255] ^
            table[0][c >> 24];
    }
    for (; size > 0; size--, at++)
        c = (c >> 8) ^ table[0][(c ^ *at) & 255];
    return c ^ 0xffffffffu;
}
