/*
 * test_photon_grids.c - photon mapping in media whose density lies on a grid: against closed forms,
 * quadrature, homogeneous media and path tracing.
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

/* ---- Transmittance ------------------------------------------------------------------- */

/* The integral of the density along the z axis, of a turned grid. */
static double depth_along_z(const rt_grid *grid, double from, double to)
{
    enum { steps = 20000 };
    const double(*m)[4] = grid->transform.m;
    double sum = 0;
    for (int i = 0; i < steps; i++) {
        const double z = from + (to - from) * (i + 0.5) / steps;
        double p[3];
        int inside = 1;
        for (int axis = 0; axis < 3; axis++) { /* the turn's inverse is its transpose */
            const double local =
                -m[0][axis] * m[0][3] - m[1][axis] * m[1][3] + m[2][axis] * (z - m[2][3]);
            p[axis] = (local + 1) / 2 * grid->size[axis];
            inside &= fabs(local) < 1;
        }
        sum += inside ? grid_density(grid, p) * (to - from) / steps : 0;
    }
    return sum;
}

#define ALONG_Z(eye, look_at)                                                                      \
    "camera { projection orthographic  width 1e-5  eye 0 0 " eye "  look_at 0 0 " look_at " }\n"   \
    "light environment { radiance 1 }\n"

/*
 * A grid that is so small, dense and far from the camera that a step between collisions is less
 * than what single precision tells apart there; most of it is empty, and has a dense voxel in its
 * brick. Rays pass it all the same, half a thousandth of them through that voxel.
 */
static void steps_of_a_dense_grid_far_away_end(void **state)
{
    static const rt_mode modes[] = {RT_MODE_PATH, RT_MODE_PHOTON};
    static float values[8 * 8 * 8];
    const rt_grid grid = {.values = values,
                          .size = {8, 8, 8},
                          .lo = {-1e-3f, -1e-3f, 299.999f},
                          .hi = {1e-3f, 1e-3f, 300.001f}};
    rt_render_options options = photons;
    (void)state;
    values[0] = 1e7f;
    options.photons = 10;
    options.max_depth = 2;
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) {
        options.mode = modes[i];
        const seed_mean m =
            mean_of(foggy_renderer("camera { projection orthographic  width 1.6e-3  eye 0 0 0  "
                                   "look_at 0 0 9 }\nlight environment { radiance 1 }\n",
                                   &grid, 0),
                    options);
        for (int c = 0; c < 3; c++)
            assert_true(m.value[c] > 0.9 && m.value[c] < 1.1);
    }
}

/*
 * The sky through a turned box, up and down the z axis, from outside, and from within. A march
 * through cells has no noise.
 */
static void rays_are_attenuated_by_what_they_pass(void **state)
{
    static const struct {
        const char *text;
        double from, to;
    } rays[] = {{ALONG_Z("0", "9"), 0, 6},
                {ALONG_Z("6", "0"), 0, 6},
                {ALONG_Z("3", "9"), 3, 6},
                {ALONG_Z("3.1", "0"), 0, 3.1}};
    float values[voxels];
    uneven_fill(values);
    const rt_grid grid = {
        .values = values,
        .size = {nx, ny, nz},
        .lo = {-1, -1, -1},
        .hi = {1, 1, 1},
        .transform = {
            {{0.8f, -0.36f, -0.48f, 0.1f}, {0, 0.8f, -0.6f, -0.05f}, {0.6f, 0.48f, 0.64f, 3}}}};
    rt_render_options options = photons;
    (void)state;
    options.photons = 10;
    options.max_depth = 1;
    for (size_t i = 0; i < sizeof rays / sizeof *rays; i++) {
        const double depth = depth_along_z(&grid, rays[i].from, rays[i].to);
        const seed_mean m = mean_of(foggy_renderer(rays[i].text, &grid, 0), options);
        assert_true(depth > 0.1);
        for (int c = 0; c < 3; c++) {
            const double exact = exp(-((double)smoke_absorption[c] + smoke_scattering[c]) * depth);
            assert_float_equal(m.value[c], exact, 1e-4 * exact);
        }
    }
}

/* ---- Single scattering --------------------------------------------------------------- */

static const double bottom = 0.5, height = 3;
static const double light[3] = {0.3, 0.4, 2};

/* The density at the height z, which alone it depends on. */
static double density_at(const rt_grid *grid, double z)
{
    const double p[3] = {0.5, 0.5, (z - bottom) / height * grid->size[2]};
    return p[2] < 0 || p[2] > grid->size[2] ? 0 : grid_density(grid, p);
}

enum { intervals = 8000 }; /* of the z axis, from 0 to 4 m */

