/* test_ies.c - IES files: what they say, what is refused; and what tables of lights emit. */
#include "support.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "scene/ies.h"
#include "scene/light_table.h"

static const double pi = 3.14159265358979323846;

static rt_status decode(rt_scene_light_table *out, const char *text, rt_error *error)
{
    const rt_bytes file = {(uint8_t *)text, strlen(text), strlen(text), NULL};
    return rt_ies_decode(out, &file, NULL, error);
}

static float value_at(const rt_scene_light_table *t, rt_u32 column, rt_u32 row)
{
    return t->values[4 * (row * (t->columns + 1) + column)];
}

static void expect_columns(const char *text, const double *degrees, const float *last, rt_u32 count)
{
    rt_scene_light_table t;
    rt_error error;
    expect_ok(decode(&t, text, &error), &error);
    assert_int_equal(t.columns, count - 1);
    assert_int_equal(t.rows, 1);
    for (rt_u32 i = 0; i < count; i++) {
        assert_float_equal(t.lines[i], degrees[i] * pi / 180, 1e-6);
        assert_float_equal(value_at(&t, i, 0), 7, 0);
        assert_float_equal(value_at(&t, i, 1), last[i], 0);
    }
    assert_float_equal(t.lines[count], 0, 0);
    assert_float_equal(t.lines[count + 1], pi / 2, 1e-6);
    rt_light_table_free(&t);
}

/* What is measured on a quarter or a half is mirrored. */
static void symmetries_are_unfolded(void **state)
{
    (void)state;
    expect_columns("TILT=NONE\n1 1 1 2 1 1 1 0 0 0 1 1 0\n0 90\n0\n7 1\n", (double[]){0, 360},
                   (float[]){1, 1}, 2);
    expect_columns("TILT=NONE\n1 1 1 2 3 1 1 0 0 0 1 1 0\n0 90\n0 30 90\n7 1 7 2 7 3\n",
                   (double[]){0, 30, 90, 150, 180, 210, 270, 330, 360},
                   (float[]){1, 2, 3, 2, 1, 2, 3, 2, 1}, 9);
    expect_columns("TILT=NONE\n1 1 1 2 3 1 1 0 0 0 1 1 0\n0 90\n0 30 180\n7 1 7 2 7 3\n",
                   (double[]){0, 30, 180, 330, 360}, (float[]){1, 2, 3, 2, 1}, 5);
    expect_columns("TILT=NONE\n1 1 1 2 3 1 1 0 0 0 1 1 0\n0 90\n0 30 360\n7 1 7 2 7 1\n",
                   (double[]){0, 30, 360}, (float[]){1, 2, 1}, 3);
}

/* Commas and line ends part numbers, the multiplier and both ballast factors count. */
static void factors_multiply_candela(void **state)
{
    rt_scene_light_table t;
    rt_error error;
    (void)state;
    expect_ok(decode(&t,
                     "IESNA:LM-63-1995\r\n[A] TILT=INCLUDE\r\nTILT=NONE\r\n1,-1,2\r\n2 1 1 2 .1 "
                     "+1e-1 0\r\n0.5,3.\r\n 4\r\n0\t180 0 10 2E1",
                     &error),
              &error);
    assert_float_equal(value_at(&t, 1, 0), 30, 0);
    assert_float_equal(value_at(&t, 0, 1), 60, 0);
    rt_light_table_free(&t);
}

/* 1 along the axis, linear in the angle to 0 at 90 degrees: 2 pi (1 - 2 / pi). */
static void the_flux_is_the_integral_of_the_table(void **state)
{
    rt_scene_light_table t;
    rt_error error;
    (void)state;
    expect_ok(decode(&t, "TILT=NONE\n1 1 1 3 1 1 1 0 0 0 1 1 0\n0 30 90\n0\n9 6 0\n", &error),
              &error);
    rt_light_table_measure(&t, NULL);
    assert_float_equal(t.flux[1], 9 * 2 * pi * (1 - 2 / pi), 1e-5);
    assert_float_equal(t.peak, 9, 1e-6);
    assert_float_equal(t.cosine, 0, 1e-6);
    rt_light_table_free(&t);
}

