/* ply_reader.c - reads values and lists, each checked against the bytes that are left. */
#include "mesh/ply_reader.h"

#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "mesh/colour.h"

rt_ply_reader rt_ply_reader_begin(const rt_mesh_source *source, const rt_ply_header *header)
{
    rt_ply_reader reader = {.source = source, .format = header->format, .text = header->body};
    reader.at = (const uint8_t *)header->body.at;
    reader.end = source->data + source->size;
    return reader;
}

int rt_ply_is_native(rt_ply_format format)
{
    const uint16_t one = 1;
    uint8_t first;
    memcpy(&first, &one, 1);
    return format == (first ? RT_PLY_LITTLE_ENDIAN : RT_PLY_BIG_ENDIAN);
}

double rt_ply_decode(const uint8_t *at, rt_ply_type type, int native)
{
    uint8_t bytes[8];
    size_t size = rt_ply_size(type);
    for (size_t i = 0; i < size; i++)
        bytes[i] = at[native ? i : size - 1 - i];
    union {
        int8_t i8;
        uint8_t u8;
        int16_t i16;
        uint16_t u16;
        int32_t i32;
        uint32_t u32;
        float f32;
        double f64;
    } value;
    memcpy(&value, bytes, size);
    switch (type) {
    case RT_PLY_INT8:
        return value.i8;
    case RT_PLY_UINT8:
        return value.u8;
    case RT_PLY_INT16:
        return value.i16;
    case RT_PLY_UINT16:
        return value.u16;
    case RT_PLY_INT32:
        return value.i32;
    case RT_PLY_UINT32:
        return value.u32;
    case RT_PLY_FLOAT32:
        return value.f32;
    case RT_PLY_FLOAT64:
        break;
    }
    return value.f64;
}

rt_status rt_ply_fail(const rt_ply_reader *r, const char *format, ...)
{
    char message[256], element[RT_QUOTE], property[RT_QUOTE];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    return rt_mesh_fail(r->source, r->format == RT_PLY_ASCII ? r->text.line : 0,
                        "%s %llu of %llu%s%s: %s", rt_token_quote(r->element->name, element),
                        (unsigned long long)r->row, (unsigned long long)r->element->count,
                        r->property ? ", " : "",
                        r->property ? rt_token_quote(r->property->name, property) : "", message);
}

rt_status rt_ply_refuse(const rt_ply_reader *r, double value, double largest)
{
    return fabs(value) <= FLT_MAX ? rt_ply_fail(r, "the colour %.9g is %s", value,
                                                rt_mesh_colour_fault(value, largest))
                                  : rt_ply_fail(r, "%g is not a finite float", value);
}

/* The least bytes that a value takes in the file. */
static uint64_t least_size(const rt_ply_reader *r, rt_ply_type type)
{
    /* in ascii, a digit and white space */
    return r->format == RT_PLY_ASCII ? 2 : rt_ply_size(type);
}

/* Bytes left, with one more for the white space that the last line of an ascii file may lack. */
static uint64_t bytes_left(const rt_ply_reader *r)
{
    return r->format == RT_PLY_ASCII ? (uint64_t)(r->text.end - r->text.at) + 1
                                     : (uint64_t)(r->end - r->at);
}

rt_status rt_ply_enter(rt_ply_reader *r, const rt_ply_element *element)
{
    char quote[RT_QUOTE];
    uint64_t least = 0;
    r->element = element;
    r->row = 0;
    r->property = NULL;
    for (size_t i = 0; i < element->property_count; i++) {
        const rt_ply_property *property = &element->properties[i];
        least += least_size(r, property->is_list ? property->count_type : property->type);
    }
    if (least && element->count > bytes_left(r) / least)
        return rt_mesh_fail(r->source, element->line,
                            "element %s: %llu of them do not fit in the %llu bytes that follow",
                            rt_token_quote(element->name, quote),
                            (unsigned long long)element->count, (unsigned long long)bytes_left(r));
    return RT_OK;
}

static rt_status cut_short(const rt_ply_reader *r)
{
    return rt_ply_fail(r, "the file ends here");
}

