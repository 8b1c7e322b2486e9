/* ply_attributes.h - properties of a PLY file that are attributes of its mesh. */
#ifndef RT_LIB_MESH_PLY_ATTRIBUTES_H
#define RT_LIB_MESH_PLY_ATTRIBUTES_H

#include "mesh/attributes.h"
#include "mesh/ply_header.h"

#define RT_PLY_ATTRIBUTES 64 /* of an element; more are passed over */

typedef struct rt_ply_attribute {
    rt_token name;
    size_t property; /* number of its first property; the others follow */
    uint32_t width, first;
} rt_ply_attribute;

typedef struct rt_ply_attributes {
    rt_ply_attribute list[RT_PLY_ATTRIBUTES];
    uint32_t count, width; /* width: of a row of all */
} rt_ply_attributes;

/*
 * Finds the attributes of an element among the scalars that is_taken (user: its own) does not
 * claim: floats, and whole numbers of 8 or 16 bits, which are divided by the largest of their type.
 * Neighbours whose names end in _x _y _z, _r _g _b, _0 _1 _2, _1 _2 _3, _u _v or _s _t are one
 * attribute, called by what comes before, as Blender and Mitsuba write them. Of one name the first
 * counts.
 */
typedef int rt_ply_is_taken(const void *user, const rt_ply_property *property);
void rt_ply_attributes_find(rt_ply_attributes *out, const rt_ply_element *element,
                            rt_ply_is_taken *is_taken, const void *user);

/* The place of a property in a row of the attributes, or -1. */
int rt_ply_attributes_place(const rt_ply_attributes *of, size_t property);

/* What its values are multiplied by. */
double rt_ply_attribute_scale(const rt_ply_property *property);

/* Names them in a mesh. */
rt_status rt_ply_attributes_add(rt_attributes *to, const rt_ply_attributes *found,
                                rt_memory *memory, rt_error *error);

#endif
