/* exact_sum.c - sums in bins at fixed places. */
#include "base/exact_sum.h"

#include <math.h>
#include <string.h>

enum { bin_bits = 31, lowest_place = -1074, mantissa_bits = 52 };

static const uint64_t bin_mask = 0x7fffffff;

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
            sum->high += sign * digits[i];
        else if (bin + i == sum->bin)
            sum->low += sign * digits[i];
    }
}

void rt_exact_sum_join(rt_exact_sum *sum, const rt_exact_sum *other)
{
    rt_exact_sum more = *other;
    raise_to(sum, more.bin);
    raise_to(&more, sum->bin);
    /* Sums that came from a file may wrap around. */
    sum->high = (int64_t)((uint64_t)sum->high + (uint64_t)more.high);
    sum->low = (int64_t)((uint64_t)sum->low + (uint64_t)more.low);
}

double rt_exact_sum_value(const rt_exact_sum *sum)
{
    const int unit = bin_bits * (int)sum->bin + lowest_place;
    return ldexp((double)sum->high, unit + bin_bits) + ldexp((double)sum->low, unit);
}
