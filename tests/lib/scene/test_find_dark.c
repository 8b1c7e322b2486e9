/*
 * test_find_dark.c - rt_scene_check reports which lights light nothing, and their pictures are
 * black.
 */
#include "support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/inspection.h"

#define BEGIN                                                                                      \
    "camera { eye 0 1 -4  look_at 0 1 0  fov 60 }\n"                                               \
    "film { width 12  height 12 }\nrender { spp 32 }\n" OBJECTS
#define OBJECTS                                                                                    \
    "material white { kd 0.7 }\nmaterial lamp { kd 0.1  emission 10 }\n"                           \
    "material both { emission 10  two_sided true }\nmaterial glass { kt 1 }\n"
#define FLOOR "plane { point 0 0 0  normal 0 1 0  material white }\n"
#define BALL "sphere { centre 0 1 0  radius 0.5  material white }\n"
#define WALL(corner, a, b) "quad { corner " corner "  edge1 " a "  edge2 " b "  material white }\n"
#define ROOM                                                                                       \
    WALL("-2 0 -5", "4 0 0", "0 0 10")                                                             \
    WALL("-2 3 -5", "4 0 0", "0 0 10")                                                             \
    WALL("-2 0 5", "4 0 0", "0 3 0")                                                               \
    WALL("-2 0 -5", "4 0 0", "0 3 0")                                                              \
    WALL("-2 0 -5", "0 0 10", "0 3 0")                                                             \
    WALL("2 0 -5", "0 0 10", "0 3 0")
#define PROJECTOR(target)                                                                          \
    "light projector { position 0 3 0  target " target "  irradiance 9  fov 53.130102  file "      \
    "\"scenes/textures/letter.png\" }\n"
/* A square of side 1 at a height, which emits up or down. */
#define UP(y) "quad { corner -0.5 " y " -0.5  edge1 0 0 1  edge2 1 0 0  material lamp }\n"
#define DOWN(y) "quad { corner -0.5 " y " -0.5  edge1 1 0 0  edge2 0 0 1  material lamp }\n"
#define DISC(n) "disc { centre 0 3 0  normal " n "  radius 0.5  material lamp"
#define SPOT(target, outer)                                                                        \
    "light spot { position 0 3 0  target " target "  intensity 10  outer " outer " }\n"
#define BEAM(x, target)                                                                            \
    "light beam { position " x " 3 0  target " target "  width 0.4  irradiance 9 }\n"

typedef struct dark_case {
    const char *text;
    const char *says; /* of its last light that lights nothing; NULL: there is none */
} dark_case;

/* Of a light that lights nothing and that another finding tells of. */
#define ELSEWHERE ""

