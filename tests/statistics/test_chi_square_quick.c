/*
 * test_chi_square_quick.c - every sampling routine against its density, in short; test_chi_square.c
 * looks closer.
 */
#include "statistics/chi_square.h"

int main(void)
{
    return test_routines("statistics/chi_square_quick", 1 << 15, 1);
}
