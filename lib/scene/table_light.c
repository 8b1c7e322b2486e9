/* table_light.c - lights whose intensity a table has: projectors, luminaires, images of spots. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "rt/photon.h"
#include "scene/check.h"
#include "scene/ies.h"
#include "scene/light_image.h"
#include "scene/light_table.h"
#include "scene/table_light.h"

static const double pi = 3.14159265358979323846;

/* W/sr of a candela, by which irradiance is turned into illuminance. */
static const double watts_of_candela = 1 / RT_LUMENS_PER_WATT;

/* ---- Axes ----------------------------------------------------------------------- */

rt_status rt_light_aim(rt_scene_light *out, const float position[3], const float target[3],
                       const char *who, rt_error *error)
{
    double axis[3];
    rt_status status = rt_check_point(position, who, "position", error);
    if (status == RT_OK)
        status = rt_check_point(target, who, "target", error);
    if (status != RT_OK)
        return status;
    rt_vec_sub(axis, target, position);
    const double length = rt_vec_length(axis);
    if (!(length > 0))
        return rt_fail_field(error, RT_ERROR_INPUT, "target",
                             "%s: position and target are the same point", who);
    for (int i = 0; i < 3; i++)
        out->direction[i] = (float)(axis[i] / length);
    memcpy(out->position, position, sizeof out->position);
    return RT_OK;
}

rt_status rt_light_set_across(rt_scene_light *l, const float up[3], int is_right, const char *who,
                              rt_error *error)
{
    static const float origin[3] = {0, 0, 0};
    static const double above[3] = {0, 1, 0}, ahead[3] = {0, 0, -1};
    const double axis[3] = {l->direction[0], l->direction[1], l->direction[2]};
    double u[3], right[3], towards[3];
    const rt_status status = rt_check_point(up, who, "up", error);
    if (status != RT_OK)
        return status;
    rt_vec_sub(u, up, origin);
    if (rt_is_black(up))
        memcpy(u, fabs(axis[1]) > 1 - 1e-6 ? ahead : above, sizeof u);
    rt_vec_cross(right, axis, u);
    if (!(rt_vec_length(right) > 1e-6 * rt_vec_length(u)))
        return rt_fail_field(error, RT_ERROR_INPUT, "up", "%s: up is parallel to its axis", who);
    rt_vec_cross(towards, right, axis);
    const double *across = is_right ? right : towards, length = rt_vec_length(across);
    for (int i = 0; i < 3; i++)
        l->across[i] = (float)(across[i] / length);
    return RT_OK;
}

/* ---- Tables ---------------------------------------------------------------------- */

static rt_status check_filter(rt_texture_filter filter, const char *who, rt_error *error)
{
    if ((unsigned)filter > RT_TEXTURE_FILTER_NEAREST)
        return rt_fail_field(error, RT_ERROR_INPUT, "filter", "%s: there is no filter %d", who,
                             (int)filter);
    return RT_OK;
}

/* Measures a table, gives it to the scene, and appends its light; frees it otherwise. */
static rt_status take(rt_scene *scene, rt_scene_light *l, rt_scene_light_table *table,
                      rt_error *error)
{
    const int is_spot = l->kind == RT_LIGHT_SPOT;
    rt_light_table_measure(table, is_spot ? l : NULL);
    if (!is_spot)
        l->outer = table->cosine;
    rt_status status = rt_scene_take_light_table(scene, &l->table, table, error);
    if (status != RT_OK) {
        rt_light_table_free(table);
        return status;
    }
    return rt_scene_take_light(scene, l, error);
}

static rt_u32 cells_flag(rt_texture_filter filter)
{
    return filter == RT_TEXTURE_FILTER_NEAREST ? RT_TABLE_CELLS : 0;
}

rt_status rt_spot_add_image(rt_scene *scene, rt_scene_light *l, const rt_spot_light *light,
                            rt_error *error)
{
    static const char who[] = "spot light";
    rt_light_image image = {0, 0, NULL};
    rt_scene_light_table table;
    rt_status status = check_filter(light->filter, who, error);
    if (status == RT_OK && !(l->outer > 1e-3f))
        return rt_fail_field(error, RT_ERROR_INPUT, "outer",
                             "spot light: outer is %g degrees; with an image it must be below 89.9",
                             acos(l->outer) * 180 / pi);
    if (status == RT_OK)
        status = rt_light_set_across(l, light->up, 1, who, error);
    if (status == RT_OK)
        status = rt_light_image_read(&image, light->path, light->layer, who, scene->memory, error);
    if (status != RT_OK)
        return status;
    const double side = sqrt(1 - (double)l->outer * l->outer) / l->outer;
    status = rt_light_table_of_image(&table, image.texels, image.width, image.height,
                                     RT_TABLE_PLANE | cells_flag(light->filter),
                                     (const double[2]){side, side}, scene->memory, error);
    rt_memory_free(image.texels);
    if (status == RT_OK && light->repeat)
        rt_light_table_repeat(&table);
    return status == RT_OK ? take(scene, l, &table, error) : status;
}

/* ---- Projectors ------------------------------------------------------------------- */

