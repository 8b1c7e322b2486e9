/* whole_file.c - a file, or stdin, read into memory at once. */
#include "whole_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { CHUNK = 1 << 16 };

/* All that a stream has; NULL with the cause. */
static char *read_stream(FILE *file, size_t limit, size_t *size, char *cause, size_t cause_size)
{
    char *bytes = NULL;
    size_t used = 0, capacity = 0, got = 0;
    do {
        if (used + CHUNK + 1 > capacity) {
            capacity = 2 * capacity + CHUNK + 1;
            char *grown = used <= limit ? realloc(bytes, capacity) : NULL;
            if (!grown) {
                snprintf(cause, cause_size, used <= limit ? "out of memory" : "it is too large");
                free(bytes);
                return NULL;
            }
            bytes = grown;
        }
        got = fread(bytes + used, 1, CHUNK, file);
        used += got;
    } while (got > 0);
    if (ferror(file) || used > limit) {
        snprintf(cause, cause_size, "%s", used > limit ? "it is too large" : strerror(errno));
        free(bytes);
        return NULL;
    }
    bytes[used] = '\0';
    *size = used;
    return bytes;
}

char *whole_file_read(const char *path, size_t limit, size_t *size, char *cause, size_t cause_size)
{
    struct stat about;
    if (strcmp(path, "-") == 0)
        return read_stream(stdin, limit, size, cause, cause_size);
    if (stat(path, &about) != 0) {
        snprintf(cause, cause_size, "%s", strerror(errno));
        return NULL;
    }
    if (!S_ISREG(about.st_mode)) {
        snprintf(cause, cause_size, "it is no regular file");
        return NULL;
    }
    FILE *file = fopen(path, "rb");
    if (!file) {
        snprintf(cause, cause_size, "%s", strerror(errno));
        return NULL;
    }
    char *bytes = read_stream(file, limit, size, cause, cause_size);
    fclose(file);
    return bytes;
}
