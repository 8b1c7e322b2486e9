/* within.c - whether a file lies in a folder. */
#define _XOPEN_SOURCE 700 /* realpath */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "rt.h"

/* The path of a file without links; where there is no such file, that of its folder. */
static char *follow_links(const char *path)
{
    char *found = realpath(path, NULL);
    const char *slash = strrchr(path, '/');
    if (found || errno != ENOENT)
        return found;
    size_t length = slash ? (size_t)(slash - path) : 0;
    char *folder = malloc(length + 3);
    if (!folder)
        return NULL;
    memcpy(folder, path, length);
    memcpy(folder + length, slash ? "/." : ".", slash ? 3 : 2);
    found = realpath(folder, NULL);
    free(folder);
    return found;
}

int rt_path_is_within(const char *root, const char *path)
{
    if (!path)
        return 0;
    if (!root)
        return 1;
    char *folder = realpath(root, NULL), *file = follow_links(path);
    size_t length = folder ? strlen(folder) : 0;
    int is_within = file && folder && strncmp(file, folder, length) == 0 &&
                    (file[length] == '/' || file[length] == '\0' || folder[length - 1] == '/');
    free(file);
    free(folder);
    return is_within;
}
