/*
 * test_paths.c - the recorded paths of a pixel are those of the render: their sum is the pixel, and
 * what the vertices say adds up and fits together.
 */
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { width = 24, height = 18, spp = 8 };

static const rt_render_options options = {.width = width, .height = height, .spp = spp};

/* One scene on one device. */
typedef struct setting {
    rt_device *device;
    rt_renderer *renderer;
    rt_film *film;
} setting;

static setting open_scene(const char *path, uint32_t lanes, const rt_render_options *o)
{
    setting s = {0};
    rt_scene *scene = NULL;
    rt_error error;
    const rt_device_options one = {.width = lanes};
    expect_ok(rt_scene_load(&scene, path, NULL, &error), &error);
    expect_ok(rt_device_open(&s.device, &one, &error), &error);
    expect_ok(rt_renderer_create(&s.renderer, scene, s.device, NULL, &error), &error);
    expect_ok(rt_render(&s.film, s.renderer, o, &error), &error);
    rt_scene_destroy(scene);
    return s;
}

static void close_scene(setting *s)
{
    rt_film_destroy(s->film);
    rt_renderer_destroy(s->renderer);
    rt_device_close(s->device);
}

/* What the paths of a pixel add up to, and the film's value beside it. */
static void pixel_of_paths(double sum[3], const rt_paths *paths)
{
    size_t count;
    const rt_camera_path *path = rt_paths_list(paths, &count);
    double weight = 0;
    sum[0] = sum[1] = sum[2] = 0;
    assert_int_equal(count, spp);
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(path[i].sample, i);
        weight += path[i].weight;
        for (int c = 0; c < 3; c++)
            sum[c] += (double)path[i].weight * path[i].radiance[c];
    }
    for (int c = 0; c < 3; c++)
        sum[c] /= weight;
}

/* A path's vertices follow from each other, and their light is the path's. */
static void check_path(const rt_camera_path *path, const rt_path_vertex *vertices, size_t count)
{
    double sum[3] = {0, 0, 0}, size = 0;
    const rt_path_vertex *v = vertices + path->first_vertex;
    assert_true(path->first_vertex + path->vertex_count <= count);
    assert_int_equal(v->event, RT_PATH_CAMERA);
    for (uint32_t i = 0; i < path->vertex_count; i++, v++) {
        const int is_last = i + 1 == path->vertex_count;
        const int has_ended = v->event == RT_PATH_ABSORBED || v->event == RT_PATH_CUT_OFF ||
                              v->event == RT_PATH_ESCAPED;
        assert_int_equal(is_last, has_ended);
        assert_true(v->event == RT_PATH_CAMERA || v->depth >= 1);
        assert_true(v->direct_weight >= 0 && v->direct_weight <= 1.00001f);
        assert_true(v->emitted_weight >= 0 && v->emitted_weight <= 1.00001f);
        for (int c = 0; c < 3; c++) {
            sum[c] += (double)v->emitted[c] + v->direct[c];
            size += fabs((double)path->radiance[c]);
            assert_true(v->emitted[c] == 0 || v->emitter != RT_NONE);
            assert_true(v->direct[c] == 0 ||
                        (v->light != RT_NONE && !(v->flags & RT_PATH_LIGHT_OCCLUDED)));
        }
    }
    for (int c = 0; c < 3; c++)
        assert_true(fabs(sum[c] - path->radiance[c]) <= 1e-5 * size);
}

static void check_paths(const rt_paths *paths)
{
    size_t count, vertex_count;
    const rt_camera_path *list = rt_paths_list(paths, &count);
    const rt_path_vertex *vertices = rt_paths_vertices(paths, &vertex_count);
    for (size_t i = 0; i < count; i++)
        check_path(list + i, vertices, vertex_count);
}

/* How many of the channels of all pixels are farther than `bound` from the sum of their paths. */
static uint32_t count_off(const setting *s, const rt_render_options *o, double bound)
{
    uint32_t off = 0;
    rt_error error;
    for (uint32_t i = 0; i < width * height; i++) {
        double sum[3];
        rt_paths *paths = NULL;
        expect_ok(rt_paths_trace(&paths, s->renderer, o, i % width, i / width, 0, spp, &error),
                  &error);
        pixel_of_paths(sum, paths);
        check_paths(paths);
        const float *pixel = rt_film_rgb(s->film) + 3 * i;
        for (int c = 0; c < 3; c++)
            off += fabs(sum[c] - pixel[c]) > bound * (fabs(sum[c]) + 1e-6);
        rt_paths_destroy(paths);
    }
    return off;
}

static const char *const scenes[] = {
    "scenes/cornell.rts",                            /* mirror and glass under an area light */
    "scenes/textured_mesh.rts",                      /* a mesh, and an environment */
    "scenes/primitives.rts", "scenes/box_point.rts", /* a delta light */
};

static void paths_add_up_to_the_pixels(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        setting s = open_scene(scenes[i], 1, &options);
        const uint32_t off = count_off(&s, &options, 2e-7);
        if (off > 0)
            fail_msg("%s: %u of %u values differ", scenes[i], off, 3 * width * height);
        close_scene(&s);
    }
}

