/*
 * photon_order.cl - the order of photons along Hilbert's curve, as lib/photon/point_order.c has it
 * to the bit: cells in double precision, and a stable sort by the key, four bits at a time.
 */
#include "entry.h"
#include "types.h"

#ifdef cl_khr_fp64
#pragma OPENCL EXTENSION cl_khr_fp64 : enable

/* Where most photons are, and the cells of the curve, as point_order.c says. */
struct cells {
    double middle[3], reach;
    double origin[3], scale;
};

/* ---- The box around all photons, and where most are ---------------------------- */

/* The box of each run of photons: its low and its high corner. */
KERNEL photon_bounds(uint count, global const rt_photon *photons, global float *boxes)
{
    const uint run = item_number();
    const uint begin = run * RT_SUM_RUN;
    if (begin >= count)
        return;
    const uint end = min(begin + RT_SUM_RUN, count);
    float3 low = (float3)(INFINITY), high = (float3)(-INFINITY);
    for (uint i = begin; i < end; i++) {
        const float3 position = vload3(0, photons[i].position);
        low = fmin(low, position);
        high = fmax(high, position);
    }
    vstore3(low, 2 * run, boxes);
    vstore3(high, 2 * run + 1, boxes);
}

/* The box of each run of the `count` boxes from `first` on, to those from `to` on. */
KERNEL join_bounds(uint count, uint first, uint to, global float *boxes)
{
    const uint run = item_number();
    const uint begin = run * RT_SUM_RUN;
    if (begin >= count)
        return;
    const uint end = min(begin + RT_SUM_RUN, count);
    float3 low = (float3)(INFINITY), high = (float3)(-INFINITY);
    for (uint i = begin; i < end; i++) {
        low = fmin(low, vload3(2 * (first + i), boxes));
        high = fmax(high, vload3(2 * (first + i) + 1, boxes));
    }
    vstore3(low, 2 * (to + run), boxes);
    vstore3(high, 2 * (to + run) + 1, boxes);
}

/* samples: [3][sample_count], coordinates of photons at even distances in the list */
KERNEL sample_photons(uint count, uint sample_count, global const rt_photon *photons,
                      global float *samples)
{
    if (sample_count == 0u)
        return;
    const uint item = item_number(), axis = item / sample_count;
    if (axis >= 3u)
        return;
    const ulong i = item % sample_count;
    samples[item] = photons[i * count / sample_count].position[axis];
}

/*
 * The samples that `aside` others are below, and above, on each axis: most [2][3]. Each work-item
 * finds the rank of one sample; of equal ones, the first has the lowest.
 */
KERNEL find_most(uint sample_count, uint aside, global const float *samples, global float *most)
{
    if (sample_count == 0u)
        return;
    const uint item = item_number(), axis = item / sample_count;
    if (axis >= 3u)
        return;
    const uint own = item % sample_count;
    const float value = samples[item];
    uint rank = 0u;
    samples += axis * sample_count;
    for (uint i = 0u; i < sample_count; i++)
        rank += samples[i] < value || (samples[i] == value && i < own);
    if (rank == aside)
        most[axis] = value;
    if (rank == sample_count - 1u - aside)
        most[3u + axis] = value;
}

/* ---- Keys ---------------------------------------------------------------------- */

/* Along an axis: in units of the reach from the middle, and within [-2, 2] however far out. */
static inline double compress(double middle, double reach, float x)
{
    const double from = (x - middle) / reach, far = fabs(from);
    return far <= 1.0 ? from : copysign(2.0 - 1.0 / far, from);
}

/* One work-item sets the cells; box: the low and the high corner of that around all photons. */
KERNEL set_cells(global const float *most, uint box, global const float *boxes,
                 global struct cells *out)
{
    struct cells cells;
    double largest = 0.0;
    if (item_number() > 0)
        return;
    cells.reach = 0.0;
    for (uint axis = 0u; axis < 3u; axis++) {
        const double low = most[axis], high = most[3u + axis];
        cells.middle[axis] = 0.5 * (low + high);
        cells.reach = fmax(cells.reach, 0.75 * (high - low));
    }
    if (!(cells.reach > 0.0))
        cells.reach = 1.0;
    for (uint axis = 0u; axis < 3u; axis++) {
        const float low = boxes[6u * box + axis], high = boxes[6u * box + 3u + axis];
        cells.origin[axis] = compress(cells.middle[axis], cells.reach, low);
        largest =
            fmax(largest, compress(cells.middle[axis], cells.reach, high) - cells.origin[axis]);
    }
    cells.scale = largest > 0.0 ? (1 << RT_CURVE_BITS) * (1.0 - 1e-9) / largest : 0.0;
    *out = cells;
}

