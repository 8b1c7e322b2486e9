/*
 * format.c - rt_scene_format: a scene text laid out anew, with its comments.
 *
 * Lines stay the lines that they are, but for a block of one line that is too long. Within a line
 * the space between tokens is set, without ever parting tokens that touch or joining others where
 * that means something; then columns are aligned over neighbouring lines.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/format_line.h"
#include "dsl/lexer.h"
#include "dsl/parser.h"
#include "dsl/schema.h"

enum { NESTING_MAX = 256 };

/* What is around a token: braces, parentheses or brackets that are open. */
typedef struct rt_nest {
    char opening;
    const rt_block *block; /* of a '{' of a block; else NULL */
    rt_place place;        /* of its statement, or of the sign itself */
} rt_nest;

typedef struct rt_formatter {
    rt_lexer lexer;
    rt_reports *reports;
    rt_layout *layout;
    rt_nest nests[NESTING_MAX];
    int depth;             /* of nests */
    rt_token last;         /* the token before; kind 0: none */
    rt_token first, other; /* the words that opened the statement, kind 0 for none */
    int in_let;            /* reading the expression of a let */
    int is_binary;         /* the last token was an operator with two operands */
    int takes_word;        /* the next word is the value of a field */
    int has_ended;         /* after an error that what follows would only repeat */
} rt_formatter;

static int is_closing(int kind)
{
    return kind == '}' || kind == ')' || kind == ']';
}

/* Whether a token ends an operand, so that a sign behind it is an operator between two. */
static int ends_operand(const rt_token *token)
{
    return token->kind == RT_TOKEN_WORD || token->kind == RT_TOKEN_NUMBER || token->kind == ')' ||
           token->kind == ']';
}

static int is_sign(int kind)
{
    return kind == '+' || kind == '-' || kind == '*' || kind == '/';
}

static const rt_nest *innermost(const rt_formatter *f)
{
    static const rt_nest outside = {.opening = '\0'};
    return f->depth > 0 ? &f->nests[f->depth - 1] : &outside;
}

/* Whether signs are operators here, rather than parts of numbers. */
static int in_arithmetic(const rt_formatter *f)
{
    char opening = innermost(f)->opening;
    return opening == '(' || (f->in_let && opening != '[');
}

/* The field that a word begins, or NULL. */
static const rt_field *field_of(const rt_formatter *f, const rt_token *token)
{
    const rt_nest *nest = innermost(f);
    if (nest->opening != '{' || !nest->block || f->takes_word || token->kind != RT_TOKEN_WORD)
        return NULL;
    if (f->last.kind == '-' && !token->space_before)
        return NULL;
    return rt_schema_field(nest->block, rt_place_text(&token->place));
}

/* Spaces between the last token and the next one, on one line. */
static int spaces_before(const rt_formatter *f, const rt_token *token, const rt_field *field)
{
    int kind = token->kind, last = f->last.kind;
    if (last == '{' || kind == '{' || kind == '}' || last == '}')
        return 1;
    if (field)
        return 2;
    if (kind == '=' || last == '=')
        return 1;
    if (last == '(' || last == '[' || kind == ')' || kind == ']')
        return 0;
    if (in_arithmetic(f)) {
        if (kind == ',')
            return 0;
        if (is_sign(kind))
            return ends_operand(&f->last) || last == ',' || f->is_binary;
        if (is_sign(last))
            return f->is_binary;
        if (last == ',')
            return 1;
    }
    return token->space_before != 0;
}

/* Notes the words that begin a statement, which name the block whose '{' follows. */
static void note_statement(rt_formatter *f, const rt_token *token)
{
    if (token->kind != RT_TOKEN_WORD || innermost(f)->block || in_arithmetic(f))
        return;
    if (f->first.kind == 0) {
        f->first = *token;
        f->in_let = rt_text_equal(rt_place_text(&token->place), "let");
    } else if (f->other.kind == 0) {
        f->other = *token;
    }
}

/* The block that a '{' opens, or NULL: a repeat, or no block that is known. */
static const rt_block *opened_block(const rt_formatter *f)
{
    if (f->first.kind == 0)
        return NULL;
    rt_text word = rt_place_text(&f->first.place), kind = {"", 0};
    if (f->other.kind)
        kind = rt_place_text(&f->other.place);
    const rt_block *block = rt_schema_find(word, NULL);
    return block ? block : rt_schema_find(word, &kind);
}

