/*
 * parser.h - from tokens to statements, one at a time.
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

/* A field as it is written. */
typedef struct rt_entry {
    const rt_field *field;
    rt_place name;
    rt_place word; /* the word given, or the text of a string */
    rt_expression values[RT_FIELD_VALUES_MAX];
    int value_count;
    int is_broken; /* has an error already reported */
} rt_entry;

typedef enum rt_statement_kind {
    RT_STATEMENT_LET,
    RT_STATEMENT_INCLUDE,
    RT_STATEMENT_BLOCK,
    RT_STATEMENT_REPEAT, /* up to its '{' */
    RT_STATEMENT_END     /* the '}' of a repeat */
} rt_statement_kind;

#define RT_ENTRIES_MAX 64 /* in one block */

typedef struct rt_statement {
    rt_statement_kind kind;
    rt_place place; /* of its first word, or first two: `light point` */
    /* the word that names it or, of a repeat, its constant; length 0 when it is missing */
    rt_place name;
    rt_expression value; /* of a constant; of a repeat the first */
    rt_expression last;  /* of a repeat */
    rt_place path;       /* of an include, without the quotes */
    const rt_block *block;
    int is_broken;     /* has an error already reported: not to be built */
    int is_incomplete; /* fields may be missing because of an error already reported */
    int entry_count;
    rt_entry entries[RT_ENTRIES_MAX]; /* last: only the first entry_count are ever written */
} rt_statement;

/* The entry of a field in a block, or NULL. */
const rt_entry *rt_statement_entry(const rt_statement *statement, const rt_field *field);

typedef struct rt_parser {
    rt_lexer lexer;
    rt_reports *reports;
    rt_operations *operations; /* of the current statement */
    const rt_scope *scope;
    rt_token ahead[3];
    int ahead_count;
    int last_kind;    /* kind of the latest token taken */
    rt_place last;    /* and its place */
    int depth;        /* parentheses and brackets open */
    int repeats;      /* whose '}' is still to come */
    int value_broken; /* the expression being parsed has an error that does not stop parsing */
} rt_parser;

void rt_parser_begin(rt_parser *parser, const rt_source *source, rt_reports *reports,
                     uint64_t *order, rt_operations *operations, const rt_scope *scope);

/*
 * Parses the next statement that can be understood, errors included; returns 0 at the end of the
 * text. Nothing past the statement's last token is read, but for the one that ends a `let`.
 */
int rt_parser_next(rt_parser *parser, rt_statement *statement);

/*
 * A place between two statements, to go back to; and going on behind the '}' of the repeat that the
 * parser is in.
 */
typedef rt_lexer rt_parser_mark;
rt_parser_mark rt_parser_remember(const rt_parser *parser);
void rt_parser_return(rt_parser *parser, const rt_parser_mark *mark);
void rt_parser_skip_repeat(rt_parser *parser);

/* ---- Shared by the parser's files ---------------------------------------- */

/* Looks n tokens ahead, n from 0 to 2; takes the next token. */
const rt_token *rt_parser_peek(rt_parser *parser, int n);
rt_token rt_parser_take(rt_parser *parser);

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

/*
 * Takes a word, and what hyphens join to it, as in `gaussian-jensen`; the next token must be a word.
 */
rt_place rt_parser_take_hyphenated(rt_parser *parser, int *is_joined);

/* Takes a name, which has no hyphens: `red-wall` is one mistake. The next token must be a word. */
rt_place rt_parser_take_word(rt_parser *parser, int *is_broken);

/* Whether the next tokens are a call: a word and, touching it, a parenthesis. */
int rt_parser_call_follows(rt_parser *parser);

/* Whether a word is the name of a constant, one that the scene defines or `pi`. */
int rt_parser_is_constant(const rt_parser *parser, rt_text word);

/* The table of the names that a field takes, or NULL. */
const rt_names *rt_scope_names(const rt_scope *scope, rt_field_type type);

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
