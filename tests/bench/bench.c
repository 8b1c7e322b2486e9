/* bench.c - what the programs of the benchmark share. */
#include "bench/bench.h"

#include <stdio.h>
#include <stdlib.h>

void bench_must(rt_status status, const rt_error *error)
{
    if (status != RT_OK) {
        fprintf(stderr, "bench: %s\n", error->message);
        exit(1);
    }
}

void *bench_allocate(size_t count, size_t size)
{
    void *memory = calloc(count, size);
    if (memory == NULL) {
        fprintf(stderr, "bench: out of memory\n");
        exit(1);
    }
    return memory;
}

rt_device *bench_device(void)
{
    const rt_device_options options = {.select = getenv("RT_TEST_DEVICE")};
    rt_device *device = NULL;
    rt_error error;
    bench_must(rt_device_open(&device, &options, &error), &error);
    return device;
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double bench_median(double *values)
{
    qsort(values, bench_turns, sizeof *values, by_value);
    return values[bench_turns / 2];
}

void bench_figure(const char *name, double value)
{
    printf("%s %.6g\n", name, value);
}