/* Of what is open, where a token comes that cannot stand in it; all that follows is in doubt. */
static void fail_open(rt_formatter *f, const rt_token *token)
{
    const rt_nest *open = innermost(f);
    char title[RT_BLOCK_TITLE_SIZE], sign[4] = {'\'', open->opening, '\'', '\0'},
                                     found[RT_FOUND_SIZE];
    rt_report_error(f->reports, open->place, "%s is not closed: expected '%c' before %s",
                    open->block ? rt_block_title(title, open->block) : sign,
                    open->opening == '{'   ? '}'
                    : open->opening == '(' ? ')'
                                           : ']',
                    rt_parser_found(found, token));
    f->has_ended = 1;
}

static void open(rt_formatter *f, const rt_token *token)
{
    const rt_block *block = token->kind == '{' ? opened_block(f) : NULL;
    /* No block stands in a vector or an expression: these want their end. */
    if (token->kind == '{' && f->depth > 0 && innermost(f)->opening != '{') {
        fail_open(f, token);
        return;
    }
    if (f->depth == NESTING_MAX) {
        rt_report_error(f->reports, token->place, "braces and parentheses nest deeper than %d",
                        NESTING_MAX);
        f->has_ended = 1;
        return;
    }
    f->nests[f->depth++] =
        (rt_nest){(char)token->kind, block, block ? f->first.place : token->place};
    if (token->kind == '{')
        f->first.kind = f->other.kind = f->in_let = 0;
}

static void close(rt_formatter *f, const rt_token *token)
{
    char opening = token->kind == '}' ? '{' : token->kind == ')' ? '(' : '[';
    if (innermost(f)->opening != opening &&
        (innermost(f)->opening == '(' || innermost(f)->opening == '[')) {
        fail_open(f, token);
        return;
    }
    if (innermost(f)->opening != opening) {
        rt_report_error(f->reports, token->place, "this '%c' closes nothing", token->kind);
        return;
    }
    f->depth--;
    if (token->kind == '}')
        f->first.kind = f->other.kind = 0;
}

/* Whether the next token begins a line: the text has one, or a statement follows another. */
static int breaks_line(const rt_formatter *f, const rt_token *token)
{
    return token->first_on_line ||
           (f->depth == 0 && f->last.kind == '}' && token->kind == RT_TOKEN_WORD);
}

/* Levels of indentation of a line that begins with this token. */
static int indentation(const rt_formatter *f, const rt_token *token, const rt_field *field)
{
    int levels = 0, is_value = 0;
    for (int i = 0; i < f->depth; i++)
        levels += f->nests[i].opening == '{';
    if (token->kind == '}')
        return levels > 0 ? levels - 1 : 0;
    const rt_nest *nest = innermost(f);
    is_value = nest->opening == '(' || nest->opening == '[' || (nest->block && !field) ||
               (f->in_let && !(token->kind == RT_TOKEN_WORD && !f->is_binary)) ||
               (f->first.kind && token->kind == '{');
    return levels + (is_value && token->kind != '{');
}

/* A let ends where a word begins a line and no operator waits for it. */
static void end_let(rt_formatter *f, const rt_token *token)
{
    if (f->in_let && token->first_on_line && token->kind == RT_TOKEN_WORD && !f->is_binary &&
        f->last.kind != '=' && (f->depth == 0 || innermost(f)->opening == '{'))
        f->in_let = f->first.kind = f->other.kind = 0;
    if (f->in_let && token->kind == '}')
        f->in_let = 0;
    /* An include has no braces: the next line begins a statement. */
    if (f->last.kind == RT_TOKEN_STRING && !innermost(f)->block)
        f->first.kind = f->other.kind = 0;
}

