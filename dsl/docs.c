/* docs.c - `make docs`: writes the reference page's generated regions and the editors' grammar. */
#include <stdio.h>
#include <stdlib.h>

#include "dsl/reference.h"
#include "dsl/textmate.h"

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

/* Writes the grammar of editors anew; returns whether it could. */
static int write_grammar(const char *path)
{
    char *text = rt_textmate_grammar();
    int is_written = text && write_file(path, text);
    free(text);
    return is_written;
}

int main(int argc, char **argv)
{
    const char *error = "usage: docs PAGE.md GRAMMAR.json";
    char *page = argc == 3 ? read_file(argv[1]) : NULL, *text = NULL;
    if (argc == 3)
        error = "cannot read the page";
    if (page)
        text = rt_reference_update(page, &error);
    if (text && !write_file(argv[1], text))
        error = "cannot write the page";
    if (!error && !write_grammar(argv[2]))
        error = "cannot write the grammar";
    if (error)
        fprintf(stderr, "docs: %s\n", error);
    free(text);
    free(page);
    return error != NULL;
}
