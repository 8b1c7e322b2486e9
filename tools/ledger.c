/* ledger.c - the energy ledger as text and as JSON. */
#include "ledger.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "json.h"

enum { ROWS_MAX = 32 }; /* lights that are printed by themselves */

static double mean(const double c[3])
{
    return (c[0] + c[1] + c[2]) / 3;
}

static void print_row(const char *name, const rt_light_ledger *l)
{
    double missing = mean(l->emitted) - mean(l->absorbed) - mean(l->escaped) - mean(l->cut_off) -
                     mean(l->roulette);
    printf("ledger %s: %" PRIu64
           " paths, power %.6g, emitted %.6g = absorbed %.6g + escaped %.6g + cut off %.6g + "
           "roulette %.3g, missing %.1e W\n",
           name, l->paths, mean(l->power), mean(l->emitted), mean(l->absorbed), mean(l->escaped),
           mean(l->cut_off), mean(l->roulette), missing);
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

static void name_light(char *out, size_t size, const rt_light_ledger *rows, size_t i)
{
    if (rows[i].shape == RT_NONE)
        snprintf(out, size, "light %zu", i);
    else
        snprintf(out, size, "light %zu (shape %u)", i, rows[i].shape);
}

void ledger_print(const rt_light_ledger *rows, size_t count)
{
    rt_light_ledger sum = {0};
    char name[64];
    for (size_t i = 0; i < count; i++) {
        add(&sum, rows + i);
        name_light(name, sizeof name, rows, i);
        if (i < ROWS_MAX)
            print_row(name, rows + i);
    }
    if (count > ROWS_MAX)
        printf("ledger: %zu lights more\n", count - ROWS_MAX);
    if (count > 1)
        print_row("of all lights", &sum);
}

void ledger_print_difference(const rt_light_ledger *a, const rt_light_ledger *b, size_t count)
{
    size_t differ = 0;
    char name[64];
    for (size_t i = 0; i < count; i++) {
        if (memcmp(a + i, b + i, sizeof *a) == 0 || ++differ > ROWS_MAX)
            continue;
        name_light(name, sizeof name, a, i);
        printf("ledger %s: %" PRIu64 " and %" PRIu64
               " paths, share %.6g and %.6g, emitted %.6g and %.6g, "
               "absorbed %.6g and %.6g, escaped %.6g and %.6g, cut off %.6g and %.6g, roulette "
               "%.3g and %.3g W\n",
               name, a[i].paths, b[i].paths, a[i].share, b[i].share, mean(a[i].emitted),
               mean(b[i].emitted), mean(a[i].absorbed), mean(b[i].absorbed), mean(a[i].escaped),
               mean(b[i].escaped), mean(a[i].cut_off), mean(b[i].cut_off), mean(a[i].roulette),
               mean(b[i].roulette));
    }
    if (differ > ROWS_MAX)
        printf("ledger: %zu lights more differ\n", differ - ROWS_MAX);
}

static void put_light(const rt_light_ledger *l)
{
    fputs("{\"shape\":", stdout);
    if (l->shape == RT_NONE)
        fputs("null", stdout);
    else
        printf("%" PRIu32, l->shape);
    printf(",\"paths\":%" PRIu64, l->paths);
    json_member("share", l->share);
    json_triple("power", l->power);
    json_triple("emitted", l->emitted);
    json_triple("absorbed", l->absorbed);
    json_triple("escaped", l->escaped);
    json_triple("cut_off", l->cut_off);
    json_triple("roulette", l->roulette);
    putchar('}');
}

void ledger_print_json(const rt_light_ledger *rows, size_t count)
{
    fputs(",\"ledger\":[", stdout);
    for (size_t i = 0; i < count; i++) {
        if (i)
            putchar(',');
        put_light(rows + i);
    }
    putchar(']');
}