static rt_status check_projector(const rt_projector_light *light, const char *who, rt_error *error)
{
    rt_status status = rt_check_colour(light->irradiance, who, "irradiance", error);
    if (status == RT_OK)
        status = rt_check_colour(light->intensity, who, "intensity", error);
    if (status == RT_OK)
        status = check_filter(light->filter, who, error);
    if (status != RT_OK)
        return status;
    if (!rt_is_black(light->irradiance) && !rt_is_black(light->intensity))
        return rt_fail_field(error, RT_ERROR_INPUT, "intensity",
                             "%s: give irradiance or intensity, not both", who);
    if (!light->path)
        return rt_fail_field(error, RT_ERROR_INPUT, "path", "%s: name the file of an image", who);
    if (light->fov != 0 && !(light->fov >= 1e-3f && light->fov <= 179))
        return rt_fail_field(error, RT_ERROR_INPUT, "fov",
                             "%s: fov is %g degrees; it must lie from 0.001 to 179", who,
                             light->fov);
    return RT_OK;
}

rt_status rt_scene_add_projector_light(rt_scene *scene, const rt_projector_light *light,
                                       rt_error *error)
{
    static const char who[] = "projector";
    rt_scene_light l = {.kind = RT_LIGHT_TABLE};
    rt_light_image image = {0, 0, NULL};
    rt_scene_light_table table;
    rt_status status = check_projector(light, who, error);
    if (status == RT_OK)
        status = rt_light_aim(&l, light->position, light->target, who, error);
    if (status == RT_OK)
        status = rt_light_set_across(&l, light->up, 1, who, error);
    if (status == RT_OK)
        status = rt_light_image_read(&image, light->path, light->layer, who, scene->memory, error);
    if (status != RT_OK)
        return status;
    const int has_intensity = !rt_is_black(light->intensity);
    memcpy(l.emission, has_intensity ? light->intensity : light->irradiance, sizeof l.emission);
    const double side = tan((light->fov == 0 ? 45 : light->fov) * pi / 360);
    status = rt_light_table_of_image(
        &table, image.texels, image.width, image.height,
        RT_TABLE_PLANE | cells_flag(light->filter) | (has_intensity ? 0 : RT_TABLE_IRRADIANCE),
        (const double[2]){side, side * image.height / image.width}, scene->memory, error);
    rt_memory_free(image.texels);
    if (status == RT_OK && light->repeat)
        rt_light_table_repeat(&table);
    return status == RT_OK ? take(scene, &l, &table, error) : status;
}

/* ---- Luminaires ------------------------------------------------------------------- */

/* Whether a name ends in .ies, in either case. */
static int is_ies(const char *path)
{
    static const char ending[] = ".ies";
    const size_t length = strlen(path), end = sizeof ending - 1;
    if (length < end)
        return 0;
    for (size_t i = 0; i < end; i++) {
        const char c = path[length - end + i];
        if ((c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c) != ending[i])
            return 0;
    }
    return 1;
}

static rt_status read_luminaire(rt_scene_light_table *table, const rt_goniometric_light *light,
                                const char *who, rt_memory *memory, rt_error *error)
{
    rt_light_image image = {0, 0, NULL};
    rt_status status;
    if (is_ies(light->path) && light->layer)
        return rt_fail_field(error, RT_ERROR_INPUT, "layer",
                             "%s: a layer is one of an image, not of an IES file", who);
    if (is_ies(light->path)) {
        status = rt_ies_read(table, light->path, memory, error);
        if (status != RT_OK && error && !error->field[0])
            snprintf(error->field, sizeof error->field, "path");
        return status;
    }
    status = rt_light_image_read(&image, light->path, light->layer, who, memory, error);
    if (status != RT_OK)
        return status;
    status = rt_light_table_of_image(table, image.texels, image.width, image.height,
                                     cells_flag(light->filter), NULL, memory, error);
    rt_memory_free(image.texels);
    return status;
}

rt_status rt_scene_add_goniometric_light(rt_scene *scene, const rt_goniometric_light *light,
                                         rt_error *error)
{
    static const char who[] = "goniometric light";
    rt_scene_light l = {.kind = RT_LIGHT_TABLE};
    rt_scene_light_table table;
    rt_status status = rt_check_colour(light->intensity, who, "intensity", error);
    if (status == RT_OK)
        status = check_filter(light->filter, who, error);
    if (status == RT_OK && !light->path)
        return rt_fail_field(error, RT_ERROR_INPUT, "path",
                             "%s: name an IES file, or that of an image", who);
    if (status == RT_OK)
        status = rt_light_aim(&l, light->position, light->target, who, error);
    if (status == RT_OK)
        status = rt_light_set_across(&l, light->up, 0, who, error);
    if (status == RT_OK)
        status = read_luminaire(&table, light, who, scene->memory, error);
    if (status != RT_OK)
        return status;
    const float unit = is_ies(light->path) ? (float)watts_of_candela : 1;
    for (int c = 0; c < 3; c++)
        l.emission[c] = rt_is_black(light->intensity) ? unit : light->intensity[c];
    return take(scene, &l, &table, error);
}
