/* test_api.c - the contracts that rt.h states, through rt.h alone. */
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
                           "film { width 16  height 12 }\n"
                           "material white { kd 0.7 }\n"
                           "plane { point 0 0 0  normal 0 1 0  material white }\n"
                           "sphere { centre 0 1 0  radius 1  material white }\n"
                           "light point { position 2 4 -3  intensity 20 }\n";

/* What most tests use: a scene, the device, and the scene on it. */
typedef struct fixture {
    rt_scene *scene;
    rt_device *device;
    rt_renderer *renderer;
} fixture;

static void expect_ok(rt_status status, const rt_error *error)
{
    if (status != RT_OK)
        fail_msg("%s", error->message);
}

static int setup(void **state)
{
    static fixture fixture;
    rt_device_options options = {.select = getenv("RT_TEST_DEVICE")};
    rt_error error;
    expect_ok(rt_scene_parse(&fixture.scene, text, "test", NULL, &error), &error);
    expect_ok(rt_device_open(&fixture.device, &options, &error), &error);
    expect_ok(rt_renderer_create(&fixture.renderer, fixture.scene, fixture.device, NULL, &error),
              &error);
    *state = &fixture;
    return 0;
}

static int teardown(void **state)
{
    fixture *fixture = *state;
    rt_renderer_destroy(fixture->renderer);
    rt_device_close(fixture->device);
    rt_scene_destroy(fixture->scene);
    return 0;
}

/* ---- Names and errors -------------------------------------------------------- */

static void version_is_that_of_the_header(void **state)
{
    (void)state;
    char version[32];
    snprintf(version, sizeof version, "%d.%d.%d", RT_VERSION_MAJOR, RT_VERSION_MINOR,
             RT_VERSION_PATCH);
    assert_string_equal(rt_version(), version);
}

static void stages_have_names(void **state)
{
    (void)state;
    static const char *const names[] = {"load", "build", "compile", "emit", "gather", "render"};
    for (int stage = RT_STAGE_LOAD; stage <= RT_STAGE_RENDER; stage++)
        assert_string_equal(rt_stage_name((rt_stage)stage), names[stage]);
}

static void destroying_null_does_nothing(void **state)
{
    (void)state;
    rt_film_destroy(NULL);
    rt_renderer_destroy(NULL);
    rt_device_close(NULL);
    rt_scene_destroy(NULL);
    rt_devices_free(NULL);
}

static void failure_fills_the_error_and_leaves_the_result(void **state)
{
    (void)state;
    rt_scene *untouched = (rt_scene *)&untouched, *scene = untouched;
    rt_error error;
    memset(&error, 0xff, sizeof error);
    assert_int_equal(rt_scene_parse(&scene, "film {\n  widht 3 }\n", "name", NULL, &error),
                     RT_ERROR_INPUT);
    assert_ptr_equal(scene, untouched);
    assert_int_equal(error.status, RT_ERROR_INPUT);
    assert_string_equal(error.file, "name");
    assert_int_equal(error.line, 2);
    assert_int_equal(error.column, 3);
    assert_non_null(strstr(error.message, "widht"));
    assert_null(strchr(error.message, '\n'));
}

static void a_text_without_a_name_is_called_text(void **state)
{
    (void)state;
    rt_scene *scene;
    rt_error error;
    assert_int_equal(rt_scene_parse(&scene, "nonsense", NULL, NULL, &error), RT_ERROR_INPUT);
    assert_string_equal(error.file, "text");
}

static void error_may_be_null(void **state)
{
    (void)state;
    rt_scene *scene;
    rt_device *device;
    rt_device_options options = {.select = "no such device"};
    assert_int_equal(rt_scene_parse(&scene, "nonsense", "name", NULL, NULL), RT_ERROR_INPUT);
    assert_int_equal(rt_scene_load(&scene, "/no/such/file.rts", NULL, NULL), RT_ERROR_INPUT);
    assert_int_equal(rt_device_open(&device, &options, NULL), RT_ERROR_DEVICE);
}