static rt_status ascii_value(rt_ply_reader *r, rt_ply_type type, double *out)
{
    char quote[RT_QUOTE];
    rt_token token;
    if (!rt_mesh_text_any(&r->text, &token))
        return cut_short(r);
    if (rt_ply_is_float(type))
        return rt_token_real(token, out)
                   ? RT_OK
                   : rt_ply_fail(r, "'%s' is not a number", rt_token_quote(token, quote));
    int64_t value;
    if (!rt_token_integer(token, &value) || value < rt_ply_least(type) ||
        value > rt_ply_greatest(type))
        return rt_ply_fail(r, "'%s' is not a whole number from %lld to %lld",
                           rt_token_quote(token, quote), (long long)rt_ply_least(type),
                           (long long)rt_ply_greatest(type));
    *out = (double)value;
    return RT_OK;
}

rt_status rt_ply_value(rt_ply_reader *r, rt_ply_type type, double *out)
{
    if (r->format == RT_PLY_ASCII)
        return ascii_value(r, type, out);
    if ((size_t)(r->end - r->at) < rt_ply_size(type))
        return cut_short(r);
    *out = rt_ply_decode(r->at, type, rt_ply_is_native(r->format));
    r->at += rt_ply_size(type);
    return RT_OK;
}

rt_status rt_ply_finite(rt_ply_reader *r, rt_ply_type type, float *out)
{
    double value;
    rt_status status = rt_ply_value(r, type, &value);
    if (status != RT_OK)
        return status;
    if (!(fabs(value) <= FLT_MAX))
        return rt_ply_refuse(r, value, 0);
    *out = (float)value;
    return RT_OK;
}

rt_status rt_ply_list(rt_ply_reader *r, const rt_ply_property *property, uint64_t *count)
{
    double value;
    r->property = property;
    rt_status status = rt_ply_value(r, property->count_type, &value);
    if (status != RT_OK)
        return status;
    if (value < 0)
        return rt_ply_fail(r, "a list of %.0f values", value);
    if (value > (double)(bytes_left(r) / least_size(r, property->type)))
        return rt_ply_fail(r, "a list of %.0f values, but only %llu bytes follow", value,
                           (unsigned long long)bytes_left(r));
    *count = (uint64_t)value;
    return RT_OK;
}

rt_status rt_ply_skip(rt_ply_reader *r, const rt_ply_property *property)
{
    uint64_t count = 1;
    double ignored;
    rt_status status = RT_OK;
    r->property = property;
    if (property->is_list && (status = rt_ply_list(r, property, &count)) != RT_OK)
        return status;
    if (r->format != RT_PLY_ASCII && property->is_list) {
        r->at += (size_t)count * rt_ply_size(property->type);
        return RT_OK;
    }
    for (uint64_t i = 0; i < count && status == RT_OK; i++)
        status = rt_ply_value(r, property->type, &ignored);
    return status;
}

rt_status rt_ply_end_row(rt_ply_reader *r)
{
    char quote[RT_QUOTE];
    rt_token extra;
    r->property = NULL;
    if (r->format == RT_PLY_ASCII && r->element->property_count &&
        rt_mesh_text_token(&r->text, &extra))
        return rt_ply_fail(r, "'%s' is one value more than the header announces",
                           rt_token_quote(extra, quote));
    /* Report now and then. */
    if ((++r->row & 0xffff) == 0) {
        const uint8_t *at = r->format == RT_PLY_ASCII ? (const uint8_t *)r->text.at : r->at;
        return rt_mesh_step(r->source, (uint64_t)(at - r->source->data), r->source->size);
    }
    return RT_OK;
}

int rt_ply_end(rt_ply_reader *r)
{
    rt_token token;
    const uint8_t *at = r->at;
    if (r->format == RT_PLY_ASCII && rt_mesh_text_any(&r->text, &token)) {
        rt_mesh_log(r->source, "what follows the last element, from line %zu on, is ignored",
                    r->text.line);
        return 1;
    }
    if (r->format == RT_PLY_ASCII || at == r->end)
        return 0;
    rt_mesh_log(r->source, "%zu bytes after the last element are ignored", (size_t)(r->end - at));
    while (at < r->end && (*at == '\n' || *at == '\r' || *at == ' ' || *at == 0))
        at++;
    return at < r->end;
}
