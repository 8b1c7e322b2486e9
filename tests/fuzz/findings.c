/* findings.c - reads what is kept in tests/fuzz/findings. */
#include "fuzz/findings.h"

#include <ctype.h>
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"

static int digit(int c)
{
    return isdigit(c) ? c - '0' : 10 + tolower(c) - 'a';
}

/* Turns pairs of digits into bytes, in place. */
static void decode(rt_bytes *bytes)
{
    size_t digits = 0;
    for (size_t i = 0; i < bytes->size; i++) {
        int c = bytes->data[i];
        while (c == '#' && i < bytes->size && bytes->data[i] != '\n')
            i++;
        if (!isxdigit(c))
            continue;
        uint8_t *byte = bytes->data + digits / 2;
        *byte = (uint8_t)(digits % 2 ? *byte << 4 | digit(c) : digit(c));
        digits++;
    }
    bytes->size = digits / 2;
}

static int is_finding(const struct dirent *entry)
{
    return entry->d_name[0] != '.';
}

void fuzz_findings_read(fuzz_inputs *out, const char *target)
{
    struct dirent **entries = NULL;
    char folder[256], path[1024];
    snprintf(folder, sizeof folder, "tests/fuzz/findings/%s", target);
    int count = scandir(folder, &entries, is_finding, alphasort);
    for (int i = 0; i < count; i++) {
        const char *ending = strrchr(entries[i]->d_name, '.');
        rt_bytes bytes = {0};
        snprintf(path, sizeof path, "%s/%s", folder, entries[i]->d_name);
        FUZZ_EXPECT(rt_file_read(&bytes, path, 1 << 20, NULL) == RT_OK);
        if (ending && strcmp(ending, ".hex") == 0)
            decode(&bytes);
        fuzz_add(out, bytes.data, bytes.size);
        rt_bytes_free(&bytes);
        free(entries[i]);
    }
    free(entries);
}
