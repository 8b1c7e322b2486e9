/* json.c - a checker of JSON, by recursive descent. */
#include "fuzz/json.h"

#include <ctype.h>
#include <string.h>

enum { depth_max = 64 };

/* A place in a text; NULL once it is no JSON. */
typedef struct cursor {
    const char *at;
    int depth;
} cursor;

static void value(cursor *c);

static void skip_space(cursor *c)
{
    while (c->at && (*c->at == ' ' || *c->at == '\t'))
        c->at++;
}

/* Passes over a text, which must come next. */
static void expect(cursor *c, const char *text)
{
    size_t length = strlen(text);
    if (c->at)
        c->at = strncmp(c->at, text, length) == 0 ? c->at + length : NULL;
}

static void string(cursor *c)
{
    expect(c, "\"");
    while (c->at && *c->at != '"') {
        if ((unsigned char)*c->at < 0x20)
            c->at = NULL;
        else if (*c->at != '\\')
            c->at++;
        else if (strchr("\"\\/bfnrt", c->at[1]) && c->at[1])
            c->at += 2;
        else if (c->at[1] == 'u' && strspn(c->at + 2, "0123456789abcdefABCDEF") >= 4)
            c->at += 6;
        else
            c->at = NULL;
    }
    expect(c, "\"");
}

static void digits(cursor *c)
{
    if (c->at && !isdigit((unsigned char)*c->at))
        c->at = NULL;
    while (c->at && isdigit((unsigned char)*c->at))
        c->at++;
}

static void number(cursor *c)
{
    c->at += *c->at == '-';
    if (*c->at == '0')
        c->at++;
    else
        digits(c);
    if (c->at && *c->at == '.') {
        c->at++;
        digits(c);
    }
    if (c->at && (*c->at == 'e' || *c->at == 'E')) {
        c->at++;
        c->at += *c->at == '+' || *c->at == '-';
        digits(c);
    }
}

/* Members or elements up to the closing bracket. */
static void list(cursor *c, int has_names, const char *close)
{
    c->at++;
    if (++c->depth > depth_max)
        c->at = NULL;
    skip_space(c);
    if (c->at && *c->at == *close) {
        c->at++;
        c->depth--;
        return;
    }
    for (;;) {
        skip_space(c);
        if (has_names) {
            string(c);
            skip_space(c);
            expect(c, ":");
        }
        value(c);
        if (!c->at || *c->at != ',')
            break;
        c->at++;
    }
    expect(c, close);
    c->depth--;
}

static void value(cursor *c)
{
    skip_space(c);
    if (!c->at)
        return;
    if (*c->at == '{')
        list(c, 1, "}");
    else if (*c->at == '[')
        list(c, 0, "]");
    else if (*c->at == '"')
        string(c);
    else if (*c->at == '-' || isdigit((unsigned char)*c->at))
        number(c);
    else
        expect(c, *c->at == 't' ? "true" : *c->at == 'f' ? "false" : "null");
    skip_space(c);
}

int fuzz_is_json_lines(const char *text)
{
    cursor c = {text, 0};
    while (c.at && *c.at) {
        if (*c.at != '{' && *c.at != '\n')
            return 0;
        if (*c.at == '{')
            value(&c);
        expect(&c, "\n");
    }
    return c.at != NULL;
}
