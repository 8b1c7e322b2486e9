/* emitters.c - scenes with one area light, and points on it. */
#include "statistics/emitters.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/light_draw.h"
#include "statistics/space.h"

enum { triangles = 12 };

static const rt_transform skew = {
    {{1.2f, 0.1f, 0, 0.3f}, {-0.2f, 0.8f, 0.3f, 0.1f}, {0, -0.2f, 1.1f, 0}}};

/* The rectangle and the parallelogram. */
static const float corner[3] = {1, 2, 3}, edge1[3] = {2, 0, 0}, right[3] = {0, 0, 1},
                   slanted[3] = {1, 0, 1};

static const float vertices[9] = {0, 2, 0, 1, 2, 0, 0, 2, 2};

/* The others: centre or base; towards the top or along the axis. */
static const float centre[3] = {0.3f, 0.2f, -0.1f}, top[3] = {0.5f, 1.4f, 0.3f},
                   radii[3] = {0.5f, 0.2f, 0.8f}, edges[3] = {0.5f, 1.2f, 0.8f};

static const double sphere_radius = 0.5, disc_radius = 0.7f, disc_hole = 0.3f, torus_major = 0.6f,
                    torus_minor = 0.2f;

/* Radii of the cylinders and cones at base and top. */
static void cylinder_radii(emitter kind, double *at_base, double *at_top)
{
    *at_base = kind == EMIT_PIPE || kind == EMIT_CYLINDER ? 0.4f : 0.5f;
    *at_top = kind == EMIT_CONE ? 0 : kind == EMIT_FRUSTUM ? 0.2f : *at_base;
}

static int is_closed(emitter kind)
{
    return kind >= EMIT_CYLINDER;
}

/* ---- The emitters --------------------------------------------------------------- */

static double strip_width(int i)
{
    return (i * 7 % 5 + 1) / 5.0;
}

static double strip_depth(int i)
{
    return (i * 3 % 4 + 1) / 2.0;
}

/* Triangle i has its corner at (i, 2, 0), one edge along x and one along z. */
static rt_status add_mesh(rt_scene *scene, const rt_surface *surface, rt_error *error)
{
    float positions[9 * triangles];
    uint32_t indices[3 * triangles];
    for (int i = 0; i < triangles; i++) {
        const float three[9] = {(float)i, 2,        0, (float)(i + strip_width(i)), 2,
                                0,        (float)i, 2, (float)strip_depth(i)};
        memcpy(positions + 9 * i, three, sizeof three);
        for (int c = 0; c < 3; c++)
            indices[3 * i + c] = (uint32_t)(3 * i + c);
    }
    return rt_scene_add_triangles(scene, NULL, positions, 3 * triangles, indices, triangles, NULL,
                                  surface, error);
}

static rt_status add_emitter(rt_scene *scene, emitter kind, const rt_surface *surface,
                             rt_error *error)
{
    static const uint32_t one[3] = {0, 1, 2};
    double at_base, at_top;
    cylinder_radii(kind, &at_base, &at_top);
    switch (kind) {
    case EMIT_BOX:
        return rt_scene_add_box(scene, NULL, centre, edges, surface, error);
    case EMIT_RECTANGLE:
    case EMIT_TWO_SIDED:
        return rt_scene_add_quad(scene, NULL, corner, edge1, right, surface, error);
    case EMIT_PARALLELOGRAM:
        return rt_scene_add_quad(scene, NULL, corner, edge1, slanted, surface, error);
    case EMIT_TRIANGLE:
        return rt_scene_add_triangles(scene, NULL, vertices, 3, one, 1, NULL, surface, error);
    case EMIT_MESH:
        return add_mesh(scene, surface, error);
    case EMIT_SPHERE:
        return rt_scene_add_sphere(scene, NULL, centre, (float)sphere_radius, surface, error);
    case EMIT_ELLIPSOID:
        return rt_scene_add_ellipsoid(scene, NULL, centre, radii, surface, error);
    case EMIT_DISC:
        return rt_scene_add_disc(scene, NULL, centre, top, (float)disc_radius, (float)disc_hole,
                                 surface, error);
    case EMIT_TORUS:
        return rt_scene_add_torus(scene, NULL, centre, top, (float)torus_major, (float)torus_minor,
                                  surface, error);
    case EMIT_PIPE:
    case EMIT_CYLINDER:
        return rt_scene_add_cylinder(scene, NULL, centre, top, (float)at_base, is_closed(kind),
                                     surface, error);
    default:
        return rt_scene_add_cone(scene, NULL, centre, top, (float)at_base, (float)at_top, 1,
                                 surface, error);
    }
}

