/*
 * parse_expression.c - recursive descent over arithmetic, into postfix.
 *
 *     expression = term { ( "+" | "-" ) term }
 *     term       = factor { ( "*" | "/" ) factor }
 *     factor     = { "-" } primary
 *     primary    = number | name | call | "(" expression ")" | "[" value value value "]"
 *     call       = function "(" expression { "," expression } ")"
 *     value      = [ "-" ] primary
 */
#include <string.h>

#include "dsl/function.h"
#include "dsl/parse_expression.h"
#include "dsl/suggest.h"

static int parse_sum(rt_parser *parser, int *is_vector);
static int parse_signed_primary(rt_parser *parser, int *is_vector);
static int parse_whole(rt_parser *parser, rt_expression *out, int (*parse)(rt_parser *, int *));

static int add(rt_parser *parser, rt_operation_kind kind, rt_place place, double number,
               size_t constant)
{
    rt_operation *operation = rt_operations_add(parser->operations, parser->reports);
    if (operation) {
        operation->kind = kind;
        operation->place = place;
        operation->number = number;
        operation->constant = constant;
        return 1;
    }
    rt_report_error(parser->reports, place, "the expression is too long");
    return 0;
}

static int parse_number(rt_parser *parser, int *is_vector)
{
    rt_token token = *rt_parser_take(parser);
    parser->value_broken |= token.is_broken;
    *is_vector = 0;
    return add(parser, RT_OPERATION_NUMBER, token.place, token.number, 0);
}

static void report_unknown_constant(rt_parser *parser, rt_place place)
{
    char quote[RT_QUOTE_SIZE];
    rt_text text = rt_place_text(&place);
    rt_report_error(parser->reports, place, "unknown constant '%s'", rt_text_quote(quote, text));
    rt_suggestion suggestion = rt_suggestion_begin(text);
    rt_suggestion_offer_names(&suggestion, &parser->scope->constants);
    if (rt_names_find(&parser->scope->textures, text) != RT_NAME_NONE)
        rt_report_hint(parser->reports,
                       "'%s' is a texture: the field that takes it ends in `_texture`, as in "
                       "`kd_texture`",
                       rt_text_quote(quote, text));
    else if (suggestion.best.at)
        rt_report_hint(parser->reports, "did you mean '%s'?",
                       rt_text_quote(quote, suggestion.best));
    else if (rt_text_is_unit(text))
        rt_report_hint(parser->reports, RT_UNIT_HINT);
    else if (rt_text_equal(text, "nan") || rt_text_equal(text, "inf") ||
             rt_text_equal(text, "infinity"))
        rt_report_hint(parser->reports, "every number is finite");
    else
        rt_report_hint(parser->reports,
                       "constants are defined by 'let NAME = VALUE' above their use");
    rt_report_unknown(parser->reports, &parser->scope->constants);
}

static int parse_constant(rt_parser *parser, int *is_vector)
{
    rt_place place = rt_parser_take(parser)->place;
    size_t found = rt_names_find(&parser->scope->constants, rt_place_text(&place));
    *is_vector = 0;
    if (found == RT_NAME_NONE && rt_text_equal(rt_place_text(&place), "pi"))
        return add(parser, RT_OPERATION_NUMBER, place, 3.14159265358979323846, 0);
    if (found == RT_NAME_NONE) {
        report_unknown_constant(parser, place);
        parser->value_broken = 1;
        return 1;
    }
    rt_name *name = &parser->scope->constants.items[found];
    name->is_used = 1;
    *is_vector = name->value.is_vector;
    parser->value_broken |= name->is_broken;
    return add(parser, RT_OPERATION_CONSTANT, place, 0, found);
}

static int open_bracket(rt_parser *parser, rt_place *open)
{
    *open = rt_parser_take(parser)->place;
    if (++parser->depth <= RT_NESTING_MAX)
        return 1;
    rt_report_error(parser->reports, *open, "parentheses are nested deeper than %d",
                    RT_NESTING_MAX);
    return 0;
}

static int close_bracket(rt_parser *parser, rt_place open, char bracket)
{
    char found[RT_FOUND_SIZE];
    const rt_token *token = rt_parser_peek(parser, 0);
    if (token->kind == bracket) {
        rt_parser_take(parser);
        parser->depth--;
        return 1;
    }
    rt_report_error(parser->reports, rt_parser_expected_place(parser), "expected '%c', found %s",
                    bracket, rt_parser_found(found, token));
    if (token->kind == ',')
        rt_report_hint(parser->reports,
                       "numbers are separated by spaces; parentheses hold one value");
    else if (!rt_parser_hint_operator(parser, token))
        rt_report_hint(parser->reports, "it closes the '%c' at line %d, column %d",
                       bracket == ')' ? '(' : '[', open.line, open.column);
    return 0;
}

