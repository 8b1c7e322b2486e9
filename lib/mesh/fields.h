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

/* The same of doubles. */
typedef struct rt_doubles {
    double *data;
    size_t count, room;
} rt_doubles;

rt_status rt_doubles_add(rt_doubles *list, const rt_mesh_source *source, const double *values,
                         size_t count);
void rt_doubles_free(rt_doubles *list);

/* A number that fits a finite float, in double precision. */
rt_status rt_field_double(const rt_mesh_source *source, const rt_mesh_text *text, rt_token token,
                          const char *what, double *out);

/* A finite float from a token of the line that the text is at. `what` names it, such as "v". */
rt_status rt_field_float(const rt_mesh_source *source, const rt_mesh_text *text, rt_token token,
                         const char *what, float *out);

/*
 * The numbers of the rest of the line: from least to most of them; *count gets how many. They fit
 * finite floats, or, the second, may be anything, even nan.
 */
rt_status rt_field_reals(const rt_mesh_source *source, rt_mesh_text *text, const char *what,
                         double *out, int least, int most, int *count);
rt_status rt_field_floats(const rt_mesh_source *source, rt_mesh_text *text, const char *what,
                          double *out, int least, int most, int *count);

/* A whole number from 0 to most. */
rt_status rt_field_count(const rt_mesh_source *source, const rt_mesh_text *text, rt_token token,
                         const char *what, uint64_t most, uint64_t *out);

#endif
