/* parse_entry.h - the value of a field. */
#ifndef RT_DSL_PARSE_ENTRY_H
#define RT_DSL_PARSE_ENTRY_H

#include "dsl/parser.h"
#include "dsl/statement.h"

/* Parses what follows the name of a field, which was just taken. */
void rt_parse_entry(rt_parser *parser, const rt_block *block, rt_entry *entry);

#endif
