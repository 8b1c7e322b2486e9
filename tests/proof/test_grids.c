/*
 * test_grids.c - media whose density lies on a grid: whole renders against closed forms,
 * quadrature, and homogeneous media.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "kernels/statistics.h"
#include "lib/scene/uneven_grid.h"
#include "proof/page.h"
#include "proof/proof.h"

enum { side = 16, pixels = side * side, spp = 256 };

static const double pi = 3.14159265358979323846;
static const char *const channel[3] = {"red", "green", "blue"};
static const float absorption[3] = {0.1f, 0.4f, 0.6f}, scattering[3] = {0.5f, 0.2f, 1.8f};

#define ALONG_Z "camera { projection orthographic  width 1e-3  eye 0 0 0  look_at 0 0 9 }\n"

/* ---- Scenes -------------------------------------------------------------------------- */

/* A scene text, whose space outside of solids has the coefficients above times a grid. */
typedef struct foggy {
    const char *text;
    rt_grid grid;
    int is_white, is_clear; /* without absorption, or without scattering */
} foggy;

static rt_scene *parse(const char *text)
{
    rt_scene *scene = NULL;
    rt_error error;
    expect_ok(rt_scene_parse(&scene, text, "test", NULL, &error), &error);
    return scene;
}

static rt_scene *scene_of(const foggy *f)
{
    rt_scene *scene = parse(f->text);
    rt_medium medium = {.g = 0.5f};
    rt_error error;
    if (!f->is_white)
        memcpy(medium.absorption, absorption, sizeof absorption);
    if (!f->is_clear)
        memcpy(medium.scattering, scattering, sizeof scattering);
    expect_ok(rt_scene_add_grid(scene, &medium.density, &f->grid, &error), &error);
    expect_ok(rt_scene_set_medium(scene, &medium, &error), &error);
    return scene;
}

/* Renders a scene, which is destroyed, into out[channel][pixel]. */
static void render(double out[3][pixels], rt_scene *scene, rt_render_options options)
{
    rt_renderer *renderer = NULL;
    rt_film *film = NULL;
    rt_error error;
    options.width = options.height = side;
    options.seed = test_seed(options.seed);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    for (int i = 0; i < pixels; i++)
        for (int c = 0; c < 3; c++)
            out[c][i] = rt_film_rgb(film)[3 * i + c];
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
}

/* The mean of a channel's pixels, of which the page has an entry. */
static void prove(const char *scene, const char *formula, double found[3][pixels], int c,
                  double exact, double rounding)
{
    double mean = 0, squares = 0;
    for (int k = 0; k < pixels; k++)
        mean += found[c][k] / pixels;
    for (int k = 0; k < pixels; k++)
        squares += (found[c][k] - mean) * (found[c][k] - mean);
    const double error = sqrt(squares / (pixels * (pixels - 1.0)) + rounding * rounding);
    page_row(proof_text("%s, %s, path: %s\n  expected %.6g,", scene, channel[c], formula, exact),
             proof_text("ours %.6g: off by %+.2f standard errors of %.1e", mean,
                        error > 0 ? (mean - exact) / error : 0, error));
    expect_mean(found[c], pixels, exact, rounding, channel[c]);
}

/* ---- Transmittance ------------------------------------------------------------------- */

static void expect_transmittance(const foggy *f, double depth, const char *scene,
                                 const char *formula)
{
    double found[3][pixels];
    render(found, scene_of(f), (rt_render_options){.spp = spp, .max_depth = 1, .seed = 1});
    for (int c = 0; c < 3; c++) {
        const double sigma = (f->is_white ? 0 : absorption[c]) + (f->is_clear ? 0 : scattering[c]);
        prove(scene, formula, found, c, exp(-sigma * depth), 1e-4);
    }
}

static void a_ramp_transmits_by_its_mean(void **state)
{
    float values[20];
    (void)state;
    for (int i = 0; i < 20; i++)
        values[i] = ((float)i + 0.5f) / 10;
    foggy f = {
        .text = ALONG_Z "light environment { radiance 1 }\n",
        .grid = {.values = values, .size = {1, 1, 20}, .lo = {-1, -1, 2}, .hi = {1, 1, 3.5f}}};
    expect_transmittance(&f, 1.5, "density that rises along rays", "exp(-sigma mean(density) d)");
    f.is_clear = 1;
    expect_transmittance(&f, 1.5, "the same, without scattering", "exp(-sigma_a mean(density) d)");
}

