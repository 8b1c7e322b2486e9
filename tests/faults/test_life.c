/*
 * test_life.c - long lives: thousands of renders take no more memory, descriptors and threads than
 * a few, and clocks that jump disturb none. RT_TEST_LONG=1 makes it ten thousand.
 */
#define _XOPEN_SOURCE 700

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "faults/fault.h"
#include "lib/image/scratch.h"
#include "support.h"

#define WORLD                                                                                      \
    "camera { eye 0 1.5 -5  look_at 0 0.8 0  fov 45 }\n"                                           \
    "film { width 4  height 4 }\n"                                                                 \
    "material paper { kd 0.7 }\nmaterial glass { kt 1  ior 1.5  fresnel dielectric }\n"            \
    "quad { corner -4 0 -4  edge1 0 0 8  edge2 8 0 0  material paper }\n"                          \
    "sphere { centre 1 1 0  radius 0.9  material glass }\n"                                        \
    "quad { corner -1 4 -1  edge1 2 0 0  edge2 0 0 2  material paper  radiance 8 }\n"

static const char *const texts[] = {
    WORLD "render { spp 1 }\n",
    WORLD "render { mode photon  photons 200  k 10  spp 1  gather flann }\n",
    WORLD "render { mode photon  photons 200  passes 2 }\n",
    "sphere { centre 0 0 0  radius -1 }\n", /* an error on the way */
};
enum { kinds = sizeof texts / sizeof *texts };

static int entries(const char *path)
{
    int count = 0;
    DIR *folder = opendir(path);
    assert_non_null(folder);
    while (readdir(folder))
        count++;
    closedir(folder);
    return count;
}

/* Memory of this process that is in use, KiB. */
static long resident(void)
{
    long pages = 0, shared = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    assert_non_null(file);
    assert_int_equal(fscanf(file, "%*s %ld %ld", &pages, &shared), 2);
    fclose(file);
    return (pages - shared) * (sysconf(_SC_PAGESIZE) / 1024);
}

static rt_status render(const char *text, const rt_hooks *hooks, float *rgb, rt_error *error)
{
    rt_scene *scene = NULL;
    rt_renderer *renderer = NULL;
    rt_film *film = NULL;
    rt_render_options options;
    const rt_renderer_options with = {.hooks = hooks};
    rt_status status = rt_scene_parse(&scene, text, NULL, NULL, error);
    if (status == RT_OK)
        status = rt_renderer_create(&renderer, scene, test_device(), &with, error);
    if (status == RT_OK) {
        rt_scene_get_options(scene, &options);
        options.hooks = hooks;
        status = rt_render(&film, renderer, &options, error);
    }
    if (status == RT_OK)
        status = rt_film_write(film, "out.exr", NULL, error);
    if (status == RT_OK && rgb)
        memcpy(rgb, rt_film_rgb(film), 3 * 4 * 4 * sizeof *rgb);
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
    return status;
}

static void cycle(int count)
{
    for (int i = 0; i < count; i++) {
        rt_error error;
        rt_status status = render(texts[i % kinds], NULL, NULL, &error);
        assert_int_equal(status, i % kinds == kinds - 1 ? RT_ERROR_INPUT : RT_OK);
    }
}

static void thousands_of_renders_leave_nothing_behind(void **state)
{
    (void)state;
    int many = getenv("RT_TEST_LONG") ? 10000 : 400;
    cycle(many / 4); /* until allocators and drivers have what they keep */
    long blocks = fault_live(), memory = resident();
    int descriptors = entries("/proc/self/fd"), threads = entries("/proc/self/task");
    cycle(many);
    assert_int_equal(fault_live(), blocks);
    assert_int_equal(entries("/proc/self/fd"), descriptors);
    assert_int_equal(entries("/proc/self/task"), threads);
    print_message("%d renders: %ld KiB more\n", many, resident() - memory);
    assert_true(resident() - memory < 4096);
}

static void devices_open_and_close_without_end(void **state)
{
    (void)state;
    int many = getenv("RT_TEST_LONG") ? 1000 : 40, descriptors = 0, threads = 0;
    long memory = 0;
    for (int i = 0; i < 2 * many; i++) {
        rt_device *device = test_device_open(0, 0);
        rt_device_close(device);
        if (i == many) {
            memory = resident();
            descriptors = entries("/proc/self/fd");
            threads = entries("/proc/self/task");
        }
    }
    print_message("%d openings: %ld KiB more\n", many, resident() - memory);
    assert_int_equal(entries("/proc/self/fd"), descriptors);
    assert_int_equal(entries("/proc/self/task"), threads);
    assert_true(resident() - memory < 4096);
}

/* ---- Clocks ---------------------------------------------------------------------------------- */

typedef struct watch {
    long jump; /* seconds, at each report */
    long shift, reports;
    double furthest;
    rt_stage stage;
    int is_wrong;
} watch;

/* Each report finds the clock elsewhere: a day later, or an hour earlier. */
static int on_progress(void *user, const rt_progress *progress)
{
    watch *w = user;
    if (progress->stage != w->stage)
        w->furthest = 0;
    w->is_wrong |= !(progress->fraction >= w->furthest && progress->fraction <= 1) ||
                   progress->elapsed != progress->elapsed;
    w->stage = progress->stage;
    w->furthest = progress->fraction;
    w->reports++;
    fault_shift_clocks(w->shift += w->jump);
    return 0;
}

static void clocks_that_jump_change_no_picture(void **state)
{
    static const long jumps[] = {0, 86400, -3600};
    (void)state;
    for (int kind = 0; kind < kinds - 1; kind++) {
        float right[48], rgb[48];
        for (size_t i = 0; i < sizeof jumps / sizeof *jumps; i++) {
            watch w = {.jump = jumps[i]};
            const rt_hooks hooks = {.progress = on_progress, .user = &w};
            rt_error error;
            expect_ok(render(texts[kind], &hooks, i == 0 ? right : rgb, &error), &error);
            fault_shift_clocks(0);
            assert_false(w.is_wrong);
            assert_true(w.reports > 4);
            if (i > 0)
                assert_memory_equal(rgb, right, sizeof rgb);
        }
    }
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_enter, scratch_leave)
    const struct CMUnitTest tests[] = {
        TEST(thousands_of_renders_leave_nothing_behind),
        TEST(devices_open_and_close_without_end),
        TEST(clocks_that_jump_change_no_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
