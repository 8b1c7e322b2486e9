/*
 * target_serialized.c - meshes in the compressed files of Mitsuba. An input is a version, whether
 * the rest is a whole file or, more often, what is deflated, and that.
 */
#include <stdlib.h>

#include "fuzz/import.h"
#include "fuzz/targets.h"
#include "dsl/import/serialized.h"
#include "tools/serialized_sample.h"

static void check_mesh(import_mesh *mesh)
{
    importer import = {.path = "m"};
    if (rt_import_mesh_check(&import, 0, mesh))
        for (size_t i = 0; i < 3 * mesh->triangle_count; i++)
            FUZZ_EXPECT(mesh->indices[i] < mesh->vertex_count);
}

static int run(const uint8_t *data, size_t size)
{
    importer import = {.path = "m", .folder = (char *)""};
    rt_bytes file = {0};
    if (size < 2)
        return 0;
    const rt_bytes rest = {.data = (uint8_t *)data + 2, .size = size - 2};
    if (data[1] % 4 == 3)
        fuzz_put(&file, rest.data, rest.size);
    else
        serialized_put_mesh(&file, 3 + data[0] % 2, &rest);
    fuzz_write("m.serialized", file.data, file.size);
    import_mesh mesh;
    int is_flat;
    const int is_good =
        rt_serialized_read(&import, 1, "m.serialized", data[1] >> 2 & 3, &mesh, &is_flat);
    FUZZ_EXPECT(is_good == !import.failed);
    if (is_good)
        check_mesh(&mesh);
    else
        fuzz_expect_line(import.error);
    rt_import_mesh_free(&mesh);
    free(import.read);
    rt_bytes_free(&file);
    return is_good;
}

static void seed(fuzz_inputs *seeds)
{
    for (int i = 0; i < 4; i++) {
        const int version = 3 + i % 2;
        rt_bytes content = serialized_triangle(version, i / 2, 0.5), input = {0}, file = {0};
        const size_t start = 0;
        fuzz_put_number(&input, (uint64_t)(i % 2), 2, 0);
        fuzz_put(&input, content.data, content.size);
        fuzz_add(seeds, input.data, input.size);
        rt_bytes_free(&input);
        serialized_put_mesh(&file, version, &content);
        serialized_put_table(&file, version, &start, 1);
        fuzz_put_number(&input, 0x300, 2, 0);
        fuzz_put(&input, file.data, file.size);
        fuzz_add(seeds, input.data, input.size);
        rt_bytes_free(&input);
        rt_bytes_free(&file);
        rt_bytes_free(&content);
    }
}

const fuzz_target fuzz_target_serialized = {
    .name = "serialized",
    .sources = "dsl/import/serialized.c",
    .run = run,
    .seed = seed,
    .size_max = 4096,
    .tries = 3000,
};
