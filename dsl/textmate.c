/*
 * textmate.c - the TextMate grammar, which Visual Studio Code, Sublime Text, TextMate and others
 * read. It knows words, not places: a word that is a block, a field and a value of one gets the
 * colour of the first of these.
 */
#include "dsl/textmate.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/function.h"
#include "dsl/schema.h"

enum { GRAMMAR_SIZE = 1 << 16, WORDS_MAX = 1024 };

/* Words of one colour, each once. */
typedef struct word_list {
    const char *words[WORDS_MAX];
    size_t count;
} word_list;

static void add_word(word_list *list, const char *word)
{
    for (size_t i = 0; i < list->count; i++)
        if (strcmp(list->words[i], word) == 0)
            return;
    if (word[0] && list->count < WORDS_MAX)
        list->words[list->count++] = word;
}

static int by_name(const void *a, const void *b)
{
    const char *const *s = a, *const *t = b;
    return strcmp(*s, *t);
}

static void put(char *out, const char *format, ...)
{
    size_t used = strlen(out);
    va_list list;
    va_start(list, format);
    vsnprintf(out + used, GRAMMAR_SIZE - used, format, list);
    va_end(list);
}

/* A rule that colours these words. A word ends where no letter, digit, `_` or `-` goes on. */
static void put_rule(char *out, const char *name, word_list *list, const char *behind)
{
    qsort(list->words, list->count, sizeof *list->words, by_name);
    put(out, "    {\n      \"name\": \"%s\",\n      \"match\": \"(?<![\\\\w-])(?:", name);
    for (size_t i = 0; i < list->count; i++)
        put(out, "%s%s", i ? "|" : "", list->words[i]);
    put(out, ")%s\"\n    },\n", behind);
}

static void add_fields(const rt_block *block, word_list *fields, word_list *values)
{
    const rt_field *field;
    for (size_t i = 0; (field = rt_block_field(block, i)) != NULL; i++) {
        add_word(fields, field->name);
        const rt_word *word = rt_field_words(field);
        for (; word && word->name; word++)
            add_word(values, word->name);
    }
}

static void put_words(char *out)
{
    word_list statements, blocks, fields, values, functions;
    const rt_block *block;
    statements.count = blocks.count = fields.count = values.count = functions.count = 0;
    add_word(&statements, "let");
    add_word(&statements, "include");
    add_word(&statements, "repeat");
    add_word(&statements, "from");
    add_word(&statements, "to");
    for (size_t i = 0; (block = rt_block_at(i)) != NULL; i++) {
        add_word(&blocks, block->word);
        add_fields(block, &fields, &values);
        if (block->kind)
            add_word(&values, block->kind);
    }
    for (int i = 0; i < RT_FUNCTION_COUNT; i++)
        add_word(&functions, rt_functions[i].name);
    put_rule(out, "keyword.control.rts", &statements, "(?![\\\\w-])");
    put_rule(out, "support.function.rts", &functions, "(?=\\\\()");
    put_rule(out, "entity.name.type.rts", &blocks, "(?=[^#\\\"{}]*\\\\{)");
    put_rule(out, "variable.parameter.rts", &fields, "(?![\\\\w-])");
    put_rule(out, "constant.language.rts", &values, "(?![\\\\w-])");
}

char *rt_textmate_grammar(void)
{
    char *out = calloc(GRAMMAR_SIZE, 1);
    if (!out)
        return NULL;
    put(out, "{\n"
             "  \"comment\": \"made by `make docs` from the tables of the language\",\n"
             "  \"name\": \"librt scene\",\n"
             "  \"scopeName\": \"source.rts\",\n"
             "  \"fileTypes\": [\"rts\"],\n"
             "  \"patterns\": [\n"
             "    {\n      \"name\": \"comment.line.number-sign.rts\",\n"
             "      \"match\": \"#.*$\"\n    },\n"
             "    {\n      \"name\": \"string.quoted.double.rts\",\n"
             "      \"match\": \"\\\"[^\\\"]*\\\"?\"\n    },\n");
    put_words(out);
    put(out, "    {\n      \"name\": \"constant.numeric.rts\",\n"
             "      \"match\": \"(?<![\\\\w.])(?:\\\\d+\\\\.?\\\\d*|\\\\.\\\\d+)"
             "(?:[eE][+-]?\\\\d+)?(?![\\\\w.])\"\n    },\n"
             "    {\n      \"name\": \"keyword.operator.rts\",\n"
             "      \"match\": \"[-+*/=]\"\n    }\n"
             "  ]\n}\n");
    return out;
}
