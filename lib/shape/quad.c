/* quad.c - the parallelogram, in world space: p[0..2] a corner, p[3..5] and p[6..8] its edges. */
#include "shape/edges.h"
#include "shape/placed.h"

#include <math.h>
#include <string.h>

static const float zero[3];

static void light(rt_light_data *out, const rt_scene *scene, const rt_scene_shape *shape,
                  size_t primitive)
{
    (void)primitive;
    const float *p = rt_scene_parameters(scene, shape);
    double b[3], c[3];
    out->kind = RT_LIGHT_QUAD;
    memcpy(out->a, p, sizeof out->a);
    rt_vec_sub(b, p + 3, zero);
    rt_vec_sub(c, p + 6, zero);
    rt_light_set_edges(out, b, c);
}

const rt_shape_class rt_shape_quad = {.name = "quad",
                                      .storage = RT_STORED_QUAD,
                                      .faces = RT_FACES_FLAT,
                                      .boundary = rt_boundary_flat,
                                      .light = light};

rt_status rt_scene_add_quad(rt_scene *scene, uint32_t *out, const float corner[3],
                            const float edge1[3], const float edge2[3], const rt_surface *surface,
                            rt_error *error)
{
    rt_new_shape added = {.shape.kind = RT_SHAPE_QUAD, .surface = surface};
    rt_affine *to_world = &added.placement.to_world;
    float *p = added.placement.p;
    double v[3][3], n[3];
    rt_status status;

    if ((status = rt_check_point(corner, "quad", "corner", error)) != RT_OK ||
        (status = rt_check_point(edge1, "quad", "edge1", error)) != RT_OK ||
        (status = rt_check_point(edge2, "quad", "edge2", error)) != RT_OK ||
        (status = rt_surface_transform(to_world, surface, "quad", error)) != RT_OK)
        return status;
    added.shape.has_transform = !rt_affine_is_identity(to_world);
    rt_affine_point(v[0], to_world, (const double[3]){corner[0], corner[1], corner[2]});
    rt_affine_vector(v[1], to_world, (const double[3]){edge1[0], edge1[1], edge1[2]});
    rt_affine_vector(v[2], to_world, (const double[3]){edge2[0], edge2[1], edge2[2]});
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            p[3 * k + i] = (float)v[k][i];
        rt_shape_set_bounds(&added.shape, i, v[0][i] + fmin(v[1][i], 0) + fmin(v[2][i], 0),
                            v[0][i] + fmax(v[1][i], 0) + fmax(v[2][i], 0));
    }
    rt_vec_sub(v[1], p + 3, zero);
    rt_vec_sub(v[2], p + 6, zero);
    rt_vec_cross(n, v[1], v[2]);
    added.area = rt_vec_length(n);
    if (!(added.area > 0))
        return rt_fail_field(error, RT_ERROR_INPUT, "edge2",
                             "quad: its area is zero; edge1 and edge2 must not be parallel");
    if (added.area < RT_AREA_MIN)
        return rt_fail_field(error, RT_ERROR_INPUT, "edge2",
                             "quad: its area is %g m^2; it must be at least %g", added.area,
                             RT_AREA_MIN);
    return rt_scene_add_shape(scene, out, &added, "quad", error);
}
