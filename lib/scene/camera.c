/* camera.c - the camera of a scene: defaults and ranges. */
#include "base/error.h"
#include "scene/check.h"
#include "scene/scene.h"

enum { blades_max = 64 };

static const float shift_max = 1000;

/* Lengths and angles; each has a default. */
static rt_status check_lens(rt_camera *c, rt_error *error)
{
    if (c->fov == 0)
        c->fov = 45;
    if (!(c->fov > 0 && c->fov < 180))
        return rt_fail_field(error, RT_ERROR_INPUT, "fov",
                             "camera: fov is %g degrees; it must lie between 0 and 180", c->fov);
    if (c->width == 0)
        c->width = 2;
    if (!(c->width >= RT_LENGTH_MIN && c->width <= RT_COORDINATE_MAX))
        return rt_fail_field(error, RT_ERROR_INPUT, "width",
                             "camera: width is %g m; it must lie between %g and %g", c->width,
                             RT_LENGTH_MIN, RT_COORDINATE_MAX);
    if (!(c->aperture >= 0 && c->aperture <= RT_COORDINATE_MAX))
        return rt_fail_field(error, RT_ERROR_INPUT, "aperture",
                             "camera: aperture is %g m; it must lie between 0 and %g", c->aperture,
                             RT_COORDINATE_MAX);
    if (c->blades == 1 || c->blades == 2 || c->blades > blades_max)
        return rt_fail_field(error, RT_ERROR_INPUT, "blades",
                             "camera: %u blades; give 3 to %d, or 0 for a round lens", c->blades,
                             blades_max);
    if (!(fabsf(c->blade_rotation) <= 1e6f))
        return rt_fail_field(
            error, RT_ERROR_INPUT, "blade_rotation",
            "camera: blade_rotation is %g degrees; it must lie between -1e6 and 1e6",
            c->blade_rotation);
    for (int i = 0; i < 2; i++)
        if (!(fabsf(c->shift[i]) <= shift_max))
            return rt_fail_field(error, RT_ERROR_INPUT, "shift",
                                 "camera: shift is %g %g; it must lie between -%g and %g",
                                 c->shift[0], c->shift[1], shift_max, shift_max);
    return RT_OK;
}

/* Refuses a camera that sees nothing. */
static rt_status check_view(rt_camera *c, rt_error *error)
{
    double axis[3], up[3], side[3];
    static const float origin[3];

    if (rt_is_black(c->up))
        c->up[1] = 1;
    rt_vec_sub(axis, c->look_at, c->eye);
    rt_vec_sub(up, c->up, origin);
    if (!(rt_vec_length(axis) > 0))
        return rt_fail_field(error, RT_ERROR_INPUT, "look_at",
                             "camera: eye and look_at are the same point");
    rt_vec_cross(side, axis, up);
    if (!(rt_vec_length(side) > 1e-6 * rt_vec_length(axis) * rt_vec_length(up)))
        return rt_fail_field(error, RT_ERROR_INPUT, "up",
                             "camera: up is parallel to the direction of view");
    int is_given = c->focal_distance != 0;
    if (!is_given)
        c->focal_distance = (float)rt_vec_length(axis);
    if (!(c->focal_distance >= RT_LENGTH_MIN && c->focal_distance <= RT_COORDINATE_MAX))
        return rt_fail_field(error, RT_ERROR_INPUT, is_given ? "focal_distance" : "look_at",
                             "camera: %s is %g m; it must lie between %g and %g",
                             is_given ? "focal_distance" : "the distance from eye to look_at",
                             c->focal_distance, RT_LENGTH_MIN, RT_COORDINATE_MAX);
    return RT_OK;
}

rt_status rt_scene_set_camera(rt_scene *scene, const rt_camera *camera, rt_error *error)
{
    rt_camera c = *camera;
    rt_status status;

    if ((unsigned)c.kind > RT_CAMERA_ENVIRONMENT)
        return rt_fail_field(error, RT_ERROR_INPUT, "kind", "camera: there is no kind %d",
                             (int)c.kind);
    if ((status = rt_check_point(c.eye, "camera", "eye", error)) != RT_OK ||
        (status = rt_check_point(c.look_at, "camera", "look_at", error)) != RT_OK ||
        (status = rt_check_point(c.up, "camera", "up", error)) != RT_OK ||
        (status = check_lens(&c, error)) != RT_OK || (status = check_view(&c, error)) != RT_OK)
        return status;
    scene->camera = c;
    scene->has_camera = 1;
    return RT_OK;
}
