/* serialized_sample.h - files of meshes as Mitsuba writes them. */
#ifndef RT_TESTS_TOOLS_SERIALIZED_SAMPLE_H
#define RT_TESTS_TOOLS_SERIALIZED_SAMPLE_H

#include "base/bytes.h"

/* Appends a mesh, `content` deflated behind its mark and version. */
void serialized_put_mesh(rt_bytes *file, int version, const rt_bytes *content);

/* Appends where `count` meshes start, and how many there are. */
void serialized_put_table(rt_bytes *file, int version, const size_t *starts, size_t count);

/*
 * The content of a mesh of one triangle, (0, 0, z), (1, 0, z), (0, 1, z), to be freed: positions
 * and (u, v) in single or double precision.
 */
rt_bytes serialized_triangle(int version, int is_double, double z);

#endif