static void paths_add_up_with_filters_and_estimators(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        rt_render_options o = options;
        o.filter = i == 0 ? RT_FILTER_MITCHELL : RT_FILTER_BOX;
        o.estimator = i == 1 ? RT_ESTIMATOR_LIGHT : i == 2 ? RT_ESTIMATOR_BSDF : RT_ESTIMATOR_MIS;
        o.seed = 5;
        o.sampler = RT_SAMPLER_INDEPENDENT;
        setting s = open_scene("scenes/cornell.rts", 1, &o);
        assert_int_equal(count_off(&s, &o, 2e-7), 0);
        close_scene(&s);
    }
}

/* Eight at a time differ by rounding, which now and then sends a path elsewhere. */
static void paths_of_eight_add_up_but_for_rounding(void **state)
{
    (void)state;
    setting s = open_scene("scenes/cornell.rts", 8, &options);
    const uint32_t off = count_off(&s, &options, 1e-3);
    if (off > 3 * width * height / 100)
        fail_msg("%u of %u values differ", off, 3 * width * height);
    close_scene(&s);
}

static void a_range_of_samples_is_that_part_of_all(void **state)
{
    (void)state;
    setting s = open_scene("scenes/cornell.rts", 1, &options);
    rt_paths *all = NULL, *some = NULL;
    rt_error error;
    size_t count, all_count;
    expect_ok(rt_paths_trace(&all, s.renderer, &options, 11, 12, 0, spp, &error), &error);
    expect_ok(rt_paths_trace(&some, s.renderer, &options, 11, 12, 3, 2, &error), &error);
    const rt_camera_path *a = rt_paths_list(all, &all_count) + 3, *b = rt_paths_list(some, &count);
    assert_int_equal(count, 2);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(b[i].sample, 3 + i);
        assert_memory_equal(a[i].radiance, b[i].radiance, sizeof a->radiance);
        assert_int_equal(a[i].vertex_count, b[i].vertex_count);
    }
    rt_paths_destroy(all);
    rt_paths_destroy(some);
    close_scene(&s);
}

/* The first vertex lies in its pixel, as the box filter places the sample there. */
static void the_camera_sees_a_first_hit_in_its_pixel(void **state)
{
    static const char *const cameras[] = {"scenes/cornell.rts", "scenes/primitives.rts"};
    (void)state;
    for (int s = 0; s < 2; s++) {
        setting set = open_scene(cameras[s], 1, &options);
        for (uint32_t i = 0; i < width * height; i += 37) {
            rt_paths *paths = NULL;
            rt_error error;
            size_t count;
            expect_ok(rt_paths_trace(&paths, set.renderer, &options, i % width, i / width, 0, spp,
                                     &error),
                      &error);
            const rt_path_vertex *v = rt_paths_vertices(paths, &count);
            for (size_t j = 0; j < count; j++)
                if (v[j].depth == 1 && v[j].event != RT_PATH_ESCAPED) {
                    assert_true(fabs(v[j].raster[0] - (i % width + 0.5)) < 0.51);
                    assert_true(fabs(v[j].raster[1] - (i / width + 0.5)) < 0.51);
                }
            rt_paths_destroy(paths);
        }
        close_scene(&set);
    }
}

/* Between two mirrors that face each other, a path is longer than the first room for it. */
static void long_paths_are_whole(void **state)
{
    static const char text[] = "camera { eye 0 0 0.1  look_at 0 0 1  fov 1 }\n"
                               "film { width 24 height 18 }\n"
                               "render { max_depth 300  roulette_depth 1000 }\n"
                               "material mirror { ks 1 }\n"
                               "plane { point 0 0 1  normal 0 0 -1  material mirror }\n"
                               "plane { point 0 0 -1  normal 0 0 1  material mirror }\n"
                               "light point { position 0 0.5 0  intensity 1 }\n";
    rt_paths *paths = NULL;
    rt_error error;
    size_t count, vertex_count;
    (void)state;
    rt_renderer *renderer = test_renderer(text);
    expect_ok(rt_paths_trace(&paths, renderer, NULL, 12, 9, 0, 3, &error), &error);
    const rt_camera_path *list = rt_paths_list(paths, &count);
    const rt_path_vertex *vertices = rt_paths_vertices(paths, &vertex_count);
    assert_int_equal(count, 3);
    assert_int_equal(vertex_count, 3 * 301);
    for (int i = 0; i < 3; i++) {
        const rt_path_vertex *last = vertices + list[i].first_vertex + list[i].vertex_count - 1;
        assert_int_equal(list[i].vertex_count, 301);
        assert_int_equal(last->event, RT_PATH_CUT_OFF);
        assert_int_equal(last->depth, 300);
        assert_true(list[i].cut_off > 0.9f);
    }
    rt_paths_destroy(paths);
    rt_renderer_destroy(renderer);
}

