/* names.h - names with their numbers, in the order in which they came: a hash table. */
#ifndef RTC_IMPORT_NAMES_H
#define RTC_IMPORT_NAMES_H

#include <stddef.h>
#include <stdint.h>

/* All zero is empty. */
typedef struct name_table {
    char **names;
    size_t count, capacity;
    uint32_t *slots; /* a number plus 1, or 0; open addressing */
    size_t slot_count;
} name_table;

/* The number of a name, or -1. */
int name_table_find(const name_table *table, const char *name);

/* Adds a name that is not there. Returns its number, or -1 without memory. */
int name_table_add(name_table *table, const char *name);

void name_table_free(name_table *table);

#endif
