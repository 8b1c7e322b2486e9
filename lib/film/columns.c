/* columns.c - packs rows of whole numbers, column by column. */
#include "film/columns.h"

static size_t size_of(rt_number number)
{
    return number == RT_NUMBER_64 ? 8 : 4;
}

size_t rt_columns_most(const rt_table *table, size_t rows)
{
    size_t bytes = 0;
    for (int m = 0; m < table->count; m++) {
        /* Differences of numbers of four bytes may take five. */
        const size_t widest = table->members[m].number == RT_NUMBER_64 ? 8 : 5;
        bytes += (size_t)table->members[m].count * (RT_COLUMN_HEAD + widest * rows);
    }
    return bytes;
}

/* ---- Packing ------------------------------------------------------------------ */

/* The numbers of a column, as 64 bits. */
static void load_column(uint64_t *out, const uint8_t *at, size_t stride, rt_number number,
                        size_t count)
{
    switch (number) {
    case RT_NUMBER_64:
        for (size_t i = 0; i < count; i++)
            memcpy(out + i, at + i * stride, 8);
        return;
    case RT_NUMBER_U32:
        for (size_t i = 0; i < count; i++) {
            uint32_t value;
            memcpy(&value, at + i * stride, 4);
            out[i] = value;
        }
        return;
    case RT_NUMBER_I32:
        for (size_t i = 0; i < count; i++) {
            int32_t value;
            memcpy(&value, at + i * stride, 4);
            out[i] = (uint64_t)(int64_t)value;
        }
        return;
    }
}

/* The bytes that each of these numbers takes with its sign. */
static size_t width_of(const uint64_t *values, size_t count)
{
    uint64_t all = 0;
    size_t width = 0;
    /* The sign goes to the lowest bit: 0, -1, 1, -2, ... become 0, 1, 2, 3, ... */
    for (size_t i = 0; i < count; i++)
        all |= values[i] << 1 ^ (0 - (values[i] >> 63));
    for (; all > 0; all >>= 8)
        width++;
    return width;
}

static void put_column(rt_writer *w, const uint8_t *at, size_t stride, rt_number number,
                       size_t count)
{
    uint64_t values[RT_COLUMNS_ROWS];
    load_column(values, at, stride, number, count);
    const uint64_t first = count > 0 ? values[0] : 0;
    for (size_t i = 0; i < count; i++)
        values[i] -= first;
    const size_t width = width_of(values, count);
    *w->at++ = (uint8_t)width;
    rt_put64(w, first);
    /* All eight bytes each time: those beyond the width belong to the next one. */
    for (size_t i = 0; i < count && width > 0; i++) {
        rt_writer to = {w->at + i * width};
        rt_put64(&to, values[i]);
    }
    w->at += count * width;
}

void rt_columns_put(rt_writer *w, const rt_table *table, const void *rows, size_t count)
{
    for (int m = 0; m < table->count; m++) {
        const rt_member *member = table->members + m;
        const uint8_t *at = (const uint8_t *)rows + member->offset;
        for (int c = 0; c < member->count; c++, at += size_of(member->number))
            put_column(w, at, table->size, member->number, count);
    }
}

/* ---- Unpacking ---------------------------------------------------------------- */

/* A number of so many bytes, of which eight may be read. */
static uint64_t get_wide(const uint8_t *at, size_t width)
{
    rt_reader r = {at};
    return rt_get64(&r) & (width < 8 ? (UINT64_C(1) << (8 * width)) - 1 : UINT64_MAX);
}

static uint64_t get_narrow(const uint8_t *at, size_t width)
{
    uint64_t value = 0;
    for (size_t i = 0; i < width; i++)
        value |= (uint64_t)at[i] << (8 * i);
    return value;
}

/* Reads the numbers of a column, of `width` bytes after their first. */
static void get_values(uint64_t *out, rt_reader *r, const uint8_t *end, uint64_t first,
                       size_t width, size_t count)
{
    const uint64_t sign = width > 0 ? UINT64_C(1) << (8 * width - 1) : 0;
    for (size_t i = 0; i < count; i++, r->at += width) {
        const uint64_t bits = end - r->at < 8 ? get_narrow(r->at, width) : get_wide(r->at, width);
        out[i] = first + ((bits ^ sign) - sign);
    }
}

/* Stores the numbers of a column; whether all are in range. */
static int store_column(uint8_t *at, size_t stride, rt_number number, const uint64_t *values,
                        size_t count)
{
    uint64_t beyond = 0;
    for (size_t i = 0; i < count; i++, at += stride) {
        const uint32_t low = (uint32_t)values[i];
        switch (number) {
        case RT_NUMBER_64:
            memcpy(at, values + i, 8);
            break;
        case RT_NUMBER_U32:
            beyond |= values[i] >> 32;
            memcpy(at, &low, 4);
            break;
        case RT_NUMBER_I32:
            beyond |= (values[i] + (UINT64_C(1) << 31)) >> 32;
            memcpy(at, &low, 4);
            break;
        }
    }
    return beyond == 0;
}

static int get_column(rt_reader *r, const uint8_t *end, uint8_t *at, size_t stride,
                      rt_number number, size_t count)
{
    uint64_t values[RT_COLUMNS_ROWS];
    if (end - r->at < RT_COLUMN_HEAD)
        return 0;
    const size_t width = *r->at++;
    const uint64_t first = rt_get64(r);
    if (width > 8 || count * width > (size_t)(end - r->at))
        return 0;
    get_values(values, r, end, first, width, count);
    return store_column(at, stride, number, values, count);
}

int rt_columns_get(rt_reader *r, const uint8_t *end, const rt_table *table, void *rows,
                   size_t count)
{
    for (int m = 0; m < table->count; m++) {
        const rt_member *member = table->members + m;
        uint8_t *at = (uint8_t *)rows + member->offset;
        for (int c = 0; c < member->count; c++, at += size_of(member->number))
            if (!get_column(r, end, at, table->size, member->number, count))
                return 0;
    }
    return 1;
}
