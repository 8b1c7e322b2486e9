/* test_camera.c - the thin lens: where its rays start, and where they meet. */
#include "support.h"

#include <math.h>
#include <string.h>

#include "types.h"

enum { n = 4096 };

/* At (1, 2, 3), looking along +z, in focus at 5 m; the film's plane in focus is 4 m wide and 2 m high. */
static rt_scene_header header_with_camera(float aperture)
{
    rt_scene_header header;
    memset(&header, 0, sizeof header);
    header.camera = (rt_camera_data){.eye = {1, 2, 3}, .aperture = aperture, .corner = {2, 1, 5}, .across = {-4, 0, 0},
                                     .down = {0, -2, 0}, .lens_u = {-1, 0, 0}, .lens_v = {0, 1, 0}};
    return header;
}

static float in[n][4];
static float rays[n][2][4];

static void make_rays(float aperture)
{
    rt_scene_header header = header_with_camera(aperture);
    uint32_t count = n;
    for (int i = 0; i < n; i++) {
        in[i][0] = (float)(i % 16) / 15;
        in[i][1] = (float)(i / 16 % 16) / 15;
        in[i][2] = ((float)(i % 7) + 0.5f) / 7;
        in[i][3] = ((float)(i % 61) + 0.5f) / 61;
    }
    cl_kernel kernel = test_kernel("camera", "rays");
    cl_mem scene = test_buffer(sizeof header, &header), given = test_buffer(sizeof in, in);
    cl_mem out = test_buffer(sizeof rays, NULL);
    rt_arg args[] = {RT_ARG(scene), RT_ARG(count), RT_ARG(given), RT_ARG(out)};
    test_run(kernel, args, 4, n);
    test_read(out, sizeof rays, rays);
    rt_buffer_release(scene);
    rt_buffer_release(given);
    rt_buffer_release(out);
    rt_kernel_release(kernel);
}

/* Every ray is of unit direction and passes through its film point in the plane in focus. */
static void expect_to_meet_in_focus(void)
{
    for (int i = 0; i < n; i++) {
        const float *o = rays[i][0], *d = rays[i][1];
        double t = (8 - o[2]) / d[2];
        assert_float_equal(d[0] * d[0] + d[1] * d[1] + d[2] * d[2], 1, 1e-6);
        assert_float_equal(o[0] + t * d[0], 3 - 4 * in[i][0], 5e-6);
        assert_float_equal(o[1] + t * d[1], 3 - 2 * in[i][1], 5e-6);
        assert_true(o[3] == 0 && isinf(d[3]));
    }
}

static void pinhole_rays_leave_from_the_eye(void **state)
{
    (void)state;
    make_rays(0);
    expect_to_meet_in_focus();
    for (int i = 0; i < n; i++)
        assert_true(rays[i][0][0] == 1 && rays[i][0][1] == 2 && rays[i][0][2] == 3);
}

static void lens_rays_leave_from_the_disc_and_meet_in_focus(void **state)
{
    double largest = 0;
    (void)state;
    make_rays(0.25f);
    expect_to_meet_in_focus();
    for (int i = 0; i < n; i++) {
        double r = hypot(rays[i][0][0] - 1, rays[i][0][1] - 2);
        largest = r > largest ? r : largest;
        assert_true(rays[i][0][2] == 3);
    }
    assert_true(largest > 0.24 && largest <= 0.250001);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pinhole_rays_leave_from_the_eye),
        cmocka_unit_test(lens_rays_leave_from_the_disc_and_meet_in_focus),
    };
    return cmocka_run_group_tests_name("kernels/camera", tests, NULL, NULL);
}
