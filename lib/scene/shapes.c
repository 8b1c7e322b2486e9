/*
 * shapes.c - the builder calls of the shapes that are no meshes.
 *
 * Quad, plane and sphere are brought to world space; every other shape is kept in a space of its
 * own, as kernels/types.h describes, with the map that places it there followed by the caller's
 * transform.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/error.h"
#include "scene/area.h"
#include "scene/check.h"
#include "scene/scene.h"

static const double pi = 3.14159265358979323846;
static const float zero[3];

/* ---- Bounds ---------------------------------------------------------------- */

/* Rounds a double outwards, with room for the roundings of the kernels that intersect the shape. */
static void set_bounds(rt_scene_shape *shape, int axis, double lo, double hi)
{
    double room = 0x1p-21 * fmax(fabs(lo), fabs(hi));
    shape->lo[axis] = nextafterf((float)(lo - room), -FLT_MAX);
    shape->hi[axis] = nextafterf((float)(hi + room), FLT_MAX);
}

/* What row `a` of the map makes of the shape's own space: the least and the greatest value. */
static void extent(const rt_scene_shape *shape, const double a[4], double *lo, double *hi)
{
    double across = hypot(a[0], a[1]), reach;
    switch (shape->kind) {
    case RT_SHAPE_DISC:
        reach = across;
        break;
    case RT_SHAPE_TORUS:
        reach = across + shape->p[0] * hypot(across, a[2]);
        break;
    case RT_SHAPE_CYLINDER:
    case RT_SHAPE_CONE: {
        double top = shape->kind == RT_SHAPE_CONE ? shape->p[0] * across : across;
        *lo = a[3] + fmin(-across, a[2] - top);
        *hi = a[3] + fmax(across, a[2] + top);
        return;
    }
    default:
        reach = hypot(across, a[2]);
    }
    *lo = a[3] - reach;
    *hi = a[3] + reach;
}

/* Adds an analytic shape whose kind, p and placement are set. */
static rt_status add_analytic(rt_scene *scene, uint32_t *out, rt_scene_shape *shape,
                              const rt_affine *placement, const char *who, rt_error *error)
{
    rt_affine transform, inverse;
    rt_status status = rt_surface_transform(&transform, &shape->surface, who, error);
    if (status != RT_OK)
        return status;
    shape->to_world = rt_affine_product(&transform, placement);
    shape->has_transform = 1;
    if (!rt_affine_inverse(&inverse, &shape->to_world))
        return rt_fail_field(error, RT_ERROR_INPUT, "transform", "%s: it is too small or too flat",
                             who);
    for (int i = 0; i < 3; i++) {
        double lo, hi;
        extent(shape, shape->to_world.m[i], &lo, &hi);
        set_bounds(shape, i, lo, hi);
    }
    return rt_scene_add_shape(scene, out, shape, who, error);
}

/* ---- Checks ---------------------------------------------------------------- */

static rt_status check_radius(float radius, const char *who, const char *field, rt_error *error)
{
    if (!(radius >= RT_LENGTH_MIN && radius <= RT_COORDINATE_MAX))
        return rt_fail_field(error, RT_ERROR_INPUT, field,
                             "%s: %s is %g m; it must lie between %g and %g", who, field, radius,
                             RT_LENGTH_MIN, RT_COORDINATE_MAX);
    return RT_OK;
}

/* Normalises a direction; fails when it has no length. */
static rt_status check_direction(double out[3], const float v[3], const char *who,
                                 const char *field, rt_error *error)
{
    rt_status status = rt_check_point(v, who, field, error);
    if (status != RT_OK)
        return status;
    rt_vec_sub(out, v, zero);
    double length = rt_vec_length(out);
    if (!(length > 0))
        return rt_fail_field(error, RT_ERROR_INPUT, field, "%s: %s is zero", who, field);
    for (int i = 0; i < 3; i++)
        out[i] /= length;
    return RT_OK;
}

/*
 * The map to a circle of this radius about unit vector n at `centre`, with `height` along n for 1.
 */
