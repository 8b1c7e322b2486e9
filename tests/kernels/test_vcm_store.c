/*
 * test_vcm_store.c - what the store of light vertices packs: directions as good as floats have
 * them, on the side of the surface on which they were, numbers rounded to nearest, so that their
 * mean stays, and colours by their place.
 */
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render/renderer.h"
#include "types.h"

enum { n = 1 << 16 };

typedef float row[4];

static row in[2 * n], out[4 * n];

static uint32_t state_of_random = 1;

static double uniform(double low, double high)
{
    state_of_random = state_of_random * 1664525u + 1013904223u;
    return low + (high - low) * (state_of_random >> 8) * 0x1p-24;
}

static double dot3(const row a, const row b)
{
    return (double)a[0] * b[0] + (double)a[1] * b[1] + (double)a[2] * b[2];
}

static void random_direction(row w)
{
    const double z = uniform(-1, 1), turn = uniform(0, 6.28318530718), r = sqrt(1 - z * z);
    w[0] = (float)(r * cos(turn));
    w[1] = (float)(r * sin(turn));
    w[2] = (float)z;
}

static void run(const char *name, size_t rows_in, size_t rows_out, int has_stores)
{
    uint32_t count = n;
    cl_kernel kernel = test_kernel("vcm_store", name);
    cl_mem given = test_buffer(rows_in * sizeof *in, in),
           stores = test_buffer(n * sizeof(rt_light_vertex), NULL),
           made = test_buffer(rows_out * sizeof *out, NULL);
    rt_arg args[4] = {RT_ARG(count), RT_ARG(given), RT_ARG(stores), RT_ARG(made)};
    if (!has_stores)
        args[2] = args[3];
    test_run(kernel, args, has_stores ? 4 : 3, n);
    test_read(made, rows_out * sizeof *out, out);
    rt_buffer_release(test_device(), given);
    rt_buffer_release(test_device(), stores);
    rt_buffer_release(test_device(), made);
    rt_kernel_release(kernel);
}

static void expect_direction(const row expected, const row found, double lifted)
{
    for (int c = 0; c < 3; c++)
        assert_float_equal(found[c], expected[c], 6e-7 + lifted);
    assert_float_equal(dot3(found, found), 1, lifted > 0 ? 5e-6 : 5e-7);
}

/* The normal of item i, and beside it a direction on its side, of most along the surface. */
static void make_directions(void)
{
    for (int i = 0; i < n; i++) {
        float *normal = in[2 * i], *wo = in[2 * i + 1];
        if (i < 6) {
            memset(normal, 0, sizeof(row));
            normal[i / 2] = i % 2 ? -1 : 1;
        } else {
            random_direction(normal);
        }
        random_direction(wo);
        double cosine = dot3(normal, wo), length = 0;
        const double to = exp(uniform(-20, 0)) - cosine;
        for (int c = 0; c < 3; c++)
            wo[c] = (float)(wo[c] + to * normal[c]);
        length = sqrt(dot3(wo, wo));
        for (int c = 0; c < 3; c++)
            wo[c] = (float)(wo[c] / length);
    }
}

static void directions_are_as_good_as_floats(void **state)
{
    (void)state;
    make_directions();
    run("directions", 2 * n, 3 * n, 1);
    for (int i = 0; i < n; i++) {
        /* wo is lifted off the surface to a cosine of 1e-6. */
        const double lifted = dot3(in[2 * i], in[2 * i + 1]) < 2e-6 ? 2.5e-6 : 0;
        expect_direction(in[2 * i], out[3 * i], 0);
        expect_direction(in[2 * i + 1], out[3 * i + 1], lifted);
        expect_direction(in[2 * i], out[3 * i + 2], 0);
        assert_true(out[3 * i + 2][3] == 1.0f);
        assert_true(i >= 6 || memcmp(in[2 * i], out[3 * i], 3 * sizeof(float)) == 0);
        assert_true(dot3(out[3 * i], out[3 * i + 1]) > 3e-7);
    }
}

/* Numbers over all magnitudes; x by steps of a few last places, so that all roundings occur. */
static void make_numbers(void)
{
    memset(in, 0, sizeof in);
    for (int i = 1; i < n; i++) {
        in[i][0] = (float)exp(uniform(-60, 60));
        in[i][1] = (float)uniform(1, 2);
        in[i][2] = (float)exp(uniform(-8, 8));
    }
    in[1][0] = INFINITY;
    in[2][0] = NAN;
    in[3][0] = 1e-42f;
}

