/* target_ppm.c - PPM and PGM files. */
#include "fuzz/image.h"
#include "fuzz/targets.h"
#include "image/decode.h"
#include "image/netpbm.h"

static rt_status encode(rt_bytes *out, const rt_image *image, rt_error *error)
{
    const rt_image_options options = {0};
    return rt_ppm_encode(out, image, &options, error);
}

static int run(const uint8_t *data, size_t size)
{
    return fuzz_image_run(rt_ppm_decode, encode, data, size);
}

static void seed(fuzz_inputs *seeds)
{
    static const uint8_t deep[] = "P5 2 2\t1023\n\0\1\2\3\3\377\0\0";
    fuzz_add_text(seeds, "P6\n2 2\n255\nabcdefghijkl\n");
    fuzz_add(seeds, deep, sizeof deep - 1);
    fuzz_add_text(seeds, "P2\n# a\n3 1\n15\n0 7# b\n15 15\n");
    fuzz_add_text(seeds, "P3 1 2 65535\r\n0 65535 1\n2 3 4 ");
}

const fuzz_target fuzz_target_ppm = {
    .name = "ppm",
    .sources = "lib/image/ppm_*",
    .run = run,
    .seed = seed,
    .size_max = 4096,
    .tries = 20000,
};
