/* message.c - errors, warnings, hints and notes on stderr, as text or as JSON. */
#include "message.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "status.h"
#include "utf8.h"

#define RED "\033[1;31m"
#define YELLOW "\033[1;33m"
#define CYAN "\033[1;36m"
#define GREEN "\033[1;32m"
#define BOLD "\033[1m"
#define PLAIN "\033[0m"

/* Longest part of a source line that is shown, and how much of it stands before the place. */
enum { EXCERPT = 110, EXCERPT_BEFORE = 70 };

/* The escape sequence on a terminal that wants colours (https://no-color.org), else nothing. */
static const char *colour(FILE *out, const char *escape)
{
    const char *no_color = getenv("NO_COLOR"), *term = getenv("TERM");
    int plain = out != stderr || (no_color && no_color[0]) || !term || strcmp(term, "dumb") == 0 ||
                !isatty(STDERR_FILENO);
    return plain ? "" : escape;
}

/*
 * Bytes of the character at text, where `length` bytes are left, or 0 when it must not reach a
 * terminal: a control character other than tab, or what is no UTF-8.
 */
static size_t character_size(const char *text, size_t length)
{
    const unsigned char *c = (const unsigned char *)text;
    const size_t size = utf8_size(text, length);
    if (size == 1)
        return (c[0] >= 0x20 && c[0] != 0x7f) || c[0] == '\t';
    return size == 2 && c[0] == 0xc2 && c[1] < 0xa0 ? 0 : size;
}

/* Prints text with '?' for each byte that could drive the terminal. */
static void put_safe(FILE *out, const char *text, size_t length)
{
    for (size_t i = 0, size; i < length; i += size ? size : 1) {
        size = character_size(text + i, length - i);
        if (size)
            fwrite(text + i, 1, size, out);
        else
            fputc('?', out);
    }
}

void message_put_name(const char *before, const char *name, const char *behind)
{
    fputs(before, stdout);
    if (isatty(STDOUT_FILENO))
        put_safe(stdout, name, strlen(name));
    else
        fputs(name, stdout);
    fputs(behind, stdout);
}

/* ---- Somebody else who listens ---------------------------------------------- */

static message_listener *listener;
static void *listener_user;

void message_listen(message_listener *heard, void *user)
{
    listener = heard;
    listener_user = user;
}

/* ---- Lines for a program ---------------------------------------------------- */

static int as_json;

void message_as_json(int is_json)
{
    /* A line goes out whole, so that a signal that speaks up does not cut one in two. */
    static char line[1 << 16];
    if (is_json)
        setvbuf(stderr, line, _IOLBF, sizeof line);
    as_json = is_json;
}

static void put_json(const char *name, const char *text)
{
    size_t length = strlen(text);
    fprintf(stderr, "\"%s\":\"", name);
    for (size_t i = 0, size; i < length; i += size ? size : 1) {
        size = character_size(text + i, length - i);
        if (text[i] == '"' || text[i] == '\\')
            fputc('\\', stderr);
        if (text[i] == '\t')
            fputs("\\t", stderr);
        else if (size)
            fwrite(text + i, 1, size, stderr);
        else
            fputc('?', stderr);
    }
    fputc('"', stderr);
}

static void put_json_message(const char *severity, const char *text)
{
    fputc('{', stderr);
    put_json("severity", severity);
    fputc(',', stderr);
    put_json("message", text);
    fputs("}\n", stderr);
}

/* ---- Messages ---------------------------------------------------------------- */

/* How a kind of message looks; severity is its name in JSON. */
typedef struct message_kind {
    const char *severity, *before, *escape, *label;
} message_kind;

static void put_message(const message_kind *kind, const char *format, va_list args)
{
    char text[2048];
    vsnprintf(text, sizeof text, format, args);
    if (listener)
        listener(listener_user, kind->severity, text);
    if (as_json) {
        put_json_message(kind->severity, text);
        return;
    }
    fprintf(stderr, "%s%s%s%s", kind->before, colour(stderr, kind->escape), kind->label,
            colour(stderr, PLAIN));
    put_safe(stderr, text, strlen(text));
    fputc('\n', stderr);
}

