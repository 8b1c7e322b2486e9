/* target_grid.c - grids of densities and albedos. */
#include <stdlib.h>
#include <string.h>

#include "fuzz/targets.h"
#include "scene/grid_file.h"

enum { header_size = RT_GRID_HEADER };

/* As a file it is read as the same grid, or refused by its name. */
static void check_file(const uint8_t *data, size_t size, const float *values, const rt_u32 *sides)
{
    float *again = fuzz_untouched;
    rt_u32 sides_again[4] = {0};
    rt_error error;
    fuzz_write("a.grid", data, size);
    const rt_status status = rt_grid_read(&again, sides_again, "a.grid", NULL, &error);
    if (fuzz_expect_answer(status, &error, again)) {
        FUZZ_EXPECT(values && memcmp(sides, sides_again, sizeof sides_again) == 0);
        FUZZ_EXPECT(memcmp(values, again, size - header_size) == 0);
        rt_memory_free(again);
    } else {
        FUZZ_EXPECT(!values && strcmp(error.file, "a.grid") == 0);
    }
}

static int run(const uint8_t *data, size_t size)
{
    const rt_bytes file = {(uint8_t *)data, size, size, NULL};
    float *values = fuzz_untouched;
    rt_u32 sides[4];
    rt_error error;
    const rt_status status = rt_grid_decode(&values, sides, &file, NULL, &error);
    if (!fuzz_expect_answer(status, &error, values)) {
        check_file(data, size, NULL, NULL);
        return 0;
    }
    const size_t count = (size_t)sides[0] * sides[1] * sides[2] * sides[3];
    FUZZ_EXPECT(sides[0] > 0 && sides[1] > 0 && sides[2] > 0);
    FUZZ_EXPECT(sides[3] == 1 || sides[3] == 3);
    FUZZ_EXPECT(size == header_size + 4 * count);
    fuzz_expect_finite(values, count);
    for (size_t i = 0; i < count; i++)
        FUZZ_EXPECT(values[i] >= 0);
    check_file(data, size, values, sides);
    rt_memory_free(values);
    return 1;
}

static void add(fuzz_inputs *seeds, rt_u32 nx, rt_u32 ny, rt_u32 nz, rt_u32 channels)
{
    rt_bytes file = {0};
    fuzz_put_text(&file, channels == 3 ? "RTGRID3\n" : "RTGRID1\n");
    fuzz_put_number(&file, nx, 4, 0);
    fuzz_put_number(&file, ny, 4, 0);
    fuzz_put_number(&file, nz, 4, 0);
    for (rt_u32 i = 0; i < nx * ny * nz * channels; i++)
        fuzz_put_float(&file, (float)(i % 7) * 0.25f, 0);
    fuzz_add(seeds, file.data, file.size);
    rt_bytes_free(&file);
}

static void seed(fuzz_inputs *seeds)
{
    add(seeds, 3, 2, 4, 1);
    add(seeds, 1, 1, 1, 1);
    add(seeds, 17, 1, 2, 1);
    add(seeds, 2, 3, 2, 3);
}

/* The file has the size that its header announces, most of the time. */
static size_t mutate(uint8_t *data, size_t size, size_t room, uint32_t seed)
{
    fuzz_random random = fuzz_random_begin(seed);
    size = fuzz_mutate_bytes(data, size, room);
    if (size < header_size || fuzz_random_below(&random, 4) == 0)
        return size;
    const size_t channels = fuzz_random_below(&random, 2) == 0 ? 3 : 1;
    memcpy(data, channels == 3 ? "RTGRID3\n" : "RTGRID1\n", 8);
    fuzz_set(data + 8, 1 + fuzz_random_below(&random, 3), 4);
    fuzz_set(data + 12, 1 + fuzz_random_below(&random, 3), 4);
    const size_t layer = 4 * channels * (size_t)(fuzz_get(data + 8, 4) * fuzz_get(data + 12, 4));
    const size_t layers = (size - header_size) / layer;
    fuzz_set(data + 16, layers, 4);
    return header_size + layers * layer;
}

const fuzz_target fuzz_target_grid = {
    .name = "grid",
    .sources = "lib/scene/grid_file.c",
    .run = run,
    .seed = seed,
    .mutate = mutate,
    .size_max = 4096,
    .tries = 20000,
};
