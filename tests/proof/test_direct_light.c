/*
 * test_direct_light.c - the light of one emitter on a white floor, whose radiance is its irradiance
 * over pi.
 *
 * The camera looks straight down on a square of the floor. The expected value is the mean of the
 * closed form over that square; for a photon map it is smoothed by the density kernel too, so that
 * no bias is left.
 *
 * References:
 *   Lambert: "Photometria", 1760 (polygons).
 *   Snyder: "Radiation View Factor from an Arbitrarily Oriented Differential Surface to a Sphere",
 *     1969.
 *   Howell: "A Catalog of Radiation Heat Transfer Configuration Factors" (discs).
 */
#include <math.h>

#include "proof/proof.h"

#define PI 3.14159265358979323846
static const double pi = PI;

/* Irradiance at the point (x, 0, z) of the floor. */
typedef double irradiance(double x, double z);

static const double side = 1;      /* of the square that the camera sees, m */
static const double radius = 0.15; /* of the gather discs, m */

/*
 * Wide enough for gather discs at the edge of the square. The lights are above the camera or beside
 * its view.
 */
#define FLOOR                                                                                      \
    "camera { projection orthographic  eye 0 0.4 0  look_at 0 0 0  up 0 0 -1  width 1 }\n"         \
    "material white { kd 1 }\nmaterial black { }\n"                                                \
    "quad { corner -1 0 1  edge1 2 0 0  edge2 0 0 -2  material white }\n"

static const rt_render_options path = {.width = 16, .height = 16, .spp = 16};
static const rt_render_options direct = {
    .width = 16, .height = 16, .spp = 16, .mode = RT_MODE_DIRECT};
static const rt_render_options map = {.width = 16,
                                      .height = 16,
                                      .spp = 4,
                                      .mode = RT_MODE_PHOTON,
                                      .direct = RT_DIRECT_PHOTONS,
                                      .photons = 50000,
                                      .k = RT_K_ALL,
                                      .radius = 0.15f,
                                      .max_depth = 3};

/* By Gauss's rule of three points in each cell of a grid. */
static double mean_of_square(irradiance *e)
{
    enum { cells = 8 };
    static const double at[3] = {0.1127016653792583, 0.5, 0.8872983346207417},
                        weight[3] = {5 / 18.0, 8 / 18.0, 5 / 18.0};
    double sum = 0;
    for (int i = 0; i < 3 * cells; i++)
        for (int j = 0; j < 3 * cells; j++)
            sum += weight[i % 3] * weight[j % 3] *
                   e(side * ((i / 3 + at[i % 3]) / cells - 0.5),
                     side * ((j / 3 + at[j % 3]) / cells - 0.5));
    return sum / (cells * cells);
}

/*
 * The mean about a point by the Epanechnikov kernel 2 (1 - t^2) / (pi r^2), t = d/r: 2 t^2 - t^4 of
 * it is within t.
 */
static irradiance *sharp;
static double smoothed(double x, double z)
{
    enum { rings = 24, spokes = 12 };
    double sum = 0;
    for (int i = 0; i < rings; i++) {
        double d = radius * sqrt(1 - sqrt(1 - (i + 0.5) / rings));
        for (int j = 0; j < spokes; j++)
            sum += sharp(x + d * cos(2 * pi * (j + 0.5) / spokes),
                         z + d * sin(2 * pi * (j + 0.5) / spokes));
    }
    return sum / (rings * spokes);
}

static void expect_by_paths(const char *scene, const char *formula, irradiance *e,
                            const char *light)
{
    const char *text = proof_text(FLOOR "%s", light);
    proof_radiance((proof_row){scene, "path", formula}, mean_of_square(e) / pi, text, &path);
    proof_radiance((proof_row){scene, "direct", formula}, mean_of_square(e) / pi, text, &direct);
}

/* By path tracing, by direct light alone, and all from the photon map. */
static void expect_irradiance(const char *scene, const char *formula, irradiance *e,
                              const char *light)
{
    expect_by_paths(scene, formula, e, light);
    sharp = e;
    proof_radiance((proof_row){scene, "photons", formula}, mean_of_square(smoothed) / pi,
                   proof_text(FLOOR "%s", light), &map);
}

