/* test_findings.c - points inside solids, shapes in view, and the findings of rt_scene_check. */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/scene/scenes.h"
#include "scene/inside.h"

/* ---- Points in solids -------------------------------------------------------- */

enum { points = 20000 };

static const float at_a[3] = {0.3f, -0.2f, 0.4f}, at_b[3] = {-0.5f, 0.9f, -0.3f};

static double uniform(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (*state >> 8) / 8388608.0 - 1;
}

/* Where p lies along the axis from at_a to at_b, 0 to 1, and how far from it. */
static void about_axis(const double p[3], double *along, double *away)
{
    double length = 0, dot = 0, square = 0;
    for (int i = 0; i < 3; i++) {
        double n = (double)at_b[i] - at_a[i], d = p[i] - at_a[i];
        length += n * n;
        dot += n * d;
        square += d * d;
    }
    *along = dot / length;
    *away = sqrt(fmax(square - dot * dot / length, 0));
}

static double in_ball(const double p[3])
{
    return 0.8 - sqrt(pow(p[0] - at_a[0], 2) + pow(p[1] - at_a[1], 2) + pow(p[2] - at_a[2], 2));
}

static double in_ellipsoid(const double p[3])
{
    return 1 - sqrt(pow((p[0] - at_a[0]) / 0.8, 2) + pow((p[1] - at_a[1]) / 0.4, 2) +
                    pow((p[2] - at_a[2]) / 0.6, 2));
}

static double in_cylinder(const double p[3])
{
    double along, away;
    about_axis(p, &along, &away);
    return fmin(fmin(along, 1 - along), 0.5 - away);
}

static double in_cone(const double p[3])
{
    double along, away;
    about_axis(p, &along, &away);
    return fmin(fmin(along, 1 - along), 0.7 + along * (0.2 - 0.7) - away);
}

static double in_torus(const double p[3])
{
    double along, away, length = 0;
    about_axis(p, &along, &away);
    for (int i = 0; i < 3; i++)
        length += pow((double)at_b[i] - at_a[i], 2);
    return 0.3 - hypot(away - 0.6, along * sqrt(length));
}

static double in_box(const double p[3])
{
    return 0.5 - fmax(fabs(p[0]), fmax(fabs(p[1]), fabs(p[2])));
}

static const float box_corners[8][3] = {
    {-0.5f, -0.5f, -0.5f}, {0.5f, -0.5f, -0.5f}, {-0.5f, 0.5f, -0.5f}, {0.5f, 0.5f, -0.5f},
    {-0.5f, -0.5f, 0.5f},  {0.5f, -0.5f, 0.5f},  {-0.5f, 0.5f, 0.5f},  {0.5f, 0.5f, 0.5f}};
