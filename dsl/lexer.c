/* lexer.c - from text to tokens. */
#include "dsl/lexer.h"

#include <string.h>

/* What a byte may be; 0: it means nothing here. */
enum { LETTER = 1, DIGIT = 2, SPACE = 4, PUNCTUATION = 8 };

#define L LETTER
#define D DIGIT
#define S SPACE
#define P PUNCTUATION
static const unsigned char classes[256] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, S, S, 0, 0, S, 0, 0, /* tab, line feed, carriage return */
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, /* */
    S, 0, 0, 0, 0, P, 0, 0, P, P, P, P, P, P, 0, P, /*   % ( ) * + , - / */
    D, D, D, D, D, D, D, D, D, D, P, P, 0, P, 0, 0, /* 0 to 9 : ; = */
    0, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, /* A to O */
    L, L, L, L, L, L, L, L, L, L, L, P, 0, P, P, L, /* P to Z [ ] ^ _ */
    0, L, L, L, L, L, L, L, L, L, L, L, L, L, L, L, /* a to o */
    L, L, L, L, L, L, L, L, L, L, L, P, 0, P, 0, 0, /* p to z { } */
};
#undef L
#undef D
#undef S
#undef P

static int is(char c, int kinds)
{
    return classes[(unsigned char)c] & kinds;
}

/* Bytes of the well-formed UTF-8 sequence at s (Unicode, table 3-7), or 0. */
static size_t utf8_length(const char *s, size_t left)
{
    const unsigned char *u = (const unsigned char *)s;
    size_t length = u[0] < 0x80   ? 1
                    : u[0] < 0xc2 ? 0
                    : u[0] < 0xe0 ? 2
                    : u[0] < 0xf0 ? 3
                    : u[0] < 0xf5 ? 4
                                  : 0;
    if (length == 0 || length > left)
        return 0;
    for (size_t i = 1; i < length; i++)
        if ((u[i] & 0xc0) != 0x80)
            return 0;
    if ((u[0] == 0xe0 && u[1] < 0xa0) || (u[0] == 0xed && u[1] > 0x9f) ||
        (u[0] == 0xf0 && u[1] < 0x90) || (u[0] == 0xf4 && u[1] > 0x8f))
        return 0;
    return length;
}

static char byte_at(const rt_lexer *lexer, size_t at)
{
    return lexer->source->text[at]; /* the NUL after the text included */
}

static rt_place place_of(const rt_lexer *lexer, size_t start)
{
    rt_place place;
    place.source = lexer->source;
    place.order = ++*lexer->order;
    place.offset = start;
    place.line = lexer->line;
    place.column = (int)(start - lexer->line_start) + 1;
    place.length = (int)(lexer->at - start);
    return place;
}

void rt_lexer_begin(rt_lexer *lexer, const rt_source *source, rt_reports *reports, uint64_t *order)
{
    memset(lexer, 0, sizeof *lexer);
    lexer->source = source;
    lexer->reports = reports;
    lexer->order = order;
    lexer->line = 1;
    lexer->first_on_line = 1;
    lexer->at = lexer->line_start = rt_byte_order_mark(source->text, source->size);
}

/* Passes over bytes that are not UTF-8, and reports them as one. */
static void skip_invalid(rt_lexer *lexer)
{
    const rt_source *source = lexer->source;
    size_t start = lexer->at;
    while (lexer->at < source->size &&
           !utf8_length(source->text + lexer->at, source->size - lexer->at))
        lexer->at++;
    rt_report_error(lexer->reports, place_of(lexer, start), "byte 0x%02x is not UTF-8",
                    (unsigned)(unsigned char)source->text[start]);
    rt_report_hint(lexer->reports, "save the file as UTF-8");
}

/* At a line feed, or at the carriage return before it. */
static int is_line_end(const rt_lexer *lexer)
{
    char c = byte_at(lexer, lexer->at);
    return c == '\n' || (c == '\r' && byte_at(lexer, lexer->at + 1) == '\n');
}

/* The first place from `at` on that is not plain ASCII or holds the closing character. */
static size_t plain_end(const char *text, size_t at, char closing)
{
    /* The NUL after the text is not plain. */
    while (text[at] >= ' ' && text[at] <= '~' && text[at] != closing)
        at++;
    return at;
}

