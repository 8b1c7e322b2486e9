/*
 * expression.h - arithmetic as a sequence of operations on a stack (postfix).
 *
 * Expressions are kept, not computed while parsing, so that one text can be evaluated
 * more than once. Evaluation does not recurse.
 */
#ifndef RT_DSL_EXPRESSION_H
#define RT_DSL_EXPRESSION_H

#include "dsl/report.h"

#define RT_NESTING_MAX 64       /* parentheses and brackets inside each other */
#define RT_OPERATIONS_MAX 65536 /* in one statement */

typedef enum rt_operation_kind {
    RT_OPERATION_NUMBER,   /* push a number */
    RT_OPERATION_CONSTANT, /* push a constant's value */
    RT_OPERATION_VECTOR,   /* pop three numbers, push them as a vector */
    RT_OPERATION_CALL,     /* pop a function's arguments, push its value, component by component */
    RT_OPERATION_NEGATE,
    RT_OPERATION_ADD, /* these four: pop two values, push the result, component by component */
    RT_OPERATION_SUBTRACT,
    RT_OPERATION_MULTIPLY,
    RT_OPERATION_DIVIDE
} rt_operation_kind;

typedef struct rt_operation {
    rt_operation_kind kind;
    rt_place place;
    double number;
    size_t constant; /* position in the table of constants, or of the function in theirs */
} rt_operation;

/* The operations of all expressions of a statement. All zero is none. */
typedef struct rt_operations {
    rt_operation *items;
    size_t count, capacity;
} rt_operations;

/* One expression among them, or a number, which needs none. */
typedef struct rt_expression {
    rt_place place;
    size_t first, count; /* 0: it is a number as written */
    double number;
    int is_vector; /* what it will yield; meaningless when broken */
    int is_broken; /* has an error already reported: not to be evaluated */
} rt_expression;

/*
 * Appends an operation, to be filled by the caller; returns NULL when there are too many or no
 * memory (then set in reports).
 */
rt_operation *rt_operations_add(rt_operations *operations, rt_reports *reports);
void rt_operations_free(rt_operations *operations);

/*
 * Evaluates an expression that is not broken. Returns 0 after reporting what went wrong (division
 * by zero, ...).
 */
int rt_expression_evaluate(rt_value *out, const rt_expression *expression,
                           const rt_operations *operations, const rt_names *constants,
                           rt_reports *reports);

#endif
