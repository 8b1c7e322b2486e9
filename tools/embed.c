/*
 * embed.c - build tool: turns OpenCL sources into one C file of byte arrays.
 *
 *     embed OUT.c SYMBOL [-I DIR]... KERNEL.cl...
 *
 * Each #include "name" is replaced by the file, looked up beside the including file and then in the
 * -I folders: a *.inc.h each time, any other (all have include guards) only the first time it is
 * met within one kernel. #line directives keep the driver's messages true to the files. Bytes
 * rather than string literals, because C99 promises only 4095 characters of those. OUT.c defines
 *
 *     const rt_kernel_source SYMBOL[];
 *
 * whose last entry has a NULL name; see device/kernel_source.h.
 */
#include <libgen.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { max_included = 256, max_dirs = 8, max_path = 4096, max_line = 8192 };

static const char *dirs[max_dirs];
static int dir_count;

/* The files that one kernel has met so far. */
typedef struct included {
    char path[max_included][max_path];
    int count;
} included;

static void fail(const char *what, const char *name)
{
    fprintf(stderr, "embed: %s: %s\n", name, what);
    exit(1);
}

static void put_bytes(FILE *out, const char *text)
{
    for (; *text; text++)
        fprintf(out, "%d,", (unsigned char)*text);
    fputc('\n', out);
}

/* Opens dir/name and tells its path; NULL when it cannot be read. */
static FILE *open_in(char path[max_path], const char *dir, const char *name)
{
    int length = snprintf(path, max_path, "%s/%s", dir, name);
    return length < max_path ? fopen(path, "r") : NULL;
}

/* Finds an included file beside the one that names it, else in the search folders. */
static void find_include(char path[max_path], const char *from, const char *name)
{
    char copy[max_path];
    snprintf(copy, sizeof copy, "%s", from);
    FILE *file = open_in(path, dirname(copy), name);
    for (int i = 0; !file && i < dir_count; i++)
        file = open_in(path, dirs[i], name);
    if (!file)
        fail("included file not found", name);
    fclose(file);
}

static void embed_file(FILE *out, const char *path, included *seen)
{
    char line[max_line], directive[max_path + 32], name[max_path], inner[max_path];
    int number = 0;
    FILE *in = fopen(path, "r");

    if (!in)
        fail("cannot be read", path);
    snprintf(directive, sizeof directive, "#line 1 \"%s\"\n", path);
    put_bytes(out, directive);
    while (fgets(line, sizeof line, in)) {
        number++;
        if (sscanf(line, " # include \"%4095[^\"]\"", name) != 1) {
            put_bytes(out, line);
            continue;
        }
        find_include(inner, path, name);
        int known = 0;
        const char *again = strstr(inner, ".inc.h");
        for (int i = 0; i < seen->count; i++)
            known |= strcmp(seen->path[i], inner) == 0;
        if (!known || again) {
            if (seen->count == max_included)
                fail("too many included files", path);
            if (!known)
                strcpy(seen->path[seen->count++], inner);
            embed_file(out, inner, seen);
        }
        snprintf(directive, sizeof directive, "#line %d \"%s\"\n", number + 1, path);
        put_bytes(out, directive);
    }
    fclose(in);
}

/* Writes a file as it is, as an array of bytes and their number. */
static void embed_bytes(const char *path, const char *symbol, const char *from)
{
    char line[max_line];
    FILE *out = fopen(path, "w"), *in = fopen(from, "r");
    if (!in)
        fail("cannot be read", from);
    if (!out)
        fail("cannot be written", path);
    fprintf(out,
            "/* Made by tools/embed.c. */\n#include <stddef.h>\n"
            "extern const unsigned char %s[];\nextern const size_t %s_size;\n"
            "const unsigned char %s[] = {\n",
            symbol, symbol, symbol);
    while (fgets(line, sizeof line, in))
        put_bytes(out, line);
    fprintf(out, "};\nconst size_t %s_size = sizeof %s;\n", symbol, symbol);
    fclose(in);
    if (fclose(out))
        fail("cannot be written", path);
}

int main(int argc, char **argv)
{
    int first = 3;
    if (argc == 5 && strcmp(argv[3], "--bytes") == 0) {
        embed_bytes(argv[1], argv[2], argv[4]);
        return 0;
    }
    if (argc < 4) {
        fprintf(stderr, "usage: embed OUT.c SYMBOL [-I DIR]... KERNEL.cl...\n");
        return 2;
    }
    while (first + 1 < argc && strcmp(argv[first], "-I") == 0 && dir_count < max_dirs) {
        dirs[dir_count++] = argv[first + 1];
        first += 2;
    }
    FILE *out = fopen(argv[1], "w");
    if (!out)
        fail("cannot be written", argv[1]);
    fprintf(out, "/* Made by tools/embed.c. */\n#include \"device/kernel_source.h\"\n");
    for (int i = first; i < argc; i++) {
        static included seen;
        seen.count = 0;
        fprintf(out, "static const unsigned char source_%d[] = {\n", i - first);
        embed_file(out, argv[i], &seen);
        fprintf(out, "};\n");
    }
    fprintf(out, "const rt_kernel_source %s[] = {\n", argv[2]);
    for (int i = first; i < argc; i++) {
        char name[max_path];
        snprintf(name, sizeof name, "%s", basename(argv[i]));
        name[strcspn(name, ".")] = '\0';
        fprintf(out, "    {\"%s\", source_%d, sizeof source_%d},\n", name, i - first, i - first);
    }
    fprintf(out, "    {0, 0, 0}};\n");
    if (fclose(out))
        fail("cannot be written", argv[1]);
    return 0;
}
