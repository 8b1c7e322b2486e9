/*
 * complete.c - build tool: prints the script by which a shell completes the command line of rtc.
 *
 *     complete bash|zsh|fish
 */
#include <stdio.h>
#include <string.h>

#include "lines.h"

int main(int argc, char **argv)
{
    static const struct {
        const char *name;
        void (*print)(void);
    } shells[] = {{"bash", line_print_bash}, {"zsh", line_print_zsh}, {"fish", line_print_fish}};
    for (size_t i = 0; i < sizeof shells / sizeof *shells && argc == 2; i++)
        if (strcmp(argv[1], shells[i].name) == 0) {
            shells[i].print();
            return fflush(stdout) || ferror(stdout);
        }
    fprintf(stderr, "usage: complete bash|zsh|fish\n");
    return 2;
}
