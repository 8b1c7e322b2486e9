/*
 * point_order.c - Hilbert keys and a parallel radix sort.
 *
 * On an infinite plane some points lie so far out that all others would share a cell. Cells are
 * therefore cubes of one size where most of the points are, and grow outside of that.
 *
 * References:
 *   Hamilton: "Compact Hilbert Indices", Technical Report CS-2006-07, Dalhousie University, 2006.
 */
#include "photon/point_order.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/parallel.h"

enum { CURVE_BITS = RT_CURVE_BITS, INDEX_BITS = RT_INDEX_BITS };
enum { DIGIT_BITS = 12, DIGITS = 3 * CURVE_BITS / DIGIT_BITS, BINS = 1 << DIGIT_BITS };
/* of the points, each one job: at most so many, so many a thread, and as are worth their bins */
enum { SHARES = 64, SHARES_A_THREAD = 2, SHARE_POINTS = BINS };
enum { SAMPLE = RT_ORDER_SAMPLE, FAR_OUT = RT_ORDER_FAR_OUT };

/* ---- The curve ----------------------------------------------------------------- */

/*
 * Hilbert's curve as a machine: in each of 24 states, an entry corner of the cube (3 bits) and a
 * direction, an octant is passed in some place, and is entered in another state.
 */
enum { STATES = RT_CURVE_STATES };
typedef struct curve {
    unsigned char place[STATES][8], next[STATES][8];
    /* the same for two steps at once: the octant of the first step in the upper three bits */
    unsigned char two_places[STATES][64], after_two[STATES][64];
} curve;

static unsigned rotate_left(unsigned bits, unsigned by)
{
    return (bits << by | bits >> (3 - by)) & 7;
}

/*
 * Hamilton, sections 2.1 and 2.2: the corner at which the curve enters its w-th octant, and its
 * direction there.
 */
static unsigned entry_corner(unsigned w)
{
    unsigned i = w == 0 ? 0 : 2 * ((w - 1) / 2);
    return i ^ i >> 1;
}

static unsigned direction_within(unsigned w)
{
    unsigned i = w == 0 ? 0 : w % 2 ? w : w - 1, ones = 0;
    for (; i & 1; i >>= 1)
        ones++;
    return w == 0 ? 0 : ones % 3;
}

static void make_curve(curve *c)
{
    for (unsigned state = 0; state < STATES; state++)
        for (unsigned octant = 0; octant < 8; octant++) {
            unsigned corner = state / 3, turn = state % 3 + 1; /* direction + 1 */
            unsigned gray = rotate_left(octant ^ corner, turn % 3 ? 3 - turn : 0),
                     w = gray ^ gray >> 1 ^ gray >> 2;
            unsigned to = corner ^ rotate_left(entry_corner(w), turn % 3);
            c->place[state][octant] = (unsigned char)w;
            c->next[state][octant] = (unsigned char)(3 * to + (turn + direction_within(w)) % 3);
        }
    for (unsigned state = 0; state < STATES; state++)
        for (unsigned octants = 0; octants < 64; octants++) {
            const unsigned first = octants >> 3, then = octants & 7;
            const unsigned within = c->next[state][first];
            c->two_places[state][octants] =
                (unsigned char)(c->place[state][first] << 3 | c->place[within][then]);
            c->after_two[state][octants] = c->next[within][then];
        }
}

void rt_point_order_curve(unsigned char table[RT_CURVE_BYTES])
{
    curve c;
    make_curve(&c);
    memcpy(table, c.two_places, sizeof c.two_places);
    memcpy(table + sizeof c.two_places, c.after_two, sizeof c.after_two);
}

static uint64_t hilbert_key(const curve *c, const uint32_t cell[3])
{
    /* two bits of an axis, moved apart to where they stand in a pair of octants */
    static const unsigned char apart[4] = {0, 1, 8, 9};
    uint64_t key = 0;
    unsigned state = 0;
    for (int bit = CURVE_BITS - 2; bit >= 0; bit -= 2) {
        unsigned octants = apart[cell[0] >> bit & 3] | apart[cell[1] >> bit & 3] << 1 |
                           apart[cell[2] >> bit & 3] << 2;
        key = key << 6 | c->two_places[state][octants];
        state = c->after_two[state][octants];
    }
    return key;
}

/* ---- Sorting ------------------------------------------------------------------ */

typedef struct sorting {
    const char *positions; /* float[3] each, `stride` bytes apart */
    size_t stride, count;
    uint32_t shares;
    uint64_t *from, *to;
    int shift; /* of the digit */
    float low[SHARES][3], high[SHARES][3];
    double middle[3], reach; /* where most photons are: so far from there, along each axis */
    double origin[3], scale; /* of compressed positions, to cells of the curve */
    curve curve;
    uint32_t (*bins)[BINS]; /* [shares], counts, then where each share's items of a bin go */
} sorting;

static size_t share_begin(const sorting *s, uint32_t share)
{
    return s->count * share / s->shares;
}

static const float *position(const sorting *s, size_t i)
{
    return (const float *)(const void *)(s->positions + i * s->stride);
}

