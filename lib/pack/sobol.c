/*
 * sobol.c - the first four dimensions of the Sobol sequence.
 *
 * Primitive polynomials and initial numbers are those of Joe and Kuo, "Constructing Sobol Sequences
 * with Better Two-Dimensional Projections", SIAM J. Sci. Comput. 30, 2008; the recurrence is that
 * of Bratley and Fox, "Algorithm 659", ACM TOMS 14(1), 1988.
 */
#include "pack/sobol.h"

/*
 * A primitive polynomial of degree s, with its inner coefficients in the bits of a, and s initial
 * numbers.
 */
struct polynomial {
    unsigned s, a;
    uint32_t m[3];
};

/* Dimension 0, the van der Corput sequence, is the polynomial of degree 0. */
static const struct polynomial polynomials[4] = {
    {0, 0, {0}}, {1, 0, {1}}, {2, 1, {1, 3}}, {3, 1, {1, 3, 1}}};

/*
 * The 32 columns of the generator matrix: column k is added to a point when bit k of its index is
 * set.
 */
static void sobol_columns(uint32_t column[32], const struct polynomial *p)
{
    for (unsigned k = 0; k < 32; k++) {
        if (p->s == 0) {
            column[k] = 1u << (31 - k);
        } else if (k < p->s) {
            column[k] = p->m[k] << (31 - k);
        } else {
            column[k] = column[k - p->s] ^ (column[k - p->s] >> p->s);
            for (unsigned j = 1; j < p->s; j++)
                if ((p->a >> (p->s - 1 - j)) & 1u)
                    column[k] ^= column[k - j];
        }
    }
}

static uint32_t reverse_bits(uint32_t x)
{
    uint32_t reversed = 0;
    for (int i = 0; i < 32; i++)
        reversed |= (x >> i & 1u) << (31 - i);
    return reversed;
}

void rt_sobol_table(uint32_t table[RT_SOBOL_WORDS])
{
    for (unsigned dimension = 0; dimension < 4; dimension++) {
        uint32_t column[32];
        sobol_columns(column, &polynomials[dimension]);
        for (unsigned byte = 0; byte < 4; byte++)
            for (unsigned value = 0; value < 256; value++) {
                uint32_t point = 0;
                for (unsigned bit = 0; bit < 8; bit++)
                    if (value >> bit & 1u)
                        point ^= reverse_bits(column[31 - (8 * byte + bit)]);
                table[(byte * 256 + value) * 4 + dimension] = point;
            }
    }
}