static rt_affine placement_about(const float centre[3], const double n[3], double radius,
                                 double height)
{
    double x[3], y[3], z[3], origin[3];
    rt_frame_about(n, x, y);
    for (int i = 0; i < 3; i++) {
        x[i] *= radius;
        y[i] *= radius;
        z[i] = height * n[i];
        origin[i] = centre[i];
    }
    return rt_affine_frame(x, y, z, origin);
}

/* ---- Flat shapes ----------------------------------------------------------- */

rt_status rt_scene_add_plane(rt_scene *scene, uint32_t *out, const float point[3],
                             const float normal[3], const rt_surface *surface, rt_error *error)
{
    rt_scene_shape shape = {.kind = RT_SHAPE_PLANE, .surface = *surface, .area = INFINITY};
    rt_affine transform, placement, inverse;
    double n[3], p[3], m[3];
    rt_status status;

    if ((status = rt_check_point(point, "plane", "point", error)) != RT_OK ||
        (status = check_direction(n, normal, "plane", "normal", error)) != RT_OK ||
        (status = rt_surface_transform(&transform, surface, "plane", error)) != RT_OK)
        return status;
    shape.has_transform = !rt_affine_is_identity(&transform);
    placement = placement_about(point, n, 1, 1);
    shape.to_world = rt_affine_product(&transform, &placement);
    rt_affine_inverse(&inverse, &transform);
    rt_affine_normal(m, &inverse, n);
    rt_affine_point(p, &transform, (const double[3]){point[0], point[1], point[2]});
    double length = rt_vec_length(m);
    for (int i = 0; i < 3; i++) {
        shape.p[i] = (float)p[i];
        shape.p[4 + i] = (float)(m[i] / length);
        if (!(fabsf(shape.p[i]) <= RT_COORDINATE_MAX))
            return rt_fail_field(error, RT_ERROR_INPUT, "transform",
                                 "plane: its point lies beyond coordinates of %g",
                                 RT_COORDINATE_MAX);
    }
    return rt_scene_add_shape(scene, out, &shape, "plane", error);
}

rt_status rt_scene_add_quad(rt_scene *scene, uint32_t *out, const float corner[3],
                            const float edge1[3], const float edge2[3], const rt_surface *surface,
                            rt_error *error)
{
    rt_scene_shape shape = {.kind = RT_SHAPE_QUAD, .surface = *surface};
    double v[3][3], n[3];
    rt_status status;

    if ((status = rt_check_point(corner, "quad", "corner", error)) != RT_OK ||
        (status = rt_check_point(edge1, "quad", "edge1", error)) != RT_OK ||
        (status = rt_check_point(edge2, "quad", "edge2", error)) != RT_OK ||
        (status = rt_surface_transform(&shape.to_world, surface, "quad", error)) != RT_OK)
        return status;
    shape.has_transform = !rt_affine_is_identity(&shape.to_world);
    rt_affine_point(v[0], &shape.to_world, (const double[3]){corner[0], corner[1], corner[2]});
    rt_affine_vector(v[1], &shape.to_world, (const double[3]){edge1[0], edge1[1], edge1[2]});
    rt_affine_vector(v[2], &shape.to_world, (const double[3]){edge2[0], edge2[1], edge2[2]});
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            shape.p[3 * k + i] = (float)v[k][i];
        set_bounds(&shape, i, v[0][i] + fmin(v[1][i], 0) + fmin(v[2][i], 0),
                   v[0][i] + fmax(v[1][i], 0) + fmax(v[2][i], 0));
    }
    rt_vec_sub(v[1], shape.p + 3, zero);
    rt_vec_sub(v[2], shape.p + 6, zero);
    rt_vec_cross(n, v[1], v[2]);
    shape.area = rt_vec_length(n);
    if (!(shape.area > 0))
        return rt_fail_field(error, RT_ERROR_INPUT, "edge2",
                             "quad: its area is zero; edge1 and edge2 must not be parallel");
    if (shape.area < RT_AREA_MIN)
        return rt_fail_field(error, RT_ERROR_INPUT, "edge2",
                             "quad: its area is %g m^2; it must be at least %g", shape.area,
                             RT_AREA_MIN);
    return rt_scene_add_shape(scene, out, &shape, "quad", error);
}

