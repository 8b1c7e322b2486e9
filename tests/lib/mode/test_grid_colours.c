/*
 * test_grid_colours.c - media whose albedo lies on a grid, and densities of three channels, by
 * paths and photons: against closed forms, quadrature, and homogeneous media.
 */
#include "support.h"

#include <math.h>
#include <string.h>

#include "kernels/statistics.h"
#include "lib/mode/grid_scenes.h"
#include "lib/mode/seed_means.h"

static const double pi = 3.14159265358979323846;

static seed_mean mean_of(rt_renderer *renderer, rt_render_options options)
{
    const seed_mean m = seed_mean_of(renderer, options);
    rt_renderer_destroy(renderer);
    return m;
}

static const rt_render_options photons = {
    .mode = RT_MODE_PHOTON, .width = 4, .height = 4, .spp = 1, .direct = RT_DIRECT_PHOTONS};

static double extinction(int c)
{
    return (double)smoke_absorption[c] + smoke_scattering[c];
}

/* What a grid of layers has of a channel at a height. */
static double number_at(const rt_grid *grid, double z, int c)
{
    const double unit = (z - grid->lo[2]) / ((double)grid->hi[2] - grid->lo[2]);
    return grid_number(grid, (double[3]){0.5, 0.5, unit * grid->size[2]}, (uint32_t)c);
}

/* Layers of half a metre, of these albedos in turn, from 0.3 m on and without end. */
static const float turns[] = {1, 0.2f, 0.5f, 0.1f, 0.9f, 0.7f, 0.6f, 0.6f, 0};
static const rt_grid stripes = {.values = turns,
                                .size = {1, 1, 3},
                                .channels = 3,
                                .lo = {-1, -1, 0.3f},
                                .hi = {1, 1, 1.8f},
                                .wrap = RT_GRID_REPEAT};

/* ---- Transmittance ------------------------------------------------------------------- */

/* The sky through a density that rises along the rays, by another slope for each channel. */
static void channels_are_attenuated_by_their_own_density(void **state)
{
    enum { layers = 20 };
    static const char text[] =
        "camera { projection orthographic  width 1e-3  eye 0 0 0  look_at 0 0 9 }\n"
        "light environment { radiance 1 }\n";
    float values[3 * layers];
    double exact[3];
    (void)state;
    for (int i = 0; i < 3 * layers; i++)
        values[i] = (float)(i / 3 + 1) * (float)(i % 3) / 10;
    const rt_grid grid = {.values = values,
                          .size = {1, 1, layers},
                          .channels = 3,
                          .lo = {-1, -1, 2},
                          .hi = {1, 1, 3.5f}};
    rt_render_options options = photons;
    options.photons = 10;
    options.max_depth = 1;
    for (int c = 0; c < 3; c++)
        exact[c] = exp(-extinction(c) * 1.5 * 1.05 * c);
    seed_mean m = mean_of(foggy_renderer(text, &grid, 0), options);
    for (int c = 0; c < 3; c++)
        assert_float_equal(m.value[c], exact[c], 1e-4 * exact[c]);
    options.mode = RT_MODE_PATH;
    options.spp = 64;
    m = mean_of(foggy_renderer(text, &grid, 0), options);
    expect_mean_near(&m, exact, 1e-4);
}

/* ---- Single scattering --------------------------------------------------------------- */

/*
 * A fog without end, of the albedos of the layers, which a point beside the z axis lights:
 *
 *   L = integral of albedo sigma_s p(z) I / d^2 exp(-sigma_t (z + d)) dz
 */
