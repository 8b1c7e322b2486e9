/* blind.h - mutations without a guide. */
#ifndef RT_TESTS_FUZZ_BLIND_H
#define RT_TESTS_FUZZ_BLIND_H

#include "fuzz/fuzz.h"

/*
 * Starts the sequence of fuzz_mutate_bytes anew; words, which may be NULL, are inserted too and
 * must live as long as it goes on.
 */
void fuzz_blind_begin(uint32_t seed, const fuzz_inputs *words);

#endif