static int is_skew(emitter kind)
{
    return kind >= EMIT_ELLIPSOID && kind <= EMIT_TORUS;
}

rt_scene *emitter_scene(emitter kind)
{
    const float radiance = (float)EMITTED_RADIANCE;
    rt_material material = {.emission = {radiance, radiance, radiance},
                            .two_sided = kind == EMIT_TWO_SIDED};
    rt_surface surface;
    rt_scene *scene = light_scene();
    rt_error error;
    memset(&surface, 0, sizeof surface);
    expect_ok(rt_scene_add_material(scene, &surface.material, NULL, &material, &error), &error);
    if (is_skew(kind))
        surface.transform = skew;
    expect_ok(add_emitter(scene, kind, &surface, &error), &error);
    return scene;
}

/* ---- Parameters ------------------------------------------------------------------ */

/* Axes of the cylinders and cones: the last is theirs, and not of unit length but theirs. */
typedef struct axes {
    double s[3], t[3], along[3];
} axes;

/* Those of disc and torus, and of the others. */
static axes across_top, from_centre;

static void find_axes(void)
{
    double unit[3];
    wide(across_top.along, top);
    normalise(across_top.along);
    axes_about(across_top.along, across_top.s, across_top.t);
    rt_vec_sub(from_centre.along, top, centre);
    memcpy(unit, from_centre.along, sizeof unit);
    normalise(unit);
    axes_about(unit, from_centre.s, from_centre.t);
}

/* Found once, as every sample is placed by them. */
static const axes *axes_of(emitter kind)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, find_axes);
    return kind < EMIT_PIPE ? &across_top : &from_centre;
}

/* Radius and height of the cylinders and cones, before the transform. */
static void profile(emitter kind, double x, double *radius, double *height)
{
    double at_base, at_top;
    cylinder_radii(kind, &at_base, &at_top);
    *height = 0;
    if (kind == EMIT_DISC) {
        *radius = disc_hole + x * (disc_radius - disc_hole);
    } else if (kind == EMIT_TORUS) {
        *radius = torus_major + torus_minor * cos(2 * PI * x);
        *height = torus_minor * sin(2 * PI * x);
    } else if (!is_closed(kind) || x < 1.0 / 3) {
        *height = is_closed(kind) ? 3 * x : x;
        *radius = at_base + *height * (at_top - at_base);
    } else {
        *height = x >= 2.0 / 3;
        *radius = *height > 0 ? (3 * x - 2) * at_top : (3 * x - 1) * at_base;
    }
}

static void cylinder_point(emitter kind, double x, double y, double out[3])
{
    const axes *a = axes_of(kind);
    double radius, height;
    profile(kind, x, &radius, &height);
    for (int i = 0; i < 3; i++)
        out[i] = centre[i] + radius * (cos(2 * PI * y) * a->s[i] + sin(2 * PI * y) * a->t[i]) +
                 height * a->along[i];
}

static void ball_point(emitter kind, double x, double y, double out[3])
{
    const double z = 2 * x - 1, r = sqrt(fmax(0, 1 - z * z));
    const double n[3] = {r * cos(2 * PI * y), r * sin(2 * PI * y), z};
    for (int i = 0; i < 3; i++)
        out[i] = centre[i] + n[i] * (kind == EMIT_SPHERE ? sphere_radius : radii[i]);
}

static void flat_point(emitter kind, double x, double y, double out[3])
{
    const float *second = kind == EMIT_PARALLELOGRAM ? slanted : right;
    const int which = (int)fmax(0, fmin(triangles - 1, floor(x * triangles)));
    const double part = x * triangles - which;
    for (int i = 0; i < 3; i++)
        out[i] = corner[i] + x * edge1[i] + y * second[i];
    if (kind == EMIT_TRIANGLE)
        for (int i = 0; i < 3; i++)
            out[i] = vertices[i] + x * (vertices[3 + i] - vertices[i]) +
                     y * (1 - x) * (vertices[6 + i] - vertices[i]);
    if (kind == EMIT_MESH) {
        out[0] = which + part * strip_width(which);
        out[2] = y * (1 - part) * strip_depth(which);
    }
}

