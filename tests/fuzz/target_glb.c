/* target_glb.c - glTF 2.0 as one binary file; its lengths are kept right most of the time. */
#include <string.h>

#include "fuzz/import.h"
#include "fuzz/targets.h"

enum { HEADER = 12, CHUNK = 8 };

static int run(const uint8_t *data, size_t size)
{
    return fuzz_import_run("a.glb", data, size, rt_import_gltf);
}

static void add(fuzz_inputs *seeds, const char *json, const void *chunk, size_t size)
{
    rt_bytes bytes = {0};
    size_t length = strlen(json);
    fuzz_put_text(&bytes, "glTF");
    fuzz_put_number(&bytes, 2, 4, 0);
    fuzz_put_number(&bytes, HEADER + 2 * CHUNK + length + size, 4, 0);
    fuzz_put_number(&bytes, length, 4, 0);
    fuzz_put_text(&bytes, "JSON");
    fuzz_put_text(&bytes, json);
    fuzz_put_number(&bytes, size, 4, 0);
    fuzz_put(&bytes, "BIN", 4);
    fuzz_put(&bytes, chunk, size);
    fuzz_add(seeds, bytes.data, bytes.size);
    rt_bytes_free(&bytes);
}

static void seed(fuzz_inputs *seeds)
{
    static const float corners[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    add(seeds,
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"mode\":6}]}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":4}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48}],\"buffers\":[{\"byteLength\":48}]}",
        corners, sizeof corners);
    add(seeds,
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1},"
        "\"indices\":2}]}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5122,\"type\":\"VEC3\",\"count\":3},"
        "{\"bufferView\":0,\"componentType\":5120,\"normalized\":true,\"type\":\"VEC3\","
        "\"count\":3},{\"bufferView\":0,\"componentType\":5121,\"type\":\"SCALAR\",\"count\":3}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":24,\"byteStride\":8}],"
        "\"buffers\":[{\"byteLength\":24}]}",
        corners, 24);
}

/* The length of the whole, and that of the first chunk where the second can be found. */
static size_t mutate(uint8_t *data, size_t size, size_t room, uint32_t seed)
{
    size = fuzz_mutate_bytes(data, size, room);
    fuzz_random random = fuzz_random_begin(seed);
    if (size < HEADER + CHUNK || fuzz_random_below(&random, 8) == 0)
        return size;
    memcpy(data, "glTF", 4);
    fuzz_set(data + 4, 2, 4);
    fuzz_set(data + 8, size, 4);
    memcpy(data + HEADER + 4, "JSON", 4);
    for (size_t i = HEADER + CHUNK; i + CHUNK <= size; i++)
        if (memcmp(data + i + 4, "BIN", 4) == 0) {
            fuzz_set(data + HEADER, i - HEADER - CHUNK, 4);
            fuzz_set(data + i, size - i - CHUNK, 4);
            return size;
        }
    fuzz_set(data + HEADER, size - HEADER - CHUNK, 4);
    return size;
}

const fuzz_target fuzz_target_glb = {
    .name = "glb",
    .sources = "dsl/import/gltf_bytes.c",
    .run = run,
    .seed = seed,
    .mutate = mutate,
    .size_max = 4096,
    .tries = 3000,
};