static void numbers_are_rounded_to_nearest(void **state)
{
    double off = 0, off24 = 0;
    (void)state;
    make_numbers();
    run("numbers", n, 4 * n, 0);
    for (int i = 0; i < n; i++)
        assert_true(out[4 * i + 3][0] == 1.0f);
    assert_true(out[0][0] == 0 && out[0][1] == 0 && out[1][0] == 0 && out[2][0] == 0);
    assert_true(isinf(out[4][0]) && isinf(out[5][0]) && isnan(out[8][0]) && isnan(out[9][0]));
    assert_true(out[14][0] >= 1e-42f);
    for (int i = 4; i < n; i++) {
        for (int c = 0; c < 3; c++)
            assert_true(fabs(out[4 * i][c] / in[i][c] - 1) <= 0x1p-14);
        assert_true(fabs(out[4 * i + 1][0] / in[i][0] - 1) <= 0x1p-17);
        const double above = out[4 * i + 2][0] / in[i][0];
        assert_true(above >= 1 && above <= 1 + 0x1p-4);
        off += out[4 * i][1] / in[i][1] - 1;
        off24 += out[4 * i + 1][0] / in[i][0] - 1;
    }
    /* Roundings are uniform over a step of at most 2^-13, 2^-16: the means by 7 standard errors. */
    assert_float_equal(off / n, 0, 7 * 0x1p-13 / sqrt(12.0 * n));
    assert_float_equal(off24 / n, 0, 7 * 0x1p-16 / sqrt(12.0 * n));
}

