#include "ledger.h"

#include <inttypes.h>
#include <stdio.h>

enum { ROWS_MAX = 32 }; /* lights that are printed by themselves */

static double mean(const double c[3])
{
    return (c[0] + c[1] + c[2]) / 3;
}

static void print_row(const char *name, const rt_light_ledger *l)
{
    double missing = mean(l->emitted) - mean(l->absorbed) - mean(l->escaped) - mean(l->cut_off) - mean(l->roulette);
    printf("ledger %s: %" PRIu64 " paths, power %.6g, emitted %.6g = absorbed %.6g + escaped %.6g + cut off %.6g + "
           "roulette %.3g, missing %.1e W\n",
           name, l->paths, mean(l->power), mean(l->emitted), mean(l->absorbed), mean(l->escaped), mean(l->cut_off),
           mean(l->roulette), missing);
}

static void add(rt_light_ledger *sum, const rt_light_ledger *l)
{
    sum->paths += l->paths;
    for (int c = 0; c < 3; c++) {
        sum->power[c] += l->power[c];
        sum->emitted[c] += l->emitted[c];
        sum->absorbed[c] += l->absorbed[c];
        sum->escaped[c] += l->escaped[c];
        sum->cut_off[c] += l->cut_off[c];
        sum->roulette[c] += l->roulette[c];
    }
}

void ledger_print(const rt_light_ledger *rows, size_t count)
{
    rt_light_ledger sum = {0};
    char name[64];
    for (size_t i = 0; i < count; i++) {
        add(&sum, rows + i);
        if (rows[i].shape == RT_NONE)
            snprintf(name, sizeof name, "light %zu", i);
        else
            snprintf(name, sizeof name, "light %zu (shape %u)", i, rows[i].shape);
        if (i < ROWS_MAX)
            print_row(name, rows + i);
    }
    if (count > ROWS_MAX)
        printf("ledger: %zu lights more\n", count - ROWS_MAX);
    if (count > 1)
        print_row("of all lights", &sum);
}