/*
 * A file that is not there, is no file, or holds something else; and places that cannot be written.
 */
static void errors_name_the_file_at_fault(void **state)
{
    const fixture *fixture = *state;
    static const char *const unreadable[] = {"/nowhere/file", "/dev/null", "."};
    rt_photon_map *map = NULL;
    rt_image *image = NULL;
    uint32_t handle;
    const float grey[3] = {1, 1, 1};
    rt_error e;
    for (size_t i = 0; i < sizeof unreadable / sizeof *unreadable; i++) {
        const char *path = unreadable[i];
        rt_texture texture = {.path = path};
        rt_environment environment = {.path = path};
        assert_int_equal(rt_image_read(&image, path, &e), RT_ERROR_INPUT);
        assert_string_equal(e.file, path);
        assert_int_equal(rt_photon_map_load(&map, path, &e), RT_ERROR_INPUT);
        assert_string_equal(e.file, path);
        assert_int_equal(
            rt_scene_load_mesh(fixture->scene, &handle, path, RT_SHADING_FILE, NULL, &e),
            RT_ERROR_INPUT);
        assert_string_equal(e.file, path);
        assert_int_equal(rt_scene_add_texture(fixture->scene, &handle, &texture, &e),
                         RT_ERROR_INPUT);
        assert_string_equal(e.file, path);
        assert_string_equal(e.field, "path");
        assert_int_equal(rt_scene_set_environment(fixture->scene, &environment, &e),
                         RT_ERROR_INPUT);
        assert_string_equal(e.file, path);
    }
    expect_ok(rt_image_from_rgb(&image, grey, 1, 1, &e), &e);
    assert_int_equal(rt_image_write(image, "/nowhere/a.png", NULL, &e), RT_ERROR_OUTPUT);
    assert_string_equal(e.file, "/nowhere/a.png");
    assert_int_equal(rt_file_write("/nowhere/a", "", 0, &e), RT_ERROR_OUTPUT);
    assert_string_equal(e.file, "/nowhere/a");
    rt_image_destroy(image);
}

static void count_diagnostic(void *user, const rt_diagnostic *diagnostic)
{
    int *count = user;
    assert_true(diagnostic->line >= 1 && diagnostic->column >= 1 && diagnostic->length >= 1);
    assert_string_equal(diagnostic->file, "name");
    assert_non_null(diagnostic->source_line);
    *count += diagnostic->severity == RT_SEVERITY_ERROR;
}

static void every_error_of_a_text_is_reported(void **state)
{
    (void)state;
    int count = 0;
    rt_scene *scene;
    rt_error error;
    rt_load_options options = {.diagnostic = count_diagnostic, .user = &count};
    static const char bad[] = "a { }\nb { }\nfilm { c 1 }\nfilm { width -1 }\n";
    assert_int_equal(rt_scene_parse(&scene, bad, "name", &options, &error), RT_ERROR_INPUT);
    assert_true(count >= 4);
    assert_int_equal(error.line, 1);
}

static void options_out_of_range_name_their_field(void **state)
{
    fixture *fixture = *state;
    rt_film *film = NULL;
    rt_render_options options = {0};
    rt_error error;
    options.k = 1;
    options.mode = RT_MODE_PHOTON;
    assert_int_equal(rt_render(&film, fixture->renderer, &options, &error), RT_ERROR_USAGE);
    assert_string_equal(error.field, "k");
    assert_null(film);
    assert_int_equal(rt_scene_set_options(fixture->scene, &options, &error), RT_ERROR_USAGE);
    assert_string_equal(error.field, "k");
}

/* ---- Scenes by calls ------------------------------------------------------------ */