/* A gradient on a ball, and on a mesh with texture coordinates and vertex colours, smooth. */
static rt_renderer *textured_renderer(void)
{
    static const char text[] =
        "texture fade { pattern gradient  a 0.1 0.5 0.9  b 0.9 0.3 0.2  wrap mirror  scale 3 5 }\n"
        "material faded { kd 0.8  kd_texture fade }\n"
        "sphere { centre -1.2 0 0  radius 1  material faded }\n";
    static const float positions[] = {0, -1, 0, 2, -1, 0, 2, 1, 0.5f, 0, 1, -0.5f},
                       normals[] = {0.3f, 0, 1, -0.3f, 0, 1, 0, 0.3f, 1, 0, -0.3f, 1},
                       uv[] = {0, 0, 1, 0, 1, 1, 0, 1},
                       colours[] = {1, 0.2f, 0.1f, 0.3f, 1, 0.5f, 0.2f, 0.4f, 1, 1, 1, 0.3f};
    static const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    const rt_material plain = {.kd = {0.8f, 0.8f, 0.8f}};
    const rt_texture fade = {.kind = RT_TEXTURE_GRADIENT,
                             .wrap = RT_WRAP_MIRROR,
                             .a = {0.1f, 0.9f, 0.4f},
                             .b = {0.9f, 0.2f, 1},
                             .scale = {4, 3}};
    const rt_mesh_data mesh = {.positions = positions,
                               .normals = normals,
                               .uv = uv,
                               .colours = colours,
                               .indices = indices,
                               .vertex_count = 4,
                               .triangle_count = 2};
    rt_scene *scene = NULL;
    rt_renderer *renderer = NULL;
    rt_surface surface;
    uint32_t handle;
    rt_error error;
    memset(&surface, 0, sizeof surface);
    expect_ok(rt_scene_parse(&scene, text, "test", NULL, &error), &error);
    expect_ok(rt_scene_add_material(scene, &surface.material, "plain", &plain, &error), &error);
    expect_ok(rt_scene_add_texture(scene, &surface.texture, &fade, &error), &error);
    expect_ok(rt_scene_add_mesh(scene, &handle, &mesh, &error), &error);
    expect_ok(rt_scene_add_instance(scene, NULL, handle, &surface, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    rt_scene_destroy(scene);
    return renderer;
}

/* Runs a kernel that shoots n rays of `in` into a scene. */
static void shoot(const rt_renderer *renderer, const char *name)
{
    uint32_t count = n;
    cl_kernel kernel = test_kernel("vcm_store", name);
    cl_mem given = test_buffer(sizeof in, in),
           stores = test_buffer(n * sizeof(rt_light_vertex), NULL),
           made = test_buffer(sizeof out, NULL);
    rt_arg args[] = {RT_ARG(count), RT_ARG(renderer->scene), RT_ARG(given), RT_ARG(stores),
                     RT_ARG(made)};
    test_run(kernel, args, 5, n);
    test_read(made, sizeof out, out);
    rt_buffer_release(test_device(), given);
    rt_buffer_release(test_device(), stores);
    rt_buffer_release(test_device(), made);
    rt_kernel_release(kernel);
}

static void colours_are_those_of_the_place(void **state)
{
    rt_renderer *renderer = textured_renderer();
    uint32_t met = 0;
    double least = 1, most = 0;
    (void)state;
    for (int i = 0; i < n; i++) {
        const row from = {(float)uniform(-2.2, 2), (float)uniform(-1, 1), 3, 0}, to = {0, 0, -1, 0};
        memcpy(in[2 * i], from, sizeof from);
        memcpy(in[2 * i + 1], to, sizeof to);
    }
    shoot(renderer, "colours");
    for (int i = 0; i < n; i++) {
        const float *kd = out[4 * i];
        met += kd[3] > 0;
        for (int c = 0; c < 3; c++)
            assert_float_equal(out[4 * i + 2][c], kd[c], 1e-4);
        if (kd[3] > 0) {
            expect_direction(out[4 * i + 1], out[4 * i + 3], 0);
            least = fmin(least, kd[0]);
            most = fmax(most, kd[0]);
        }
    }
    assert_true(met > n / 2 && least < 0.1 && most > 0.6);
    rt_renderer_destroy(renderer);
}

/* Shapes of all kinds of storage in a row along x, of a brushed material, with a texture. */
static const char brushed_shapes[] =
    "texture fade { pattern gradient  a 0.1 0.5 0.9  b 0.9 0.3 0.2  scale 3 5 }\n"
    "material plain { ks 0.8  roughness 0.2  roughness_v 0.5  anisotropy_rotation 25 }\n"
    "material faded { ks 0.8  ks_texture fade  roughness 0.4  roughness_v 0.1\n"
    "                 anisotropy_rotation -50 }\n"
    "sphere { centre -5 0 0  radius 1  material plain }\n"
    "sphere { centre -3 0 0  radius 1  material faded  rotate 1 1 0 40 }\n"
    "quad { corner -2 -1 0.2  edge1 2 0 0.3  edge2 0.5 2 0  material plain }\n"
    "quad { corner 0 -1 0.2  edge1 2 0 0.3  edge2 0.5 2 0  material faded }\n"
    "triangle { a 2 -1 0  b 4 -1 0.4  c 3 1 0.2  na 0 0.3 1  nb 0.3 0 1  nc 0 0 1\n"
    "           uva 0 0  uvb 1 0.3  uvc 0 1  material faded }\n"
    "box { centre 5 0 0  size 1.4 1.4 1.4  material faded  rotate 1 1 0 30 }\n"
    "cylinder { a 7 -1 0  b 7 1 0.3  radius 0.8  material plain }\n";

/* Seen from both sides, whichever of them is that of the normal. */
static void tangents_are_those_of_the_place(void **state)
{
    rt_renderer *renderer = test_renderer(brushed_shapes);
    uint32_t met = 0;
    (void)state;
    for (int i = 0; i < n; i++) {
        const float side = i % 2 ? -1 : 1;
        const row from = {(float)uniform(-6, 8), (float)uniform(-1, 1), i % 4 < 2 ? 3 * side : 0,
                          0},
                  to = {0, 0, -side, 0};
        memcpy(in[2 * i], from, sizeof from);
        memcpy(in[2 * i + 1], to, sizeof to);
    }
    shoot(renderer, "tangents");
    for (int i = 0; i < n; i++) {
        met += out[4 * i][3] > 0;
        assert_float_equal(out[4 * i][3] > 0 ? dot3(out[4 * i], out[4 * i]) : 1, 1, 1e-5);
        for (int c = 0; c < 4; c++) {
            assert_float_equal(out[4 * i + 2][c], out[4 * i][c], 2e-5);
            assert_float_equal(out[4 * i + 3][c], out[4 * i + 1][c], 2e-4);
        }
    }
    assert_true(met > n / 2);
    rt_renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(directions_are_as_good_as_floats),
                                       cmocka_unit_test(numbers_are_rounded_to_nearest),
                                       cmocka_unit_test(colours_are_those_of_the_place),
                                       cmocka_unit_test(tangents_are_those_of_the_place)};
    return cmocka_run_group_tests_name("kernels/vcm_store", tests, NULL, NULL);
}
