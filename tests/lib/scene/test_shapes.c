/* test_shapes.c - what transforms make of shapes: kinds, places, areas, bounds. */
#include "support.h"

#include <math.h>
#include <string.h>

#include "lib/scene/scenes.h"
#include "scene/scene.h"
#include "scene/shape_class.h"
#include "shape_kinds.h"

static const double pi = 3.14159265358979323846;
static const float origin[3], x_axis[3] = {1, 0, 0}, y_axis[3] = {0, 1, 0}, z_axis[3] = {0, 0, 1};

/*
 * A quarter turn about z, then twice the size, then one metre along x; and an uneven scale,
 * mirrored and sheared.
 */
static const rt_transform similar = {{{0, -2, 0, 1}, {2, 0, 0, 0}, {0, 0, 2, 0}}};
static const rt_transform skewed = {{{1.5f, 0.4f, 0, 1}, {0, -0.7f, 0.3f, 2}, {0.2f, 0, 0.9f, -3}}};
static const rt_transform flat = {{{1, 0, 1, 0}, {0, 1, 0, 0}, {1, 0, 1, 0}}};

static rt_surface placed(const rt_transform *transform)
{
    rt_surface surface = {.transform = *transform};
    return surface;
}

static void a_transform_that_flattens_is_refused(void **state)
{
    rt_scene *scene = new_scene();
    rt_surface s = placed(&flat);
    rt_error error;
    static const uint32_t corners[3] = {0, 1, 2};
    static const float triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, radii[3] = {1, 2, 3};
    (void)state;
    expect_refused(rt_scene_add_plane(scene, NULL, origin, y_axis, &s, &error), &error,
                   "transform");
    expect_refused(rt_scene_add_sphere(scene, NULL, origin, 1, &s, &error), &error, "transform");
    expect_refused(rt_scene_add_ellipsoid(scene, NULL, origin, radii, &s, &error), &error,
                   "transform");
    expect_refused(rt_scene_add_quad(scene, NULL, origin, x_axis, y_axis, &s, &error), &error,
                   "transform");
    expect_refused(rt_scene_add_disc(scene, NULL, origin, y_axis, 1, 0, &s, &error), &error,
                   "transform");
    expect_refused(rt_scene_add_cylinder(scene, NULL, origin, y_axis, 1, 1, &s, &error), &error,
                   "transform");
    expect_refused(rt_scene_add_cone(scene, NULL, origin, y_axis, 1, 0, 1, &s, &error), &error,
                   "transform");
    expect_refused(rt_scene_add_torus(scene, NULL, origin, y_axis, 1, 0.2f, &s, &error), &error,
                   "transform");
    expect_refused(rt_scene_add_box(scene, NULL, origin, radii, &s, &error), &error, "transform");
    expect_refused(rt_scene_add_triangles(scene, NULL, triangle, 3, corners, 1, NULL, &s, &error),
                   &error, "transform");
    s.transform.m[0][0] = NAN;
    expect_refused(rt_scene_add_sphere(scene, NULL, origin, 1, &s, &error), &error, "transform");
    assert_true(scene->shape_count == 0 && scene->mesh_count == 0);
    rt_scene_destroy(scene);
}

static void a_sphere_stays_one_under_a_similarity_only(void **state)
{
    rt_scene *scene = new_scene();
    rt_error error;
    rt_surface turned = placed(&similar), bent = placed(&skewed), plain = {0};
    static const float centre[3] = {1, 2, 3}, equal[3] = {2, 2, 2};
    (void)state;
    expect_ok(rt_scene_add_sphere(scene, NULL, centre, 0.5f, &turned, &error), &error);
    expect_ok(rt_scene_add_sphere(scene, NULL, centre, 0.5f, &bent, &error), &error);
    expect_ok(rt_scene_add_ellipsoid(scene, NULL, centre, equal, &plain, &error), &error);

    const rt_scene_shape *s = scene->shapes;
    assert_int_equal(s[0].kind, RT_SHAPE_SPHERE);
    assert_float_equal(s[0].p[0], -3, 1e-6); /* 1 - 2 y */
    assert_float_equal(s[0].p[1], 2, 1e-6);
    assert_float_equal(s[0].p[2], 6, 1e-6);
    assert_float_equal(s[0].p[3], 1, 1e-6);
    assert_true(s[0].has_transform); /* its longitudes are turned */
    assert_int_equal(s[1].kind, RT_SHAPE_ELLIPSOID);
    assert_true(s[2].kind == RT_SHAPE_SPHERE && s[2].p[3] == 2 && !s[2].has_transform);
    rt_scene_destroy(scene);
}

