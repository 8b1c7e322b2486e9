/*
 * test_threads.c - many threads on the whole API: scenes, devices and renderers of their own, one
 * scene that all of them render, cancels from outside, and openings that race. Each picture is the
 * one that a single thread makes. `make check-threads` runs it under the thread sanitizer, with all
 * kinds of renders by RT_TEST_LONG=1.
 */
#define _XOPEN_SOURCE 700

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "lib/image/scratch.h"
#include "support.h"

enum { crowd = 8, values = 3 * 8 * 6 };

#define WORLD                                                                                      \
    "camera { eye 0 1.5 -5  look_at 0 0.8 0  fov 45 }\n"                                           \
    "film { width 8  height 6 }\n"                                                                 \
    "material paper { kd 0.7 }\nmaterial glass { kt 1  ior 1.5  fresnel dielectric }\n"            \
    "quad { corner -4 0 -4  edge1 0 0 8  edge2 8 0 0  material paper }\n"                          \
    "sphere { centre 1 1 0  radius 0.9  material glass }\n"                                        \
    "quad { corner -1 4 -1  edge1 2 0 0  edge2 0 0 2  material paper  radiance 8 }\n"

static const char *const texts[] = {
    WORLD "render { spp 4  variance true }\n",
    WORLD "render { mode photon  photons 2000  k 20  spp 1  gather flann }\n",
    WORLD "render { mode photon  photons 2000  k 20  spp 1  gather device }\n",
    WORLD "render { mode photon  photons 1000  passes 3 }\n",
    WORLD "render { mode direct  spp 2  aov true }\n",
};
enum { kinds = sizeof texts / sizeof *texts };

/* One thread's part: a picture of a scene, given or made of a text. */
typedef struct part {
    const char *text;
    const rt_scene *scene; /* of all, or NULL */
    int number;
    rt_status status;
    rt_error error;
    float rgb[values];
} part;

static rt_status render(part *p, const rt_scene *scene, rt_error *error)
{
    rt_device *device = NULL;
    rt_renderer *renderer = NULL;
    rt_film *film = NULL;
    rt_render_options options;
    rt_device_options device_options = {.threads = 1 + (uint32_t)p->number % 2};
    char name[32];
    rt_scene_get_options(scene, &options);
    rt_status status = rt_device_open(&device, &device_options, error);
    if (status == RT_OK)
        status = rt_renderer_create(&renderer, scene, device, NULL, error);
    if (status == RT_OK)
        status = rt_render(&film, renderer, &options, error);
    if (status == RT_OK) {
        memcpy(p->rgb, rt_film_rgb(film), sizeof p->rgb);
        snprintf(name, sizeof name, "%d.exr", p->number % 2); /* some write the same file */
        status = rt_film_write(film, name, NULL, error);
    }
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
    rt_device_close(device);
    return status;
}

static void *do_part(void *data)
{
    part *p = data;
    rt_scene *own = NULL;
    p->status = p->scene ? RT_OK : rt_scene_parse(&own, p->text, NULL, NULL, &p->error);
    if (p->status == RT_OK)
        p->status = render(p, p->scene ? p->scene : own, &p->error);
    rt_scene_destroy(own);
    return NULL;
}

/* Runs all parts, each in a thread. */
static void do_all(part *parts, int count)
{
    pthread_t threads[crowd];
    for (int i = 0; i < count; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, do_part, &parts[i]), 0);
    for (int i = 0; i < count; i++)
        assert_int_equal(pthread_join(threads[i], NULL), 0);
    for (int i = 0; i < count; i++)
        expect_ok(parts[i].status, &parts[i].error);
}

static void make_part(part *p, int number, const char *text, const rt_scene *scene)
{
    memset(p, 0, sizeof *p);
    p->number = number;
    p->text = text;
    p->scene = scene;
}

static void threads_with_scenes_of_their_own(void **state)
{
    static part parts[crowd], alone[kinds];
    (void)state;
    /* First together, so that it is they who start the driver and compile. */
    for (int i = 0; i < crowd; i++)
        make_part(&parts[i], i, texts[i % kinds], NULL);
    do_all(parts, crowd);
    for (int i = 0; i < kinds; i++) {
        make_part(&alone[i], i, texts[i], NULL);
        do_all(&alone[i], 1);
    }
    for (int i = 0; i < crowd; i++)
        assert_memory_equal(parts[i].rgb, alone[i % kinds].rgb, sizeof parts[i].rgb);
}

static void one_scene_in_many_renderers(void **state)
{
    static part parts[crowd];
    rt_error error;
    (void)state;
    for (int kind = 0; kind < (getenv("RT_TEST_LONG") ? kinds : 2); kind++) {
        rt_scene *scene;
        expect_ok(rt_scene_parse(&scene, texts[kind], NULL, NULL, &error), &error);
        for (int i = 0; i < crowd; i++)
            make_part(&parts[i], i, NULL, scene);
        do_all(parts, crowd);
        for (int i = 1; i < crowd; i++)
            assert_memory_equal(parts[i].rgb, parts[0].rgb, sizeof parts[0].rgb);
        rt_scene_destroy(scene);
    }
}

/* ---- Cancelling ------------------------------------------------------------------------------ */

typedef struct control {
    pthread_mutex_t lock;
    int asked;
} control;

static int on_progress(void *user, const rt_progress *progress)
{
    control *c = user;
    (void)progress;
    pthread_mutex_lock(&c->lock);
    int asked = c->asked;
    pthread_mutex_unlock(&c->lock);
    return asked;
}

static void *render_for_long(void *data)
{
    static const char text[] = WORLD "render { spp 1000000 }\n";
    const rt_hooks hooks = {.progress = on_progress, .user = data};
    rt_scene *scene = NULL;
    rt_device *device = NULL;
    rt_renderer *renderer = NULL;
    rt_film *film = NULL;
    rt_render_options options;
    rt_error error;
    rt_status status = rt_scene_parse(&scene, text, NULL, NULL, &error);
    if (status == RT_OK)
        status = rt_device_open(&device, NULL, &error);
    if (status == RT_OK) {
        const rt_renderer_options with = {.hooks = &hooks};
        rt_scene_get_options(scene, &options);
        options.hooks = &hooks;
        status = rt_renderer_create(&renderer, scene, device, &with, &error);
    }
    if (status == RT_OK)
        status = rt_render(&film, renderer, &options, &error);
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
    rt_device_close(device);
    rt_scene_destroy(scene);
    static const int cancelled = 1;
    return status == RT_CANCELLED ? (void *)&cancelled : NULL;
}

static void renders_are_cancelled_from_outside(void **state)
{
    static control controls[crowd];
    pthread_t threads[crowd];
    (void)state;
    for (int i = 0; i < crowd; i++) {
        pthread_mutex_init(&controls[i].lock, NULL);
        controls[i].asked = 0;
        assert_int_equal(pthread_create(&threads[i], NULL, render_for_long, &controls[i]), 0);
    }
    for (int i = 0; i < crowd; i++) {
        const struct timespec nap = {0, 50000000};
        void *result;
        nanosleep(&nap, NULL);
        pthread_mutex_lock(&controls[i].lock);
        controls[i].asked = 1;
        pthread_mutex_unlock(&controls[i].lock);
        assert_int_equal(pthread_join(threads[i], &result), 0);
        assert_non_null(result);
        pthread_mutex_destroy(&controls[i].lock);
    }
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_enter, scratch_leave)
    const struct CMUnitTest tests[] = {
        TEST(threads_with_scenes_of_their_own),
        TEST(one_scene_in_many_renderers),
        TEST(renders_are_cancelled_from_outside),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
