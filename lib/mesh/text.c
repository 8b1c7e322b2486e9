/* text.c - lines and tokens of a text in memory. */
#include "mesh/text.h"

#include <string.h>

rt_mesh_text rt_mesh_text_begin(const void *data, size_t size)
{
    rt_mesh_text text = {data, (const char *)data + size, 1, '\n', 0, 0};
    const char *end = text.at;
    while (end < text.end && *end != '\n' && *end != '\r')
        end++;
    if (end < text.end && *end == '\r' && (end + 1 == text.end || end[1] != '\n'))
        text.newline = '\r';
    return text;
}

static int is_space(char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/* Whether a backslash here, with nothing but white space after it, joins the next line. */
static int is_continued(const rt_mesh_text *text, const char **next)
{
    const char *c = text->at + 1;
    if (!text->continued || *text->at != '\\')
        return 0;
    while (c < text->end && *c != text->newline && is_space(*c))
        c++;
    if (c == text->end || *c != text->newline)
        return 0;
    *next = c + 1;
    return 1;
}

static void skip_space(rt_mesh_text *text)
{
    const char *next;
    while (text->at < text->end) {
        if (is_space(*text->at) && *text->at != text->newline) {
            text->at++;
        } else if (is_continued(text, &next)) {
            text->at = next;
            text->line++;
        } else {
            return;
        }
    }
}

int rt_mesh_text_token(rt_mesh_text *text, rt_token *out)
{
    skip_space(text);
    const char *start = text->at;
    const char *next;
    if (start == text->end || *start == text->newline || (text->comments && *start == '#'))
        return 0;
    while (text->at < text->end && !is_space(*text->at) && !(text->comments && *text->at == '#') &&
           !is_continued(text, &next))
        text->at++;
    out->at = start;
    out->length = (size_t)(text->at - start);
    return 1;
}

/* The byte that ends the line, or NULL at the end of the text. A comment is never continued. */
static const char *line_end(rt_mesh_text *text)
{
    while (text->continued && text->at < text->end && *text->at != text->newline &&
           !(text->comments && *text->at == '#')) {
        const char *next = text->at + 1;
        if (is_continued(text, &next))
            text->line++;
        text->at = next;
    }
    return text->at < text->end ? memchr(text->at, text->newline, (size_t)(text->end - text->at))
                                : NULL;
}

int rt_mesh_text_line(rt_mesh_text *text)
{
    const char *end = line_end(text);
    text->at = end ? end + 1 : text->end;
    text->line += end != NULL;
    return end != NULL;
}

int rt_mesh_text_any(rt_mesh_text *text, rt_token *out)
{
    while (!rt_mesh_text_token(text, out))
        if (!rt_mesh_text_line(text))
            return 0;
    return 1;
}

rt_token rt_mesh_text_rest(rt_mesh_text *text)
{
    skip_space(text);
    rt_token rest = {text->at, 0};
    while (text->at < text->end && *text->at != text->newline)
        text->at++;
    rest.length = (size_t)(text->at - rest.at);
    while (rest.length && is_space(rest.at[rest.length - 1]))
        rest.length--;
    return rest;
}

int rt_token_is(rt_token token, const char *word)
{
    return token.length == strlen(word) && memcmp(token.at, word, token.length) == 0;
}

const char *rt_token_quote(rt_token token, char buffer[RT_QUOTE])
{
    size_t room = RT_QUOTE - 4, length = token.length < room ? token.length : room;
    for (size_t i = 0; i < length; i++)
        buffer[i] = token.at[i] >= ' ' && token.at[i] <= '~' ? token.at[i] : '?';
    strcpy(buffer + length, length < token.length ? "..." : "");
    return buffer;
}