static const dark_case cases[] = {
    /* Flat lights in a room, whose ceiling is at 3 m; in the open; turned by what places them. */
    {BEGIN ROOM DOWN("2.99"), NULL},
    {BEGIN ROOM UP("2"), NULL},
    {BEGIN ROOM UP("3"), "along 0 1 0, where it touches a quad; 3 m behind it is a quad"},
    {BEGIN ROOM UP("2.99"), "or next to it: it emits along 0 1 0, where a quad is 0.01 m away"},
    {BEGIN FLOOR BALL UP("2.5"), "where nothing is; 1 m behind it is a sphere"},
    {BEGIN FLOOR BALL DOWN("2.5"), NULL},
    {BEGIN FLOOR "quad { corner -0.5 2 -0.5  edge1 0 0 1  edge2 1 0 0  material both }", NULL},
    {BEGIN FLOOR DISC("0 1 0") "}", "along 0 1 0, where nothing is; 3 m behind it is a plane"},
    {BEGIN FLOOR DISC("0 -1 0") "}", NULL},
    {BEGIN FLOOR DISC("0 -1 0") "}\nmaterial paper { diffuse_transmission 0.5 }\n"
                                "plane { point 0 2 0  normal 0 1 0  material paper }",
     NULL},
    {BEGIN FLOOR DISC("0 -1 0") "}\nmaterial paper { diffuse_transmission 0.5 }\n"
                                "sphere { centre 0 3 0  radius 1  material paper }",
     NULL},
    {BEGIN FLOOR DISC("0 -1 0") " scale -1 1 1 }", NULL},
    {BEGIN FLOOR DISC("0 1 0") " scale 1 -1 1 translate 0 6 0 }", NULL},
    {BEGIN FLOOR DISC("0 -1 0") " rotate 1 0 0 180 translate 0 6 0 }", "along 0 1 0, where noth"},
    {BEGIN FLOOR "quad { corner -0.5 -2 -0.5  edge1 1 0 0  edge2 0 0 1  material lamp "
                 "scale 1 -1 1 }",
     "along 0 1 0, where nothing is"},
    {BEGIN FLOOR "quad { corner -0.5 -2 -0.5  edge1 0 0 1  edge2 1 0 0  material lamp "
                 "scale 1 -1 1 }",
     NULL},
    /* Something on that side: above, through glass, or the light itself, which the camera sees. */
    {BEGIN FLOOR BALL UP("0.3"), NULL},
    {BEGIN ROOM UP("2.98") "box { centre 0 3.1 0  size 4.4 0.2 10.4  material white }\n"
                           "sphere { centre 0 8 0  radius 1  material white }\n",
     "or next to it: it emits along 0 1 0, where a"},
    {BEGIN ROOM UP("3") "box { centre 0 3.1 0  size 4 0.2 10  material white }\n",
     "along 0 1 0, where it touches a box"},
    {"camera { eye 0 3 -3  look_at 0 2 0  fov 60 }\nfilm { width 12 height 12 }\n"
     "render { spp 8 }\n" OBJECTS FLOOR UP("2.5"),
     NULL},
    {"camera { eye 0 3 -4  look_at 0 0.5 -2  fov 20 }\nfilm { width 12 height 12 }\n"
     "render { spp 8 }\n" OBJECTS FLOOR UP("2.5"),
     "along 0 1 0, where nothing is"},
    /* Solids that emit outwards, from around all there is. */
    {BEGIN BALL "sphere { centre 0 0 0  radius 9  material lamp }", ELSEWHERE},
    {BEGIN BALL "sphere { centre 0 0 0  radius 9  material both }", NULL},
    {BEGIN BALL "box { centre 0 0 0  size 99 99 99  material lamp }", ELSEWHERE},
    {BEGIN BALL "sphere { centre 0 3 0  radius 0.5  material lamp }", NULL},
    {BEGIN FLOOR "box { centre 0 2.5 0  size 2 1 2  material white }\n" UP("2.5"), ELSEWHERE},
    /* Spot lights. */
    {BEGIN FLOOR BALL SPOT("0.2 4 0", "30"), "nothing is in its cone, 30 degrees about 0.196 0.98"},
    {BEGIN FLOOR BALL SPOT("1 3.3 0", "10"), "nothing is in its cone, 10 degrees"},
    {BEGIN BALL SPOT("5 1 0", "20"), "nothing is in its cone, 20 degrees about 0.928 -0.371 0"},
    {BEGIN BALL SPOT("0.5 1 0", "20"), NULL},
    {BEGIN FLOOR SPOT("0.2 2 0", "30"), NULL},
    {BEGIN FLOOR SPOT("0 4 0", "120"), NULL},
    /* The cone around a projector's image of 72 x 72 pixels. */
    {BEGIN FLOOR BALL PROJECTOR("0.2 4 0"), "nothing is in its cone, 35.3 degrees"},
    {BEGIN FLOOR PROJECTOR("0 0 1"), NULL},
    {BEGIN BALL "light goniometric { position 0 3 0  target 0 9 0  file "
                "\"scenes/luminaires/wallwasher.ies\" }\n",
     "nothing is in its cone, 90 degrees"},
    /* Beams. */
    {BEGIN BALL BEAM("0", "0 4 0"), "nothing is in its beam along 0 1 0"},
    {BEGIN BALL BEAM("0", "0 1 -0.5"), NULL},
    {BEGIN BALL BEAM("0.8", "0.8 0 0"), "nothing is in its beam along 0 -1 0"},
    {BEGIN BALL BEAM("0.4", "0.3 1 -0.4"), NULL},
    {BEGIN FLOOR BEAM("0", "1 4 0"), "nothing is in its beam"},
    {BEGIN FLOOR BEAM("0", "1 0 0"), NULL},
    /* Opaque planes. */
    {BEGIN FLOOR BALL "light directional { direction 0.3 1 0.2  irradiance 3 }",
     "it comes from behind an opaque plane"},
    {BEGIN FLOOR BALL "light directional { direction 0.3 -1 0.2  irradiance 3 }", NULL},
    {BEGIN FLOOR BALL "light point { position 0 -1 0  intensity 3 }", "is behind an opaque plane"},
    {BEGIN FLOOR UP("-1"), "is behind an opaque plane"},
    {BEGIN "plane { point 0 0 0 normal 0 -1 0 material white }" BALL UP("-1"), "behind an opaque"},
    {BEGIN "plane { point 0 0 0  normal 0 1 0  material glass }\n" BALL UP("-1"), NULL},
};

enum { CASES = sizeof cases / sizeof *cases };

/* The last finding of this kind, and how many there are. */
typedef struct told {
    char message[256];
    uint32_t emitter, light;
    int count;
} told;

