/* columns.c - packs blocks of whole numbers, column by column. */
#include "film/columns.h"

/* Bytes before the differences: the least number, and how many bytes each difference takes. */
enum { HEAD = 9 };

/* A column's least number, and how many bytes the differences from it take. */
typedef struct span {
    uint64_t least;
    size_t width;
} span;

static span span_of(const int64_t *values, size_t rows)
{
    int64_t least = values[0], most = values[0];
    for (size_t i = 1; i < rows; i++) {
        least = values[i] < least ? values[i] : least;
        most = values[i] > most ? values[i] : most;
    }
    uint64_t range = (uint64_t)most - (uint64_t)least;
    span s = {(uint64_t)least, 0};
    for (; range > 0; range >>= 8)
        s.width++;
    return s;
}

size_t rt_block_size(const rt_block *b)
{
    size_t size = 0;
    for (size_t c = 0; c < b->columns; c++)
        size += HEAD + b->rows * span_of(b->values[c], b->rows).width;
    return size;
}

void rt_block_put(rt_writer *w, const rt_block *b)
{
    for (size_t c = 0; c < b->columns; c++) {
        const span s = span_of(b->values[c], b->rows);
        uint8_t *at = w->at + HEAD;
        rt_put64(w, s.least);
        *w->at = (uint8_t)s.width;
        /* All eight bytes each time: those beyond the width belong to the next one. */
        for (size_t i = 0; i < b->rows && s.width > 0; i++) {
            w->at = at + i * s.width;
            rt_put64(w, (uint64_t)b->values[c][i] - s.least);
        }
        w->at = at + b->rows * s.width;
    }
}

/* A number of so many bytes. */
static uint64_t get(const uint8_t *at, size_t width)
{
    uint64_t value = 0;
    for (size_t i = 0; i < width; i++)
        value |= (uint64_t)at[i] << (8 * i);
    return value;
}

static void get_column(const uint8_t *at, span s, int64_t *values, size_t rows)
{
    for (size_t i = 0; i < rows; i++) {
        const uint64_t value = s.least + get(at + i * s.width, s.width);
        memcpy(values + i, &value, sizeof value);
    }
}

int rt_block_get(rt_reader *r, const uint8_t *end, rt_block *b)
{
    for (size_t c = 0; c < b->columns; c++) {
        if (end - r->at < HEAD)
            return 0;
        span s = {.least = rt_get64(r)};
        s.width = *r->at++;
        if (s.width > 8 || b->rows * s.width > (size_t)(end - r->at))
            return 0;
        get_column(r->at, s, b->values[c], b->rows);
        r->at += b->rows * s.width;
    }
    return 1;
}
