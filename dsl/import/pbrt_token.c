/* pbrt_token.c - from text to tokens. */
#include <stdlib.h>
#include <string.h>

#include "dsl/import/pbrt.h"

int rt_pbrt_line(const pbrt_tokens *tokens)
{
    return tokens->line;
}

pbrt_place rt_pbrt_here(const pbrt_tokens *tokens)
{
    return (pbrt_place){tokens->import->place.file, tokens->line};
}

int rt_pbrt_at(importer *import, pbrt_place place)
{
    import->place.file = place.file;
    return place.line;
}

/* The import, whose message is of a token that was not taken. */
static importer *of(pbrt_tokens *tokens, const pbrt_token *token)
{
    tokens->import->place.file = token->file;
    return tokens->import;
}

/* Passes over space and comments; returns whether something follows in this file. */
static int skip_space(pbrt_source *source)
{
    while (source->at < source->end) {
        char c = *source->at;
        if (c == '#') {
            while (source->at < source->end && *source->at != '\n')
                source->at++;
        } else if (strchr(" \t\r\n", c) && c) {
            source->line += c == '\n';
            source->at++;
        } else {
            return 1;
        }
    }
    return 0;
}

static void read_string(pbrt_tokens *tokens, pbrt_source *source, pbrt_token *out)
{
    size_t used = 0;
    const char *at = source->at + 1;
    while (at < source->end && *at != '"' && *at != '\n') {
        if (*at == '\\' && at + 1 < source->end && at[1] != '\n')
            at++;
        if (used == PBRT_TEXT - 1) {
            rt_import_fail(of(tokens, out), out->line, "a string of more than %d bytes",
                           PBRT_TEXT - 1);
            return;
        }
        out->text[used++] = *at++;
    }
    if (at == source->end || *at != '"')
        rt_import_fail(of(tokens, out), out->line, "a string is not closed");
    source->at = at < source->end ? at + 1 : at;
    out->kind = PBRT_STRING;
}

static void read_word(pbrt_tokens *tokens, pbrt_source *source, pbrt_token *out)
{
    size_t used = 0;
    while (source->at < source->end && !strchr(" \t\r\n\"[]#", *source->at)) {
        if (used == PBRT_TEXT - 1) {
            rt_import_fail(of(tokens, out), out->line, "a word of more than %d bytes",
                           PBRT_TEXT - 1);
            return;
        }
        out->text[used++] = *source->at++;
    }
    out->kind = PBRT_WORD;
    if (!strchr("+-.0123456789", out->text[0]))
        return;
    const char *end = out->text;
    out->kind = PBRT_NUMBER;
    if (!rt_import_number(&out->number, &end) || *end)
        rt_import_fail(of(tokens, out), out->line, "'%.40s' is not a finite number", out->text);
}

static void read_token(pbrt_tokens *tokens, pbrt_token *out)
{
    memset(out, 0, sizeof *out);
    while (tokens->depth > 0 && !skip_space(&tokens->sources[tokens->depth - 1])) {
        if (tokens->depth == 1)
            break;
        free(tokens->sources[--tokens->depth].text);
    }
    pbrt_source *source = &tokens->sources[tokens->depth - 1];
    out->line = source->line;
    out->file = source->file;
    if (source->at == source->end || tokens->import->failed)
        return;
    if (*source->at == '"')
        read_string(tokens, source, out);
    else if (*source->at == '[' || *source->at == ']')
        out->kind = *source->at++ == '[' ? PBRT_OPEN : PBRT_CLOSE;
    else
        read_word(tokens, source, out);
    if (tokens->import->failed)
        out->kind = PBRT_END;
}

const pbrt_token *rt_pbrt_peek(pbrt_tokens *tokens)
{
    if (!tokens->has_ahead)
        read_token(tokens, &tokens->ahead);
    tokens->has_ahead = 1;
    return &tokens->ahead;
}

pbrt_token rt_pbrt_take(pbrt_tokens *tokens)
{
    rt_pbrt_peek(tokens);
    tokens->has_ahead = 0;
    tokens->line = tokens->ahead.line;
    tokens->import->place.file = tokens->ahead.file;
    return tokens->ahead;
}

enum { INCLUDES_MAX = 10000 };

void rt_pbrt_include(pbrt_tokens *tokens, const char *name)
{
    size_t size;
    int line = rt_pbrt_line(tokens);
    if (tokens->depth == IMPORT_DEPTH_MAX) {
        rt_import_fail(tokens->import, line, "includes are nested deeper than %d, or in themselves",
                       IMPORT_DEPTH_MAX);
        return;
    }
    if (tokens->file_count == INCLUDES_MAX) {
        rt_import_fail(tokens->import, line, "more than %d includes", INCLUDES_MAX);
        return;
    }
    char *text = rt_import_read_text(tokens->import, line, name, &size);
    char **moved =
        text ? rt_import_grow(tokens->import, tokens->files, tokens->file_count, sizeof *moved)
             : NULL;
    char *file = moved ? malloc(strlen(name) + 1) : NULL;
    tokens->files = moved ? moved : tokens->files;
    if (!text)
        return;
    if (!file) {
        free(text);
        rt_import_fail_memory(tokens->import);
        return;
    }
    tokens->files[tokens->file_count++] = strcpy(file, name);
    tokens->sources[tokens->depth++] = (pbrt_source){file, text, text, text + size, 1};
}

void rt_pbrt_free_tokens(pbrt_tokens *tokens)
{
    tokens->import->place.file = NULL;
    while (tokens->depth > 1)
        free(tokens->sources[--tokens->depth].text);
    for (size_t i = 0; i < tokens->file_count; i++)
        free(tokens->files[i]);
    free(tokens->files);
}
