/* sobol.h - the table from which kernels make Sobol points. */
#ifndef RT_LIB_PACK_SOBOL_H
#define RT_LIB_PACK_SOBOL_H

#include <stdint.h>

enum { RT_SOBOL_WORDS = 4 * 256 * 4 };

/*
 * Fills the table `sobol` of a scene, [byte][value][dimension]: the XOR of the four lists of words
 * table[b][byte b of i], b from 0 to 3, is the four-dimensional Sobol point whose index is i with
 * its 32 bits reversed; each coordinate is a binary fraction, with its bits reversed too (the first
 * binary digit is bit 0).
 */
void rt_sobol_table(uint32_t table[RT_SOBOL_WORDS]);

#endif
