/*
 * test_touching.c - solids that touch, against closed forms: two plane slabs one upon the other
 * reflect and transmit as Fresnel's equations and all reflections between their boundaries say,
 * whatever shapes they are, in whatever order, upright or tilted; a thin gap stays one; an opaque
 * face hides those that coincide with it; and the camera may be in any of them.
 *
 * The sky is red of radiance 1, the floor below emits green of radiance 1 and reflects nothing: red
 * is what the stack reflects, green what it transmits.
 */
#include "kernels/statistics.h"
#include "lib/image/scratch.h"
#include "proof/optics.h"
#include "support.h"

#include <math.h>
#include <stdio.h>

enum { side = 8, pixels = side * side, text_most = 4096 };

static const double pi = 3.14159265358979323846;

/* ---- The closed form ---------------------------------------------------------------- */

/* A slab of a medium. */
typedef struct layer {
    double index, absorption, thickness;
} layer;

/*
 * What a stack of slabs, the uppermost first, between air above and a black floor in air reflects
 * and transmits of light at this angle: slabs are added from below, each time with all reflections
 * between the new boundary and what lies beneath it.
 */
typedef struct response {
    double reflected, transmitted;
} response;

static double cos_in(double sine, double index)
{
    return sqrt(1 - sine * sine / (index * index));
}

static response response_of(const layer *layers, int count, double sine)
{
    response all = {0, 1};
    for (int i = count; i >= 0; i--) {
        const double above = i > 0 ? layers[i - 1].index : 1;
        const double below = i < count ? layers[i].index : 1;
        const double r = optics_fresnel(cos_in(sine, above), below / above);
        const double kept =
            i < count ? exp(-layers[i].absorption * layers[i].thickness / cos_in(sine, below)) : 1;
        const double back = all.reflected * kept * kept;
        const double between = (1 - r) / (1 - r * back);
        all.transmitted *= kept * between;
        all.reflected = r + (1 - r) * between * back;
    }
    return all;
}

/* ---- Scenes ------------------------------------------------------------------------- */

/* A slab as a shape: 4 m wide, from lo to hi, with further fields of its block. */
#define SLAB_BOX "box { centre 0 %.9g 0  size 4 %.9g 4  material %s %s }\n"
#define SLAB_CYLINDER "cylinder { a 0 %.9g 0  b 0 %.9g 0  radius 2  material %s %s }\n"
#define SLAB_MODEL                                                                                 \
    "model { file \"cube.off\"  scale 2 %.9g 2  translate 0 %.9g 0  material %s %s }\n"
#define SLAB_INSTANCE "instance cube { scale 2 %.9g 2  translate 0 %.9g 0  material %s %s }\n"

typedef enum kind { BOX, CYLINDER, MODEL, INSTANCE, KINDS } kind;
static const char *const kind_names[KINDS] = {"box", "cylinder", "mesh", "instance"};

static int write_slab(char *to, kind kind, double lo, double hi, const char *material,
                      const char *tail)
{
    switch (kind) {
    case BOX:
        return sprintf(to, SLAB_BOX, (lo + hi) / 2, hi - lo, material, tail);
    case CYLINDER:
        return sprintf(to, SLAB_CYLINDER, lo, hi, material, tail);
    case MODEL:
        return sprintf(to, SLAB_MODEL, (hi - lo) / 2, (lo + hi) / 2, material, tail);
    case INSTANCE:
        return sprintf(to, SLAB_INSTANCE, (hi - lo) / 2, (lo + hi) / 2, material, tail);
    case KINDS:
        break;
    }
    return 0;
}

/* The cube from -1 to 1, normals outwards. */
static void write_cube(void)
{
    scratch_write("cube.off", "OFF\n8 6 0\n"
                              "-1 -1 -1\n1 -1 -1\n-1 1 -1\n1 1 -1\n"
                              "-1 -1 1\n1 -1 1\n-1 1 1\n1 1 1\n"
                              "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n"
                              "4 0 4 6 2\n4 1 3 7 5\n");
}

/* Where a scene stands: upright at the origin, or turned about an axis, and away from it. */
typedef struct placement {
    const char *tail;
    double axis[3], angle, away[3];
} placement;

static const placement upright = {"", {0, 1, 0}, 0, {0, 0, 0}};
static const placement tilted = {"rotate 1 2 3 37  translate 3 -2 5", {1, 2, 3}, 37, {3, -2, 5}};

