/* docs.c - `make docs`: writes the generated regions of a reference page anew, in place. */
#include <stdio.h>
#include <stdlib.h>

#include "dsl/reference.h"

/* The whole of a file, to be freed; NULL where it cannot be read. */
static char *read_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    char *text = NULL;
    long size = -1;
    if (file && fseek(file, 0, SEEK_END) == 0)
        size = ftell(file);
    if (size >= 0 && fseek(file, 0, SEEK_SET) == 0)
        text = calloc((size_t)size + 1, 1);
    if (text && fread(text, 1, (size_t)size, file) != (size_t)size) {
        free(text);
        text = NULL;
    }
    if (file)
        fclose(file);
    return text;
}

static int write_file(const char *path, const char *text)
{
    FILE *file = fopen(path, "wb");
    int is_written = file && fputs(text, file) >= 0;
    return file && fclose(file) == 0 && is_written;
}

int main(int argc, char **argv)
{
    const char *error = "usage: docs PAGE.md";
    char *page = argc == 2 ? read_file(argv[1]) : NULL, *text = NULL;
    if (argc == 2)
        error = "cannot read the page";
    if (page)
        text = rt_reference_update(page, &error);
    if (text && !write_file(argv[1], text))
        error = "cannot write the page";
    if (error)
        fprintf(stderr, "docs: %s\n", error);
    free(text);
    free(page);
    return error != NULL;
}
