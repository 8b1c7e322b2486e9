/*
 * line.h - a ray in object space, made ready for finding roots along it.
 */
#ifndef RT_KERNELS_SHAPE_LINE_H
#define RT_KERNELS_SHAPE_LINE_H

#include "math/ray.h"

/*
 * The points origin + s direction, lo <= s <= hi, with a unit direction; s in lengths of
 * object space. The line of a ray from afar starts where it is nearest to the middle, so that what
 * follows works with small numbers; that of a ray from near keeps the ray's origin to the bit, so
 * that its side of a surface stays known.
 */
struct line {
    float3 origin, direction;
    float lo, hi;
    float shift; /* from the ray's origin to this one */
    float speed; /* length of the ray's direction */
};

#define LINE_NEAR 4.0f

static inline struct line make_line(const struct ray *ray)
{
    struct line line;
    line.speed = length(ray->direction);
    line.direction = ray->direction * (1.0f / line.speed);
    line.shift = dot(ray->origin, ray->origin) > LINE_NEAR * LINE_NEAR
                     ? -dot(ray->origin, line.direction)
                     : 0.0f;
    line.origin = ray->origin + line.shift * line.direction;
    line.lo = ray->t_min * line.speed - line.shift;
    line.hi = ray->t_max * line.speed - line.shift;
    return line;
}

/* The ray's t at s in [lo, hi]. */
static inline float line_t(const struct line *line, const struct ray *ray, float s)
{
    return clamp((s + line->shift) / line->speed, ray->t_min, ray->t_max);
}

static inline bool line_has(const struct line *line, float s)
{
    return s >= line->lo && s <= line->hi;
}

#endif