/* ---- Delta lights ----------------------------------------------------------------- */

/* 3 W/sr at (0.2, 1, 0.1). */
static double of_point(double x, double z)
{
    double d = sqrt((x - 0.2) * (x - 0.2) + 1 + (z - 0.1) * (z - 0.1));
    return 3 / (d * d * d);
}

static void point_lights(void **state)
{
    (void)state;
    expect_irradiance("point light of an intensity", "I cos / (pi d^2)", of_point,
                      "light point { position 0.2 1 0.1  intensity 3 }");
    expect_irradiance("point light of a power", "P cos / (2 pi d)^2", of_point,
                      "light point { position 0.2 1 0.1  power (12 * pi) }");
}

static double of_point_in_the_middle(double x, double z)
{
    return of_point(x + 0.2, z + 0.1);
}

static double none(double x, double z)
{
    (void)x, (void)z;
    return 0;
}

/*
 * A disc of 0.3 m has a shadow of 0.75 m, which covers the square; through a hole as wide, the
 * light covers it.
 */
static void shadows(void **state)
{
    (void)state;
    expect_by_paths("point light behind a disc", "0 in its shadow", none,
                    "light point { position 0 1 0  intensity 3 }\n"
                    "disc { centre 0 0.6 0  normal 0 1 0  radius 0.3  material black }");
    expect_by_paths(
        "point light behind a hole", "I cos / (pi d^2)", of_point_in_the_middle,
        "light point { position 0 1 0  intensity 3 }\n"
        "disc { centre 0 0.6 0  normal 0 1 0  radius 1  inner_radius 0.3  material black }");
}

/* Full up to 40 degrees, ending at 60; the corners of the square are at 44 degrees and more. */
static double of_spot(double x, double z)
{
    double d = sqrt(x * x + 0.7 * 0.7 + z * z), lo = cos(pi / 3), hi = cos(pi / 4.5),
           t = (0.7 / d - lo) / (hi - lo);
    return 3 * 0.7 / (d * d * d) * (t > 1 ? 1 : t < 0 ? 0 : t * t * (3 - 2 * t));
}

/* Falling from the axis. */
static double of_linear_spot(double x, double z)
{
    double d = sqrt(x * x + 0.7 * 0.7 + z * z), t = 1 - acos(0.7 / d) / (pi / 3);
    return 3 * 0.7 / (d * d * d) * (t < 0 ? 0 : t);
}

static double of_sun(double x, double z)
{
    (void)x, (void)z;
    return 3 * 2 / sqrt(6);
}

static double of_sky(double x, double z)
{
    (void)x, (void)z;
    return 2 * pi;
}

static void spots_suns_and_skies(void **state)
{
    (void)state;
    expect_irradiance(
        "spot light", "I cos smooth(cos) / (pi d^2)", of_spot,
        "light spot { position 0 0.7 0  target 0 0 0  intensity 3  inner 40  outer 60 }");
    expect_irradiance("linear spot light", "I cos (1 - a / outer) / (pi d^2)", of_linear_spot,
                      "light spot { position 0 0.7 0  target 0 0 0  intensity 3  inner 0  "
                      "outer 60  falloff linear }");
    expect_irradiance("directional light", "E cos / pi", of_sun,
                      "light directional { direction 1 -2 1  irradiance 3 }");
    expect_irradiance("uniform environment", "L", of_sky, "light environment { radiance 2 }");
}

/* ---- Polygons --------------------------------------------------------------------- */

typedef double corner[3];

/*
 * Lambert: E = L/2 |sum of angle times (unit normal of the plane through the edge and the point) .
 * n|, for polygons above the horizon.
 */
static double of_polygon(double radiance, const corner *corners, int count, double x, double z)
{
    double sum = 0;
    for (int i = 0; i < count; i++) {
        const double *p = corners[i], *q = corners[(i + 1) % count];
        double a[3] = {p[0] - x, p[1], p[2] - z}, b[3] = {q[0] - x, q[1], q[2] - z};
        double c[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                       a[0] * b[1] - a[1] * b[0]};
        double length = sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
        if (length > 0)
            sum += atan2(length, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) * c[1] / length;
    }
    return 0.5 * radiance * fabs(sum);
}

