/* source.h - scene texts in memory, and places in them. */
#ifndef RT_DSL_SOURCE_H
#define RT_DSL_SOURCE_H

#include <stddef.h>
#include <stdint.h>

#include "dsl/budget.h"

#define RT_SOURCE_BYTES_MAX ((size_t)1 << 30) /* of all texts of a scene together, 1 GiB */
#define RT_SOURCE_COUNT_MAX 10000             /* texts of a scene */
#define RT_SOURCE_DEPTH_MAX 32                /* includes inside includes */

/* One text: a file, or a string that the caller gave. It lives until the scene has been read. */
typedef struct rt_source {
    char *path; /* as messages show it */
    char *text; /* size bytes, then a NUL */
    size_t size;
    size_t before; /* bytes of all texts before it */
    /* what it names is relative to path; else to the current directory */
    int is_file;
    int depth;                        /* includes around it */
    uint64_t device, inode;           /* identity of the file, to notice cycles */
    const struct rt_source *includer; /* NULL for the first text */
    struct rt_source *next;           /* all texts of the scene, latest first */
} rt_source;

/* All texts of a scene. All zero is none. */
typedef struct rt_sources {
    rt_source *latest;
    size_t count, bytes;
    rt_budget *budget; /* that they count in; NULL: none */
} rt_sources;

/* A part of a text that a message can point at. Line 0: the text as a whole. */
typedef struct rt_place {
    const rt_source *source;
    uint64_t order; /* counts tokens in the order of reading, over all texts */
    size_t offset;  /* of its first byte */
    int line, column, length;
} rt_place;

/* A word of a source text; not NUL-terminated. */
typedef struct rt_text {
    const char *at;
    size_t length;
} rt_text;

/* Adds an empty text of this name; NULL when memory is exhausted. Owned by *sources. */
rt_source *rt_sources_add(rt_sources *sources, const char *path, const rt_source *includer);

/* Fills a source with a copy of text. On failure *cause says why, as a part of a sentence. */
rt_status rt_source_copy(rt_sources *sources, rt_source *source, const char *text,
                         const char **cause);

/* The text, among those that include this one, that is the same file; NULL if there is none. */
const rt_source *rt_source_around(const rt_source *source);

/*
 * Fills a source from the file of its path. Fails with RT_ERROR_INPUT or RT_ERROR_MEMORY;
 * cause (of cause_size bytes) then says why, as a part of a sentence.
 */
rt_status rt_source_read(rt_sources *sources, rt_source *source, char *cause, size_t cause_size);

/*
 * The path of a file that `source` names, by the rules of relative paths; NULL without memory. To
 * be freed.
 */
char *rt_source_resolve(const rt_source *source, rt_text name);

void rt_sources_free(rt_sources *sources);

/* The text that a place covers. */
static inline rt_text rt_place_text(const rt_place *place)
{
    rt_text text = {place->source->text + place->offset, (size_t)place->length};
    return text;
}

/*
 * The place from the start of `first` to the end of `last`, or `first` alone when they are on
 * different lines.
 */
rt_place rt_place_join(rt_place first, rt_place last);

static inline int rt_text_equal(rt_text text, const char *word)
{
    size_t i = 0;
    while (i < text.length && word[i] == text.at[i] && word[i])
        i++;
    return i == text.length && word[i] == '\0';
}

/* A copy that ends with a NUL, to be freed; NULL without memory. */
char *rt_text_copy(rt_text text);

/* Room for any text that a message quotes. */
#define RT_QUOTE_SIZE 64

/*
 * Writes text as a message may show it: one line, bounded, without control characters. Returns out.
 */
const char *rt_text_quote(char out[RT_QUOTE_SIZE], rt_text text);

#endif
