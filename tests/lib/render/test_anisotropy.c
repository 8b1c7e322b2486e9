/*
 * test_anisotropy.c - brushed and Beckmann's surfaces: the directions of roughness are those of u
 * and v, turned as it is said, about shading normals as well; what cannot be is refused; and paths,
 * photons, vertex connection and merging agree.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "kernels/statistics.h"
#include "lib/render/means.h"
#include "render/renderer.h"

/* ---- Directions ------------------------------------------------------------------- */

/* What a floor of this square and material reflects of a small light, seen aslant. */
static void floor_means(double means[3], const char *square, const char *facets)
{
    char text[600];
    snprintf(text, sizeof text,
             "camera { eye 0 1 2  look_at 0 0 0  fov 10 }\n"
             "light point { position 0.3 1 -1  intensity 1 }\n"
             "material floor { ks 1  %s }\nquad { %s  material floor }\n",
             facets, square);
    render_means(means, text, (rt_render_options){.spp = 16});
}

/* The same of brushed metal, with a texture before it. */
static void textured_means(double means[3], const char *texture, const char *turn)
{
    char text[900];
    snprintf(text, sizeof text,
             "camera { eye 0 1 2  look_at 0 0 0  fov 10 }\n"
             "light point { position 0.3 1 -1  intensity 1 }\n%s"
             "material floor { ks 1  roughness 0.1  roughness_v 0.4  %s }\n"
             "quad { corner -4 0 -4  edge1 8 0 0  edge2 0 0 8  material floor }\n",
             texture, turn);
    render_means(means, text, (rt_render_options){.spp = 16});
}

/* u along x, v along z, and the same turned by 30 degrees from x to z. */
static const char straight[] = "corner -4 0 -4  edge1 8 0 0  edge2 0 0 8",
                  turned[] = "corner -1.4641 0 -5.4641  edge1 6.9282 0 4  edge2 -4 0 6.9282";

static void expect_same(const char *square, const char *facets, const char *other_square,
                        const char *other_facets)
{
    double means[3], others[3];
    floor_means(means, square, facets);
    floor_means(others, other_square, other_facets);
    assert_true(means[0] > 0.01);
    assert_float_equal(others[0], means[0], 1e-3 * means[0]);
}

static void roughness_is_along_u_and_roughness_v_along_v(void **state)
{
    double along[3], across[3];
    (void)state;
    expect_same(straight, "roughness 0.1  roughness_v 0.4", straight,
                "roughness 0.4  roughness_v 0.1  anisotropy_rotation 90");
    expect_same(straight, "roughness 0.3  roughness_v 0.3", straight, "roughness 0.3");
    /* The light is in the plane of v: seen from there, facets that lean along v reflect it. */
    floor_means(along, straight, "roughness 0.05  roughness_v 0.6");
    floor_means(across, straight, "roughness 0.6  roughness_v 0.05");
    assert_true(fabs(along[0] / across[0] - 1) > 0.2);
}

static void rotation_turns_from_u_to_v(void **state)
{
    double to[3], back[3];
    (void)state;
    expect_same(turned, "roughness 0.1  roughness_v 0.4", straight,
                "roughness 0.1  roughness_v 0.4  anisotropy_rotation 30");
    expect_same(turned, "roughness 0.1  roughness_v 0.4  distribution beckmann", straight,
                "roughness 0.1  roughness_v 0.4  distribution beckmann  anisotropy_rotation -330");
    floor_means(to, straight, "roughness 0.1  roughness_v 0.4  anisotropy_rotation 30");
    floor_means(back, straight, "roughness 0.1  roughness_v 0.4  anisotropy_rotation -30");
    assert_true(fabs(to[0] / back[0] - 1) > 0.05);
}

/* The floor is seen about v = 1/2, in the middle of the ramp. */
static void a_texture_turns_from_point_to_point(void **state)
{
    static const char ramp[] = "texture ramp { pattern gradient  a 0.25  b 0.75 }\n",
                      half[] = "texture half { pattern constant  a 0.5 }\n";
    double by_ramp[3], by_half[3], given[3], before[3];
    (void)state;
    expect_same(straight, "roughness 0.1  roughness_v 0.4  anisotropy_turn 0.0625", straight,
                "roughness 0.1  roughness_v 0.4  anisotropy_rotation 22.5");
    expect_same(straight,
                "roughness 0.1  roughness_v 0.4  anisotropy_turn 0.0625  anisotropy_rotation 7.5",
                turned, "roughness 0.1  roughness_v 0.4");
    textured_means(by_half, half, "anisotropy_turn 0.25  anisotropy_turn_texture half");
    textured_means(given, half, "anisotropy_turn 0.125");
    textured_means(by_ramp, ramp, "anisotropy_turn 0.25  anisotropy_turn_texture ramp");
    textured_means(before, ramp, "");
    assert_float_equal(by_half[0], given[0], 1e-3 * given[0]);
    assert_float_equal(by_ramp[0], given[0], 0.02 * given[0]);
    assert_true(fabs(given[0] / before[0] - 1) > 0.05);
}

