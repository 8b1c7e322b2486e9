/* parse_expression.h - arithmetic: whole expressions, and the single values that fields take. */
#ifndef RT_DSL_PARSE_EXPRESSION_H
#define RT_DSL_PARSE_EXPRESSION_H

#include "dsl/parser.h"

/*
 * Both append postfix operations to the parser's and describe them in *out; they return 0 after a
 * syntax error, with parser->depth telling how many parentheses are still open. An error that does
 * not stop the parsing, such as an unknown constant, leaves *out broken.
 */

/* A whole expression, as after `let NAME =`. */
int rt_parse_expression(rt_parser *parser, rt_expression *out);

/*
 * One value of a field or vector: a number, a constant, a vector or arithmetic in parentheses,
 * perhaps negated.
 */
int rt_parse_value(rt_parser *parser, rt_expression *out);

#endif
