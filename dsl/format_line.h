/*
 * format_line.h - the lines of a scene text that is laid out anew: their indentation, and the
 * columns that neighbours have in common.
 */
#ifndef RT_DSL_FORMAT_LINE_H
#define RT_DSL_FORMAT_LINE_H

#include "dsl/source.h"

/* What a piece of text is to the layout. */
typedef enum rt_mark {
    RT_MARK_NONE,
    RT_MARK_FIELD, /* the name of a field */
    RT_MARK_BRACE, /* a '{' */
    RT_MARK_EQUALS /* the '=' of a let */
} rt_mark;

typedef struct rt_line {
    size_t text, length; /* in the layout's characters */
    rt_text comment;     /* behind the text, or alone on its line; length 0: none */
    size_t first_mark, mark_count, fields, braces, closings;
    int levels;         /* of indentation */
    int is_after_blank; /* an empty line stands before it */
    size_t pad_at, pad; /* spaces put in at an offset of the text */
    size_t comment_column;
} rt_line;

typedef struct rt_line_mark {
    rt_mark mark;
    size_t at, length; /* of its text, in its line */
} rt_line_mark;

/* All zero is empty. Without memory `out_of_memory` is set, and nothing more is added. */
typedef struct rt_layout {
    char *text;
    size_t size, capacity;
    rt_line *lines;
    size_t line_count, line_capacity;
    rt_line_mark *marks;
    size_t mark_count, mark_capacity;
    int is_after_blank; /* the next line has an empty one before it */
    int out_of_memory;
} rt_layout;

/* Begins a line of text; then spaces and text at its end. */
void rt_layout_line(rt_layout *layout, int levels);
void rt_layout_space(rt_layout *layout, int count);
void rt_layout_text(rt_layout *layout, rt_text text, rt_mark mark, int is_closing);

/* A comment behind the line, or on one of its own; it must live until the layout is finished. */
void rt_layout_comment(rt_layout *layout, rt_text comment, int is_alone, int levels);

/* An empty line before the next one, unless that is the first. */
void rt_layout_blank(rt_layout *layout);

/* The text, to be freed; NULL without memory. */
char *rt_layout_finish(rt_layout *layout);
void rt_layout_free(rt_layout *layout);

#endif