static double of_rectangle(double x, double z)
{
    static const corner corners[] = {
        {-0.3, 0.8, -0.2}, {0.5, 0.8, -0.2}, {0.5, 0.8, 0.4}, {-0.3, 0.8, 0.4}};
    return of_polygon(5, corners, 4, x, z);
}

static double of_wall(double x, double z)
{
    static const corner corners[] = {
        {0.9, 0, -0.5}, {0.9, 0, 0.5}, {0.9, 0.8, 0.5}, {0.9, 0.8, -0.5}};
    return of_polygon(5, corners, 4, x, z);
}

static double of_parallelogram(double x, double z)
{
    static const corner corners[] = {
        {-0.3, 0.6, -0.2}, {0.4, 0.8, -0.2}, {0.6, 1.1, 0.4}, {-0.1, 0.9, 0.4}};
    return of_polygon(5, corners, 4, x, z);
}

static double of_triangle(double x, double z)
{
    static const corner corners[] = {{-0.3, 0.6, -0.2}, {0.4, 0.8, -0.2}, {-0.1, 0.9, 0.4}};
    return of_polygon(5, corners, 3, x, z);
}

static void polygons(void **state)
{
    (void)state;
    expect_irradiance(
        "rectangle above, a ceiling behind it", "form factor (Lambert)", of_rectangle,
        "quad { corner -0.3 0.8 -0.2  edge1 0.8 0 0  edge2 0 0 0.6  material black  radiance 5 }\n"
        "quad { corner -1 0.801 -1  edge1 2 0 0  edge2 0 0 2  material black }");
    expect_irradiance(
        "rectangle in a wall", "form factor (Lambert)", of_wall,
        "quad { corner 0.9 0 -0.5  edge1 0 0 1  edge2 0 0.8 0  material black  radiance 5 }");
    expect_irradiance("parallelogram, tilted", "form factor (Lambert)", of_parallelogram,
                      "quad { corner -0.3 0.6 -0.2  edge1 0.7 0.2 0  edge2 0.2 0.3 0.6  material "
                      "black  radiance 5 }");
    expect_irradiance(
        "triangle, tilted", "form factor (Lambert)", of_triangle,
        "triangle { a -0.3 0.6 -0.2  b 0.4 0.8 -0.2  c -0.1 0.9 0.4  material black  radiance 5 }");
}

/* ---- Round area lights ------------------------------------------------------------------ */

/* Radiance 5 of a ball; Snyder's factor where the horizon cuts it. */
static double of_ball(double cx, double cy, double r, double x, double z)
{
    double d = sqrt((x - cx) * (x - cx) + cy * cy + z * z), h = d / r, c = cy / d,
           s = sqrt(1 - c * c), k = sqrt(h * h - 1);
    if (c * h >= 1)
        return 5 * pi * c / (h * h);
    if (c * h <= -1)
        return 0;
    return 5 * pi *
           (0.5 - asin(k / (h * s)) / pi +
            (c * acos(-k * c / s) - k * sqrt(1 - h * h * c * c)) / (pi * h * h));
}

static double of_sphere(double x, double z)
{
    return of_ball(0.2, 0.8, 0.3, x, z);
}

static double of_sunken_sphere(double x, double z)
{
    return of_ball(0.95, 0.1, 0.28, x, z);
}

/* Howell's factor of a disc of radius r at height h, seen from a point that is a aside. */
static double of_round(double r, double h, double a)
{
    double sum = h * h + a * a + r * r;
    return 5 * pi * 0.5 * (1 - (sum - 2 * r * r) / sqrt(sum * sum - 4 * r * r * a * a));
}

static double of_disc(double x, double z)
{
    return of_round(0.4, 0.7, hypot(x - 0.2, z));
}

static double of_ring(double x, double z)
{
    return of_disc(x, z) - of_round(0.25, 0.7, hypot(x - 0.2, z));
}

