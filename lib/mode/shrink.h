/* shrink.h - how the radius of progressive density estimation shrinks from pass to pass. */
#ifndef RT_MODE_SHRINK_H
#define RT_MODE_SHRINK_H

#include <stdint.h>

/* The factor after some passes, kept for the next ones; all zero at first. */
typedef struct rt_shrink {
    uint32_t passes;
    double factor;
} rt_shrink;

/*
 * By which the square of the radius has shrunk after so many passes: the product of
 * (i + alpha)/(i + 1) over them, i counted from 1 + pilot (Knaus and Zwicker 2011, equation 15).
 */
double rt_shrink_after(rt_shrink *shrink, uint32_t passes, uint32_t pilot, double alpha);

#endif