static void no_count_takes_the_samples_of_the_render(void **state)
{
    (void)state;
    setting s = open_scene("scenes/cornell.rts", 1, &options);
    rt_render_options o = options;
    const struct {
        uint32_t spp, first, expected;
        double time;
    } cases[] = {{spp, 0, spp, 0}, {spp, 1, spp - 1, 0}, {0, 0, 64, 0}, {0, 0, 64, 10}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        rt_paths *paths = NULL;
        rt_error error;
        size_t count;
        o.spp = cases[i].spp;
        o.time = cases[i].time;
        expect_ok(rt_paths_trace(&paths, s.renderer, &o, 1, 2, cases[i].first, 0, &error), &error);
        rt_paths_list(paths, &count);
        assert_int_equal(count, cases[i].expected);
        rt_paths_destroy(paths);
    }
    close_scene(&s);
}

/* What rt_paths_trace fails with, at fault `field`. */
static void expect_refused(rt_renderer *renderer, const rt_render_options *o, uint32_t x,
                           uint32_t first, uint32_t count, const char *field)
{
    rt_paths *paths = (rt_paths *)&paths;
    rt_error error;
    assert_int_equal(rt_paths_trace(&paths, renderer, o, x, 0, first, count, &error),
                     RT_ERROR_USAGE);
    assert_string_equal(error.field, field);
    assert_ptr_equal(paths, &paths);
}

static void what_is_no_pixel_or_no_path_is_refused(void **state)
{
    (void)state;
    setting s = open_scene("scenes/cornell.rts", 1, &options);
    rt_render_options o = options;
    expect_refused(s.renderer, &o, width, 0, 1, "pixel");
    expect_refused(s.renderer, &o, 0, spp, 0, "first");
    expect_refused(s.renderer, &o, 0, 0, RT_PATHS_MAX + 1, "count");
    expect_refused(s.renderer, &o, 0, UINT32_MAX, 1, "first");
    o.mode = RT_MODE_PHOTON;
    expect_refused(s.renderer, &o, 0, 0, 1, "mode");
    o = options;
    o.variance = 1;
    expect_refused(s.renderer, &o, 0, 0, 1, "variance");
    expect_refused(NULL, &o, 0, 0, 1, "renderer");
    close_scene(&s);
}

/* The reports of the stages, and the one to be cancelled. */
typedef struct stage_reports {
    int compiling[2], tracing[2], others; /* how many begin, and end */
    int cancels;
    rt_stage stop;
} stage_reports;

static int count_report(void *user, const rt_progress *progress)
{
    stage_reports *seen = user;
    int *counts = progress->stage == RT_STAGE_COMPILE  ? seen->compiling
                  : progress->stage == RT_STAGE_RENDER ? seen->tracing
                                                       : NULL;
    if (counts && progress->fraction == 0)
        counts[0]++;
    else if (counts && progress->fraction == 1)
        counts[1]++;
    seen->others += !counts;
    return seen->cancels && progress->stage == seen->stop;
}

static void its_stages_are_told_and_can_be_cancelled(void **state)
{
    stage_reports seen = {0};
    const rt_hooks hooks = {.progress = count_report, .user = &seen};
    rt_paths *paths = NULL;
    rt_error error;
    (void)state;
    setting s = open_scene("scenes/cornell.rts", 1, &options);
    rt_render_options o = options;
    o.hooks = &hooks;
    expect_ok(rt_paths_trace(&paths, s.renderer, &o, 0, 0, 0, 1, &error), &error);
    /* What is compiled for long is told again while nothing of it is done. */
    assert_true(seen.compiling[0] >= 1 && seen.compiling[1] == 1);
    assert_true(seen.tracing[0] == 1 && seen.tracing[1] == 1);
    assert_int_equal(seen.others, 0);
    rt_paths_destroy(paths);
    seen = (stage_reports){.cancels = 1, .stop = RT_STAGE_RENDER};
    assert_int_equal(rt_paths_trace(&paths, s.renderer, &o, 0, 0, 0, 1, &error), RT_CANCELLED);
    assert_true(seen.compiling[1] == 1 && seen.tracing[0] == 1 && seen.tracing[1] == 0);
    seen = (stage_reports){.cancels = 1, .stop = RT_STAGE_COMPILE};
    assert_int_equal(rt_paths_trace(&paths, s.renderer, &o, 0, 0, 0, 1, &error), RT_CANCELLED);
    assert_true(seen.compiling[1] == 0 && seen.tracing[0] == 0);
    close_scene(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(paths_add_up_to_the_pixels),
        cmocka_unit_test(paths_add_up_with_filters_and_estimators),
        cmocka_unit_test(paths_of_eight_add_up_but_for_rounding),
        cmocka_unit_test(a_range_of_samples_is_that_part_of_all),
        cmocka_unit_test(the_camera_sees_a_first_hit_in_its_pixel),
        cmocka_unit_test(long_paths_are_whole),
        cmocka_unit_test(no_count_takes_the_samples_of_the_render),
        cmocka_unit_test(what_is_no_pixel_or_no_path_is_refused),
        cmocka_unit_test(its_stages_are_told_and_can_be_cancelled),
    };
    return cmocka_run_group_tests_name("lib/mode/paths", tests, NULL, NULL);
}