static const uint32_t box_faces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                          {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                          {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};

static void add_box(rt_scene *scene, size_t faces, const rt_surface *surface)
{
    rt_error error;
    expect_ok(rt_scene_add_triangles(scene, NULL, box_corners[0], 8, box_faces[0], faces, NULL,
                                     surface, &error),
              &error);
}

/* The closed shapes, each with what is positive inside of it. */
static double (*const insides[])(const double p[3]) = {in_ball,  in_ellipsoid, in_cylinder, in_cone,
                                                       in_torus, in_box,       in_box};

static rt_scene *scene_of_solids(const rt_surface *surface)
{
    const float radii[3] = {0.8f, 0.4f, 0.6f}, middle[3] = {0, 0, 0}, edges[3] = {1, 1, 1};
    rt_scene *scene = new_scene();
    rt_error error;
    float axis[3];
    for (int i = 0; i < 3; i++)
        axis[i] = at_b[i] - at_a[i];
    expect_ok(rt_scene_add_sphere(scene, NULL, at_a, 0.8f, surface, &error), &error);
    expect_ok(rt_scene_add_ellipsoid(scene, NULL, at_a, radii, surface, &error), &error);
    expect_ok(rt_scene_add_cylinder(scene, NULL, at_a, at_b, 0.5f, 1, surface, &error), &error);
    expect_ok(rt_scene_add_cone(scene, NULL, at_a, at_b, 0.7f, 0.2f, 1, surface, &error), &error);
    expect_ok(rt_scene_add_torus(scene, NULL, at_a, axis, 0.6f, 0.3f, surface, &error), &error);
    add_box(scene, 12, surface);
    expect_ok(rt_scene_add_box(scene, NULL, middle, edges, surface, &error), &error);
    return scene;
}

/*
 * Points of the cube from -1.5 to 1.5 about the solids, placed with them; those closer than
 * rounding are left out.
 */
static void expect_sides(const rt_surface *surface)
{
    rt_scene *scene = scene_of_solids(surface);
    const rt_affine placed = rt_affine_from(&surface->transform);
    for (size_t s = 0; s < scene->shape_count; s++) {
        uint32_t state = 7;
        int inside = 0;
        for (int i = 0; i < points; i++) {
            double p[3] = {1.5 * uniform(&state), 1.5 * uniform(&state), 1.5 * uniform(&state)},
                   q[3];
            double depth = insides[s](p);
            rt_affine_point(q, &placed, p);
            inside += depth > 0;
            if (fabs(depth) > 1e-5)
                assert_int_equal(rt_shape_contains(scene, scene->shapes + s, q), depth > 0);
        }
        assert_in_range(inside, points / 100, points / 2);
    }
    rt_scene_destroy(scene);
}

static void points_in_solids_are_those_of_their_equations(void **state)
{
    rt_surface plain = {0},
               placed = {
                   .transform = {{{0, 2, 0, 5}, {-0.5f, 0.1f, 0, -3}, {0.3f, 0, -1.5f, 100}}}};
    (void)state;
    expect_sides(&plain);
    expect_sides(&placed);
}

static void only_closed_shapes_have_an_inside(void **state)
{
    static const float point[3], normal[3] = {0, 0, 1}, top[3] = {0, 0, 1};
    static const double middle[3] = {0, 0, 0.25}, outside[3] = {0, 0, 0.75};
    rt_surface surface = {0},
               mirrored = {.transform = {{{-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}}};
    rt_scene *scene = new_scene();
    rt_error error;
    (void)state;
    add_box(scene, 11, &surface); /* a face is missing */
    expect_ok(rt_scene_add_cylinder(scene, NULL, point, top, 1, 0, &surface, &error), &error);
    expect_ok(rt_scene_add_cone(scene, NULL, point, top, 1, 0.5f, 0, &surface, &error), &error);
    expect_ok(rt_scene_add_plane(scene, NULL, top, normal, &surface, &error), &error);
    for (size_t i = 0; i < scene->shape_count; i++)
        assert_int_equal(rt_shape_contains(scene, scene->shapes + i, middle), 0);

    /* A box turned inside out, by the order of its corners; a map that mirrors does not do that. */
    uint32_t inverted[12][3];
    for (int i = 0; i < 12; i++) {
        inverted[i][0] = box_faces[i][0];
        inverted[i][1] = box_faces[i][2];
        inverted[i][2] = box_faces[i][1];
    }
    uint32_t box;
    expect_ok(rt_scene_add_triangles(scene, &box, box_corners[0], 8, inverted[0], 12, NULL,
                                     &mirrored, &error),
              &error);
    assert_int_equal(rt_shape_contains(scene, scene->shapes + box, middle), -1);
    assert_int_equal(rt_shape_contains(scene, scene->shapes + box, outside), 0);
    rt_scene_destroy(scene);
}

/* ---- Scenes --------------------------------------------------------------------- */

typedef struct told {
    int count;
    rt_finding last;
    char message[256];
} told;

static void keep(void *user, const rt_finding *finding)
{
    told *t = user;
    t->count++;
    t->last = *finding;
    snprintf(t->message, sizeof t->message, "%s", finding->message);
}

/* What is told of a scene; nothing, or one finding. */
static told findings_of(const char *text)
{
    told t = {0, {RT_FINDING_NONE, RT_SEVERITY_ERROR, 0, 0, 0, 0, NULL, NULL, 0, 0}, ""};
    rt_scene *scene = NULL;
    rt_error error;
    expect_ok(rt_scene_parse(&scene, text, NULL, NULL, &error), &error);
    size_t warnings = rt_scene_check(scene, keep, &t);
    assert_true(warnings == (t.count == 1 && t.last.severity == RT_SEVERITY_WARNING));
    assert_in_range(t.count, 0, 1);
    assert_true(t.count == 0 || (t.message[0] && !strchr(t.message, '\n')));
    rt_scene_destroy(scene);
    return t;
}

#define MATERIALS                                                                                  \
    "material white { kd 0.5 }\nmaterial glass { kt 1 fresnel dielectric }\nmaterial emitter { "   \
    "emission 1 }\n"                                                                               \
    "material glow { emission 1 two_sided true }\n"
#define VIEW "camera { eye 0 0 -5 look_at 0 0 0 }\n"
#define BALL "sphere { centre 0 0 0 radius 1 material white }\n"
#define SUN "light directional { direction 0 -1 0 irradiance 1 }\n"

typedef struct scene_case {
    const char *text;
    rt_finding_kind kind;
} scene_case;

static void expect_findings(const scene_case *cases, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        told t = findings_of(cases[i].text);
        if (t.last.kind != cases[i].kind)
            fail_msg("found %d (%s), expected %d in:\n%s", (int)t.last.kind, t.message,
                     (int)cases[i].kind, cases[i].text);
    }
}

#define EXPECT(cases) expect_findings(cases, sizeof cases / sizeof *cases)

static void what_is_missing_is_reported(void **state)
{
    static const scene_case cases[] = {
        {MATERIALS VIEW BALL SUN, RT_FINDING_NONE},
        {MATERIALS BALL SUN, RT_FINDING_NO_CAMERA},
        {MATERIALS VIEW SUN, RT_FINDING_NO_SHAPE},
        {MATERIALS VIEW "light environment { radiance 1 }", RT_FINDING_NONE},
        {VIEW "light point { position 0 3 0 power 9 }  medium { scattering 0.1 }", RT_FINDING_NONE},
        {MATERIALS VIEW BALL, RT_FINDING_NO_LIGHT},
        {MATERIALS VIEW BALL "light point { position 0 3 0 intensity 0 }", RT_FINDING_NO_LIGHT},
        {MATERIALS VIEW "sphere { centre 0 0 0 radius 1 material emitter }", RT_FINDING_NONE},
        {MATERIALS VIEW BALL "render { mode normals }", RT_FINDING_NONE},
        {MATERIALS VIEW BALL "render { mode photon }", RT_FINDING_NO_LIGHT},
    };
    (void)state;
    EXPECT(cases);
}

/* A picture of 512 pixels across, of 4 m or of 45 degrees over 10 m: pixels of 8 or 15 mm. */
static void a_camera_too_far_from_the_origin_is_reported(void **state)
{
#define FAR_BALL(x) MATERIALS SUN "sphere { centre " x " 0 0 radius 1 material white }"
#define FAR_CAMERA(x) "camera { eye " x " 0 -10 look_at " x " 0 0 "
#define ORTHOGRAPHIC " projection orthographic width 4 }"
    static const scene_case cases[] = {
        {FAR_BALL("1e4") FAR_CAMERA("1e4") ORTHOGRAPHIC, RT_FINDING_NONE},
        {FAR_BALL("1e5") FAR_CAMERA("1e5") ORTHOGRAPHIC, RT_FINDING_CAMERA_ROUNDED},
        {FAR_BALL("1e4") FAR_CAMERA("1e4") " fov 45 }", RT_FINDING_NONE},
        {FAR_BALL("1e5") FAR_CAMERA("1e5") " fov 45 }", RT_FINDING_CAMERA_ROUNDED},
        {FAR_BALL("1e5") FAR_CAMERA("1e5") " projection environment }", RT_FINDING_NONE},
    };
    (void)state;
    EXPECT(cases);
}

/*
 * Each view looks along +z and sees 45 degrees, from -22.5 to 22.5 in x, and in a square picture in
 * y.
 */
static void a_camera_that_sees_no_shape_is_reported(void **state)
{
    static const scene_case cases[] = {
        {MATERIALS SUN BALL "camera { eye 0 0 -5 look_at 0 0 -9 }", RT_FINDING_NOTHING_IN_VIEW},
        {MATERIALS SUN BALL "camera { eye 0 0 -5 look_at 0 0 0 }", RT_FINDING_NONE},
        {MATERIALS SUN BALL "camera { eye 3.5 0 -5 look_at 3.5 0 0 }", RT_FINDING_NOTHING_IN_VIEW},
        {MATERIALS SUN BALL "camera { eye -3.5 0 -5 look_at -3.5 0 0 }",
         RT_FINDING_NOTHING_IN_VIEW},
        {MATERIALS SUN BALL "camera { eye 3.4 0 -5 look_at 3.4 0 0 }", RT_FINDING_NONE},
        {MATERIALS SUN BALL "camera { eye 0 3.5 -5 look_at 0 3.5 0 }", RT_FINDING_NOTHING_IN_VIEW},
        {MATERIALS SUN BALL "camera { eye 0 -3.5 -5 look_at 0 -3.5 0 }",
         RT_FINDING_NOTHING_IN_VIEW},
        {MATERIALS SUN BALL "camera { eye 0 3.5 -5 look_at 0 3.5 0 } film { width 256 }",
         RT_FINDING_NONE},
        {MATERIALS SUN BALL "camera { eye 3.5 0 -5 look_at 3.5 0 0 aperture 0.1 }",
         RT_FINDING_NONE},
        {MATERIALS SUN BALL "camera { projection orthographic eye 1.9 0 -5 look_at 1.9 0 0 }",
         RT_FINDING_NONE},
        {MATERIALS SUN BALL "camera { projection orthographic eye 2.1 0 -5 look_at 2.1 0 0 }",
         RT_FINDING_NOTHING_IN_VIEW},
        {MATERIALS SUN BALL "camera { projection environment eye 0 0 -5 look_at 0 0 -9 }",
         RT_FINDING_NONE},
        {MATERIALS SUN
         "plane { point 0 -1 0 normal 0 1 0 material white } camera { eye 0 0 0 look_at 0 0 9 }",
         RT_FINDING_NONE},
        {MATERIALS SUN
         "plane { point 0 -1 0 normal 0 1 0 material white } camera { eye 0 0 0 look_at 0 5 9 }",
         RT_FINDING_NOTHING_IN_VIEW},
        {MATERIALS SUN "plane { point 0 0 1 normal 0 0 1 material white }"
                       "camera { projection orthographic eye 0 0 2 look_at 0 0 9 }",
         RT_FINDING_NOTHING_IN_VIEW},
    };
    (void)state;
    EXPECT(cases);
}

static void glass_without_an_inside_is_reported(void **state)
{
#define GLASS MATERIALS VIEW SUN "material clear { kt 1 ior 1.5 }\n"
#define FACE(z) "quad { corner 0 0 " z " edge1 1 0 0 edge2 0 1 0 material clear }\n"
    static const scene_case cases[] = {
        {GLASS FACE("0"), RT_FINDING_OPEN_GLASS},
        {GLASS "disc { centre 0 0 0 normal 0 0 1 radius 1 material clear }", RT_FINDING_OPEN_GLASS},
        {GLASS "triangle { a 0 0 0 b 1 0 0 c 0 1 0 material clear }", RT_FINDING_OPEN_GLASS},
        {GLASS "cylinder { a 0 0 0 b 0 1 0 radius 1 caps false material clear }",
         RT_FINDING_OPEN_GLASS},
        {GLASS "cone { base 0 0 0 apex 0 1 0 radius 1 caps false material clear }",
         RT_FINDING_OPEN_GLASS},
        /*
         * Closed, by itself or by what may be its other faces; a plane is the boundary of a
         * half-space.
         */
        {GLASS "cone { base 0 0 0 apex 0 1 0 radius 1 material clear }", RT_FINDING_NONE},
        {GLASS "cone { base 0 0 0 apex 0 1 0 radius 1 caps false material clear }"
               "disc { centre 0 0 0 normal 0 -1 0 radius 1 material clear }",
         RT_FINDING_NONE},
        {GLASS FACE("0") FACE("1") FACE("2") FACE("3"), RT_FINDING_NONE},
        {GLASS "plane { point 0 -9 0 normal 0 1 0 material clear } sphere { centre 0 0 0 radius 1 "
               "material clear }",
         RT_FINDING_NONE},
        {MATERIALS VIEW SUN "material clear { interface true  scattering 1 }" FACE("0"),
         RT_FINDING_OPEN_INTERFACE},
        /* A sheet without refraction. */
        {MATERIALS VIEW SUN "material clear { kt 0.5 ior 1 }" FACE("0"), RT_FINDING_NONE},
    };
    (void)state;
    EXPECT(cases);
}

/* What is said of a mesh of glass. */
static void keep_message(void *user, const rt_finding *finding)
{
    if (finding->kind == RT_FINDING_INSIDE_OUT || finding->kind == RT_FINDING_OPEN_GLASS)
        snprintf(user, 200, "%s", finding->message);
}

/* A box of glass as a mesh, some of its faces turned inwards, and with one triangle too few. */
static void glass_that_is_no_solid_is_reported(void **state)
{
    static const struct {
        int faces, turned;
        const char *says, *more;
    } boxes[] = {{12, 0, NULL, ""},
                 {12, 12, "is inside out", ""},
                 {12, 1, "turned against each other at 3 edges", ""},
                 {12, 6, "turned against each other", ""},
                 {11, 0, "is open at 3 edges", ""},
                 {11, 11, "is open at 3 edges", ""},
                 {12, 12, NULL, "relative_ior true"},
                 {12, 6, "turned against each other", "relative_ior true"},
                 {11, 11, NULL, "relative_ior true"},
                 {11, 11, "is open at 3 edges", "relative_ior true  absorption 1"}};
    (void)state;
    for (size_t b = 0; b < sizeof boxes / sizeof *boxes; b++) {
        const rt_surface clear = {.material = 0};
        uint32_t indices[12][3];
        rt_scene *scene = NULL;
        rt_error error;
        char said[200] = "", text[200];
        snprintf(text, sizeof text,
                 "material clear { kt 1  ior 1.5  %s }\n"
                 "light point { position 0 3 0  power 1 }",
                 boxes[b].more);
        for (int i = 0; i < 12; i++)
            for (int k = 0; k < 3; k++)
                indices[i][k] = box_faces[i][i < boxes[b].turned ? 2 - k : k];
        expect_ok(rt_scene_parse(&scene, text, "scene", NULL, &error), &error);
        expect_ok(rt_scene_add_triangles(scene, NULL, box_corners[0], 8, indices[0],
                                         (size_t)boxes[b].faces, NULL, &clear, &error),
                  &error);
        rt_scene_check(scene, keep_message, said);
        if (boxes[b].says ? !strstr(said, boxes[b].says) : said[0])
            fail_msg("'%s' of box %zu", said, b);
        rt_scene_destroy(scene);
    }
}

static void keep_leaning(void *user, const rt_finding *finding)
{
    if (finding->kind == RT_FINDING_LEANING_NORMALS)
        snprintf(user, 200, "%u %s", (unsigned)finding->shape, finding->message);
}

/* A box whose normals are those of a ball, 55 degrees from its faces. */
static void sharp_edges_of_smooth_glass_are_reported(void **state)
{
    static const struct {
        const char *material;
        int is_smooth;
        const char *says;
    } boxes[] = {
        {"kt 1  ior 1.5", 1, "1 normals lean by more than 30 degrees from 100 % of"},
        {"kt 1  ior 1.5  roughness 0.3", 1, "from 100 % of"},
        {"kt 1  ior 1.5", 0, ""},
        {"kt 1  ior 1  absorption 1", 1, ""},
        {"kt 1  ior 1.5  thin true", 1, ""},
        {"kd 0.5", 1, ""},
        {"ks 0.5", 1, ""},
    };
    (void)state;
    for (size_t b = 0; b < sizeof boxes / sizeof *boxes; b++) {
        const rt_surface surface = {.material = 0};
        const float centre[3] = {5, 5, 5};
        rt_scene *scene = NULL;
        rt_error error;
        char said[200] = "", text[200];
        snprintf(text, sizeof text, "material m { %s }\nlight point { position 0 3 0  power 1 }",
                 boxes[b].material);
        expect_ok(rt_scene_parse(&scene, text, "scene", NULL, &error), &error);
        expect_ok(rt_scene_add_sphere(scene, NULL, centre, 0.1f, &surface, &error), &error);
        expect_ok(rt_scene_add_triangles(scene, NULL, box_corners[0], 8, box_faces[0], 12,
                                         boxes[b].is_smooth ? box_corners[0] : NULL, &surface,
                                         &error),
                  &error);
        rt_scene_check(scene, keep_leaning, said);
        if (boxes[b].says[0] ? !strstr(said, boxes[b].says) : said[0])
            fail_msg("'%s' of box %zu", said, b);
        rt_scene_destroy(scene);
    }
}

static void a_camera_in_a_dark_solid_is_reported(void **state)
{
    static const scene_case cases[] = {
        {MATERIALS SUN "sphere { centre 0 0 -5 radius 1 material white }" VIEW,
         RT_FINDING_CAMERA_IN_OPAQUE},
        {MATERIALS SUN "sphere { centre 0 0 -5 radius 1 material glass }" VIEW,
         RT_FINDING_CAMERA_IN_MEDIUM},
        /* Behind a plane of glass, which fills a half-space; before it; behind a mere filter. */
        {MATERIALS SUN BALL "plane { point 0 3 0 normal 0 1 0 material glass }" VIEW,
         RT_FINDING_CAMERA_IN_MEDIUM},
        {MATERIALS SUN BALL "plane { point 0 -3 0 normal 0 1 0 material glass }" VIEW,
         RT_FINDING_NONE},
        {MATERIALS SUN BALL "material filter { kt 0.5 ior 1 }"
                            "plane { point 0 3 0 normal 0 1 0 material filter }" VIEW,
         RT_FINDING_NONE},
        /*
         * A room is no such solid where a light or a wall emits inside it; a sphere that emits
         * outwards is one.
         */
        {MATERIALS "sphere { centre 0 0 0 radius 9 material white } light point { position 1 0 0 "
                   "intensity 1 }" VIEW,
         RT_FINDING_NONE},
        {MATERIALS "sphere { centre 0 0 0 radius 9 material white }"
                   "quad { corner 0 0 0 edge1 1 0 0 edge2 0 1 0 material emitter }" VIEW,
         RT_FINDING_NONE},
        {MATERIALS "sphere { centre 0 0 0 radius 9 material glow }" VIEW, RT_FINDING_NONE},
        {MATERIALS "sphere { centre 0 0 0 radius 9 material emitter }" VIEW,
         RT_FINDING_CAMERA_IN_OPAQUE},
        {MATERIALS "sphere { centre 0 0 0 radius 9 material white } light point { position 0 10 0 "
                   "intensity 1 }" VIEW,
         RT_FINDING_CAMERA_IN_OPAQUE},
        {MATERIALS SUN "cylinder { a -1 0 -5 b 1 0 -5 radius 1 caps false material white }" VIEW,
         RT_FINDING_NONE},
    };
    (void)state;
    EXPECT(cases);
    told t = findings_of(cases[1].text);
    assert_int_equal(t.last.severity, RT_SEVERITY_NOTE);
    assert_true(t.last.shape == 0 && t.last.emitter == RT_NONE && t.last.light == RT_NONE);
}

static void a_light_in_a_solid_is_reported(void **state)
{
    static const scene_case cases[] = {
        {MATERIALS VIEW SUN BALL "light point { position 0 0 0.9 intensity 1 }",
         RT_FINDING_LIGHT_IN_OPAQUE},
        {MATERIALS VIEW SUN BALL "light point { position 0 0 1.1 intensity 1 }", RT_FINDING_NONE},
        {MATERIALS VIEW BALL "quad { corner 0 0 0 edge1 0.5 0 0 edge2 0 0.5 0 material emitter }",
         RT_FINDING_LIGHT_IN_OPAQUE},
        {MATERIALS VIEW BALL "quad { corner 0 0 0 edge1 2 0 0 edge2 0 0.5 0 material emitter }",
         RT_FINDING_NONE},
        {MATERIALS VIEW "sphere { centre 0 0 0 radius 1 material glass } light point { position 0 "
                        "0 0 intensity 1 }",
         RT_FINDING_NONE},
        {MATERIALS VIEW "material gauze { kd 0.5  opacity 0.5 }\nsphere { centre 0 0 0 radius 1 "
                        "material gauze } light point { position 0 0 0 intensity 1 }",
         RT_FINDING_NONE},
    };
    (void)state;
    EXPECT(cases);
    told t = findings_of(cases[0].text);
    assert_true(t.last.shape == 0 && t.last.emitter == RT_NONE && t.last.light == 1);
    t = findings_of(cases[2].text);
    assert_true(t.last.shape == 0 && t.last.emitter == 1 && t.last.light == RT_NONE);
}

static void a_light_that_fills_a_solid_is_reported(void **state)
{
    static const scene_case cases[] = {
        {MATERIALS VIEW BALL "sphere { centre 0.01 0 0 radius 0.98 material emitter }",
         RT_FINDING_LIGHT_IN_OPAQUE},
        {MATERIALS VIEW BALL "sphere { centre 0.1 0 0 radius 0.95 material emitter }",
         RT_FINDING_NONE},
        {MATERIALS VIEW BALL "disc { centre 0 0 0 normal 1 2 3 radius 0.98 material emitter }",
         RT_FINDING_LIGHT_IN_OPAQUE},
        {MATERIALS VIEW SUN BALL "disc { centre 0 0 0 normal 1 2 -3 radius 1.2 material glow }",
         RT_FINDING_NONE},
        {MATERIALS VIEW BALL "ellipsoid { centre 0 0 0 radii 0.98 0.9 0.97 material emitter }",
         RT_FINDING_LIGHT_IN_OPAQUE},
        {MATERIALS VIEW "box { centre 0 0 0 size 2 2 2 rotate 0 0 1 45 material white }"
                        "sphere { centre 0 0 0 radius 0.98 material emitter }",
         RT_FINDING_LIGHT_IN_OPAQUE},
        {MATERIALS VIEW "box { centre 0 0 0 size 2 2 2 rotate 0 0 1 45 material white }"
                        "sphere { centre 0.1 0 0 radius 0.98 material emitter }",
         RT_FINDING_NONE},
    };
    (void)state;
    EXPECT(cases);
}

#define SOLIDS                                                                                     \
    "material glass { kt 1 ior 1.5 fresnel dielectric }"                                           \
    "material water { kt 1 ior 1.33 fresnel dielectric }"                                          \
    "material frosted { kt 1 ior 1.5 fresnel dielectric roughness 0.3 }"                           \
    "material filling { kt 1 ior 1.33 fresnel dielectric priority 1 }" SUN VIEW
#define CUBE(x, m) "box { centre " x " 0 0 size 2 2 2 material " m " }"

static void solids_whose_priorities_settle_nothing_are_reported(void **state)
{
    static const scene_case cases[] = {
        {SOLIDS CUBE("0", "glass") CUBE("1.5", "water"), RT_FINDING_OVERLAP},
        {SOLIDS CUBE("0", "water") CUBE("1.5", "glass"), RT_FINDING_OVERLAP},
        {SOLIDS CUBE("0", "glass") CUBE("1.5", "glass"), RT_FINDING_NONE},
        {SOLIDS CUBE("0", "glass") CUBE("1.5", "filling"), RT_FINDING_NONE},
        {SOLIDS "sphere { centre 0 0 0 radius 1 material glass }"
                "sphere { centre 1.2 0 0 radius 1 material water }",
         RT_FINDING_OVERLAP},
        /* One inside the other is settled: the one entered last. */
        {SOLIDS CUBE("0", "glass") "sphere { centre 0 0 0 radius 0.5 material water }",
         RT_FINDING_NONE},
        {SOLIDS CUBE("0", "glass") "sphere { centre 0.8 0 0 radius 0.5 material water }",
         RT_FINDING_OVERLAP},
        {SOLIDS CUBE("0", "glass") CUBE("2", "frosted"), RT_FINDING_CONTACT},
        {SOLIDS CUBE("0", "frosted") CUBE("2", "glass"), RT_FINDING_CONTACT},
        {SOLIDS CUBE("0", "frosted") CUBE("2", "filling"), RT_FINDING_NONE},
        /* The same surface, whichever of the two gives it. */
        {SOLIDS CUBE("0", "glass") CUBE("2", "water"), RT_FINDING_NONE},
        /* A gap is none. */
        {SOLIDS CUBE("0", "glass") CUBE("2.0001", "frosted"), RT_FINDING_NONE},
        {SOLIDS "cylinder { a 0 0 0 b 0 1 0 radius 0.5 material glass }"
                "cylinder { a 0 1 0 b 0 2 0 radius 0.3 material frosted }",
         RT_FINDING_CONTACT},
        /* In any direction, and where the faces are curved. */
        {SOLIDS "box { centre -0.25 0.5 0 size 0.5 1 1 material glass rotate 1 2 3 30 }"
                "box { centre 0.25 0.5 0 size 0.5 1 1 material frosted rotate 1 2 3 30 }",
         RT_FINDING_CONTACT},
        {SOLIDS "box { centre -0.2501 0.5 0 size 0.5 1 1 material glass rotate 1 2 3 30 }"
                "box { centre 0.25 0.5 0 size 0.5 1 1 material frosted rotate 1 2 3 30 }",
         RT_FINDING_NONE},
        {SOLIDS "cylinder { a 0 0 0 b 0 1 0 radius 0.5 material glass rotate 0 0 1 30 }"
                "cylinder { a 0 0.2 0 b 0 0.8 0 radius 0.5 material frosted rotate 0 0 1 30 }",
         RT_FINDING_CONTACT},
        /* A single point is no face. */
        {SOLIDS "sphere { centre 0 0.5 0 radius 0.4 material glass }"
                "box { centre 0 0.5 0.9 size 1 1 1 material frosted }",
         RT_FINDING_NONE},
    };
    (void)state;
    EXPECT(cases);
    told t = findings_of(cases[0].text);
    assert_true(t.last.shape == 1 && t.last.other == 0 && t.last.emitter == RT_NONE);
}

#define BALL_OF(radius, m) "sphere { centre 0 0.5 0 radius " radius " material " m " }"
#define NEST                                                                                       \
    "material air { kt 1 priority 1 }"                                                             \
    "material ice { kt 1 ior 1.31 fresnel dielectric priority 2 }"                                 \
    "material bubble { kt 1 ior 1 priority 3 }" SOLIDS

static void too_many_solids_around_a_point_are_reported(void **state)
{
    static const scene_case cases[] = {
        {NEST BALL_OF("0.5", "glass") BALL_OF("0.4", "air") BALL_OF("0.3", "filling")
             BALL_OF("0.2", "ice"),
         RT_FINDING_NONE},
        {NEST BALL_OF("0.5", "glass") BALL_OF("0.4", "air") BALL_OF("0.3", "filling")
             BALL_OF("0.2", "ice") BALL_OF("0.1", "bubble"),
         RT_FINDING_TOO_MANY_SOLIDS},
        /* whatever is first, and of one material too */
        {NEST BALL_OF("0.1", "bubble") BALL_OF("0.3", "filling") BALL_OF("0.2", "ice")
             BALL_OF("0.5", "glass") BALL_OF("0.4", "air"),
         RT_FINDING_TOO_MANY_SOLIDS},
        {NEST CUBE("0", "glass") CUBE("0.1", "glass") CUBE("0.2", "glass") CUBE("0.3", "glass")
             CUBE("0.4", "glass"),
         RT_FINDING_TOO_MANY_SOLIDS},
        /* five of which no more than two share a point; and one of them opaque */
        {NEST CUBE("0", "glass") CUBE("1.5", "glass") CUBE("3", "glass") CUBE("4.5", "glass")
             CUBE("6", "glass"),
         RT_FINDING_NONE},
        {NEST "material white { kd 0.5 }" BALL_OF("0.5", "glass") BALL_OF("0.4", "air")
             BALL_OF("0.3", "filling") BALL_OF("0.2", "ice") BALL_OF("0.1", "white"),
         RT_FINDING_NONE},
    };
    (void)state;
    EXPECT(cases);
    told t = findings_of(cases[1].text);
    assert_true(t.last.shape == 4 && t.last.other == RT_NONE);
    /* Bubbles by the hundred do not hide the large ones that they are in. */
    t = findings_of(NEST "repeat i from 1 to 300 { sphere { centre (i / 1000) 0.5 0 radius 0.0002 "
                         "material bubble } }" BALL_OF("2", "glass") BALL_OF("1.8", "air")
                             BALL_OF("1.6", "filling") BALL_OF("1.4", "ice"));
    assert_true(t.count == 1 && t.last.kind == RT_FINDING_TOO_MANY_SOLIDS && t.last.shape == 303);
}

static void solids_without_effect_are_reported(void **state)
{
    static const scene_case cases[] = {
        {SOLIDS BALL_OF("0.5", "filling") BALL_OF("0.3", "glass"), RT_FINDING_HIDDEN},
        {SOLIDS BALL_OF("0.3", "glass") BALL_OF("0.5", "filling"), RT_FINDING_HIDDEN},
        {SOLIDS BALL_OF(
             "0.5",
             "filling") "torus { centre 0 0.5 0 axis 1 1 0 major_radius 0.2 minor_radius 0.1 "
                        "material glass }",
         RT_FINDING_HIDDEN},
        /* of equal or higher priority, or not all of it inside */
        {SOLIDS BALL_OF("0.5", "water") BALL_OF("0.3", "glass"), RT_FINDING_NONE},
        {SOLIDS BALL_OF("0.5", "glass") BALL_OF("0.3", "filling"), RT_FINDING_NONE},
        {SOLIDS BALL_OF("0.5", "filling") "sphere { centre 0.2 0.5 0 radius 0.32 material glass }",
         RT_FINDING_NONE},
        {SOLIDS BALL_OF("0.5", "filling") "box { centre 0 0.5 0 size 0.6 0.6 0.6 material glass }",
         RT_FINDING_NONE},
        /* opaque, or a lamp */
        {SOLIDS "material white { kd 0.5 }" BALL_OF("0.5", "filling") BALL_OF("0.3", "white"),
         RT_FINDING_NONE},
        {SOLIDS BALL_OF("0.5", "filling") "sphere { centre 0 0.5 0 radius 0.3 radiance 1 "
                                          "material glass }",
         RT_FINDING_NONE},
    };
    (void)state;
    EXPECT(cases);
    told t = findings_of(cases[0].text);
    assert_true(t.last.shape == 1 && t.last.other == 0);
}

/* A grid may lie in a room of quads, or be turned; only one wholly beside its solids is told. */
static void grids_beside_their_solids_are_reported(void **state)
{
#define SMOKE(lo, hi)                                                                              \
    MATERIALS VIEW SUN "grid g { file \"scenes/media/puff.grid\" lo " lo " hi " hi " }\n"          \
                       "material smoke { interface true  scattering 1  density g }\n"
#define PUFF(x) "sphere { centre " x " 0 0 radius 1 material smoke }\n"
#define WALL(corner, a, b) "quad { corner " corner " edge1 " a " edge2 " b " material smoke }\n"
    static const scene_case cases[] = {
        {SMOKE("2 0 0", "3 1 1") PUFF("0"), RT_FINDING_GRID_APART},
        {SMOKE("-1 1.1 -1", "1 2 1") PUFF("0"), RT_FINDING_GRID_APART},
        {SMOKE("0 0 -9", "1 1 -1.1") PUFF("0"), RT_FINDING_GRID_APART},
        {SMOKE("0.9 0 0", "3 1 1") PUFF("0"), RT_FINDING_NONE},
        {SMOKE("-5 -5 -5", "5 5 5") PUFF("0"), RT_FINDING_NONE},
        {SMOKE("2 0 0", "3 1 1") PUFF("0") PUFF("3"), RT_FINDING_NONE},
        {SMOKE("2 2 2", "3 3 3") WALL("0 0 0", "5 0 0", "0 5 0") WALL("0 0 5", "5 0 0", "0 5 0")
             WALL("0 0 0", "0 0 5", "0 5 0") WALL("5 0 0", "0 0 5", "0 5 0"),
         RT_FINDING_NONE},
        /* No density, but no medium either. */
        {MATERIALS VIEW SUN "grid g { file \"scenes/media/puff.grid\" lo 2 0 0 hi 3 1 1 }" BALL,
         RT_FINDING_NONE},
    };
    (void)state;
    EXPECT(cases);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solids_whose_priorities_settle_nothing_are_reported),
        cmocka_unit_test(too_many_solids_around_a_point_are_reported),
        cmocka_unit_test(solids_without_effect_are_reported),
        cmocka_unit_test(points_in_solids_are_those_of_their_equations),
        cmocka_unit_test(only_closed_shapes_have_an_inside),
        cmocka_unit_test(what_is_missing_is_reported),
        cmocka_unit_test(a_camera_too_far_from_the_origin_is_reported),
        cmocka_unit_test(a_camera_that_sees_no_shape_is_reported),
        cmocka_unit_test(glass_without_an_inside_is_reported),
        cmocka_unit_test(glass_that_is_no_solid_is_reported),
        cmocka_unit_test(sharp_edges_of_smooth_glass_are_reported),
        cmocka_unit_test(a_camera_in_a_dark_solid_is_reported),
        cmocka_unit_test(grids_beside_their_solids_are_reported),
        cmocka_unit_test(a_light_in_a_solid_is_reported),
        cmocka_unit_test(a_light_that_fills_a_solid_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
