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

void bench_figure(const char *name, double value)
{
    printf("%s %.6g\n", name, value);
}
