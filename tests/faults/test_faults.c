/*
 * test_faults.c - small renders in which each call for memory, to files, threads and OpenCL fails
 * in turn: each ends with the right picture or with an error, all is freed, and the files that were
 * there are whole.
 *
 * The whole takes minutes; `make check-faults` runs it, by RT_TEST_LONG=1. Without that every so
 * manyth call fails. RT_FAULT_JOB picks jobs by a part of their name.
 */
#define _XOPEN_SOURCE 700

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "device/work_folder.h"
#include "faults/fault.h"
#include "faults/inject.h"
#include "faults/scene_files.h"
#include "lib/image/scratch.h"
#include "support.h"

/* ---- Jobs ------------------------------------------------------------------------------------ */

#define WORLD                                                                                      \
    "include \"materials.rts\"\n"                                                                  \
    "camera { eye 0 1.5 -5  look_at 0 0.8 0  fov 45 }\n"                                           \
    "quad { corner -4 0 -4  edge1 0 0 8  edge2 8 0 0  material paper }\n"                          \
    "sphere { centre 1 1 0  radius 0.9  material glass }\n"                                        \
    "model { file \"a.obj\"  material paper }\n"                                                   \
    "quad { corner -1 4 -1  edge1 2 0 0  edge2 0 0 2  material paper  radiance 8 }\n"              \
    "light point { position -2 3 -2  intensity 5 }\n"

typedef struct job {
    const char *name, *text;
} job;

static const job jobs[] = {
    {"path", WORLD "film { width 8  height 8 }\nrender { spp 2  variance true }\n"},
    {"direct", WORLD "film { width 8  height 8 }\nrender { mode direct  spp 1  aov true }\n"},
    {"normals", WORLD "film { width 8  height 8 }\nrender { mode normals  spp 1 }\n"},
    {"photon by neighbours", WORLD "film { width 8  height 8 }\n"
                                   "render { mode photon  photons 2000  k 20  gather flann }\n"},
    {"photon by the tree",
     WORLD "film { width 8  height 8 }\nrender { mode photon  photons 2000  caustic_photons 500  "
           "k 20  gather device  photon_layers true }\n"},
    {"final gather", WORLD "film { width 8  height 8 }\nrender { mode photon  photons 2000  k 20  "
                           "final_gather 1  spp 1 }\n"},
    {"files", SCENE_OF_FILES "film { width 8  height 8 }\nrender { mode albedo  spp 1 }\n"},
    {"passes",
     WORLD "film { width 8  height 8 }\nrender { mode photon  photons 1000  passes 3 }\n"},
};

/* Pictures, and the map of photon mapping without passes. */
static const char *const outputs[] = {"out.exr", "out.png", "out.ppm", "out.pfm", NULL};
static const char *const outputs_and_map[] = {"out.exr", "out.png", "out.ppm",
                                              "out.pfm", "out.rtp", NULL};

/* Writes the films of a renderer, and its photons. */
static rt_status write_all(rt_renderer *renderer, const rt_render_options *options, rt_error *error)
{
    rt_film *film = NULL;
    rt_photon_map *map = NULL, *again = NULL;
    rt_status status = rt_render(&film, renderer, options, error);
    for (size_t i = 0; outputs[i] && status == RT_OK; i++)
        status = rt_film_write(film, outputs[i], NULL, error);
    if (status == RT_OK && options->mode == RT_MODE_PHOTON && options->passes < 2) {
        status = rt_photon_map_emit(&map, renderer, NULL, error);
        if (status == RT_OK)
            status = rt_photon_map_save(map, "out.rtp", error);
        if (status == RT_OK)
            status = rt_photon_map_load(&again, "out.rtp", error);
    }
    rt_photon_map_destroy(again);
    rt_photon_map_destroy(map);
    rt_film_destroy(film);
    return status;
}

/* Does a job from its text to its files, on a device that is open, or on one of its own. */
static rt_status work(const job *job, rt_device *open, rt_error *error)
{
    rt_scene *scene = NULL;
    rt_renderer *renderer = NULL;
    rt_device *device = open;
    rt_render_options options;
    rt_status status = rt_scene_parse(&scene, job->text, NULL, NULL, error);
    if (status == RT_OK && !open)
        status = rt_device_open(&device, NULL, error);
    if (status == RT_OK)
        status = rt_renderer_create(&renderer, scene, device, NULL, error);
    if (status == RT_OK) {
        rt_scene_get_options(scene, &options);
        status = write_all(renderer, &options, error);
    }
    rt_renderer_destroy(renderer);
    if (!open)
        rt_device_close(device);
    rt_scene_destroy(scene);
    return status;
}

