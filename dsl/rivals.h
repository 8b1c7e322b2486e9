/* rivals.h - fields that set what other fields of their block say. */
#ifndef RT_DSL_RIVALS_H
#define RT_DSL_RIVALS_H

#include "dsl/report.h"
#include "dsl/statement.h"

/* Whether no two entries of a block say the same thing; reports those that do. */
int rt_rivals_check(const rt_statement *statement, rt_reports *reports);

/* Whether another field of a block, which is given, sets this one. */
int rt_rivals_set(const rt_block *block, const rt_field *field, const rt_block_fields *fields);

#endif