/* Of ten million spheres: what few shapes have stands elsewhere. */
static void a_plain_shape_takes_64_bytes(void **state)
{
    static const float radii[3] = {1, 2, 1};
    rt_scene *scene = new_scene();
    rt_surface plain = {0}, emissive = {.radiance = {1, 1, 1}};
    rt_error error;
    (void)state;
    assert_true(sizeof(rt_scene_shape) <= 64);
    expect_ok(rt_scene_add_sphere(scene, NULL, origin, 1, &plain, &error), &error);
    assert_int_equal(scene->placement_count + scene->emission_count, 0);
    expect_ok(rt_scene_add_sphere(scene, NULL, origin, 1, &emissive, &error), &error);
    expect_ok(rt_scene_add_ellipsoid(scene, NULL, origin, radii, &plain, &error), &error);
    assert_true(scene->placement_count == 1 && scene->emission_count == 1);
    rt_scene_destroy(scene);
}

static void flat_shapes_are_brought_to_world_space(void **state)
{
    rt_scene *scene = new_scene();
    rt_error error;
    rt_surface turned = placed(&similar), bent = placed(&skewed);
    static const float corner[3] = {1, 0, 0}, edge1[3] = {0, 1, 0}, edge2[3] = {0, 0, 1},
                       at[3] = {0, 3, 0};
    (void)state;
    turned.radiance[0] = 1; /* the area of what emits is kept */
    expect_ok(rt_scene_add_quad(scene, NULL, corner, edge1, edge2, &turned, &error), &error);
    expect_ok(rt_scene_add_plane(scene, NULL, at, y_axis, &bent, &error), &error);

    static const float quad[9] = {1, 2, 0, -2, 0, 0, 0, 0, 2};
    const rt_scene_shape *s = scene->shapes;
    for (int i = 0; i < 9; i++)
        assert_float_equal(rt_scene_parameters(scene, s)[i], quad[i], 1e-6);
    assert_float_equal(scene->emissions[s[0].emission].area, 4, 1e-6);

    /*
     * The plane's point is mapped; its normal is perpendicular to the mapped x and z, on the side
     * of the mapped y.
     */
    const float *plane = rt_scene_parameters(scene, s + 1);
    double normal[3] = {plane[4], plane[5], plane[6]};
    assert_float_equal(plane[0], 2.2, 1e-6);
    assert_float_equal(plane[1], -0.1, 1e-6);
    assert_float_equal(normal[0] * 1.5 + normal[2] * 0.2, 0, 1e-6);
    assert_float_equal(normal[1] * 0.3 + normal[2] * 0.9, 0, 1e-6);
    assert_true(normal[0] * 0.4 - normal[1] * 0.7 > 0);
    rt_scene_destroy(scene);
}

/* ---- Areas ------------------------------------------------------------------ */

/* A point of a curved shape in object space; u and v from 0 to 1. */
typedef void surface_point(double out[3], double u, double v, double parameter);

static void ball(double out[3], double u, double v, double parameter)
{
    (void)parameter;
    out[0] = sin(pi * v) * cos(2 * pi * u);
    out[1] = sin(pi * v) * sin(2 * pi * u);
    out[2] = cos(pi * v);
}