/* ---- Tests ----------------------------------------------------------------------------------- */

/* What a task does: a job, on a device that is open or on one of its own. */
typedef struct job_run {
    const job *job;
    rt_device *device;
} job_run;

static inject_end run(const void *data)
{
    const job_run *r = data;
    rt_error error;
    memset(&error, 0, sizeof error);
    rt_status status = work(r->job, r->device, &error);
    return status == RT_OK                                   ? INJECT_DONE
           : error.status == status && error.message[0] != 0 ? INJECT_ERROR
                                                             : INJECT_WRONG;
}

static int writes_map(const job *job)
{
    return strstr(job->text, "mode photon") && !strstr(job->text, "passes");
}

static void inject_job(const job *job, rt_device *device, long step, inject_tally *sum)
{
    const job_run r = {job, device};
    const inject_task task = {job->name, run, &r, writes_map(job) ? outputs_and_map : outputs};
    inject_all(&task, step, sum);
}

static void each_call_of_a_render(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof jobs / sizeof *jobs; i++) {
        inject_tally sum = {0, 0, 0};
        if (getenv("RT_FAULT_JOB") && !strstr(jobs[i].name, getenv("RT_FAULT_JOB")))
            continue;
        inject_job(&jobs[i], test_device(), inject_step(61), &sum);
        print_message("%s: %ld calls failed: %ld errors, %ld right pictures\n", jobs[i].name,
                      sum.calls, sum.errors, sum.survived);
        assert_true(sum.errors > 0);
    }
}

/* And of opening a device and building programs, which takes longer. */
static void each_call_of_a_run_that_opens_its_device(void **state)
{
    (void)state;
    inject_tally sum = {0, 0, 0};
    inject_job(&jobs[0], NULL, inject_step(211), &sum);
    print_message("with its device: %ld calls failed: %ld errors, %ld right pictures\n", sum.calls,
                  sum.errors, sum.survived);
}

/* What happens once in a process: a run of its own for each call. */
static int open_first(long n, int for_good)
{
    rt_device *device = NULL;
    rt_error error;
    memset(&error, 0, sizeof error);
    fault_arm(n, for_good);
    rt_status status = rt_device_open(&device, NULL, &error);
    fault_disarm();
    if (!fault_fired())
        return 100;
    if (status != RT_OK)
        return error.message[0] && error.status == status ? 1 : 2;
    rt_device_close(device);
    return 0;
}

static void each_call_of_the_first_opening(void **state)
{
    (void)state;
    inject_tally sum = {0, 0, 0};
    const char *given = getenv("POCL_CACHE_DIR");
    char *cache = given ? strdup(given) : NULL;
    setenv("POCL_CACHE_DIR", "kernels", 1);
    for (int for_good = 0; for_good < 2; for_good++)
        for (long n = 1;; n += inject_step(9)) {
            int status;
            fflush(NULL);
            pid_t child = fork();
            assert_int_not_equal(child, -1);
            if (child == 0)
                exit(open_first(n, for_good));
            assert_int_equal(waitpid(child, &status, 0), child);
            if (!WIFEXITED(status) || WEXITSTATUS(status) == 2)
                fail_msg("call %ld of the first opening: status %d", n, status);
            if (WEXITSTATUS(status) == 100)
                break;
            sum.calls++;
            sum.errors += WEXITSTATUS(status) == 1;
            sum.survived += WEXITSTATUS(status) == 0;
        }
    rt_folder_remove("kernels");
    /* The tests that follow find what is compiled already. */
    if (cache)
        setenv("POCL_CACHE_DIR", cache, 1);
    else
        unsetenv("POCL_CACHE_DIR");
    free(cache);
    print_message("first opening: %ld calls failed: %ld errors, %ld devices\n", sum.calls,
                  sum.errors, sum.survived);
    assert_true(sum.errors > 0);
}

int main(void)
{
    /* The first opening comes before any other, as a child would inherit what that leaves. */
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(each_call_of_the_first_opening, scene_files_enter,
                                        scratch_leave),
        cmocka_unit_test_setup_teardown(each_call_of_a_render, scene_files_enter, scratch_leave),
        cmocka_unit_test_setup_teardown(each_call_of_a_run_that_opens_its_device, scene_files_enter,
                                        scratch_leave),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