void message_error(const char *format, ...)
{
    static const message_kind kind = {"error", "rtc: ", RED, "error: "};
    va_list args;
    va_start(args, format);
    put_message(&kind, format, args);
    va_end(args);
}

void message_warning(const char *format, ...)
{
    static const message_kind kind = {"warning", "rtc: ", YELLOW, "warning: "};
    va_list args;
    va_start(args, format);
    put_message(&kind, format, args);
    va_end(args);
}

void message_hint(const char *format, ...)
{
    static const message_kind kind = {"hint", "  ", CYAN, "hint: "};
    va_list args;
    va_start(args, format);
    put_message(&kind, format, args);
    va_end(args);
}

void message_hint_constant(const char *field, const char *block, const char *option,
                           const char *values)
{
    message_hint("'%s' is a field of %s: 'let %s = VALUE' in the scene, and '%s { ... %s (%s) }', "
                 "make it a constant, for %s %s=%s",
                 field, block, field, block, field, field, option, field, values);
}

void message_note(const char *format, ...)
{
    static const message_kind kind = {"note", "", "", ""};
    va_list args;
    va_start(args, format);
    put_message(&kind, format, args);
    va_end(args);
}

/* ---- Diagnostics --------------------------------------------------------- */

/* Spaces, or `fill`, as wide as put_safe prints text; a tab stays one. */
static void put_blank(FILE *out, const char *text, size_t length, char fill)
{
    for (size_t i = 0, size; i < length; i += size ? size : 1) {
        size = character_size(text + i, length - i);
        fputc(text[i] == '\t' && fill == ' ' ? '\t' : fill, out);
    }
}

static int is_continuation(char c)
{
    return ((unsigned char)c & 0xc0) == 0x80;
}

/* The source line, cut to a window around the place when it is long, and the place underlined. */
static void put_excerpt(FILE *out, const char *line, size_t at, size_t marked)
{
    size_t length = strlen(line);
    if (at > length)
        at = length;
    size_t first = at > EXCERPT_BEFORE && length > EXCERPT ? at - EXCERPT_BEFORE : 0;
    while (first > 0 && is_continuation(line[first]))
        first--;
    size_t end = length - first > EXCERPT ? first + EXCERPT : length;
    while (end < length && is_continuation(line[end]))
        end++;
    const char *lead = first > 0 ? "..." : "";

    fprintf(out, "    %s", lead);
    put_safe(out, line + first, end - first);
    fprintf(out, "%s\n    %*s", end < length ? "..." : "", (int)strlen(lead), "");
    put_blank(out, line + first, at - first, ' ');
    fprintf(out, "%s^", colour(out, GREEN));
    if (marked > end - at)
        marked = end - at;
    size_t head = marked ? character_size(line + at, end - at) : 0;
    head = head ? head : 1;
    if (marked > head)
        put_blank(out, line + at + head, marked - head, '~');
    fprintf(out, "%s\n", colour(out, PLAIN));
}

static const char *const severities[] = {"error", "warning", "note"};

static void put_json_diagnostic(const rt_diagnostic *diagnostic)
{
    fputc('{', stderr);
    put_json("severity", severities[diagnostic->severity]);
    fputc(',', stderr);
    put_json("file", diagnostic->file);
    fprintf(stderr, ",\"line\":%d,\"column\":%d,", diagnostic->line, diagnostic->column);
    put_json("message", diagnostic->message);
    if (diagnostic->hint) {
        fputc(',', stderr);
        put_json("hint", diagnostic->hint);
    }
    fputs("}\n", stderr);
}