static void side(double out[3], double u, double v, double top)
{
    double r = 1 - (1 - top) * v;
    out[0] = r * cos(2 * pi * u);
    out[1] = r * sin(2 * pi * u);
    out[2] = v;
}

static void ring(double out[3], double u, double v, double minor)
{
    double r = 1 + minor * cos(2 * pi * v);
    out[0] = r * cos(2 * pi * u);
    out[1] = r * sin(2 * pi * u);
    out[2] = minor * sin(2 * pi * v);
}

static void annulus(double out[3], double u, double v, double inner)
{
    double r = inner + (1 - inner) * v;
    out[0] = r * cos(2 * pi * u);
    out[1] = r * sin(2 * pi * u);
    out[2] = 0;
}

static void face(double out[3], double u, double v, double axis)
{
    int a = (int)axis;
    out[a] = 1;
    out[(a + 1) % 3] = 2 * u - 1;
    out[(a + 2) % 3] = 2 * v - 1;
}

static void corner_of_cube(double out[3], double u, double v, double parameter)
{
    (void)parameter;
    out[0] = u < 0.5 ? -1 : 1;
    out[1] = v < 0.5 ? -1 : 1;
    out[2] = fmod(4 * u, 2) < 1 ? -1 : 1;
}

/*
 * The area by the parallelograms of central differences; its error is of second order in the step.
 */
static double brute_area(surface_point *point, double parameter, const rt_affine *map, int steps)
{
    double sum = 0, h = 0.5 / steps;
    for (int i = 0; i < steps; i++)
        for (int j = 0; j < steps; j++) {
            double u = (i + 0.5) / steps, v = (j + 0.5) / steps, p[4][3], q[4][3], n[3];
            point(p[0], u - h, v, parameter);
            point(p[1], u + h, v, parameter);
            point(p[2], u, v - h, parameter);
            point(p[3], u, v + h, parameter);
            for (int k = 0; k < 4; k++)
                rt_affine_point(q[k], map, p[k]);
            for (int k = 0; k < 3; k++) {
                int a = (k + 1) % 3, b = (k + 2) % 3;
                n[k] = (q[1][a] - q[0][a]) * (q[3][b] - q[2][b]) -
                       (q[1][b] - q[0][b]) * (q[3][a] - q[2][a]);
            }
            sum += sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        }
    return sum;
}

static void expect_area(double found, double expected, double relative)
{
    if (!(fabs(found - expected) <= relative * expected))
        fail_msg("the area is %.9g, expected %.9g", found, expected);
}

/* Kinds of which areas were compared. */
static int seen[SHAPE_KINDS_MAX];

/* The area of a kind of shape under this map. */
static double class_area(rt_u32 kind, double parameter, int caps, const rt_affine *map)
{
    rt_scene_shape shape = {.kind = kind, .caps = caps, .p = {(float)parameter}};
    seen[kind] = 1;
    return rt_shape_class_of(kind)->area(&shape, map);
}

