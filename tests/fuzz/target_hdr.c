/* target_hdr.c - Radiance HDR files. */
#include "fuzz/image.h"
#include "fuzz/targets.h"
#include "image/decode.h"

static int run(const uint8_t *data, size_t size)
{
    return fuzz_image_run(rt_hdr_decode, NULL, data, size);
}

static void seed(fuzz_inputs *seeds)
{
    static const uint8_t runs[] = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 9\n"
                                  "\2\2\0\11\211\5\1\6\203\7\5\1\2\3\4\5\211\0\211\210";
    static const uint8_t old[] = "#?RGBE\n\n+X 2 -Y 4\n\3\4\5\210\1\1\1\3\6\7\10\210\1\1\1\1"
                                 "\6\7\10\0\1\2\3\4";
    fuzz_add(seeds, runs, sizeof runs - 1);
    fuzz_add(seeds, old, sizeof old - 1);
}

static void words(fuzz_inputs *words)
{
    static const char *const texts[] = {"-Y 1 +X 8\n", "+X 9 -Y 2\n", "-X 1 +Y 3\n",
                                        "FORMAT=32-bit_rle_rgbe\n", "FORMAT=32-bit_rle_xyze\n"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        fuzz_add_text(words, texts[i]);
    fuzz_add(words, "\1\1\1\2", 4);
    fuzz_add(words, "\2\2\0\10", 4);
}

const fuzz_target fuzz_target_hdr = {
    .name = "hdr",
    .sources = "lib/image/hdr_*",
    .run = run,
    .seed = seed,
    .words = words,
    .size_max = 4096,
    .tries = 20000,
};
