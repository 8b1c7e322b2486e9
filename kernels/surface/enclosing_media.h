/*
 * enclosing_media.h - the solids around a point that a path starts from.
 *
 * A ray is followed from the point to infinity. A solid that it leaves without having entered it is
 * around the point. The solids are nested in the order in which the ray leaves them, the innermost
 * first; opaque surfaces are passed through. Half-spaces behind planes have no end: those that the
 * ray does not leave, but its opposite does, are the outermost.
 */
#ifndef RT_KERNELS_SURFACE_ENCLOSING_MEDIA_H
#define RT_KERNELS_SURFACE_ENCLOSING_MEDIA_H

#include "accel/coincident.h"
#include "accel/traverse.h"
#include "material/medium.h"

#define RT_MAX_SURFACES 1024 /* surfaces that a ray is followed through */

/*
 * Leaves the solids whose faces a ray goes out through: those that it entered, or else notes that
 * they are around its start.
 */
static inline void leave_faces(const struct scene *scene, const struct coincident *coincident,
                               bool entering, uint4 *entered, uint left[4], int *count)
{
    for (uint i = 0u; i < coincident->count; i++) {
        const uint material = coincident->faces[i].material;
        if (coincident->faces[i].is_opposite != entering ||
            !is_transparent(scene->materials + material))
            continue;
        if (any(*entered == material))
            *entered = media_leave(*entered, material);
        else if (*count < 4)
            left[(*count)++] = material;
    }
}

/* Enters those whose faces it goes in through. */
static inline void enter_faces(const struct scene *scene, const struct coincident *coincident,
                               bool entering, uint4 *entered)
{
    for (uint i = 0u; i < coincident->count; i++) {
        const uint material = coincident->faces[i].material;
        if (coincident->faces[i].is_opposite != entering &&
            is_transparent(scene->materials + material))
            *entered = media_enter(scene, *entered, material);
    }
}

/* The nearest transparent plane that a ray meets behind *t, or at *t with a greater index. */
static inline bool next_plane(const struct scene *scene, const struct ray *ray, float *t, uint *at)
{
    const float behind = *t;
    const uint before = *at;
    float nearest = INFINITY;
    for (uint i = 0u; i < scene->header->plane_count; i++) {
        global const rt_shape *plane = scene->shapes + scene->planes[i];
        uint part;
        const float met = plane_intersect(plane, ray, &part);
        const bool is_next = met > behind || (met == behind && i + 1u > before);
        if (is_next && met < nearest && is_transparent(scene->materials + plane->material)) {
            nearest = met;
            *at = i + 1u;
        }
    }
    *t = nearest;
    return nearest < INFINITY;
}

/*
 * Notes the half-spaces that a ray leaves without having entered them: of those between two planes
 * of one material, which are a slab, none that lies all on one side. Others' faces are passed over.
 */
static inline void leave_half_spaces(const struct scene *scene, const struct ray *ray, uint left[4],
                                     int *count)
{
    uint4 entered = RT_VACUUM;
    float t = 0.0f;
    uint at = 0u;
    for (uint i = 0u; i < scene->header->plane_count && next_plane(scene, ray, &t, &at); i++) {
        global const rt_shape *plane = scene->shapes + scene->planes[at - 1u];
        bool is_noted = false;
        for (int k = 0; k < *count; k++)
            is_noted |= left[k] == plane->material;
        if (dot(ray->direction, vload3(0, plane->p + 4)) < 0.0f)
            entered = media_enter(scene, entered, plane->material);
        else if (any(entered == plane->material))
            entered = media_leave(entered, plane->material);
        else if (!is_noted && *count < 4)
            left[(*count)++] = plane->material;
    }
}

/* Enters these solids as a path from outside would, outermost first. */
static inline uint4 enter_outermost_first(const struct scene *scene, const uint left[4], int count)
{
    uint4 media = RT_VACUUM;
    while (count > 0)
        media = media_enter(scene, media, left[--count]);
    return media;
}

/* The media list of a path that starts infinitely far, here, and goes in direction w. */
static inline uint4 half_spaces_around(const struct scene *scene, float3 from, float3 w)
{
    const struct ray ray = make_ray(from, w, 0.0f, INFINITY),
                     back = make_ray(from, -w, 0.0f, INFINITY);
    uint left[4];
    int count = 0;
    leave_half_spaces(scene, &ray, left, &count);
    leave_half_spaces(scene, &back, left, &count);
    return enter_outermost_first(scene, left, count);
}

/* The media list of a path that starts here. */
RARELY_CALLED uint4 media_around(const struct scene *scene, float3 from)
{
    /* Any direction will do; one off all axes and diagonals seldom meets an edge. */
    struct ray ray = make_ray(from, unit((float3)(0.3017f, 0.8731f, 0.3829f)), 0.0f, INFINITY);
    uint4 entered = RT_VACUUM;
    uint left[4]; /* solids around the point */
    int count = 0;
    struct hit hit;
    for (int i = 0; i < RT_MAX_SURFACES && closest_hit(scene, &ray, &hit); i++) {
        struct surface surface;
        surface_at(&surface, scene, &ray, &hit);
        const bool entering = dot(ray.direction, surface.normal) < 0.0f;
        struct coincident coincident;
        find_coincident(&coincident, scene, &surface);
        surface.error = coincident.lift;
        ray.origin = leave_surface(&surface, ray.direction);
        leave_faces(scene, &coincident, entering, &entered, left, &count);
        enter_faces(scene, &coincident, entering, &entered);
    }

    const struct ray back = make_ray(from, -ray.direction, 0.0f, INFINITY);
    leave_half_spaces(scene, &back, left, &count);
    return enter_outermost_first(scene, left, count);
}

/*
 * The media list behind a surface that others may touch, from that before it: the solids whose
 * faces coincide there end or begin.
 */
RARELY_CALLED uint4 media_behind(const struct scene *scene, const struct surface *surface,
                                 uint4 media)
{
    struct coincident coincident;
    uint left[4]; /* those of which nothing was known, and nothing has to be */
    int count = 0;
    find_coincident(&coincident, scene, surface);
    leave_faces(scene, &coincident, true, &media, left, &count);
    enter_faces(scene, &coincident, true, &media);
    return media;
}

#endif
