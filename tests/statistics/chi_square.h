/*
 * chi_square.h - chi-square tests of the kernels' sampling routines against their densities.
 *
 * A routine's samples are brought to the unit square by coordinates that suit it: r and angle on a
 * disc, height and longitude on a sphere. The density over that square is stated here again, in
 * float64 and by the definition of what is sampled, and integrated over each of a grid of cells;
 * what the samples count there is held against it by Pearson's test. Where kernels return a density
 * themselves, it must be the same function, in the same measure.
 *
 * False alarms. A family of tests is one run: every routine with every seed, T tests. A test raises
 * suspicion when counts as far off have a chance below 0.01 / T (Bonferroni), so that with correct
 * routines 1 run of 100 has a suspect. Samples of a new seed must then clear the routine, at the
 * same level, or it fails: together T (0.01 / T)^2 = 1e-4 / T a run. As all seeds are fixed, the
 * verdict on one machine is always the same as well.
 */
#ifndef RT_TESTS_STATISTICS_CHI_SQUARE_H
#define RT_TESTS_STATISTICS_CHI_SQUARE_H

#include <stddef.h>
#include <stdint.h>

#define PI 3.14159265358979323846

/*
 * The maximum number of samples per seed, and how many of the first have their densities checked.
 */
enum { most_samples = 1000000, told_samples = 4096 };

/* A sample on the unit square. */
typedef struct sampled {
    double x, y; /* x < 0: nothing was sampled; counted in a cell of its own */
    /* density over the square that the kernels tell; NAN: they tell none, or i >= told_samples */
    double pdf;
} sampled;

/* How samples of a kind are made and what they should be; `setup` is a routine's own. */
typedef struct method {
    /* makes samples and keeps them */
    void (*draw)(const void *setup, uint32_t seed, uint32_t count);
    /* sample i of those; called by several threads */
    sampled (*place)(const void *setup, uint32_t i);
    /* over the square; what lacks to 1 is not sampled */
    double (*density)(const void *setup, double x, double y);
    int is_proportional; /* the density is known but for a factor, which makes its integral 1 */
    /*
     * How many bytes at the beginning of a setup `draw` reads, where routines differ in the rest
     * alone: those are tested on the same samples. 0: each draws its own.
     */
    size_t drawn_bytes;
} method;

typedef struct routine {
    const char *name;
    int across, down; /* cells of x and of y */
    const method *method;
    const void *setup;
} routine;

/* The tables of all routines. */
typedef struct routine_table {
    const routine *routines;
    size_t count;
} routine_table;
extern const routine_table map_routines, number_routines, light_routines, emission_routines,
    scatter_routines, table_light_routines;

/*
 * Runs a group of tests, one a routine: `samples` samples, at most most_samples, of each of `seeds`
 * seeds. Returns what cmocka returns.
 */
int test_routines(const char *group, uint32_t samples, uint32_t seeds);

#endif
