/* target_ply.c - PLY files, of text and binary. */
#include <stdio.h>
#include <string.h>

#include "fuzz/mesh.h"
#include "fuzz/ply_file.h"
#include "fuzz/targets.h"

static int run(const uint8_t *data, size_t size)
{
    /* The content tells the format, whatever the name; what is no PLY has none. */
    return fuzz_mesh_run(size % 4 ? "a.ply" : "a", data, size, 0);
}

/* ---- Seeds --------------------------------------------------------------------------------- */

#define ELEMENTS                                                                                   \
    "comment TextureFile t.png\nobj_info made\nelement vertex 4\nproperty float x\n"               \
    "property float y\nproperty double z\nproperty float nx\nproperty float ny\n"                  \
    "property float nz\nproperty float s\nproperty float t\nproperty uchar red\n"                  \
    "property uchar green\nproperty uchar blue\nproperty list uchar short other\n"                 \
    "element face 2\nproperty list uchar int vertex_indices\n"                                     \
    "property list uchar float texcoord\nelement tristrips 1\n"                                    \
    "property list int int vertex_indices\nend_header\n"
#define CORNERS                                                                                    \
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"     \
    "property list uchar int vertex_index\nproperty list uchar float texcoord\nend_header\n"

static void put_binary(rt_bytes *out, int is_big)
{
    fuzz_put_text(out, is_big ? "ply\nformat binary_big_endian 1.0\n"
                              : "ply\nformat binary_little_endian 1.0\n");
    fuzz_put_text(out, ELEMENTS);
    for (unsigned vertex = 0; vertex < 4; vertex++) {
        fuzz_put_float(out, (float)vertex, is_big);
        fuzz_put_float(out, (float)(vertex * vertex), is_big);
        fuzz_put_number(out, UINT64_C(0x3ff0000000000000) + vertex, 8, is_big);
        for (int i = 0; i < 5; i++)
            fuzz_put_float(out, 0.25f * (float)i, is_big);
        fuzz_put_number(out, 0x20ff40, 3, 0);
        fuzz_put_number(out, 0, 1, 0);
    }
    for (unsigned face = 0; face < 2; face++) {
        fuzz_put_number(out, 3 + face, 1, 0);
        for (unsigned i = 0; i < 3 + face; i++)
            fuzz_put_number(out, i, 4, is_big);
        fuzz_put_number(out, 0, 1, 0);
    }
    fuzz_put_number(out, 5, 4, is_big);
    for (unsigned i = 0; i < 5; i++)
        fuzz_put_number(out, i == 3 ? 0xffffffff : i % 4, 4, is_big);
}

/* More elements than a header may have. */
static void add_elements(fuzz_inputs *seeds)
{
    rt_bytes file = {0};
    char line[32];
    fuzz_put_text(&file, "ply\nformat ascii 1.0\n");
    for (int i = 0; i < 66; i++) {
        snprintf(line, sizeof line, "element e%d 0\n", i);
        fuzz_put_text(&file, line);
    }
    fuzz_put_text(&file, "end_header\n");
    fuzz_add(seeds, file.data, file.size);
    rt_bytes_free(&file);
}

static void seed(fuzz_inputs *seeds)
{
    fuzz_add_text(seeds, "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                         "property float y\nproperty float z\nelement face 1\n"
                         "property list uchar uint vertex_indices\nend_header\n"
                         "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    fuzz_add_text(seeds, "ply\nformat ascii 1.0\n" ELEMENTS
                         "0 0 0 0 0 1 0 0 255 0 0 0\n1 0 0 0 0 1 1 0 0 255 0 1 5\n"
                         "1 1 0 0 0 1 1 1 0 0 255 0\n0 1 0 0 0 1 0 1 9 9 9 0\n"
                         "3 0 1 2 6 0 0 1 0 1 1\n4 0 1 2 3 0\n6 0 1 2 -1 3 2\n");
    fuzz_add_text(seeds,
                  "ply\nformat ascii 1.0\n" CORNERS "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 6 0 0 1 0 1 1\n");
    fuzz_add_text(seeds, "ply\nformat ascii 1.0\ncomment TextureFile a.png\n"
                         "comment TextureFile b.png\nelement vertex 5\nproperty double x\n"
                         "property double y\nproperty double z\nelement face 4\n"
                         "property list uchar int vertex_indices\nproperty int texnumber\n"
                         "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                         "end_header\n5e6 0 0\n5000002 .5 0\n5000000.5 .5 0\n5e6 2 0\n5e6 1 0\n"
                         "4 0 1 2 3 0 255 0 0\n4 2 3 0 1 1 0 255 0\n4 0 1 3 2 -1 0 0 9\n"
                         "3 0 4 3 7 1 2 3\n");
    add_elements(seeds);
    fuzz_random random = fuzz_random_begin(11);
    for (int i = 0; i < 60; i++) {
        rt_bytes file = {0};
        fuzz_ply_file(&file, &random);
        fuzz_add(seeds, file.data, file.size);
        rt_bytes_free(&file);
    }
    for (int is_big = 0; is_big < 2; is_big++) {
        rt_bytes binary = {0};
        put_binary(&binary, is_big);
        fuzz_add(seeds, binary.data, binary.size);
        rt_bytes_free(&binary);
    }
}

