/* format_line.c - lines laid out: long blocks are broken, and columns aligned. */
#include "dsl/format_line.h"

#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 100, INDENT = 4 };

/* Makes room for one more item; returns whether there is. */
static int reserve(rt_layout *layout, void **items, size_t count, size_t *capacity, size_t size)
{
    if (count < *capacity)
        return 1;
    size_t grown = *capacity ? 2 * *capacity : 64;
    void *moved = layout->out_of_memory ? NULL : realloc(*items, grown * size);
    if (!moved) {
        layout->out_of_memory = 1;
        return 0;
    }
    *items = moved;
    *capacity = grown;
    return 1;
}

static void put(rt_layout *layout, const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        if (!reserve(layout, (void **)&layout->text, layout->size, &layout->capacity, 1))
            return;
        layout->text[layout->size++] = text[i];
    }
}

static void put_spaces(rt_layout *layout, size_t count)
{
    for (size_t i = 0; i < count; i++)
        put(layout, " ", 1);
}

static rt_line *last_line(rt_layout *layout)
{
    return &layout->lines[layout->line_count - 1];
}

static rt_line *add_line(rt_layout *layout, int levels)
{
    if (!reserve(layout, (void **)&layout->lines, layout->line_count, &layout->line_capacity,
                 sizeof *layout->lines) ||
        !reserve(layout, (void **)&layout->text, layout->size, &layout->capacity, 1))
        return NULL;
    rt_line *line = &layout->lines[layout->line_count++];
    memset(line, 0, sizeof *line);
    line->text = layout->size;
    line->first_mark = layout->mark_count;
    line->levels = levels;
    line->is_after_blank = layout->is_after_blank;
    layout->is_after_blank = 0;
    return line;
}

void rt_layout_line(rt_layout *layout, int levels)
{
    add_line(layout, levels);
}

void rt_layout_space(rt_layout *layout, int count)
{
    if (layout->line_count == 0)
        add_line(layout, 0);
    if (layout->out_of_memory)
        return;
    put_spaces(layout, (size_t)count);
    last_line(layout)->length += (size_t)count;
}

void rt_layout_text(rt_layout *layout, rt_text text, rt_mark mark, int is_closing)
{
    if (layout->out_of_memory || !reserve(layout, (void **)&layout->marks, layout->mark_count,
                                          &layout->mark_capacity, sizeof *layout->marks))
        return;
    rt_line *line = last_line(layout);
    if (mark != RT_MARK_NONE) {
        layout->marks[layout->mark_count++] = (rt_line_mark){mark, line->length, text.length};
        line->mark_count++;
    }
    line->fields += mark == RT_MARK_FIELD;
    line->braces += mark == RT_MARK_BRACE;
    line->closings += is_closing != 0;
    put(layout, text.at, text.length);
    line->length += text.length;
}

void rt_layout_comment(rt_layout *layout, rt_text comment, int is_alone, int levels)
{
    while (comment.length > 1 && strchr(" \t\r", comment.at[comment.length - 1]))
        comment.length--;
    rt_line *line = is_alone || layout->line_count == 0 || layout->out_of_memory
                        ? add_line(layout, levels)
                        : last_line(layout);
    if (line)
        line->comment = comment;
}

void rt_layout_blank(rt_layout *layout)
{
    layout->is_after_blank = layout->line_count > 0;
}

/* ---- Long blocks ----------------------------------------------------------- */

/* Whether a line is one whole block, as `sphere { centre 0 0 0 }`. */
static int is_block(const rt_layout *layout, const rt_line *line)
{
    return line->braces == 1 && line->closings == 1 && line->mark_count > 0 &&
           layout->marks[line->first_mark].mark == RT_MARK_BRACE &&
           layout->text[line->text + line->length - 1] == '}';
}

/*
 * The next line of a block that is broken: its text from `from` to `to`, without spaces around. The
 * name of a field, so long, begins it; 0: none does.
 */
static void add_part(rt_layout *out, const rt_layout *layout, const rt_line *line, size_t from,
                     size_t to, int levels, size_t name)
{
    const char *text = layout->text + line->text;
    while (to > from && text[to - 1] == ' ')
        to--;
    while (from < to && text[from] == ' ')
        from++;
    if (to == from)
        return;
    rt_layout_line(out, levels);
    rt_layout_text(out, (rt_text){text + from, name}, name ? RT_MARK_FIELD : RT_MARK_NONE, 0);
    rt_layout_text(out, (rt_text){text + from + name, to - from - name}, RT_MARK_NONE, 0);
}

/* Whether nothing but space stands between its '{' and the first of its fields. */
static int begins_with_field(const rt_layout *layout, const rt_line *line)
{
    const rt_line_mark *marks = layout->marks + line->first_mark;
    const char *text = layout->text + line->text;
    return line->fields > 0 && text[marks[0].at + 1] == ' ' && marks[1].at <= marks[0].at + 2;
}

static void break_block(rt_layout *out, const rt_layout *layout, const rt_line *line)
{
    const rt_line_mark *marks = layout->marks + line->first_mark;
    size_t at = marks[0].at + 1;
    out->is_after_blank = line->is_after_blank;
    add_part(out, layout, line, 0, at, line->levels, 0);
    if (!out->out_of_memory)
        last_line(out)->comment = line->comment;
    for (size_t i = 1; i <= line->mark_count; i++) {
        size_t to = i < line->mark_count ? marks[i].at : line->length - 1;
        add_part(out, layout, line, at, to, line->levels + 1, i > 1 ? marks[i - 1].length : 0);
        at = to;
    }
    add_part(out, layout, line, line->length - 1, line->length, line->levels, 0);
}

