/* budget.c - counts what the reading of a scene takes. */
#include "dsl/budget.h"

#include <string.h>

/* What was taken for the same; the last has all for which there is no place of its own. */
static rt_budget_part *part_of(rt_budget *budget, const char *what)
{
    rt_budget_part *part = budget->parts, *last = part + RT_BUDGET_PARTS - 1;
    while (part < last && part->what && strcmp(part->what, what) != 0)
        part++;
    if (!part->what)
        part->what = what;
    return part;
}

int rt_budget_take(rt_budget *budget, uint64_t bytes, const char *what)
{
    rt_error error;
    if (!budget)
        return 1;
    rt_budget_part *part = part_of(budget, what);
    if (rt_memory_take(budget->memory, bytes, part->what, &error) != RT_OK) {
        if (budget->error.status == RT_OK)
            budget->error = error;
        return 0;
    }
    part->taken += bytes;
    return 1;
}

void rt_budget_free(rt_budget *budget)
{
    for (int i = 0; i < RT_BUDGET_PARTS; i++)
        if (budget->parts[i].taken > 0)
            rt_memory_give(budget->memory, budget->parts[i].taken, budget->parts[i].what);
    memset(budget->parts, 0, sizeof budget->parts);
}
