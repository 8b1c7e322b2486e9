/* The part of a scene that the cameras of other programs see. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "lib/image/scratch.h"
#include "scene/scene.h"
#include "tests/support.h"

#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, scratch_enter, scratch_leave)

static const double degrees = 180 / 3.14159265358979323846;

/* What was told last. */
static char told[512];

static void on_diagnostic(void *user, const rt_diagnostic *diagnostic)
{
    (void)user;
    if (diagnostic->severity == RT_SEVERITY_WARNING)
        snprintf(told, sizeof told, "%s", diagnostic->message);
}

static rt_camera camera_of(const char *name, const char *text, uint32_t width, uint32_t height)
{
    static const rt_load_options options = {.diagnostic = on_diagnostic};
    rt_scene *scene = NULL;
    rt_render_options settings;
    rt_error error;
    told[0] = '\0';
    scratch_write(name, text);
    expect_ok(rt_scene_load(&scene, name, &options, &error), &error);
    const rt_camera camera = scene->camera;
    rt_scene_get_options(scene, &settings);
    assert_true(settings.width == width && settings.height == height);
    rt_scene_destroy(scene);
    return camera;
}

static rt_camera mitsuba(const char *type, const char *sensor, const char *film, uint32_t width,
                         uint32_t height)
{
    char text[2048];
    snprintf(text, sizeof text,
             "<scene version='3.0.0'><sensor type='%s'>%s<film type='hdrfilm'>"
             "<integer name='width' value='120'/><integer name='height' value='80'/>%s</film>"
             "</sensor><shape type='sphere'/><emitter type='constant'/></scene>",
             type, sensor, film);
    return camera_of("a.xml", text, width, height);
}

#define FOV_40 "<float name='fov' value='40'/>"
#define CROP                                                                                       \
    "<integer name='crop_width' value='50'/><integer name='crop_height' value='40'/>"              \
    "<integer name='crop_offset_x' value='40'/><integer name='crop_offset_y' value='5'/>"

/* tan(fov/2) */
static double tangent(const rt_camera *camera)
{
    return tan(camera->fov / 2 / degrees);
}

static void expect_shift(const rt_camera *camera, double x, double y)
{
    assert_float_equal(camera->shift[0], x, 1e-6);
    assert_float_equal(camera->shift[1], y, 1e-6);
}

/* Its axis meets the film at (60, 40), of the window at (20, 35). */
static void windows_of_mitsuba_s_films_are_seen(void **state)
{
    (void)state;
    rt_camera camera = mitsuba("perspective", FOV_40, CROP, 50, 40);
    assert_float_equal(tangent(&camera), tan(20 / degrees) * 50 / 120, 1e-6);
    expect_shift(&camera, 0.5 - 20.0 / 50, 35.0 / 40 - 0.5);
    /* The angle is that of the whole film. */
    camera = mitsuba("perspective", FOV_40 "<string name='fov_axis' value='y'/>", CROP, 50, 40);
    assert_float_equal(tangent(&camera), tan(20 / degrees) * 120 / 80 * 50 / 120, 1e-6);
    camera = mitsuba("orthographic", "", CROP, 50, 40);
    assert_float_equal(camera.width, 2 * 50.0 / 120, 1e-6);
    expect_shift(&camera, 0.5 - 20.0 / 50, 35.0 / 40 - 0.5);
    assert_string_equal(told, "");
    camera = mitsuba("perspective", FOV_40, "<integer name='crop_width' value='121'/>", 120, 80);
    expect_shift(&camera, 0, 0);
    assert_non_null(strstr(told, "a crop window of 121 x 80 pixels at 0, 0 does not fit"));
}

static void principal_points_of_mitsuba_are_kept(void **state)
{
    static const char point[] = FOV_40 "<float name='principal_point_offset_x' value='0.1'/>"
                                       "<float name='principal_point_offset_y' value='-0.2'/>";
    (void)state;
    rt_camera camera = mitsuba("thinlens", point, "", 120, 80);
    expect_shift(&camera, 0.1, 0.2);
    assert_float_equal(camera.fov, 40, 1e-5);
    /* At (48, 56) of the film. */
    camera = mitsuba("perspective", point, CROP, 50, 40);
    expect_shift(&camera, 0.5 - 8.0 / 50, 51.0 / 40 - 0.5);
}

static void mirrored_sensors_of_mitsuba_are_mirrors(void **state)
{
    (void)state;
    rt_camera camera = mitsuba(
        "perspective", "<transform name='to_world'><scale x='-1'/></transform>", "", 120, 80);
    assert_true(camera.mirror);
    camera = mitsuba("perspective", "<transform name='to_world'><scale x='-1' y='-1'/></transform>",
                     "", 120, 80);
    assert_false(camera.mirror);
}

