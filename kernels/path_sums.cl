/*
 * path_sums.cl - the sums of the accounts of photon paths: what the energy ledger books, in whole
 * numbers of each light's unit, so that they are exact in whatever order.
 */
#include "entry.h"
#include "types.h"

/*
 * Flux in units of 2^exponent W, rounded half away from zero, at most 2^40 units: what the host's
 * ledger does in double precision.
 */
static inline long units_of(float flux, int exponent)
{
    const ulong most = 1ul << 40;
    const uint bits = as_uint(flux), power = bits >> 23 & 255u;
    const ulong digits = (bits & 0x7fffffu) | (power > 0u ? 0x800000u : 0u);
    const int shift = (int)max(power, 1u) - 150 - exponent;
    ulong units = 0ul;
    if (shift >= 0)
        units = digits == 0ul ? 0ul : shift >= 40 ? most : min(digits << shift, most);
    else if (shift >= -24)
        units = (digits + (1ul << (-shift - 1))) >> -shift;
    return bits >> 31 ? -(long)units : (long)units;
}

static inline long3 units3(global const float *flux, int exponent)
{
    return (long3)(units_of(flux[0], exponent), units_of(flux[1], exponent),
                   units_of(flux[2], exponent));
}

static inline bool is_finite3(global const float *v)
{
    return all(isfinite(vload3(0, v)));
}

static inline bool is_sound(global const rt_path_account *a)
{
    return is_finite3(a->emitted) && is_finite3(a->absorbed) && is_finite3(a->left) &&
           is_finite3(a->roulette);
}

/* Photons that paths stored and left out, and how many accounts are not finite. */
static inline void sum_totals(uint paths, uint item, uint items,
                              global const rt_path_account *accounts, global rt_i64 *row)
{
    long photons = 0, rejected = 0, unsound = 0;
    for (uint path = item; path < paths; path += items) {
        global const rt_path_account *a = accounts + path;
        photons += a->photons;
        rejected += a->rejected;
        unsound += a->light != RT_NONE && !is_sound(a);
    }
    row[RT_TOTAL_PHOTONS] = photons;
    row[RT_TOTAL_REJECTED] = rejected;
    row[RT_TOTAL_UNSOUND] = unsound;
}

/* The flux of a source's paths, in the columns of rt_ledger_row, and their number. */
static inline void sum_source(uint paths, uint item, uint items, uint source, int exponent,
                              global const uint *of_light, global const rt_path_account *accounts,
                              global rt_i64 *row)
{
    long3 emitted = (long3)(0), absorbed = (long3)(0), escaped = (long3)(0), cut_off = (long3)(0),
          roulette = (long3)(0);
    long count = 0;
    for (uint path = item; path < paths; path += items) {
        global const rt_path_account *a = accounts + path;
        if (a->light == RT_NONE || of_light[a->light] != source || !is_sound(a))
            continue;
        count++;
        emitted += units3(a->emitted, exponent);
        absorbed += units3(a->absorbed, exponent);
        roulette += units3(a->roulette, exponent);
        if (a->end == RT_END_ESCAPED)
            escaped += units3(a->left, exponent);
        else if (a->end != RT_END_ABSORBED)
            cut_off += units3(a->left, exponent);
    }
    vstore3(emitted, 0, row);
    vstore3(absorbed, 1, row);
    vstore3(escaped, 2, row);
    vstore3(cut_off, 3, row);
    vstore3(roulette, 4, row);
    row[RT_SUMS_A_ROW - 1] = count;
}

/*
 * rows: [items][row_count][RT_SUMS_A_ROW]; of each item's share of the paths, row 0 holds the
 * totals, and row 1 + i the sums of source i. of_light: the source of each light; exponents: of
 * each source's unit.
 */
KERNEL path_sums(uint paths, uint items, uint row_count, global const rt_path_account *accounts,
                 global const uint *of_light, global const int *exponents, global rt_i64 *rows)
{
    if (items == 0u)
        return;
    const uint item = item_number() % items, row = item_number() / items;
    if (row >= row_count)
        return;
    rows += ((size_t)item * row_count + row) * RT_SUMS_A_ROW;
    for (uint i = 0u; i < RT_SUMS_A_ROW; i++)
        rows[i] = 0;
    if (row == 0u)
        sum_totals(paths, item, items, accounts, rows);
    else
        sum_source(paths, item, items, row - 1u, exponents[row - 1u], of_light, accounts, rows);
}

/*
 * Each work-item adds one number of a run of `count` rows of `numbers`, from `first` on; the sums
 * go to the rows from `to` on.
 */
KERNEL join_sums(uint count, uint numbers, uint first, uint to, global rt_i64 *rows)
{
    if (numbers == 0u)
        return;
    const uint number = item_number() % numbers, run = item_number() / numbers;
    const uint begin = run * RT_SUM_RUN;
    if (begin >= count)
        return;
    const uint end = min(begin + RT_SUM_RUN, count);
    rt_i64 sum = 0;
    for (uint i = begin; i < end; i++)
        sum += rows[(size_t)(first + i) * numbers + number];
    rows[(size_t)(to + run) * numbers + number] = sum;
}
