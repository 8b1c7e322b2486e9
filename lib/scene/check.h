/* check.h - checks of values that come from the caller, and the scene's growing arrays. */
#ifndef RT_LIB_SCENE_CHECK_H
#define RT_LIB_SCENE_CHECK_H

#include <math.h>

#include "base/memory.h"
#include "base/vec.h"
#include "types.h"

/*
 * Shorter lengths have squares, and areas have reciprocals, that float32 does not hold in full
 * precision.
 */
#define RT_LENGTH_MIN 1e-15f
#define RT_AREA_MIN 1e-30

/* Greatest component of a colour, of whatever unit. */
#define RT_COLOUR_MAX 1e28f

static inline int rt_is_black(const float c[3])
{
    return c[0] == 0 && c[1] == 0 && c[2] == 0;
}

/* A row of RT_SURFACE_INPUTS and its like: returns the name of the input where it is given. */
#define RT_GIVEN_COLOUR(name) !rt_is_black(m->name)
#define RT_GIVEN_NUMBER(name) m->name != 0
#define RT_GIVEN_INPUT(TYPE, name, RANGE, NEED, unit, help)                                        \
    if (m->name##_texture)                                                                         \
        return #name "_texture";                                                                   \
    if (RT_GIVEN_##TYPE(name))                                                                     \
        return #name;

/* Finite coordinates. */
static inline rt_status rt_check_point(const float p[3], const char *who, const char *field,
                                       rt_error *error)
{
    for (int i = 0; i < 3; i++)
        if (!(fabsf(p[i]) <= RT_COORDINATE_MAX))
            return rt_fail_field(error, RT_ERROR_INPUT, field,
                                 "%s: %s has the coordinate %g; it must lie within %g", who, field,
                                 p[i], RT_COORDINATE_MAX);
    return RT_OK;
}

/* Not negative, not above RT_COLOUR_MAX. */
static inline rt_status rt_check_colour(const float c[3], const char *who, const char *field,
                                        rt_error *error)
{
    for (int i = 0; i < 3; i++)
        if (!(c[i] >= 0 && c[i] <= RT_COLOUR_MAX))
            return rt_fail_field(error, RT_ERROR_INPUT, field,
                                 "%s: %s has the component %g; it must lie between 0 and %g", who,
                                 field, c[i], RT_COLOUR_MAX);
    return RT_OK;
}

/* Makes room for one more element of `size` bytes after `count` in a list of the scene. */
static inline rt_status rt_grow(rt_memory *memory, void **array, size_t *room, size_t count,
                                size_t size, const char *what, rt_error *error)
{
    return count < *room ? RT_OK
                         : rt_memory_grow(memory, array, room, count + 1, size, what, error);
}

#endif
