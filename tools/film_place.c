/* film_place.c - from where the names in a film are meant. */
#define _XOPEN_SOURCE 700 /* getcwd, chdir */

#include "film_place.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "message.h"
#include "status.h"

/* Options that take a path. */
static const option_id with_path[] = {OPTION_RESUME, OPTION_CHECKPOINT, OPTION_PHOTON_MAP};
enum { WITH_PATH = sizeof with_path / sizeof *with_path };

/* Puts FOLDER/PATH into *at, which it moves on, in place of a relative path. */
static void make_absolute(const char **path, char **at, const char *folder)
{
    if (**path == '/')
        return;
    const int length = sprintf(*at, "%s/%s", folder, *path);
    *path = *at;
    *at += length + 1;
}

/* Makes the paths of the command line absolute, which are meant from `folder`. */
static int keep_paths(command_line *arguments, const char *folder)
{
    const size_t each = strlen(folder) + 2;
    size_t size = 1;
    for (size_t i = 0; i < arguments->output_count; i++)
        size += each + strlen(arguments->outputs[i]);
    for (size_t i = 0; i < WITH_PATH; i++)
        if (arguments->options[with_path[i]].given)
            size += each + strlen(arguments->options[with_path[i]].text);
    char *at = arguments->paths = malloc(size);
    if (!at) {
        message_error("out of memory");
        return STATUS_DEVICE;
    }
    for (size_t i = 0; i < arguments->output_count; i++)
        make_absolute(arguments->outputs + i, &at, folder);
    for (size_t i = 0; i < WITH_PATH; i++)
        if (arguments->options[with_path[i]].given)
            make_absolute(&arguments->options[with_path[i]].text, &at, folder);
    return STATUS_DONE;
}

/* The folder that a note names; whether there is one, and it fits. */
static int find_folder(char out[PATH_MAX], const char *note)
{
    static const char word[] = "folder ";
    for (const char *line = note, *end; (end = strchr(line, '\n')); line = end + 1)
        if (strncmp(line, word, sizeof word - 1) == 0) {
            line += sizeof word - 1;
            if (end - line >= PATH_MAX)
                return 0;
            memcpy(out, line, (size_t)(end - line));
            out[end - line] = '\0';
            return 1;
        }
    return 0;
}

int film_place_enter(command_line *arguments, const char *note)
{
    char here[PATH_MAX], there[PATH_MAX];
    if (arguments->operand_count > 0 || arguments->options[OPTION_UNTRUSTED].given ||
        !find_folder(there, note) || !getcwd(here, sizeof here) || strcmp(here, there) == 0 ||
        chdir(there) != 0)
        return STATUS_DONE;
    return keep_paths(arguments, here);
}

int film_place_may_name(const char *path)
{
    if (*path == '/' || strcmp(path, "-") == 0)
        return 0;
    for (const char *part = path; part; part = strchr(part, '/')) {
        part += *part == '/';
        if (strncmp(part, "..", 2) == 0 && (part[2] == '/' || part[2] == '\0'))
            return 0;
    }
    return rt_path_is_within(".", path);
}
