/* shape_check.c - shapes on the device against shape_reference. */
#include "kernels/shape_check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "shape_kinds.h"
#include "support.h"

static const double band = 1e-4;
static const double pi = 3.14159265358979323846;

const reference_shape shape_kinds[] = {
    {.kind = RT_SHAPE_ELLIPSOID},
    {.kind = RT_SHAPE_DISC},
    {.kind = RT_SHAPE_DISC, .p = 0.6f},
    {.kind = RT_SHAPE_CYLINDER},
    {.kind = RT_SHAPE_CYLINDER, .caps = 1},
    {.kind = RT_SHAPE_CONE},
    {.kind = RT_SHAPE_CONE, .caps = 1},
    {.kind = RT_SHAPE_CONE, .p = 0.4f, .caps = 1},
    {.kind = RT_SHAPE_CONE, .p = 0.9f},
    {.kind = RT_SHAPE_TORUS, .p = 0.25f},
    {.kind = RT_SHAPE_TORUS, .p = 0.95f},
    {.kind = RT_SHAPE_TORUS, .p = 0.01f},
    {.kind = RT_SHAPE_BOX},
};
const size_t shape_kind_count = sizeof shape_kinds / sizeof *shape_kinds;

const shape_place shape_places[] = {{1.0f, 0.0f, 0},   {1e-3f, 0.0f, 1}, {1e3f, 0.0f, 1},
                                    {1.0f, 100.0f, 0}, {1.0f, 3.0f, 1},  {1e-3f, 1000.0f, 1}};
const size_t shape_place_count = sizeof shape_places / sizeof *shape_places;

/* ---- Scenes ---------------------------------------------------------------- */