rt_status rt_scene_add_disc(rt_scene *scene, uint32_t *out, const float centre[3],
                            const float normal[3], float radius, float inner_radius,
                            const rt_surface *surface, rt_error *error)
{
    rt_scene_shape shape = {.kind = RT_SHAPE_DISC, .surface = *surface};
    double n[3];
    rt_status status;

    if ((status = rt_check_point(centre, "disc", "centre", error)) != RT_OK ||
        (status = check_direction(n, normal, "disc", "normal", error)) != RT_OK ||
        (status = check_radius(radius, "disc", "radius", error)) != RT_OK)
        return status;
    if (!(inner_radius >= 0 && inner_radius < radius))
        return rt_fail_field(
            error, RT_ERROR_INPUT, "inner_radius",
            "disc: inner_radius is %g m; it must be at least 0 and less than radius, %g",
            inner_radius, radius);
    shape.p[0] = inner_radius / radius;
    rt_affine placement = placement_about(centre, n, radius, radius);
    rt_affine transform = rt_affine_from(&surface->transform),
              whole = rt_affine_product(&transform, &placement);
    shape.area = rt_area_disc(&whole, shape.p[0]);
    return add_analytic(scene, out, &shape, &placement, "disc", error);
}

/* ---- Round shapes ---------------------------------------------------------- */

/* A sphere where the map keeps it one, else an ellipsoid. */
static rt_status add_ball(rt_scene *scene, uint32_t *out, const rt_affine *placement,
                          const rt_surface *surface, const char *who, rt_error *error)
{
    rt_scene_shape shape = {.kind = RT_SHAPE_ELLIPSOID, .surface = *surface};
    rt_affine transform = rt_affine_from(&surface->transform),
              whole = rt_affine_product(&transform, placement);
    double radius = rt_affine_similarity(&whole);

    shape.area = radius > 0 ? 4 * pi * radius * radius : rt_area_ellipsoid(&whole);
    if (!(radius > 0))
        return add_analytic(scene, out, &shape, placement, who, error);
    rt_status status = rt_surface_transform(&transform, surface, who, error);
    if (status != RT_OK)
        return status;
    shape.kind = RT_SHAPE_SPHERE;
    shape.to_world = whole;
    shape.p[3] = (float)radius;
    for (int i = 0; i < 3; i++) {
        shape.p[i] = (float)whole.m[i][3];
        shape.lo[i] = nextafterf(shape.p[i] - shape.p[3], -FLT_MAX);
        shape.hi[i] = nextafterf(shape.p[i] + shape.p[3], FLT_MAX);
        for (int j = 0; j < 3; j++)
            shape.has_transform |= i != j ? whole.m[i][j] != 0 : !(whole.m[i][j] > 0);
    }
    return rt_scene_add_shape(scene, out, &shape, who, error);
}

static rt_affine scaling(const float centre[3], double x, double y, double z)
{
    rt_affine a = {{{x, 0, 0, centre[0]}, {0, y, 0, centre[1]}, {0, 0, z, centre[2]}}};
    return a;
}

rt_status rt_scene_add_sphere(rt_scene *scene, uint32_t *out, const float centre[3], float radius,
                              const rt_surface *surface, rt_error *error)
{
    rt_status status = rt_check_point(centre, "sphere", "centre", error);
    if (status == RT_OK)
        status = check_radius(radius, "sphere", "radius", error);
    if (status != RT_OK)
        return status;
    rt_affine placement = scaling(centre, radius, radius, radius);
    return add_ball(scene, out, &placement, surface, "sphere", error);
}

rt_status rt_scene_add_ellipsoid(rt_scene *scene, uint32_t *out, const float centre[3],
                                 const float radii[3], const rt_surface *surface, rt_error *error)
{
    rt_status status = rt_check_point(centre, "ellipsoid", "centre", error);
    for (int i = 0; i < 3 && status == RT_OK; i++)
        status = check_radius(radii[i], "ellipsoid", "radii", error);
    if (status != RT_OK)
        return status;
    rt_affine placement = scaling(centre, radii[0], radii[1], radii[2]);
    return add_ball(scene, out, &placement, surface, "ellipsoid", error);
}