/* The scene of `text`, by calls. */
static rt_scene *build_scene(void)
{
    rt_scene *scene;
    rt_error error;
    rt_material white = {.kd = {0.7f, 0.7f, 0.7f}};
    rt_surface surface = {0};
    rt_camera camera = {.eye = {0, 1, -4}, .look_at = {0, 1, 0}, .fov = 40};
    rt_point_light light = {.position = {2, 4, -3}, .intensity = {20, 20, 20}};
    rt_render_options options = {.width = 16, .height = 12};
    const float origin[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_add_material(scene, &surface.material, "white", &white, &error), &error);
    expect_ok(rt_scene_add_plane(scene, NULL, origin, up, &surface, &error), &error);
    expect_ok(rt_scene_add_sphere(scene, NULL, up, 1, &surface, &error), &error);
    expect_ok(rt_scene_add_point_light(scene, &light, &error), &error);
    expect_ok(rt_scene_set_camera(scene, &camera, &error), &error);
    expect_ok(rt_scene_set_options(scene, &options, &error), &error);
    return scene;
}

static void scene_by_calls_renders_like_its_text(void **state)
{
    fixture *fixture = *state;
    rt_scene *scene = build_scene();
    rt_renderer *renderer;
    rt_film *a, *b;
    rt_error error;
    expect_ok(rt_renderer_create(&renderer, scene, fixture->device, NULL, &error), &error);
    /* It is not needed once it is on the device. */
    rt_scene_destroy(scene);
    expect_ok(rt_render(&a, fixture->renderer, NULL, &error), &error);
    expect_ok(rt_render(&b, renderer, NULL, &error), &error);
    rt_renderer_destroy(renderer);
    assert_memory_equal(rt_film_rgb(a), rt_film_rgb(b), 16 * 12 * 3 * sizeof(float));
    rt_film_destroy(a);
    rt_film_destroy(b);
}

static void scene_tells_what_it_holds(void **state)
{
    fixture *fixture = *state;
    rt_scene_info info;
    rt_render_options options;
    rt_scene_get_info(fixture->scene, &info);
    assert_int_equal(info.shapes, 2);
    assert_int_equal(info.materials, 1);
    assert_int_equal(info.lights, 1);
    assert_int_equal(info.triangles, 0);
    assert_true(info.has_camera);
    rt_scene_get_options(fixture->scene, &options);
    assert_int_equal(options.width, 16);
    assert_int_equal(options.height, 12);
    assert_null(options.hooks);
}

static void wrong_shape_names_its_parameter_and_adds_nothing(void **state)
{
    (void)state;
    rt_scene *scene = build_scene();
    rt_surface surface = {0};
    rt_error error;
    rt_scene_info info;
    const float centre[3] = {0, 0, 0}, broken[3] = {0, NAN, 0};
    assert_int_equal(rt_scene_add_sphere(scene, NULL, centre, -1, &surface, &error),
                     RT_ERROR_INPUT);
    assert_string_equal(error.field, "radius");
    assert_int_equal(rt_scene_add_sphere(scene, NULL, broken, 1, &surface, &error), RT_ERROR_INPUT);
    assert_string_equal(error.field, "centre");
    assert_int_equal(rt_scene_add_plane(scene, NULL, centre, centre, &surface, &error),
                     RT_ERROR_INPUT);
    assert_string_equal(error.field, "normal");
    surface.material = 7;
    assert_int_equal(rt_scene_add_sphere(scene, NULL, centre, 1, &surface, &error), RT_ERROR_INPUT);
    rt_scene_get_info(scene, &info);
    assert_int_equal(info.shapes, 2);
    rt_scene_destroy(scene);
}

/* ---- Devices ---------------------------------------------------------------------- */

static void device_is_found_by_number_and_by_name(void **state)
{
    (void)state;
    rt_device_info *devices, info;
    size_t count;
    rt_device *device;
    rt_error error;
    expect_ok(rt_devices_list(&devices, &count, &error), &error);
    assert_true(count >= 1);
    assert_true(devices[0].compute_units >= 1);
    const char *const names[] = {"0", devices[0].name, devices[0].platform};
    for (int i = 0; i < 3; i++) {
        rt_device_options options = {.select = names[i]};
        expect_ok(rt_device_open(&device, &options, &error), &error);
        rt_device_get_info(device, &info);
        assert_string_equal(info.name, devices[0].name);
        rt_device_close(device);
    }
    rt_devices_free(devices);
}

