/*
 * test_chi_square.c - every sampling routine against its density: 10^6 samples of one seed, and by
 * RT_TEST_LONG=1 of three.
 */
#include "statistics/chi_square.h"

#include <stdlib.h>

int main(void)
{
    return test_routines("statistics/chi_square", most_samples, getenv("RT_TEST_LONG") ? 3 : 1);
}
