/*
 * text.h - bounded reading of a text file in memory: lines, tokens, numbers; whatever the locale.
 */
#ifndef RT_LIB_MESH_TEXT_H
#define RT_LIB_MESH_TEXT_H

#include <stddef.h>
#include <stdint.h>

/* A run of bytes of the file without white space. It is not terminated. */
typedef struct rt_token {
    const char *at;
    size_t length;
} rt_token;

/* A place in a text. Set all members; line counts from 1. */
typedef struct rt_mesh_text {
    const char *at, *end;
    size_t line;
    /* the byte that ends a line; a carriage return before a line feed is white space */
    char newline;
    int comments;  /* a # hides the rest of its line */
    int continued; /* a backslash at the end of a line joins the next one */
} rt_mesh_text;

/*
 * Starts at the beginning of the text. Files of the classic Macintosh, with carriage returns alone,
 * are seen.
 */
rt_mesh_text rt_mesh_text_begin(const void *data, size_t size);

/* The next token of this line; 0 at its end. */
int rt_mesh_text_token(rt_mesh_text *text, rt_token *out);

/* Passes to the next line, over what is left of this one; 0 at the end of the text. */
int rt_mesh_text_line(rt_mesh_text *text);

/* The next token of this line or of one below; 0 at the end of the text. */
int rt_mesh_text_any(rt_mesh_text *text, rt_token *out);

/* What is left of this line, without white space around it. */
rt_token rt_mesh_text_rest(rt_mesh_text *text);

int rt_token_is(rt_token token, const char *word);

/*
 * The token for a message: printable, shortened, in a buffer of RT_QUOTE bytes. Returns the buffer.
 */
#define RT_QUOTE 44
const char *rt_token_quote(rt_token token, char buffer[RT_QUOTE]);

/* A decimal integer, + or - allowed. Returns 0 when the token is none or does not fit. */
int rt_token_integer(rt_token token, int64_t *out);

/*
 * A decimal number, or inf or nan in any case. Returns 0 when the token is none. What is beyond
 * double becomes infinite or 0. Right to two units in the last place of a double, thus for all but
 * a few of 10^8 numbers the nearest float.
 */
int rt_token_real(rt_token token, double *out);

#endif