static void put_text_diagnostic(FILE *out, const rt_diagnostic *diagnostic)
{
    static const char *const labels[] = {"error: ", "warning: ", "note: "}, *const colours[] = {
                                                                                RED, YELLOW, CYAN};
    if (diagnostic->column == 0) { /* as any other message of a file */
        fprintf(out, "rtc: %s%s%s", colour(out, colours[diagnostic->severity]),
                labels[diagnostic->severity], colour(out, PLAIN));
        put_safe(out, diagnostic->file, strlen(diagnostic->file));
        if (diagnostic->line > 0)
            fprintf(out, ":%d", diagnostic->line);
        fputs(": ", out);
        put_safe(out, diagnostic->message, strlen(diagnostic->message));
        fputc('\n', out);
        return;
    }
    fputs(colour(out, BOLD), out);
    put_safe(out, diagnostic->file, strlen(diagnostic->file));
    fprintf(out, ":%d:%d", diagnostic->line, diagnostic->column);
    fprintf(out, ": %s%s%s%s", colour(out, PLAIN), colour(out, colours[diagnostic->severity]),
            labels[diagnostic->severity], colour(out, PLAIN));
    put_safe(out, diagnostic->message, strlen(diagnostic->message));
    fputc('\n', out);
    if (diagnostic->source_line)
        put_excerpt(out, diagnostic->source_line, (size_t)diagnostic->column - 1,
                    diagnostic->length > 0 ? (size_t)diagnostic->length : 1);
}

void message_of_log(void *user, const char *line)
{
    (void)user;
    message_note("%s", line);
}

void message_of_warning(void *user, const char *line)
{
    (void)user;
    message_warning("%s", line);
}

/* Tells the listener of a diagnostic, as the terminal shows it. */
static void tell_listener(const rt_diagnostic *diagnostic)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return;
    put_text_diagnostic(out, diagnostic);
    if (fclose(out) == 0 && size > 0) {
        text[size - 1] = '\0'; /* the newline */
        listener(listener_user, severities[diagnostic->severity], text);
        if (diagnostic->hint && as_json)
            listener(listener_user, "hint", diagnostic->hint);
    }
    free(text);
}

void message_diagnostic(const rt_diagnostic *diagnostic)
{
    if (listener)
        tell_listener(diagnostic);
    if (as_json)
        put_json_diagnostic(diagnostic);
    else
        put_text_diagnostic(stderr, diagnostic);
    if (diagnostic->hint && !as_json)
        message_hint("%s", diagnostic->hint);
}

/* ---- Failures of the library --------------------------------------------- */

int message_status(rt_status status)
{
    switch (status) {
    case RT_OK:
        return STATUS_DONE;
    case RT_ERROR_INPUT:
        return STATUS_INPUT;
    case RT_ERROR_USAGE:
        return STATUS_USAGE;
    case RT_ERROR_OUTPUT:
        return STATUS_OUTPUT;
    case RT_CANCELLED:
        return STATUS_INTERRUPTED;
    case RT_ERROR_DEVICE:
    case RT_ERROR_MEMORY:
        break;
    }
    return STATUS_DEVICE;
}

int message_failure(const rt_error *error)
{
    char place[sizeof error->file + 32] = "";
    if (error->file[0] && error->line && error->column)
        snprintf(place, sizeof place, "%s:%d:%d: ", error->file, error->line, error->column);
    else if (error->file[0] && error->line)
        snprintf(place, sizeof place, "%s:%d: ", error->file, error->line);
    else if (error->file[0] && !strstr(error->message, error->file))
        snprintf(place, sizeof place, "%s: ", error->file);
    message_error("%s%s", place, error->message);
    if (error->status == RT_ERROR_DEVICE && strcmp(error->field, "device") == 0)
        message_hint("`rtc devices` lists them");
    else if (error->status == RT_ERROR_DEVICE)
        message_hint("`rtc doctor` checks OpenCL step by step and says what to install");
    return message_status(error->status);
}

int message_finish_stdout(void)
{
    errno = 0;
    int failed = fflush(stdout) != 0 || ferror(stdout);
    /* A reader that has gone, as in `rtc --help | head`, chose to. */
    if (!failed || errno == EPIPE)
        return STATUS_DONE;
    message_error("cannot write to stdout%s%s", errno ? ": " : "", errno ? strerror(errno) : "");
    return STATUS_OUTPUT;
}
