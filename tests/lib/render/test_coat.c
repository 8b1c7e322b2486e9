/*
 * test_coat.c - coats in whole renders: light that a spot casts through one is that of the closed
 * form, a white furnace stays white, and paths, photons, vertex connection and merging agree.
 */
#include "support.h"

#include <math.h>

#include "kernels/statistics.h"
#include "lib/render/means.h"

#define PI 3.14159265358979323846

/* ---- A floor --------------------------------------------------------------------- */

/* Lit by a spot at 59 degrees, and seen from as far on the side, where no mirror shows it. */
#define FLOOR(more)                                                                                \
    "camera { eye 0 1.2 2  look_at 0 0 0  fov 2 }\n"                                               \
    "texture t { pattern constant  a 0.5 1 2 }\n"                                                  \
    "material m { kd 0.9 0.6 0.2  coat 0.8  coat_ior 1.6" more " }\n"                              \
    "quad { corner -9 0 -9  edge1 0 0 18  edge2 18 0 0  material m }\n"                            \
    "light spot { position 3 1.8 0  target 0 0 0  intensity 10  inner 6  outer 7 }\n"
static const char clear[] = FLOOR(""),
                  dyed[] = FLOOR("  coat_absorption 0.2 0.2 0.1  coat_absorption_texture t");

static double reflectance(double cosine, double m)
{
    const double sine2 = (1 - cosine * cosine) / (m * m);
    if (sine2 >= 1)
        return 1;
    const double beyond = sqrt(1 - sine2);
    const double s = (cosine - m * beyond) / (cosine + m * beyond),
                 p = (m * cosine - beyond) / (m * cosine + beyond);
    return (s * s + p * p) / 2;
}

/* The radiance at the middle: what the coat, of this optical depth, lets in and throws back. */
static double floor_radiance(double kd, double depth)
{
    enum { steps = 1 << 14 };
    const double m = 1.6, d2 = 3 * 3 + 1.8 * 1.8, cosine = 1.8 / sqrt(d2);
    const double passed = 1 - reflectance(cosine, m);
    double inner = 0;
    const double beyond = sqrt(1 - (1 - cosine * cosine) / (m * m)), left = exp(-depth / beyond);
    for (int i = 0; i < steps; i++) {
        const double u = sqrt((i + 0.5) / steps);
        inner += reflectance(u, 1 / m) * exp(-2 * depth / u) / steps;
    }
    const double below = passed * passed * left * left / (m * m * (1 - kd * inner));
    return kd / PI * (0.2 + 0.8 * below) * 10 / d2 * cosine;
}

static void expect_floor(rt_render_options options, double tolerance, const char *what)
{
    static const double kd[3] = {0.9, 0.6, 0.2}, depths[3] = {0.1, 0.2, 0.2};
    double of_clear[3], of_dyed[3];
    render_means(of_clear, clear, options);
    render_means(of_dyed, dyed, options);
    for (int c = 0; c < 3; c++) {
        const double exact = floor_radiance(kd[c], 0), left = floor_radiance(kd[c], depths[c]);
        expect_close(of_clear[c], exact, tolerance * exact, what);
        expect_close(of_dyed[c], left, tolerance * left, what);
    }
}

static void light_goes_through_a_coat_by_the_definition(void **state)
{
    rt_render_options map = {.mode = RT_MODE_PHOTON,
                             .spp = 4,
                             .photons = 400000,
                             .k = 200,
                             .direct = RT_DIRECT_PHOTONS,
                             .max_depth = 8};
    (void)state;
    expect_floor((rt_render_options){.spp = 16, .max_depth = 2}, 3e-3, "by paths");
    expect_floor((rt_render_options){.mode = RT_MODE_DIRECT, .spp = 16}, 3e-3, "in mode direct");
    expect_floor((rt_render_options){.mode = RT_MODE_VCM, .spp = 16, .max_depth = 2}, 1e-2,
                 "by vertex connection and merging");
    map.gather = RT_GATHER_DEVICE;
    expect_floor(map, 0.05, "by photons of the tree");
    map.gather = RT_GATHER_FLANN;
    expect_floor(map, 0.05, "by photons of neighbour lists");
    map.area = RT_AREA_HULL;
    expect_floor(map, 0.05, "by photons of the hull");
}

/* ---- A rough coat, whose facets scatter light once --------------------------------- */

/* The facets' light is the same in all channels, so that it goes out of their differences. */
static const char rough[] =
    "camera { eye 0 1.2 2  look_at 0 0 0  fov 2 }\n"
    "material m { kd 0.9 0.6 0.2  coat 1  coat_ior 1.6  coat_roughness 0.4  coat_linear true\n"
    "    facet_scattering single }\n"
    "quad { corner -9 0 -9  edge1 0 0 18  edge2 18 0 0  material m }\n"
    "light spot { position 3 1.8 0  target 0 0 0  intensity 10  inner 6  outer 7 }\n";

static const double alpha = 0.4;

/* Smith's masking of GGX at this cosine. */
static double unmasked(double cosine)
{
    const double tangent2 = 1 / (cosine * cosine) - 1;
    return 2 / (1 + sqrt(1 + alpha * alpha * tangent2));
}

/*
 * The parts of the light along w, at this cosine, that facets reflect and refract between an index
 * and m times that: the integral over their normals h of G1(w) D(h) w.h / w.z by what each sends
 * where nothing masks it, G1 of that direction.
 */