/* Wherever the integrator stands that hides them. */
static void hidden_emitters_of_mitsuba_are_hidden(void **state)
{
    static const char *const values[] = {"false", "true"};
    (void)state;
    for (int is_first = 0; is_first < 2; is_first++)
        for (int i = 0; i < 2; i++) {
            char integrator[200], text[700];
            snprintf(integrator, sizeof integrator,
                     "<integrator type='path'><boolean name='hide_emitters' value='%s'/>"
                     "</integrator>",
                     values[i]);
            snprintf(text, sizeof text,
                     "<scene version='3.0.0'>%s<sensor type='perspective'>" FOV_40
                     "<film type='hdrfilm'><integer name='width' value='120'/>"
                     "<integer name='height' value='80'/></film></sensor><shape type='sphere'/>"
                     "<emitter type='constant'/>%s</scene>",
                     is_first ? integrator : "", is_first ? "" : integrator);
            assert_int_equal(camera_of("a.xml", text, 120, 80).hide_emitters, i);
        }
}

static void focal_lengths_of_mitsuba_are_of_film_of_35_mm(void **state)
{
    static const struct {
        const char *sensor, *says;
        double millimetres;
    } cases[] = {{"<string name='focal_length' value='35mm'/>", "", 35},
                 {"", "", 50},
                 {"<string name='focal_length' value='35ft'/>", "'35ft' became 50 mm", 50}};
    (void)state;
    for (int i = 0; i < 3; i++) {
        const rt_camera camera = mitsuba("perspective", cases[i].sensor, "", 120, 80);
        /* The film of 120 x 80 has its shape. */
        assert_float_equal(tangent(&camera), 18 / cases[i].millimetres, 1e-6);
        assert_non_null(strstr(told, cases[i].says));
    }
}

static void sensors_that_differ_are_told(void **state)
{
    static const struct {
        const char *sensor, *says;
    } cases[] = {
        {FOV_40 "<string name='fov_axis' value='q'/>", "a fov_axis 'q' became x"},
        {FOV_40 "<string name='focal_length' value='35mm'/>",
         "focal_length is left out beside fov"},
        {"<transform name='to_world'><scale x='2'/></transform>",
         "scaled by 2 across and 1 upwards is taken as scaled by the former"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mitsuba("orthographic", "", "", 120, 80);
        assert_string_equal(told, "");
        mitsuba("perspective", cases[i].sensor, "", 120, 80);
        assert_non_null(strstr(told, cases[i].says));
    }
}

static rt_camera pbrt(const char *camera, const char *film, uint32_t width, uint32_t height)
{
    char text[1024];
    snprintf(text, sizeof text,
             "Camera \"perspective\" \"float fov\" 40 %s\n"
             "Film \"rgb\" \"integer xresolution\" 120 \"integer yresolution\" 80 %s\n"
             "WorldBegin\nLightSource \"infinite\"\nShape \"sphere\"\n",
             camera, film);
    return camera_of("a.pbrt", text, width, height);
}

static void windows_of_pbrt_s_films_are_seen(void **state)
{
    (void)state;
    rt_camera camera = pbrt("", "\"integer pixelbounds\" [40 90 5 45]", 50, 40);
    assert_float_equal(tangent(&camera), tan(20 / degrees) * 1.5 * 50 / 120, 1e-6);
    expect_shift(&camera, 0.5 - 20.0 / 50, 35.0 / 40 - 0.5);
    camera = pbrt("", "\"float cropwindow\" [0 0.5 0.5 1]", 60, 40);
    assert_float_equal(tangent(&camera), tan(20 / degrees) * 1.5 * 0.5, 1e-6);
    expect_shift(&camera, -0.5, -0.5);
    camera = pbrt("\"float screenwindow\" [-1.5 3 -0.5 2.5]", "", 120, 80);
    assert_float_equal(tangent(&camera), tan(20 / degrees) * 2.25, 1e-6);
    expect_shift(&camera, 0.75 / 4.5, 1 / 3.0);
    assert_string_equal(told, "");
    camera = pbrt("", "\"float cropwindow\" [0.5 1.5 0 1]", 120, 80);
    expect_shift(&camera, 0, 0);
    assert_non_null(strstr(told, "cropwindow is not within the film"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_SCRATCH(windows_of_mitsuba_s_films_are_seen),
        IN_SCRATCH(principal_points_of_mitsuba_are_kept),
        IN_SCRATCH(mirrored_sensors_of_mitsuba_are_mirrors),
        IN_SCRATCH(hidden_emitters_of_mitsuba_are_hidden),
        IN_SCRATCH(focal_lengths_of_mitsuba_are_of_film_of_35_mm),
        IN_SCRATCH(sensors_that_differ_are_told),
        IN_SCRATCH(windows_of_pbrt_s_films_are_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