/* ---- Tracing ------------------------------------------------------------------------- */

static void rays_hit_and_miss(void **state)
{
    fixture *fixture = *state;
    const rt_ray rays[] = {
        {{0, 1, -4}, 0, {0, 0, 1}, INFINITY},  /* the sphere, at 3 m */
        {{0, 1, -4}, 0, {0, 0, 2}, INFINITY},  /* the same: t counts directions, not metres */
        {{0, 1, -4}, 0, {0, -1, 0}, INFINITY}, /* the floor, at 1 m */
        {{0, 1, -4}, 0, {0, 1, 0}, INFINITY},  /* the sky */
        {{0, 1, -4}, 0, {0, 0, 1}, 2.5f},      /* ends before the sphere */
    };
    rt_hit hits[5];
    rt_error error;
    expect_ok(rt_trace(fixture->renderer, RT_TRACE_CLOSEST, rays, 5, hits, &error), &error);
    assert_int_equal(hits[0].shape, 1);
    assert_true(fabsf(hits[0].t - 3.0f) < 1e-5f);
    assert_true(fabsf(hits[0].normal[2] + 1.0f) < 1e-5f);
    assert_true(fabsf(hits[1].t - 1.5f) < 1e-5f);
    assert_int_equal(hits[2].shape, 0);
    assert_true(fabsf(hits[2].t - 1.0f) < 1e-5f);
    for (int i = 3; i < 5; i++) {
        assert_int_equal(hits[i].shape, RT_NONE);
        assert_int_equal(hits[i].prim, RT_NONE);
        assert_true(isinf(hits[i].t));
    }
    expect_ok(rt_trace(fixture->renderer, RT_TRACE_ANY, rays, 5, hits, &error), &error);
    for (int i = 0; i < 5; i++)
        assert_int_equal(hits[i].shape != RT_NONE, i < 3);
    expect_ok(rt_trace(fixture->renderer, RT_TRACE_CLOSEST, NULL, 0, NULL, &error), &error);
}

static void ray_that_is_no_ray_is_refused(void **state)
{
    fixture *fixture = *state;
    const rt_ray rays[] = {
        {{0, NAN, 0}, 0, {0, 0, 1}, 1},
        {{0, 0, 0}, 0, {0, 0, 0}, 1},
        {{0, 0, 0}, 2, {0, 0, 1}, 1},
        {{0, 1, -4}, 0, {0, 0, 1e-16f}, INFINITY},
        {{0, 1, -4}, 0, {0, 0, 1e16f}, INFINITY},
        {{0, 1e16f, -4}, 0, {0, 0, 1}, INFINITY},
    };
    rt_hit hit;
    rt_error error;
    for (size_t i = 0; i < sizeof rays / sizeof *rays; i++) {
        const rt_ray pair[] = {{{0, 1, -4}, 0, {0, 0, 1}, INFINITY}, rays[i]};
        rt_hit hits[2];
        assert_int_equal(rt_trace(fixture->renderer, RT_TRACE_CLOSEST, pair, 2, hits, &error),
                         RT_ERROR_USAGE);
        assert_non_null(strstr(error.message, "ray 1 "));
    }
    const rt_ray good = {{0, 1, -4}, 0, {0, 0, 1}, INFINITY};
    assert_int_equal(rt_trace(fixture->renderer, (rt_trace_kind)2, &good, 1, &hit, &error),
                     RT_ERROR_USAGE);
    assert_string_equal(error.field, "kind");
}

/* At both ends of the lengths that are allowed. */
static void a_direction_may_be_short_or_long(void **state)
{
    fixture *fixture = *state;
    const rt_ray rays[] = {{{0, 1, -4}, 0, {0, 0, 1e-15f}, INFINITY},
                           {{0, 1, -4}, 0, {0, 0, 9.9e14f}, INFINITY}};
    rt_hit hits[2];
    rt_error error;
    expect_ok(rt_trace(fixture->renderer, RT_TRACE_CLOSEST, rays, 2, hits, &error), &error);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(hits[i].shape, 1);
        assert_true(fabsf(hits[i].t * rays[i].direction[2] - 3.0f) < 1e-4f);
    }
}

