/* lexer.h - from text to tokens. */
#ifndef RT_DSL_LEXER_H
#define RT_DSL_LEXER_H

#include "dsl/report.h"

/* Kinds of token; punctuation is its own character: { } ( ) [ ] + - * / = , ; : */
enum {
    RT_TOKEN_END = 256, /* of the text */
    RT_TOKEN_WORD,
    RT_TOKEN_NUMBER,
    RT_TOKEN_STRING /* the place covers the quotes too */
};

typedef struct rt_token {
    int kind;
    rt_place place;
    double number;     /* of RT_TOKEN_NUMBER */
    int is_broken;     /* a number or string that is malformed, already reported */
    int first_on_line; /* only space stands before it on its line */
    int space_before;  /* space, a comment or the line's start stands before it */
} rt_token;

typedef struct rt_lexer {
    const rt_source *source;
    rt_reports *reports;
    uint64_t *order; /* counts the tokens of all texts */
    size_t at;       /* next byte */
    size_t line_start;
    int line;
    int first_on_line, space_before; /* of the next token */
} rt_lexer;

/* Starts at the beginning of a text, after a byte-order mark if it has one. */
void rt_lexer_begin(rt_lexer *lexer, const rt_source *source, rt_reports *reports, uint64_t *order);

/* Reads the next token. Characters outside the language are reported and passed over. */
void rt_lexer_next(rt_lexer *lexer, rt_token *token);

/*
 * Reports what shows that a source is no UTF-8 text at all, such as a NUL byte; returns whether it
 * is text. Counts the place's order as a token.
 */
int rt_lexer_check_text(const rt_source *source, rt_reports *reports, uint64_t *order);

#endif