static void fog_near_a_point(double out[3], const rt_grid *albedo)
{
    enum { intervals = 40000 };
    static const double light[3] = {0.3, 0.4, 2}, end = 20, g = 0.5;
    for (int c = 0; c < 3; c++)
        out[c] = 0;
    for (int i = 0; i < intervals; i++) {
        const double z = end * (i + 0.5) / intervals, dz = light[2] - z;
        const double d = sqrt(light[0] * light[0] + light[1] * light[1] + dz * dz);
        const double phase = (1 - g * g) / (4 * pi * pow(1 + g * g - 2 * g * dz / d, 1.5));
        for (int c = 0; c < 3; c++)
            out[c] += number_at(albedo, z, c) * smoke_scattering[c] * phase * 5 / (d * d) *
                      exp(-extinction(c) * (z + d)) * end / intervals;
    }
}

/* Of red, green and blue in layers that repeat, and of one number that goes on at both sides. */
static void a_fog_of_layers_scatters_the_light_of_a_point(void **state)
{
    static const char text[] =
        "camera { projection orthographic  width 1e-3  eye 0 0 0  look_at 0 0 9 }\n"
        "light point { position 0.3 0.4 2  intensity 5 }\n";
    static const float halves[] = {0.1f, 0.9f};
    static const rt_grid half = {
        .values = halves, .size = {1, 1, 2}, .lo = {0, 0, 1.5f}, .hi = {1, 1, 2.5f}};
    const rt_grid *const albedos[] = {&stripes, &half};
    rt_render_options options = photons;
    (void)state;
    options.max_depth = 2;
    options.spp = 256;
    options.photons = 10;
    options.direct = RT_DIRECT_NEE;
    for (int i = 0; i < 2; i++) {
        double exact[3];
        fog_near_a_point(exact, albedos[i]);
        options.mode = RT_MODE_PHOTON;
        seed_mean m = mean_of(coloured_renderer(text, NULL, albedos[i]), options);
        expect_mean_near(&m, exact, 1e-4);
        options.mode = RT_MODE_PATH;
        m = mean_of(coloured_renderer(text, NULL, albedos[i]), options);
        expect_mean_near(&m, exact, 1e-4);
    }
}

/* Layers, 0.1 m thick, from 1 m to 2 m, whose channels are dense in turn. */
enum { layers = 100 };
static void fill_layers(float values[3 * layers])
{
    for (int i = 0; i < 3 * layers; i++)
        values[i] = 0.3f * (float)((i / 30 + i % 3) % 4) + 0.2f * (float)(i % 3);
}

/*
 * Layers under light from far, at an angle of cosine 0.8, as seen from above:
 *
 *   L = E p sigma_s integral of albedo rho exp(-sigma_t (1 + 1/0.8) S)
 *
 * with S the integral of rho so far, each of them by channel.
 */
static void layers_in_far_light(double out[3], const rt_grid *grid)
{
    enum { intervals = 20000 };
    const double g = 0.5, phase = (1 - g * g) / (4 * pi * pow(1 + g * g + 2 * g * 0.8, 1.5));
    for (int c = 0; c < 3; c++) {
        double depth = 0;
        out[c] = 0;
        for (int i = 0; i < intervals; i++) {
            const double z = 1 + (i + 0.5) / intervals, rho = number_at(grid, z, c) / intervals;
            depth += rho / 2;
            out[c] += 5 * phase * smoke_scattering[c] * number_at(&stripes, z, c) * rho *
                      exp(-extinction(c) * (1 + 1 / 0.8) * depth);
            depth += rho / 2;
        }
    }
}

