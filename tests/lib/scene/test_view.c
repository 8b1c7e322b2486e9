/* The rays of cameras, and what they may meet, where the picture is shifted or mirrored. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "scene/scene.h"
#include "scene/view.h"
#include "tests/support.h"

static const rt_camera plain = {.eye = {1, 2, 3},
                                .look_at = {2, 1, 7},
                                .up = {0.1f, 1, 0},
                                .fov = 50,
                                .width = 3,
                                .focal_distance = 4};

/* A point of the picture in the plane of the film. */
static void at(double out[3], const rt_camera_data *c, double x, double y)
{
    for (int i = 0; i < 3; i++)
        out[i] = (double)c->corner[i] + x * (double)c->across[i] + y * (double)c->down[i];
}

static void expect_point(const rt_camera_data *c, double x, double y, const rt_camera_data *other,
                         double other_x, double other_y)
{
    double a[3], b[3];
    at(a, c, x, y);
    at(b, other, other_x, other_y);
    for (int i = 0; i < 3; i++)
        assert_float_equal(a[i], b[i], 1e-5);
}

/* The picture's own axes move with it: right by its width, up by its height. */
static void a_shift_moves_the_picture(void **state)
{
    (void)state;
    for (int kind = RT_CAMERA_PERSPECTIVE; kind <= RT_CAMERA_ORTHOGRAPHIC; kind++) {
        rt_camera camera = plain;
        rt_camera_data still, moved;
        camera.kind = (rt_camera_kind)kind;
        rt_view_aim(&still, &camera, 30, 20);
        camera.shift[0] = 0.25f;
        camera.shift[1] = 0.5f;
        rt_view_aim(&moved, &camera, 30, 20);
        expect_point(&moved, 0, 0, &still, 0.25, -0.5);
        expect_point(&moved, 1, 1, &still, 1.25, 0.5);
        assert_memory_equal(moved.axis, still.axis, sizeof still.axis);
    }
}

static void a_mirror_exchanges_left_and_right(void **state)
{
    (void)state;
    for (int kind = RT_CAMERA_PERSPECTIVE; kind <= RT_CAMERA_ENVIRONMENT; kind++) {
        rt_camera camera = plain;
        rt_camera_data still, mirrored;
        camera.kind = (rt_camera_kind)kind;
        rt_view_aim(&still, &camera, 30, 20);
        camera.mirror = 1;
        rt_view_aim(&mirrored, &camera, 30, 20);
        for (int i = 0; i < 3; i++)
            assert_true(mirrored.lens_u[i] == -still.lens_u[i] &&
                        mirrored.lens_v[i] == still.lens_v[i]);
        if (kind != RT_CAMERA_ENVIRONMENT)
            expect_point(&mirrored, 0.25, 0.1, &still, 0.75, 0.1);
        camera.shift[0] = 0.25f;
        rt_view_aim(&mirrored, &camera, 30, 20);
        if (kind != RT_CAMERA_ENVIRONMENT)
            expect_point(&mirrored, 0, 0, &still, 0.75, 0);
    }
}

/* Small boxes all over the plane of the film: those of the picture are seen, others beyond not. */
static void shapes_are_seen_where_the_picture_is(void **state)
{
    (void)state;
    for (int k = 0; k < 16; k++) {
        rt_camera camera = plain;
        rt_camera_data data;
        camera.kind = k & 1 ? RT_CAMERA_ORTHOGRAPHIC : RT_CAMERA_PERSPECTIVE;
        camera.mirror = k >> 1 & 1;
        camera.shift[0] = k & 4 ? 0.75f : -0.25f;
        camera.shift[1] = k & 8 ? 2 : 0;
        rt_view_aim(&data, &camera, 30, 20);
        for (int y = -30; y <= 40; y++)
            for (int x = -30; x <= 40; x++) {
                double p[3];
                rt_scene_shape box = {.kind = RT_SHAPE_SPHERE};
                at(p, &data, 0.1 * x + 0.05, 0.1 * y + 0.05);
                for (int i = 0; i < 3; i++) {
                    /* Of parallel rays ahead of the film, which holds the eye. */
                    const double ahead = k & 1 ? (double)data.axis[i] : 0;
                    box.lo[i] = (float)(camera.eye[i] + p[i] + ahead - 1e-3);
                    box.hi[i] = (float)(camera.eye[i] + p[i] + ahead + 1e-3);
                }
                const int is_in = x >= 0 && x < 10 && y >= 0 && y < 10;
                assert_int_equal(rt_view_may_see(&data, NULL, &box), is_in);
            }
    }
}

static void a_shift_out_of_range_is_refused(void **state)
{
    static const float wrong[] = {1001, -INFINITY, NAN};
    rt_scene *scene = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_scene_create(&scene, &error), &error);
    for (int i = 0; i < 3; i++) {
        rt_camera camera = plain;
        camera.shift[i % 2] = wrong[i];
        assert_int_equal(rt_scene_set_camera(scene, &camera, &error), RT_ERROR_INPUT);
        assert_string_equal(error.field, "shift");
    }
    rt_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_shift_moves_the_picture),
        cmocka_unit_test(a_mirror_exchanges_left_and_right),
        cmocka_unit_test(shapes_are_seen_where_the_picture_is),
        cmocka_unit_test(a_shift_out_of_range_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
