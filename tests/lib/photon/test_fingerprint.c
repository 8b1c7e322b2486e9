/*
 * test_fingerprint.c - fingerprints differ exactly where scenes differ in what photons depend on.
 */
#include "support.h"

#include <stdio.h>

#include "base/wire.h"
#include "lib/image/scratch.h"
#include "lib/photon/emitted.h"
#include "photon/fingerprint.h"
#include "render/renderer.h"

static uint64_t fingerprint(const char *text, rt_accel accel)
{
    rt_render_options render = {.photons = 1};
    rt_emit_options options = {.render = &render};
    rt_photon_map_info info;
    rt_renderer *renderer = renderer_on(test_device(), text, accel);
    rt_photon_map *map = emit_map(renderer, &options);
    rt_photon_map_get_info(map, &info);
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
    return info.scene;
}

/* Images and meshes that differ in one thing each. */
static void write_parts(void)
{
    scratch_write("grey.ppm", "P3 2 1 255  128 128 128  255 255 255\n");
    scratch_write("white.ppm", "P3 2 1 255  255 255 255  255 255 255\n");
    scratch_write("plain.obj", "v 0 0 0\nv 0.15 0 0\nv 0 0.1 0\nf 1 2 3\n");
    scratch_write("wide.obj", "v 0 0 0\nv 0.2 0 0\nv 0 0.1 0\nf 1 2 3\n");
    scratch_write("smooth.obj",
                  "v 0 0 0\nv 0.15 0 0\nv 0 0.1 0\nvn 0 0 1\nvn 0 1 1\nf 1//1 2//2 3//1\n");
    scratch_write("smoother.obj",
                  "v 0 0 0\nv 0.15 0 0\nv 0 0.1 0\nvn 0 0 1\nvn 0 1 2\nf 1//1 2//2 3//1\n");
    scratch_write("mapped.obj", "v 0 0 0\nv 0.15 0 0\nv 0 0.1 0\nvt 0 0\nvt 1 1\nf 1/1 2/2 3/1\n");
    scratch_write("red.obj", "v 0 0 0 1 0 0\nv 0.15 0 0 1 0 0\nv 0 0.1 0 1 0 0\nf 1 2 3\n");
    scratch_write("green.obj", "v 0 0 0 1 0 0\nv 0.15 0 0 1 0 0\nv 0 0.1 0 0 1 0\nf 1 2 3\n");
}

/* A grid of one voxel of this density. */
static void write_grid(const char *name, float density)
{
    uint8_t data[24] = "RTGRID1\n\1\0\0\0\1\0\0\0\1\0\0\0";
    rt_put_floats(&(rt_writer){data + 20}, &density, 1);
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, sizeof data, file), sizeof data);
    assert_int_equal(fclose(file), 0);
}

