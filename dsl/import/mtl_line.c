/* mtl_line.c - lines of OBJ and MTL files: their words, names and files. */
#define _XOPEN_SOURCE 700 /* strncasecmp */
#include "dsl/import/mtl_line.h"

#include <string.h>
#include <strings.h>

enum { PATH_LENGTH_MAX = 4096 };

static const char blanks[] = " \t\r";

/* LF, after CR or not, or CR alone. */
static int is_line_end(const char *at)
{
    return *at == '\n' || (*at == '\r' && at[1] != '\n');
}

char *rt_mtl_next_line(char **text, int *line)
{
    char *start = *text;
    if (!*start)
        return NULL;
    ++*line;
    char *at = start;
    for (; *at && !is_line_end(at); at++)
        if (*at == '\\' && (at[1] == '\n' || at[1] == '\r')) {
            *at++ = ' ';
            if (*at == '\r' && at[1] == '\n')
                *at++ = ' ';
            *at = ' ';
            ++*line;
        }
    *text = *at ? at + 1 : at;
    *at = '\0';
    return start;
}

char *rt_mtl_next_word(char **line)
{
    char *start = *line + strspn(*line, blanks);
    if (!*start || *start == '#')
        return NULL;
    char *end = start + strcspn(start, blanks);
    *line = *end ? end + 1 : end;
    *end = '\0';
    return start;
}

char *rt_mtl_rest(char *line)
{
    char *const rest = line + strspn(line, blanks);
    size_t length = strlen(rest);
    while (length > 0 && strchr(blanks, rest[length - 1]))
        rest[--length] = '\0';
    return rest;
}

int rt_mtl_cut_comment(char *rest)
{
    char *at = strchr(rest, '#');
    while (at && at > rest && !strchr(blanks, at[-1]))
        at = strchr(at + 1, '#');
    if (!at)
        return 0;
    *at = '\0';
    rt_mtl_rest(rest);
    return 1;
}

/* A name in quotation marks without them; of what is none, itself. */
static char *unquote(char *name)
{
    const size_t length = strlen(name);
    if (length < 2 || name[0] != '"' || name[length - 1] != '"')
        return name;
    name[length - 1] = '\0';
    return name + 1;
}

char *rt_mtl_file(const importer *import, char *line)
{
    char *const rest = rt_mtl_rest(line);
    for (char *at = rest; *at; at++)
        *at = *at == '\\' ? '/' : *at;
    if (rt_import_has_file(import, rest))
        return rest;
    rt_mtl_cut_comment(rest);
    return unquote(rest);
}

/*
 * Where the name ends that begins here and has the extension of libraries; else the end, or further
 * away than a path is long.
 */
static char *extension_end(char *name)
{
    static const char extension[] = ".mtl";
    char *at = name;
    for (; *at && at - name <= PATH_LENGTH_MAX; at++)
        if (strncasecmp(at, extension, sizeof extension - 1) == 0 &&
            strchr(blanks, at[sizeof extension - 1]))
            return at + sizeof extension - 1;
    return at;
}

/* Whether the text from here up to `end` names a file. */
static int is_file(const importer *import, const char *name, char *end)
{
    const char kept = *end;
    *end = '\0';
    const int is_there = rt_import_has_file(import, name);
    *end = kept;
    return is_there;
}

char *rt_mtl_next_library(const importer *import, char **rest)
{
    char *const name = *rest + strspn(*rest, blanks);
    if (!*name)
        return NULL;
    char *word = name + strcspn(name, blanks), *end = extension_end(name);
    const int is_word = end - name > PATH_LENGTH_MAX ||
                        (end != word && !is_file(import, name, end) && is_file(import, name, word));
    end = is_word ? word : end;
    *rest = *end ? end + 1 : end;
    *end = '\0';
    return name;
}
