/* test_camera.c - cameras: where their rays start, where they go, and where they meet. */
#include "support.h"

#include <math.h>
#include <string.h>

#include "statistics.h"
#include "types.h"

#define PI 3.14159265358979323846

enum { n = 4096 };

/*
 * At (1, 2, 3), looking along +z, in focus at 5 m; the film's plane in focus is 4 m wide and 2 m
 * high.
 */
static rt_camera_data thin_lens(float aperture)
{
    return (rt_camera_data){.eye = {1, 2, 3},
                            .aperture = aperture,
                            .corner = {2, 1, 5},
                            .across = {-4, 0, 0},
                            .down = {0, -2, 0},
                            .lens_u = {-1, 0, 0},
                            .lens_v = {0, 1, 0},
                            .axis = {0, 0, 1},
                            .focal_distance = 5};
}

static float in[n][4];
static float rays[n][2][4];

static void make_rays_of(rt_camera_data camera)
{
    rt_scene_header header;
    uint32_t count = n;
    memset(&header, 0, sizeof header);
    header.camera = camera;
    for (int i = 0; i < n; i++) {
        in[i][0] = (float)(i % 16) / 15;
        in[i][1] = (float)(i / 16 % 16) / 15;
        /* Hammersley points: evenly over the lens. */
        uint32_t reversed = 0;
        for (int bit = 0; bit < 12; bit++)
            reversed |= ((uint32_t)i >> bit & 1u) << (11 - bit);
        in[i][2] = ((float)i + 0.5f) / n;
        in[i][3] = ((float)reversed + 0.5f) / n;
    }
    cl_kernel kernel = test_kernel("camera", "rays");
    cl_mem scene = test_buffer(sizeof header, &header), given = test_buffer(sizeof in, in);
    cl_mem out = test_buffer(sizeof rays, NULL);
    rt_arg args[] = {RT_ARG(scene), RT_ARG(count), RT_ARG(given), RT_ARG(out)};
    test_run(kernel, args, 4, n);
    test_read(out, sizeof rays, rays);
    rt_buffer_release(test_device(), scene);
    rt_buffer_release(test_device(), given);
    rt_buffer_release(test_device(), out);
    rt_kernel_release(kernel);
}

static void make_rays(float aperture)
{
    make_rays_of(thin_lens(aperture));
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
    int inside = 0; /* half the radius, which is a quarter of the disc */
    (void)state;
    make_rays(0.25f);
    expect_to_meet_in_focus();
    for (int i = 0; i < n; i++) {
        double r = hypot(rays[i][0][0] - 1, rays[i][0][1] - 2);
        largest = r > largest ? r : largest;
        inside += r < 0.125;
        assert_true(rays[i][0][2] == 3);
    }
    assert_true(largest > 0.24 && largest <= 0.250001);
    assert_in_range(inside, n / 4 - 30, n / 4 + 30);
}

/* Film points 4 m across and 2 m down, about the eye; in focus at 5 m. */
static rt_camera_data parallel(float aperture)
{
    rt_camera_data camera = thin_lens(aperture);
    camera.kind = RT_CAMERA_KIND_ORTHOGRAPHIC;
    camera.corner[2] = 0;
    return camera;
}

static void orthographic_rays_are_parallel(void **state)
{
    (void)state;
    make_rays_of(parallel(0));
    expect_to_meet_in_focus();
    for (int i = 0; i < n; i++)
        assert_true(rays[i][1][0] == 0 && rays[i][1][1] == 0 && rays[i][1][2] == 1 &&
                    rays[i][0][2] == 3);
    make_rays_of(parallel(0.25f));
    expect_to_meet_in_focus();
    for (int i = 0; i < n; i++)
        assert_true(hypot(rays[i][0][0] - (3 - 4 * in[i][0]), rays[i][0][1] - (3 - 2 * in[i][1])) <=
                    0.250001);
}

/* Longitude to the right, latitude from the top down, the axis in the centre. */
static void environment_rays_go_everywhere(void **state)
{
    rt_camera_data camera = thin_lens(0.25f);
    (void)state;
    camera.kind = RT_CAMERA_KIND_ENVIRONMENT;
    make_rays_of(camera);
    for (int i = 0; i < n; i++) {
        double longitude = 2 * PI * (in[i][0] - 0.5), polar = PI * in[i][1];
        assert_true(rays[i][0][0] == 1 && rays[i][0][1] == 2 && rays[i][0][2] == 3);
        assert_float_equal(rays[i][1][0], -sin(polar) * sin(longitude), 2e-6);
        assert_float_equal(rays[i][1][1], cos(polar), 2e-6);
        assert_float_equal(rays[i][1][2], sin(polar) * cos(longitude), 2e-6);
    }
}

/*
 * In a wheel of `blades` edges, every triangle of the centre and an edge, and in it every part, has
 * its share.
 */
static void blades_make_an_even_polygon(void **state)
{
    static const uint32_t kinds[] = {3, 5, 6, 9};
    (void)state;
    for (int k = 0; k < 4; k++) {
        enum { rings = 8 };
        uint32_t blades = kinds[k], counts[9 * rings] = {0};
        double expected[9 * rings];
        rt_camera_data camera = thin_lens(0.25f);
        camera.blades = blades;
        camera.blade_rotation = 0.3f;
        make_rays_of(camera);
        for (int i = 0; i < n; i++) {
            double x = (1 - rays[i][0][0]) / 0.25, y = (rays[i][0][1] - 2) / 0.25;
            double turn = (atan2(y, x) - (double)0.3f) / (2 * PI),
                   wedge = (turn - floor(turn)) * blades;
            double off = (wedge - floor(wedge) - 0.5) * 2 * PI / blades;
            /* How far towards the edge, from 0 to 1. */
            double reach = hypot(x, y) * cos(off) / cos(PI / blades);
            assert_true(reach <= 1 + 1e-5);
            int ring = (int)fmin(rings - 1, reach * reach * rings);
            counts[(int)fmin(wedge, blades - 1) * rings + ring]++;
        }
        for (uint32_t i = 0; i < blades * rings; i++)
            expected[i] = (double)n / (blades * rings);
        /* Hammersley points lie more evenly than random ones. */
        assert_true(chance_of_counts(counts, expected, blades * rings) > 0.5);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pinhole_rays_leave_from_the_eye),
        cmocka_unit_test(lens_rays_leave_from_the_disc_and_meet_in_focus),
        cmocka_unit_test(orthographic_rays_are_parallel),
        cmocka_unit_test(environment_rays_go_everywhere),
        cmocka_unit_test(blades_make_an_even_polygon),
    };
    return cmocka_run_group_tests_name("kernels/camera", tests, NULL, NULL);
}
