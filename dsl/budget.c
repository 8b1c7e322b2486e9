/* budget.c - counts what the reading of a scene takes. */
#include "dsl/budget.h"

int rt_budget_take(rt_budget *budget, uint64_t bytes, const char *what)
{
    rt_error error;
    if (!budget)
        return 1;
    if (rt_memory_take(budget->memory, bytes, what, &error) != RT_OK) {
        if (budget->error.status == RT_OK)
            budget->error = error;
        return 0;
    }
    budget->taken += bytes;
    return 1;
}

void rt_budget_free(rt_budget *budget)
{
    rt_memory_give(budget->memory, budget->taken);
    budget->taken = 0;
}
