/*
 * prefix_sum.cl - the places of things that are counted: each number of a table becomes the sum of
 * those before it. The table is cut into runs, whose sums make a smaller table, and so on: each
 * work-item takes one run.
 */
#include "entry.h"
#include "types.h"

/* The sum of each run of the `count` numbers from `first` on goes to the table from `to` on. */
KERNEL sum_runs(uint count, uint first, uint to, global uint *table)
{
    const uint run = item_number();
    const uint begin = run * RT_SUM_RUN;
    if (begin >= count)
        return;
    const uint end = min(begin + RT_SUM_RUN, count);
    uint sum = 0u;
    for (uint i = begin; i < end; i++)
        sum += table[first + i];
    table[to + run] = sum;
}

/*
 * Numbers to places, from where the run begins: at the place that the table from `from` on holds;
 * RT_NONE: at 0.
 */
KERNEL place_runs(uint count, uint first, uint from, global uint *table)
{
    const uint run = item_number();
    const uint begin = run * RT_SUM_RUN;
    if (begin >= count)
        return;
    const uint end = min(begin + RT_SUM_RUN, count);
    uint place = from == RT_NONE ? 0u : table[from + run];
    for (uint i = begin; i < end; i++) {
        const uint number = table[first + i];
        table[first + i] = place;
        place += number;
    }
}