/* ---- Progress and cancelling ------------------------------------------------------------ */

/* What a progress callback saw. */
typedef struct watch {
    int reports, begun, ended, disordered;
    rt_stage cancel_in; /* asks to stop once this stage is past half, or RT_STAGE_LOAD: never */
    rt_stage stage;
    double fraction;
} watch;

static int watch_progress(void *user, const rt_progress *progress)
{
    watch *watch = user;
    if (!watch->reports || progress->stage != watch->stage) {
        watch->begun += progress->fraction == 0.0;
        watch->disordered += watch->reports && progress->stage < watch->stage;
    } else {
        watch->disordered += progress->fraction < watch->fraction;
    }
    watch->disordered += !(progress->fraction >= 0.0 && progress->fraction <= 1.0);
    watch->reports++;
    watch->ended += progress->fraction == 1.0;
    watch->stage = progress->stage;
    watch->fraction = progress->fraction;
    return watch->cancel_in && progress->stage == watch->cancel_in && progress->fraction > 0.0;
}

static void progress_shows_each_stage_from_start_to_end(void **state)
{
    fixture *fixture = *state;
    rt_film *film;
    rt_error error;
    watch watch = {0};
    rt_hooks hooks = {.progress = watch_progress, .user = &watch};
    rt_render_options options = {.width = 16,
                                 .height = 12,
                                 .spp = 4,
                                 .mode = RT_MODE_PHOTON,
                                 .photons = 1000,
                                 .hooks = &hooks};
    expect_ok(rt_render(&film, fixture->renderer, &options, &error), &error);
    /* Kernels, emission, gathering. */
    assert_int_equal(watch.begun, 3);
    assert_true(watch.ended >= 3);
    assert_int_equal(watch.disordered, 0);
    assert_int_equal(watch.stage, RT_STAGE_GATHER);
    rt_film_destroy(film);
}

/* The first pass is finished, long after the time unless the device is quick. */
static void progress_stays_within_1_when_time_is_over(void **state)
{
    fixture *fixture = *state;
    rt_film *film;
    rt_error error;
    rt_film_stats stats;
    watch watch = {0};
    rt_hooks hooks = {.progress = watch_progress, .user = &watch};
    rt_render_options options = {.width = 1024, .height = 1024, .time = 1e-3, .hooks = &hooks};
    expect_ok(rt_render(&film, fixture->renderer, &options, &error), &error);
    rt_film_get_stats(film, &stats);
    assert_int_equal(stats.spp, 1);
    assert_true(watch.reports > (stats.render_seconds > 1 ? 4 : 0));
    assert_int_equal(watch.disordered, 0);
    rt_film_destroy(film);
}

static void cancelled_render_keeps_its_samples(void **state)
{
    fixture *fixture = *state;
    rt_film *film = NULL;
    rt_error error;
    rt_film_stats stats;
    watch watch = {.cancel_in = RT_STAGE_RENDER};
    rt_hooks hooks = {.progress = watch_progress, .user = &watch};
    rt_render_options options = {.width = 16, .height = 12, .spp = 10000000, .hooks = &hooks};
    assert_int_equal(rt_render(&film, fixture->renderer, &options, &error), RT_CANCELLED);
    assert_int_equal(error.status, RT_CANCELLED);
    assert_non_null(film);
    assert_true(watch.fraction < 1);
    rt_film_get_stats(film, &stats);
    assert_in_range(stats.spp, 1, 9999999);
    /* They are a picture: what as many samples asked for outright give. */
    rt_film *same;
    options.spp = stats.spp;
    options.hooks = NULL;
    expect_ok(rt_render(&same, fixture->renderer, &options, &error), &error);
    assert_memory_equal(rt_film_rgb(film), rt_film_rgb(same), 16 * 12 * 3 * sizeof(float));
    rt_film_destroy(same);
    rt_film_destroy(film);
}

