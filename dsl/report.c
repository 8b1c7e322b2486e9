/* report.c - orders reports by place, adds hints and hands them on. */
#include "dsl/report.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A message is one line, whatever is quoted in it: a file's name may have a carriage return. */
static void write_line(char *out, size_t size, const char *format, va_list args)
{
    vsnprintf(out, size, format, args);
    for (char *c = out; *c; c++)
        if (*c == '\r' || *c == '\n')
            *c = ' ';
}

static void put_line(char *out, size_t size, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    write_line(out, size, format, args);
    va_end(args);
}

static rt_report *add_report(rt_reports *reports, rt_place place)
{
    reports->is_left_out = 0;
    if (reports->count == reports->capacity) {
        size_t capacity = reports->capacity ? 2 * reports->capacity : 16;
        rt_report *items = realloc(reports->items, capacity * sizeof *items);
        if (!items) {
            reports->out_of_memory = 1;
            return NULL;
        }
        reports->items = items;
        reports->capacity = capacity;
    }
    rt_report *report = &reports->items[reports->count++];
    memset(report, 0, sizeof *report);
    report->place = place;
    report->sequence = reports->count;
    return report;
}

void rt_report_error(rt_reports *reports, rt_place place, const char *format, ...)
{
    rt_report *report = add_report(reports, place);
    if (!report)
        return;
    reports->errors++;
    va_list args;
    va_start(args, format);
    write_line(report->message, sizeof report->message, format, args);
    va_end(args);
}

void rt_report_warning(rt_reports *reports, rt_place place, const char *format, ...)
{
    if (reports->warnings == RT_REPORTS_MAX) {
        reports->left_out++;
        reports->is_left_out = 1;
        return;
    }
    rt_report *report = add_report(reports, place);
    if (!report)
        return;
    reports->warnings++;
    report->severity = RT_SEVERITY_WARNING;
    va_list args;
    va_start(args, format);
    write_line(report->message, sizeof report->message, format, args);
    va_end(args);
}

void rt_report_finding(rt_reports *reports, rt_place place, const rt_finding *finding)
{
    rt_report *report = add_report(reports, place);
    if (!report)
        return;
    report->severity = finding->severity;
    report->finding = finding->kind;
    snprintf(report->message, sizeof report->message, "%s", finding->message);
}

void rt_report_hint(rt_reports *reports, const char *format, ...)
{
    if (reports->out_of_memory || reports->count == 0 || reports->is_left_out)
        return;
    rt_report *report = &reports->items[reports->count - 1];
    va_list args;
    va_start(args, format);
    write_line(report->hint, sizeof report->hint, format, args);
    va_end(args);
}

void rt_report_unknown(rt_reports *reports, const rt_names *table)
{
    if (!reports->out_of_memory && reports->count > 0)
        reports->items[reports->count - 1].table = table;
}

int rt_reports_full(const rt_reports *reports)
{
    return reports->out_of_memory || reports->errors >= RT_REPORTS_MAX;
}

static int compare_reports(const void *a, const void *b)
{
    const rt_place *x = &((const rt_report *)a)->place, *y = &((const rt_report *)b)->place;
    if (x->order != y->order)
        return x->order < y->order ? -1 : 1;
    if (x->offset != y->offset)
        return x->offset < y->offset ? -1 : 1;
    size_t i = ((const rt_report *)a)->sequence, j = ((const rt_report *)b)->sequence;
    return (i > j) - (i < j);
}

/* The texture that names another at this place of the text, inside of this one; or NULL. */
static const rt_name *circle(const rt_names *table, const rt_name *name, const char *use,
                             int *steps)
{
    for (int i = 0; i < RT_NAME_INSIDE && (*steps)-- > 0; i++) {
        if (name->inside[i].at == use)
            return name;
        const size_t found =
            name->inside[i].at ? rt_names_find(table, name->inside[i]) : RT_NAME_NONE;
        const rt_name *inner =
            found == RT_NAME_NONE ? NULL : circle(table, &table->items[found], use, steps);
        if (inner)
            return inner;
    }
    return NULL;
}

