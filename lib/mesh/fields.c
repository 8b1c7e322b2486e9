/* fields.c - reads and checks the numbers of a line, and appends them to lists. */
#include "mesh/fields.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Makes room for `more` elements after count, growing by at least a half. */
static rt_status grow(void **data, size_t *room, size_t count, size_t more, size_t size,
                      const rt_mesh_source *source)
{
    if (more <= *room - count)
        return RT_OK;
    return rt_memory_grow(source->memory, data, room, count + more, size, "a mesh", source->error);
}

rt_status rt_floats_add(rt_floats *list, const rt_mesh_source *source, const float *values,
                        size_t count)
{
    rt_status status =
        grow((void **)&list->data, &list->room, list->count, count, sizeof *list->data, source);
    if (status != RT_OK)
        return status;
    memcpy(list->data + list->count, values, count * sizeof *values);
    list->count += count;
    return RT_OK;
}

void rt_floats_free(rt_floats *list)
{
    rt_memory_free(list->data);
    memset(list, 0, sizeof *list);
}

rt_status rt_doubles_add(rt_doubles *list, const rt_mesh_source *source, const double *values,
                         size_t count)
{
    rt_status status =
        grow((void **)&list->data, &list->room, list->count, count, sizeof *list->data, source);
    if (status != RT_OK)
        return status;
    memcpy(list->data + list->count, values, count * sizeof *values);
    list->count += count;
    return RT_OK;
}

void rt_doubles_free(rt_doubles *list)
{
    rt_memory_free(list->data);
    memset(list, 0, sizeof *list);
}

rt_status rt_indices_add(rt_indices *list, const rt_mesh_source *source, uint32_t index)
{
    rt_status status =
        grow((void **)&list->data, &list->room, list->count, 1, sizeof *list->data, source);
    if (status == RT_OK)
        list->data[list->count++] = index;
    return status;
}

void rt_indices_free(rt_indices *list)
{
    rt_memory_free(list->data);
    memset(list, 0, sizeof *list);
}

static rt_status read_real(const rt_mesh_source *source, const rt_mesh_text *text, rt_token token,
                           const char *what, int is_finite, double *out)
{
    char quote[RT_QUOTE];
    double value;
    if (!rt_token_real(token, &value))
        return rt_mesh_fail(source, text->line, "%s: '%s' is not a number", what,
                            rt_token_quote(token, quote));
    if (is_finite && !(fabs(value) <= FLT_MAX))
        return rt_mesh_fail(source, text->line, "%s: '%s' is not a finite float", what,
                            rt_token_quote(token, quote));
    *out = value;
    return RT_OK;
}

rt_status rt_field_double(const rt_mesh_source *source, const rt_mesh_text *text, rt_token token,
                          const char *what, double *out)
{
    return read_real(source, text, token, what, 1, out);
}

rt_status rt_field_float(const rt_mesh_source *source, const rt_mesh_text *text, rt_token token,
                         const char *what, float *out)
{
    double value = 0;
    rt_status status = read_real(source, text, token, what, 1, &value);
    *out = (float)value;
    return status;
}

static rt_status read_line(const rt_mesh_source *source, rt_mesh_text *text, const char *what,
                           int are_finite, double *out, int least, int most, int *count)
{
    rt_token token;
    rt_status status = RT_OK;
    *count = 0;
    while (status == RT_OK && rt_mesh_text_token(text, &token)) {
        if (*count == most)
            return rt_mesh_fail(source, text->line, "%s: more than %d values", what, most);
        status = read_real(source, text, token, what, are_finite, &out[(*count)++]);
    }
    if (status == RT_OK && *count < least)
        return rt_mesh_fail(source, text->line, "%s: %d values; at least %d are needed", what,
                            *count, least);
    return status;
}

rt_status rt_field_floats(const rt_mesh_source *source, rt_mesh_text *text, const char *what,
                          double *out, int least, int most, int *count)
{
    return read_line(source, text, what, 1, out, least, most, count);
}

rt_status rt_field_reals(const rt_mesh_source *source, rt_mesh_text *text, const char *what,
                         double *out, int least, int most, int *count)
{
    return read_line(source, text, what, 0, out, least, most, count);
}

rt_status rt_field_count(const rt_mesh_source *source, const rt_mesh_text *text, rt_token token,
                         const char *what, uint64_t most, uint64_t *out)
{
    char quote[RT_QUOTE];
    int64_t value;
    if (!rt_token_integer(token, &value) || value < 0 || (uint64_t)value > most)
        return rt_mesh_fail(source, text->line, "%s: '%s' is not a whole number from 0 to %llu",
                            what, rt_token_quote(token, quote), (unsigned long long)most);
    *out = (uint64_t)value;
    return RT_OK;
}