static int refuse(void *user, const rt_progress *progress)
{
    (void)user;
    (void)progress;
    return 1;
}

static void cancelled_before_the_first_sample_gives_no_film(void **state)
{
    fixture *fixture = *state;
    rt_film *film = (rt_film *)&film;
    rt_renderer *renderer = NULL;
    rt_error error;
    rt_hooks hooks = {.progress = refuse};
    rt_render_options options = {.width = 16, .height = 12, .hooks = &hooks};
    rt_renderer_options renderer_options = {RT_ACCEL_BVH, &hooks};
    assert_int_equal(rt_render(&film, fixture->renderer, &options, &error), RT_CANCELLED);
    assert_null(film);
    assert_int_equal(
        rt_renderer_create(&renderer, fixture->scene, fixture->device, &renderer_options, &error),
        RT_CANCELLED);
    assert_null(renderer);
}

/* ---- Films --------------------------------------------------------------------------------- */

static void film_outlives_its_renderer(void **state)
{
    fixture *fixture = *state;
    rt_renderer *renderer;
    rt_film *film;
    rt_error error;
    uint32_t width, height;
    expect_ok(rt_renderer_create(&renderer, fixture->scene, fixture->device, NULL, &error), &error);
    expect_ok(rt_render(&film, renderer, NULL, &error), &error);
    rt_renderer_destroy(renderer);
    rt_film_get_size(film, &width, &height);
    assert_int_equal(width, 16);
    assert_int_equal(height, 12);
    double sum = 0.0;
    for (int i = 0; i < 16 * 12 * 3; i++)
        sum += rt_film_rgb(film)[i];
    assert_true(isfinite(sum) && sum > 0.0);
    rt_film_destroy(film);
}

static void film_refuses_unknown_formats_and_places(void **state)
{
    fixture *fixture = *state;
    rt_film *film;
    rt_error error;
    rt_render_options options = {.width = 4, .height = 4, .spp = 1};
    expect_ok(rt_render(&film, fixture->renderer, &options, &error), &error);
    assert_int_equal(rt_film_write(film, "/tmp/film.jpg", NULL, &error), RT_ERROR_USAGE);
    assert_int_not_equal(access("/tmp/film.jpg", F_OK), 0);
    assert_int_equal(rt_film_write(film, "/no/such/place/film.png", NULL, &error), RT_ERROR_OUTPUT);
    assert_non_null(strstr(error.message, "/no/such/place/film.png"));
    rt_film_destroy(film);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(version_is_that_of_the_header),
        cmocka_unit_test(stages_have_names),
        cmocka_unit_test(destroying_null_does_nothing),
        cmocka_unit_test(failure_fills_the_error_and_leaves_the_result),
        cmocka_unit_test(error_may_be_null),
        cmocka_unit_test(errors_name_the_file_at_fault),
        cmocka_unit_test(a_text_without_a_name_is_called_text),
        cmocka_unit_test(every_error_of_a_text_is_reported),
        cmocka_unit_test(options_out_of_range_name_their_field),
        cmocka_unit_test(scene_by_calls_renders_like_its_text),
        cmocka_unit_test(scene_tells_what_it_holds),
        cmocka_unit_test(wrong_shape_names_its_parameter_and_adds_nothing),
        cmocka_unit_test(device_is_found_by_number_and_by_name),
        cmocka_unit_test(rays_hit_and_miss),
        cmocka_unit_test(ray_that_is_no_ray_is_refused),
        cmocka_unit_test(a_direction_may_be_short_or_long),
        cmocka_unit_test(progress_shows_each_stage_from_start_to_end),
        cmocka_unit_test(progress_stays_within_1_when_time_is_over),
        cmocka_unit_test(cancelled_render_keeps_its_samples),
        cmocka_unit_test(cancelled_before_the_first_sample_gives_no_film),
        cmocka_unit_test(film_outlives_its_renderer),
        cmocka_unit_test(film_refuses_unknown_formats_and_places),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
