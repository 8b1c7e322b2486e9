/* test_columns.c - packed columns of whole numbers come back, and what is cut short is refused. */
#include "support.h"

#include <stdlib.h>
#include <string.h>

#include "film/columns.h"

/* Vigna's splitmix64. */
static uint64_t next(uint64_t *state)
{
    uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

/* Numbers of any size and sign; of columns that are constant, and of the greatest ranges. */
static void fill(rt_block *b, uint64_t *state)
{
    for (size_t c = 0; c < b->columns; c++) {
        const unsigned shift = (unsigned)(next(state) % 65);
        const uint64_t base = next(state);
        for (size_t i = 0; i < b->rows; i++) {
            const uint64_t value = base + (shift == 64 ? 0 : next(state) >> shift);
            memcpy(&b->values[c][i], &value, sizeof value);
        }
    }
    b->values[0][0] = INT64_MIN;
    b->values[0][b->rows - 1] = INT64_MAX;
}

static void blocks_come_back_and_take_what_they_say(void **state)
{
    static rt_block block, back;
    static uint8_t bytes[RT_BLOCK_BYTES + RT_BLOCK_BEYOND];
    uint64_t random = 1;
    (void)state;
    for (size_t rows = 1; rows <= RT_BLOCK_ROWS; rows += 17) {
        rt_writer w = {bytes};
        block.rows = back.rows = rows;
        block.columns = back.columns = 1 + next(&random) % RT_BLOCK_COLUMNS;
        fill(&block, &random);
        rt_block_put(&w, &block);
        const size_t size = rt_block_size(&block);
        assert_int_equal(w.at - bytes, size);
        assert_true(size <= RT_BLOCK_BYTES);
        /* A copy of the exact size, so that a sanitizer sees what is read beyond it. */
        uint8_t *copy = malloc(size);
        assert_non_null(copy);
        memcpy(copy, bytes, size);
        rt_reader r = {copy};
        assert_true(rt_block_get(&r, copy + size, &back));
        assert_ptr_equal(r.at, copy + size);
        for (size_t c = 0; c < block.columns; c++)
            assert_memory_equal(block.values[c], back.values[c], rows * sizeof *back.values[c]);
        for (size_t cut = 0; cut < size; cut += 1 + size / 50) {
            r.at = copy;
            assert_false(rt_block_get(&r, copy + cut, &back));
        }
        copy[8] = 9;
        r.at = copy;
        assert_false(rt_block_get(&r, copy + size, &back));
        free(copy);
    }
}

static void what_is_the_same_in_all_rows_takes_no_bytes_a_row(void **state)
{
    static rt_block block = {.rows = RT_BLOCK_ROWS, .columns = 3};
    (void)state;
    for (size_t i = 0; i < block.rows; i++) {
        block.values[1][i] = -77;
        block.values[2][i] = 1000 + (int64_t)i;
    }
    assert_int_equal(rt_block_size(&block), 3 * 9 + block.rows);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_come_back_and_take_what_they_say),
        cmocka_unit_test(what_is_the_same_in_all_rows_takes_no_bytes_a_row),
    };
    return cmocka_run_group_tests_name("lib/film/columns", tests, NULL, NULL);
}