static int parse_parentheses(rt_parser *parser, int *is_vector)
{
    rt_place open;
    return open_bracket(parser, &open) && parse_sum(parser, is_vector) &&
           close_bracket(parser, open, ')');
}

static void report_unknown_function(rt_parser *parser, rt_place place)
{
    char quote[RT_QUOTE_SIZE];
    rt_text text = rt_place_text(&place);
    rt_suggestion suggestion = rt_suggestion_begin(text);
    rt_suggestion_offer_functions(&suggestion);
    rt_report_error(parser->reports, place, "unknown function '%s'", rt_text_quote(quote, text));
    if (rt_parser_is_constant(parser, text))
        rt_report_hint(parser->reports, "a space separates a constant from the value that follows");
    else if (suggestion.best.at)
        rt_report_hint(parser->reports, "did you mean '%s'?", suggestion.best.at);
    parser->value_broken = 1;
}

/* The function's name comes next, and its '(' touches it. */
static int parse_call(rt_parser *parser, int *is_vector)
{
    rt_place place = rt_parser_take(parser)->place, open;
    int function = rt_function_find(rt_place_text(&place)), given = 0, is_more = 1;
    *is_vector = 0;
    if (function < 0)
        report_unknown_function(parser, place);
    if (!open_bracket(parser, &open))
        return 0;
    for (; is_more; given++) {
        int argument_is_vector;
        if (!parse_sum(parser, &argument_is_vector))
            return 0;
        *is_vector |= argument_is_vector;
        is_more = rt_parser_peek(parser, 0)->kind == ',';
        if (is_more)
            rt_parser_take(parser);
    }
    if (!close_bracket(parser, open, ')'))
        return 0;
    if (function >= 0 && given != rt_functions[function].arguments) {
        rt_report_error(parser->reports, place, "'%s' takes %s, found %d",
                        rt_functions[function].name,
                        rt_functions[function].arguments == 1 ? "one value"
                                                              : "two values, separated by a comma",
                        given);
        parser->value_broken = 1;
    }
    return add(parser, RT_OPERATION_CALL, place, 0, (size_t)(function < 0 ? 0 : function));
}

/* Whether a call follows but for a space, as in `sin (30)`; this is then reported. */
static int call_follows_apart(rt_parser *parser)
{
    rt_place place = rt_parser_peek(parser, 0)->place;
    rt_text name = rt_place_text(&place);
    if (rt_function_find(name) < 0 || rt_parser_is_constant(parser, name) ||
        rt_parser_peek(parser, 1)->kind != '(')
        return 0;
    char quote[RT_QUOTE_SIZE];
    rt_report_error(parser->reports, place, "'%s' is apart from its '('",
                    rt_text_quote(quote, name));
    rt_report_hint(parser->reports, "a function's name touches it: %s(...)", quote);
    parser->value_broken = 1;
    return 1;
}

static int parse_vector(rt_parser *parser, int *is_vector)
{
    rt_place open;
    if (!open_bracket(parser, &open))
        return 0;
    for (int i = 0; i < 3; i++) {
        rt_expression component;
        if (rt_parser_peek(parser, 0)->kind == ']') {
            rt_report_error(parser->reports, rt_parser_peek(parser, 0)->place,
                            "a vector has three numbers, found %d", i);
            return 0;
        }
        if (!parse_whole(parser, &component, parse_signed_primary))
            return 0;
        if (component.is_vector && !component.is_broken) {
            rt_report_error(parser->reports, component.place, "expected a number, found a vector");
            parser->value_broken = 1;
        }
    }
    *is_vector = 1;
    return close_bracket(parser, open, ']') && add(parser, RT_OPERATION_VECTOR, open, 0, 0);
}

