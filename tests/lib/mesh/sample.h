/*
 * sample.h - mesh files made by the tests, in the current directory, and what reading them gives.
 */
#ifndef RT_TESTS_MESH_SAMPLE_H
#define RT_TESTS_MESH_SAMPLE_H

#include <stddef.h>

#include "mesh/load.h"

/* A file under construction; all zero is empty. */
typedef struct sample {
    unsigned char *data;
    size_t size, room;
} sample;

void sample_text(sample *s, const char *text);
void sample_bytes(sample *s, const void *bytes, size_t size);
void sample_free(sample *s);

/* Adds numbers as binary values, little- or big-endian. */
void sample_u8(sample *s, unsigned value);
void sample_u16(sample *s, unsigned value, int big);
void sample_u32(sample *s, unsigned long value, int big);
void sample_f32(sample *s, float value, int big);
void sample_f64(sample *s, double value, int big);

/*
 * Writes a file, reads it as a mesh and removes it. Returns the status, checking that error and
 * mesh fit it.
 */
rt_status sample_read(rt_mesh **out, const sample *s, const char *name, rt_error *error);

/* Reads text that must be a mesh. The caller destroys it. */
rt_mesh *sample_accept(const char *name, const char *text);

/* Reads text that must be refused at this line (0: none) with a message that contains `part`. */
void sample_refuse(const char *name, const char *text, int line, const char *part);

/* Fails the running test unless the mesh has exactly these triangles, [count][3]. */
void sample_expect_triangles(const rt_mesh *mesh, const unsigned *indices, size_t count);

/* Fails the running test unless the values are exactly these. */
void sample_expect_floats(const float *values, const float *expected, size_t count);

#endif
