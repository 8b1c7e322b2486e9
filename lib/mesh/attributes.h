/* attributes.h - named numbers that a mesh has at its vertices, or that its triangles have. */
#ifndef RT_LIB_MESH_ATTRIBUTES_H
#define RT_LIB_MESH_ATTRIBUTES_H

#include <stddef.h>
#include <stdint.h>

#include "base/memory.h"

#define RT_ATTRIBUTE_NAME 64 /* bytes of a name, its end included */
#define RT_ATTRIBUTE_WIDTH 3 /* numbers of one, at most */

typedef struct rt_attribute {
    char name[RT_ATTRIBUTE_NAME];
    uint32_t first, width; /* its numbers in each row */
    /* of its numbers that count; both the same where one is not finite, which they are then */
    float least, largest;
} rt_attribute;

/* All attributes of the vertices of a mesh, or of its triangles. All zero: none. */
typedef struct rt_attributes {
    rt_attribute *list;
    uint32_t count;
    uint32_t width; /* of a row */
    float *values;  /* [vertices or triangles][width]; in files any number, finite or not */
} rt_attributes;

/* Adds one behind the others, before values are there. Fails with RT_ERROR_MEMORY. */
rt_status rt_attributes_add(rt_attributes *to, const char *name, size_t length, uint32_t width,
                            rt_memory *memory, rt_error *error);

/* The attribute of this name, or NULL. */
const rt_attribute *rt_attributes_find(const rt_attributes *of, const char *name);

/* Sets the least and largest numbers of each in these rows; NULL: in the first ones. */
void rt_attributes_measure(rt_attributes *of, const uint32_t *rows, size_t count);

void rt_attributes_free(rt_attributes *of);

#endif