/* A vector turned as the placement says (Rodrigues). */
static void turn(float out[3], const placement *at, const double v[3], double away)
{
    const double *k = at->axis, length = sqrt(k[0] * k[0] + k[1] * k[1] + k[2] * k[2]);
    const double c = cos(at->angle * pi / 180), s = sin(at->angle * pi / 180);
    const double along = (k[0] * v[0] + k[1] * v[1] + k[2] * v[2]) / (length * length);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, l = (i + 2) % 3;
        out[i] = (float)(v[i] * c + (k[j] * v[l] - k[l] * v[j]) / length * s +
                         k[i] * along * (1 - c) + away * at->away[i]);
    }
}

#define MEDIA                                                                                      \
    "material black { kd 0 }\nmaterial lamp { emission 0 1 0 }\n"                                  \
    "material glass { kt 1  ior 1.5  fresnel dielectric  absorption 1 }\n"                         \
    "material water { kt 1  ior 1.33  fresnel dielectric  absorption 2 }\n"                        \
    "material heavy { kt 1  ior 1.33  fresnel dielectric  absorption 2  priority 1 }\n"            \
    "material air { kt 1  ior 1  priority 1 }\n"                                                   \
    "mesh cube { file \"cube.off\" }\ninstance cube { material black  translate 900 0 0 }\n"
#define SKY "light environment { radiance 1 0 0 }\n"

static int write_floor(char *to, const char *tail)
{
    return sprintf(
        to, SKY "quad { corner -50 0 -50  edge1 0 0 100  edge2 100 0 0  material lamp %s }\n",
        tail);
}

/* A camera that looks from above at this angle at the middle of the stack. */
static rt_camera camera_above(const placement *at, double degrees)
{
    const double a = degrees * pi / 180, middle[3] = {0, 0.6, 0};
    const double eye[3] = {3 * sin(a), 0.6 + 3 * cos(a), 0}, up[3] = {0, 0, 1};
    rt_camera camera = {.kind = RT_CAMERA_ORTHOGRAPHIC, .width = 0.05f};
    turn(camera.look_at, at, middle, 1);
    turn(camera.eye, at, eye, 1);
    turn(camera.up, at, up, 0);
    return camera;
}