/* Passes over text up to the end of the line or the closing character; its bytes must be UTF-8. */
static void skip_free_text(rt_lexer *lexer, char closing)
{
    const rt_source *source = lexer->source;
    for (;;) {
        lexer->at = plain_end(source->text, lexer->at, closing);
        if (lexer->at >= source->size)
            return;
        if (is_line_end(lexer) || (closing && byte_at(lexer, lexer->at) == closing))
            return;
        size_t length = utf8_length(source->text + lexer->at, source->size - lexer->at);
        if (length)
            lexer->at += length;
        else
            skip_invalid(lexer);
    }
}

static void skip_space(rt_lexer *lexer)
{
    while (lexer->at < lexer->source->size) {
        char c = byte_at(lexer, lexer->at);
        if (c == '#') {
            skip_free_text(lexer, '\0');
        } else if (is(c, SPACE)) {
            lexer->at++;
            if (c == '\n') {
                lexer->line++;
                lexer->line_start = lexer->at;
                lexer->first_on_line = 1;
            }
        } else {
            return;
        }
        lexer->space_before = 1;
    }
}

/* Passes over a run of characters that mean nothing here, and reports them as one. */
static void skip_stray(rt_lexer *lexer)
{
    const rt_source *source = lexer->source;
    size_t start = lexer->at, length;
    while (lexer->at < source->size) {
        char c = byte_at(lexer, lexer->at);
        if (is(c, LETTER | DIGIT | SPACE | PUNCTUATION) || c == '"' || c == '#')
            break;
        length = utf8_length(source->text + lexer->at, source->size - lexer->at);
        if (!length)
            break;
        lexer->at += length;
    }
    if (lexer->at == start) {
        skip_invalid(lexer);
        return;
    }
    rt_place place = place_of(lexer, start);
    char quote[RT_QUOTE_SIZE];
    unsigned char first = (unsigned char)source->text[start];
    if (first < 0x20 || first == 0x7f)
        rt_report_error(lexer->reports, place, "unexpected byte 0x%02x", (unsigned)first);
    else
        rt_report_error(lexer->reports, place, "unexpected '%s'",
                        rt_text_quote(quote, rt_place_text(&place)));
}

/*
 * A number takes every letter, digit and point that touches it, so that 1.2.3 or 12abc is one
 * mistake.
 */
static void read_number(rt_lexer *lexer, rt_token *token)
{
    size_t start = lexer->at;
    for (;; lexer->at++) {
        char c = byte_at(lexer, lexer->at);
        char before = lexer->at > start ? byte_at(lexer, lexer->at - 1) : '\0';
        int is_sign = (c == '+' || c == '-') && (before == 'e' || before == 'E');
        if (!is(c, LETTER | DIGIT) && c != '.' && !is_sign)
            break;
    }
    token->kind = RT_TOKEN_NUMBER;
    token->place = place_of(lexer, start);

    char quote[RT_QUOTE_SIZE];
    rt_text text = rt_place_text(&token->place);
    rt_number_result result = rt_number_read(&token->number, text.at, text.length);
    token->is_broken = result == RT_NUMBER_MALFORMED || result == RT_NUMBER_TOO_LARGE;
    if (result == RT_NUMBER_MALFORMED) {
        rt_report_error(lexer->reports, token->place, "'%s' is not a number",
                        rt_text_quote(quote, text));
        rt_report_hint(lexer->reports, "numbers are written without units, like 2, 0.5 or 1e-3");
    } else if (result == RT_NUMBER_TOO_LARGE) {
        rt_report_error(lexer->reports, token->place, "the number '%s' is too large",
                        rt_text_quote(quote, text));
    }
}

/*
 * The last '}' of a line that an open string has run over hardly belongs to a file name: it closes
 * the block.
 */
static void give_back_brace(rt_lexer *lexer, size_t start)
{
    for (size_t at = lexer->at; at > start; at--)
        if (byte_at(lexer, at - 1) == '}') {
            lexer->at = at - 1;
            return;
        }
}

