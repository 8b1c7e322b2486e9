/* fields.h - numbers and indices of the text formats, checked, with errors that name the field. */
#ifndef RT_LIB_MESH_FIELDS_H
#define RT_LIB_MESH_FIELDS_H

#include "mesh/source.h"
#include "mesh/text.h"

/* X(name, type): growing lists. All zero is empty; rt_NAME_add appends, rt_NAME_free empties. */
#define RT_LISTS(X)                                                                                \
    X(floats, float)                                                                               \
    X(doubles, double)                                                                             \
    X(indices, uint32_t)

#define RT_LIST_DECLARATION(name, type)                                                            \
    typedef struct rt_##name {                                                                     \
        type *data;                                                                                \
        size_t count, room;                                                                        \
    } rt_##name;                                                                                   \
    rt_status rt_##name##_add(rt_##name *list, const rt_mesh_source *source, const type *values,   \
                              size_t count);                                                       \
    void rt_##name##_free(rt_##name *list);

RT_LISTS(RT_LIST_DECLARATION)

/*
 * A number from a token of the line that the text is at, of any size, even nan; or one that fits a
 * finite float. `what` names it, such as "v".
 */
rt_status rt_field_real(const rt_mesh_source *source, const rt_mesh_text *text, rt_token token,
                        const char *what, double *out);
rt_status rt_field_double(const rt_mesh_source *source, const rt_mesh_text *text, rt_token token,
                          const char *what, double *out);

/* The numbers of the rest of the line: from least to most of them; *count gets how many. */
rt_status rt_field_reals(const rt_mesh_source *source, rt_mesh_text *text, const char *what,
                         double *out, int least, int most, int *count);
rt_status rt_field_doubles(const rt_mesh_source *source, rt_mesh_text *text, const char *what,
                           double *out, int least, int most, int *count);

/* A whole number from 0 to most. */
rt_status rt_field_count(const rt_mesh_source *source, const rt_mesh_text *text, rt_token token,
                         const char *what, uint64_t most, uint64_t *out);

#endif