static int parse_primary(rt_parser *parser, int *is_vector)
{
    char found[RT_FOUND_SIZE];
    const rt_token *token = rt_parser_peek(parser, 0);
    int is_next_statement = token->first_on_line && rt_parser_statement_follows(parser);
    const int kind = is_next_statement ? RT_TOKEN_END : token->kind;
    if (kind == RT_TOKEN_NUMBER)
        return parse_number(parser, is_vector);
    if (kind == RT_TOKEN_WORD && (rt_parser_call_follows(parser) || call_follows_apart(parser)))
        return parse_call(parser, is_vector);
    if (kind == RT_TOKEN_WORD)
        return parse_constant(parser, is_vector);
    if (kind == '(')
        return parse_parentheses(parser, is_vector);
    if (kind == '[')
        return parse_vector(parser, is_vector);
    rt_report_error(parser->reports, rt_parser_expected_place(parser),
                    "expected a number, found %s", rt_parser_found(found, token));
    if (token->kind == ',')
        rt_report_hint(parser->reports, "numbers are separated by spaces");
    return 0;
}

static int parse_factor(rt_parser *parser, int *is_vector)
{
    int negative = 0;
    rt_place minus = rt_parser_peek(parser, 0)->place;
    while (rt_parser_peek(parser, 0)->kind == '-') {
        rt_parser_take(parser);
        negative = !negative;
    }
    return parse_primary(parser, is_vector) &&
           (!negative || add(parser, RT_OPERATION_NEGATE, minus, 0, 0));
}

static int parse_product(rt_parser *parser, int *is_vector)
{
    if (!parse_factor(parser, is_vector))
        return 0;
    for (;;) {
        int kind = rt_parser_peek(parser, 0)->kind, right_is_vector;
        if (kind != '*' && kind != '/')
            return 1;
        rt_place place = rt_parser_take(parser)->place;
        if (!parse_factor(parser, &right_is_vector))
            return 0;
        *is_vector |= right_is_vector;
        if (!add(parser, kind == '*' ? RT_OPERATION_MULTIPLY : RT_OPERATION_DIVIDE, place, 0, 0))
            return 0;
    }
}

static int parse_sum(rt_parser *parser, int *is_vector)
{
    if (!parse_product(parser, is_vector))
        return 0;
    for (;;) {
        int kind = rt_parser_peek(parser, 0)->kind, right_is_vector;
        if (kind != '+' && kind != '-')
            return 1;
        rt_place place = rt_parser_take(parser)->place;
        if (!parse_product(parser, &right_is_vector))
            return 0;
        *is_vector |= right_is_vector;
        if (!add(parser, kind == '+' ? RT_OPERATION_ADD : RT_OPERATION_SUBTRACT, place, 0, 0))
            return 0;
    }
}

/* Parses one expression by `parse` and describes it in *out. */
static int parse_whole(rt_parser *parser, rt_expression *out, int (*parse)(rt_parser *, int *))
{
    int outer_broken = parser->value_broken;
    memset(out, 0, sizeof *out);
    parser->value_broken = 0;
    out->place = rt_parser_peek(parser, 0)->place;
    out->first = parser->operations->count;
    int parsed = parse(parser, &out->is_vector);
    out->count = parser->operations->count - out->first;
    out->place = rt_place_join(out->place, rt_parser_last(parser)->place);
    out->is_broken = !parsed || parser->value_broken;
    parser->value_broken |= outer_broken;
    return parsed;
}

int rt_parse_expression(rt_parser *parser, rt_expression *out)
{
    parser->depth = 0;
    return parse_whole(parser, out, parse_sum);
}

/* One minus at most, and it must touch what it negates: `1 - 4` in a list could mean two things. */
static int parse_signed_primary(rt_parser *parser, int *is_vector)
{
    if (rt_parser_peek(parser, 0)->kind != '-')
        return parse_primary(parser, is_vector);
    int opens = rt_parser_last(parser)->kind == '[';
    rt_token minus = *rt_parser_take(parser);
    if ((!minus.space_before && !opens) || rt_parser_peek(parser, 0)->space_before) {
        rt_report_error(parser->reports, minus.place,
                        "this '-' is neither a sign nor inside parentheses");
        rt_report_hint(parser->reports, "write (a - b) for a difference, -4 for a negative number");
        parser->value_broken = 1;
    }
    return parse_primary(parser, is_vector) && add(parser, RT_OPERATION_NEGATE, minus.place, 0, 0);
}

int rt_parse_value(rt_parser *parser, rt_expression *out)
{
    if (rt_parser_peek(parser, 0)->kind == RT_TOKEN_NUMBER) {
        const rt_token *token = rt_parser_take(parser);
        out->place = token->place;
        out->count = 0;
        out->number = token->number;
        out->is_vector = 0;
        out->is_broken = token->is_broken;
        parser->value_broken |= token->is_broken;
        return 1;
    }
    return parse_whole(parser, out, parse_signed_primary);
}