static void copy_line(rt_layout *out, const rt_layout *layout, const rt_line *line)
{
    out->is_after_blank = line->is_after_blank;
    rt_line *copy = add_line(out, line->levels);
    if (!copy)
        return;
    size_t text = copy->text, first = copy->first_mark;
    *copy = *line;
    copy->text = text;
    copy->first_mark = first;
    put(out, layout->text + line->text, line->length);
    for (size_t i = 0; i < line->mark_count; i++)
        if (reserve(out, (void **)&out->marks, out->mark_count, &out->mark_capacity,
                    sizeof *out->marks))
            out->marks[out->mark_count++] = layout->marks[line->first_mark + i];
}

/* ---- Columns --------------------------------------------------------------- */

/* Offset at which a line may be padded to align it with its neighbours; 0: nowhere. */
static size_t pad_place(const rt_layout *layout, const rt_line *line)
{
    if (line->mark_count == 0)
        return 0;
    const char *text = layout->text + line->text;
    const rt_line_mark *first = layout->marks + line->first_mark;
    if (line->mark_count == 1 && first->mark == RT_MARK_EQUALS)
        return first->at;
    /* What touches the field, such as file"a b.ply", may have a space of its own. */
    if (line->fields == 1 && line->braces + line->closings == 0 && first->at == 0)
        return first->length < line->length && text[first->length] == ' ' ? first->length + 1 : 0;
    return line->braces == 1 && line->closings == 1 && is_block(layout, line) ? first->at : 0;
}

/* Whether two lines, one behind the other, are of one table. */
static int are_alike(const rt_line *a, const rt_line *b)
{
    return a->levels == b->levels && !b->is_after_blank && a->pad_at && b->pad_at &&
           a->braces == b->braces && (a->braces || a->fields == b->fields);
}

static void align_text(rt_layout *layout, size_t from, size_t to)
{
    size_t column = 0, longest = 0;
    for (size_t i = from; i < to; i++)
        if (layout->lines[i].pad_at > column)
            column = layout->lines[i].pad_at;
    for (size_t i = from; i < to; i++) {
        const rt_line *line = &layout->lines[i];
        size_t length = (size_t)line->levels * INDENT + line->length + column - line->pad_at;
        longest = length > longest ? length : longest;
    }
    for (size_t i = from; i < to && longest <= COLUMNS; i++)
        layout->lines[i].pad = column - layout->lines[i].pad_at;
}

static size_t width(const rt_line *line)
{
    return (size_t)line->levels * INDENT + line->length + line->pad;
}

static int has_tail(const rt_line *line)
{
    return line->length > 0 && line->comment.length > 0;
}

static void align_comments(rt_layout *layout, size_t from, size_t to)
{
    size_t column = 0;
    for (size_t i = from; i < to; i++)
        if (width(&layout->lines[i]) > column)
            column = width(&layout->lines[i]);
    for (size_t i = from; i < to; i++)
        layout->lines[i].comment_column = column + 2;
}

static void align(rt_layout *layout)
{
    size_t to;
    for (size_t i = 0; i < layout->line_count; i++)
        layout->lines[i].pad_at = pad_place(layout, &layout->lines[i]);
    for (size_t i = 0; i < layout->line_count; i = to) {
        for (to = i + 1; to < layout->line_count; to++)
            if (!are_alike(&layout->lines[to - 1], &layout->lines[to]))
                break;
        align_text(layout, i, to);
    }
    for (size_t i = 0; i < layout->line_count; i = to) {
        to = i + 1;
        if (!has_tail(&layout->lines[i]))
            continue;
        while (to < layout->line_count && has_tail(&layout->lines[to]) &&
               !layout->lines[to].is_after_blank)
            to++;
        align_comments(layout, i, to);
    }
}

/* ---- The whole ------------------------------------------------------------- */

static void write_line(rt_layout *out, const rt_layout *layout, const rt_line *line)
{
    const char *text = layout->text + line->text;
    if (line->is_after_blank)
        put(out, "\n", 1);
    put_spaces(out, (size_t)line->levels * INDENT);
    put(out, text, line->pad ? line->pad_at : line->length);
    if (line->pad) {
        put_spaces(out, line->pad);
        put(out, text + line->pad_at, line->length - line->pad_at);
    }
    if (has_tail(line))
        put_spaces(out, line->comment_column - width(line));
    put(out, line->comment.at, line->comment.length);
    put(out, "\n", 1);
}

char *rt_layout_finish(rt_layout *layout)
{
    rt_layout broken = {0}, out = {0};
    for (size_t i = 0; i < layout->line_count; i++) {
        const rt_line *line = &layout->lines[i];
        if (width(line) > COLUMNS && is_block(layout, line) && begins_with_field(layout, line))
            break_block(&broken, layout, line);
        else
            copy_line(&broken, layout, line);
    }
    broken.out_of_memory |= layout->out_of_memory;
    if (!broken.out_of_memory)
        align(&broken);
    for (size_t i = 0; i < broken.line_count && !broken.out_of_memory; i++)
        write_line(&out, &broken, &broken.lines[i]);
    put(&out, "", 1);
    if (broken.out_of_memory || out.out_of_memory) {
        free(out.text);
        out.text = NULL;
    }
    rt_layout_free(&broken);
    return out.text;
}

void rt_layout_free(rt_layout *layout)
{
    free(layout->text);
    free(layout->lines);
    free(layout->marks);
}
