/*
 * enclosing_media.cl - the media that paths start in: the solids around the camera and each light.
 *
 * A ray is followed from the point to infinity. A solid that it leaves without having entered it is
 * around the point. The solids are nested in the order in which the ray leaves them, the innermost
 * first; opaque surfaces are passed through.
 */
#include "entry.h"
#include "light/emit.h"
#include "material/medium.h"
#include "accel/traverse.h"

#define RT_MAX_SURFACES 1024 /* surfaces that a ray is followed through */

/*
 * Leaves the solids whose faces a ray goes out through: those that it entered, or else notes that
 * they are around its start.
 */
static void leave_faces(const struct scene *scene, const struct coincident *coincident,
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
static void enter_faces(const struct scene *scene, const struct coincident *coincident,
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
static uint4 media_around(const struct scene *scene, float3 from)
{
    /* Any direction will do; one off all axes and diagonals seldom meets an edge. */
    struct ray ray = make_ray(from, unit((float3)(0.3017f, 0.8731f, 0.3829f)), 0.0f, INFINITY);
    uint4 entered = RT_VACUUM;
    uint left[4]; /* solids around the point */
    int count = 0;
    struct hit hit;
    for (int i = 0; i < RT_MAX_SURFACES && closest_hit(scene, &ray, &hit); i++) {
        struct surface surface = surface_at(scene, &ray, &hit);
        const bool entering = dot(ray.direction, surface.normal) < 0.0f;
        global const rt_scene_header *header = scene->header;
        struct coincident coincident;
        find_coincident(&coincident, header, &surface);
        surface.error = coincident.lift;
        ray.origin = leave_surface(&surface, ray.direction);
        leave_faces(scene, &coincident, entering, &entered, left, &count);
        enter_faces(scene, &coincident, entering, &entered);
    }

    /* Enter them as a path from outside would, outermost first. */
    uint4 media = RT_VACUUM;
    while (count > 0)
        media = media_enter(scene, media, left[--count]);
    return media;
}

static uint4 media_around_light(const struct scene *scene, global const rt_light_data *light)
{
    switch ((rt_light_kind)light->kind) {
    case RT_LIGHT_DIRECTIONAL:
    case RT_LIGHT_ENVIRONMENT:
        return RT_VACUUM;
    case RT_LIGHT_POINT:
    case RT_LIGHT_SPOT:
        return media_around(scene, row3(light->a));
    case RT_LIGHT_QUAD:
    case RT_LIGHT_TRIANGLE:
    case RT_LIGHT_SPHERE:
    case RT_LIGHT_SHAPE:
        break;
    }
    /* One point stands for all of an area light. */
    struct emission emission;
    emit_area(scene, &emission, light, (float2)(0.3f, 0.4f), (float2)(0.5f), 0.75f);
    return media_around(scene, leave_surface(&emission.at, emission.at.normal));
}

/* Item 0: the camera at `eye`; item i: light i - 1. Needed only where a material lets light in. */
KERNEL enclosing_media(const rt_params params, global rt_scene_header *header, const float4 eye)
{
    const uint item = (uint)get_global_id(0);
    if (item >= params.item_count)
        return;
    const struct scene scene = scene_open(header);
    if (item == 0u) {
        vstore4(media_around(&scene, eye.xyz) + 1u, 0, header->eye_media);
        return;
    }
    global uchar *lights = (global uchar *)header + (size_t)header->lights * RT_SCENE_ROW;
    global rt_light_data *light = (global rt_light_data *)lights + (item - 1u);
    vstore3(media_around_light(&scene, light).xyz + 1u, 0, light->media);
}
