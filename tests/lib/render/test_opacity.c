/*
 * test_opacity.c - surfaces of an opacity below 1 in whole renders: what passes them and what they
 * scatter, for rays from the camera, to lights, from lights and between paths, for every kind of
 * shape; outlines by textures; and cutouts that emit.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>

#include "kernels/statistics.h"
#include "lib/image/scratch.h"
#include "lib/render/means.h"

static const rt_render_options by_path = {.spp = 1024, .max_depth = 4},
                               by_bpt = {.mode = RT_MODE_VCM,
                                         .techniques = RT_TECHNIQUES_BPT,
                                         .spp = 256,
                                         .max_depth = 4},
                               by_photons = {.mode = RT_MODE_PHOTON,
                                             .passes = 12,
                                             .photons = 50000,
                                             .k = 100,
                                             .max_depth = 4,
                                             .direct = RT_DIRECT_PHOTONS};

/* ---- What passes --------------------------------------------------------------------- */

/* Shapes between the camera and a wall of radiance 1, and how many of their layers are crossed. */
static const struct {
    const char *shape;
    int layers;
} shapes[] = {
    {"quad { corner -1 -1 0  edge1 2 0 0  edge2 0 2 0  material m }", 1},
    {"plane { point 0 0 0  normal 0 0 1  material m }", 1},
    {"disc { centre 0 0 0  normal 0 0 1  radius 1  material m }", 1},
    {"sphere { centre 0 0 0  radius 1  material m }", 2},
    {"ellipsoid { centre 0 0 0  radii 1 1.5 0.7  material m }", 2},
    {"cylinder { a 0 -1 0  b 0 1 0  radius 0.8  material m }", 2},
    {"torus { centre 0 0 0  axis 1 0 0  major_radius 1  minor_radius 0.4  material m  "
     "translate 0 0 0 }",
     4},
    {"box { centre 0 0 0  size 1 1 1  material m }", 2},
    {"triangle { a -3 -2 0  b 3 -2 0  c 0 4 0  material m }", 1},
    {"mesh octahedron { file \"octahedron.off\" }\n"
     "instance octahedron { material m }\ninstance octahedron { material m  translate 0 0 -5 }",
     4},
};

static void rays_pass_every_shape(void **state)
{
    assert_int_equal(scratch_enter(state), 0);
    scratch_write(
        "octahedron.off",
        "OFF\n6 8 12\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n3 0 2 4\n3 2 1 4\n3 1 3 4\n"
        "3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n");
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        char text[700];
        double means[3];
        snprintf(text, sizeof text,
                 "camera { eye 0.02 0.03 9  look_at 0.02 0.03 0  fov 1 }\n"
                 "material m { opacity 0.3 }\nmaterial wall { emission 1  two_sided true }\n%s\n"
                 "quad { corner -90 -90 -20  edge1 180 0 0  edge2 0 180 0  material wall }\n",
                 shapes[i].shape);
        render_means(means, text, by_path);
        expect_close(means[1], pow(0.7, shapes[i].layers), 0.006, shapes[i].shape);
    }
    scratch_leave(state);
}

/* ---- What lights a floor behind gauze -------------------------------------------------- */

/* Lit by a light alone, and with gauze between; the camera is below that. */
static void expect_shadow(const char *light)
{
    static const char floor[] =
        "camera { eye 0 0.5 2  look_at 0 0 0  fov 20 }\nmaterial m { kd 0.8 }\n"
        "material glow { }\nmaterial gauze { opacity 0.25 }\n"
        "quad { corner -9 0 -9  edge1 0 0 18  edge2 18 0 0  material m }\n";
    static const char gauze[] =
        "quad { corner -9 0.9 -9  edge1 0 0 18  edge2 18 0 0  material gauze }\n";
    const rt_render_options *const modes[] = {&by_path, &by_bpt, &by_photons};
    char text[900];
    double open[3], means[3];
    snprintf(text, sizeof text, "%s%s", floor, light);
    render_means(open, text, by_path);
    snprintf(text, sizeof text, "%s%s%s", floor, light, gauze);
    for (int i = 0; i < 3; i++) {
        render_means(means, text, *modes[i]);
        expect_close(means[1], 0.75 * open[1], 0.03 * open[1], light);
    }
}

static void shadows_are_as_light_as_gauze(void **state)
{
    (void)state;
    expect_shadow("light point { position 0 1.8 0  intensity 10 }\n");
    expect_shadow("light directional { direction 0 -1 0  irradiance 3 }\n");
    expect_shadow(
        "disc { centre 0 1.8 0  normal 0 -1 0  radius 0.5  material glow  radiance 4 }\n");
}

