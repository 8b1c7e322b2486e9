/* exact_sum.c - sums in bins at fixed places. */
#include "base/exact_sum.h"

#include <math.h>
#include <string.h>

enum { bin_bits = 31, lowest_place = -1074, mantissa_bits = 52 };

static const uint64_t bin_mask = 0x7fffffff;

/* The sum of two, which wraps around where one came from a damaged file. */
static int64_t wrapped(int64_t a, int64_t b)
{
    return (int64_t)((uint64_t)a + (uint64_t)b);
}

/* Moves a sum up until its lower bin is at least this one. */
static void raise_to(rt_exact_sum *sum, int64_t bin)
{
    if (bin <= sum->bin)
        return;
    sum->low = bin == sum->bin + 1 ? sum->high : 0;
    sum->high = 0;
    sum->bin = bin;
}

void rt_exact_sum_add(rt_exact_sum *sum, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    const uint64_t exponent = bits >> mantissa_bits & 2047;
    const uint64_t mantissa =
        (bits & ((UINT64_C(1) << mantissa_bits) - 1)) | (uint64_t)(exponent > 0) << mantissa_bits;
    const int place = exponent > 0 ? (int)exponent - 1 : 0, bin = place / bin_bits,
              shift = place % bin_bits;
    const uint64_t rest = mantissa >> (bin_bits - shift);
    /* the digits in this bin and the two above */
    const int64_t digits[] = {(int64_t)(mantissa << shift & bin_mask), (int64_t)(rest & bin_mask),
                              (int64_t)(rest >> bin_bits)};
    const int64_t sign = bits >> 63 ? -1 : 1;
    int top = 2;
    while (top > 0 && digits[top] == 0)
        top--;
    if (digits[top] == 0)
        return;
    raise_to(sum, bin + top - 1);
    for (int i = 0; i <= top; i++) {
        if (bin + i == sum->bin + 1)
            sum->high = wrapped(sum->high, sign * digits[i]);
        else if (bin + i == sum->bin)
            sum->low = wrapped(sum->low, sign * digits[i]);
    }
}

void rt_exact_sum_join(rt_exact_sum *sum, const rt_exact_sum *other)
{
    rt_exact_sum more = *other;
    raise_to(sum, more.bin);
    raise_to(&more, sum->bin);
    sum->high = wrapped(sum->high, more.high);
    sum->low = wrapped(sum->low, more.low);
}

double rt_exact_sum_value(const rt_exact_sum *sum)
{
    const int unit = bin_bits * (int)sum->bin + lowest_place;
    return ldexp((double)sum->high, unit + bin_bits) + ldexp((double)sum->low, unit);
}