/* A name that was unknown where it stood may be defined by now: say so. */
static void hint_at_later_definition(rt_report *report)
{
    size_t found =
        report->table ? rt_names_find(report->table, rt_place_text(&report->place)) : RT_NAME_NONE;
    if (found == RT_NAME_NONE)
        return;
    const rt_name *const name = &report->table->items[found];
    const rt_place *place = &name->place;
    int steps = 100;
    const rt_name *inner = circle(report->table, name, rt_place_text(&report->place).at, &steps);
    if (inner) {
        char quote[2][RT_QUOTE_SIZE];
        put_line(report->hint, sizeof report->hint,
                 "'%s' lies inside of '%s', at %s:%d: textures cannot lie inside of each other",
                 rt_text_quote(quote[0], inner->text), rt_text_quote(quote[1], name->text),
                 place->source->path, place->line);
        return;
    }
    if (place->source == report->place.source && place->offset < report->place.offset) {
        char quote[RT_QUOTE_SIZE];
        put_line(report->hint, sizeof report->hint, "'%s' cannot name itself",
                 rt_text_quote(quote, name->text));
        return;
    }
    put_line(report->hint, sizeof report->hint,
             "it is defined further down, at %s:%d; define it before its use", place->source->path,
             place->line);
}

/*
 * The line around a place, cut out of the text in place: *end is set to NUL and its byte returned
 * in *kept.
 */
static const char *cut_line(const rt_place *place, char **end, char *kept)
{
    char *text = place->source->text;
    char *start = text + place->offset - (place->line > 0 ? place->column - 1 : 0);
    char *stop = memchr(start, '\n', (size_t)(text + place->source->size - start));
    if (!stop)
        stop = text + place->source->size;
    else if (stop > start && stop[-1] == '\r')
        stop--;
    *end = stop;
    *kept = *stop;
    *stop = '\0';
    return start;
}

static void hand_on(const rt_report *report, const rt_load_options *options)
{
    char *end, kept;
    rt_diagnostic diagnostic;
    memset(&diagnostic, 0, sizeof diagnostic);
    diagnostic.severity = report->severity;
    diagnostic.finding = report->finding;
    diagnostic.file = report->place.source->path;
    diagnostic.line = report->place.line;
    diagnostic.column = report->place.column;
    diagnostic.length = report->place.length > 0 ? report->place.length : 1;
    diagnostic.message = report->message;
    diagnostic.hint = report->hint[0] ? report->hint : NULL;
    diagnostic.source_line = cut_line(&report->place, &end, &kept);
    options->diagnostic(options->user, &diagnostic);
    *end = kept;
}

static void fill_error(rt_error *error, const rt_report *first, size_t errors)
{
    memset(error, 0, sizeof *error);
    error->status = RT_ERROR_INPUT;
    error->line = first->place.line;
    error->column = first->place.column;
    snprintf(error->file, sizeof error->file, "%s", first->place.source->path);
    if (errors > 1)
        snprintf(error->message, sizeof error->message, "%s (and %zu more)", first->message,
                 errors - 1);
    else
        snprintf(error->message, sizeof error->message, "%s", first->message);
}

rt_status rt_reports_finish(rt_reports *reports, const rt_load_options *options, rt_error *error)
{
    if (reports->count > 1)
        qsort(reports->items, reports->count, sizeof *reports->items, compare_reports);
    if (reports->errors >= RT_REPORTS_MAX)
        rt_report_error(reports, reports->items[reports->count - 1].place,
                        "too many errors: reading stopped here");
    if (reports->left_out > 0) {
        reports->warnings = 0;
        rt_report_warning(reports, reports->items[reports->count - 1].place,
                          "too many warnings: %zu more are left out", reports->left_out);
    }
    if (reports->out_of_memory) {
        if (error) {
            memset(error, 0, sizeof *error);
            error->status = RT_ERROR_MEMORY;
            snprintf(error->message, sizeof error->message,
                     "memory is exhausted while reading the scene");
        }
        return RT_ERROR_MEMORY;
    }

    const rt_report *first = NULL;
    for (size_t i = 0; i < reports->count; i++) {
        rt_report *report = &reports->items[i];
        hint_at_later_definition(report);
        if (!first && report->severity == RT_SEVERITY_ERROR)
            first = report;
        if (options && options->diagnostic)
            hand_on(report, options);
    }
    if (first && error)
        fill_error(error, first, reports->errors);
    return first ? RT_ERROR_INPUT : RT_OK;
}

void rt_reports_free(rt_reports *reports)
{
    free(reports->items);
    memset(reports, 0, sizeof *reports);
}
