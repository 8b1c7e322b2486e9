/*
 * columns.h - arrays of structs in few bytes: in each column of some rows the differences from the
 * first number, without the low bits that are zero in all, in as many bytes as the greatest takes.
 * (Sums of floats are multiples of the last bit of the smallest.)
 */
#ifndef RT_LIB_FILM_COLUMNS_H
#define RT_LIB_FILM_COLUMNS_H

#include <stddef.h>

#include "base/wire.h"

/* What a member of a struct holds. */
typedef enum rt_number {
    RT_NUMBER_64, /* signed or not */
    RT_NUMBER_U32,
    RT_NUMBER_I32
} rt_number;

/* A member: `count` columns, one after the other. */
typedef struct rt_member {
    size_t offset;
    rt_number number;
    int count;
} rt_member;

/* A struct, of `size` bytes, as its members. */
typedef struct rt_table {
    size_t size;
    const rt_member *members;
    int count;
} rt_table;

enum {
    RT_COLUMNS_ROWS = 128, /* the most rows that are packed together */
    RT_COLUMN_HEAD = 10,   /* bytes of a column before its differences: form, first number */
    RT_COLUMNS_BEYOND = 8  /* bytes behind the rows that packing may change */
};

/* The most bytes that so many rows take. */
size_t rt_columns_most(const rt_table *table, size_t rows);

/* Packs up to RT_COLUMNS_ROWS rows; there is room for RT_COLUMNS_BEYOND bytes more. */
void rt_columns_put(rt_writer *w, const rt_table *table, const void *rows, size_t count);

/*
 * Reads as many rows back; 0 when they do not end before `end`, a width is above 8, a shift above
 * 63 or a number outside of its member's range.
 */
int rt_columns_get(rt_reader *r, const uint8_t *end, const rt_table *table, void *rows,
                   size_t count);

#endif
