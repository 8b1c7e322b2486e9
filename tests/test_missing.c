/*
 * test_missing.c - NULL for an object, a path or a text makes each call of rt.h that returns
 * rt_status fail and name what is missing. tests/test_missing.sh finds the calls that are not here.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "rt.h"

static const char text[] = "camera { eye 0 1 -4  look_at 0 1 0  fov 40 }\n"
                           "film { width 4  height 3 }\n"
                           "material white { kd 0.7 }\n"
                           "sphere { centre 0 1 0  radius 1  material white }\n"
                           "light point { position 2 4 -3  intensity 20 }\n";

/* One of each object, so that only what is meant to be missing is. */
static rt_scene *scene;
static rt_device *device;
static rt_renderer *renderer;
static rt_film *film;
static rt_film_saver *saver;
static rt_photon_map *map;
static rt_image *image;
static rt_comparison *comparison;
static rt_share *share;
static rt_profile *profile;
static rt_memory *memory;
static rt_render_options options;
static uint32_t worker;

static rt_error error;

static void expect_ok(rt_status status)
{
    if (status != RT_OK)
        fail_msg("%s", error.message);
}

static int setup(void **state)
{
    const rt_device_options chosen = {.select = getenv("RT_TEST_DEVICE")};
    const rt_render_options few = {.mode = RT_MODE_PHOTON, .photons = 100};
    const rt_emit_options emission = {.render = &few};
    const float black[3] = {0, 0, 0};
    (void)state;
    expect_ok(rt_scene_parse(&scene, text, "test", NULL, &error));
    expect_ok(rt_device_open(&device, &chosen, &error));
    expect_ok(rt_renderer_create(&renderer, scene, device, NULL, &error));
    rt_scene_get_options(scene, &options);
    options.spp = 1;
    expect_ok(rt_share_create(&share, renderer, &options, &error));
    expect_ok(rt_share_join(&worker, share, &error));
    options.part = options.parts = 1;
    expect_ok(rt_render(&film, renderer, &options, &error));
    options.part = options.parts = 0;
    expect_ok(rt_film_saver_create(&saver, "never.rtpart", &error));
    expect_ok(rt_photon_map_emit(&map, renderer, &emission, &error));
    expect_ok(rt_image_from_rgb(&image, black, 1, 1, &error));
    const rt_image *const images[] = {image};
    expect_ok(rt_image_compare(&comparison, images, 1, image, NULL, &error));
    expect_ok(rt_profile_create(&profile, 0, &error));
    expect_ok(rt_memory_create(&memory, 0, &error));
    expect_ok(rt_memory_take(memory, 1, "the test", &error));
    return 0;
}

static int teardown(void **state)
{
    (void)state;
    rt_memory_give(memory, 1, "the test");
    rt_memory_destroy(memory);
    rt_profile_destroy(profile);
    rt_comparison_destroy(comparison);
    rt_image_destroy(image);
    rt_photon_map_destroy(map);
    rt_film_saver_destroy(saver);
    rt_film_destroy(film);
    rt_share_destroy(share);
    rt_renderer_destroy(renderer);
    rt_device_close(device);
    rt_scene_destroy(scene);
    return 0;
}

static void expect_missing(rt_status status, const char *call, const char *name)
{
    if (status != RT_ERROR_USAGE || error.status != RT_ERROR_USAGE ||
        strcmp(error.field, name) != 0 || !strstr(error.message, "is NULL"))
        fail_msg("%s without %s: status %d, field '%s': %s", call, name, (int)status, error.field,
                 error.message);
}

