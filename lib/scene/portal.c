/* portal.c - openings through which light from infinitely far enters. */
#include "base/error.h"
#include "scene/check.h"
#include "scene/scene.h"

static const double least_sine = 0.9994; /* of the angle between its edges */

rt_status rt_scene_add_portal(rt_scene *scene, const rt_portal *portal, rt_error *error)
{
    static const char who[] = "portal";
    rt_status status;
    if ((status = rt_check_point(portal->corner, who, "corner", error)) != RT_OK ||
        (status = rt_check_point(portal->edge1, who, "edge1", error)) != RT_OK ||
        (status = rt_check_point(portal->edge2, who, "edge2", error)) != RT_OK)
        return status;
    double b[3], c[3], n[3];
    rt_vec_sub(b, portal->edge1, (const float[3]){0, 0, 0});
    rt_vec_sub(c, portal->edge2, (const float[3]){0, 0, 0});
    rt_vec_cross(n, b, c);
    if (!(rt_vec_length(n) >= RT_AREA_MIN))
        return rt_fail_field(error, RT_ERROR_INPUT, "edge2",
                             "portal: its area is %g m^2; it must be at least %g", rt_vec_length(n),
                             RT_AREA_MIN);
    if (rt_vec_length(n) < least_sine * rt_vec_length(b) * rt_vec_length(c))
        return rt_fail_field(error, RT_ERROR_INPUT, "edge2",
                             "portal: edge1 and edge2 must be at right angles, to two degrees");
    status = rt_grow(scene->memory, (void **)&scene->portals, &scene->portal_room,
                     scene->portal_count, sizeof *portal, "the list of portals", error);
    if (status == RT_OK)
        scene->portals[scene->portal_count++] = *portal;
    return status;
}
