/* parse_block.h - blocks, and the entries inside. */
#ifndef RT_DSL_PARSE_BLOCK_H
#define RT_DSL_PARSE_BLOCK_H

#include "dsl/parser.h"
#include "dsl/statement.h"

/* Parses a block whose first word comes next. Returns 0 when nothing of it could be understood. */
int rt_parse_block(rt_parser *parser, rt_statement *statement);

#endif
