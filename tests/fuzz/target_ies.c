/* target_ies.c - IES files of luminaires. */
#include <stdlib.h>
#include <string.h>

#include "fuzz/targets.h"
#include "scene/ies.h"
#include "scene/light_table.h"

/* What the kernels rely on: lines ascend, within the sphere, and no value is negative. */
static void check_table(const rt_scene_light_table *t)
{
    const float *const vs = t->lines + t->columns + 1;
    const size_t values = 4 * rt_light_table_values(t);
    FUZZ_EXPECT(t->columns > 0 && t->rows > 0 && t->flags == 0);
    FUZZ_EXPECT(t->lines[0] == 0 && t->lines[t->columns] > 6.28f && t->lines[t->columns] < 6.2832f);
    FUZZ_EXPECT(vs[0] >= 0 && vs[t->rows] < 3.1416f);
    for (rt_u32 i = 0; i < t->columns; i++)
        FUZZ_EXPECT(t->lines[i] < t->lines[i + 1]);
    for (rt_u32 i = 0; i < t->rows; i++)
        FUZZ_EXPECT(vs[i] < vs[i + 1]);
    fuzz_expect_finite(t->values, values);
    for (size_t i = 0; i < values; i++)
        FUZZ_EXPECT(t->values[i] >= 0);
    for (rt_u32 row = 0; row < t->rows && row < 8; row++)
        for (rt_u32 column = 0; column < t->columns && column < 8; column++)
            FUZZ_EXPECT(rt_light_table_weight(t, NULL, column, row) >= 0);
}

static int run(const uint8_t *data, size_t size)
{
    const rt_bytes file = {(uint8_t *)data, size, size, NULL};
    rt_scene_light_table table = {.lines = fuzz_untouched};
    rt_error error;
    const rt_status status = rt_ies_decode(&table, &file, NULL, &error);
    if (!fuzz_expect_answer(status, &error, table.lines))
        return 0;
    check_table(&table);
    rt_light_table_measure(&table, NULL);
    FUZZ_EXPECT(table.flux[0] >= 0 && table.flux[0] < 1e31 && table.cosine >= -1);
    rt_light_table_free(&table);
    return 1;
}

static void seed(fuzz_inputs *seeds)
{
    fuzz_add_text(seeds, "IESNA:LM-63-2002\n[TEST] a\nTILT=NONE\n1 -1 2 3 1 1 2 .1 .1 0\n"
                         "0.5 1 40\n0 60 90\n0\n683 341.5 0\n");
    fuzz_add_text(seeds, "IESNA91\r\nTILT=NONE\r\n1,1000,1,2,3,1,1,0,0,0\r\n1,1,9\r\n0,180\r\n"
                         "0,45,90\r\n1e2,2\r\n3,4\r\n5,6\r\n");
    fuzz_add_text(seeds, "TILT=NONE\n1 1 1 2 2 1 1 0 0 0 1 1 0\n0 90 0 180 1 2 3 4");
    fuzz_add_text(seeds, "TILT=NONE\n1 1 1 2 3 1 1 0 0 0 1 1 0\n90 180\n0 1.5 360\n1 2 3 4 1 2\n");
    fuzz_add_text(seeds, "IESNA91\nTILT=INCLUDE\n1\n2\n0 90\n1 1\n");
}

const fuzz_target fuzz_target_ies = {
    .name = "ies",
    .sources = "lib/scene/ies.c",
    .run = run,
    .seed = seed,
    .size_max = 2048,
    .tries = 20000,
};
