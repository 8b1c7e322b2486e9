/*
 * enclosing_media.h - the solids around a point that a path starts from.
 *
 * A ray is followed from the point to infinity. A solid that it leaves without having entered it is
 * around the point. The solids are nested in the order in which the ray leaves them, the innermost
 * first; opaque surfaces are passed through.
 */
#ifndef RT_KERNELS_MATERIAL_ENCLOSING_MEDIA_H
#define RT_KERNELS_MATERIAL_ENCLOSING_MEDIA_H

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

/* The media list of a path that starts here. */
RARELY_CALLED uint4 media_around(global const rt_scene_header *header, float3 from)
{
    const struct scene scene = scene_open(header);
    /* Any direction will do; one off all axes and diagonals seldom meets an edge. */
    struct ray ray = make_ray(from, unit((float3)(0.3017f, 0.8731f, 0.3829f)), 0.0f, INFINITY);
    uint4 entered = RT_VACUUM;
    uint left[4]; /* solids around the point */
    int count = 0;
    struct hit hit;
    for (int i = 0; i < RT_MAX_SURFACES && closest_hit(&scene, &ray, &hit); i++) {
        struct surface surface = surface_at(&scene, &ray, &hit);
        const bool entering = dot(ray.direction, surface.normal) < 0.0f;
        struct coincident coincident;
        find_coincident(&coincident, header, &surface);
        surface.error = coincident.lift;
        ray.origin = leave_surface(&surface, ray.direction);
        leave_faces(&scene, &coincident, entering, &entered, left, &count);
        enter_faces(&scene, &coincident, entering, &entered);
    }

    /* Enter them as a path from outside would, outermost first. */
    uint4 media = RT_VACUUM;
    while (count > 0)
        media = media_enter(&scene, media, left[--count]);
    return media;
}

#endif
