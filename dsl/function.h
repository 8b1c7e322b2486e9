/* function.h - the functions of arithmetic. Angles are in degrees. */
#ifndef RT_DSL_FUNCTION_H
#define RT_DSL_FUNCTION_H

#include "dsl/suggest.h"

#define RT_FUNCTION_ARGUMENTS_MAX 2

typedef struct rt_function {
    const char *name;
    int arguments;
    double (*value)(const double *arguments);
} rt_function;

#define RT_FUNCTION_COUNT 20

/* All functions, RT_FUNCTION_COUNT of them. */
extern const rt_function rt_functions[];

/* The position of a function, or -1. */
int rt_function_find(rt_text name);
void rt_suggestion_offer_functions(rt_suggestion *suggestion);

/* Sine and cosine of an angle in degrees; exact at multiples of 90 degrees. */
double rt_sine(double degrees);
double rt_cosine(double degrees);

#endif