static void round_lights(void **state)
{
    (void)state;
    expect_irradiance("sphere", "L cos (r/d)^2", of_sphere,
                      "sphere { centre 0.2 0.8 0  radius 0.3  material black  radiance 5 }");
    expect_irradiance("sphere cut by the horizon", "form factor (Snyder)", of_sunken_sphere,
                      "sphere { centre 0.95 0.1 0  radius 0.28  material black  radiance 5 }");
    expect_irradiance(
        "disc above", "form factor (Howell)", of_disc,
        "disc { centre 0.2 0.7 0  normal 0 -1 0  radius 0.4  material black  radiance 5 }");
    expect_irradiance("ring above", "form factor (Howell)", of_ring,
                      "disc { centre 0.2 0.7 0  normal 0 -1 0  radius 0.4  inner_radius 0.25  "
                      "material black  radiance 5 }");
}

/* ---- More than one, and their power -------------------------------------------------- */

/* None shades another. */
static double of_three(double x, double z)
{
    return of_wall(x, z) + of_ball(-0.88, 0.3, 0.18, x, z) + 0.1 * of_point(x, z);
}

static void lights_add_up(void **state)
{
    (void)state;
    expect_irradiance(
        "rectangle, sphere and point", "sum of the three", of_three,
        "quad { corner 0.9 0 -0.5  edge1 0 0 1  edge2 0 0.8 0  material black  radiance 5 }\n"
        "sphere { centre -0.88 0.3 0  radius 0.18  material black  radiance 5 }\n"
        "light point { position 0.2 1 0.1  intensity 0.3 }\n");
}

/* The camera looks at the area light itself, whose outside has the same radiance everywhere. */
static void power_is_pi_times_area_times_radiance(void **state)
{
    static const struct {
        const char *name, *law, *shape;
        double area_by_pi;
    } lights[] = {
        {"parallelogram", "P / (pi area)", "quad { corner -1 0 -1  edge1 0 0 2  edge2 2 0 1",
         4 / PI},
        {"triangle", "P / (pi area)", "triangle { a -1 0 -1  b 0 0 2  c 2 0 -1", 4.5 / PI},
        {"ring", "P / (pi^2 (R^2 - r^2))",
         "disc { centre 0.5 0 0  normal 0 1 0  radius 1  inner_radius 0.4", 0.84},
        {"sphere", "P / (2 pi r)^2", "sphere { centre 0 0 0  radius 0.6", 4 * 0.36},
        /* a = 1/2, c = 1, e^2 = 1 - a^2/c^2 = 3/4, asin e = pi/3 */
        {"long spheroid by transform", "P / (2 pi^2 a^2 (1 + c/(a e) asin e))",
         "sphere { centre 0 0 0  radius 1  scale 0.5 1 0.5",
         0.5 * (1 + 4 * PI / (3 * 1.73205080756887729))},
        {"cylinder with caps", "P / (2 pi^2 r (r + h))",
         "cylinder { a 0 -1 0  b 0 0.5 0  radius 0.5", 2 * 0.5 * 2},
        {"cone without caps", "P / (pi^2 r s)",
         "cone { base 0 -1 0  apex 0 0.5 0  radius 0.5  caps false", 0.5 * 1.58113883008418967},
        {"torus", "P / (4 pi^3 R r)",
         "torus { centre -0.6 0 0  axis 0 1 0  major_radius 0.6  minor_radius 0.2",
         4 * PI * 0.6 * 0.2},
    };
    (void)state;
    for (size_t i = 0; i < sizeof lights / sizeof *lights; i++) {
        const char *text = proof_text(
            "camera { projection orthographic  eye 0 3 0  look_at 0 0 0  up 0 0 -1  width 0.1 }\n"
            "material black { }\n%s  material black  power 7 }",
            lights[i].shape);
        proof_radiance(
            (proof_row){proof_text("%s of a power", lights[i].name), "path", lights[i].law},
            7 / (pi * pi * lights[i].area_by_pi), text, &path);
    }
}

static void the_page_has_the_rows(void **state)
{
    (void)state;
    proof_page("Direct light");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(point_lights),
        cmocka_unit_test(shadows),
        cmocka_unit_test(spots_suns_and_skies),
        cmocka_unit_test(polygons),
        cmocka_unit_test(round_lights),
        cmocka_unit_test(lights_add_up),
        cmocka_unit_test(power_is_pi_times_area_times_radiance),
        cmocka_unit_test(the_page_has_the_rows),
    };
    return cmocka_run_group_tests_name("proof/direct_light", tests, NULL, NULL);
}
