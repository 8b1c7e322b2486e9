/* medium.c - participating media: coefficients of materials and of the space outside of solids. */
#include <math.h>

#include "base/error.h"
#include "scene/check.h"
#include "scene/inside.h"
#include "scene/scene.h"

/* Beyond it the phase function is as narrow as float32 can sample. */
static const float g_max = 0.99f;

rt_status rt_medium_check(const float scattering[3], float g, const char *who, rt_error *error)
{
    rt_status status = rt_check_colour(scattering, who, "scattering", error);
    if (status != RT_OK)
        return status;
    if (!(fabsf(g) <= g_max))
        return rt_fail_field(error, RT_ERROR_INPUT, "g",
                             "%s: g is %g; it must lie from -0.99 to 0.99", who, g);
    return RT_OK;
}

rt_status rt_scene_set_medium(rt_scene *scene, const rt_medium *medium, rt_error *error)
{
    const char *who = "medium";
    rt_status status = rt_check_colour(medium->absorption, who, "absorption", error);
    if (status == RT_OK)
        status = rt_medium_check(medium->scattering, medium->g, who, error);
    if (status == RT_OK)
        status = rt_grid_check_medium(scene, medium->density, medium->absorption,
                                      medium->scattering, who, error);
    if (status == RT_OK)
        status = rt_grid_check_albedo(scene, medium->albedo, who, error);
    if (status == RT_OK)
        scene->medium = *medium;
    return status;
}

/* Whether the material of a shape has an inside whose density or albedo lies on a grid. */
static int is_on_grid(const rt_material *m)
{
    return (m->density || (m->albedo && !rt_is_black(m->scattering))) &&
           (m->interface || rt_material_is_transparent(m));
}

/* Whether there is a medium outside of all solids. */
static int fills_space(const rt_medium *m)
{
    return !rt_is_black(m->absorption) || !rt_is_black(m->scattering);
}

int rt_scene_has_grids(const rt_scene *scene)
{
    const rt_medium *outside = &scene->medium;
    if ((outside->density && fills_space(outside)) ||
        (outside->albedo && !rt_is_black(outside->scattering)))
        return 1;
    for (size_t i = 0; i < scene->shape_count; i++)
        if (is_on_grid(scene->materials + scene->shapes[i].material))
            return 1;
    return 0;
}

int rt_scene_has_media(const rt_scene *scene)
{
    if (fills_space(&scene->medium))
        return 1;
    for (size_t i = 0; i < scene->shape_count; i++) {
        const rt_material *m = scene->materials + scene->shapes[i].material;
        if (m->interface || is_on_grid(m) ||
            (rt_material_is_transparent(m) && !rt_is_black(m->scattering)))
            return 1;
    }
    return 0;
}
