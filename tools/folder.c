/* folder.c - the folder that a file is in. */
#include "folder.h"

#include <stdlib.h>
#include <string.h>

#include "message.h"

char *folder_of(const char *path)
{
    const char *slash = strcmp(path, "-") == 0 ? NULL : strrchr(path, '/');
    size_t length = slash ? (size_t)(slash - path) + 1 : 0;
    char *folder = malloc(length + 2);
    if (!folder) {
        message_error("out of memory");
        return NULL;
    }
    memcpy(folder, path, length);
    strcpy(folder + length, ".");
    return folder;
}
