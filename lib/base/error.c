/* error.c - fills the error that a failing call leaves to its caller. */
#include "base/error.h"

#include <stdio.h>
#include <string.h>

void rt_write_line(char *out, size_t size, const char *format, va_list args)
{
    vsnprintf(out, size, format, args);
    for (char *c = out; *c; c++)
        if (*c == '\n' || *c == '\r')
            *c = ' ';
}

static void fill(rt_error *error, rt_status status, const char *field, const char *format,
                 va_list args)
{
    memset(error, 0, sizeof *error);
    error->status = status;
    if (field)
        snprintf(error->field, sizeof error->field, "%s", field);
    rt_write_line(error->message, sizeof error->message, format, args);
}

rt_status rt_fail(rt_error *error, rt_status status, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    if (error)
        fill(error, status, NULL, format, args);
    va_end(args);
    return status;
}

rt_status rt_fail_field(rt_error *error, rt_status status, const char *field, const char *format,
                        ...)
{
    va_list args;
    va_start(args, format);
    if (error)
        fill(error, status, field, format, args);
    va_end(args);
    return status;
}

rt_status rt_at_file(rt_status status, const char *path, rt_error *error)
{
    if (status != RT_OK && status != RT_ERROR_USAGE && error && !error->file[0])
        snprintf(error->file, sizeof error->file, "%s", path);
    return status;
}

int rt_is_missing(const void *pointer, const char *name, rt_error *error)
{
    if (!pointer)
        rt_fail_field(error, RT_ERROR_USAGE, name, "%s is NULL", name);
    return pointer == NULL;
}

const char *rt_cause(char out[RT_CAUSE_SIZE], int code)
{
    if (strerror_r(code, out, RT_CAUSE_SIZE) != 0)
        snprintf(out, RT_CAUSE_SIZE, "error %d", code);
    return out;
}