static void bound_share(void *user, uint32_t share)
{
    sorting *s = user;
    float low[3] = {HUGE_VALF, HUGE_VALF, HUGE_VALF},
          high[3] = {-HUGE_VALF, -HUGE_VALF, -HUGE_VALF};
    for (size_t i = share_begin(s, share); i < share_begin(s, share + 1); i++)
        for (int axis = 0; axis < 3; axis++) {
            float x = position(s, i)[axis];
            low[axis] = x < low[axis] ? x : low[axis];
            high[axis] = x > high[axis] ? x : high[axis];
        }
    memcpy(s->low[share], low, sizeof low);
    memcpy(s->high[share], high, sizeof high);
}

static int by_value(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* Finds the region of most points from a sample, and enlarges it by half. */
static void find_most(sorting *s)
{
    float sample[SAMPLE];
    size_t count = s->count < SAMPLE ? s->count : SAMPLE, aside = count / FAR_OUT;
    s->reach = 0;
    for (int axis = 0; axis < 3 && count > 0; axis++) {
        for (size_t i = 0; i < count; i++)
            sample[i] = position(s, i * s->count / count)[axis];
        qsort(sample, count, sizeof *sample, by_value);
        double low = sample[aside], high = sample[count - 1 - aside];
        s->middle[axis] = 0.5 * (low + high);
        s->reach = fmax(s->reach, 0.75 * (high - low));
    }
    if (!(s->reach > 0))
        s->reach = 1;
}

/* Along an axis: in units of the reach from the middle, and within [-2, 2] however far out. */
static double compress(const sorting *s, float x, int axis)
{
    double from = (x - s->middle[axis]) / s->reach, far = fabs(from);
    return far <= 1 ? from : copysign(2 - 1 / far, from);
}

/* Maps the box around all points to the cells; one scale for all axes keeps the cells cubes. */
static void set_cells(sorting *s)
{
    double largest = 0;
    for (int axis = 0; axis < 3; axis++) {
        float low = HUGE_VALF, high = -HUGE_VALF;
        for (uint32_t i = 0; i < s->shares; i++) {
            low = s->low[i][axis] < low ? s->low[i][axis] : low;
            high = s->high[i][axis] > high ? s->high[i][axis] : high;
        }
        s->origin[axis] = compress(s, low, axis);
        largest = fmax(largest, compress(s, high, axis) - s->origin[axis]);
    }
    s->scale = largest > 0 ? (1 << CURVE_BITS) * (1 - 1e-9) / largest : 0;
}

static void key_share(void *user, uint32_t share)
{
    sorting *s = user;
    for (size_t i = share_begin(s, share); i < share_begin(s, share + 1); i++) {
        uint32_t cell[3];
        for (int axis = 0; axis < 3; axis++)
            cell[axis] =
                (uint32_t)((compress(s, position(s, i)[axis], axis) - s->origin[axis]) * s->scale);
        s->from[i] = hilbert_key(&s->curve, cell) << INDEX_BITS | i;
    }
}

static size_t digit(const sorting *s, uint64_t item)
{
    return (size_t)(item >> s->shift) & (BINS - 1);
}

static void count_share(void *user, uint32_t share)
{
    sorting *s = user;
    uint32_t *bins = s->bins[share];
    memset(bins, 0, sizeof s->bins[share]);
    for (size_t i = share_begin(s, share); i < share_begin(s, share + 1); i++)
        bins[digit(s, s->from[i])]++;
}

/* Counts to places: bins in order, and in each bin the shares in order. */
static void place_bins(sorting *s)
{
    uint32_t place = 0;
    for (size_t bin = 0; bin < BINS; bin++)
        for (uint32_t share = 0; share < s->shares; share++) {
            uint32_t count = s->bins[share][bin];
            s->bins[share][bin] = place;
            place += count;
        }
}

static void move_share(void *user, uint32_t share)
{
    sorting *s = user;
    uint32_t *bins = s->bins[share];
    for (size_t i = share_begin(s, share); i < share_begin(s, share + 1); i++)
        s->to[bins[digit(s, s->from[i])]++] = s->from[i];
}

rt_status rt_point_order(uint64_t *items, uint64_t *spare, const float *first, size_t stride,
                         size_t count, uint32_t threads, rt_error *error)
{
    sorting s;
    memset(&s, 0, sizeof s);
    s.positions = (const char *)first;
    s.stride = stride;
    s.count = count;
    s.shares = threads < SHARES / SHARES_A_THREAD ? SHARES_A_THREAD * (threads + !threads) : SHARES;
    if (count / SHARE_POINTS < s.shares)
        s.shares = 1 + (uint32_t)(count / SHARE_POINTS);
    /* An odd number of passes ends in the other array than it began with. */
    s.from = DIGITS % 2 ? spare : items;
    s.to = DIGITS % 2 ? items : spare;
    s.bins = malloc(s.shares * sizeof *s.bins);
    if (!s.bins)
        return rt_fail(error, RT_ERROR_MEMORY, "no memory to sort %zu points", count);
    make_curve(&s.curve);

    rt_parallel(threads, s.shares, bound_share, &s);
    find_most(&s);
    set_cells(&s);
    rt_parallel(threads, s.shares, key_share, &s);
    for (int pass = 0; pass < DIGITS; pass++) {
        s.shift = INDEX_BITS + pass * DIGIT_BITS;
        rt_parallel(threads, s.shares, count_share, &s);
        place_bins(&s);
        rt_parallel(threads, s.shares, move_share, &s);
        uint64_t *swap = s.from;
        s.from = s.to;
        s.to = swap;
    }
    free(s.bins);
    return RT_OK;
}
