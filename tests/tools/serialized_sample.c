/* serialized_sample.c - files of meshes as Mitsuba writes them. */
#include "tools/serialized_sample.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <zlib.h>

static void put(rt_bytes *bytes, const void *data, size_t size)
{
    assert_int_equal(rt_bytes_put(bytes, bytes->size, data, size, NULL), RT_OK);
}

static void put_number(rt_bytes *bytes, uint64_t value, int size)
{
    for (int i = 0; i < size; i++) {
        const uint8_t byte = (uint8_t)(value >> 8 * i & 0xff);
        put(bytes, &byte, 1);
    }
}

static void put_real(rt_bytes *bytes, double value, int is_double)
{
    const float single = (float)value;
    uint64_t bits = 0;
    uint32_t half;
    memcpy(&bits, &value, sizeof bits);
    memcpy(&half, &single, sizeof half);
    put_number(bytes, is_double ? bits : half, is_double ? 8 : 4);
}

void serialized_put_mesh(rt_bytes *file, int version, const rt_bytes *content)
{
    uLongf size = compressBound((uLong)content->size);
    Bytef *const packed = malloc(size);
    assert_non_null(packed);
    assert_int_equal(compress(packed, &size, content->data, (uLong)content->size), Z_OK);
    put_number(file, 0x041c, 2);
    put_number(file, (uint64_t)version, 2);
    put(file, packed, size);
    free(packed);
}

void serialized_put_table(rt_bytes *file, int version, const size_t *starts, size_t count)
{
    for (size_t i = 0; i < count; i++)
        put_number(file, starts[i], version == 3 ? 4 : 8);
    put_number(file, count, 4);
}

rt_bytes serialized_triangle(int version, int is_double, double z)
{
    static const double corners[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    rt_bytes out = {0};
    put_number(&out, 0x2 | 0x8 | (is_double ? 0x2000 : 0x1000), 4); /* with uv and colours */
    if (version == 4)
        put(&out, "mesh", 5);
    put_number(&out, 3, 8);
    put_number(&out, 1, 8);
    for (int i = 0; i < 9; i++)
        put_real(&out, i % 3 < 2 ? corners[i / 3][i % 3] : z, is_double);
    for (int i = 0; i < 6; i++)
        put_real(&out, corners[i / 2][i % 2], is_double);
    for (int i = 0; i < 9; i++)
        put_real(&out, i % 4 == 0, is_double);
    for (uint64_t i = 0; i < 3; i++)
        put_number(&out, i, 4);
    return out;
}