/* Face 2 a is at the low end of axis a, and face 2 a + 1 at its high end. */
static void box_point(double x, double y, double out[3])
{
    const int face = (int)fmax(0, fmin(5, floor(6 * x))), axis = face / 2;
    const double place[3] = {face % 2, 6 * x - face, y};
    for (int i = 0; i < 3; i++) {
        const int a = (axis + i) % 3;
        out[a] = centre[a] + (place[i] - 0.5) * edges[a];
    }
}

static void box_place(const double p[3], const float normal[3], double *x, double *y)
{
    const int axis = fabsf(normal[0]) > 0.5f ? 0 : fabsf(normal[1]) > 0.5f ? 1 : 2;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double within = (p[u] - centre[u]) / edges[u] + 0.5;
    *x = (2 * axis + (normal[axis] > 0) + fmax(0, fmin(within, 1 - 1e-9))) / 6;
    *y = (p[v] - centre[v]) / edges[v] + 0.5;
}

/* By the areas of the faces. */
static double box_density(double x)
{
    const double areas[3] = {edges[1] * edges[2], edges[2] * edges[0], edges[0] * edges[1]};
    const int axis = (int)fmax(0, fmin(2, floor(3 * x)));
    return 3 * areas[axis] / (areas[0] + areas[1] + areas[2]);
}

void emitter_point(emitter kind, double x, double y, double out[3])
{
    double p[3];
    if (kind == EMIT_BOX)
        box_point(x, y, p);
    else if (kind < EMIT_SPHERE)
        flat_point(kind, x, y, p);
    else if (kind <= EMIT_ELLIPSOID)
        ball_point(kind, x, y, p);
    else
        cylinder_point(kind, x, y, p);
    for (int i = 0; i < 3; i++)
        out[i] = is_skew(kind) ? skew.m[i][0] * p[0] + skew.m[i][1] * p[1] + skew.m[i][2] * p[2] +
                                     skew.m[i][3]
                               : p[i];
}

/* What the transform maps to a point: by Cramer's rule. */
static void before_skew(const float position[3], double out[3])
{
    double columns[3][3], away[3], cross[3];
    for (int i = 0; i < 3; i++) {
        away[i] = (double)position[i] - skew.m[i][3];
        for (int c = 0; c < 3; c++)
            columns[c][i] = skew.m[i][c];
    }
    for (int c = 0; c < 3; c++) {
        rt_vec_cross(cross, columns[(c + 1) % 3], columns[(c + 2) % 3]);
        out[c] = dot3(away, cross) / dot3(columns[c], cross);
    }
}

static void flat_place(emitter kind, const double p[3], double *x, double *y)
{
    if (kind == EMIT_TRIANGLE) {
        *x = p[0];
        *y = *x < 1 ? p[2] / 2 / (1 - *x) : 0;
    } else if (kind == EMIT_MESH) {
        const int which = (int)fmax(0, fmin(triangles - 1, floor(p[0] + 1e-6)));
        const double part = (p[0] - which) / strip_width(which);
        *x = (which + fmax(0, fmin(part, 1 - 1e-9))) / triangles;
        *y = part < 1 ? p[2] / strip_depth(which) / (1 - part) : 0;
    } else {
        *y = p[2] - corner[2];
        *x = (p[0] - corner[0] - (kind == EMIT_PARALLELOGRAM ? *y : 0)) / 2;
    }
}

static void round_place(emitter kind, const double p[3], const float normal[3], double *x,
                        double *y)
{
    const axes *a = axes_of(kind);
    double away[3], n[3], at_base, at_top;
    cylinder_radii(kind, &at_base, &at_top);
    for (int i = 0; i < 3; i++)
        away[i] = p[i] - centre[i];
    wide(n, normal);
    const double radius = distance(dot3(away, a->s), dot3(away, a->t)),
                 height = dot3(away, a->along) / dot3(a->along, a->along);
    const double facing = dot3(n, a->along) / rt_vec_length(a->along);
    *y = turns_of(dot3(away, a->s), dot3(away, a->t));
    if (kind == EMIT_DISC)
        *x = (radius - disc_hole) / (disc_radius - disc_hole);
    else if (kind == EMIT_TORUS)
        *x = turns_of(radius - torus_major, height);
    else if (!is_closed(kind))
        *x = height;
    else
        *x = (facing < -0.9  ? 1 + radius / at_base
              : facing > 0.9 ? 2 + radius / at_top
                             : height) /
             3;
}