/* What the z axis scatters towards the origin from a light beside it, W/(m^2 sr). */
static double single_scattering(const rt_grid *grid, int c)
{
    static double depth[intervals];
    const double g = 0.5, step = 4.0 / intervals;
    const int at = (int)(light[2] / step);
    double sum = 0, depth_so_far = 0;
    for (int i = 0; i < intervals; i++) {
        depth_so_far += density_at(grid, (i + 0.25) * step) * step / 2;
        depth[i] = depth_so_far;
        depth_so_far += density_at(grid, (i + 0.75) * step) * step / 2;
    }
    for (int i = 0; i < intervals; i++) {
        const double z = (i + 0.5) * step, dz = light[2] - z;
        const double d = sqrt(light[0] * light[0] + light[1] * light[1] + dz * dz);
        const double phase = (1 - g * g) / (4 * pi * pow(1 + g * g - 2 * g * dz / d, 1.5));
        const double towards = (depth[at] - depth[i]) * d / dz;
        sum += smoke_scattering[c] * density_at(grid, z) * phase * 5 / (d * d) *
               exp(-((double)smoke_absorption[c] + smoke_scattering[c]) * (depth[i] + towards)) *
               step;
    }
    return sum;
}

/* Layers, 0.17 m thick, from 0.5 m to 3.5 m, one of them beside a brick that is thinner. */
static void fill_layers(float values[nz])
{
    for (int i = 0; i < nz; i++)
        values[i] = i % 5 == 4 ? 0 : 0.3f + 1.2f * (float)(i % 4);
    values[8] = 8;
}

static void layers_scatter_the_light_of_a_point_once(void **state)
{
    static const char text[] =
        "camera { projection orthographic  width 1e-3  eye 0 0 0  look_at 0 0 9 }\n"
        "light point { position 0.3 0.4 2  intensity 5 }\n";
    float values[nz];
    (void)state;
    fill_layers(values);
    const rt_grid grid = {.values = values,
                          .size = {1, 1, nz},
                          .lo = {-50, -50, (float)bottom},
                          .hi = {50, 50, (float)(bottom + height)}};
    const double exact[3] = {single_scattering(&grid, 0), single_scattering(&grid, 1),
                             single_scattering(&grid, 2)};
    rt_render_options options = photons;
    options.max_depth = 2;
    options.photons = 10;
    options.direct = RT_DIRECT_NEE;
    options.spp = 256;
    const seed_mean m = mean_of(foggy_renderer(text, &grid, 0), options);
    expect_mean_near(&m, exact, 0);
}

/*
 * Layers in a height of 1 m under light from far, which comes down at an angle of cosine 0.8, as
 * seen from above:
 *
 *   L = E p sigma_s integral of rho exp(-sigma_t (1 + 1/0.8) S) = E p sigma_s (1 - exp(-sigma_t
 *       (1 + 1/0.8) S_all)) / (sigma_t (1 + 1/0.8))
 *
 * with S the integral of rho so far, whatever the layers.
 */
static void far_light_scattered(double out[3], const float *values, int count)
{
    const double g = 0.5, phase = (1 - g * g) / (4 * pi * pow(1 + g * g + 2 * g * 0.8, 1.5));
    double all = 0;
    for (int i = 0; i < count; i++)
        all += (double)values[i] / count;
    for (int c = 0; c < 3; c++) {
        const double sigma = ((double)smoke_absorption[c] + smoke_scattering[c]) * (1 + 1 / 0.8);
        out[c] = 5 * phase * smoke_scattering[c] * (1 - exp(-sigma * all)) / sigma;
    }
}

/*
 * Photons lie alike everywhere across the rays: the blur of the beam estimate does not show; that
 * of spheres reaches over layers. There are few layers, and more than a run has.
 */
static void layers_scatter_light_from_far_once(void **state)
{
    static const char text[] =
        "camera { projection orthographic  width 2  eye 0 0 0  look_at 0 0 9 }\n"
        "light directional { direction 0.6 0 0.8  irradiance 5 }\n";
    enum { few = 3, many = 100 };
    static const float coarse[few] = {0, 6, 1};
    float fine[many];
    double exact[3];
    rt_render_options options = photons;
    (void)state;
    for (int i = 0; i < many; i++)
        fine[i] = i % 5 == 4 ? 0 : 0.3f + 1.2f * (float)(i / 10 % 4);
    rt_grid grid = {
        .values = coarse, .size = {1, 1, few}, .lo = {-2.2f, -1.4f, 1}, .hi = {2.2f, 1.4f, 2}};
    options.width = options.height = 8;
    options.max_depth = 2;
    options.photons = 20000;
    options.volume_k = RT_K_ALL;
    options.volume_radius = 0.15f;
    far_light_scattered(exact, coarse, few);
    seed_mean m = mean_of(foggy_renderer(text, &grid, 0), options);
    expect_mean_near(&m, exact, 0);
    grid.values = fine;
    grid.size[2] = many;
    far_light_scattered(exact, fine, many);
    m = mean_of(foggy_renderer(text, &grid, 0), options);
    expect_mean_near(&m, exact, 0);
    options.volume_estimate = RT_VOLUME_POINT;
    options.volume_radius = 0.05f;
    options.spp = 16;
    m = mean_of(foggy_renderer(text, &grid, 0), options);
    expect_mean_near(&m, exact, 0.01);
    options.direct = RT_DIRECT_NEE;
    options.photons = 10;
    m = mean_of(foggy_renderer(text, &grid, 0), options);
    expect_mean_near(&m, exact, 0);
}

