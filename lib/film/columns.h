/*
 * columns.h - rows of whole numbers in few bytes: in each column of a block the differences from
 * its least number, in as many bytes as the greatest of them takes.
 */
#ifndef RT_LIB_FILM_COLUMNS_H
#define RT_LIB_FILM_COLUMNS_H

#include <stddef.h>

#include "base/wire.h"

enum {
    RT_BLOCK_ROWS = 256,
    RT_BLOCK_COLUMNS = 18, /* the most there are */
    /* the most that a block takes: its columns, each after its least number and its width */
    RT_BLOCK_BYTES = RT_BLOCK_COLUMNS * (9 + 8 * RT_BLOCK_ROWS),
    RT_BLOCK_BEYOND = 8 /* bytes behind it that writing may change */
};

/* Some rows, of all or of the first few columns. */
typedef struct rt_block {
    size_t rows, columns;
    int64_t values[RT_BLOCK_COLUMNS][RT_BLOCK_ROWS];
} rt_block;

/* The bytes that a block takes. */
size_t rt_block_size(const rt_block *block);

/* Writes them; there is room for RT_BLOCK_BEYOND more. */
void rt_block_put(rt_writer *w, const rt_block *block);

/*
 * Reads the values of a block, whose rows and columns are set; 0 when it does not end before `end`
 * or a width is above 8.
 */
int rt_block_get(rt_reader *r, const uint8_t *end, rt_block *block);

#endif