static void layers_scatter_light_from_far(void **state)
{
    static const char text[] =
        "camera { projection orthographic  width 2  eye 0 0 0  look_at 0 0 9 }\n"
        "light directional { direction 0.6 0 0.8  irradiance 5 }\n";
    float values[3 * layers];
    double exact[3];
    rt_render_options options = photons;
    (void)state;
    fill_layers(values);
    const rt_grid grid = {.values = values,
                          .size = {1, 1, layers},
                          .channels = 3,
                          .lo = {-2.2f, -1.4f, 1},
                          .hi = {2.2f, 1.4f, 2}};
    layers_in_far_light(exact, &grid);
    options.width = options.height = 8;
    options.max_depth = 2;
    options.photons = 20000;
    options.volume_k = RT_K_ALL;
    options.volume_radius = 0.15f;
    seed_mean m = mean_of(coloured_renderer(text, &grid, &stripes), options);
    expect_mean_near(&m, exact, 1e-4);
    options.volume_estimate = RT_VOLUME_POINT;
    options.volume_radius = 0.05f;
    options.spp = 16;
    m = mean_of(coloured_renderer(text, &grid, &stripes), options);
    expect_mean_near(&m, exact, 0.01);
    options.direct = RT_DIRECT_NEE;
    options.photons = 10;
    m = mean_of(coloured_renderer(text, &grid, &stripes), options);
    expect_mean_near(&m, exact, 1e-4);
    options.mode = RT_MODE_PATH;
    m = mean_of(coloured_renderer(text, &grid, &stripes), options);
    expect_mean_near(&m, exact, 1e-4);
}

/* ---- All orders of scattering -------------------------------------------------------- */

/*
 * The room with a box of smoke, by coefficients, or by an albedo and a density of constant colours.
 */
static rt_renderer *smoke(int has_albedo, int has_density)
{
    float albedo[3], density[3];
    rt_material smoke = {.interface = 1, .g = 0.4f};
    rt_surface surface = {0};
    rt_scene *scene = NULL;
    rt_renderer *renderer = NULL;
    rt_error error;
    for (int c = 0; c < 3; c++) {
        albedo[c] = smoke_scattering[c] / (smoke_scattering[c] + smoke_absorption[c]);
        density[c] = (float)extinction(c);
        smoke.absorption[c] = has_albedo ? 0 : 2 * smoke_absorption[c];
        smoke.scattering[c] = !has_albedo   ? 2 * smoke_scattering[c]
                              : has_density ? 2
                                            : 2 * (float)extinction(c);
    }
    const rt_grid of_albedo = {.values = albedo, .size = {1, 1, 1}, .channels = 3},
                  of_density = {.values = density,
                                .size = {1, 1, 1},
                                .channels = 3,
                                .lo = {-1, 0, -1},
                                .hi = {1, 2, 1}};
    expect_ok(rt_scene_parse(&scene, SMOKE_ROOM, "test", NULL, &error), &error);
    if (has_albedo)
        expect_ok(rt_scene_add_grid(scene, &smoke.albedo, &of_albedo, &error), &error);
    if (has_density)
        expect_ok(rt_scene_add_grid(scene, &smoke.density, &of_density, &error), &error);
    expect_ok(rt_scene_add_material(scene, &surface.material, "smoke", &smoke, &error), &error);
    expect_ok(rt_scene_add_box(scene, NULL, (float[]){0, 0.7f, 0}, (float[]){1.4f, 1, 1.2f},
                               &surface, &error),
              &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    rt_scene_destroy(scene);
    return renderer;
}

static void constant_colours_are_a_homogeneous_medium(void **state)
{
    static const rt_mode modes[] = {RT_MODE_PATH, RT_MODE_PHOTON};
    rt_render_options options = photons;
    (void)state;
    options.width = options.height = 16;
    options.spp = 16;
    options.max_depth = 24;
    options.photons = 12000;
    options.radius = options.volume_radius = 0.1f;
    for (int i = 0; i < 2; i++) {
        options.mode = modes[i];
        const seed_mean plain = mean_of(smoke(0, 0), options),
                        coloured = mean_of(smoke(1, 0), options),
                        on_grid = mean_of(smoke(1, 1), options);
        expect_same_mean(&coloured, &plain, 0);
        expect_same_mean(&on_grid, &plain, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(channels_are_attenuated_by_their_own_density),
        statistical_test(a_fog_of_layers_scatters_the_light_of_a_point),
        statistical_test(layers_scatter_light_from_far),
        statistical_test(constant_colours_are_a_homogeneous_medium),
    };
    return cmocka_run_group_tests_name("lib/mode/grid_colours", tests, NULL, NULL);
}