static void put_token(rt_formatter *f, const rt_token *token)
{
    end_let(f, token);
    const rt_field *field = field_of(f, token);
    rt_text text = rt_place_text(&token->place);
    rt_mark mark = field                             ? RT_MARK_FIELD
                   : token->kind == '{'              ? RT_MARK_BRACE
                   : f->in_let && token->kind == '=' ? RT_MARK_EQUALS
                                                     : RT_MARK_NONE;
    if (breaks_line(f, token))
        rt_layout_line(f->layout, indentation(f, token, field));
    else
        rt_layout_space(f->layout, f->last.kind ? spaces_before(f, token, field) : 0);
    rt_layout_text(f->layout, text, mark, token->kind == '}');
    f->is_binary = is_sign(token->kind) && ends_operand(&f->last);
    f->takes_word = field && (rt_field_words(field) || field->type == RT_FIELD_MATERIAL ||
                              field->type == RT_FIELD_TEXTURE || field->type == RT_FIELD_GRID ||
                              field->type == RT_FIELD_PART);
    note_statement(f, token);
    if (token->kind == '{' || token->kind == '(' || token->kind == '[')
        open(f, token);
    else if (is_closing(token->kind))
        close(f, token);
    f->last = *token;
}

/* Comments and empty lines between two tokens. */
static void put_gap(rt_formatter *f, const char *at, const char *end)
{
    int newlines = 0, levels = 0;
    for (int i = 0; i < f->depth; i++)
        levels += f->nests[i].opening == '{';
    for (; at < end; at++) {
        if (*at == '\n') {
            newlines++;
        } else if (*at == '#') {
            const char *stop = memchr(at, '\n', (size_t)(end - at));
            stop = stop ? stop : end;
            if (newlines > 1)
                rt_layout_blank(f->layout);
            rt_layout_comment(f->layout, (rt_text){at, (size_t)(stop - at)},
                              newlines > 0 || f->last.kind == 0, levels);
            newlines = 0;
            at = stop - 1;
        }
    }
    if (newlines > 1)
        rt_layout_blank(f->layout);
}

static void format(rt_formatter *f, const rt_source *source)
{
    const char *end = source->text + rt_byte_order_mark(source->text, source->size);
    rt_token token;
    do {
        rt_lexer_next(&f->lexer, &token);
        put_gap(f, end, source->text + token.place.offset);
        if (token.kind != RT_TOKEN_END)
            put_token(f, &token);
        end = source->text + token.place.offset + token.place.length;
    } while (token.kind != RT_TOKEN_END && !rt_reports_full(f->reports) &&
             !f->layout->out_of_memory && !f->has_ended);
    if (f->depth > 0 && f->reports->errors == 0 && !f->layout->out_of_memory)
        fail_open(f, &token);
}

static rt_status fail_missing(rt_error *error, const char *name)
{
    if (error) {
        memset(error, 0, sizeof *error);
        error->status = RT_ERROR_USAGE;
        snprintf(error->field, sizeof error->field, "%s", name);
        snprintf(error->message, sizeof error->message, "%s is NULL", name);
    }
    return RT_ERROR_USAGE;
}

rt_status rt_scene_format(char **out, const char *text, const char *name,
                          const rt_load_options *options, rt_error *error)
{
    static const rt_load_options silent = {0};
    const char *why;
    rt_sources sources = {NULL, 0, 0, NULL};
    rt_reports reports;
    rt_layout layout = {0};
    uint64_t order = 0;
    if (!text)
        return fail_missing(error, "text");
    memset(&reports, 0, sizeof reports);
    rt_formatter *f = calloc(1, sizeof *f);
    rt_source *source = rt_sources_add(&sources, name ? name : "text", NULL);
    if (!f || !source || rt_source_copy(&sources, source, text, &why) != RT_OK)
        reports.out_of_memory = 1;
    if (!reports.out_of_memory && rt_lexer_check_text(source, &reports, &order)) {
        f->reports = &reports;
        f->layout = &layout;
        rt_lexer_begin(&f->lexer, source, &reports, &order);
        format(f, source);
    }
    char *made = reports.errors || reports.out_of_memory ? NULL : rt_layout_finish(&layout);
    reports.out_of_memory |= reports.errors == 0 && !made;
    rt_status status = rt_reports_finish(&reports, options ? options : &silent, error);
    if (status == RT_OK)
        *out = made;
    rt_layout_free(&layout);
    rt_reports_free(&reports);
    rt_sources_free(&sources);
    free(f);
    return status;
}
