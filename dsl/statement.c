/* statement.c - looks up the entries of a block. */
#include "dsl/statement.h"

#include <stddef.h>

const rt_entry *rt_statement_entry(const rt_statement *statement, const rt_field *field)
{
    for (int i = 0; i < statement->entry_count; i++)
        if (statement->entries[i].field == field)
            return &statement->entries[i];
    return NULL;
}
