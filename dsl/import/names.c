/* names.c - names with their numbers, in a balanced tree of the C library. */
#define _XOPEN_SOURCE 700 /* tsearch */
#include "dsl/import/names.h"

#include <limits.h>
#include <search.h>
#include <stdlib.h>
#include <string.h>

typedef struct named {
    int number;
    const char *name;
} named;

static int compare(const void *a, const void *b)
{
    return strcmp(((const named *)a)->name, ((const named *)b)->name);
}

int rt_name_table_find(const name_table *table, const char *name)
{
    const named wanted = {.name = name};
    void *const *found = tfind(&wanted, &table->tree, compare);
    return found ? (*(const named *const *)found)->number : -1;
}

/* Doubles the room. Returns 0 without memory. */
static int grow(name_table *table)
{
    const size_t capacity = table->capacity ? 2 * table->capacity : 32;
    char **names = realloc(table->names, capacity * sizeof *names);
    if (!names)
        return 0;
    table->names = names;
    table->capacity = capacity;
    return 1;
}

int rt_name_table_add(name_table *table, const char *name)
{
    const size_t size = strlen(name) + 1;
    if (table->count == INT_MAX || (table->count == table->capacity && !grow(table)))
        return -1;
    named *made = malloc(sizeof *made + size); /* with its name behind it */
    if (!made)
        return -1;
    char *copy = memcpy(made + 1, name, size);
    *made = (named){(int)table->count, copy};
    if (!tsearch(made, &table->tree, compare)) {
        free(made);
        return -1;
    }
    table->names[table->count] = copy;
    return (int)table->count++;
}

void rt_name_table_free(name_table *table)
{
    while (table->tree) {
        named *const root = *(named **)table->tree;
        tdelete(root, &table->tree, compare);
        free(root);
    }
    free(table->names);
}
