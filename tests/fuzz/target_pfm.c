/* target_pfm.c - PFM files. */
#include <stdio.h>
#include <string.h>

#include "fuzz/image.h"
#include "fuzz/targets.h"
#include "image/decode.h"
#include "image/netpbm.h"

static int run(const uint8_t *data, size_t size)
{
    return fuzz_image_run(rt_pfm_decode, rt_pfm_encode, data, size);
}

static void add(fuzz_inputs *seeds, const char *header, int count, int is_big)
{
    rt_bytes file = {0};
    fuzz_put_text(&file, header);
    for (int i = 0; i < count; i++)
        fuzz_put_float(&file, (float)i * 0.25f, is_big);
    fuzz_add(seeds, file.data, file.size);
    rt_bytes_free(&file);
}

static void seed(fuzz_inputs *seeds)
{
    add(seeds, "PF\n2 2\n-1.0\n", 12, 0);
    add(seeds, "Pf 3 1\t+2e0\r", 3, 1);
}

/* A header of its own in front of the pixels, which are cut or filled up to fit it. */
static size_t mutate(uint8_t *data, size_t size, size_t room, uint32_t seed)
{
    fuzz_random random = fuzz_random_begin(seed);
    char header[64];
    size = fuzz_mutate_bytes(data, size, room);
    if (fuzz_random_below(&random, 2))
        return size;
    unsigned width = 1 + fuzz_random_below(&random, 5), height = 1 + fuzz_random_below(&random, 5);
    int is_grey = (int)fuzz_random_below(&random, 2);
    size_t length =
        (size_t)snprintf(header, sizeof header, "%s\n%u %u\n%s\n", is_grey ? "Pf" : "PF", width,
                         height, fuzz_random_below(&random, 2) ? "-1" : "1");
    size_t whole = length + (size_t)(is_grey ? 4 : 12) * width * height;
    if (whole > room)
        return size;
    if (size < whole)
        memset(data + size, 0x3f, whole - size);
    memcpy(data, header, length);
    return whole;
}

const fuzz_target fuzz_target_pfm = {
    .name = "pfm",
    .sources = "lib/image/pfm*",
    .run = run,
    .seed = seed,
    .mutate = mutate,
    .size_max = 4096,
    .tries = 20000,
};