/* Of irradiance the flux is the mean over the plane's area; its intensity is over cos^3. */
static void images_emit_what_they_show(void **state)
{
    static const float texels[2][4] = {{1, 2, 3, 0}, {5, 6, 7, 0}};
    const double half[2] = {1, 0.5}, corner = 2.25;
    rt_scene_light_table t;
    rt_error error;
    (void)state;
    for (rt_u32 cells = 0; cells <= RT_TABLE_CELLS; cells += RT_TABLE_CELLS) {
        expect_ok(rt_light_table_of_image(&t, texels[0], 2, 1,
                                          RT_TABLE_PLANE | RT_TABLE_IRRADIANCE | cells, half, NULL,
                                          &error),
                  &error);
        rt_light_table_measure(&t, NULL);
        assert_float_equal(t.flux[0], 2 * 3, 1e-6);
        assert_float_equal(t.flux[2], 2 * 5, 1e-6);
        assert_float_equal(t.cosine, 1 / sqrt(corner), 1e-6);
        assert_float_equal(t.peak, 6 * pow(corner, 1.5), 1e-3);
        rt_light_table_free(&t);
    }
    /* As intensity: the solid angle of the rectangle, 4 atan of a b / sqrt(1 + a^2 + b^2), by 3. */
    expect_ok(rt_light_table_of_image(&t, texels[0], 2, 1, RT_TABLE_PLANE, half, NULL, &error),
              &error);
    rt_light_table_measure(&t, NULL);
    assert_float_equal(t.flux[0], 3 * 4 * atan(0.5 / sqrt(corner)), 1e-4);
    /* Where it repeats, its ends are between its texels, in each of the rows. */
    rt_light_table_repeat(&t);
    for (int row = 0; row < 3; row++) {
        const float *v = t.values + 16 * row;
        assert_true(v[0] == 3 && v[4] == 1 && v[8] == 5 && v[12] == 3);
    }
    rt_light_table_free(&t);
    expect_ok(rt_light_table_of_image(&t, texels[0], 1, 2, RT_TABLE_PLANE, half, NULL, &error),
              &error);
    rt_light_table_repeat(&t);
    for (int column = 0; column < 3; column++) {
        const float *v = t.values + 4 * column;
        assert_true(v[0] == 3 && v[12] == 1 && v[24] == 5 && v[36] == 3);
    }
    rt_light_table_free(&t);
}

#define NUMBERS "1 1 1 2 1 1 1 0 0 0 1 1 0\n"
static const struct {
    const char *text, *message;
    uint32_t line;
} refused[] = {
    {"", "no line that begins with TILT=", 0},
    {"IESNA91\n[TILT=NONE]\n", "no line that begins with TILT=", 2},
    {"IESNA91\nTILT=INCLUDE\n1\n", "TILT=INCLUDE; only TILT=NONE", 2},
    {"TILT=NONE\n", "ends where its number of sources", 2},
    {"TILT=NONE\n1 1 x\n", "'x' where its candela multiplier", 2},
    {"TILT=NONE\n1 1 1 nan\n", "'nan' where its number of vertical angles", 2},
    {"TILT=NONE\n1 1 1 1e3.5\n", "'1e3.5' where", 2},
    {"TILT=NONE\n1 1 1 1e\n", "'1e' where", 2},
    {"TILT=NONE\n1 1 1e999\n", "too large", 2},
    {"TILT=NONE\n1 1 1 0\n", "vertical angles 0; it must be a whole number from 1", 2},
    {"TILT=NONE\n1 1 1 2.5\n", "vertical angles 2.5", 2},
    {"TILT=NONE\n1 1 1 2 99999\n", "horizontal angles 99999", 2},
    {"TILT=NONE\n1 1 1 2 1 2\n", "photometric type B (2); only type C", 2},
    {"TILT=NONE\n1 1 1 2 1 1 3\n", "units 3; they are 1, feet, or 2", 2},
    {"TILT=NONE\n1 1 -1 2 1 1 1 0 0 0 1 1 0\n", "make -1; their product must be above 0", 2},
    {"TILT=NONE\n1 1 1 2 1 1 1 0 0 0 0 1 0\n", "make 0; their product", 2},
    {"TILT=NONE\n1 1 1 36001 36001 1 1 0 0 0 1 1 0\n", "too short", 2},
    {"TILT=NONE\n" NUMBERS "0 181\n0\n1 1\n", "vertical angle 181; it must lie from 0 to 180", 3},
    {"TILT=NONE\n" NUMBERS "-1 90\n0\n1 1\n", "vertical angle -1", 3},
    {"TILT=NONE\n" NUMBERS "90 90\n0\n1 1\n", "90 follows on 90; they must ascend", 3},
    {"TILT=NONE\n" NUMBERS "0 90\n5\n1 1\n", "go from 5 to 5", 4},
    {"TILT=NONE\n1 1 1 2 2 1 1 0 0 0 1 1 0\n0 90\n0 270\n1 1 1 1\n", "go from 0 to 270", 4},
    {"TILT=NONE\n1 1 1 1 2 1 1 0 0 0 1 1 0\n0\n0 90\n1 1\n", "one vertical angle", 4},
    {"TILT=NONE\n" NUMBERS "0 90\n0\n1 -1\n", "-1 candela; they must lie from 0", 5},
    {"TILT=NONE\n1 1 1e20 2 1 1 1 0 0 0 1 1 0\n0 90\n0\n1 1e20\n", "1e+40 candela", 5},
    {"tilt = none\n" NUMBERS "0 90\n0\n1 1 1\n", "goes on behind the candela values of its 2", 5},
    {"TILT=NONE\n" NUMBERS "0 90\n0\n1 1\nEND\n", "horizontal angles", 6},
    {"TILT=NONE\n" NUMBERS "0 90\n0\n1          \n", "ends where its candela value", 6},
};