static void collect(void *user, const rt_finding *finding)
{
    told *t = user;
    if (finding->kind != RT_FINDING_LIGHTS_NOTHING)
        return;
    t->count++;
    t->emitter = finding->emitter;
    t->light = finding->light;
    snprintf(t->message, sizeof t->message, "%s", finding->message);
    assert_int_equal(finding->severity, RT_SEVERITY_WARNING);
}

static rt_scene *parse(const char *text)
{
    rt_scene *scene = NULL;
    rt_error error;
    expect_ok(rt_scene_parse(&scene, text, "scene", NULL, &error), &error);
    return scene;
}

static told dark_lights_of(const rt_scene *scene)
{
    told t = {.count = 0};
    rt_scene_check(scene, collect, &t);
    return t;
}

static void note_warning(void *user, const char *line)
{
    snprintf(user, 256, "%s", line);
}

/* The mean of a scene's picture; its last warning goes to said. */
static double mean_of_picture(const rt_scene *scene, char said[256])
{
    const rt_hooks hooks = {.warning = note_warning, .user = said};
    rt_renderer *renderer = NULL;
    rt_film *film = NULL;
    rt_render_options options;
    rt_error error;
    double sum = 0;
    said[0] = '\0';
    rt_scene_get_options(scene, &options);
    options.hooks = &hooks;
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    for (uint32_t i = 0; i < 3 * options.width * options.height; i++)
        sum += rt_film_rgb(film)[i];
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
    return sum / (3 * options.width * options.height);
}

static void lights_that_light_nothing_are_told_and_no_others(void **state)
{
    (void)state;
    for (size_t i = 0; i < CASES; i++) {
        rt_scene *scene = parse(cases[i].text);
        const told t = dark_lights_of(scene);
        if (t.count != (cases[i].says && cases[i].says[0]) ||
            (t.count && !strstr(t.message, cases[i].says)))
            fail_msg("told %d ('%s'), not '%s', of:\n%s", t.count, t.message,
                     cases[i].says ? cases[i].says : "", cases[i].text);
        assert_int_equal(rt_scene_is_dark(scene), cases[i].says != NULL);
        rt_scene_destroy(scene);
    }
}

/* A gap of a hundredth of the light's size lets a few hundredths of its light out. */
static void their_pictures_are_black_and_those_of_others_are_not(void **state)
{
    (void)state;
    for (size_t i = 0; i < CASES; i++) {
        char said[256];
        rt_scene *scene = parse(cases[i].text);
        const double mean = mean_of_picture(scene, said);
        const int has_gap = cases[i].says && strncmp(cases[i].says, "or next", 7) == 0;
        const double most = has_gap ? 0.02 : 0;
        if (cases[i].says ? mean > most : mean <= 0)
            fail_msg("the mean is %g of:\n%s", mean, cases[i].text);
        assert_int_equal(strstr(said, "no light of the scene lights anything") != NULL,
                         cases[i].says != NULL);
        rt_scene_destroy(scene);
    }
}

/* One of several, by its number; and those of a mesh, by all of its faces. */
static void each_light_counts_by_itself(void **state)
{
    (void)state;
    rt_scene *scene =
        parse(BEGIN ROOM UP("3") DOWN("2.9") "light point { position 0 1 0 power 1 }");
    told t = dark_lights_of(scene);
    assert_true(t.count == 1 && t.emitter == 6 && t.light == RT_NONE);
    assert_false(rt_scene_is_dark(scene));
    rt_scene_destroy(scene);
    scene = parse(BEGIN FLOOR "light point { position 0 1 0 power 1 }" SPOT("0 4 0", "9"));
    t = dark_lights_of(scene);
    assert_true(t.count == 1 && t.emitter == RT_NONE && t.light == 1);
    rt_scene_destroy(scene);
    /* Out of view, where another lights what is seen; and in a medium, which shows all light. */
    scene = parse("camera { eye 0 3 -4  look_at 0 0.5 -2  fov 20 }\n" OBJECTS FLOOR UP(
        "2.5") "light point { position 0 9 0 power 1 }");
    assert_int_equal(dark_lights_of(scene).count, 0);
    rt_scene_destroy(scene);
    scene = parse(BEGIN FLOOR UP("2.5") "medium { scattering 0.1 }");
    assert_int_equal(dark_lights_of(scene).count, 0);
    rt_scene_destroy(scene);
    scene = parse(OBJECTS UP("2.5")); /* part of a scene */
    assert_int_equal(dark_lights_of(scene).count, 0);
    rt_scene_destroy(scene);
}