/* The call fails and names the parameter. */
#define MISSING(call, parameter, arguments)                                                        \
    (memset(&error, 0, sizeof error), expect_missing(call arguments, #call, #parameter))

static void scenes_and_renderers(void **state)
{
    rt_scene *made = NULL;
    rt_renderer *ready = NULL;
    rt_ray_counts rays;
    char *again = NULL;
    uint32_t mesh;
    (void)state;
    MISSING(rt_scene_load, path, (&made, NULL, NULL, &error));
    MISSING(rt_scene_import, path, (&made, "a.rts", NULL, NULL, &error));
    MISSING(rt_scene_parse, text, (&made, NULL, "name", NULL, &error));
    MISSING(rt_scene_format, text, (&again, NULL, "name", NULL, &error));
    MISSING(rt_scene_load_mesh, path, (scene, &mesh, NULL, RT_SHADING_FILE, NULL, &error));
    MISSING(rt_renderer_create, scene, (&ready, NULL, device, NULL, &error));
    MISSING(rt_renderer_create, device, (&ready, scene, NULL, NULL, &error));
    MISSING(rt_renderer_get_rays, renderer, (NULL, &rays, &error));
    MISSING(rt_trace, renderer, (NULL, RT_TRACE_ANY, NULL, 0, NULL, &error));
    MISSING(rt_device_compile, device, (NULL, NULL, NULL, &error));
    MISSING(rt_setting_set, options, (NULL, rt_setting_find("spp"), "4", &error));
    MISSING(rt_setting_set, setting, (&options, NULL, "4", &error));
    MISSING(rt_setting_set, text, (&options, rt_setting_find("spp"), NULL, &error));
    MISSING(rt_render_options_check, options, (NULL, &error));
    MISSING(rt_denoise_options_check, options, (NULL, &error));
    assert_true(!made && !ready && !again);
}

static void films(void **state)
{
    rt_film *made = NULL;
    rt_film_saver *kept = NULL;
    rt_paths *paths = NULL;
    size_t size;
    uint64_t first, count;
    uint32_t channels;
    float rgb[3 * 4 * 3];
    (void)state;
    MISSING(rt_render, renderer, (&made, NULL, &options, &error));
    MISSING(rt_film_denoise, film, (NULL, renderer, NULL, &error));
    MISSING(rt_film_denoise, renderer, (film, NULL, NULL, &error));
    MISSING(rt_film_preview, film, (rgb, NULL, NULL, &channels, &error));
    MISSING(rt_film_write, film, (NULL, "a.exr", NULL, &error));
    MISSING(rt_film_write, path, (film, NULL, NULL, &error));
    MISSING(rt_film_save, film, (NULL, "a.rtpart", &error));
    MISSING(rt_film_save, path, (film, NULL, &error));
    MISSING(rt_film_load, path, (&made, NULL, NULL, &error));
    MISSING(rt_film_saver_create, path, (&kept, NULL, &error));
    MISSING(rt_film_saver_put, saver, (NULL, film, &error));
    MISSING(rt_film_saver_put, film, (saver, NULL, &error));
    MISSING(rt_film_saver_wait, saver, (NULL, &error));
    MISSING(rt_film_encode, film, (NULL, NULL, 0, &size, &error));
    MISSING(rt_film_decode, data, (&made, NULL, 8, &error));
    MISSING(rt_film_send, film, (NULL, -1, &error));
    MISSING(rt_film_add, film, (NULL, film, &error));
    MISSING(rt_film_add, other, (film, NULL, &error));
    MISSING(rt_film_covers, film, (NULL, film, &error));
    MISSING(rt_film_covers, other, (film, NULL, &error));
    MISSING(rt_film_begin, renderer, (&made, NULL, &options, &error));
    MISSING(rt_film_resolve, film, (NULL, NULL, &error));
    MISSING(rt_chunk_count, options, (&count, NULL, &error));
    MISSING(rt_chunk_units, options, (&first, &count, NULL, 0, 1, &error));
    MISSING(rt_chunk_task, options, (&first, &count, NULL, 0, 1, &error));
    MISSING(rt_chunk_render, renderer, (&made, NULL, &options, 0, 1, &error));
    MISSING(rt_paths_trace, renderer, (&paths, NULL, &options, 0, 0, 0, 1, &error));
    assert_true(!made && !kept && !paths);
}

static void photon_maps(void **state)
{
    static const rt_photon_map *const none[] = {NULL};
    rt_photon_map *made = NULL;
    rt_photon_reading reading;
    size_t size;
    float v[3] = {0, 0, 1};
    (void)state;
    MISSING(rt_photon_map_emit, renderer, (&made, NULL, NULL, &error));
    MISSING(rt_photon_map_covers, map, (NULL, map, &error));
    MISSING(rt_photon_map_covers, other, (map, NULL, &error));
    MISSING(rt_photon_map_emit_covers, renderer, (NULL, NULL, map, &error));
    MISSING(rt_photon_map_emit_covers, other, (renderer, NULL, NULL, &error));
    MISSING(rt_photon_map_irradiance, map, (v, NULL, device, v, v, 1, NULL, &error));
    MISSING(rt_photon_map_irradiance, device, (v, map, NULL, v, v, 1, NULL, &error));
    MISSING(rt_photon_map_illuminance, map, (&reading, NULL, v, v, 1, 1, NULL, &error));
    MISSING(rt_photon_map_merge, map, (&made, none, 1, &error));
    MISSING(rt_photon_map_save, map, (NULL, "a.rtp", &error));
    MISSING(rt_photon_map_save, path, (map, NULL, &error));
    MISSING(rt_photon_map_load, path, (&made, NULL, &error));
    MISSING(rt_photon_map_load_in, path, (&made, NULL, NULL, &error));
    MISSING(rt_photon_map_encode, map, (NULL, NULL, 0, &size, &error));
    MISSING(rt_photon_map_decode, data, (&made, NULL, 8, NULL, &error));
    MISSING(rt_photon_map_export, map, (NULL, "a.ply", &error));
    MISSING(rt_photon_map_export, path, (map, NULL, &error));
    assert_null(made);
}

static void images_and_files(void **state)
{
    static const rt_image *const none[] = {NULL};
    const rt_image *const images[] = {image};
    rt_image *made = NULL;
    rt_comparison *measured = NULL;
    char *text = NULL;
    size_t size;
    float v[3];
    (void)state;
    MISSING(rt_file_load, path, (&text, &size, NULL, 9, &error));
    MISSING(rt_file_write, path, (NULL, "", 0, &error));
    MISSING(rt_file_write_another, path, (NULL, "", 0, &error));
    MISSING(rt_image_read, path, (&made, NULL, &error));
    MISSING(rt_image_get_rgb, image, (v, NULL, NULL, &error));
    MISSING(rt_image_write, image, (NULL, "a.exr", NULL, &error));
    MISSING(rt_image_write, path, (image, NULL, NULL, &error));
    MISSING(rt_image_compare, image, (&measured, none, 1, image, NULL, &error));
    MISSING(rt_image_compare, reference, (&measured, images, 1, NULL, NULL, &error));
    MISSING(rt_comparison_write_difference, comparison, (NULL, "a.exr", 0, &error));
    MISSING(rt_comparison_write_difference, path, (comparison, NULL, 0, &error));
    MISSING(rt_memory_take, what, (memory, 1, NULL, &error));
    MISSING(rt_profile_write, profile, (NULL, "a.json", &error));
    MISSING(rt_profile_write, path, (profile, NULL, &error));
    assert_true(!made && !measured);
}

/* And none of it ends the share, which still has all units to hand out. */
static void shares(void **state)
{
    rt_share *made = NULL;
    rt_film *whole = NULL;
    uint32_t number;
    uint64_t first, count;
    (void)state;
    MISSING(rt_share_create, renderer, (&made, NULL, &options, &error));
    MISSING(rt_share_create, options, (&made, renderer, NULL, &error));
    MISSING(rt_share_join, share, (&number, NULL, &error));
    MISSING(rt_share_add, share, (NULL, worker, film, 0, &error));
    MISSING(rt_share_add, film, (share, worker, NULL, 0, &error));
    MISSING(rt_share_render, share, (NULL, renderer, NULL, &error));
    MISSING(rt_share_render, renderer, (share, NULL, NULL, &error));
    MISSING(rt_share_finish, share, (&whole, NULL, NULL, &error));
    assert_true(!made && !whole);
    assert_int_equal(rt_share_ask(share, worker, &first, &count), RT_SHARE_RENDER);
    /* One that has left gets nothing more. */
    rt_share_leave(share, worker);
    assert_int_equal(rt_share_ask(share, worker, &first, &count), RT_SHARE_END);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_and_renderers),
        cmocka_unit_test(films),
        cmocka_unit_test(photon_maps),
        cmocka_unit_test(images_and_files),
        cmocka_unit_test(shares),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