/* The means of the pixels of a picture, by channel. */
static void render(double (*channels)[pixels], const char *text, const rt_camera *camera)
{
    rt_render_options options = {.width = side,
                                 .height = side,
                                 .mode = RT_MODE_PATH,
                                 .spp = 128,
                                 .max_depth = 64,
                                 .seed = test_seed(11)};
    rt_renderer *renderer = NULL;
    rt_scene *scene = NULL;
    rt_film *film = NULL;
    rt_error error;
    expect_ok(rt_scene_parse(&scene, text, "test", NULL, &error), &error);
    expect_ok(rt_scene_set_camera(scene, camera, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    for (int i = 0; i < pixels; i++)
        for (int c = 0; c < 3; c++)
            channels[c][i] = rt_film_rgb(film)[3 * i + c];
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
}

static void expect_response(const char *text, const rt_camera *camera, response truth,
                            const char *what)
{
    double channels[3][pixels];
    char name[128];
    render(channels, text, camera);
    snprintf(name, sizeof name, "%s, reflected", what);
    expect_mean(channels[0], pixels, truth.reflected, 1e-4, name);
    snprintf(name, sizeof name, "%s, transmitted", what);
    expect_mean(channels[1], pixels, truth.transmitted, 1e-4, name);
}

/* ---- Stacks ------------------------------------------------------------------------- */

/* Two slabs: what they are, of which material, from where to where; and the stack they make. */
typedef struct stack {
    const char *name;
    const char *materials[2];
    double lo[2], hi[2]; /* of the upper one first */
    layer layers[3];
    int count;
} stack;

static const stack stacks[] = {
    {"water on glass",
     {"water", "glass"},
     {0.6, 0.4},
     {0.8, 0.6},
     {{1.33, 2, 0.2}, {1.5, 1, 0.2}},
     2},
    {"heavy water in glass, both with the same bottom",
     {"glass", "heavy"},
     {0.4, 0.4},
     {0.8, 0.6},
     {{1.5, 1, 0.2}, {1.33, 2, 0.2}},
     2},
    {"heavy water in glass, both with the same top",
     {"heavy", "glass"},
     {0.6, 0.4},
     {0.8, 0.8},
     {{1.33, 2, 0.2}, {1.5, 1, 0.2}},
     2},
    {"glass on glass", {"glass", "glass"}, {0.6, 0.4}, {0.8, 0.6}, {{1.5, 1, 0.4}}, 1},
    {"a thin gap",
     {"water", "glass"},
     {0.60002, 0.4},
     {0.8, 0.6},
     {{1.33, 2, 0.2}, {1, 0, 0}, {1.5, 1, 0.2}},
     3},
    {"a bubble of air without Fresnel equations, in water",
     {"air", "water"},
     {0.5, 0.4},
     {0.6, 0.8},
     {{1.33, 2, 0.2}, {1, 0, 0.1}, {1.33, 2, 0.1}},
     3},
    {"air without Fresnel equations in glass, both with the same bottom",
     {"air", "glass"},
     {0.4, 0.4},
     {0.6, 0.8},
     {{1.5, 1, 0.2}, {1, 0, 0.2}},
     2},
};
enum { stack_count = sizeof stacks / sizeof *stacks };

static void expect_stack(const stack *s, const kind kinds[2], int order, const placement *at,
                         double degrees)
{
    char text[text_most], what[128];
    int used = sprintf(text, MEDIA);
    used += write_floor(text + used, at->tail);
    for (int i = 0; i < 2; i++) {
        const int which = i ^ order;
        used += write_slab(text + used, kinds[which], s->lo[which], s->hi[which],
                           s->materials[which], at->tail);
    }
    rt_camera camera = camera_above(at, degrees);
    snprintf(what, sizeof what, "%s, %s first of %s above %s, at %g degrees%s", s->name,
             kind_names[kinds[order]], kind_names[kinds[0]], kind_names[kinds[1]], degrees,
             at == &tilted ? ", tilted" : "");
    expect_response(text, &camera, response_of(s->layers, s->count, sin(degrees * pi / 180)), what);
}

static void two_slabs_are_one_stack_whatever_shapes_they_are(void **state)
{
    (void)state;
    for (int i = 0; i < KINDS * KINDS; i++)
        for (int order = 0; order < 2; order++) {
            const kind kinds[2] = {(kind)(i / KINDS), (kind)(i % KINDS)};
            expect_stack(stacks, kinds, order, &upright, order ? 0 : 50);
            expect_stack(stacks, kinds, order, &tilted, order ? 50 : 0);
        }
}

static void touching_faces_count_by_priority_and_gaps_stay(void **state)
{
    (void)state;
    for (int i = 1; i < stack_count; i++)
        for (int k = 0; k < KINDS; k++)
            for (int order = 0; order < 2; order++) {
                const kind kinds[2] = {(kind)k, (kind)((k + i) % KINDS)};
                expect_stack(stacks + i, kinds, order, order ? &upright : &tilted, 50);
            }
}

/* ---- Opaque faces, half-spaces ------------------------------------------------------ */

/* Below glass, a lamp that touches it emits into the glass: 1/n^2 of its radiance is seen. */
static void a_lamp_emits_into_the_glass_that_lies_on_it(void **state)
{
    const double r = optics_fresnel(cos(50 * pi / 180), 1.5),
                 path = 0.2 / cos_in(sin(50 * pi / 180), 1.5);
    const response truth = {r, (1 - r) * exp(-path) / (1.5 * 1.5)};
    static const char *const lamps[] = {
        "quad { corner -50 0.4 -50  edge1 0 0 100  edge2 100 0 0  material lamp %s }\n",
        "disc { centre 0 0.4 0  normal 0 1 0  radius 50  material lamp %s }\n",
        "box { centre 0 0.2 0  size 50 0.4 50  material lamp %s }\n"};
    (void)state;
    for (int i = 0; i < 3 * KINDS; i++)
        for (int order = 0; order < 2; order++) {
            const placement *at = (i + order) % 2 ? &tilted : &upright;
            char text[text_most], what[64];
            int used = sprintf(text, MEDIA SKY);
            if (order)
                used += sprintf(text + used, lamps[i % 3], at->tail);
            used += write_slab(text + used, (kind)(i / 3), 0.4, 0.6, "glass", at->tail);
            if (!order)
                used += sprintf(text + used, lamps[i % 3], at->tail);
            rt_camera camera = camera_above(at, 50);
            snprintf(what, sizeof what, "lamp %d below a %s", i % 3, kind_names[i / 3]);
            expect_response(text, &camera, truth, what);
        }
}

static void a_plane_of_water_may_bear_glass(void **state)
{
    const layer layers[] = {{1.5, 1, 0.2}, {1.33, 2, 1e6}};
    (void)state;
    for (int k = 0; k < KINDS; k++)
        for (int order = 0; order < 2; order++) {
            const placement *at = order ? &tilted : &upright;
            char text[text_most];
            int used = sprintf(text, MEDIA SKY);
            used += write_slab(text + used, (kind)k, 0.6, 0.8, "glass", at->tail);
            sprintf(text + used, "plane { point 0 0.6 0  normal 0 1 0  material water %s }\n",
                    at->tail);
            rt_camera camera = camera_above(at, 50);
            expect_response(text, &camera, response_of(layers, 2, sin(50 * pi / 180)),
                            kind_names[k]);
        }
}

/* ---- White furnaces ----------------------------------------------------------------- */

#define CLEAR                                                                                      \
    "material glass { kt 1  ior 1.5  fresnel dielectric }\n"                                       \
    "material water { kt 1  ior 1.33  fresnel dielectric }\n"                                      \
    "material heavy { kt 1  ior 1.33  fresnel dielectric  priority 1 }\n"                          \
    "material white { kd 1 }\nlight environment { radiance 1 }\n"                                  \
    "mesh cube { file \"cube.off\" }\ninstance cube { material white  translate 900 0 0 }\n"

static void expect_furnace(const char *text, const rt_camera *camera, double truth,
                           const char *what)
{
    double channels[3][pixels];
    render(channels, text, camera);
    expect_mean(channels[0], pixels, truth, 1e-4 * truth, what);
}

/*
 * Radiance in a medium of index n is n^2, where the sky's is 1. Seen so steeply, no light is
 * trapped in a box by total reflection.
 */
static void the_camera_is_in_the_water_below_glass(void **state)
{
    (void)state;
    for (int i = 0; i < KINDS * KINDS; i++) {
        const placement *at = i % 2 ? &tilted : &upright;
        const double eye[3] = {0, 0.5, 0}, to[3] = {0.02, 0.6, 0.01};
        rt_camera camera = {.fov = 20};
        char text[text_most];
        int used = sprintf(text, CLEAR);
        for (int k = 0; k < 2; k++)
            if (k ^ (i / 2 % 2))
                used += write_slab(text + used, (kind)(i / KINDS), 0.6, 0.8, "glass", at->tail);
            else
                used += write_slab(text + used, (kind)(i % KINDS), 0.4, 0.6, "water", at->tail);
        turn(camera.eye, at, eye, 1);
        turn(camera.look_at, at, to, 1);
        expect_furnace(text, &camera, 1.33 * 1.33, "from the water");
    }
}

/*
 * Glass of the size of a hand on water 4 km wide, turned so that its rounded corners are a tenth of
 * a millimetre off: the errors of both faces count for whether they coincide, and for where rays
 * that leave them start.
 */
static void a_small_solid_touches_a_large_one(void **state)
{
    (void)state;
    for (int i = 0; i < 12; i++) {
        const double eye[3] = {0, 0.3, 0}, to[3] = {0.02, 0.6, 0.01};
        placement at = tilted;
        rt_camera camera = {.fov = 5};
        char text[text_most], tail[64];
        at.angle = 8 + 11 * i;
        snprintf(tail, sizeof tail, "rotate 1 2 3 %g  translate 3 -2 5", at.angle);
        at.tail = tail;
        int used = sprintf(text, CLEAR);
        used += write_slab(text + used, BOX, 0.6, 0.8, "glass", tail);
        sprintf(text + used,
                "model { file \"cube.off\"  scale 2000 0.2 2000  translate 0 0.4 0  "
                "material water %s }\n",
                tail);
        turn(camera.eye, &at, eye, 1);
        turn(camera.look_at, &at, to, 1);
        expect_furnace(text, &camera, 1.33 * 1.33, "from the water of a lake");
    }
}

/*
 * White surfaces on glass, or below all of it, send back all light. What total reflection would
 * trap meets them again.
 */
static void white_surfaces_touch_glass(void **state)
{
    static const char *const floors[] = {
        "plane { point 0 0.4 0  normal 0 1 0  material white %s }\n",
        "quad { corner -3 0.4 -3  edge1 0 0 6  edge2 6 0 0  material white %s }\n",
        "quad { corner -1 0.6 -1  edge1 0 0 2  edge2 2 0 0  material white %s }\n",
        "box { centre 0 0.2 0  size 5 0.4 5  material white %s }\n",
        "model { file \"cube.off\"  scale 1 0.1 1  translate 0 0.7 0  material white %s }\n"};
    (void)state;
    for (int i = 0; i < 5 * KINDS; i++) {
        const placement *at = i % 2 ? &tilted : &upright;
        char text[text_most], what[64];
        int used = sprintf(text, CLEAR);
        used += write_slab(text + used, (kind)(i / 5), 0.4, 0.6, "glass", at->tail);
        sprintf(text + used, floors[i % 5], at->tail);
        rt_camera camera = camera_above(at, 50);
        snprintf(what, sizeof what, "floor %d and a %s", i % 5, kind_names[i / 5]);
        expect_furnace(text, &camera, 1, what);
    }
}

/* ---- Layers ------------------------------------------------------------------------- */

static void layers_show_the_face_that_light_meets(void **state)
{
    static const char label[] =
        "quad { corner -1 0.6 -1  edge1 0 0 2  edge2 2 0 0  material white %s }\n";
    (void)state;
    for (int i = 0; i < 2 * KINDS; i++) {
        const placement *at = i / 2 % 2 ? &tilted : &upright;
        rt_render_options options = {
            .width = side, .height = side, .mode = RT_MODE_DIRECT, .spp = 1, .aov = 1};
        rt_camera camera = camera_above(at, 50);
        rt_renderer *renderer = NULL;
        rt_scene *scene = NULL;
        rt_film *film = NULL;
        rt_error error;
        char text[text_most];
        int used = sprintf(text, CLEAR);
        if (i % 2)
            used += sprintf(text + used, label, at->tail);
        used += write_slab(text + used, (kind)(i / 2), 0.4, 0.6, "glass", at->tail);
        if (i % 2 == 0)
            sprintf(text + used, label, at->tail);
        expect_ok(rt_scene_parse(&scene, text, "test", NULL, &error), &error);
        expect_ok(rt_scene_set_camera(scene, &camera, &error), &error);
        expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
        expect_ok(rt_render(&film, renderer, &options, &error), &error);
        const float *shape = rt_film_layer(film, "shape", NULL);
        assert_non_null(shape);
        for (int k = 0; k < pixels; k++)
            assert_int_equal((int)shape[k], i % 2 ? 1 : 2); /* 0: the cube far away */
        rt_film_destroy(film);
        rt_renderer_destroy(renderer);
        rt_scene_destroy(scene);
    }
}

/* ---- Curved faces ------------------------------------------------------------------- */

/* Balls of the same centre and radius, and pipes in pipes. */
static void curved_faces_coincide(void **state)
{
    static const char *const pairs[] = {
        "sphere { centre 0 0.6 0  radius 0.3  material glass %s }\n"
        "sphere { centre 0 0.6 0  radius 0.3  material heavy %s }\n",
        "sphere { centre 0 0.6 0  radius 0.3  material heavy %s }\n"
        "ellipsoid { centre 0 0.6 0  radii 0.3 0.3 0.3  material glass %s }\n",
        "cylinder { a 0 0.4 0  b 0 0.8 0  radius 0.3  material glass %s }\n"
        "cylinder { a 0 0.5 0  b 0 0.7 0  radius 0.3  material heavy %s }\n",
        "cylinder { a 0 0.4 0  b 0 0.8 0  radius 0.3  material heavy %s }\n"
        "cone { base 0 0.4 0  apex 0 0.8 0  radius 0.3  apex_radius 0.3  material glass %s }\n",
        "torus { centre 0 0.6 0  axis 0 1 0  major_radius 0.3  minor_radius 0.1 "
        "material glass %s }\n"
        "torus { centre 0 0.6 0  axis 0 1 0  major_radius 0.3  minor_radius 0.1 "
        "material heavy %s }\n"};
    (void)state;
    for (int i = 0; i < 10; i++) {
        const placement *at = i % 2 ? &tilted : &upright;
        char text[text_most];
        int used = sprintf(text, CLEAR);
        sprintf(text + used, pairs[i / 2], at->tail, at->tail);
        rt_camera camera = camera_above(at, 50);
        camera.width = 0.7f;
        expect_furnace(text, &camera, 1, "balls, pipes and rings");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(two_slabs_are_one_stack_whatever_shapes_they_are),
        statistical_test(touching_faces_count_by_priority_and_gaps_stay),
        statistical_test(a_lamp_emits_into_the_glass_that_lies_on_it),
        statistical_test(a_plane_of_water_may_bear_glass),
        statistical_test(the_camera_is_in_the_water_below_glass),
        statistical_test(a_small_solid_touches_a_large_one),
        statistical_test(white_surfaces_touch_glass),
        statistical_test(curved_faces_coincide),
        cmocka_unit_test(layers_show_the_face_that_light_meets),
    };
    void *scratch = NULL;
    if (scratch_enter(&scratch) != 0)
        return 1;
    write_cube();
    int failed = cmocka_run_group_tests_name("lib/render/touching", tests, NULL, NULL);
    return scratch_leave(&scratch) != 0 || failed != 0;
}