static void files_that_are_damaged_are_refused(void **state)
{
    rt_scene_light_table t = {.columns = 99};
    rt_error error;
    (void)state;
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        assert_int_equal(decode(&t, refused[i].text, &error), RT_ERROR_INPUT);
        if (!strstr(error.message, refused[i].message))
            fail_msg("'%s' lacks '%s'", error.message, refused[i].message);
        assert_int_equal(error.line, refused[i].line);
        assert_int_equal(t.columns, 99);
    }
}

static void lights_of_tables_are_checked(void **state)
{
    rt_goniometric_light luminaire = {.position = {0, 2, 0},
                                      .path = "scenes/luminaires/wallwasher.ies"};
    rt_projector_light projector = {.position = {0, 2, 0}, .irradiance = {1, 1, 1}};
    rt_scene *scene = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_scene_create(&scene, &error), &error);
#define EXPECT_REFUSED(call, name)                                                                 \
    assert_int_equal(call, RT_ERROR_INPUT);                                                        \
    assert_string_equal(error.field, name)
    expect_ok(rt_scene_add_goniometric_light(scene, &luminaire, &error), &error);
    assert_float_equal(scene->lights[0].emission[1], 1 / 179.0, 1e-9);
    luminaire.up[1] = 1;
    EXPECT_REFUSED(rt_scene_add_goniometric_light(scene, &luminaire, &error), "up");
    luminaire.up[0] = 1;
    luminaire.layer = "a";
    EXPECT_REFUSED(rt_scene_add_goniometric_light(scene, &luminaire, &error), "layer");
    luminaire.layer = NULL;
    luminaire.intensity[1] = NAN;
    EXPECT_REFUSED(rt_scene_add_goniometric_light(scene, &luminaire, &error), "intensity");
    EXPECT_REFUSED(rt_scene_add_projector_light(scene, &projector, &error), "path");
    projector.path = "none.png";
    EXPECT_REFUSED(rt_scene_add_projector_light(scene, &projector, &error), "path");
    projector.fov = 180;
    EXPECT_REFUSED(rt_scene_add_projector_light(scene, &projector, &error), "fov");
    projector.intensity[0] = 1;
    EXPECT_REFUSED(rt_scene_add_projector_light(scene, &projector, &error), "intensity");
    projector.intensity[0] = 0;
    projector.fov = 20;
    projector.filter = (rt_texture_filter)2;
    EXPECT_REFUSED(rt_scene_add_projector_light(scene, &projector, &error), "filter");
    projector.filter = RT_TEXTURE_FILTER_BILINEAR;
    memcpy(projector.target, projector.position, sizeof projector.target);
    EXPECT_REFUSED(rt_scene_add_projector_light(scene, &projector, &error), "target");
    rt_spot_light spot = {.position = {0, 2, 0},
                          .intensity = {1, 1, 1},
                          .outer = 90,
                          .path = "scenes/textures/letter.png"};
    EXPECT_REFUSED(rt_scene_add_spot_light(scene, &spot, &error), "outer");
    assert_int_equal(scene->light_count, 1);
    assert_int_equal(scene->light_table_count, 1);
    rt_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(symmetries_are_unfolded),
        cmocka_unit_test(factors_multiply_candela),
        cmocka_unit_test(the_flux_is_the_integral_of_the_table),
        cmocka_unit_test(images_emit_what_they_show),
        cmocka_unit_test(files_that_are_damaged_are_refused),
        cmocka_unit_test(lights_of_tables_are_checked),
    };
    return cmocka_run_group_tests_name("lib/scene/ies", tests, NULL, NULL);
}