static void distributions_differ(void **state)
{
    double ggx[3], beckmann[3];
    (void)state;
    floor_means(ggx, straight, "roughness 0.3");
    floor_means(beckmann, straight, "roughness 0.3  distribution beckmann");
    assert_true(fabs(beckmann[0] / ggx[0] - 1) > 0.1);
}

/* ---- What cannot be --------------------------------------------------------------- */

static void expect_refused(const rt_material *material, const char *field)
{
    rt_scene *scene = NULL;
    rt_error error;
    expect_ok(rt_scene_create(&scene, &error), &error);
    assert_int_equal(rt_scene_add_material(scene, NULL, "m", material, &error), RT_ERROR_INPUT);
    assert_string_equal(error.field, field);
    rt_scene_destroy(scene);
}

static void wrong_facets_are_refused(void **state)
{
    (void)state;
    expect_refused(&(rt_material){.ks = {1, 1, 1}, .roughness_v = 0.2f}, "roughness_v");
    expect_refused(&(rt_material){.ks = {1, 1, 1}, .roughness = 0.2f, .roughness_v = 1.5f},
                   "roughness_v");
    expect_refused(&(rt_material){.ks = {1, 1, 1}, .anisotropy_rotation = NAN},
                   "anisotropy_rotation");
    expect_refused(&(rt_material){.ks = {1, 1, 1}, .distribution = (rt_distribution)2},
                   "distribution");
    expect_refused(
        &(rt_material){.ks = {1, 1, 1}, .exponent = 10, .distribution = RT_DISTRIBUTION_BECKMANN},
        "distribution");
}

/* ---- A room ----------------------------------------------------------------------- */

/* A brushed ball and plate, textured and with a normal map, and glass of Beckmann's facets. */
static const char room[] =
    "camera { eye 0 0.1 1.9  look_at 0 -0.1 0  fov 50 }\n"
    "texture squares { pattern checker  a 0.6 0.55 0.9  b 0.45 0.4 0.9  scale 5 4 }\n"
    "texture grey { pattern checker  a 1 1 1  b 0.6 0.6 0.6  scale 5 4 }\n"
    "material wall { kd 0.7 0.6 0.4 }\n"
    "material ball { kd 0.3  ks 0.5  roughness 0.25  roughness_v 0.6  anisotropy_rotation 30\n"
    "                roughness_texture grey  normal_texture squares }\n"
    "material plate { ks 0.8  roughness 0.6  roughness_v 0.3  distribution beckmann\n"
    "                 anisotropy_rotation 20  anisotropy_turn_texture grey }\n"
    "material frost { kt 1  fresnel dielectric  ior 1.5  roughness 0.3\n"
    "                 distribution beckmann }\n"
    "material lamp { emission 5 }\nbox { centre 0 0 0  size 2 2 4  material wall }\n"
    "sphere { centre 0.4 -0.5 -0.2  radius 0.4  material ball }\n"
    "sphere { centre -0.4 -0.5 0.2  radius 0.3  material frost }\n"
    "quad { corner -0.9 -0.7 -0.9  edge1 1.8 0 0  edge2 0 1.2 0  material plate }\n"
    "quad { corner -0.4 0.95 -0.4  edge1 0.8 0 0  edge2 0 0 0.8  material lamp }\n";

static void modes_agree_in_a_room(void **state)
{
    (void)state;
    expect_modes_agree(room);
}

/* A brushed plate, seen where it is lit by a lamp aside. */
static const char plate[] =
    "camera { eye 0 2 2  look_at 0 0 0  fov 16 }\n"
    "material brushed { ks 1  roughness 0.2  roughness_v 0.6  anisotropy_rotation 20 }\n"
    "material lamp { emission 5 }\n"
    "quad { corner -1 0 -1  edge1 0 0 2  edge2 2 0 0  material brushed }\n"
    "quad { corner 0.2 1 -1.6  edge1 0.8 0 0  edge2 0 0 0.8  material lamp }\n";

/* Photons are gathered by facets of the same two roughnesses. */
static void gathered_facets_have_the_mean_of_paths(void **state)
{
    (void)state;
    expect_gathered_means(plate);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(roughness_is_along_u_and_roughness_v_along_v),
        cmocka_unit_test(rotation_turns_from_u_to_v),
        cmocka_unit_test(a_texture_turns_from_point_to_point),
        cmocka_unit_test(distributions_differ),
        cmocka_unit_test(wrong_facets_are_refused),
        statistical_test(modes_agree_in_a_room),
        statistical_test(gathered_facets_have_the_mean_of_paths),
    };
    return cmocka_run_group_tests_name("lib/render/anisotropy", tests, NULL, NULL);
}
