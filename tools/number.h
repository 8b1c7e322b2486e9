/* number.h - numbers as a command line writes them, read strictly. */
#ifndef RTC_NUMBER_H
#define RTC_NUMBER_H

#include <stdint.h>

/*
 * A finite decimal number and nothing else: no spaces, hexadecimal, inf or nan, nor one that single
 * precision takes for 0. Returns 0, or -1.
 */
int number_real(double *out, const char *text);

/* A whole number from 0 to 2^53, which may be written as 1e6 or 2.5e5. Returns 0, or -1. */
int number_count(uint64_t *out, const char *text);

/*
 * Bytes, from 1 to 2^60: a number as above, or one with K, M, G or T for a power of 1024, behind
 * which may stand B or iB, in either case. A fraction of a byte is left out. Returns 0, or -1.
 */
int number_size(uint64_t *out, const char *text);

#endif
