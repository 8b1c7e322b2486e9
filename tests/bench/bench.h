/* bench.h - what the programs of the benchmark share. */
#ifndef RT_TESTS_BENCH_BENCH_H
#define RT_TESTS_BENCH_BENCH_H

#include <stddef.h>

#include "rt.h"

/* Ends the program with the error's message, unless all is well. */
void bench_must(rt_status status, const rt_error *error);

/* Zeroed memory; ends the program where there is none. */
void *bench_allocate(size_t count, size_t size);

/* The device that the environment variable RT_TEST_DEVICE names, else the first. */
rt_device *bench_device(void);

/* A program takes each of its figures this often, in turn with its peer's. */
enum { bench_turns = 3 };

/* The median of bench_turns values, which it sorts. */
double bench_median(double *values);

/* Prints a figure for bench.py: its name and its value. */
void bench_figure(const char *name, double value);

#endif