/* The ray is the z axis, which is close to a diagonal of the box. */
static void a_turned_box_transmits_by_quadrature(void **state)
{
    static const rt_transform placed = {
        {{0.8f, -0.36f, -0.48f, 0.1f}, {0, 0.8f, -0.6f, -0.05f}, {0.6f, 0.48f, 0.64f, 3}}};
    enum { steps = 20000 };
    float values[voxels];
    double depth = 0;
    (void)state;
    uneven_fill(values);
    const foggy f = {.text = ALONG_Z "light environment { radiance 1 }\n",
                     .grid = {.values = values,
                              .size = {nx, ny, nz},
                              .lo = {-1, -1, -1},
                              .hi = {1, 1, 1},
                              .transform = placed}};
    for (int i = 0; i < steps; i++) {
        const double x = -0.1, y = 0.05, z = 6 * (i + 0.5) / steps - 3;
        const double u = 0.8 * x + 0.6 * z, v = -0.36 * x + 0.8 * y + 0.48 * z;
        const double w = -0.48 * x - 0.6 * y + 0.64 * z;
        const double p[3] = {(u + 1) / 2 * nx, (v + 1) / 2 * ny, (w + 1) / 2 * nz};
        if (fabs(u) < 1 && fabs(v) < 1 && fabs(w) < 1)
            depth += grid_density(&f.grid, p) * 6 / steps;
    }
    assert_true(depth > 0.3);
    expect_transmittance(&f, depth, "turned box", "exp(-sigma S), S of density by quadrature");
}

/* Rays from the far corner to the origin's side, and back: down the bricks, and up. */
static void a_ray_and_its_reverse_transmit_the_same(void **state)
{
    static const char *const cameras[] = {
        "camera { projection orthographic  width 1e-3  eye 3 2 4  look_at 0 0 0 }\n",
        "camera { projection orthographic  width 1e-3  eye -3 -2 -4  look_at 0 0 0 }\n"};
    static double found[2][3][pixels];
    float values[voxels];
    (void)state;
    uneven_fill(values);
    for (int i = 0; i < 2; i++) {
        char text[200];
        snprintf(text, sizeof text, "%slight environment { radiance 1 }\n", cameras[i]);
        const foggy f = {
            .text = text,
            .grid = {.values = values, .size = {nx, ny, nz}, .lo = {-1, -1, -1}, .hi = {1, 1, 1}}};
        render(found[i], scene_of(&f),
               (rt_render_options){.spp = spp, .max_depth = 1, .seed = 8 + (uint32_t)i});
    }
    for (int c = 0; c < 3; c++) {
        for (int k = 0; k < pixels; k++)
            found[0][c][k] -= found[1][c][k];
        prove("rays through a box and back", "difference of transmittances", found[0], c, 0, 1e-4);
    }
}

/* ---- Single scattering --------------------------------------------------------------- */

static const double floor_z = 0.5, height = 3;
static const double light[3] = {0.3, 0.4, 2};

/* The density at the height z, which alone it depends on, and its integral from 0 to there. */
static double density_at(const rt_grid *grid, double z)
{
    const double p[3] = {0.5, 0.5, (z - floor_z) / height * grid->size[2]};
    return p[2] < 0 || p[2] > grid->size[2] ? 0 : grid_density(grid, p);
}

enum { intervals = 8000 }; /* of the z axis, from 0 to 4 m */

static double step(void)
{
    return 4.0 / intervals;
}

/* What the height of interval i scatters towards the origin, W/(m^3 sr). */
static double scattered(const rt_grid *grid, const double *depth, int i, int c)
{
    const double g = 0.5, z = (i + 0.5) * step(), dz = light[2] - z;
    const double d = sqrt(light[0] * light[0] + light[1] * light[1] + dz * dz);
    const double phase = (1 - g * g) / (4 * pi * pow(1 + g * g - 2 * g * dz / d, 1.5));
    const int at = (int)(light[2] / step());
    const double towards = dz == 0 ? density_at(grid, z) * d : (depth[at] - depth[i]) * d / dz;
    return scattering[c] * density_at(grid, z) * phase * 5 / (d * d) *
           exp(-(absorption[c] + scattering[c]) * (depth[i] + towards));
}

static void a_layered_fog_scatters_the_light_of_a_point(void **state)
{
    static double depth[intervals], found[3][pixels];
    float values[nz];
    double sum = 0;
    (void)state;
    for (int i = 0; i < nz; i++)
        values[i] = i % 5 == 4 ? 0 : 0.3f + 1.2f * (float)(i % 4);
    values[8] = 8; /* beside a brick that is thinner */
    const foggy f = {.text = ALONG_Z "light point { position 0.3 0.4 2  intensity 5 }\n",
                     .grid = {.values = values,
                              .size = {1, 1, nz},
                              .lo = {-50, -50, (float)floor_z},
                              .hi = {50, 50, (float)(floor_z + height)}}};
    for (int i = 0; i < intervals; i++) {
        sum += density_at(&f.grid, (i + 0.25) * step()) * step() / 2;
        depth[i] = sum;
        sum += density_at(&f.grid, (i + 0.75) * step()) * step() / 2;
    }
    render(found, scene_of(&f), (rt_render_options){.spp = spp, .max_depth = 2, .seed = 2});
    for (int c = 0; c < 3; c++) {
        double exact = 0;
        for (int i = 0; i < intervals; i++)
            exact += scattered(&f.grid, depth, i, c) * step();
        prove("layers under a point light", "light scattered once, by quadrature", found, c, exact,
              1e-3 * exact);
    }
}

/* ---- All orders of scattering -------------------------------------------------------- */

