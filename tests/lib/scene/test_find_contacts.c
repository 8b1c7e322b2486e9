/* test_find_contacts.c - rt_scene_check reports lights that lie in an opaque surface. */
#include "support.h"

#include <stdio.h>
#include <string.h>

#define BEGIN                                                                                      \
    "camera { eye 0 1 -4  look_at 0 1 0  fov 60 }\n"                                               \
    "material white { kd 0.7 }\nmaterial glass { kt 1  ior 1.5  fresnel dielectric }\n"            \
    "material lamp { emission 10 }\n"
#define ROOM "box { centre 0 2 0  size 10 4 10  material white }\n"
#define FLOOR "quad { corner -5 0 -5  edge1 0 0 10  edge2 10 0 0  material white }\n"
#define DISC(y, n) "disc { centre 0 " y " 0  normal 0 " n " 0  radius 0.5  material lamp }\n"

static const struct {
    const char *text, *says; /* NULL: nothing */
} cases[] = {
    {BEGIN ROOM DISC("4", "-1"), "in the surface of a box: which of the two is seen"},
    {BEGIN ROOM DISC("3.999", "-1"), NULL},
    {BEGIN FLOOR DISC("0", "1"), "in the surface of a quad: which"},
    {BEGIN FLOOR "quad { corner 0 0 0  edge1 0 0 1  edge2 1 0 0  material lamp }",
     "in the surface of a quad: which"},
    {BEGIN "plane { point 0 0.1 0  normal 0 1 0  material white }\n" DISC("0.1", "1"),
     "in the surface of a plane: which"},
    /* told as one that lights nothing */
    {BEGIN ROOM DISC("4", "1"), NULL},
    /* upright on the floor; another light; a window; a solid, whose face there is not seen */
    {BEGIN FLOOR "quad { corner 0 0 0  edge1 0 1 0  edge2 1 0 0  material lamp }", NULL},
    {BEGIN DISC("0", "1") "quad { corner -5 0 -5  edge1 0 0 10  edge2 10 0 0  material lamp }",
     NULL},
    {BEGIN DISC("0", "1") "box { centre 0 -1 0  size 2 2 2  material glass }", NULL},
    {BEGIN FLOOR "box { centre 0 0.5 0  size 1 1 1  material lamp }", NULL},
    /* one that crosses the floor */
    {BEGIN FLOOR "quad { corner -1 -1 0  edge1 2 0 0  edge2 0 2 1  material lamp }", NULL},
    /* delta lights */
    {BEGIN FLOOR "light point { position 1 0 2  power 9 }", "of a quad: what it lights"},
    {BEGIN FLOOR "light spot { position 1 0 2  target 0 1 0  intensity 9 }",
     "of a quad: what it lights"},
    {BEGIN FLOOR "light point { position 1 0.001 2  power 9 }", NULL},
    {BEGIN FLOOR "light point { position 9 0 2  power 9 }", NULL},
    {BEGIN ROOM "light point { position 5 1 2  power 9 }", "of a box: what it lights"},
};

typedef struct told {
    char message[256];
    uint32_t emitter, light;
    int count;
} told;

static void collect(void *user, const rt_finding *finding)
{
    told *t = user;
    if (finding->kind != RT_FINDING_LIGHT_IN_SURFACE)
        return;
    t->count++;
    t->emitter = finding->emitter;
    t->light = finding->light;
    snprintf(t->message, sizeof t->message, "%s", finding->message);
    assert_int_equal(finding->severity, RT_SEVERITY_WARNING);
}

static void lights_in_surfaces_are_told_and_no_others(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        told t = {.count = 0};
        rt_scene *scene = NULL;
        rt_error error;
        expect_ok(rt_scene_parse(&scene, cases[i].text, "scene", NULL, &error), &error);
        rt_scene_check(scene, collect, &t);
        if (t.count != (cases[i].says != NULL) || (t.count && !strstr(t.message, cases[i].says)))
            fail_msg("told %d ('%s') of:\n%s", t.count, t.message, cases[i].text);
        if (t.count)
            assert_true((t.light == RT_NONE) != (t.emitter == RT_NONE));
        rt_scene_destroy(scene);
    }
}

/* A block of a mesh that stands on the floor, and its lower face alone. */
static void faces_of_closed_meshes_are_not_told(void **state)
{
    static const float corners[8][3] = {{0, 0, 0}, {1, 0, 0}, {0, 0.5f, 0}, {1, 0.5f, 0},
                                        {0, 0, 1}, {1, 0, 1}, {0, 0.5f, 1}, {1, 0.5f, 1}};
    /* the faces down and up, then the others */
    static const uint32_t faces[12][3] = {{0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                          {0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                          {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    const rt_surface lamp = {.material = 2};
    (void)state;
    for (size_t count = 4; count <= 12; count += 8) {
        told t = {.count = 0};
        rt_scene *scene = NULL;
        rt_error error;
        expect_ok(rt_scene_parse(&scene, BEGIN FLOOR, "scene", NULL, &error), &error);
        expect_ok(rt_scene_add_triangles(scene, NULL, corners[0], 8, faces[0], count, NULL, &lamp,
                                         &error),
                  &error);
        rt_scene_check(scene, collect, &t);
        assert_int_equal(t.count, count == 4);
        rt_scene_destroy(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(faces_of_closed_meshes_are_not_told),
        cmocka_unit_test(lights_in_surfaces_are_told_and_no_others),
    };
    return cmocka_run_group_tests_name("lib/scene/find_contacts", tests, NULL, NULL);
}
