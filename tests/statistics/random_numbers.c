/* random_numbers.c - pairs of random numbers: within one stream, and across many streams. */
#include <stddef.h>

#include "kernels/rng_draw.h"
#include "statistics/space.h"

/*
 * Which numbers of which sets; along: of the samples of one stream, else of one sample of many
 * streams.
 */
typedef struct choice {
    uint32_t sampler; /* rt_sampler */
    int along;
    uint32_t set;
    int first, second; /* 0 to 3 of the set, 4 to 7 of the next */
} choice;

static float rows[most_samples][8];

static void draw_numbers(const void *setup, uint32_t seed, uint32_t count)
{
    const choice *c = setup;
    rng_draw_pairs(c->sampler, seed, c->along, c->set, count, rows);
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

static const method by_numbers = {draw_numbers, place_numbers, even, 0, offsetof(choice, first)};

static const routine routines[] = {
    {"Sobol, x and y", 32, 32, &by_numbers, &(const choice){S, 1, 0, 0, 1}},
    {"Sobol, z and w", 32, 32, &by_numbers, &(const choice){S, 1, 2, 6, 7}},
    {"Sobol, x of two sets", 32, 32, &by_numbers, &(const choice){S, 1, 2, 0, 4}},
    {"Sobol over streams, x and y", 32, 32, &by_numbers, &(const choice){S, 0, 0, 0, 1}},
    {"Sobol over streams, z and w", 32, 32, &by_numbers, &(const choice){S, 0, 2, 6, 7}},
    {"Sobol over streams, x of two sets", 32, 32, &by_numbers, &(const choice){S, 0, 2, 0, 4}},
    {"independent, x and y", 32, 32, &by_numbers, &(const choice){I, 1, 0, 0, 1}},
    {"independent, z and w", 32, 32, &by_numbers, &(const choice){I, 1, 2, 6, 7}},
    {"independent, x of two sets", 32, 32, &by_numbers, &(const choice){I, 1, 2, 0, 4}},
    {"independent over streams, x and y", 32, 32, &by_numbers, &(const choice){I, 0, 0, 0, 1}},
    {"independent over streams, z and w", 32, 32, &by_numbers, &(const choice){I, 0, 2, 6, 7}},
    {"independent over streams, x of two sets", 32, 32, &by_numbers,
     &(const choice){I, 0, 2, 0, 4}},
};

const routine_table number_routines = {routines, sizeof routines / sizeof *routines};
