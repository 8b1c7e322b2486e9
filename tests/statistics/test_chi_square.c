/*
 * test_chi_square.c - every sampling routine against its density: 10^6 samples of each of three
 * seeds.
 */
#include "statistics/chi_square.h"

int main(void)
{
    return test_routines("statistics/chi_square", most_samples, 3);
}