static void areas_under_affine_maps_match_brute_force(void **state)
{
    enum { steps = 700 };
    static const rt_transform maps[] = {
        {{{0}}},
        {{{1.5f, 0.4f, 0, 1}, {0, -0.7f, 0.3f, 2}, {0.2f, 0, 0.9f, -3}}},
        {{{20, 0, 0, 0}, {0, 1, 0, 0}, {0, 3, 0.5f, 0}}},
    };
    (void)state;
    for (size_t i = 0; i < sizeof maps / sizeof *maps; i++) {
        rt_affine map = rt_affine_from(maps + i);
        double end = brute_area(annulus, 0, &map, steps);
        expect_area(class_area(RT_SHAPE_ELLIPSOID, 0, 0, &map), brute_area(ball, 0, &map, steps),
                    1e-5);
        expect_area(class_area(RT_SHAPE_DISC, 0.4f, 0, &map),
                    brute_area(annulus, 0.4f, &map, steps), 1e-5);
        expect_area(class_area(RT_SHAPE_CYLINDER, 0, 0, &map), brute_area(side, 1, &map, steps),
                    1e-5);
        expect_area(class_area(RT_SHAPE_CYLINDER, 0, 1, &map),
                    brute_area(side, 1, &map, steps) + 2 * end, 1e-5);
        expect_area(class_area(RT_SHAPE_CONE, 0.25, 1, &map),
                    brute_area(side, 0.25, &map, steps) + 1.0625 * end, 1e-5);
        expect_area(class_area(RT_SHAPE_TORUS, 0.4f, 0, &map), brute_area(ring, 0.4f, &map, steps),
                    1e-5);
        double cube = 0;
        for (int axis = 0; axis < 3; axis++)
            cube += 2 * brute_area(face, axis, &map, steps);
        expect_area(class_area(RT_SHAPE_BOX, 0, 0, &map), cube, 1e-5);
    }
    RT_PLACED_SHAPES(EXPECT_SEEN)
}

static void areas_of_plain_shapes_are_the_known_ones(void **state)
{
    rt_scene *scene = new_scene();
    rt_surface turned = placed(&similar);
    rt_error error;
    static const float top[3] = {0, 3, 4}, prolate[3] = {1, 1, 2};
    (void)state;
    turned.radiance[0] = 1;
    expect_ok(rt_scene_add_sphere(scene, NULL, origin, 3, &turned, &error), &error);
    expect_ok(rt_scene_add_disc(scene, NULL, origin, x_axis, 3, 1, &turned, &error), &error);
    expect_ok(rt_scene_add_cylinder(scene, NULL, origin, top, 2, 1, &turned, &error), &error);
    expect_ok(rt_scene_add_cone(scene, NULL, origin, top, 12, 0, 0, &turned, &error), &error);
    expect_ok(rt_scene_add_torus(scene, NULL, origin, z_axis, 3, 1, &turned, &error), &error);
    expect_ok(rt_scene_add_ellipsoid(scene, NULL, origin, prolate, &turned, &error), &error);
    double e = sqrt(0.75); /* of the prolate spheroid: 2 pi a^2 (1 + c / (a e) asin e) */
    const double known[] = {36 * pi,      8 * pi,          2 * pi * 2 * 5 + 8 * pi,
                            pi * 12 * 13, 4 * pi * pi * 3, 2 * pi * (1 + 2 / e * asin(e))};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        expect_area(scene->emissions[i].area, 4 * known[i], 1e-6);
    rt_scene_destroy(scene);
}

static void power_becomes_the_radiance_that_emits_it(void **state)
{
    rt_scene *scene = new_scene();
    rt_surface emissive = placed(&skewed);
    rt_error error;
    float radiance[3];
    (void)state;
    emissive.power[0] = emissive.power[1] = emissive.power[2] = 7;
    expect_ok(rt_scene_add_torus(scene, NULL, origin, z_axis, 1, 0.3f, &emissive, &error), &error);
    rt_scene_shape_radiance(scene, scene->shapes, radiance);
    rt_affine to_world = rt_scene_to_world(scene, scene->shapes);
    expect_area(radiance[1] * pi * brute_area(ring, 0.3, &to_world, 1000), 7, 1e-5);
    rt_scene_destroy(scene);
}

