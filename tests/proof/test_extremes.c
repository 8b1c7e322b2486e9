/*
 * test_extremes.c - what sizes, numbers and shapes can be at their limits, where the light is still
 * known: an integrating sphere shows the same radiance whatever its size and place, where the power
 * grows with its area; in a closed body whose walls emit L and reflect a, the radiance is
 * L / (1 - a), whatever its triangles; in glass of index n under a uniform sky L, it is n^2 L; and
 * what no light reaches is black.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "lib/image/scratch.h"
#include "proof/proof.h"

static const double pi = 3.14159265358979323846;

static const rt_render_options path = {.width = 6, .height = 6, .spp = 8, .max_depth = 40};
static const rt_render_options map = {.width = 6,
                                      .height = 6,
                                      .spp = 2,
                                      .mode = RT_MODE_PHOTON,
                                      .max_depth = 40,
                                      .photons = 5000,
                                      .k = 40};

static const rt_render_options both_ends = {.width = 6,
                                            .height = 6,
                                            .spp = 32,
                                            .mode = RT_MODE_VCM,
                                            .techniques = RT_TECHNIQUES_BPT,
                                            .max_depth = 40};

/* An integrating sphere of radius r around (x, 0, 0) and albedo 1/2 that shows the radiance. */
static void expect_sphere(double r, double x, double radiance)
{
    const char *text = proof_text(
        "let r = %.9g\nlet x = %.9g\nmaterial wall { kd 0.5 }\n"
        "sphere { centre x 0 0  radius r  material wall }\n"
        "light point { position x 0 0  power %.9g }\n"
        "camera { eye (x + 0.3*r) (0.2*r) (-0.1*r)  look_at (x - 0.2*r) (0.1*r) r  fov 90 }\n",
        r, x, radiance * 4 * pi * pi * r * r);
    const char *name = proof_text("sphere of radius %g m at x = %g m, radiance %g", r, x, radiance);
    proof_radiance((proof_row){name, "path", "a/(1 - a) P/(2 pi r)^2"}, radiance, text, &path);
    proof_radiance((proof_row){name, "vcm bpt", "a/(1 - a) P/(2 pi r)^2"}, radiance, text,
                   &both_ends);
    /* The k nearest photons leave out a part of the wall that is the same for all sizes. */
    proof_films films;
    proof_render(&films, text, &map);
    proof_values values = proof_mean(&films, 1);
    for (int i = 0; i < proof_renders; i++)
        assert_true(fabs(values.of[i] / radiance - 1) < 0.1);
    proof_free(&films);
}

static void spheres_of_all_sizes(void **state)
{
    (void)state;
    expect_sphere(1e-15, 0, 1);
    expect_sphere(1e-6, 0, 1);
    expect_sphere(1e6, 0, 1);
    expect_sphere(5e14, 0, 1e-4);
}

/* A parallelogram and a triangle side by side under a light at a height of s. */
static void expect_floor(double s)
{
    const char *text =
        proof_text("let s = %.9g\nmaterial floor { kd 0.5 }\n"
                   "quad { corner (-s) 0 (-s)  edge1 0 0 (2*s)  edge2 s 0 0  material floor }\n"
                   "triangle { a 0 0 (-3*s)  b 0 0 (3*s)  c (3*s) 0 0  material floor }\n"
                   "light point { position 0 s 0  intensity (s*s) }\n"
                   "camera { projection orthographic  eye 0 s 0  look_at 0 0 0  up 0 0 1  width "
                   "(0.0011*s) }\n",
                   s);
    const char *name = proof_text("floor under a light at a height of %g m", s);
    proof_radiance((proof_row){name, "path", "kd/pi I/h^2"}, 0.5 / pi, text, &path);
    proof_radiance((proof_row){name, "vcm bpt", "kd/pi I/h^2"}, 0.5 / pi, text, &both_ends);
}

static void floors_of_all_sizes(void **state)
{
    (void)state;
    expect_floor(1e-12);
    expect_floor(1e-6);
    expect_floor(1e6);
    expect_floor(1e12);
}

static void spheres_of_all_powers(void **state)
{
    (void)state;
    expect_sphere(1, 0, 1e-28);
    expect_sphere(1, 0, 1e26);
}

/* There, numbers of single precision are 1 m apart. */
static void a_sphere_far_from_the_origin(void **state)
{
    (void)state;
    expect_sphere(1e5, 1e7, 1);
}