/* ---- Mutation ------------------------------------------------------------------------------ */

enum { elements_max = 16 };

/* The counts of a header: where they stand, and their values. */
typedef struct counts {
    size_t body; /* where the header ends; 0: it does not */
    size_t at[elements_max], length[elements_max];
    uint64_t value[elements_max];
    int count, is_text;
} counts;

static size_t line_end(const uint8_t *data, size_t size, size_t at)
{
    const uint8_t *end = memchr(data + at, '\n', size - at);
    return end ? (size_t)(end - data) : size;
}

static int starts_with(const uint8_t *data, size_t at, size_t end, const char *word)
{
    size_t length = strlen(word);
    return end - at >= length && memcmp(data + at, word, length) == 0;
}

/* Notes the number at the end of a line. */
static void note_count(counts *c, const uint8_t *data, size_t end)
{
    size_t at = end;
    uint64_t value = 0;
    while (at > 0 && data[at - 1] >= '0' && data[at - 1] <= '9')
        at--;
    if (at == end || c->count == elements_max)
        return;
    for (size_t i = at; i < end; i++)
        value = 10 * value + (uint64_t)(data[i] - '0');
    c->at[c->count] = at;
    c->length[c->count] = end - at;
    c->value[c->count++] = value;
}

static counts find_counts(const uint8_t *data, size_t size)
{
    counts c = {0};
    for (size_t at = 0; at < size;) {
        size_t end = line_end(data, size, at);
        if (starts_with(data, at, end, "element "))
            note_count(&c, data, end);
        c.is_text |= starts_with(data, at, end, "format ascii");
        if (starts_with(data, at, end, "end_header")) {
            c.body = end < size ? end + 1 : size;
            break;
        }
        at = end + 1;
    }
    return c;
}

/* A text body has a line for each row of each element: one count is made to fit the others. */
static size_t repair(uint8_t *data, size_t size, size_t room, fuzz_random *random)
{
    counts c = find_counts(data, size);
    char digits[24];
    uint64_t lines = 0;
    if (!c.body || !c.is_text || !c.count)
        return size;
    for (size_t at = c.body; at < size; at = line_end(data, size, at) + 1)
        lines++;
    int chosen = (int)fuzz_random_below(random, (uint32_t)c.count);
    for (int i = 0; i < c.count; i++)
        lines -= i != chosen && c.value[i] <= lines ? c.value[i] : 0;
    snprintf(digits, sizeof digits, "%llu", (unsigned long long)lines);
    return fuzz_splice(data, size, room, c.at[chosen], c.length[chosen], digits, strlen(digits));
}

static size_t mutate(uint8_t *data, size_t size, size_t room, uint32_t seed)
{
    fuzz_random random = fuzz_random_begin(seed);
    rt_bytes file = {0};
    if (fuzz_random_below(&random, 8) == 0)
        fuzz_ply_file(&file, &random);
    if (file.size && file.size <= room) {
        size = file.size;
        memcpy(data, file.data, size);
    }
    rt_bytes_free(&file);
    size = fuzz_mutate_bytes(data, size, room);
    return fuzz_random_below(&random, 4) ? repair(data, size, room, &random) : size;
}

const fuzz_target fuzz_target_ply = {
    .name = "ply",
    .sources = "lib/mesh/ply* lib/mesh/load* lib/mesh/canonical* lib/mesh/openmesh* "
               "lib/mesh/normals* lib/mesh/source*",
    .run = run,
    .seed = seed,
    .mutate = mutate,
    .size_max = 4096,
    .tries = 20000,
};
