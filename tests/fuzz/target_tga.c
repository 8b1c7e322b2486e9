/* target_tga.c - TGA files. */
#include "fuzz/image.h"
#include "fuzz/targets.h"
#include "image/decode.h"
#include "image/tga.h"

static int run(const uint8_t *data, size_t size)
{
    return fuzz_image_run(rt_tga_decode, NULL, data, size);
}

static void seed(fuzz_inputs *seeds)
{
    static const uint8_t plain[] = "\0\0\2\0\0\0\0\0\0\0\0\0\2\0\1\0\40\10abcdefgh",
                         grey[] = "\2\0\3\0\0\0\0\0\0\0\0\0\2\0\2\0\10\40hiabcd",
                         mapped[] = "\0\1\1\0\0\2\0\30\0\0\0\0\3\0\1\0\10\0abcdef\0\1\1",
                         runs[] = "\0\0\12\0\0\0\0\0\0\0\0\0\3\0\2\0\30\60\203abc\1defghi",
                         narrow[] = "\0\0\12\0\0\0\0\0\0\0\0\0\3\0\2\0\20\1\205ab";
    fuzz_add(seeds, plain, sizeof plain - 1);
    fuzz_add(seeds, grey, sizeof grey - 1);
    fuzz_add(seeds, mapped, sizeof mapped - 1);
    fuzz_add(seeds, runs, sizeof runs - 1);
    fuzz_add(seeds, narrow, sizeof narrow - 1);
}

const fuzz_target fuzz_target_tga = {
    .name = "tga",
    .sources = "lib/image/tga_*",
    .run = run,
    .seed = seed,
    .size_max = 4096,
    .tries = 20000,
};
