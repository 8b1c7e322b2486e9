/* numbers.c - the random numbers themselves, two coordinates at a time: along one stream, and over many streams. */
#include <string.h>

#include "render/sobol.h"
#include "statistics/space.h"
#include "support.h"
#include "types.h"

/* Which numbers of which sets; along: of the samples of one stream, else of one sample of many streams. */
typedef struct choice {
    uint32_t sampler; /* rt_sampler */
    int along;
    uint32_t set;
    int first, second; /* 0 to 3 of the set, 4 to 7 of the next */
} choice;

static float rows[most_samples][8];

static cl_mem sobol_scene(void)
{
    static struct {
        rt_scene_header header;
        uint32_t table[RT_SOBOL_WORDS];
    } scene;
    scene.header.sobol = sizeof scene.header / RT_SCENE_ROW;
    scene.header.sobol_count = RT_SOBOL_WORDS / 4;
    rt_sobol_table(scene.table);
    return test_buffer(sizeof scene, &scene);
}

static void draw_numbers(const void *setup, uint32_t seed, uint32_t count)
{
    const choice *c = setup;
    rt_params params;
    memset(&params, 0, sizeof params);
    params.sampler = c->sampler;
    params.seed = seed;
    uint32_t along = (uint32_t)c->along;
    cl_kernel kernel = test_kernel("rng", "pairs");
    cl_mem scene = sobol_scene(), made = test_buffer(count * sizeof *rows, NULL);
    rt_arg args[] = {RT_ARG(params), RT_ARG(scene), RT_ARG(along), RT_ARG(c->set), RT_ARG(count), RT_ARG(made)};
    test_run(kernel, args, 6, count);
    test_read(made, count * sizeof *rows, rows);
}

static sampled place_numbers(const void *setup, uint32_t i)
{
    const choice *c = setup;
    return (sampled){rows[i][c->first], rows[i][c->second], NAN};
}

static double even(const void *setup, double x, double y)
{
    (void)setup, (void)x, (void)y;
    return 1;
}

enum { S = RT_SAMPLER_SOBOL, I = RT_SAMPLER_INDEPENDENT };

static const method by_numbers = {draw_numbers, place_numbers, even, 0};

static const routine routines[] = {
    {"Sobol, x and y", 32, 32, &by_numbers, &(const choice){S, 1, 0, 0, 1}},
    {"Sobol, z and w", 32, 32, &by_numbers, &(const choice){S, 1, 3, 2, 3}},
    {"Sobol, x of two sets", 32, 32, &by_numbers, &(const choice){S, 1, 2, 0, 4}},
    {"Sobol over streams, x and y", 32, 32, &by_numbers, &(const choice){S, 0, 0, 0, 1}},
    {"Sobol over streams, z and w", 32, 32, &by_numbers, &(const choice){S, 0, 3, 2, 3}},
    {"Sobol over streams, x of two sets", 32, 32, &by_numbers, &(const choice){S, 0, 2, 0, 4}},
    {"independent, x and y", 32, 32, &by_numbers, &(const choice){I, 1, 0, 0, 1}},
    {"independent, z and w", 32, 32, &by_numbers, &(const choice){I, 1, 3, 2, 3}},
    {"independent, x of two sets", 32, 32, &by_numbers, &(const choice){I, 1, 2, 0, 4}},
    {"independent over streams, x and y", 32, 32, &by_numbers, &(const choice){I, 0, 0, 0, 1}},
    {"independent over streams, z and w", 32, 32, &by_numbers, &(const choice){I, 0, 3, 2, 3}},
    {"independent over streams, x of two sets", 32, 32, &by_numbers, &(const choice){I, 0, 2, 0, 4}},
};

const routine_table number_routines = {routines, sizeof routines / sizeof *routines};