/* ---- All orders of scattering -------------------------------------------------------- */

/*
 * A medium that absorbs nothing cannot be seen under a uniform sky, which reaches it beside all
 * shapes.
 */
static void albedo_of_1_disappears_under_a_uniform_sky(void **state)
{
    static const char *const texts[] = {
        "camera { eye 0 0 -5  look_at 0 0 0  fov 30 }\nlight environment { radiance 1 }\n",
        "camera { eye 0 0 -5  look_at 0 0 0  fov 30 }\nlight environment { radiance 1 }\n"
        "material black { kd 0 }\nsphere { centre 0 2 0  radius 0.1  material black }\n"};
    static const double one[3] = {1, 1, 1};
    float values[voxels];
    rt_render_options options = photons;
    (void)state;
    uneven_fill(values);
    const rt_grid grid = {
        .values = values, .size = {nx, ny, nz}, .lo = {-1, -1, -1}, .hi = {1, 1, 1}};
    options.max_depth = 200;
    options.volume_k = RT_K_ALL;
    options.volume_radius = 0.05f;
    options.width = options.height = 8;
    options.photons = 20000;
    for (int i = 0; i < 2; i++) {
        const seed_mean m = mean_of(foggy_renderer(texts[i], &grid, 1), options);
        expect_mean_near(&m, one, 0.005);
    }
    options.spp = 16;
    options.volume_estimate = RT_VOLUME_POINT;
    seed_mean m = mean_of(foggy_renderer(texts[0], &grid, 1), options);
    expect_mean_near(&m, one, 0.03); /* spheres reach out of the box, where no points are */
    options.direct = RT_DIRECT_NEE;
    options.volume_estimate = RT_VOLUME_BEAM;
    m = mean_of(foggy_renderer(texts[0], &grid, 1), options);
    expect_mean_near(&m, one, 0.005);
}

static const struct {
    rt_direct direct;
    uint32_t final_gather;
    uint64_t caustic_photons;
    rt_volume_estimate estimate;
} ways[] = {{RT_DIRECT_NEE, 0, 0, RT_VOLUME_BEAM},
            {RT_DIRECT_PHOTONS, 0, 3000, RT_VOLUME_BEAM},
            {RT_DIRECT_PHOTONS, 0, 0, RT_VOLUME_POINT},
            {RT_DIRECT_NEE, 1, 3000, RT_VOLUME_BEAM}};

static rt_render_options options_of(size_t way)
{
    rt_render_options options = photons;
    options.width = options.height = 16;
    options.spp = 4;
    options.max_depth = 24;
    options.photons = 12000;
    options.radius = options.volume_radius = 0.1f;
    options.direct = ways[way].direct;
    options.final_gather = ways[way].final_gather;
    options.caustic_photons = ways[way].caustic_photons;
    options.volume_estimate = ways[way].estimate;
    return options;
}

/* The blur of both is the same. */
static void a_constant_grid_is_a_homogeneous_medium(void **state)
{
    float ones[voxels];
    (void)state;
    for (int i = 0; i < voxels; i++)
        ones[i] = 1;
    const rt_grid grid = {
        .values = ones, .size = {nx, ny, nz}, .lo = {-1, -1, -1}, .hi = {1, 2, 1}};
    for (size_t i = 1; i < 3; i++) {
        const seed_mean plain = mean_of(smoky_renderer(SMOKE_ROOM, NULL), options_of(i)),
                        found = mean_of(smoky_renderer(SMOKE_ROOM, &grid), options_of(i));
        expect_same_mean(&found, &plain, 0);
    }
}

static void photons_and_paths_agree(void **state)
{
    static const rt_render_options paths = {.width = 16, .height = 16, .spp = 32, .max_depth = 24};
    float values[voxels];
    (void)state;
    uneven_fill(values);
    const rt_grid grid = {.values = values,
                          .size = {nx, ny, nz},
                          .lo = {-0.7f, 0.2f, -0.6f},
                          .hi = {0.7f, 1.2f, 0.6f}};
    const seed_mean reference = mean_of(smoky_renderer(SMOKE_ROOM, &grid), paths);
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        if (ways[i].estimate == RT_VOLUME_POINT)
            continue;
        const seed_mean m = mean_of(smoky_renderer(SMOKE_ROOM, &grid), options_of(i));
        expect_same_mean(&m, &reference, 0.02);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steps_of_a_dense_grid_far_away_end),
        cmocka_unit_test(rays_are_attenuated_by_what_they_pass),
        statistical_test(layers_scatter_the_light_of_a_point_once),
        statistical_test(layers_scatter_light_from_far_once),
        statistical_test(albedo_of_1_disappears_under_a_uniform_sky),
        statistical_test(a_constant_grid_is_a_homogeneous_medium),
        statistical_test(photons_and_paths_agree),
    };
    return cmocka_run_group_tests_name("lib/mode/photon_grids", tests, NULL, NULL);
}
