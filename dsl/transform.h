/* transform.h - the transform of a block, step by step. */
#ifndef RT_DSL_TRANSFORM_H
#define RT_DSL_TRANSFORM_H

#include "dsl/schema.h"

/* The map so far: upper three rows, for column vectors. */
typedef struct rt_steps {
    double m[3][4];
    int count; /* steps taken */
} rt_steps;

void rt_steps_begin(rt_steps *steps);

/* Adds a step after those before. numbers has as many as the type of the field takes. */
void rt_steps_add(rt_steps *steps, rt_field_type type, const double *numbers);

#endif
