/* target_off.c - Geomview OFF files. */
#include "fuzz/mesh.h"
#include "fuzz/targets.h"

static int run(const uint8_t *data, size_t size)
{
    return fuzz_mesh_run("a.off", data, size, 1);
}

static void seed(fuzz_inputs *seeds)
{
    fuzz_add_text(seeds, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    fuzz_add_text(seeds, "STCNOFF\n# all\n4 2 0\n0 0 0 0 0 1 255 0 0 0 0\n"
                         "1 0 0 0 0 1 0 1.0 0 1 0\n1 1 0 0 0 1 0 0 255 1 1 1\n"
                         "0 1 0 0 0 1 9 9 9 0 1\n4 0 1 2 3 1.0 0 0\n3 0 1 2\n");
    fuzz_add_text(seeds, "COFF 3 1\n0 0 0 1e-1 .5 0.25 1\n\n1 0 0 255 255 255\n"
                         "0 1 0 0 0 0\n4 0 1\n2 1\n");
    fuzz_add_text(seeds, "NOFF\n8 3 0\n9e5 0 0 nan 0 1\n900003 0 0 0 0 0\n900003 3 0 0 0 1\n"
                         "900002 3 0 0 0 1\n900002 1 0 1e99 0 1\n900001 1 0 0 0 1\n"
                         "900001 3 0 0 0 1\n900000.01 3 0 0 0 1\n8 3 4 5 6 7 0 1 2\n4 0 2 1 3\n"
                         "5 0 0 0 0 0\n");
    fuzz_add_text(seeds, "3 1 2\n0 0 0\n1 0 0\n0 1 0\n2 0 1\nmore\n");
}

const fuzz_target fuzz_target_off = {
    .name = "off",
    .sources = "lib/mesh/off.c",
    .run = run,
    .seed = seed,
    .size_max = 4096,
    .tries = 20000,
};
