/* target_bmp.c - BMP files. */
#include <string.h>

#include "fuzz/image.h"
#include "fuzz/targets.h"
#include "image/decode.h"

static int run(const uint8_t *data, size_t size)
{
    return fuzz_image_run(rt_bmp_decode, NULL, data, size);
}

/* A header of 40 bytes, a palette of two colours or masks, and pixels. */
static void add(fuzz_inputs *seeds, uint8_t bits, uint8_t method, const void *rest, size_t size)
{
    uint8_t file[256] = {0x42, 0x4d, [10] = 14 + 40, [14] = 40, [18] = 3, [22] = 2, [26] = 1};
    file[28] = bits;
    file[30] = method;
    file[10] = (uint8_t)(file[10] + (bits <= 8 ? 8 : method == 3 ? 12 : method == 6 ? 16 : 0));
    memcpy(file + 54, rest, size);
    fuzz_add(seeds, file, 54 + size);
}

static void seed(fuzz_inputs *seeds)
{
    add(seeds, 1, 0, "\0\0\0\0\1\2\3\0\240\0\0\0\100\0\0\0", 16);
    add(seeds, 4, 2, "\0\0\0\0\1\2\3\0\3\20\0\0\0\3\21\0\0\1", 18);
    add(seeds, 8, 0, "\0\0\0\0\1\2\3\0\1\0\1\0\0\0\1\0", 16);
    add(seeds, 8, 1, "\0\0\0\0\1\2\3\0\2\1\0\2\1\0\0\0\1\1\0\3\0\1\0\0\0\1", 26);
    add(seeds, 16, 3, "\0\370\0\0\340\7\0\0\37\0\0\0abcdef\0\0ghijkl\0\0", 28);
    add(seeds, 24, 0, "abcdefghi\0\0\0abcdefghi\0\0\0", 24);
    add(seeds, 32, 6, "\377\0\0\0\0\377\0\0\0\0\377\0\0\0\0\377abcdabcdabcdabcdabcdabcd", 40);
}

const fuzz_target fuzz_target_bmp = {
    .name = "bmp",
    .sources = "lib/image/bmp_*",
    .run = run,
    .seed = seed,
    .size_max = 4096,
    .tries = 20000,
};