void emitter_place(emitter kind, const float position[3], const float normal[3], double *x,
                   double *y)
{
    double p[3];
    wide(p, position);
    if (is_skew(kind))
        before_skew(position, p);
    if (kind == EMIT_BOX) {
        box_place(p, normal, x, y);
    } else if (kind < EMIT_SPHERE) {
        flat_place(kind, p, x, y);
    } else if (kind <= EMIT_ELLIPSOID) {
        double n[3];
        for (int i = 0; i < 3; i++)
            n[i] = (p[i] - centre[i]) / (kind == EMIT_SPHERE ? sphere_radius : radii[i]);
        *x = 0.5 + 0.5 * n[2];
        *y = turns_of(n[0], n[1]);
    } else {
        round_place(kind, p, normal, x, y);
    }
}

/* ---- Area ------------------------------------------------------------------------ */

/* The product of the derivatives, by central differences. */
static void across(emitter kind, double x, double y, double out[3])
{
    const double h = 1e-6;
    double a[3], b[3], dx[3], dy[3];
    emitter_point(kind, x + h, y, a);
    emitter_point(kind, x - h, y, b);
    for (int i = 0; i < 3; i++)
        dx[i] = (a[i] - b[i]) / (2 * h);
    emitter_point(kind, x, y + h, a);
    emitter_point(kind, x, y - h, b);
    for (int i = 0; i < 3; i++)
        dy[i] = (a[i] - b[i]) / (2 * h);
    rt_vec_cross(out, dx, dy);
}

double emitter_element(emitter kind, double x, double y)
{
    double product[3];
    across(kind, x, y, product);
    return rt_vec_length(product);
}

void emitter_normal(emitter kind, double x, double y, double out[3])
{
    across(kind, x, y, out);
    normalise(out);
}

/* By the areas of side and caps, and by radius on each. */
static double round_density(emitter kind, double x)
{
    double at_base, at_top, along[3], radius, height;
    cylinder_radii(kind, &at_base, &at_top);
    rt_vec_sub(along, top, centre);
    profile(kind, x, &radius, &height);
    const double side = PI * (at_base + at_top) * distance(rt_vec_length(along), at_base - at_top);
    const double base = PI * at_base * at_base, cover = PI * at_top * at_top,
                 all = side + base + cover;
    const double on_side = 2 * radius / (at_base + at_top);
    if (!is_closed(kind))
        return on_side;
    if (x < 1.0 / 3)
        return 3 * on_side * side / all;
    if (x < 2.0 / 3)
        return 3 * 2 * radius / at_base * base / all;
    return at_top > 0 ? 3 * 2 * radius / at_top * cover / all : 0;
}

double emitter_density(emitter kind, double x, double y)
{
    double radius, height, total = 0;
    (void)y;
    switch (kind) {
    case EMIT_BOX:
        return box_density(x);
    case EMIT_TRIANGLE:
        return 2 * (1 - x);
    case EMIT_MESH: {
        const int which = (int)fmax(0, fmin(triangles - 1, floor(x * triangles)));
        for (int i = 0; i < triangles; i++)
            total += strip_width(i) * strip_depth(i);
        return triangles * strip_width(which) * strip_depth(which) / total * 2 *
               (1 - (x * triangles - which));
    }
    case EMIT_DISC:
        profile(kind, x, &radius, &height);
        return 2 * radius * (disc_radius - disc_hole) /
               (disc_radius * disc_radius - disc_hole * disc_hole);
    case EMIT_TORUS:
        profile(kind, x, &radius, &height);
        return radius / torus_major;
    default:
        return kind >= EMIT_PIPE ? round_density(kind, x) : 1;
    }
}

/* ---- Renderers --------------------------------------------------------------------- */

static rt_renderer *kept;
static const void *kept_for;
static rt_scene *(*kept_by)(const void *key);

static void drop(void)
{
    rt_renderer_destroy(kept);
}

rt_renderer *kept_renderer(const void *key, rt_scene *(*build)(const void *key))
{
    static int is_dropped_at_exit;
    if (kept && key == kept_for && build == kept_by)
        return kept;
    rt_renderer *made = light_renderer(build(key));
    rt_renderer_destroy(kept);
    kept = made;
    kept_for = key;
    kept_by = build;
    /* After the device is opened, so that it is still there. */
    if (!is_dropped_at_exit)
        is_dropped_at_exit = atexit(drop) == 0;
    return kept;
}
