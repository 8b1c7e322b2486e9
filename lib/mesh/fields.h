/* fields.h - numbers and indices of the text formats, checked, with errors that name the field. */
#ifndef RT_LIB_MESH_FIELDS_H
#define RT_LIB_MESH_FIELDS_H

#include "mesh/source.h"
#include "mesh/text.h"

/* A growing list of floats; all zero is empty. */
typedef struct rt_floats {
    float *data;
    size_t count, room;
} rt_floats;

rt_status rt_floats_add(rt_floats *list, const rt_mesh_source *source, const float *values,
                        size_t count);
void rt_floats_free(rt_floats *list);

/* A growing list of indices. */
typedef struct rt_indices {
    uint32_t *data;
    size_t count, room;
} rt_indices;

rt_status rt_indices_add(rt_indices *list, const rt_mesh_source *source, uint32_t index);
void rt_indices_free(rt_indices *list);

/* A finite float from a token of the line that the text is at. `what` names it, such as "v". */
rt_status rt_field_float(const rt_mesh_source *source, const rt_mesh_text *text, rt_token token,
                         const char *what, float *out);

/* The numbers of the rest of the line: from least to most of them; *count gets how many. */
rt_status rt_field_floats(const rt_mesh_source *source, rt_mesh_text *text, const char *what,
                          float *out, int least, int most, int *count);

/* A whole number from 0 to most. */
rt_status rt_field_count(const rt_mesh_source *source, const rt_mesh_text *text, rt_token token,
                         const char *what, uint64_t most, uint64_t *out);

#endif
