/* emitted.c - photon maps of a room, by the public interface. */
#include "lib/photon/emitted.h"

#include "photon/map_file.h"
#include "support.h"

rt_renderer *renderer_on(rt_device *device, const char *text, rt_accel accel)
{
    rt_renderer_options options = {.accel = accel};
    rt_renderer *renderer = NULL;
    rt_scene *scene = NULL;
    rt_error error;
    expect_ok(rt_scene_parse(&scene, text, "test", NULL, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, device, &options, &error), &error);
    rt_scene_destroy(scene);
    return renderer;
}

rt_photon_map *emit_map(rt_renderer *renderer, const rt_emit_options *options)
{
    rt_photon_map *map = NULL;
    rt_error error;
    expect_ok(rt_photon_map_emit(&map, renderer, options, &error), &error);
    return map;
}

void expect_same_map(const rt_photon_map *a, const rt_photon_map *b)
{
    rt_bytes x = {0}, y = {0};
    rt_error error;
    expect_ok(rt_photon_map_encode_in(&x, a, &error), &error);
    expect_ok(rt_photon_map_encode_in(&y, b, &error), &error);
    assert_int_equal(x.size, y.size);
    assert_memory_equal(x.data, y.data, x.size);
    rt_bytes_free(&x);
    rt_bytes_free(&y);
}
