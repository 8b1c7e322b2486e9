/*
 * test_intersect.c - each primitive against its closed form in float64, and rays that leave a
 * surface.
 *
 * A hit is expected where the closed form is inside the edge by more than 1e-4 of the size, a miss
 * where it is outside by more; in between either is right.
 */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/rays.h"
#include "render/renderer.h"
#include "support.h"

enum { rays_each = 250000 };
static const double band = 1e-4;

/* The closed form for a ray. */
typedef struct solution {
    double clearance; /* relative to the size: positive inside, negative outside */
    double t, normal[3];
    double u, v;
    int u_is_known;
} solution;

typedef struct shape {
    float p[9];  /* as the primitive needs */
    double size; /* its extent */
    solution (*solve)(const struct shape *shape, const rt_ray *ray);
} shape;

static void minus(double out[3], const double a[3], const double b[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[i] - b[i];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(double out[3], const double a[3], const double b[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static void load(double out[3], const float in[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = in[i];
}

/* Solves origin + t direction = p0 + u e1 + v e2 by Cramer's rule. */
static solution solve_edges(const double p0[3], const double e1[3], const double e2[3],
                            const rt_ray *ray)
{
    solution result = {0};
    double o[3], d[3], s[3], n[3], q[3];
    load(o, ray->origin);
    load(d, ray->direction);
    minus(s, o, p0);
    cross(n, e1, e2);
    const double det = -dot(d, n), length = sqrt(dot(n, n));
    result.t = dot(s, n) / det;
    cross(q, s, d);
    result.u = -dot(e2, q) / det * -1.0;
    result.v = dot(e1, q) / det * -1.0;
    for (int i = 0; i < 3; i++)
        result.normal[i] = n[i] / length;
    result.u_is_known = 1;
    return result;
}

static solution solve_triangle(const shape *shape, const rt_ray *ray)
{
    double v[3][3], e1[3], e2[3];
    for (int c = 0; c < 3; c++)
        load(v[c], shape->p + 3 * c);
    minus(e1, v[1], v[0]);
    minus(e2, v[2], v[0]);
    solution result = solve_edges(v[0], e1, e2, ray);
    result.clearance = fmin(fmin(result.u, result.v), 1.0 - result.u - result.v);
    return result;
}

static solution solve_quad(const shape *shape, const rt_ray *ray)
{
    double p0[3], e1[3], e2[3];
    load(p0, shape->p);
    load(e1, shape->p + 3);
    load(e2, shape->p + 6);
    solution result = solve_edges(p0, e1, e2, ray);
    result.clearance = fmin(fmin(result.u, result.v), fmin(1.0 - result.u, 1.0 - result.v));
    return result;
}

static solution solve_sphere(const shape *shape, const rt_ray *ray)
{
    solution result = {0};
    double c[3], o[3], d[3], f[3];
    const double r = shape->p[3];
    load(c, shape->p);
    load(o, ray->origin);
    load(d, ray->direction);
    minus(f, o, c);
    const double a = dot(d, d), b = dot(f, d), k = dot(f, f) - r * r;
    const double disc = b * b - a * k;
    /* The line's distance from the centre, against the radius. */
    result.clearance = (r - sqrt(fmax(0.0, dot(f, f) - b * b / a))) / r;
    if (disc < 0.0)
        return result;
    const double q = -b - copysign(sqrt(disc), b);
    const double t0 = fmin(k / q, q / a), t1 = fmax(k / q, q / a);
    result.t = t0 >= 0.0 ? t0 : t1;
    if (t1 < 0.0)
        result.clearance = -1.0;
    for (int i = 0; i < 3; i++)
        result.normal[i] = (o[i] + result.t * d[i] - c[i]) / r;
    result.u_is_known = result.clearance > 1e-2 && fabs(result.normal[1]) < 0.99;
    result.u = atan2(-result.normal[2], result.normal[0]) / (2.0 * acos(-1.0));
    result.u -= floor(result.u);
    result.v = 0.5 + asin(fmax(-1.0, fmin(1.0, result.normal[1]))) / acos(-1.0);
    return result;
}

static solution solve_plane(const shape *shape, const rt_ray *ray)
{
    solution result = {0};
    double p[3], n[3], o[3], d[3], s[3];
    load(p, shape->p);
    load(n, shape->p + 3);
    load(o, ray->origin);
    load(d, ray->direction);
    minus(s, p, o);
    const double length = sqrt(dot(n, n));
    result.t = dot(s, n) / dot(d, n);
    for (int i = 0; i < 3; i++)
        result.normal[i] = n[i] / length;
    result.clearance = 1.0;
    return result;
}

/*
 * How precisely t can be known: rounding of coordinates and of the plane's normal, seen at the
 * ray's angle.
 */
static double t_tolerance(const solution *exact, const shape *shape, const rt_ray *ray)
{
    double o[3], d[3];
    load(o, ray->origin);
    load(d, ray->direction);
    const double along = fabs(dot(d, exact->normal));
    const double lateral = shape->solve == solve_plane ? 2e-7 * exact->t * sqrt(dot(d, d)) : 0.0;
    return 1e-5 * exact->t + (1e-6 * (sqrt(dot(o, o)) + shape->size) + lateral) / along;
}

static void expect_hit(const solution *exact, const rt_hit *hit, const shape *shape,
                       const rt_ray *ray)
{
    assert_int_equal(hit->shape, 0);
    assert_int_equal(hit->prim, 0);
    assert_true(fabs(hit->t - exact->t) <= t_tolerance(exact, shape, ray));
    const double slack = shape->solve == solve_sphere && exact->clearance < 1e-2 ? 1e-2 : 1e-4;
    for (int a = 0; a < 3; a++)
        assert_true(fabs(hit->normal[a] - exact->normal[a]) <= slack);
    if (exact->u_is_known && exact->clearance > 1e-2) {
        const double off = fabs(hit->u - exact->u);
        assert_true(fmin(off, fabs(1.0 - off)) <= 1e-3);
        assert_true(fabs(hit->v - exact->v) <= 1e-3);
    }
}

/*
 * From outside, inside and near, towards a point near the shape, so that about half of the rays
 * hit.
 */
static rt_ray aim(const shape *shape, const float centre[3], rays_stream *stream)
{
    const float size = (float)shape->size;
    float from[3], to[3], direction[3];
    rays_point(stream, size * (rays_uniform(stream) < 0.3f ? 0.5f : 5.0f), from);
    rays_point(stream, size * 0.8f, to);
    for (int a = 0; a < 3; a++) {
        direction[a] = to[a] - from[a];
        from[a] += centre[a];
    }
    return rays_make(from, direction, 0.0f, INFINITY);
}

/* Rays against the one shape of a scene. The scene is destroyed. */
static void expect_closed_form(rt_scene *scene, const shape *shape, const float centre[3],
                               uint64_t seed)
{
    rays_stream stream = {seed};
    rt_ray *rays = malloc(rays_each * sizeof *rays);
    for (size_t i = 0; i < rays_each; i++)
        rays[i] = aim(shape, centre, &stream);
    rt_renderer *renderer = rays_renderer(scene, RT_ACCEL_BVH);
    rt_hit *hits = rays_trace(renderer, RT_TRACE_CLOSEST, rays, rays_each);
    size_t hit = 0, missed = 0;
    for (size_t i = 0; i < rays_each; i++) {
        const solution exact = shape->solve(shape, &rays[i]);
        double o[3], d[3];
        load(o, rays[i].origin);
        load(d, rays[i].direction);
        if (fabs(dot(d, exact.normal)) < 1e-3 * sqrt(dot(d, d)) && exact.clearance > 0.0)
            continue; /* edge-on */
        if (exact.clearance > band && exact.t > band) {
            expect_hit(&exact, &hits[i], shape, &rays[i]);
            hit++;
        } else if (exact.clearance < -band || exact.t < -band) {
            assert_int_equal(hits[i].shape, RT_NONE);
            assert_true(isinf(hits[i].t));
            missed++;
        }
    }
    assert_true(hit > rays_each / 20);
    assert_true(missed > rays_each / 20);
    free(hits);
    free(rays);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
}

/* Sizes, and distances of the shape from the origin in sizes. */
static const struct {
    float size, offset;
} places[] = {{1.0f, 0.0f}, {1e-3f, 0.0f}, {1e3f, 0.0f}, {1.0f, 20.0f}};
enum { place_count = sizeof places / sizeof *places };

static void random_centre(rays_stream *stream, size_t place, float out[3])
{
    rays_direction(stream, out);
    for (int a = 0; a < 3; a++)
        out[a] *= places[place].size * places[place].offset;
}

static void triangles_match_the_closed_form(void **state)
{
    (void)state;
    static const uint32_t indices[3] = {0, 1, 2};
    rays_stream stream = {1};
    for (size_t i = 0; i < place_count; i++) {
        shape shape = {.size = places[i].size, .solve = solve_triangle};
        const float corner[3][3] = {{-0.9f, -0.7f, 0.1f}, {0.8f, -0.6f, -0.4f}, {0.1f, 0.9f, 0.5f}};
        float centre[3];
        random_centre(&stream, i, centre);
        for (int k = 0; k < 9; k++)
            shape.p[k] = centre[k % 3] + places[i].size * corner[k / 3][k % 3];
        rt_scene *scene = rays_scene();
        rays_add_triangles(scene, shape.p, 3, indices, 1);
        expect_closed_form(scene, &shape, centre, 10 + i);
    }
}

static void quads_match_the_closed_form(void **state)
{
    (void)state;
    rays_stream stream = {2};
    for (size_t i = 0; i < place_count; i++) {
        shape shape = {.size = places[i].size, .solve = solve_quad};
        const float parts[9] = {-0.7f, -0.6f, 0.2f, 1.3f, 0.2f, -0.3f, 0.1f, 1.2f, 0.4f};
        float centre[3];
        random_centre(&stream, i, centre);
        for (int k = 0; k < 9; k++)
            shape.p[k] = (k < 3 ? centre[k] : 0.0f) + places[i].size * parts[k];
        rt_scene *scene = rays_scene();
        rays_add_quad(scene, shape.p, shape.p + 3, shape.p + 6);
        expect_closed_form(scene, &shape, centre, 20 + i);
    }
}

static void spheres_match_the_closed_form(void **state)
{
    (void)state;
    rays_stream stream = {3};
    for (size_t i = 0; i < place_count; i++) {
        shape shape = {.size = places[i].size, .solve = solve_sphere};
        random_centre(&stream, i, shape.p);
        shape.p[3] = 0.6f * places[i].size;
        rt_scene *scene = rays_scene();
        rays_add_sphere(scene, shape.p, shape.p[3]);
        expect_closed_form(scene, &shape, shape.p, 30 + i);
    }
}

static void planes_match_the_closed_form(void **state)
{
    (void)state;
    rays_stream stream = {4};
    for (size_t i = 0; i < place_count; i++) {
        shape shape = {.size = places[i].size, .solve = solve_plane};
        random_centre(&stream, i, shape.p);
        rays_direction(&stream, shape.p + 3);
        rt_scene *scene = rays_scene();
        rays_add_plane(scene, shape.p, shape.p + 3);
        expect_closed_form(scene, &shape, shape.p, 40 + i);
    }
}

/* A closed convex body of triangles: an octahedron cut finer, its vertices on a sphere. */
static void add_ball(rt_scene *scene, const float centre[3], float radius)
{
    enum { n = 24, rings = 12 };
    static float positions[rings + 1][n][3];
    static uint32_t indices[rings][n][2][3];
    for (uint32_t j = 0; j <= rings; j++)
        for (uint32_t i = 0; i < n; i++) {
            const double turn = 2.0 * acos(-1.0) * i / n,
                         tilt = acos(-1.0) * (j + 0.01) / (rings + 0.02);
            positions[j][i][0] = centre[0] + radius * (float)(sin(tilt) * cos(turn));
            positions[j][i][1] = centre[1] + radius * (float)cos(tilt);
            positions[j][i][2] = centre[2] + radius * (float)(sin(tilt) * sin(turn));
        }
    for (uint32_t j = 0; j < rings; j++)
        for (uint32_t i = 0; i < n; i++) {
            const uint32_t a = j * n + i, b = j * n + (i + 1) % n;
            const uint32_t faces[2][3] = {{a, b, a + n}, {b, b + n, a + n}};
            memcpy(indices[j][i], faces, sizeof faces);
        }
    rays_add_triangles(scene, positions[0][0], (rings + 1) * n, indices[0][0][0], 2 * rings * n);
}

/*
 * Share of rays that, having met a convex body from outside, leave it outwards and yet meet it
 * again.
 */
static double share_that_returns(rt_scene *scene, const float centre[3], float size, uint64_t seed)
{
    enum { count = 50000 };
    rays_stream stream = {seed};
    rt_ray *rays = malloc(count * sizeof *rays);
    float(*away)[4] = calloc(count, sizeof *away);
    for (size_t i = 0; i < count; i++) {
        float from[3], to[3], direction[3];
        rays_direction(&stream, from);
        rays_point(&stream, 0.5f * size, to);
        for (int a = 0; a < 3; a++) {
            /* Back where it came from, which is outwards and, near the rim, at a grazing angle. */
            from[a] *= 40.0f * size;
            direction[a] = to[a] - from[a];
            from[a] += centre[a];
            away[i][a] = -direction[a];
        }
        rays[i] = rays_make(from, direction, 0.0f, INFINITY);
    }
    float *next = rays_leave(scene, rays, away, count);
    size_t met = 0, returned = 0;
    for (size_t i = 0; i < count; i++) {
        met += next[i] >= 0.0f;
        returned += next[i] >= 0.0f && !isinf(next[i]);
    }
    assert_true(met > count / 4);
    free(rays);
    free(away);
    free(next);
    return (double)returned / (double)met;
}

static void rays_leave_convex_bodies(void **state)
{
    (void)state;
    static const float sizes[] = {1e-3f, 1.0f, 1e3f}, offsets[] = {0.0f, 10.0f, 1000.0f};
    for (int s = 0; s < 3; s++)
        for (int o = 0; o < 3; o++) {
            const float size = sizes[s];
            const float centre[3] = {offsets[o] * size, -0.3f * offsets[o] * size,
                                     0.7f * offsets[o] * size};
            rt_scene *ball = rays_scene();
            add_ball(ball, centre, size);
            assert_true(share_that_returns(ball, centre, size, 50 + s) == 0.0);
            rt_scene *sphere = rays_scene();
            rays_add_sphere(sphere, centre, size);
            assert_true(share_that_returns(sphere, centre, size, 60 + s) == 0.0);
        }
}

/* The plane of two axes, which rays along the third meet at coordinates without any rounding. */
static void rays_leave_planes_of_axes(void **state)
{
    enum { count = 64 };
    (void)state;
    for (int axis = 0; axis < 3; axis++) {
        static const float origin[3];
        float normal[3] = {0}, down[3] = {0}, away[count][4] = {{0}};
        rt_ray rays[count];
        rays_stream stream = {70};
        rt_scene *scene = rays_scene();
        normal[axis] = 1;
        down[axis] = -1;
        rays_add_plane(scene, origin, normal);
        for (int i = 0; i < count; i++) {
            float from[3];
            rays_point(&stream, 1, from);
            from[axis] = 0.5f + rays_uniform(&stream);
            rays[i] = rays_make(from, down, 0, INFINITY);
            rays_direction(&stream, away[i]);
            away[i][axis] = fabsf(away[i][axis]);
        }
        float *next = rays_leave(scene, rays, away, count);
        for (int i = 0; i < count; i++)
            assert_true(isinf(next[i]));
        free(next);
    }
}

/*
 * Rays as long as the sphere is large, as shadow rays are: the squares of both are in range, their
 * product is not.
 */
static void spheres_are_met_at_every_scale(void **state)
{
    (void)state;
    static const float scales[] = {1e-14f, 1e-10f, 1e-5f, 1.0f, 1e5f, 1e10f, 1e14f};
    enum { rays_a_scale = 2000 };
    static rt_ray rays[rays_a_scale];
    rays_stream stream = {12};
    for (size_t s = 0; s < sizeof scales / sizeof *scales; s++) {
        const shape sphere = {.p = {0, 0, 0, scales[s]}, .size = scales[s]};
        rt_scene *scene = rays_scene();
        rays_add_sphere(scene, sphere.p, scales[s]);
        rt_renderer *renderer = rays_renderer(scene, RT_ACCEL_BVH);
        for (int i = 0; i < rays_a_scale; i++) {
            float origin[3], direction[3];
            rays_point(&stream, 1.5f * scales[s], origin);
            rays_direction(&stream, direction);
            for (int a = 0; a < 3; a++)
                direction[a] *= scales[s];
            rays[i] = rays_make(origin, direction, 0, INFINITY);
        }
        rt_hit *hits = rays_trace(renderer, RT_TRACE_CLOSEST, rays, rays_a_scale);
        size_t met = 0;
        for (int i = 0; i < rays_a_scale; i++) {
            const solution expected = solve_sphere(&sphere, rays + i);
            if (fabs(expected.clearance) < 1e-3)
                continue;
            assert_int_equal(hits[i].shape != RT_NONE, expected.clearance > 0);
            met += expected.clearance > 0;
            if (expected.clearance > 0)
                assert_float_equal(hits[i].t, expected.t, 1e-4);
        }
        assert_true(met > rays_a_scale / 10);
        free(hits);
        rt_renderer_destroy(renderer);
        rt_scene_destroy(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triangles_match_the_closed_form),
        cmocka_unit_test(quads_match_the_closed_form),
        cmocka_unit_test(spheres_match_the_closed_form),
        cmocka_unit_test(spheres_are_met_at_every_scale),
        cmocka_unit_test(planes_match_the_closed_form),
        cmocka_unit_test(rays_leave_convex_bodies),
        cmocka_unit_test(rays_leave_planes_of_axes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