/* A cylinder or cone from a to b, whose radius is `top` of the one at a when it comes to b. */
static rt_status add_round(rt_scene *scene, uint32_t *out, rt_scene_shape *shape, const float a[3],
                           const float b[3], float radius, const char *const names[3],
                           rt_error *error)
{
    const char *who = names[0];
    double n[3];
    rt_status status;
    if ((status = rt_check_point(a, who, names[1], error)) != RT_OK ||
        (status = rt_check_point(b, who, names[2], error)) != RT_OK ||
        (status = check_radius(radius, who, "radius", error)) != RT_OK)
        return status;
    rt_vec_sub(n, b, a);
    double height = rt_vec_length(n);
    if (!(height > 0))
        return rt_fail_field(error, RT_ERROR_INPUT, names[2], "%s: %s and %s are the same point",
                             who, names[1], names[2]);
    for (int i = 0; i < 3; i++)
        n[i] /= height;
    rt_affine placement = placement_about(a, n, radius, height);
    rt_affine transform = rt_affine_from(&shape->surface.transform),
              whole = rt_affine_product(&transform, &placement);
    shape->area = rt_area_cone(&whole, shape->kind == RT_SHAPE_CONE ? shape->p[0] : 1, shape->caps);
    return add_analytic(scene, out, shape, &placement, who, error);
}

rt_status rt_scene_add_cylinder(rt_scene *scene, uint32_t *out, const float a[3], const float b[3],
                                float radius, int caps, const rt_surface *surface, rt_error *error)
{
    static const char *const names[] = {"cylinder", "a", "b"};
    rt_scene_shape shape = {.kind = RT_SHAPE_CYLINDER, .surface = *surface, .caps = caps};
    return add_round(scene, out, &shape, a, b, radius, names, error);
}

rt_status rt_scene_add_cone(rt_scene *scene, uint32_t *out, const float base[3],
                            const float apex[3], float radius, float apex_radius, int caps,
                            const rt_surface *surface, rt_error *error)
{
    static const char *const names[] = {"cone", "base", "apex"};
    rt_scene_shape shape = {.kind = RT_SHAPE_CONE, .surface = *surface, .caps = caps};
    if (!(apex_radius >= 0 && apex_radius <= radius))
        return rt_fail_field(
            error, RT_ERROR_INPUT, "apex_radius",
            "cone: apex_radius is %g m; it must be at least 0 and at most radius, %g", apex_radius,
            radius);
    shape.p[0] = radius > 0 ? apex_radius / radius : 0;
    return add_round(scene, out, &shape, base, apex, radius, names, error);
}

rt_status rt_scene_add_torus(rt_scene *scene, uint32_t *out, const float centre[3],
                             const float axis[3], float major_radius, float minor_radius,
                             const rt_surface *surface, rt_error *error)
{
    rt_scene_shape shape = {.kind = RT_SHAPE_TORUS, .surface = *surface};
    double n[3];
    rt_status status;

    if ((status = rt_check_point(centre, "torus", "centre", error)) != RT_OK ||
        (status = check_direction(n, axis, "torus", "axis", error)) != RT_OK ||
        (status = check_radius(major_radius, "torus", "major_radius", error)) != RT_OK ||
        (status = check_radius(minor_radius, "torus", "minor_radius", error)) != RT_OK)
        return status;
    if (!(minor_radius < major_radius))
        return rt_fail_field(error, RT_ERROR_INPUT, "minor_radius",
                             "torus: minor_radius is %g m; it must be less than major_radius, %g",
                             minor_radius, major_radius);
    shape.p[0] = minor_radius / major_radius;
    rt_affine placement = placement_about(centre, n, major_radius, major_radius);
    rt_affine transform = rt_affine_from(&surface->transform),
              whole = rt_affine_product(&transform, &placement);
    shape.area = rt_area_torus(&whole, shape.p[0]);
    return add_analytic(scene, out, &shape, &placement, "torus", error);
}
