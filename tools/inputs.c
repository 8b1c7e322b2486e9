/* inputs.c - files that a command reads, which it must not overwrite. */
#include "inputs.h"

#include <stdlib.h>
#include <sys/stat.h>

#include "message.h"
#include "status.h"
#include "watch.h"

void inputs_add(input_list *inputs, const char *path)
{
    struct stat info;
    if (inputs->watch)
        watch_add(inputs->watch, path);
    if (stat(path, &info) != 0 || !S_ISREG(info.st_mode))
        return;
    if (inputs->count == inputs->capacity) {
        size_t capacity = inputs->capacity ? 2 * inputs->capacity : 16;
        input_file *files = realloc(inputs->files, capacity * sizeof *files);
        if (!files) {
            inputs->out_of_memory = 1;
            return;
        }
        inputs->files = files;
        inputs->capacity = capacity;
    }
    inputs->files[inputs->count++] = (input_file){info.st_dev, info.st_ino};
}

int inputs_check(const input_list *inputs, const char *output)
{
    struct stat info;
    if (inputs->out_of_memory) {
        message_error("out of memory");
        return STATUS_DEVICE;
    }
    if (stat(output, &info) != 0)
        return STATUS_DONE;
    for (size_t i = 0; i < inputs->count; i++)
        if (inputs->files[i].device == info.st_dev && inputs->files[i].inode == info.st_ino) {
            message_error("--out %s: this command reads that file", output);
            return STATUS_USAGE;
        }
    return STATUS_DONE;
}

int inputs_are_same(const char *a, const char *b)
{
    struct stat x, y;
    return stat(a, &x) == 0 && stat(b, &y) == 0 && S_ISREG(x.st_mode) && x.st_dev == y.st_dev &&
           x.st_ino == y.st_ino;
}

void inputs_free(input_list *inputs)
{
    free(inputs->files);
}
