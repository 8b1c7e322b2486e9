/* collect.c - parses a text and keeps its diagnostics. */
#include "tests/dsl/collect.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void keep(void *user, const rt_diagnostic *diagnostic)
{
    collected *c = user;
    c->errors += diagnostic->severity == RT_SEVERITY_ERROR;
    if (c->count < COLLECTED_MAX) {
        collected_diagnostic *d = &c->items[c->count];
        d->severity = diagnostic->severity;
        d->finding = diagnostic->finding;
        d->line = diagnostic->line;
        d->column = diagnostic->column;
        d->length = diagnostic->length;
        snprintf(d->file, sizeof d->file, "%s", diagnostic->file);
        snprintf(d->message, sizeof d->message, "%s", diagnostic->message);
        snprintf(d->hint, sizeof d->hint, "%s", diagnostic->hint ? diagnostic->hint : "");
        snprintf(d->source_line, sizeof d->source_line, "%s", diagnostic->source_line);
    }
    c->count++;
}

void collect_text(collected *out, const char *text)
{
    rt_load_options options = {.diagnostic = keep, .user = out};
    memset(out, 0, sizeof *out);
    out->status = rt_scene_parse(&out->scene, text, "text", &options, &out->error);
}

void check_text(collected *out, const char *text)
{
    rt_load_options options = {.diagnostic = keep, .user = out, .check = 1};
    memset(out, 0, sizeof *out);
    out->status = rt_scene_parse(&out->scene, text, "text", &options, &out->error);
}

void collect_file(collected *out, const char *path)
{
    rt_load_options options = {.diagnostic = keep, .user = out};
    memset(out, 0, sizeof *out);
    out->status = rt_scene_load(&out->scene, path, &options, &out->error);
}

void collected_free(collected *c)
{
    rt_scene_destroy(c->scene);
    c->scene = NULL;
}

void expect_clean(const collected *c, const char *text)
{
    if (c->count > 0)
        fail_msg("%s:%d:%d: %s\nin:\n%s", c->items[0].file, c->items[0].line, c->items[0].column,
                 c->items[0].message, text);
    assert_int_equal(c->status, RT_OK);
    assert_non_null(c->scene);
}

char *read_text(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        fail_msg("cannot open %s; tests run in the top directory of the sources", path);
    size_t size = 0, capacity = 1 << 20;
    char *text = malloc(capacity + 1);
    assert_non_null(text);
    size = fread(text, 1, capacity, file);
    fclose(file);
    assert_true(size < capacity);
    text[size] = '\0';
    return text;
}