/* Of light on gauze each photon is met as often as the gauze. */
static void merging_on_gauze_has_the_mean_of_paths(void **state)
{
    static const char lit[] =
        "camera { eye 0 2 0.1  look_at 0 0 0  fov 20 }\nmaterial m { kd 0.8  opacity 0.3 }\n"
        "quad { corner -1 0 -1  edge1 0 0 2  edge2 2 0 0  material m }\n"
        "light spot { position 0 1 0  target 0 0 0  intensity 10  outer 40  inner 39 }\n";
    double by_paths[3], means[3];
    (void)state;
    render_means(by_paths, lit, by_path);
    render_means(means, lit,
                 (rt_render_options){.mode = RT_MODE_VCM,
                                     .techniques = RT_TECHNIQUES_BPM,
                                     .spp = 256,
                                     .radius = 0.1f,
                                     .max_depth = 2});
    expect_close(means[1], by_paths[1], 0.08 * by_paths[1], "merging alone");
}

/* A leaf of which a texture is the outline: its shadow is sharp, and nothing is random. */
static void a_texture_is_an_outline(void **state)
{
    static const char scene[] =
        "camera { projection orthographic  width 1  eye 0.5 0.5 9  look_at 0.5 0.5 0 }\n"
        "texture half { pattern gradient  a 0 0 0  b 1 1 1  scale 1 1 }\n"
        "material wall { kd 1 }\nmaterial leaf { opacity_texture half  opacity_cutoff 0.5 }\n"
        "quad { corner -1 -1 0  edge1 3 0 0  edge2 0 3 0  material wall }\n"
        "quad { corner 0 0 1  edge1 1 0 0  edge2 0 1 0  material leaf }\n"
        "light directional { direction 0 0 -1  irradiance 3.14159265 }\n";
    rt_render_options once = {.spp = 1, .width = 16, .height = 16, .max_depth = 2};
    rt_renderer *renderer = test_renderer(scene);
    rt_film *film = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_render(&film, renderer, &once, &error), &error);
    for (int i = 0; i < 16 * 16; i++)
        assert_float_equal(rt_film_rgb(film)[3 * i], i < 8 * 16 ? 0 : 1, 1e-5);
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
}

/* Rays of the library and of paths see the same: holes where the texture has them, many at once. */
static void traced_rays_pass_holes(void **state)
{
    enum { rays = 64 };
    rt_renderer *renderer =
        test_renderer("texture holes { pattern checker  a 1 1 1  b 0 0 0  scale 8 1 }\n"
                      "material leaf { kd 0.5  opacity_texture holes }\nmaterial wall { kd 0.5 }\n"
                      "quad { corner 0 0 1  edge1 8 0 0  edge2 0 1 0  material leaf }\n"
                      "quad { corner 0 0 0  edge1 8 0 0  edge2 0 1 0  material wall }\n");
    rt_ray ray[rays];
    rt_hit hit[rays];
    rt_error error;
    (void)state;
    for (int i = 0; i < rays; i++)
        ray[i] = (rt_ray){
            .origin = {(i + 0.5f) / 8, 0.5f, 2}, .direction = {0, 0, -1}, .t_max = INFINITY};
    expect_ok(rt_trace(renderer, RT_TRACE_CLOSEST, ray, rays, hit, &error), &error);
    for (int i = 0; i < rays; i++) {
        const float expected = i / 8 % 2 == 0 ? 1 : 2;
        assert_float_equal(hit[i].t, expected, 1e-6);
    }
    rt_renderer_destroy(renderer);
}

/* A decal on a face of glass, at the same place: the glass is seen where the decal is not. */
static void a_decal_lies_on_glass(void **state)
{
    static const char *const opacities[] = {"0 0 0", "1 1 1"};
    (void)state;
    for (int i = 0; i < 2; i++) {
        char text[700];
        double means[3];
        snprintf(text, sizeof text,
                 "camera { eye 0 0 5  look_at 0 0 0  fov 2 }\n"
                 "texture all { pattern checker  a %s  b %s }\n"
                 "material glass { kt 1  ior 1.5  fresnel dielectric }\n"
                 "material decal { opacity_texture all }\n"
                 "box { centre 0 0 -0.5  size 2 2 1  material glass }\n"
                 "quad { corner -0.5 -0.5 0  edge1 1 0 0  edge2 0 1 0  material decal }\n"
                 "light environment { radiance 1 }\n",
                 opacities[i], opacities[i]);
        render_means(means, text, (rt_render_options){.spp = 256, .max_depth = 64});
        expect_close(means[1], 1 - i, 0.01, opacities[i]);
        render_means(means, text, (rt_render_options){.mode = RT_MODE_VCM, .spp = 64});
        expect_close(means[1], 1 - i, 0.01, opacities[i]);
    }
}

