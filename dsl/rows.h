/*
 * rows.h - shorthands for the rows of the tables of blocks and fields; for blocks.c and shapes.c
 * alone.
 */
#ifndef RT_DSL_ROWS_H
#define RT_DSL_ROWS_H

#include <stddef.h>

#include "dsl/schema.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])
#define AT(type, member) offsetof(type, member), sizeof(((type *)0)->member)

/* ---- Ranges, choices ----------------------------------------------------- */

#define ANY                                                                                        \
    {                                                                                              \
        RT_RANGE_ANY, 0, 0                                                                         \
    }
#define FROM_TO(low, high)                                                                         \
    {                                                                                              \
        RT_RANGE_CLOSED, low, high                                                                 \
    }
#define BETWEEN(low, high)                                                                         \
    {                                                                                              \
        RT_RANGE_BETWEEN, low, high                                                                \
    }
#define UNIT FROM_TO(0, 1)
#define TWICE FROM_TO(0, 2)
#define LENGTH FROM_TO(1e-15, 1e15)
#define LENGTH_OR_ZERO FROM_TO(0, 1e15)
#define LIGHT FROM_TO(0, 1e28)
#define HALF_TURN FROM_TO(1e-3, 180)
#define DIRECTION                                                                                  \
    {                                                                                              \
        RT_RANGE_DIRECTION, 0, 0                                                                   \
    }
#define NOT_ZERO                                                                                   \
    {                                                                                              \
        RT_RANGE_NOT_ZERO, 0, 0                                                                    \
    }

#define INTEGER_LAST 2147483647.0

/* Shorthands for the rows: type and need. */
#define NUMBER RT_FIELD_NUMBER
#define INTEGER RT_FIELD_INTEGER
#define PAIR RT_FIELD_PAIR
#define VECTOR RT_FIELD_VECTOR
#define COLOUR RT_FIELD_COLOUR
#define BOOLEAN RT_FIELD_BOOLEAN
#define CHOICE RT_FIELD_CHOICE
#define TEXTURE RT_FIELD_TEXTURE
#define GRID RT_FIELD_GRID
#define PART RT_FIELD_PART
#define FILE_NAME RT_FIELD_FILE
#define STRING RT_FIELD_STRING
#define OPTIONAL RT_NEED_OPTIONAL
#define REQUIRED RT_NEED_REQUIRED
#define ONE_OF RT_NEED_ONE_OF
#define AT_MOST_ONE RT_NEED_AT_MOST_ONE
#define ALL_OR_NONE RT_NEED_ALL_OR_NONE
#define ALL_OR_NONE_TOO RT_NEED_ALL_OR_NONE_TOO

/* A row inside a macro. */
#define ROW(...)                                                                                   \
    {                                                                                              \
        __VA_ARGS__                                                                                \
    }

/* The steps of a transform. */
#define TRANSFORM(type, member)                                                                    \
    ROW("translate", RT_FIELD_TRANSLATE, OPTIONAL, ANY, "m", "none", NULL, AT(type, member),       \
        "translation; see [Transforms](#transforms)"),                                             \
        ROW("rotate", RT_FIELD_ROTATE, OPTIONAL, DIRECTION, "degrees", "none", NULL,               \
            AT(type, member),                                                                      \
            "turns it about an axis through the origin (three numbers) by an angle, "              \
            "counter-clockwise seen against the axis"),                                            \
        ROW("scale", RT_FIELD_SCALE, OPTIONAL, NOT_ZERO, "", "none", NULL, AT(type, member),       \
            "scales it about the origin, alike or by x, y and z"),                                 \
        ROW("matrix", RT_FIELD_MATRIX, OPTIONAL, ANY, "", "none", NULL, AT(type, member),          \
            "any affine map: three rows of four, the last column the translation")

/* Fields of all shapes, and of those that can emit. */
#define SURFACE_BUT_TEXTURE(type)                                                                  \
    ROW("material", RT_FIELD_MATERIAL, REQUIRED, ANY, "", "", NULL, AT(type, surface.material),    \
        "surface material"),                                                                       \
        TRANSFORM(type, surface.transform)
#define SURFACE_TEXTURE(type, help)                                                                \
    ROW("texture", TEXTURE, OPTIONAL, ANY, "", "none", NULL, AT(type, surface.texture), help)
#define SURFACE(type)                                                                              \
    SURFACE_TEXTURE(type, "multiplies kd or base_color of the material, or `radiance` or `power` " \
                          "where the shape has one of its own"),                                   \
        SURFACE_BUT_TEXTURE(type)
#define EMISSION(type)                                                                             \
    ROW("radiance", COLOUR, AT_MOST_ONE, LIGHT, "W/(m^2 sr)", "that of the material", NULL,        \
        AT(type, surface.radiance),                                                                \
        "makes it an area light: emitted radiance, instead of the material's emission"),           \
        ROW("power", COLOUR, AT_MOST_ONE, LIGHT, "W", "none", NULL, AT(type, surface.power),       \
            "makes it an area light: emitted flux of the whole shape; not together with "          \
            "`radiance`")

#define FIELDS(table) table, COUNT(table)

#endif