/* A cube of side 0.4 about a point, with its faces turned outwards or inwards. */
static void add_cube(rt_scene *scene, const float centre[3], int is_inverted)
{
    static const uint32_t faces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                          {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                          {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    const rt_surface lamp = {.material = 1};
    uint32_t indices[12][3];
    float corners[8][3];
    rt_error error;
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 3; k++)
            corners[i][k] = centre[k] + (i >> k & 1 ? 0.2f : -0.2f);
    for (int i = 0; i < 12; i++) {
        indices[i][0] = faces[i][0];
        indices[i][1] = faces[i][is_inverted ? 2 : 1];
        indices[i][2] = faces[i][is_inverted ? 1 : 2];
    }
    expect_ok(
        rt_scene_add_triangles(scene, NULL, corners[0], 8, indices[0], 12, NULL, &lamp, &error),
        &error);
}

static void a_mesh_that_emits_inwards_is_told(void **state)
{
    static const float above[3] = {0, 2, 0}, below[3] = {0, -9, 0};
    (void)state;
    for (int is_inverted = 0; is_inverted < 2; is_inverted++) {
        rt_scene *scene = parse(BEGIN FLOOR);
        add_cube(scene, above, is_inverted);
        const told t = dark_lights_of(scene);
        assert_int_equal(t.count, is_inverted);
        assert_true(!is_inverted || strstr(t.message, "it emits inwards, and nothing is in it"));
        rt_scene_destroy(scene);
    }
    /* Something may be in it. */
    rt_scene *scene = parse(BEGIN FLOOR "sphere { centre 0 2 0  radius 0.1  material white }");
    add_cube(scene, above, 1);
    assert_int_equal(dark_lights_of(scene).count, 0);
    add_cube(scene, below, 0);
    assert_int_equal(dark_lights_of(scene).count, 1);
    rt_scene_destroy(scene);
}

/* Lights are not told any more once the check has looked at much. */
static void many_lights_take_bounded_time(void **state)
{
    enum { LIGHTS = 200, BALLS = 50000, FEW = 50 };
    const rt_surface white = {.material = 0}, lamp = {.material = 1};
    rt_error error;
    (void)state;
    for (int balls = FEW; balls <= BALLS; balls += BALLS - FEW) {
        told t = {.count = 0};
        rt_scene *scene = parse(BEGIN);
        rt_inspection in = {.scene = scene, .found = collect, .user = &t};
        for (int i = 0; i < balls; i++)
            expect_ok(rt_scene_add_sphere(scene, NULL, (const float[3]){0, -(float)i, 0}, 0.1f,
                                          &white, &error),
                      &error);
        for (int i = 0; i < LIGHTS; i++)
            expect_ok(rt_scene_add_quad(scene, NULL, (const float[3]){-0.5f, 2, -0.5f},
                                        (const float[3]){0, 0, 1}, (const float[3]){1, 0, 0}, &lamp,
                                        &error),
                      &error);
        rt_find_dark_lights(&in);
        if (balls == FEW)
            assert_int_equal(t.count, LIGHTS);
        else
            assert_true(t.count > 50 && t.count < 150);
        rt_scene_destroy(scene);
    }
}

/* What leaves the room of the camera leaves a black picture that is told all the same. */
static void a_black_picture_is_told_whatever_its_cause(void **state)
{
    char said[256];
    (void)state;
    rt_scene *scene = parse(BEGIN ROOM "light point { position 9 9 9  intensity 1 }");
    assert_int_equal(dark_lights_of(scene).count, 0);
    assert_true(mean_of_picture(scene, said) == 0);
    assert_non_null(strstr(said, "the picture is black: no path found light"));
    rt_scene_destroy(scene);
    /* So little comes through a wall by rounding that it is no light. */
    scene = parse("camera { eye 0 2 -6 look_at 0 1 0 }\nfilm { width 48 height 48 }\n"
                  "render { spp 64 }\nmaterial white { kd 0.7 }\nmaterial lamp { emission 5 }\n"
                  "plane { point 0 0 0 normal 0 1 0 material white }\n"
                  "sphere { centre 0 1 0 radius 1 material white }\n"
                  "sphere { centre 0 4 0 radius 0.25 material lamp }\n"
                  "sphere { centre 0 4 0 radius 0.4 material white }\n");
    const double leak = mean_of_picture(scene, said);
    assert_true(leak > 0 && leak < 1e-10);
    assert_non_null(strstr(said, "the picture is black: no path found light"));
    rt_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lights_that_light_nothing_are_told_and_no_others),
        cmocka_unit_test(their_pictures_are_black_and_those_of_others_are_not),
        cmocka_unit_test(each_light_counts_by_itself),
        cmocka_unit_test(a_mesh_that_emits_inwards_is_told),
        cmocka_unit_test(many_lights_take_bounded_time),
        cmocka_unit_test(a_black_picture_is_told_whatever_its_cause),
    };
    return cmocka_run_group_tests_name("lib/scene/find_dark", tests, NULL, NULL);
}
