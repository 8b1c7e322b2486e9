/* source.c - reads texts, and compares and quotes parts of them. */
#include "dsl/source.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define READ_CHUNK ((size_t)64 << 10)

static const char what[] = "the text of the scene";

char *rt_text_copy(rt_text text)
{
    char *copy = malloc(text.length + 1);
    if (copy) {
        memcpy(copy, text.at, text.length);
        copy[text.length] = '\0';
    }
    return copy;
}

rt_source *rt_sources_add(rt_sources *sources, const char *path, const rt_source *includer)
{
    rt_source *source = calloc(1, sizeof *source);
    if (!source)
        return NULL;
    source->path = rt_text_copy((rt_text){path, strlen(path)});
    source->text = rt_text_copy((rt_text){"", 0});
    if (!source->path || !source->text) {
        free(source->path);
        free(source->text);
        free(source);
        return NULL;
    }
    source->includer = includer;
    source->depth = includer ? includer->depth + 1 : 0;
    source->next = sources->latest;
    sources->latest = source;
    sources->count++;
    return source;
}

rt_status rt_source_copy(rt_sources *sources, rt_source *source, const char *text,
                         const char **cause)
{
    size_t size = strlen(text);
    if (size > RT_SOURCE_BYTES_MAX) {
        *cause = "it is larger than 1 GiB";
        return RT_ERROR_INPUT;
    }
    char *copy =
        rt_budget_take(sources->budget, size, what) ? rt_text_copy((rt_text){text, size}) : NULL;
    if (!copy) {
        *cause = "memory is exhausted";
        return RT_ERROR_MEMORY;
    }
    free(source->text);
    source->text = copy;
    source->size = size;
    source->before = sources->bytes;
    sources->bytes += size;
    return RT_OK;
}

static rt_status fail(char *cause, size_t cause_size, rt_status status, const char *why)
{
    snprintf(cause, cause_size, "%s", why);
    return status;
}

static rt_status fail_errno(char *cause, size_t cause_size, int code)
{
    if (strerror_r(code, cause, cause_size) != 0)
        snprintf(cause, cause_size, "error %d", code);
    return RT_ERROR_INPUT;
}

/*
 * Reads to the end of the file, or to what shows that it is no text; at most `limit` bytes, growing
 * the text as it comes beyond the `expected` ones.
 */
static rt_status read_all(rt_source *source, FILE *file, size_t expected, size_t limit,
                          rt_budget *budget, char *cause, size_t cause_size)
{
    size_t capacity = 0;
    for (;;) {
        if (capacity - source->size < READ_CHUNK + 1) {
            const size_t before = capacity;
            capacity = capacity ? 2 * capacity : expected + 2 * READ_CHUNK;
            char *grown = rt_budget_take(budget, capacity - before, what)
                              ? realloc(source->text, capacity)
                              : NULL;
            if (!grown)
                return fail(cause, cause_size, RT_ERROR_MEMORY, "memory is exhausted");
            source->text = grown;
        }
        size_t count = fread(source->text + source->size, 1, READ_CHUNK, file);
        int code = errno;
        source->size += count;
        source->text[source->size] = '\0';
        if (source->size > limit)
            return fail(cause, cause_size, RT_ERROR_INPUT,
                        "the scene's files are larger than 1 GiB together");
        if (ferror(file))
            return fail_errno(cause, cause_size, code);
        if (count == 0 || memchr(source->text + source->size - count, '\0', count))
            return RT_OK;
    }
}

const rt_source *rt_source_around(const rt_source *source)
{
    for (const rt_source *s = source->includer; s && source->is_file; s = s->includer)
        if (s->is_file && s->device == source->device && s->inode == source->inode)
            return s;
    return NULL;
}

rt_status rt_source_read(rt_sources *sources, rt_source *source, char *cause, size_t cause_size)
{
    /* Bound what a few short files can make of each other. */
    if (source->depth > RT_SOURCE_DEPTH_MAX)
        return fail(cause, cause_size, RT_ERROR_INPUT, "includes are nested deeper than 32");
    if (sources->count > RT_SOURCE_COUNT_MAX)
        return fail(cause, cause_size, RT_ERROR_INPUT, "the scene includes more than 10000 files");

    /*
     * A pipe that none writes to would not even open, and the name of one in a scene is hardly
     * meant.
     */
    struct stat info;
    if (source->includer && stat(source->path, &info) == 0 && !S_ISREG(info.st_mode) &&
        !S_ISDIR(info.st_mode))
        return fail(cause, cause_size, RT_ERROR_INPUT, "it is not a regular file");
    FILE *file = fopen(source->path, "rb");
    if (!file)
        return fail_errno(cause, cause_size, errno);

    rt_status status;
    if (fstat(fileno(file), &info) != 0) {
        status = fail_errno(cause, cause_size, errno);
        goto out;
    }
    if (S_ISDIR(info.st_mode)) {
        status = fail(cause, cause_size, RT_ERROR_INPUT, "it is a directory");
        goto out;
    }
    source->is_file = 1;
    source->device = (uint64_t)info.st_dev;
    source->inode = (uint64_t)info.st_ino;
    if (rt_source_around(source)) {
        status = fail(cause, cause_size, RT_ERROR_INPUT, "it would include itself");
        goto out;
    }
    size_t limit = RT_SOURCE_BYTES_MAX - sources->bytes,
           expected = S_ISREG(info.st_mode) ? (size_t)info.st_size : 0;
    status = read_all(source, file, expected < limit ? expected : limit, limit, sources->budget,
                      cause, cause_size);
    source->before = sources->bytes;
    if (status == RT_OK)
        sources->bytes += source->size;
out:
    fclose(file);
    return status;
}

char *rt_source_resolve(const rt_source *source, rt_text name)
{
    const char *slash = source->is_file ? strrchr(source->path, '/') : NULL;
    size_t directory =
        slash && name.length && name.at[0] != '/' ? (size_t)(slash - source->path) + 1 : 0;
    char *path = malloc(directory + name.length + 1);
    if (!path)
        return NULL;
    memcpy(path, source->path, directory);
    memcpy(path + directory, name.at, name.length);
    path[directory + name.length] = '\0';
    return path;
}

void rt_sources_free(rt_sources *sources)
{
    while (sources->latest) {
        rt_source *source = sources->latest;
        sources->latest = source->next;
        free(source->path);
        free(source->text);
        free(source);
    }
    memset(sources, 0, sizeof *sources);
}

rt_place rt_place_join(rt_place first, rt_place last)
{
    if (first.line == last.line)
        first.length = last.column + last.length - first.column;
    return first;
}

const char *rt_text_quote(char out[RT_QUOTE_SIZE], rt_text text)
{
    const size_t limit = RT_QUOTE_SIZE - 4; /* room for the dots and the NUL */
    size_t count = text.length <= limit ? text.length : limit;
    if (count < text.length) /* do not cut inside a UTF-8 sequence */
        while (count > 0 && ((unsigned char)text.at[count] & 0xc0) == 0x80)
            count--;
    for (size_t i = 0; i < count; i++) {
        unsigned char c = (unsigned char)text.at[i];
        out[i] = c < 0x20 || c == 0x7f ? '?' : (char)c;
    }
    strcpy(out + count, count < text.length ? "..." : "");
    return out;
}
