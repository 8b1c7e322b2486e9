/* scene.c - a scene built by calls: materials, point lights, camera, options. Shapes are in shape.c. */
#include "scene/scene.h"

#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "scene/check.h"

static const float pi = 3.14159265358979f;

rt_status rt_scene_create(rt_scene **out, rt_error *error)
{
    rt_scene *scene = calloc(1, sizeof *scene);
    if (!scene)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for a scene");
    *out = scene;
    return RT_OK;
}

void rt_scene_destroy(rt_scene *scene)
{
    if (!scene)
        return;
    for (size_t i = 0; i < scene->shape_count; i++) {
        free(scene->shapes[i].positions);
        free(scene->shapes[i].normals);
        free(scene->shapes[i].indices);
    }
    free(scene->shapes);
    free(scene->materials);
    free(scene->point_lights);
    free(scene);
}

/* kd + ks + kt <= 1, but for the rounding of decimal fractions. */
static rt_status check_albedo(const rt_material *m, const char *who, rt_error *error)
{
    static const char *const channel[] = {"red", "green", "blue"};
    for (int c = 0; c < 3; c++) {
        double sum = (double)m->kd[c] + m->ks[c] + m->kt[c];
        if (sum > 1.0 + 1e-6)
            return rt_fail_field(error, RT_ERROR_INPUT, m->kd[c] > 0 ? "kd" : m->ks[c] > 0 ? "ks" : "kt",
                                 "%s: kd + ks + kt is %g in %s; it must not exceed 1", who, sum, channel[c]);
    }
    return RT_OK;
}

rt_status rt_scene_add_material(rt_scene *scene, uint32_t *out, const char *name, const rt_material *material,
                                rt_error *error)
{
    char who[128] = "material";
    rt_material m = *material;
    rt_status status;

    if (name)
        snprintf(who, sizeof who, "material '%.100s'", name);
    if ((status = rt_check_colour(m.kd, who, "kd", error)) != RT_OK ||
        (status = rt_check_colour(m.ks, who, "ks", error)) != RT_OK ||
        (status = rt_check_colour(m.kt, who, "kt", error)) != RT_OK ||
        (status = rt_check_colour(m.emission, who, "emission", error)) != RT_OK ||
        (status = check_albedo(&m, who, error)) != RT_OK)
        return status;
    if (m.ior == 0)
        m.ior = 1.5f;
    if (!(m.ior >= 0.1f && m.ior <= 10))
        return rt_fail_field(error, RT_ERROR_INPUT, "ior", "%s: ior is %g; it must lie between 0.1 and 10", who, m.ior);
    if (m.priority < 0)
        return rt_fail_field(error, RT_ERROR_INPUT, "priority", "%s: priority is %d; it must not be negative", who,
                             m.priority);
    status = rt_grow((void **)&scene->materials, &scene->material_room, scene->material_count, sizeof m, error);
    if (status != RT_OK)
        return status;
    if (out)
        *out = (uint32_t)scene->material_count;
    scene->materials[scene->material_count++] = m;
    return RT_OK;
}

rt_status rt_scene_add_point_light(rt_scene *scene, const rt_point_light *light, rt_error *error)
{
    rt_point_light l = *light;
    rt_status status;

    if ((status = rt_check_point(l.position, "point light", "position", error)) != RT_OK ||
        (status = rt_check_colour(l.intensity, "point light", "intensity", error)) != RT_OK ||
        (status = rt_check_colour(l.power, "point light", "power", error)) != RT_OK)
        return status;
    int has_power = !rt_is_black(l.power);
    if (has_power && !rt_is_black(l.intensity))
        return rt_fail_field(error, RT_ERROR_INPUT, "power", "point light: give intensity or power, not both");
    for (int c = 0; c < 3 && has_power; c++)
        l.intensity[c] = l.power[c] / (4 * pi);
    status = rt_grow((void **)&scene->point_lights, &scene->point_light_room, scene->point_light_count, sizeof l,
                     error);
    if (status != RT_OK)
        return status;
    scene->point_lights[scene->point_light_count++] = l;
    return RT_OK;
}

