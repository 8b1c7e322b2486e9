/* test_columns.c - packed rows come back, and what is cut short or out of range is refused. */
#include "support.h"

#include <stdlib.h>
#include <string.h>

#include "film/columns.h"

/* A row with every kind of number, and bytes that are no member. */
typedef struct row {
    int64_t wide[3];
    uint32_t word;
    int32_t sign[2];
    uint32_t unused;
} row;

static const rt_member members[] = {{offsetof(row, wide), RT_NUMBER_64, 3},
                                    {offsetof(row, word), RT_NUMBER_U32, 1},
                                    {offsetof(row, sign), RT_NUMBER_I32, 2}};
static const rt_table table = {sizeof(row), members, 3};

enum { COLUMNS = 6 };

/* Vigna's splitmix64. */
static uint64_t next(uint64_t *state)
{
    uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

/* Numbers of any size and sign; of columns that are constant, and of the greatest ranges. */
static void fill(row *rows, size_t count, uint64_t *state)
{
    memset(rows, 0, count * sizeof *rows);
    for (int c = 0; c < 3; c++) {
        const unsigned shift = (unsigned)(next(state) % 65);
        const uint64_t base = next(state);
        for (size_t i = 0; i < count; i++) {
            const uint64_t value = base + (shift == 64 ? 0 : next(state) >> shift);
            memcpy(&rows[i].wide[c], &value, sizeof value);
        }
    }
    for (size_t i = 0; i < count; i++) {
        rows[i].word = i % 2 ? UINT32_MAX : (uint32_t)next(state);
        rows[i].sign[0] = i % 2 ? INT32_MIN : INT32_MAX;
        rows[i].sign[1] = -(int32_t)(i % 129);
    }
    rows[0].wide[0] = INT64_MIN;
    rows[count - 1].wide[0] = INT64_MAX;
}

static void rows_come_back_and_take_no_more_than_is_said(void **state)
{
    static row rows[RT_COLUMNS_ROWS], back[RT_COLUMNS_ROWS];
    static uint8_t bytes[RT_COLUMNS_ROWS * (sizeof(row) + COLUMNS) + COLUMNS * RT_COLUMN_HEAD +
                         RT_COLUMNS_BEYOND];
    uint64_t random = 1;
    (void)state;
    for (size_t count = 1; count <= RT_COLUMNS_ROWS; count++) {
        rt_writer w = {bytes};
        fill(rows, count, &random);
        assert_true(rt_columns_most(&table, count) <= sizeof bytes - RT_COLUMNS_BEYOND);
        rt_columns_put(&w, &table, rows, count);
        const size_t size = (size_t)(w.at - bytes);
        assert_true(size <= rt_columns_most(&table, count));
        /* A copy of the exact size, so that a sanitizer sees what is read beyond it. */
        uint8_t *copy = malloc(size);
        assert_non_null(copy);
        memcpy(copy, bytes, size);
        rt_reader r = {copy};
        memset(back, 0, sizeof back);
        assert_true(rt_columns_get(&r, copy + size, &table, back, count));
        assert_ptr_equal(r.at, copy + size);
        assert_memory_equal(rows, back, count * sizeof *rows);
        for (size_t cut = 0; cut < size; cut += 1 + size / 50) {
            r.at = copy;
            assert_false(rt_columns_get(&r, copy + cut, &table, back, count));
        }
        for (int i = 0; i < 2; i++) {
            const uint8_t before = copy[i];
            copy[i] = i == 0 ? 9 : 64;
            r.at = copy;
            assert_false(rt_columns_get(&r, copy + size, &table, back, count));
            copy[i] = before;
        }
        free(copy);
    }
}

/* The bytes of so many rows: all columns without differences but the one at this offset. */
static size_t pack(uint8_t *bytes, const row *rows, size_t count)
{
    rt_writer w = {bytes};
    rt_columns_put(&w, &table, rows, count);
    return (size_t)(w.at - bytes);
}

/* One signed byte reaches from -128 to 127. */
static void differences_take_the_bytes_that_they_need(void **state)
{
    static const struct {
        int64_t value;
        size_t width;
    } cases[] = {{0, 0},
                 {1, 1},
                 {-1, 1},
                 {127, 1},
                 {-128, 1},
                 {129, 2},
                 {128, 1},
                 {-129, 2},
                 {32767, 2},
                 {-32768, 1},
                 {-32767, 2},
                 {32768, 1},
                 {32769, 3},
                 {INT64_MAX, 8},
                 {INT64_MIN + 1, 8},
                 {255, 2},
                 {254, 1},
                 {INT64_C(3) << 61, 1},
                 {INT64_MIN, 1},
                 {(1 << 30) + 1, 4},
                 {1 - (1 << 30), 4},
                 {(INT64_C(1) << 31) + 1, 5}};
    uint8_t bytes[256];
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        row rows[2] = {{{0}, 0, {0}, 0}};
        rows[1].wide[1] = cases[i].value;
        assert_int_equal(pack(bytes, rows, 2), COLUMNS * RT_COLUMN_HEAD + 2 * cases[i].width);
    }
}

static void numbers_out_of_range_are_refused(void **state)
{
    static const struct {
        size_t column;
        uint64_t first;
        int sound;
    } cases[] = {{3, UINT32_MAX, 1},
                 {3, UINT64_C(1) << 32, 0},
                 {3, UINT64_MAX, 0},
                 {4, INT32_MAX, 1},
                 {4, UINT64_C(1) << 31, 0},
                 {4, UINT64_MAX, 1},
                 {4, UINT64_MAX - INT32_MAX, 1},
                 {4, UINT64_MAX - INT32_MAX - 1, 0}};
    uint8_t bytes[256];
    row rows[1] = {{{0}, 0, {0}, 0}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const size_t size = pack(bytes, rows, 1);
        rt_writer w = {bytes + cases[i].column * RT_COLUMN_HEAD + 2};
        rt_reader r = {bytes};
        row back;
        rt_put64(&w, cases[i].first);
        assert_int_equal(rt_columns_get(&r, bytes + size, &table, &back, 1), cases[i].sound);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_come_back_and_take_no_more_than_is_said),
        cmocka_unit_test(differences_take_the_bytes_that_they_need),
        cmocka_unit_test(numbers_out_of_range_are_refused),
    };
    return cmocka_run_group_tests_name("lib/film/columns", tests, NULL, NULL);
}