/* Two bits of an axis, moved apart to where they stand in a pair of octants. */
static inline uint apart(uint cell, uint bit)
{
    const uint two = cell >> bit & 3u;
    return (two & 1u) | (two & 2u) << 2;
}

/*
 * The key of a cell. curve: of each state and pair of octants, their places on the curve, and
 * behind all of those the state after them.
 */
static inline ulong hilbert_key(global const uchar *curve, uint3 cell)
{
    ulong key = 0ul;
    uint state = 0u;
    for (int bit = RT_CURVE_BITS - 2; bit >= 0; bit -= 2) {
        const uint at = state * 64u + (apart(cell.x, (uint)bit) | apart(cell.y, (uint)bit) << 1 |
                                       apart(cell.z, (uint)bit) << 2);
        key = key << 6 | curve[at];
        state = curve[RT_CURVE_STATES * 64u + at];
    }
    return key;
}

static inline uint cell_on(global const struct cells *cells, uint axis, float x)
{
    return (uint)((compress(cells->middle[axis], cells->reach, x) - cells->origin[axis]) *
                  cells->scale);
}

/* items: the key of each photon above its index in the list */
KERNEL photon_keys(uint count, global const rt_photon *photons, global const struct cells *cells,
                   global const uchar *curve, global ulong *items)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const float3 position = vload3(0, photons[i].position);
    const uint3 cell = (uint3)(cell_on(cells, 0u, position.x), cell_on(cells, 1u, position.y),
                               cell_on(cells, 2u, position.z));
    items[i] = hilbert_key(curve, cell) << RT_INDEX_BITS | i;
}
#endif

/* ---- Sorting ------------------------------------------------------------------- */

/* How many items of each of 16 digits a share has, eight bits a digit: shares have at most 255. */
struct digits {
    ulong low, high; /* of digits 0 to 7, and of the others */
};

static inline uint digit_count(const struct digits *digits, uint digit)
{
    return (uint)((digit < 8u ? digits->low : digits->high) >> 8u * (digit & 7u)) & 255u;
}

static inline void count_digit(struct digits *digits, uint digit)
{
    const ulong one = 1ul << 8u * (digit & 7u);
    digits->low += digit < 8u ? one : 0ul;
    digits->high += digit < 8u ? 0ul : one;
}

/* counts: [16][shares]; each work-item has a share of the items. */
KERNEL count_digits(uint count, uint shift, global const ulong *items, global uint *counts)
{
    const uint share = item_number();
    const uint begin = share * RT_SORT_SHARE, shares = (count + RT_SORT_SHARE - 1u) / RT_SORT_SHARE;
    if (share >= shares)
        return;
    const uint end = min(begin + RT_SORT_SHARE, count);
    struct digits digits = {0ul, 0ul};
    for (uint i = begin; i < end; i++)
        count_digit(&digits, (uint)(items[i] >> shift) & 15u);
    for (uint digit = 0u; digit < 16u; digit++)
        counts[digit * shares + share] = digit_count(&digits, digit);
}

/* places: [16][shares], where the items of each digit of a share go */
KERNEL move_items(uint count, uint shift, global const ulong *from, global const uint *places,
                  global ulong *to)
{
    const uint share = item_number();
    const uint begin = share * RT_SORT_SHARE, shares = (count + RT_SORT_SHARE - 1u) / RT_SORT_SHARE;
    if (share >= shares)
        return;
    const uint end = min(begin + RT_SORT_SHARE, count);
    struct digits digits = {0ul, 0ul};
    for (uint i = begin; i < end; i++) {
        const ulong item = from[i];
        const uint digit = (uint)(item >> shift) & 15u;
        to[places[digit * shares + share] + digit_count(&digits, digit)] = item;
        count_digit(&digits, digit);
    }
}