/* Fills in the camera's defaults and refuses one that sees nothing. */
static rt_status complete_camera(rt_camera *c, rt_error *error)
{
    double axis[3], up[3], side[3];
    static const float origin[3];

    if (rt_is_black(c->up))
        c->up[1] = 1;
    if (c->fov == 0)
        c->fov = 45;
    if (!(c->fov > 0 && c->fov < 180))
        return rt_fail_field(error, RT_ERROR_INPUT, "fov", "camera: fov is %g degrees; it must lie between 0 and 180",
                             c->fov);
    if (!(c->aperture >= 0 && c->aperture <= RT_COORDINATE_MAX))
        return rt_fail_field(error, RT_ERROR_INPUT, "aperture",
                             "camera: aperture is %g m; it must lie between 0 and %g", c->aperture, RT_COORDINATE_MAX);
    rt_vec_sub(axis, c->look_at, c->eye);
    rt_vec_sub(up, c->up, origin);
    if (!(rt_vec_length(axis) > 0))
        return rt_fail_field(error, RT_ERROR_INPUT, "look_at", "camera: eye and look_at are the same point");
    rt_vec_cross(side, axis, up);
    if (!(rt_vec_length(side) > 1e-6 * rt_vec_length(axis) * rt_vec_length(up)))
        return rt_fail_field(error, RT_ERROR_INPUT, "up", "camera: up is parallel to the direction of view");
    int is_given = c->focal_distance != 0;
    if (!is_given)
        c->focal_distance = (float)rt_vec_length(axis);
    if (!(c->focal_distance >= RT_LENGTH_MIN && c->focal_distance <= RT_COORDINATE_MAX))
        return rt_fail_field(error, RT_ERROR_INPUT, is_given ? "focal_distance" : "look_at",
                             "camera: %s is %g m; it must lie between %g and %g",
                             is_given ? "focal_distance" : "the distance from eye to look_at", c->focal_distance,
                             RT_LENGTH_MIN, RT_COORDINATE_MAX);
    return RT_OK;
}

rt_status rt_scene_set_camera(rt_scene *scene, const rt_camera *camera, rt_error *error)
{
    rt_camera c = *camera;
    rt_status status;

    if ((status = rt_check_point(c.eye, "camera", "eye", error)) != RT_OK ||
        (status = rt_check_point(c.look_at, "camera", "look_at", error)) != RT_OK ||
        (status = rt_check_point(c.up, "camera", "up", error)) != RT_OK ||
        (status = complete_camera(&c, error)) != RT_OK)
        return status;
    scene->camera = c;
    scene->has_camera = 1;
    return RT_OK;
}

rt_status rt_scene_set_options(rt_scene *scene, const rt_render_options *options, rt_error *error)
{
    static const rt_render_options defaults;
    if (!options)
        options = &defaults;
    rt_status status = rt_options_check(options, error);
    if (status != RT_OK)
        return status;
    scene->options = *options;
    scene->options.hooks = NULL;
    scene->options.photon_map = NULL;
    return RT_OK;
}

void rt_scene_get_options(const rt_scene *scene, rt_render_options *out)
{
    *out = scene->options;
}

void rt_scene_get_info(const rt_scene *scene, rt_scene_info *out)
{
    memset(out, 0, sizeof *out);
    out->shapes = scene->shape_count;
    out->materials = scene->material_count;
    out->lights = scene->point_light_count;
    out->has_camera = scene->has_camera;
    for (size_t i = 0; i < scene->shape_count; i++) {
        float radiance[3];
        rt_scene_shape_radiance(scene, scene->shapes + i, radiance);
        out->primitives += rt_scene_shape_primitives(scene->shapes + i);
        out->triangles += scene->shapes[i].triangle_count;
        out->lights += !rt_is_black(radiance);
    }
}
