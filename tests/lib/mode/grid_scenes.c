/* grid_scenes.c - scenes with media on grids. */
#include "lib/mode/grid_scenes.h"

#include <string.h>

#include "support.h"

const float smoke_absorption[3] = {0.1f, 0.4f, 0.6f}, smoke_scattering[3] = {0.5f, 0.2f, 1.8f};

rt_renderer *foggy_renderer(const char *text, const rt_grid *grid, int is_white)
{
    rt_scene *scene = NULL;
    rt_renderer *renderer = NULL;
    rt_medium medium = {.g = 0.5f};
    rt_error error;
    if (!is_white)
        memcpy(medium.absorption, smoke_absorption, sizeof smoke_absorption);
    memcpy(medium.scattering, smoke_scattering, sizeof smoke_scattering);
    expect_ok(rt_scene_parse(&scene, text, "test", NULL, &error), &error);
    expect_ok(rt_scene_add_grid(scene, &medium.density, grid, &error), &error);
    expect_ok(rt_scene_set_medium(scene, &medium, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    rt_scene_destroy(scene);
    return renderer;
}

rt_renderer *coloured_renderer(const char *text, const rt_grid *grid, const rt_grid *albedo)
{
    rt_scene *scene = NULL;
    rt_renderer *renderer = NULL;
    rt_medium medium = {.g = 0.5f};
    rt_error error;
    memcpy(medium.absorption, smoke_absorption, sizeof smoke_absorption);
    memcpy(medium.scattering, smoke_scattering, sizeof smoke_scattering);
    expect_ok(rt_scene_parse(&scene, text, "test", NULL, &error), &error);
    if (grid)
        expect_ok(rt_scene_add_grid(scene, &medium.density, grid, &error), &error);
    expect_ok(rt_scene_add_grid(scene, &medium.albedo, albedo, &error), &error);
    expect_ok(rt_scene_set_medium(scene, &medium, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    rt_scene_destroy(scene);
    return renderer;
}

rt_renderer *smoky_renderer(const char *text, const rt_grid *grid)
{
    rt_scene *scene = NULL;
    rt_renderer *renderer = NULL;
    rt_material smoke = {.interface = 1, .g = 0.4f};
    rt_surface surface = {0};
    rt_error error;
    for (int c = 0; c < 3; c++) {
        smoke.absorption[c] = 2 * smoke_absorption[c];
        smoke.scattering[c] = 2 * smoke_scattering[c];
    }
    expect_ok(rt_scene_parse(&scene, text, "test", NULL, &error), &error);
    if (grid)
        expect_ok(rt_scene_add_grid(scene, &smoke.density, grid, &error), &error);
    expect_ok(rt_scene_add_material(scene, &surface.material, "smoke", &smoke, &error), &error);
    expect_ok(rt_scene_add_box(scene, NULL, (float[]){0, 0.7f, 0}, (float[]){1.4f, 1, 1.2f},
                               &surface, &error),
              &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    rt_scene_destroy(scene);
    return renderer;
}