/* ---- What is scattered ----------------------------------------------------------------- */

/* In a furnace, white gauze is white, whatever finds the light. */
static void white_gauze_is_white(void **state)
{
    static const char furnace[] =
        "camera { eye 0 0 4  look_at 0 0 0  fov 8 }\nmaterial gauze { kd 1  opacity 0.4 }\n"
        "quad { corner -2 -2 0  edge1 4 0 0  edge2 0 4 0  material gauze }\n"
        "light environment { radiance 1 }\n";
    double means[3];
    (void)state;
    render_means(means, furnace, by_path);
    expect_close(means[0], 1, 0.005, "path");
    render_means(
        means, furnace,
        (rt_render_options){
            .mode = RT_MODE_VCM, .spp = 64, .techniques = RT_TECHNIQUES_BPM, .radius = 0.05f});
    expect_close(means[0], 1, 0.005, "merging alone");
    render_means(means, furnace,
                 (rt_render_options){.mode = RT_MODE_PHOTON,
                                     .spp = 64,
                                     .photons = 100000,
                                     .k = 400,
                                     .direct = RT_DIRECT_PHOTONS});
    expect_close(means[0], 1, 0.03, "photons alone");
}

static void cutouts_agree_in_a_room(void **state)
{
    (void)state;
    expect_modes_agree(
        "camera { eye 0 0 3.5  look_at 0 0 0  fov 45 }\n"
        "texture holes { pattern checker  a 1 1 1  b 0 0 0  scale 6 6 }\n"
        "material white { kd 0.7 }\nmaterial leaf { kd 0.2 0.6 0.1  opacity_texture holes }\n"
        "material gauze { kd 0.5 0.3 0.2  opacity 0.4 }\n"
        "box { centre 0 0 2  size 6 6 6  material white }\n"
        "quad { corner -1.2 -0.4 -0.6  edge1 1.2 0 0  edge2 0 0.8 0.8  material leaf }\n"
        "sphere { centre 0.6 0 -0.3  radius 0.6  material gauze }\n"
        "light point { position 0 2 2  intensity 20 }\n");
}

/* ---- What is emitted ------------------------------------------------------------------- */

/* Light sampling and BSDF sampling see the same of cutouts that emit, and photons as well. */
static void a_cutout_emits_by_its_opacity(void **state)
{
    static const char *const lamps[] = {
        "quad { corner -0.5 1.5 -0.5  edge1 1 0 0  edge2 0 0 1  material lamp  radiance 4 }\n",
        "disc { centre 0 1.5 0  normal 0 -1 0  radius 0.6  material lamp  radiance 4 }\n",
        "sphere { centre 0 1.5 0  radius 0.4  material lamp  radiance 4 }\n"};
    (void)state;
    for (int i = 0; i < 3; i++) {
        char text[700];
        double by_light[3], means[3];
        snprintf(text, sizeof text,
                 "camera { eye 0 0.5 2  look_at 0 0 0  fov 20 }\nmaterial m { kd 0.8 }\n"
                 "texture fade { pattern gradient  a 0.2 0.2 0.2  b 0.6 0.6 0.6 }\n"
                 "material lamp { opacity_texture fade  two_sided true }\n"
                 "quad { corner -9 0 -9  edge1 0 0 18  edge2 18 0 0  material m }\n%s",
                 lamps[i]);
        render_means(by_light, text,
                     (rt_render_options){.spp = 1024, .estimator = RT_ESTIMATOR_LIGHT});
        render_means(means, text, (rt_render_options){.spp = 2048, .estimator = RT_ESTIMATOR_BSDF});
        expect_close(means[1], by_light[1], 0.02 * by_light[1], lamps[i]);
        render_means(means, text, by_bpt);
        expect_close(means[1], by_light[1], 0.02 * by_light[1], lamps[i]);
        render_means(means, text, by_photons);
        expect_close(means[1], by_light[1], 0.03 * by_light[1], lamps[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(rays_pass_every_shape),
        cmocka_unit_test(traced_rays_pass_holes),
        statistical_test(shadows_are_as_light_as_gauze),
        statistical_test(merging_on_gauze_has_the_mean_of_paths),
        cmocka_unit_test(a_texture_is_an_outline),
        statistical_test(a_decal_lies_on_glass),
        statistical_test(white_gauze_is_white),
        statistical_test(cutouts_agree_in_a_room),
        statistical_test(a_cutout_emits_by_its_opacity),
    };
    return cmocka_run_group_tests_name("lib/render/opacity", tests, NULL, NULL);
}