/* The flux of a placed mesh: pi times radiance times the area of its triangles as they stand. */
static void power_of_a_placed_mesh_is_spread_over_its_area(void **state)
{
    static const float corners[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    const rt_transform *const maps[] = {&similar, &skewed};
    rt_error error;
    (void)state;
    for (int m = 0; m < 2; m++) {
        rt_scene *scene = new_scene();
        rt_surface emissive = placed(maps[m]);
        float radiance[3];
        emissive.power[0] = emissive.power[1] = emissive.power[2] = 5;
        expect_ok(
            rt_scene_add_triangles(scene, NULL, corners, 4, indices, 2, NULL, &emissive, &error),
            &error);
        rt_scene_shape_radiance(scene, scene->shapes, radiance);
        double area = rt_scene_primitive_area(scene, scene->shapes, 0) +
                      rt_scene_primitive_area(scene, scene->shapes, 1);
        expect_area(area * pi * radiance[0], 5, 1e-6);
        assert_true(m == 1 || fabs(area - 4) < 1e-6);
        rt_scene_destroy(scene);
    }
}

/* ---- Bounds ----------------------------------------------------------------- */

/* Points of the surface reach the bounds of the shape, to a part in a thousand, and not beyond. */
static void expect_bounds(const rt_scene *scene, size_t index, surface_point *point,
                          double parameter)
{
    enum { steps = 200 };
    const rt_scene_shape *shape = scene->shapes + index;
    const rt_affine to_world = rt_scene_to_world(scene, shape);
    double lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int i = 0; i < steps; i++)
        for (int j = 0; j <= steps; j++) {
            double p[3], q[3];
            point(p, (double)i / steps, (double)j / steps, parameter);
            rt_affine_point(q, &to_world, p);
            for (int k = 0; k < 3; k++) {
                lo[k] = fmin(lo[k], q[k]);
                hi[k] = fmax(hi[k], q[k]);
            }
        }
    for (int k = 0; k < 3; k++) {
        assert_true(shape->lo[k] < lo[k] && shape->hi[k] > hi[k]);
        assert_true(shape->lo[k] > lo[k] - 1e-3 * (hi[k] - lo[k]) - 1e-5);
        assert_true(shape->hi[k] < hi[k] + 1e-3 * (hi[k] - lo[k]) + 1e-5);
    }
}

static void bounds_hold_the_shape_and_little_more(void **state)
{
    rt_scene *scene = new_scene();
    rt_surface s = placed(&skewed);
    rt_error error;
    static const float centre[3] = {1, 2, -1}, end[3] = {2, 0, 1}, radii[3] = {1, 2, 0.5f};
    (void)state;
    expect_ok(rt_scene_add_ellipsoid(scene, NULL, centre, radii, &s, &error), &error);
    expect_ok(rt_scene_add_disc(scene, NULL, centre, end, 2, 0.5f, &s, &error), &error);
    expect_ok(rt_scene_add_cylinder(scene, NULL, centre, end, 0.7f, 0, &s, &error), &error);
    expect_ok(rt_scene_add_cone(scene, NULL, centre, end, 0.7f, 0.2f, 0, &s, &error), &error);
    expect_ok(rt_scene_add_torus(scene, NULL, centre, end, 1, 0.3f, &s, &error), &error);
    expect_ok(rt_scene_add_box(scene, NULL, centre, radii, &s, &error), &error);
    expect_bounds(scene, 0, ball, 0);
    expect_bounds(scene, 1, annulus, 0);
    expect_bounds(scene, 2, side, 1);
    expect_bounds(scene, 3, side, 0.2 / 0.7);
    expect_bounds(scene, 4, ring, 0.3);
    expect_bounds(scene, 5, corner_of_cube, 0);
    rt_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_transform_that_flattens_is_refused),
        cmocka_unit_test(a_sphere_stays_one_under_a_similarity_only),
        cmocka_unit_test(a_plain_shape_takes_64_bytes),
        cmocka_unit_test(flat_shapes_are_brought_to_world_space),
        cmocka_unit_test(areas_under_affine_maps_match_brute_force),
        cmocka_unit_test(areas_of_plain_shapes_are_the_known_ones),
        cmocka_unit_test(power_becomes_the_radiance_that_emits_it),
        cmocka_unit_test(power_of_a_placed_mesh_is_spread_over_its_area),
        cmocka_unit_test(bounds_hold_the_shape_and_little_more),
    };
    return cmocka_run_group_tests_name("lib/scene/shapes", tests, NULL, NULL);
}