/* Scenes that photons tell apart. */
static const char *const others[] = {
    ROOM "light point { position 0 0 0.5  power 1 }\n",
    ROOM "triangle { a 0 0 0  b 0.1 0 0  c 0 0.1 0  material wall }\n",
    ROOM "triangle { a 0 0 0  b 0.1 0 0  c 0 0.2 0  material wall }\n",
    ROOM "triangle { a 0 0 0  b 0.1 0 0  c 0 0.1 0  material glass }\n",
    ROOM "quad { corner 0 0 0  edge1 0.1 0 0  edge2 0 0.1 0  material wall }\n",
    ROOM "plane { point 0 -3 0  normal 0 1 0  material wall }\n",
    ROOM "ellipsoid { centre 0 0 0  radii 0.1 0.2 0.3  material wall }\n",
    ROOM "ellipsoid { centre 0 0 0  radii 0.1 0.2 0.3  material wall  rotate 0 1 0 5 }\n",
    ROOM "texture t { pattern checker  a 1  b 0.5 }  sphere { centre 0 0 0  radius 0.1  "
         "material wall  texture t }\n",
    ROOM "texture t { pattern checker  a 1  b 0.4 }  sphere { centre 0 0 0  radius 0.1  "
         "material wall  texture t }\n",
    ROOM "texture t { file \"grey.ppm\" }  sphere { centre 0 0 0  radius 0.1  material wall  "
         "texture t }\n",
    ROOM "texture t { file \"white.ppm\" }  sphere { centre 0 0 0  radius 0.1  material wall  "
         "texture t }\n",
    ROOM "light environment { radiance 1 }\n",
    ROOM "light environment { file \"grey.ppm\" }\n",
    ROOM "light environment { file \"white.ppm\" }\n",
    ROOM "light environment { file \"white.ppm\"  rotation 90 }\n",
    ROOM "light environment { file \"white.ppm\"  rotate 1 0 0 20 }\n",
    ROOM "light environment { file \"white.ppm\"  rotate 1 0 0 20  scale -1 1 1 }\n",
    ROOM "light goniometric { position 0 0 0  target 0 1 0  file \"grey.ppm\" }\n",
    ROOM "light goniometric { position 0 0 0  target 0 1 0  file \"white.ppm\" }\n",
    ROOM "light goniometric { position 0 0 0  target 0 1 0  file \"white.ppm\"  filter "
         "nearest }\n",
    ROOM "light goniometric { position 0 0 0  target 0 1 0  file \"white.ppm\"  up 1 0 0 }\n",
    ROOM "light projector { position 0 0 0  target 0 1 0  file \"white.ppm\"  intensity 1 }\n",
    ROOM "light projector { position 0 0 0  target 0 1 0  file \"white.ppm\"  irradiance 1 }\n",
    ROOM "light projector { position 0 0 0  target 0 1 0  file \"white.ppm\"  irradiance 1  fov "
         "50 }\n",
    ROOM "model { file \"plain.obj\"  material wall }\n",
    ROOM "model { file \"smooth.obj\"  material wall }\n",
    ROOM "model { file \"smoother.obj\"  material wall }\n",
    ROOM "model { file \"mapped.obj\"  material wall }\n",
    ROOM "model { file \"red.obj\"  material wall }\n",
    ROOM "model { file \"green.obj\"  material wall }\n",
    ROOM "mesh m { file \"plain.obj\" }  instance m { material wall }  instance m { material "
         "wall  scale 0.5 }\n",
    ROOM "mesh m { file \"plain.obj\" }  instance m { material wall }  instance m { material "
         "wall  scale 0.6 }\n",
    ROOM "mesh m { file \"wide.obj\" }  instance m { material wall }  instance m { material "
         "wall  scale 0.5 }\n",
};

static void scenes_are_told_apart_by_what_photons_see(void **state)
{
    enum { count = sizeof others / sizeof *others };
    uint64_t seen[count + 1] = {fingerprint(ROOM, RT_ACCEL_BVH)};
    (void)state;
    write_parts();
    assert_true(fingerprint(ROOM, RT_ACCEL_NONE) == seen[0]);
    assert_true(fingerprint(ROOM "camera { eye 0 0 1  look_at 0 0 0 }\n", RT_ACCEL_BVH) == seen[0]);
    assert_true(fingerprint(others[1], RT_ACCEL_NONE) == fingerprint(others[1], RT_ACCEL_BVH));
    for (int i = 1; i <= count; i++) {
        seen[i] = fingerprint(others[i - 1], RT_ACCEL_BVH);
        for (int j = 0; j < i; j++)
            assert_true(seen[i] != seen[j]);
    }
}

/* Films, too, are told apart by them, and no photon map is made in a grid. */
static uint64_t fingerprint_of_picture(const char *text)
{
    rt_renderer *renderer = test_renderer(text);
    uint64_t print = 0;
    rt_error error;
    expect_ok(rt_picture_fingerprint(&print, test_device(), renderer->scene, &error), &error);
    rt_renderer_destroy(renderer);
    return print;
}

static void grids_are_told_apart(void **state)
{
    static const char *const scenes[] = {
        ROOM "medium { scattering 1 }\n",
        ROOM "grid g { file \"thin.grid\" }  medium { scattering 1  density g }\n",
        ROOM "grid g { file \"thick.grid\" }  medium { scattering 1  density g }\n",
        ROOM "grid g { file \"thin.grid\"  scale 2 }  medium { scattering 1  density g }\n",
        ROOM "grid g { file \"thin.grid\" }  medium { scattering 1  albedo g }\n",
        ROOM "grid g { file \"thin.grid\"  wrap repeat }  medium { scattering 1  albedo g }\n",
        ROOM "grid g { file \"half.grid\" }  medium { scattering 1  albedo g }\n",
    };
    enum { count = sizeof scenes / sizeof *scenes };
    uint64_t seen[count];
    (void)state;
    write_grid("thin.grid", 1);
    write_grid("thick.grid", 2);
    write_grid("half.grid", 0.5f);
    for (int i = 0; i < count; i++) {
        seen[i] = fingerprint_of_picture(scenes[i]);
        for (int j = 0; j < i; j++)
            assert_true(seen[i] != seen[j]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(scenes_are_told_apart_by_what_photons_see, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(grids_are_told_apart, scratch_enter, scratch_leave),
    };
    return cmocka_run_group_tests_name("lib/photon/fingerprint", tests, NULL, NULL);
}
