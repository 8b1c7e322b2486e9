/*
 * embed.c - build tool: turns OpenCL sources into one C file of byte arrays.
 *
 *     embed OUT.c SYMBOL [-I DIR]... KERNEL.cl...
 *
 * Each #include "name" is replaced by the file, looked up beside the including file and then in the
 * -I folders: a *.inc.h each time, any other (all have include guards) only the first time it is
 * met within one kernel. #line directives keep the driver's messages true to the files. What lies
 * between two #include lines of a file is a piece, which all kernels that have it share. Bytes
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

enum {
    max_included = 256,
    max_dirs = 8,
    max_path = 4096,
    max_line = 8192,
    max_pieces = 8192,
    max_order = 4096, /* pieces of a kernel */
};

static const char *dirs[max_dirs];
static int dir_count;

/* The files that one kernel has met so far. */
typedef struct included {
    char path[max_included][max_path];
    int count;
} included;

/* What a file has from a line on, up to its next #include. */
static struct piece {
    char *path;
    int line;
    size_t length;
} pieces[max_pieces];
static int piece_count;

/* A kernel: its pieces in the order of its text. */
typedef struct source {
    int order[max_order], count;
    size_t length;
} source;

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

/* Opens the array of a piece, which begins with its directive; 0 where it was written before. */
static int begin_piece(FILE *out, const char *path, int line, source *kernel)
{
    char directive[max_path + 32];
    int at = 0;
    while (at < piece_count && (pieces[at].line != line || strcmp(pieces[at].path, path) != 0))
        at++;
    if (at == max_pieces || kernel->count == max_order)
        fail("too many pieces", path);
    kernel->order[kernel->count++] = at;
    if (at < piece_count)
        return 0;
    pieces[at].path = strdup(path);
    if (!pieces[at].path)
        fail("out of memory", path);
    pieces[at].line = line;
    piece_count++;
    fprintf(out, "static const unsigned char piece_%d[] = {\n", at);
    snprintf(directive, sizeof directive, "#line %d \"%s\"\n", line, path);
    put_bytes(out, directive);
    pieces[at].length = strlen(directive);
    return 1;
}

/* Ends the last piece of a kernel. */
static void end_piece(FILE *out, source *kernel, int is_new)
{
    kernel->length += pieces[kernel->order[kernel->count - 1]].length;
    if (is_new)
        fprintf(out, "};\n");
}

/* Whether the kernel takes a file where it is included. */
static int takes(included *seen, const char *path)
{
    for (int i = 0; i < seen->count; i++)
        if (strcmp(seen->path[i], path) == 0)
            return strstr(path, ".inc.h") != NULL;
    if (seen->count == max_included)
        fail("too many included files", path);
    strcpy(seen->path[seen->count++], path);
    return 1;
}

static void embed_file(FILE *out, const char *path, included *seen, source *kernel)
{
    char line[max_line], name[max_path], inner[max_path];
    int number = 0;
    FILE *in = fopen(path, "r");

    if (!in)
        fail("cannot be read", path);
    int is_new = begin_piece(out, path, 1, kernel);
    while (fgets(line, sizeof line, in)) {
        number++;
        if (sscanf(line, " # include \"%4095[^\"]\"", name) != 1) {
            if (is_new) {
                put_bytes(out, line);
                pieces[piece_count - 1].length += strlen(line);
            }
            continue;
        }
        end_piece(out, kernel, is_new);
        find_include(inner, path, name);
        if (takes(seen, inner))
            embed_file(out, inner, seen, kernel);
        is_new = begin_piece(out, path, number + 1, kernel);
    }
    end_piece(out, kernel, is_new);
    fclose(in);
}

/* Writes the kernels' pieces, and how each kernel is put together of them. */
static void embed_kernels(FILE *out, const char *symbol, char **files, int count)
{
    source *kernels = calloc((size_t)count, sizeof *kernels);
    if (!kernels)
        fail("out of memory", symbol);
    fprintf(out, "/* Made by tools/embed.c. */\n#include \"device/kernel_source.h\"\n");
    for (int i = 0; i < count; i++) {
        static included seen;
        seen.count = 0;
        embed_file(out, files[i], &seen, &kernels[i]);
    }
    fprintf(out, "static const rt_kernel_piece pieces[] = {\n");
    for (int i = 0; i < piece_count; i++)
        fprintf(out, "    {piece_%d, sizeof piece_%d},\n", i, i);
    fprintf(out, "};\n");
    for (int i = 0; i < count; i++) {
        fprintf(out, "static const uint16_t order_%d[] = {", i);
        for (int k = 0; k < kernels[i].count; k++)
            fprintf(out, "%d,", kernels[i].order[k]);
        fprintf(out, "};\n");
    }
    fprintf(out, "const rt_kernel_source %s[] = {\n", symbol);
    for (int i = 0; i < count; i++) {
        char name[max_path];
        snprintf(name, sizeof name, "%s", basename(files[i]));
        name[strcspn(name, ".")] = '\0';
        fprintf(out, "    {\"%s\", pieces, order_%d, %d, %lu},\n", name, i, kernels[i].count,
                (unsigned long)kernels[i].length);
    }
    fprintf(out, "    {0, 0, 0, 0, 0}};\n");
    free(kernels);
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
    embed_kernels(out, argv[2], argv + first, argc - first);
    if (fclose(out))
        fail("cannot be written", argv[1]);
    return 0;
}
