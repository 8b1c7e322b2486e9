/* view.c - the rays of a camera, and which shapes they may meet. */
#include "scene/view.h"

#include <math.h>
#include <string.h>

#include "base/vec.h"

static const double pi = 3.14159265358979323846;

/* ---- The camera's rays ----------------------------------------------------- */

static void scale(float out[3], const double v[3], double factor)
{
    for (int i = 0; i < 3; i++)
        out[i] = (float)(v[i] * factor);
}

/* Half the width of what is seen at the focal distance. */
static double half_width_of(const rt_camera *camera)
{
    if (camera->kind == RT_CAMERA_ORTHOGRAPHIC)
        return 0.5 * camera->width;
    return camera->focal_distance * tan(0.5 * camera->fov * pi / 180);
}

void rt_view_aim(rt_camera_data *out, const rt_camera *camera, uint32_t width, uint32_t height)
{
    static const float origin[3];
    double axis[3], right[3], up[3], corner[3];
    double half_width = half_width_of(camera), half_height = half_width * height / width;
    double depth = camera->kind == RT_CAMERA_ORTHOGRAPHIC ? 0 : camera->focal_distance;

    rt_vec_sub(axis, camera->look_at, camera->eye);
    rt_vec_sub(up, camera->up, origin);
    double length = rt_vec_length(axis);
    for (int i = 0; i < 3; i++)
        axis[i] /= length;
    rt_vec_cross(right, axis, up);
    length = rt_vec_length(right);
    for (int i = 0; i < 3; i++)
        right[i] /= length;
    rt_vec_cross(up, right, axis);
    const int is_panorama = camera->kind == RT_CAMERA_ENVIRONMENT;
    const double left = is_panorama ? 1 : 1 - 2 * (double)camera->shift[0],
                 top = is_panorama ? 1 : 1 + 2 * (double)camera->shift[1];
    for (int i = 0; i < 3; i++) {
        if (camera->mirror)
            right[i] = -right[i];
        corner[i] = depth * axis[i] - left * half_width * right[i] + top * half_height * up[i];
    }

    memset(out, 0, sizeof *out);
    memcpy(out->eye, camera->eye, sizeof out->eye);
    out->aperture = camera->aperture;
    out->kind = camera->kind;
    out->blades = camera->blades;
    out->blade_rotation = (float)(fmod(camera->blade_rotation, 360) * pi / 180);
    out->hides_emitters = camera->hide_emitters != 0;
    out->focal_distance = camera->focal_distance;
    scale(out->corner, corner, 1);
    scale(out->across, right, 2 * half_width);
    scale(out->down, up, -2 * half_height);
    scale(out->lens_u, right, 1);
    scale(out->lens_v, up, 1);
    scale(out->axis, axis, 1);
}

/* ---- What they may meet ---------------------------------------------------- */

/*
 * Whether a plane of the view has the whole box on its outer side: n . (p - eye) + c < 0 for all of
 * its points p.
 */
static int is_outside(const rt_scene_shape *box, const float eye[3], const double n[3], double c)
{
    for (int i = 0; i < 3; i++)
        c += n[i] * ((double)(n[i] > 0 ? box->hi[i] : box->lo[i]) - eye[i]);
    return c < 0;
}

/*
 * Whether the box lies beyond the picture's edge on the side of this unit vector, times sign, which
 * is this far from the axis.
 */
static int is_beside(const rt_scene_shape *box, const rt_camera_data *c, const float side[3],
                     double sign, double edge)
{
    double n[3];
    int is_perspective = c->kind == RT_CAMERA_KIND_PERSPECTIVE;
    for (int i = 0; i < 3; i++)
        n[i] = is_perspective ? edge * c->axis[i] - sign * c->focal_distance * side[i]
                              : -sign * side[i];
    return is_outside(box, c->eye, n, is_perspective ? 0 : edge);
}

static int may_see_box(const rt_camera_data *c, const rt_scene_shape *box)
{
    const double axis[3] = {c->axis[0], c->axis[1], c->axis[2]};
    const double across[3] = {c->across[0], c->across[1], c->across[2]},
                 down[3] = {c->down[0], c->down[1], c->down[2]};
    double half_width = 0.5 * rt_vec_length(across), half_height = 0.5 * rt_vec_length(down),
           right = 0, up = 0; /* where the middle of the picture lies */
    for (int i = 0; i < 3; i++) {
        const double middle = c->corner[i] + 0.5 * (across[i] + down[i]);
        right += middle * c->lens_u[i];
        up += middle * c->lens_v[i];
    }
    if (is_outside(box, c->eye, axis, 0))
        return 0;
    /* Rays through a lens leave the pyramid of those through its middle. */
    if (c->aperture > 0)
        return 1;
    return !is_beside(box, c, c->lens_u, 1, half_width + right) &&
           !is_beside(box, c, c->lens_u, -1, half_width - right) &&
           !is_beside(box, c, c->lens_v, 1, half_height + up) &&
           !is_beside(box, c, c->lens_v, -1, half_height - up);
}

/* Whether a ray of the picture meets an infinite plane; if any does, so does one at a corner. */
static int may_see_plane(const rt_camera_data *c, const float plane[8])
{
    if (c->aperture > 0)
        return 1;
    for (int corner = 0; corner < 4; corner++) {
        double distance = 0, slope = 0;
        for (int i = 0; i < 3; i++) {
            double at = c->corner[i] + (corner & 1) * (double)c->across[i] +
                        (corner >> 1) * (double)c->down[i];
            int is_perspective = c->kind == RT_CAMERA_KIND_PERSPECTIVE;
            distance += plane[4 + i] * ((double)plane[i] - c->eye[i] - (is_perspective ? 0 : at));
            slope += plane[4 + i] * (is_perspective ? at : c->axis[i]);
        }
        if (distance == 0 || distance * slope > 0)
            return 1;
    }
    return 0;
}

int rt_view_may_see(const rt_camera_data *camera, const rt_scene *scene,
                    const rt_scene_shape *shape)
{
    if (camera->kind == RT_CAMERA_KIND_ENVIRONMENT)
        return 1;
    return shape->kind == RT_SHAPE_PLANE ? may_see_plane(camera, rt_scene_parameters(scene, shape))
                                         : may_see_box(camera, shape);
}
