/* photon_room.c - the room, its options and renders. */
#include "lib/mode/photon_room.h"

#include <string.h>

#include "chance.h"
#include "support.h"

uint32_t room_material(rt_scene *scene, float kd, float ks, float kt)
{
    rt_material material = {.kd = {kd, kd, kd},
                            .ks = {ks, ks, ks},
                            .kt = {kt, kt, kt},
                            .ior = 1.5f,
                            .fresnel = kt > 0 ? RT_FRESNEL_DIELECTRIC : RT_FRESNEL_OFF};
    uint32_t index = 0;
    rt_error error;
    expect_ok(rt_scene_add_material(scene, &index, NULL, &material, &error), &error);
    return index;
}

void room_quad(rt_scene *scene, uint32_t material, float radiance, const float c[3],
               const float a[3], const float b[3])
{
    rt_surface surface = {.material = material, .radiance = {radiance, radiance, radiance}};
    rt_error error;
    expect_ok(rt_scene_add_quad(scene, NULL, c, a, b, &surface, &error), &error);
}

rt_renderer *room_renderer(rt_device *device)
{
    const float x[3] = {2, 0, 0}, y[3] = {0, 2, 0}, z[3] = {0, 0, 2}, low[3] = {-1, -1, -1},
                high[3] = {-1, 1, -1}, back[3] = {-1, -1, 1}, right[3] = {1, -1, -1},
                emitter[3] = {-0.5f, 0.99f, -0.5f}, emitter_x[3] = {1, 0, 0},
                emitter_z[3] = {0, 0, 1}, mirror[3] = {-0.5f, -0.6f, 0.3f},
                glass[3] = {0.5f, -0.6f, 0};
    rt_camera camera = {.eye = {0, 0, -4}, .fov = 40};
    rt_renderer *renderer = NULL;
    rt_scene *scene = NULL;
    rt_error error;

    expect_ok(rt_scene_create(&scene, &error), &error);
    uint32_t walls = room_material(scene, 0.5f, 0, 0), black = room_material(scene, 0, 0, 0);
    rt_surface silver = {.material = room_material(scene, 0, 0.9f, 0)};
    rt_surface clear = {.material = room_material(scene, 0, 0, 1)};
    room_quad(scene, walls, 0, low, x, z);
    room_quad(scene, walls, 0, high, x, z);
    room_quad(scene, walls, 0, back, x, y);
    room_quad(scene, walls, 0, low, y, z);
    room_quad(scene, walls, 0, right, y, z);
    room_quad(scene, black, 5, emitter, emitter_x, emitter_z);
    expect_ok(rt_scene_add_sphere(scene, NULL, mirror, 0.4f, &silver, &error), &error);
    expect_ok(rt_scene_add_sphere(scene, NULL, glass, 0.4f, &clear, &error), &error);
    expect_ok(rt_scene_set_camera(scene, &camera, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, device, NULL, &error), &error);
    rt_scene_destroy(scene);
    return renderer;
}

rt_render_options room_options(void)
{
    rt_render_options options;
    memset(&options, 0, sizeof options);
    options.width = options.height = side;
    options.mode = RT_MODE_PHOTON;
    options.spp = 16;
    options.photons = 300000;
    options.seed = test_seed(4);
    return options;
}

rt_film *room_render(rt_renderer *renderer, const rt_render_options *options)
{
    rt_film *film = NULL;
    rt_error error;
    expect_ok(rt_render(&film, renderer, options, &error), &error);
    return film;
}
