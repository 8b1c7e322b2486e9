/* importance.c - the chances of starts, and distributions by their roots. */
#include "photon/importance.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

/* Paths of the pilot for each cell, and how many paths the chance of other cells stands for. */
enum { PATHS_A_CELL = 4, PRIOR = 4 };

static const char what[] = "the tables of visual importance";

/* Paths, their weights, and the weights of those that count. */
typedef struct tally {
    double paths, weights, counts;
    double chance;
} tally;

static void add(tally *t, const rt_pilot_path *path)
{
    t->paths++;
    t->weights += (double)path->weight;
    t->counts += path->counts ? (double)path->weight : 0;
}

/* The chance that a path counts, drawn towards another one where there are few paths. */
static double chance(const tally *t, double other)
{
    const double own = t->weights > 0 ? t->counts / t->weights : 0;
    return (t->paths * own + PRIOR * other) / (t->paths + PRIOR);
}

uint32_t rt_importance_levels(size_t paths, size_t lights)
{
    uint32_t levels = 3;
    while (levels > 0 && paths / PATHS_A_CELL < lights << 4 * levels)
        levels--;
    return levels;
}

/*
 * Replaces what the cells of a light counted with their chances: whole cells of a level count what
 * the 16 of the next one do, and a chance is drawn towards that of the level before.
 */
static void find_chances(tally *cells, uint32_t levels, double prior)
{
    const size_t count = (size_t)1 << 4 * levels;
    for (size_t i = 0; i < count; i++) {
        double p = prior;
        for (uint32_t level = 1; level <= levels; level++) {
            const size_t size = (size_t)1 << 4 * (levels - level), first = i / size * size;
            tally sum = {0, 0, 0, 0};
            for (size_t k = first; k < first + size; k++) {
                sum.paths += cells[k].paths;
                sum.weights += cells[k].weights;
                sum.counts += cells[k].counts;
            }
            p = chance(&sum, p);
        }
        cells[i].chance = p;
    }
}

/* The probabilities of a light's cells, as their sums; returns what part of paths then counts. */
static double fill_table(float *sums, const tally *cells, size_t count)
{
    double total = 0, sum = 0, seen = 0;
    for (size_t i = 0; i < count; i++)
        total += sqrt(cells[i].chance);
    for (size_t i = 0; i < count; i++) {
        const double p = cells[i].chance;
        const double share =
            RT_IMPORTANCE_LEAST / (double)count + (1 - RT_IMPORTANCE_LEAST) * sqrt(p) / total;
        sum += share;
        seen += share * p;
        sums[i] = (float)sum;
    }
    sums[count - 1] = 1;
    return seen;
}

/* The factors of the shares, by the root of each source's chance. */
static void fill_factors(double *factors, const rt_light_sources *lights, const tally *sources,
                         double prior)
{
    double total = 0;
    for (size_t i = 0; i < lights->count; i++)
        total += lights->sources[i].share * sqrt(chance(sources + i, prior));
    for (size_t i = 0; i < lights->count; i++)
        factors[i] = RT_IMPORTANCE_LEAST +
                     (1 - RT_IMPORTANCE_LEAST) * sqrt(chance(sources + i, prior)) / total;
}

/* Fills the tables from tallies of all paths: of sources, and of the cells of each light. */
static void fill(rt_importance *out, const rt_light_sources *lights, int weighs_lights,
                 const tally *all, const tally *sources, tally *cells)
{
    const size_t count = (size_t)1 << 4 * out->levels;
    const double prior = all->counts / all->weights;
    out->seen = prior;
    for (size_t i = 0; i < lights->count; i++)
        out->factors[i] = 1;
    if (weighs_lights)
        fill_factors(out->factors, lights, sources, prior);
    for (size_t i = 0; i < lights->light_count; i++) {
        const rt_u32 source = lights->of_light[i];
        find_chances(cells + i * count, out->levels, chance(sources + source, prior));
        const double seen = fill_table(out->sums + i * count, cells + i * count, count);
        out->expected += (double)lights->shares[i].pmf * out->factors[source] * seen;
    }
}

rt_status rt_importance_make(rt_importance *out, const rt_light_sources *lights, uint32_t levels,
                             int weighs_lights, const rt_pilot_path *paths, size_t count,
                             rt_error *error)
{
    const size_t cells = lights->light_count << 4 * levels;
    rt_memory *memory = lights->memory;
    tally all = {0, 0, 0, 0};
    memset(out, 0, sizeof *out);
    out->levels = levels;
    tally *tallies =
        rt_memory_zeroed(memory, cells + lights->count + 1, sizeof *tallies, what, error);
    if (tallies)
        out->sums = rt_memory_zeroed(memory, cells + 1, sizeof *out->sums, what, error);
    if (out->sums)
        out->factors =
            rt_memory_zeroed(memory, lights->count + 1, sizeof *out->factors, what, error);
    for (size_t i = 0; i < count && out->factors; i++) {
        const rt_path_start *start = &paths[i].start;
        if (start->light >= lights->light_count)
            continue;
        add(&all, paths + i);
        add(tallies + ((size_t)start->light << 4 * levels) + start->cell, paths + i);
        add(tallies + cells + lights->of_light[start->light], paths + i);
    }
    if (out->factors && all.counts > 0)
        fill(out, lights, weighs_lights, &all, tallies + cells, tallies);
    const rt_status status = out->factors ? RT_OK : RT_ERROR_MEMORY;
    rt_memory_free(tallies);
    if (status != RT_OK)
        rt_importance_free(out);
    return status;
}

float rt_importance_weight(const rt_importance *importance, const rt_light_sources *lights,
                           const rt_path_start *start)
{
    if (start->light >= lights->light_count || importance->seen == 0)
        return 1;
    const size_t count = (size_t)1 << 4 * importance->levels;
    const float *sums = importance->sums + start->light * count;
    const double share =
        (double)sums[start->cell] - (start->cell > 0 ? (double)sums[start->cell - 1] : 0);
    return (float)(1 /
                   (importance->factors[lights->of_light[start->light]] * (double)count * share));
}

void rt_importance_free(rt_importance *importance)
{
    rt_memory_free(importance->sums);
    rt_memory_free(importance->factors);
    memset(importance, 0, sizeof *importance);
}