static void albedo_of_1_disappears_in_a_white_furnace(void **state)
{
    double found[3][pixels];
    float values[voxels];
    (void)state;
    uneven_fill(values);
    const foggy f = {
        .text = "camera { eye 0 0 -5  look_at 0 0 0  fov 20 }\nlight environment { radiance 1 }\n",
        .grid = {.values = values, .size = {nx, ny, nz}, .lo = {-1, -1, -1}, .hi = {1, 1, 1}},
        .is_white = 1};
    render(found, scene_of(&f), (rt_render_options){.spp = 32, .max_depth = 1000, .seed = 3});
    for (int c = 0; c < 3; c++)
        prove("albedo of 1 under a uniform sky", "L", found, c, 1, 1e-4);
}

#define ROOM                                                                                       \
    "camera { eye 0 1 -4  look_at 0 0.6 0  fov 40 }\nmaterial grey { kd 0.6 }\n"                   \
    "plane { point 0 0 0  normal 0 1 0  material grey }\n"                                         \
    "quad { corner -0.4 1.6 -0.4  edge1 0.8 0 0  edge2 0 0 0.8  material grey  radiance 6 }\n"     \
    "light point { position 0.4 1.1 -0.8  intensity 0.3 }\n"                                       \
    "light environment { radiance 0.1 }\n"

/* The room with a box of smoke, whose density is 1: on a grid that is larger, or without one. */
static void render_smoke(double out[3][pixels], rt_estimator estimator, uint32_t seed, int has_grid)
{
    static float ones[voxels];
    rt_material smoke = {.interface = 1, .g = 0.4f};
    rt_surface surface = {0};
    rt_scene *scene = parse(ROOM);
    rt_error error;
    for (int i = 0; i < voxels; i++)
        ones[i] = 1;
    const rt_grid grid = {
        .values = ones, .size = {nx, ny, nz}, .lo = {-1, -1, -1}, .hi = {1, 2, 1}};
    memcpy(smoke.absorption, absorption, sizeof absorption);
    memcpy(smoke.scattering, scattering, sizeof scattering);
    if (has_grid)
        expect_ok(rt_scene_add_grid(scene, &smoke.density, &grid, &error), &error);
    expect_ok(rt_scene_add_material(scene, &surface.material, "smoke", &smoke, &error), &error);
    expect_ok(rt_scene_add_box(scene, NULL, (float[]){0, 0.8f, 0}, (float[]){1.4f, 1, 1.2f},
                               &surface, &error),
              &error);
    render(out, scene,
           (rt_render_options){.spp = 64, .max_depth = 5, .seed = seed, .estimator = estimator});
}

static void a_constant_grid_is_a_homogeneous_medium(void **state)
{
    static const rt_estimator estimators[] = {RT_ESTIMATOR_MIS, RT_ESTIMATOR_LIGHT,
                                              RT_ESTIMATOR_BSDF};
    static const char *const names[] = {"difference, estimator mis", "difference, estimator light",
                                        "difference, estimator bsdf"};
    static double plain[3][pixels], found[3][pixels];
    (void)state;
    render_smoke(plain, RT_ESTIMATOR_MIS, 4, 0);
    for (uint32_t i = 0; i < 3; i++) {
        render_smoke(found, estimators[i], 5 + i, 1);
        for (int c = 0; c < 3; c++) {
            for (int k = 0; k < pixels; k++)
                found[c][k] -= plain[c][k];
            prove("density of 1, and no grid", names[i], found, c, 0, 0);
        }
    }
}

static void the_page_has_the_rows(void **state)
{
    (void)state;
    page_section("Media on grids");
}

/* ---- What is refused ----------------------------------------------------------------- */

static void modes_without_grids_refuse_them(void **state)
{
    static const float one[1] = {1};
    static const rt_mode modes[] = {RT_MODE_VCM, RT_MODE_DIRECT};
    const foggy f = {.text = ROOM, .grid = {.values = one, .size = {1, 1, 1}}};
    rt_scene *scene = scene_of(&f);
    rt_renderer *renderer = NULL;
    rt_film *film = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    for (int i = 0; i < 2; i++) {
        const rt_render_options options = {.mode = modes[i], .width = 4, .height = 4, .spp = 1};
        assert_int_equal(rt_render(&film, renderer, &options, &error), RT_ERROR_USAGE);
        assert_string_equal(error.field, "mode");
        assert_non_null(strstr(error.message, "does not know; modes path and photon do"));
    }
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(a_ramp_transmits_by_its_mean),
        statistical_test(a_turned_box_transmits_by_quadrature),
        statistical_test(a_ray_and_its_reverse_transmit_the_same),
        statistical_test(a_layered_fog_scatters_the_light_of_a_point),
        statistical_test(albedo_of_1_disappears_in_a_white_furnace),
        statistical_test(a_constant_grid_is_a_homogeneous_medium),
        cmocka_unit_test(the_page_has_the_rows),
        cmocka_unit_test(modes_without_grids_refuse_them),
    };
    return cmocka_run_group_tests_name("proof/grids", tests, NULL, NULL);
}
