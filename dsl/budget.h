/* budget.h - the memory that the reading of a scene takes, and gives back at its end. */
#ifndef RT_DSL_BUDGET_H
#define RT_DSL_BUDGET_H

#include "rt.h"

enum { RT_BUDGET_PARTS = 4 };

/* What was taken for one thing. */
typedef struct rt_budget_part {
    const char *what; /* NULL: nothing yet */
    uint64_t taken;   /* bytes */
} rt_budget_part;

/* All zero counts nowhere. */
typedef struct rt_budget {
    rt_memory *memory; /* NULL: none */
    rt_budget_part parts[RT_BUDGET_PARTS];
    rt_error error; /* of the first failure; status RT_OK while there is none */
} rt_budget;

/*
 * Takes so many bytes more, which `what` needs, a string constant; returns 0 after noting the
 * error when they are not to be had. budget NULL: any are.
 */
int rt_budget_take(rt_budget *budget, uint64_t bytes, const char *what);

/* Gives all back. */
void rt_budget_free(rt_budget *budget);

#endif