/* A cube, each side of two triangles and of two that are a million times as long as wide. */
static void write_cube_of_slivers(void)
{
    static const char *const sides[] = {"1 5 6 2", "3 4 8 7", "1 3 7 5",
                                        "2 6 8 4", "1 2 4 3", "5 7 8 6"};
    char text[4096] = "";
    size_t used = 0;
    for (int i = 0; i < 8; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "v %d %d %d\n", i & 1 ? 1 : -1,
                                 i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    int vertices = 8;
    for (int i = 0; i < 6; i++) {
        int a, b, c, d;
        float p[4][3];
        assert_int_equal(sscanf(sides[i], "%d %d %d %d", &a, &b, &c, &d), 4);
        const int corners[4] = {a - 1, b - 1, c - 1, d - 1};
        for (int k = 0; k < 4; k++)
            for (int axis = 0; axis < 3; axis++)
                p[k][axis] = corners[k] & (1 << axis) ? 1 : -1;
        /* Two points 2e-6 from corners a and d, on the way to b and c. */
        for (int k = 0; k < 2; k++) {
            const float *from = p[k ? 3 : 0], *to = p[k ? 2 : 1];
            used += (size_t)snprintf(text + used, sizeof text - used, "v %.9g %.9g %.9g\n",
                                     from[0] + 1e-6f * (to[0] - from[0]),
                                     from[1] + 1e-6f * (to[1] - from[1]),
                                     from[2] + 1e-6f * (to[2] - from[2]));
        }
        int e = vertices + 1, f = vertices + 2;
        vertices += 2;
        used += (size_t)snprintf(text + used, sizeof text - used,
                                 "f %d %d %d\nf %d %d %d\nf %d %d %d\nf %d %d %d\n", a, e, f, a, f,
                                 d, e, b, c, e, c, f);
    }
    assert_true(used < sizeof text);
    scratch_write("slivers.obj", text);
}

static void a_furnace_of_slivers(void **state)
{
    (void)state;
    write_cube_of_slivers();
    proof_radiance((proof_row){"cube with slivers of 1 : 10^6", "path", "L/(1 - a)"}, 2,
                   "material wall { kd 0.5 }\n"
                   "model { file \"slivers.obj\"  material wall  radiance 1 }\n"
                   "camera { eye 0.3 0.2 -0.1  look_at -0.2 0.1 1  fov 90 }\n",
                   &path);
}

/* From there no ray is reflected totally, and none is caught in the ball. */
static void a_camera_in_glass(void **state)
{
    (void)state;
    proof_radiance((proof_row){"in a glass ball under a uniform sky", "path", "n^2 L"}, 2.25,
                   "material glass { kt 1  ior 1.5  fresnel dielectric }\n"
                   "sphere { centre 0 0 0  radius 1  material glass }\n"
                   "light environment { radiance 1 }\n"
                   "camera { eye 0.3 0.2 -0.1  look_at -0.2 0.1 1  fov 90 }\n",
                   &path);
}

/* ---- A pinhole ------------------------------------------------------------------------------- */

#define PINHOLE                                                                                    \
    "material white { kd 0.6 }\nmaterial black { kd 0 }\n"                                         \
    "light point { position 0 0 -1  intensity 3 }\n"                                               \
    "quad { corner -5 -5 1  edge1 10 0 0  edge2 0 10 0  material white }\n"                        \
    "quad { corner -5 -5 0  edge1 4.999 0 0  edge2 0 10 0  material black }\n"                     \
    "quad { corner 0.001 -5 0  edge1 4.999 0 0  edge2 0 10 0  material black }\n"                  \
    "quad { corner -0.001 -5 0  edge1 0.002 0 0  edge2 0 4.999 0  material black }\n"              \
    "quad { corner -0.001 0.001 0  edge1 0.002 0 0  edge2 0 4.999 0  material black }\n"

/* Looks from z = 0.5 at a square of the wall around x. */
#define LOOK_AT(x, width)                                                                          \
    "camera { projection orthographic  eye " x " 0 0.5  look_at " x " 0 1  width " width " }\n"

static void expect_black(const char *text, const rt_render_options *options)
{
    proof_films films;
    proof_render(&films, text, options);
    for (int i = 0; i < proof_renders; i++)
        for (uint32_t j = 0; j < 3 * films.width * films.height; j++)
            assert_true(films.rgb[i][j] == 0.0f);
    proof_free(&films);
}

static void all_light_through_a_pinhole(void **state)
{
    (void)state;
    proof_radiance((proof_row){"wall behind a pinhole of 2 mm", "path", "kd/pi I/d^2"},
                   0.6 / pi * 3 / 4, PINHOLE LOOK_AT("0", "0.00001"), &path);
    expect_black(PINHOLE LOOK_AT("0.01", "0.001"), &path);
}

static void lights_without_power_are_black(void **state)
{
    static const char *const lights[] = {"light point { position 0 1 0  intensity 0 }\n",
                                         "light environment { radiance 0 }\n",
                                         "quad { corner 0 2 0  edge1 1 0 0  edge2 0 0 1  "
                                         "material white  radiance 0 }\n"};
    (void)state;
    for (size_t i = 0; i < sizeof lights / sizeof *lights; i++) {
        const char *text =
            proof_text("material white { kd 0.6 }\n%s"
                       "quad { corner -5 0 -5  edge1 10 0 0  edge2 0 0 10  material white }\n"
                       "camera { eye 0 1 -3  look_at 0 0 0  fov 40 }\n",
                       lights[i]);
        expect_black(text, &path);
        expect_black(text, &map);
    }
}

static void the_page_has_the_rows(void **state)
{
    (void)state;
    proof_page("Extremes of size, place, power and shape");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spheres_of_all_sizes),
        cmocka_unit_test(floors_of_all_sizes),
        cmocka_unit_test(spheres_of_all_powers),
        cmocka_unit_test(a_sphere_far_from_the_origin),
        cmocka_unit_test_setup_teardown(a_furnace_of_slivers, scratch_enter, scratch_leave),
        cmocka_unit_test(a_camera_in_glass),
        cmocka_unit_test(all_light_through_a_pinhole),
        cmocka_unit_test(lights_without_power_are_black),
        cmocka_unit_test(the_page_has_the_rows),
    };
    return cmocka_run_group_tests_name("proof/extremes", tests, NULL, NULL);
}
