/* fields.c - reads and checks the numbers of a line, and appends them to lists. */
#include "mesh/fields.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Appends `more` elements of this size to a list, growing its room by at least a half. */
static rt_status append(void **data, size_t *count, size_t *room, const void *values, size_t more,
                        size_t size, const rt_mesh_source *source)
{
    rt_status status = RT_OK;
    if (more > *room - *count)
        status = rt_memory_grow(source->memory, data, room, *count + more, size, "a mesh",
                                source->error);
    if (status != RT_OK)
        return status;
    memcpy((char *)*data + *count * size, values, more * size);
    *count += more;
    return RT_OK;
}

#define LIST(name, type)                                                                           \
    rt_status rt_##name##_add(rt_##name *list, const rt_mesh_source *source, const type *values,   \
                              size_t count)                                                        \
    {                                                                                              \
        return append((void **)&list->data, &list->count, &list->room, values, count,              \
                      sizeof *values, source);                                                     \
    }                                                                                              \
    void rt_##name##_free(rt_##name *list)                                                         \
    {                                                                                              \
        rt_memory_free(list->data);                                                                \
        memset(list, 0, sizeof *list);                                                             \
    }

RT_LISTS(LIST)

rt_status rt_field_real(const rt_mesh_source *source, const rt_mesh_text *text, rt_token token,
                        const char *what, double *out)
{
    char quote[RT_QUOTE];
    return rt_token_real(token, out) ? RT_OK
                                     : rt_mesh_fail(source, text->line, "%s: '%s' is not a number",
                                                    what, rt_token_quote(token, quote));
}

rt_status rt_field_double(const rt_mesh_source *source, const rt_mesh_text *text, rt_token token,
                          const char *what, double *out)
{
    char quote[RT_QUOTE];
    double value;
    const rt_status status = rt_field_real(source, text, token, what, &value);
    if (status != RT_OK)
        return status;
    if (!(fabs(value) <= FLT_MAX))
        return rt_mesh_fail(source, text->line, "%s: '%s' is not a finite float", what,
                            rt_token_quote(token, quote));
    *out = value;
    return RT_OK;
}

typedef rt_status field(const rt_mesh_source *source, const rt_mesh_text *text, rt_token token,
                        const char *what, double *out);

static rt_status read_line(const rt_mesh_source *source, rt_mesh_text *text, const char *what,
                           field *read, double *out, int least, int most, int *count)
{
    rt_token token;
    rt_status status = RT_OK;
    *count = 0;
    while (status == RT_OK && rt_mesh_text_token(text, &token)) {
        if (*count == most)
            return rt_mesh_fail(source, text->line, "%s: more than %d values", what, most);
        status = read(source, text, token, what, &out[(*count)++]);
    }
    if (status == RT_OK && *count < least)
        return rt_mesh_fail(source, text->line, "%s: %d values; at least %d are needed", what,
                            *count, least);
    return status;
}

rt_status rt_field_reals(const rt_mesh_source *source, rt_mesh_text *text, const char *what,
                         double *out, int least, int most, int *count)
{
    return read_line(source, text, what, rt_field_real, out, least, most, count);
}

rt_status rt_field_doubles(const rt_mesh_source *source, rt_mesh_text *text, const char *what,
                           double *out, int least, int most, int *count)
{
    return read_line(source, text, what, rt_field_double, out, least, most, count);
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
