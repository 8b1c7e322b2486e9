/*
 * inputs.h - the files that a command reads, so that none of them is overwritten by what it makes.
 */
#ifndef RTC_INPUTS_H
#define RTC_INPUTS_H

#include <stddef.h>
#include <sys/types.h>

/* A file, whatever path or link led to it. */
typedef struct input_file {
    dev_t device;
    ino_t inode;
} input_file;

/* All zero is none. */
typedef struct input_list {
    input_file *files;
    size_t count, capacity;
    int out_of_memory;
    struct watch *watch; /* that is told of each, or NULL */
} input_list;

/* Notes a file that is read; what is no regular file, such as a device, may be written as well. */
void inputs_add(input_list *inputs, const char *path);

/* Says so when an output is one of the files that are read. Returns an exit status. */
int inputs_check(const input_list *inputs, const char *output);

/* Whether two paths lead to one regular file. */
int inputs_are_same(const char *a, const char *b);

void inputs_free(input_list *inputs);

#endif
