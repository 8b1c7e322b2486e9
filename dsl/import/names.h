/* names.h - names with their numbers, in the order in which they came. */
#ifndef RT_DSL_IMPORT_NAMES_H
#define RT_DSL_IMPORT_NAMES_H

#include <stddef.h>

/* All zero is empty. */
typedef struct name_table {
    char **names;
    size_t count, capacity;
    void *tree; /* of names[0] to names[count - 1], as tsearch makes it */
} name_table;

/* The number of a name, or -1; in a time that no choice of names makes longer than log(count). */
int rt_name_table_find(const name_table *table, const char *name);

/* Adds a name that is not there. Returns its number, or -1 without memory. */
int rt_name_table_add(name_table *table, const char *name);

void rt_name_table_free(name_table *table);

#endif
