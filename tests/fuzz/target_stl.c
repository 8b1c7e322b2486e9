/* target_stl.c - STL files, of text and binary. */
#include <string.h>

#include "fuzz/mesh.h"
#include "fuzz/targets.h"

enum { header_size = 84, facet_size = 50 };

static int run(const uint8_t *data, size_t size)
{
    return fuzz_mesh_run("a.stl", data, size, 0);
}

static void seed(fuzz_inputs *seeds)
{
    rt_bytes binary = {0};
    uint8_t title[80] = {0};
    fuzz_add_text(seeds, "\xef\xbb\xbfsolid a\nfacet normal 0 0 1\nouter loop\nvertex 5e6 0 0.25\n"
                         "vertex 5000000.01 0 0\nvertex 5e6 .01 0\nendloop\nendfacet\n"
                         "endsolid a\n");
    fuzz_add_text(seeds, "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                         "vertex 0 1 0\nendloop\nendfacet\nfacet normal nan 0 -1\nouter loop\n"
                         "vertex 1 0 -0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\n"
                         "endsolid a\nSOLID b\nENDSOLID\n");
    fuzz_put(&binary, title, sizeof title);
    fuzz_put_number(&binary, 3, 4, 0);
    for (int facet = 0; facet < 3; facet++) {
        for (int i = 0; i < 12; i++)
            fuzz_put_float(&binary, (float)(facet * i % 5), 0);
        fuzz_put_number(&binary, 0, 2, 0);
    }
    fuzz_add(seeds, binary.data, binary.size);
    memcpy(binary.data, "solid", 5);
    fuzz_put_text(&binary, "more");
    fuzz_add(seeds, binary.data, binary.size);
    rt_bytes_free(&binary);
}

/* The number of facets that a binary file has room for is the number that it announces. */
static size_t mutate(uint8_t *data, size_t size, size_t room, uint32_t seed)
{
    fuzz_random random = fuzz_random_begin(seed);
    size = fuzz_mutate_bytes(data, size, room);
    if (size >= header_size && memcmp(data, "solid", 5) != 0 && fuzz_random_below(&random, 8))
        fuzz_set(data + header_size - 4, (size - header_size) / facet_size, 4);
    return size;
}

const fuzz_target fuzz_target_stl = {
    .name = "stl",
    .sources = "lib/mesh/stl.c",
    .run = run,
    .seed = seed,
    .mutate = mutate,
    .size_max = 4096,
    .tries = 20000,
};
