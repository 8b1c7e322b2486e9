/*
 * make_inputs.c - writes what a fuzzer starts from.
 *
 *   make_inputs list            the targets, a line each: name, greatest input, source files
 *   make_inputs seeds NAME DIR  the seeds of a target as files, and the findings kept in the tree
 *   make_inputs words NAME      its dictionary in libFuzzer's format, on stdout
 */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "fuzz/findings.h"
#include "fuzz/targets.h"

static int list(void)
{
    for (const fuzz_target *const *target = fuzz_targets; *target; target++)
        printf("%s %zu %s\n", (*target)->name, (*target)->size_max, (*target)->sources);
    return 0;
}

static void write_all(const fuzz_inputs *inputs, const char *folder, const char *kind)
{
    char path[4096];
    for (size_t i = 0; i < inputs->count; i++) {
        snprintf(path, sizeof path, "%s/%s-%zu", folder, kind, i);
        fuzz_write(path, inputs->items[i].data, inputs->items[i].size);
    }
}

static int write_seeds(const fuzz_target *target, const char *folder)
{
    fuzz_inputs seeds = {0}, findings = {0};
    target->seed(&seeds);
    fuzz_findings_read(&findings, target->name);
    write_all(&seeds, folder, "seed");
    write_all(&findings, folder, "finding");
    fuzz_inputs_free(&findings);
    fuzz_inputs_free(&seeds);
    return 0;
}

static int print_words(const fuzz_target *target)
{
    fuzz_inputs words = {0};
    if (target->words)
        target->words(&words);
    for (size_t i = 0; i < words.count; i++) {
        putchar('"');
        for (size_t j = 0; j < words.items[i].size; j++) {
            int c = words.items[i].data[j];
            printf(isprint(c) && c != '"' && c != '\\' ? "%c" : "\\x%02x", c);
        }
        puts("\"");
    }
    fuzz_inputs_free(&words);
    return 0;
}

int main(int argc, char **argv)
{
    const fuzz_target *target = argc > 2 ? fuzz_find(argv[2]) : NULL;
    if (argc == 2 && strcmp(argv[1], "list") == 0)
        return list();
    if (argc == 4 && target && strcmp(argv[1], "seeds") == 0)
        return write_seeds(target, argv[3]);
    if (argc == 3 && target && strcmp(argv[1], "words") == 0)
        return print_words(target);
    fprintf(stderr, "usage: make_inputs list | seeds NAME DIR | words NAME\n");
    return 2;
}
