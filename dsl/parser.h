/*
 * parser.h - the state of the parser: the tokens ahead, and recovery after an error.
 *
 * The parser knows the fields of each block and the names defined so far: that is what
 * tells a value from the next field. After an error it goes on at the next place that
 * can be understood, so that each mistake is reported once and all of them are.
 */
#ifndef RT_DSL_PARSER_H
#define RT_DSL_PARSER_H

#include "dsl/expression.h"
#include "dsl/lexer.h"
#include "dsl/schema.h"
#include "dsl/scope.h"

#define RT_TOKENS_AHEAD 4u /* a power of two: three that are looked at, and the latest taken */

typedef struct rt_parser {
    rt_lexer lexer;
    rt_reports *reports;
    rt_operations *operations; /* of the current statement */
    const rt_scope *scope;
    rt_token ahead[RT_TOKENS_AHEAD]; /* a ring */
    unsigned first_ahead;            /* of it, counted on and on */
    int ahead_count;
    int depth;        /* parentheses and brackets open */
    int repeats;      /* whose '}' is still to come */
    int value_broken; /* the expression being parsed has an error that does not stop parsing */
} rt_parser;

void rt_parser_begin(rt_parser *parser, const rt_source *source, rt_reports *reports,
                     uint64_t *order, rt_operations *operations, const rt_scope *scope);

/*
 * A place between two statements, to go back to; and going on behind the '}' of the repeat that the
 * parser is in.
 */
typedef rt_lexer rt_parser_mark;
rt_parser_mark rt_parser_remember(const rt_parser *parser);
void rt_parser_return(rt_parser *parser, const rt_parser_mark *mark);
void rt_parser_skip_repeat(rt_parser *parser);

/* ---- Tokens and words ------------------------------------------------------ */

/* Looks n tokens ahead, n from 0 to 2; takes the next token. */
static inline const rt_token *rt_parser_peek(rt_parser *parser, int n)
{
    for (; parser->ahead_count <= n; parser->ahead_count++)
        rt_lexer_next(&parser->lexer,
                      &parser->ahead[(parser->first_ahead + (unsigned)parser->ahead_count) %
                                     RT_TOKENS_AHEAD]);
    return &parser->ahead[(parser->first_ahead + (unsigned)n) % RT_TOKENS_AHEAD];
}

/* The latest token taken, until the next is; all zero before the first. */
static inline const rt_token *rt_parser_last(const rt_parser *parser)
{
    return &parser->ahead[(parser->first_ahead - 1) % RT_TOKENS_AHEAD];
}

static inline const rt_token *rt_parser_take(rt_parser *parser)
{
    rt_parser_peek(parser, 0);
    parser->first_ahead++;
    parser->ahead_count--;
    return rt_parser_last(parser);
}

/* "'radius'", "a string" or "the end of the file": a token as messages name it. */
#define RT_FOUND_SIZE (RT_QUOTE_SIZE + 8)
const char *rt_parser_found(char out[RT_FOUND_SIZE], const rt_token *token);

/*
 * Where to point when something else was expected: at the next token, or behind the latest if that
 * ended its line.
 */
rt_place rt_parser_expected_place(rt_parser *parser);

/*
 * Says which function does what a sign that is no operator here, ^ or %, does elsewhere. Returns
 * whether it is one.
 */
int rt_parser_hint_operator(rt_parser *parser, const rt_token *token);

/* Takes a word and what hyphens join to it, as in `gaussian-jensen`. The next token is a word. */
rt_place rt_parser_take_hyphenated(rt_parser *parser, int *is_joined);

/* Takes a name, which has no hyphens: `red-wall` is one mistake. The next token must be a word. */
rt_place rt_parser_take_word(rt_parser *parser, int *is_broken);

/* Whether a token is this word. */
static inline int rt_token_is_word(const rt_token *token, const char *word)
{
    return token->kind == RT_TOKEN_WORD && rt_text_equal(rt_place_text(&token->place), word);
}

/* Whether the next tokens are a call: a word and, touching it, a parenthesis. */
int rt_parser_call_follows(rt_parser *parser);

/* Whether a word is the name of a constant, one that the scene defines or `pi`. */
int rt_parser_is_constant(const rt_parser *parser, rt_text word);

/*
 * Whether a statement begins at the next token: inside a block this shows that its '}' is missing.
 */
int rt_parser_statement_follows(rt_parser *parser);

/*
 * Recovery after an error. They skip what is left of a field's value, or of a constant's (block
 * NULL); a '{' with what it holds, to its '}' or a statement that shows it missing; and the rest of
 * a statement.
 */
void rt_parser_skip_value(rt_parser *parser, const rt_block *block);
void rt_parser_skip_braces(rt_parser *parser);
void rt_parser_skip_statement(rt_parser *parser);

#endif
