/* expression.c - evaluates postfix expressions and says why one has no value. */
#include "dsl/expression.h"

#include "dsl/function.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/*
 * A nesting level holds at most four values while it works on the next: the left sides of
 * a sum and of a product, and two earlier components of a vector or arguments of a function.
 */
#define STACK_SIZE (4 * (RT_NESTING_MAX + 1) + 4)

rt_operation *rt_operations_add(rt_operations *operations, rt_reports *reports)
{
    if (operations->count == RT_OPERATIONS_MAX)
        return NULL;
    if (operations->count == operations->capacity) {
        size_t capacity = operations->capacity ? 2 * operations->capacity : 64;
        rt_operation *items = realloc(operations->items, capacity * sizeof *items);
        if (!items) {
            reports->out_of_memory = 1;
            return NULL;
        }
        operations->items = items;
        operations->capacity = capacity;
    }
    return &operations->items[operations->count++];
}

void rt_operations_free(rt_operations *operations)
{
    free(operations->items);
    memset(operations, 0, sizeof *operations);
}

static rt_value number_value(double number)
{
    rt_value value = {{number, number, number}, 0};
    return value;
}

/* a op b, component by component; a number stands for three equal components. */
static rt_value combine(rt_operation_kind kind, rt_value a, rt_value b)
{
    rt_value result;
    result.is_vector = a.is_vector || b.is_vector;
    for (int i = 0; i < 3; i++) {
        double x = a.v[i], y = b.v[i];
        result.v[i] = kind == RT_OPERATION_ADD        ? x + y
                      : kind == RT_OPERATION_SUBTRACT ? x - y
                      : kind == RT_OPERATION_MULTIPLY ? x * y
                                                      : x / y;
    }
    return result;
}

static int has_zero(const rt_value *value)
{
    return value->v[0] == 0 || value->v[1] == 0 || value->v[2] == 0;
}

static int is_finite(const rt_value *value)
{
    return isfinite(value->v[0]) && isfinite(value->v[1]) && isfinite(value->v[2]);
}

/* Replaces the two topmost values by the result of an operation on them. */
static int apply_binary(rt_value *top, const rt_operation *operation, rt_reports *reports)
{
    if (operation->kind == RT_OPERATION_DIVIDE && has_zero(&top[-1])) {
        rt_report_error(reports, operation->place, "division by zero");
        return 0;
    }
    top[-2] = combine(operation->kind, top[-2], top[-1]);
    if (!is_finite(&top[-2])) {
        rt_report_error(reports, operation->place, "the result of this '%c' is too large",
                        operation->place.source->text[operation->place.offset]);
        return 0;
    }
    return 1;
}

/* Replaces the arguments of a function, the topmost values, by its value. */
static int apply_function(rt_value *top, const rt_operation *operation, rt_reports *reports)
{
    const rt_function *function = &rt_functions[operation->constant];
    rt_value *arguments = top - function->arguments, result = {{0, 0, 0}, 0};
    for (int c = 0; c < 3; c++) {
        double numbers[RT_FUNCTION_ARGUMENTS_MAX];
        for (int i = 0; i < function->arguments; i++) {
            numbers[i] = arguments[i].v[c];
            result.is_vector |= arguments[i].is_vector;
        }
        result.v[c] = function->value(numbers);
    }
    *arguments = result;
    if (is_finite(&result))
        return 1;
    rt_report_error(reports, operation->place, "'%s' has no finite value here", function->name);
    return 0;
}

int rt_expression_evaluate(rt_value *out, const rt_expression *expression,
                           const rt_operations *operations, const rt_names *constants,
                           rt_reports *reports)
{
    rt_value stack[STACK_SIZE], *top = stack;
    if (expression->count == 0) {
        *out = number_value(expression->number);
        return 1;
    }
    for (size_t i = 0; i < expression->count; i++) {
        const rt_operation *operation = &operations->items[expression->first + i];
        assert(top < stack + STACK_SIZE);
        switch (operation->kind) {
        case RT_OPERATION_NUMBER:
            *top++ = number_value(operation->number);
            break;
        case RT_OPERATION_CONSTANT:
            *top++ = constants->items[operation->constant].value;
            break;
        case RT_OPERATION_VECTOR:
            top -= 2;
            top[-1].v[1] = top[0].v[0];
            top[-1].v[2] = top[1].v[0];
            top[-1].is_vector = 1;
            break;
        case RT_OPERATION_CALL:
            if (!apply_function(top, operation, reports))
                return 0;
            top -= rt_functions[operation->constant].arguments - 1;
            break;
        case RT_OPERATION_NEGATE:
            for (int c = 0; c < 3; c++)
                top[-1].v[c] = -top[-1].v[c];
            break;
        case RT_OPERATION_ADD:
        case RT_OPERATION_SUBTRACT:
        case RT_OPERATION_MULTIPLY:
        case RT_OPERATION_DIVIDE:
            if (!apply_binary(top, operation, reports))
                return 0;
            top--;
            break;
        }
    }
    assert(top == stack + 1);
    *out = stack[0];
    return 1;
}