/* a becomes a b. */
static void multiply(double a[3][3], double b[3][3])
{
    double c[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            c[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
    memcpy(a, c, sizeof c);
}

/* a becomes a times rotations about x, y and z. */
static void rotate(double a[3][3], rays_stream *stream)
{
    for (int axis = 0; axis < 3; axis++) {
        const double angle = 2 * pi * rays_uniform(stream);
        const int i = (axis + 1) % 3, j = (axis + 2) % 3;
        double r[3][3] = {{0}};
        r[axis][axis] = 1;
        r[i][i] = r[j][j] = cos(angle);
        r[i][j] = -sin(angle);
        r[j][i] = sin(angle);
        multiply(a, r);
    }
}

reference_shape shape_placed(rays_stream *stream, size_t kind, size_t place)
{
    const shape_place *where = shape_places + place;
    double m[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, stretch[3][3] = {{0}};
    reference_shape shape = shape_kinds[kind];
    rt_transform transform;
    float to[3];
    rays_direction(stream, to);
    for (int i = 0; i < 3; i++)
        stretch[i][i] = where->is_skewed ? rays_between(stream, 0.25f, 1.0f) : 1.0;
    if (rays_uniform(stream) < 0.5f)
        stretch[0][0] = -stretch[0][0];
    if (where->is_skewed) {
        rotate(m, stream);
        multiply(m, stretch);
        rotate(m, stream);
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            transform.m[i][j] = where->size * (float)m[i][j];
        transform.m[i][3] = where->size * where->offset * to[i];
    }
    reference_place(&shape, &transform);
    return shape;
}

/* ---- Each kind --------------------------------------------------------------- */

static const float zero[3] = {0, 0, 0}, one[3] = {1, 1, 1}, up[3] = {0, 0, 1};

/*
 * Of each kind: a call that adds it, and a point and the normal there, in object space, at these
 * turns and v in [0, 1].
 */
static rt_status ellipsoid_add(rt_scene *scene, const reference_shape *shape,
                               const rt_surface *surface, rt_error *error)
{
    (void)shape;
    return rt_scene_add_ellipsoid(scene, NULL, zero, one, surface, error);
}

static void ellipsoid_point(const reference_shape *shape, double turn, double v, double p[3],
                            double n[3])
{
    (void)shape;
    p[2] = 2 * v - 1;
    p[0] = sqrt(1 - p[2] * p[2]) * cos(turn);
    p[1] = sqrt(1 - p[2] * p[2]) * sin(turn);
    memcpy(n, p, 3 * sizeof *n);
}

static rt_status disc_add(rt_scene *scene, const reference_shape *shape, const rt_surface *surface,
                          rt_error *error)
{
    return rt_scene_add_disc(scene, NULL, zero, up, 1, (float)shape->p, surface, error);
}

static void disc_point(const reference_shape *shape, double turn, double v, double p[3],
                       double n[3])
{
    const double r = shape->p + (1 - shape->p) * v;
    p[0] = r * cos(turn);
    p[1] = r * sin(turn);
    n[2] = 1;
}

static void frustum_point(double top, double turn, double v, double p[3], double n[3])
{
    const double r = 1 - (1 - top) * v, nr = 1 / hypot(1, 1 - top);
    p[0] = r * cos(turn);
    p[1] = r * sin(turn);
    p[2] = v;
    n[0] = nr * cos(turn);
    n[1] = nr * sin(turn);
    n[2] = (1 - top) * nr;
}

static rt_status cylinder_add(rt_scene *scene, const reference_shape *shape,
                              const rt_surface *surface, rt_error *error)
{
    return rt_scene_add_cylinder(scene, NULL, zero, up, 1, shape->caps, surface, error);
}

static void cylinder_point(const reference_shape *shape, double turn, double v, double p[3],
                           double n[3])
{
    (void)shape;
    frustum_point(1, turn, v, p, n);
}

static rt_status cone_add(rt_scene *scene, const reference_shape *shape, const rt_surface *surface,
                          rt_error *error)
{
    return rt_scene_add_cone(scene, NULL, zero, up, 1, (float)shape->p, shape->caps, surface,
                             error);
}

static void cone_point(const reference_shape *shape, double turn, double v, double p[3],
                       double n[3])
{
    frustum_point(shape->p, turn, v, p, n);
}

static rt_status torus_add(rt_scene *scene, const reference_shape *shape, const rt_surface *surface,
                           rt_error *error)
{
    return rt_scene_add_torus(scene, NULL, zero, up, 1, (float)shape->p, surface, error);
}

static void torus_point(const reference_shape *shape, double turn, double v, double p[3],
                        double n[3])
{
    const double x = cos(2 * pi * v), z = sin(2 * pi * v), r = 1 + shape->p * x;
    p[0] = r * cos(turn);
    p[1] = r * sin(turn);
    p[2] = shape->p * z;
    n[0] = x * cos(turn);
    n[1] = x * sin(turn);
    n[2] = z;
}

static rt_status box_add(rt_scene *scene, const reference_shape *shape, const rt_surface *surface,
                         rt_error *error)
{
    static const float two[3] = {2, 2, 2};
    (void)shape;
    return rt_scene_add_box(scene, NULL, zero, two, surface, error);
}

/* The turn chooses one of six faces, and a place across it; v is the place along it. */
static void box_point(const reference_shape *shape, double turn, double v, double p[3], double n[3])
{
    const double x = fmin(3 * turn / pi, 6 - 1e-9);
    const int face = (int)x, axis = face / 2;
    (void)shape;
    p[axis] = n[axis] = face % 2 ? 1 : -1;
    p[(axis + 1) % 3] = 2 * (x - face) - 1;
    p[(axis + 2) % 3] = 2 * v - 1;
}

#define KIND_CHECK(KIND, name, number) [RT_SHAPE_##KIND] = {name##_add, name##_point},
static const struct {
    rt_status (*add)(rt_scene *scene, const reference_shape *shape, const rt_surface *surface,
                     rt_error *error);
    void (*point)(const reference_shape *shape, double turn, double v, double p[3], double n[3]);
} checks[] = {RT_PLACED_SHAPES(KIND_CHECK)};

rt_scene *shape_scene(const reference_shape *shape)
{
    const rt_surface surface = {.transform = shape->to_world};
    rt_scene *scene = rays_scene();
    rt_error error;
    expect_ok(checks[shape->kind].add(scene, shape, &surface, &error), &error);
    return scene;
}

void shape_expect_all_kinds(void)
{
    int seen[SHAPE_KINDS_MAX] = {0};
    for (size_t i = 0; i < shape_kind_count; i++)
        seen[shape_kinds[i].kind] = 1;
    RT_PLACED_SHAPES(EXPECT_SEEN)
}

/* ---- Rays ------------------------------------------------------------------ */

/* A point of the surface and its normal, in object space. */
static void surface_point(rays_stream *stream, const reference_shape *shape, double p[3],
                          double n[3])
{
    const double turn = 2 * pi * rays_uniform(stream), v = rays_uniform(stream);
    for (int i = 0; i < 3; i++)
        p[i] = n[i] = 0;
    checks[shape->kind].point(shape, turn, v, p, n);
}

rt_ray shape_ray(rays_stream *stream, const reference_shape *shape)
{
    const float choice = rays_uniform(stream);
    double from[3], to[3], n[3], o[3], d[3];
    float f[3], g[3];
    rt_ray ray = {.t_min = 0, .t_max = INFINITY};
    surface_point(stream, shape, to, n);
    rays_point(stream, choice < 0.2f ? 0.8f : choice < 0.6f ? 4.0f : 20.0f, f);
    rays_point(stream, choice < 0.3f ? 1.2f : 0.0f, g);
    for (int i = 0; i < 3; i++) {
        from[i] = f[i];
        to[i] += g[i];
    }
    if (choice > 0.6f) {
        /*
         * Towards the point, but along the surface there, and past it by up to a hundredth of the
         * size.
         */
        const double past =
            pow(10, rays_between(stream, -5, -2)) * (rays_uniform(stream) < 0.5f ? 1 : -1);
        const double back = choice > 0.9f ? 1 : 0.03;
        double lift = 0;
        for (int i = 0; i < 3; i++)
            lift += (from[i] - to[i]) * n[i];
        for (int i = 0; i < 3; i++) {
            from[i] = to[i] + back * (from[i] - to[i] - lift * n[i]) + past * n[i];
            to[i] += past * n[i];
        }
    }
    const float speed = rays_between(stream, 0.1f, 3.0f);
    for (int i = 0; i < 3; i++) {
        o[i] = shape->to_world.m[i][3];
        d[i] = 0;
        for (int j = 0; j < 3; j++) {
            o[i] += shape->to_world.m[i][j] * from[j];
            d[i] += shape->to_world.m[i][j] * (to[j] - from[j]);
        }
        ray.origin[i] = (float)o[i];
        ray.direction[i] = (float)d[i] * speed;
    }
    return ray;
}

/* ---- Comparison ------------------------------------------------------------ */

/* What may come of a ray when the shape is not sure to within the band. */
typedef struct verdict {
    reference_hit hit;
    double normal[3];
    int is_sure;       /* all agree on hit or miss, and roughly on t */
    double speed;      /* length of the ray's direction in object space */
    double t, turning; /* by how much t and the normal vary */
} verdict;

static double gap(const double a[3], const double b[3])
{
    return fmax(fabs(a[0] - b[0]), fmax(fabs(a[1] - b[1]), fabs(a[2] - b[2])));
}

/* Without ends, `longer` changes nothing. */
static int has_ends(const reference_shape *shape)
{
    return shape->kind != RT_SHAPE_ELLIPSOID && shape->kind != RT_SHAPE_TORUS;
}

static verdict judge(const reference_shape *shape, const rt_ray *ray)
{
    double o[3], d[3];
    const double speed = reference_ray(shape, ray, o, d);
    verdict v = {.hit = reference_nearest(shape, 0, 0, ray), .speed = speed, .is_sure = 1};
    const int is_hit = v.hit.t < INFINITY;
    if (shape->kind == RT_SHAPE_DISC && fabs(d[2]) < band * speed && fabs(o[2]) < 10 * band)
        v.is_sure = 0; /* in the disc's plane */
    if (is_hit)
        reference_normal(shape, v.hit.normal, v.normal);
    for (int i = 0; i < (has_ends(shape) ? 4 : 2) && v.is_sure; i++) {
        const reference_hit other =
            reference_nearest(shape, i & 1 ? band : -band, i & 2 ? band : -band, ray);
        if ((other.t < INFINITY) != is_hit)
            v.is_sure = 0;
        if (!is_hit || !v.is_sure)
            continue;
        double normal[3];
        reference_normal(shape, other.normal, normal);
        v.t = fmax(v.t, fabs(other.t - v.hit.t));
        v.turning = fmax(v.turning, gap(v.normal, normal));
    }
    if (v.t * speed > 0.02 || v.turning > 0.3)
        v.is_sure = 0;
    if (shape->kind == RT_SHAPE_CONE && is_hit &&
        hypot(v.hit.position[0], v.hit.position[1]) < 20 * band)
        v.is_sure = 0; /* at the apex every normal is near */
    return v;
}

/*
 * Whether the ray hits a shape that differs by the band or less: it may run inside the band without
 * crossing it.
 */
static int runs_in_band(const reference_shape *shape, const rt_ray *ray)
{
    for (double by = band; by > 1e-4 * band; by *= 0.5)
        if (reference_nearest(shape, by, 0, ray).t < INFINITY ||
            reference_nearest(shape, -by, 0, ray).t < INFINITY)
            return 1;
    return 0;
}

static void expect_hit(const reference_shape *shape, const verdict *v, const rt_hit *hit)
{
    const double speed = v->speed;
    const double normal[3] = {hit->normal[0], hit->normal[1], hit->normal[2]};
    const double precision = 0.02 + 0.005 * v->hit.t * speed; /* of positions, in bands */
    const double from_axis = hypot(v->hit.position[0], v->hit.position[1]);
    const double bend =
        precision * band / (shape->kind == RT_SHAPE_TORUS ? shape->p : fmin(1, from_axis));
    double uv[2];
    assert_true(fabs(hit->t - v->hit.t) <= 1e-5 * v->hit.t + precision * v->t + 2e-6 / speed);
    assert_true(gap(normal, v->normal) <= 1e-4 + bend + precision * v->turning);
    if (v->t * speed < 10 * band && reference_parameters(shape, &v->hit, uv)) {
        const double off = fabs(hit->u - uv[0]), off_v = fabs(hit->v - uv[1]);
        assert_true(fmin(off, fabs(1 - off)) <= 2e-3);
        assert_true(fmin(off_v, fabs(1 - off_v)) <= 2e-3);
    }
}

void shape_expect_reference(const reference_shape *shape, size_t count, uint64_t seed)
{
    rays_stream stream = {seed};
    rt_scene *scene = shape_scene(shape);
    rt_renderer *renderer = rays_renderer(scene, RT_ACCEL_BVH);
    rt_ray *rays = malloc(count * sizeof *rays);
    size_t hits = 0, misses = 0, lost = 0, made_up = 0;
    for (size_t i = 0; i < count; i++)
        rays[i] = shape_ray(&stream, shape);
    rt_hit *found = rays_trace(renderer, RT_TRACE_CLOSEST, rays, count);
    rt_hit *any = rays_trace(renderer, RT_TRACE_ANY, rays, count);
    for (size_t i = 0; i < count; i++) {
        const verdict v = judge(shape, rays + i);
        const int is_hit = v.hit.t < INFINITY;
        assert_int_equal(any[i].shape != RT_NONE, found[i].shape != RT_NONE);
        if (!v.is_sure)
            continue;
        lost += is_hit && found[i].shape == RT_NONE;
        made_up += !is_hit && found[i].shape != RT_NONE && !runs_in_band(shape, rays + i);
        hits += is_hit;
        misses += !is_hit;
        if (is_hit && found[i].shape != RT_NONE)
            expect_hit(shape, &v, found + i);
    }
    assert_int_equal(lost, 0);
    assert_int_equal(made_up, 0);
    assert_true(hits > count / 20);
    assert_true(misses > count / 20);
    free(any);
    free(found);
    free(rays);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
}
