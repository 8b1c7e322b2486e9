/* test_checksum.c - the checksum of large files is what its formulas say, and sees damage. */
#include "support.h"

#include <string.h>

#include "base/checksum.h"

enum { SIZE = 100 };

static void fill(uint8_t *data)
{
    for (int i = 0; i < SIZE; i++)
        data[i] = (uint8_t)i;
}

/* By another program, from the formulas of checksum.h. */
static void sums_are_those_of_the_formulas(void **state)
{
    uint8_t data[SIZE];
    (void)state;
    fill(data);
    assert_true(rt_checksum_of("", 0) == UINT64_C(0x973638d3ce0f3ad5));
    assert_true(rt_checksum_of("abc", 3) == UINT64_C(0x349fc82018a4a7f3));
    assert_true(rt_checksum_of("123456789", 9) == UINT64_C(0x5961a588d9ddb666));
    assert_true(rt_checksum_of(data, SIZE) == UINT64_C(0x2d7ff371a3b0d698));
}

static void pieces_make_the_sum_of_the_whole(void **state)
{
    uint8_t data[SIZE];
    (void)state;
    fill(data);
    const uint64_t whole = rt_checksum_of(data, SIZE);
    for (size_t each = 1; each <= SIZE; each++) {
        rt_checksum sum = rt_checksum_begin();
        for (size_t at = 0; at < SIZE; at += each)
            rt_checksum_add(&sum, data + at, each < SIZE - at ? each : SIZE - at);
        assert_true(rt_checksum_end(&sum) == whole);
    }
}

/* Every change of one byte, every swap of two words, and every length. */
static void damage_is_seen(void **state)
{
    uint8_t data[SIZE], damaged[SIZE];
    (void)state;
    fill(data);
    const uint64_t whole = rt_checksum_of(data, SIZE);
    for (int i = 0; i < SIZE; i++)
        for (int change = 1; change < 256; change++) {
            data[i] ^= (uint8_t)change;
            assert_true(rt_checksum_of(data, SIZE) != whole);
            data[i] ^= (uint8_t)change;
        }
    for (int i = 0; i < SIZE / 8; i++)
        for (int j = 0; j < i; j++) {
            memcpy(damaged, data, SIZE);
            memcpy(damaged + 8 * i, data + 8 * j, 8);
            memcpy(damaged + 8 * j, data + 8 * i, 8);
            assert_true(rt_checksum_of(damaged, SIZE) != whole);
        }
    memset(data, 0, SIZE);
    for (size_t size = 0; size < SIZE; size++)
        assert_true(rt_checksum_of(data, size) != rt_checksum_of(data, SIZE));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_are_those_of_the_formulas),
        cmocka_unit_test(pieces_make_the_sum_of_the_whole),
        cmocka_unit_test(damage_is_seen),
    };
    return cmocka_run_group_tests_name("lib/base/checksum", tests, NULL, NULL);
}