static void read_string(rt_lexer *lexer, rt_token *token)
{
    size_t start = lexer->at++, errors = lexer->reports->errors;
    uint64_t order = ++*lexer->order; /* before that of bad bytes inside */
    skip_free_text(lexer, '"');
    int closed = byte_at(lexer, lexer->at) == '"' && lexer->at < lexer->source->size;
    if (!closed)
        give_back_brace(lexer, start);
    lexer->at += (size_t)closed;
    token->kind = RT_TOKEN_STRING;
    token->place = place_of(lexer, start);
    token->place.order = order;
    token->is_broken = !closed || lexer->reports->errors != errors;
    if (!closed) {
        rt_place quote = token->place;
        quote.length = 1;
        rt_report_error(lexer->reports, quote,
                        "the string is not closed: expected '\"' before the end of the line");
    }
}

/* Whether a comment of C begins here. */
static int is_foreign_comment(const rt_lexer *lexer)
{
    const char next = byte_at(lexer, lexer->at) == '/' ? byte_at(lexer, lexer->at + 1) : '\0';
    return next == '/' || next == '*';
}

/* Passes over it, and reports it. */
static void skip_foreign_comment(rt_lexer *lexer)
{
    const size_t start = lexer->at;
    const int is_block = byte_at(lexer, start + 1) == '*';
    lexer->at += 2;
    rt_report_error(lexer->reports, place_of(lexer, start), "'%s' begins no comment",
                    is_block ? "/*" : "//");
    rt_report_hint(lexer->reports, "a comment begins with '#', and ends with its line");
    while (lexer->at < lexer->source->size) {
        skip_free_text(lexer, is_block ? '*' : '\0');
        if (!is_block)
            break;
        if (byte_at(lexer, lexer->at) == '*' && byte_at(lexer, lexer->at + 1) == '/') {
            lexer->at += 2;
            break;
        }
        if (byte_at(lexer, lexer->at) == '*')
            lexer->at++;
        else
            skip_space(lexer); /* the end of the line */
    }
    lexer->space_before = 1;
}

void rt_lexer_next(rt_lexer *lexer, rt_token *token)
{
    token->number = 0;
    token->is_broken = 0;
    for (;;) {
        skip_space(lexer);
        token->first_on_line = lexer->first_on_line;
        token->space_before = lexer->space_before || lexer->first_on_line;

        size_t start = lexer->at;
        char c = byte_at(lexer, start);
        if (start >= lexer->source->size) {
            token->kind = RT_TOKEN_END;
            token->place = place_of(lexer, start);
        } else if (is(c, LETTER)) {
            while (is(byte_at(lexer, lexer->at), LETTER | DIGIT))
                lexer->at++;
            token->kind = RT_TOKEN_WORD;
            token->place = place_of(lexer, start);
        } else if (is(c, DIGIT) || (c == '.' && is(byte_at(lexer, start + 1), DIGIT))) {
            read_number(lexer, token);
        } else if (c == '"') {
            read_string(lexer, token);
        } else if (is_foreign_comment(lexer)) {
            skip_foreign_comment(lexer);
            if (rt_reports_full(lexer->reports))
                lexer->at = lexer->source->size;
            continue;
        } else if (is(c, PUNCTUATION)) {
            lexer->at++;
            token->kind = c;
            token->place = place_of(lexer, start);
        } else {
            skip_stray(lexer);
            if (rt_reports_full(lexer->reports))
                lexer->at = lexer->source->size;
            continue;
        }
        lexer->first_on_line = lexer->space_before = 0;
        return;
    }
}

int rt_lexer_check_text(const rt_source *source, rt_reports *reports, uint64_t *order)
{
    rt_place place = {source, ++*order, 0, 1, 1, 1};
    const char *nul = memchr(source->text, '\0', source->size);
    if (source->size >= 2 &&
        (memcmp(source->text, "\xff\xfe", 2) == 0 || memcmp(source->text, "\xfe\xff", 2) == 0)) {
        rt_report_error(reports, place, "the file is UTF-16 text");
        rt_report_hint(reports, "save it as UTF-8");
        return 0;
    }
    if (!nul)
        return 1;
    size_t line_start = 0;
    place.offset = (size_t)(nul - source->text);
    for (size_t i = 0; i < place.offset; i++)
        if (source->text[i] == '\n') {
            place.line++;
            line_start = i + 1;
        }
    place.column = (int)(place.offset - line_start) + 1;
    rt_report_error(reports, place, "the file is not text: it holds a NUL byte here");
    rt_report_hint(reports, "a scene is a text file in UTF-8");
    return 0;
}
