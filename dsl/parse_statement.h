/* parse_statement.h - from tokens to statements, one at a time. */
#ifndef RT_DSL_PARSE_STATEMENT_H
#define RT_DSL_PARSE_STATEMENT_H

#include "dsl/parser.h"
#include "dsl/statement.h"

/*
 * Parses the next statement that can be understood, errors included; returns 0 at the end of the
 * text. Nothing past the statement's last token is read, but for the one that ends a `let`.
 */
int rt_parse_statement(rt_parser *parser, rt_statement *statement);

#endif