static void scatter_once(double cosine, double m, double *reflected, double *refracted)
{
    enum { rings = 256, turns = 128 };
    const double sine = sqrt(1 - cosine * cosine);
    *reflected = *refracted = 0;
    for (int i = 0; i < rings; i++)
        for (int k = 0; k < turns; k++) {
            /* D(h) h.z is the density of h; most of the points go to its tail. */
            const double t = (i + 0.5) / rings, u = 1 - (1 - t) * (1 - t) * (1 - t),
                         turn = 2 * PI * (k + 0.5) / turns;
            const double z = 1 / sqrt(1 + alpha * alpha * u / (1 - u)), r = sqrt(1 - z * z);
            const double along = sine * r * cos(turn) + cosine * z;
            if (along <= 0)
                continue;
            const double part =
                3 * (1 - t) * (1 - t) * unmasked(cosine) * along / (cosine * z) / (rings * turns);
            const double f = reflectance(along, m), up = 2 * along * z - cosine;
            if (up > 0)
                *reflected += part * f * unmasked(up);
            if (f >= 1)
                continue;
            const double beyond = sqrt(1 - (1 - along * along) / (m * m)),
                         down = beyond * z + (cosine - along * z) / m;
            if (down > 0)
                *refracted += part * (1 - f) * unmasked(down);
        }
}

/* The radiance of a floor of kd 1 but for what facets reflect. */
static double rough_radiance(void)
{
    enum { steps = 64 };
    const double m = 1.6, d2 = 3 * 3 + 1.8 * 1.8, to_light = 1.8 / sqrt(d2),
                 to_eye = 1.2 / sqrt(1.2 * 1.2 + 2 * 2);
    double inner = 0, part, in, out;
    for (int i = 0; i < steps; i++) {
        scatter_once(sqrt((i + 0.5) / steps), 1 / m, &part, &out);
        inner += part / steps;
    }
    scatter_once(to_light, m, &part, &in);
    scatter_once(to_eye, m, &part, &out);
    return in * out / (m * m * (1 - inner)) / PI * 10 / d2 * to_light;
}

static void light_goes_through_facets_once(void **state)
{
    const double expected = rough_radiance();
    double means[3];
    rt_render_options map = {.mode = RT_MODE_PHOTON,
                             .spp = 4,
                             .photons = 400000,
                             .k = 200,
                             .direct = RT_DIRECT_PHOTONS,
                             .max_depth = 8};
    (void)state;
    render_means(means, rough, (rt_render_options){.spp = 64, .max_depth = 2});
    expect_close((means[0] - means[2]) / 0.7, expected, 5e-3 * expected, "by paths");
    expect_close((means[1] - means[2]) / 0.4, expected, 5e-3 * expected, "by paths");
    render_means(means, rough, map);
    expect_close((means[0] - means[2]) / 0.7, expected, 0.05 * expected, "by photons");
}

/* ---- A white furnace --------------------------------------------------------------- */

#define FURNACE(more)                                                                              \
    "camera { eye 0 0 -3  look_at 0 0 0  fov 20 }\nlight environment { radiance 1 }\n"             \
    "material m { kd 1  coat 1" more " }\nsphere { centre 0 0 0  radius 0.8  material m }\n"

static void white_disappears_in_a_white_furnace(void **state)
{
    static const char *const coats[] = {
        FURNACE(""), FURNACE("  coat_ior 2.2  coat_linear true"), FURNACE("  coat_roughness 0.1"),
        FURNACE("  coat_roughness 1  distribution beckmann  coat_ior 1.8"),
        "texture t { pattern gradient  a 0.2  b 1 }\n" FURNACE(
            "  coat_roughness 0.8  coat_roughness_texture t")};
    double means[3];
    (void)state;
    for (size_t i = 0; i < sizeof coats / sizeof *coats; i++) {
        render_means(means, coats[i], (rt_render_options){.spp = 256});
        expect_close(means[0], 1, 2e-3, "by paths");
        render_means(means, coats[i], (rt_render_options){.mode = RT_MODE_VCM, .spp = 64});
        expect_close(means[0], 1, 5e-3, "by vertex connection and merging");
        render_means(means, coats[i],
                     (rt_render_options){.mode = RT_MODE_PHOTON,
                                         .spp = 16,
                                         .photons = 400000,
                                         .k = 200,
                                         .direct = RT_DIRECT_PHOTONS});
        expect_close(means[0], 1, 0.03, "by photons");
    }
}

/* ---- A room -------------------------------------------------------------------------- */

/* A ball and walls below coats, the ball's rough, around a small light. */
static const char room[] =
    "camera { eye 0 0.1 1.9  look_at 0 -0.1 0  fov 50 }\n"
    "material wall { kd 0.7 0.6 0.4  coat 0.7  coat_roughness 0.3 }\n"
    "material ball { kd 0.3 0.5 0.7  coat 1  coat_ior 1.7  coat_absorption 0.1 0.3 0 }\n"
    "material lamp { emission 5 }\n"
    "box { centre 0 0 0  size 2 2 4  material wall }\n"
    "sphere { centre 0.2 -0.5 -0.2  radius 0.5  material ball }\n"
    "quad { corner -0.4 0.95 -0.4  edge1 0.8 0 0  edge2 0 0 0.8  material lamp }\n";

static void modes_agree_in_a_room(void **state)
{
    (void)state;
    expect_modes_agree(room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(light_goes_through_a_coat_by_the_definition),
        statistical_test(light_goes_through_facets_once),
        statistical_test(white_disappears_in_a_white_furnace),
        statistical_test(modes_agree_in_a_room),
    };
    return cmocka_run_group_tests_name("lib/render/coat", tests, NULL, NULL);
}
