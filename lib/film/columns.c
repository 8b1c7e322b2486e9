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

/*
 * The loops below are compiled twice, the second time for as many rows as there mostly are: a
 * compiler vectorises what has a fixed length.
 */
#if defined(__GNUC__)
#define INLINE static inline __attribute__((always_inline))
#else
#define INLINE static inline
#endif

INLINE uint64_t load(const uint8_t *at, rt_number number)
{
    uint64_t wide = 0;
    uint32_t word;
    int32_t sign;
    switch (number) {
    case RT_NUMBER_64:
        memcpy(&wide, at, 8);
        break;
    case RT_NUMBER_U32:
        memcpy(&word, at, 4);
        wide = word;
        break;
    case RT_NUMBER_I32:
        memcpy(&sign, at, 4);
        wide = (uint64_t)(int64_t)sign;
        break;
    }
    return wide;
}

/* Whether the words of a column, of four bytes, are all the same, as most counts are. */
INLINE int is_constant(const uint8_t *at, size_t stride, size_t count)
{
    uint32_t all = 0, first, word;
    memcpy(&first, at, 4);
    for (size_t i = 0; i < count; i++) {
        memcpy(&word, at + i * stride, 4);
        all |= word ^ first;
    }
    return all == 0;
}

/* How the differences of a column are stored: without so many bits, in so many bytes. */
typedef struct form {
    unsigned shift;
    size_t width;
} form;

/* The least that these numbers take, with their signs. */
INLINE form form_of(const uint64_t *values, size_t count)
{
    uint64_t all = 0, folded = 0;
    form f = {0, 0};
    /* Folded, the sign is the lowest bit: 0, -1, 1, -2, ... become 0, 1, 2, 3, ... */
    for (size_t i = 0; i < count; i++) {
        all |= values[i];
        folded |= values[i] << 1 ^ (0 - (values[i] >> 63));
    }
    if (all == 0)
        return f;
    for (; (all & 255) == 0; all >>= 8)
        f.shift += 8;
    for (; (all & 1) == 0; all >>= 1)
        f.shift++;
    for (folded >>= f.shift; folded > 0; folded >>= 8)
        f.width++;
    return f;
}

/* Drops low bits, with the sign in those that come in. */
INLINE void shift_values(uint64_t *values, size_t count, unsigned shift)
{
    for (size_t i = 0; i < count; i++)
        values[i] = values[i] >> shift | (0 - (values[i] >> 63)) << (63 - shift) << 1;
}

/* All eight bytes each time: those beyond the width belong to the next one. */
INLINE void put_values(uint8_t *at, const uint64_t *values, size_t count, size_t width)
{
    for (size_t i = 0; i < count; i++, at += width)
        rt_put64(&(rt_writer){at}, values[i]);
}

INLINE void put_column(rt_writer *w, const uint8_t *at, size_t stride, rt_number number,
                       size_t count)
{
    uint64_t values[RT_COLUMNS_ROWS];
    const uint64_t first = load(at, number);
    form f = {0, 0};
    if (number == RT_NUMBER_64 || !is_constant(at, stride, count)) {
        for (size_t i = 0; i < count; i++)
            values[i] = load(at + i * stride, number) - first;
        f = form_of(values, count);
    }
    *w->at++ = (uint8_t)f.width;
    *w->at++ = (uint8_t)f.shift;
    rt_put64(w, first);
    if (f.shift > 0)
        shift_values(values, count, f.shift);
    if (f.width > 0)
        put_values(w->at, values, count, f.width);
    w->at += count * f.width;
}

INLINE void put_number(rt_writer *w, const uint8_t *at, size_t stride, rt_number number,
                       size_t count)
{
    switch (number) {
    case RT_NUMBER_64:
        put_column(w, at, stride, RT_NUMBER_64, count);
        return;
    case RT_NUMBER_U32:
        put_column(w, at, stride, RT_NUMBER_U32, count);
        return;
    case RT_NUMBER_I32:
        put_column(w, at, stride, RT_NUMBER_I32, count);
        return;
    }
}

void rt_columns_put(rt_writer *w, const rt_table *table, const void *rows, size_t count)
{
    for (int m = 0; m < table->count; m++) {
        const rt_member *member = table->members + m;
        const uint8_t *at = (const uint8_t *)rows + member->offset;
        for (int c = 0; c < member->count; c++, at += size_of(member->number))
            if (count == RT_COLUMNS_ROWS)
                put_number(w, at, table->size, member->number, RT_COLUMNS_ROWS);
            else
                put_number(w, at, table->size, member->number, count);
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

/* Reads the numbers of a column after their first. */
static void get_values(uint64_t *out, rt_reader *r, const uint8_t *end, uint64_t first, form f,
                       size_t count)
{
    const uint64_t sign = f.width > 0 ? UINT64_C(1) << (8 * f.width - 1) : 0;
    for (size_t i = 0; i < count; i++, r->at += f.width) {
        const uint64_t bits =
            end - r->at < 8 ? get_narrow(r->at, f.width) : get_wide(r->at, f.width);
        out[i] = first + (((bits ^ sign) - sign) << f.shift);
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
    form f = {.width = *r->at++};
    f.shift = *r->at++;
    const uint64_t first = rt_get64(r);
    if (f.width > 8 || f.shift > 63 || count * f.width > (size_t)(end - r->at))
        return 0;
    get_values(values, r, end, first, f, count);
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
