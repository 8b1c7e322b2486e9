/* unit_part.c - counts the units of one part of a picture. */
#include "film/unit_part.h"

/*
 * The greatest common divisor of a and m, and *inverse: x in [0, m / gcd) with x a = gcd modulo m;
 * by Euclid's algorithm. Both are less than 2^32, as are all numbers on the way.
 */
static uint64_t gcd_and_inverse(uint64_t *inverse, uint64_t a, uint64_t m)
{
    int64_t x = 1, next_x = 0;
    uint64_t r = a, next_r = m;
    while (next_r > 0) {
        const uint64_t quotient = r / next_r, rest = r % next_r;
        const int64_t other = x - (int64_t)quotient * next_x;
        r = next_r;
        next_r = rest;
        x = next_x;
        next_x = other;
    }
    const int64_t modulus = (int64_t)(m / r);
    *inverse = (uint64_t)((x % modulus + modulus) % modulus);
    return r;
}

rt_unit_part rt_unit_part_of(const rt_units *units, uint32_t part, uint32_t parts)
{
    rt_unit_part p = {.units = *units, .first = part - 1, .step = parts};
    uint64_t inverse;
    p.chunk = rt_units_chunk(units, 0).count;
    p.in_block = (units->items + p.chunk - 1) / p.chunk;
    /* The last chunk of block b is the part's where b in_block = part modulo parts. */
    const uint64_t common = gcd_and_inverse(&inverse, p.in_block, parts);
    p.last_step = parts / common;
    if (part % common == 0) {
        p.first_last = part / common % p.last_step * inverse % p.last_step;
        p.first_last += p.first_last == 0 ? p.last_step : 0;
    }
    return p;
}

/* How many of first, first + step and so on are less than `end`. */
static uint64_t count_before(uint64_t first, uint64_t step, uint64_t end)
{
    return end > first ? (end - first - 1) / step + 1 : 0;
}

uint64_t rt_unit_part_before(const rt_unit_part *p, uint64_t unit)
{
    const uint64_t chunk = rt_units_chunk_of(&p->units, unit);
    const uint64_t chunks = count_before(p->first, p->step, chunk);
    const uint64_t lasts =
        p->first_last ? count_before(p->first_last, p->last_step, chunk / p->in_block + 1) : 0;
    uint64_t before = chunks * p->chunk - lasts * (p->in_block * p->chunk - p->units.items);
    if (chunk % p->step == p->first)
        before += unit - rt_units_chunk(&p->units, chunk).first;
    return before;
}
