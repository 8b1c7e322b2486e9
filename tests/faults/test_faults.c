/*
 * test_faults.c - small renders in which each call for memory, to files, threads and OpenCL fails
 * in turn: each ends with the right picture or with an error, all is freed, and the files that were
 * there are whole.
 *
 * The whole takes minutes; `make check-faults` runs it, by RT_TEST_LONG=1. Without that every so
 * manyth call fails. RT_FAULT_JOB picks jobs by a part of their name.
 */
#define _XOPEN_SOURCE 700

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/bytes.h"
#include "base/file.h"
#include "device/work_folder.h"
#include "faults/fault.h"
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
    {"files", "texture a { file \"a.png\" }\ntexture b { file \"a.exr\" }\n"
              "texture c { file \"a.pfm\" }\ntexture d { file \"a.ppm\" }\n"
              "material a { kd_texture a }\nmaterial b { kd_texture b }\n"
              "material c { kd_texture c }\nmaterial d { kd_texture d }\n"
              "camera { eye 0 1.5 -5  look_at 0 0.8 0  fov 45 }\n"
              "light environment { file \"a.exr\" }\n"
              "model { file \"a.ply\"  material a }\nmodel { file \"a.off\"  material b }\n"
              "model { file \"a.stl\"  material c }\nmodel { file \"a.obj\"  material d }\n"
              "film { width 8  height 8 }\nrender { mode albedo  spp 1 }\n"},
    {"passes",
     WORLD "film { width 8  height 8 }\nrender { mode photon  photons 1000  passes 3 }\n"},
};

static const char *const pictures[] = {"out.exr", "out.png", "out.ppm", "out.pfm"};
enum { picture_count = sizeof pictures / sizeof *pictures };

/* Writes the films of a renderer, and its photons. */
static rt_status write_all(rt_renderer *renderer, const rt_render_options *options, rt_error *error)
{
    rt_film *film = NULL;
    rt_photon_map *map = NULL, *again = NULL;
    rt_status status = rt_render(&film, renderer, options, error);
    for (size_t i = 0; i < picture_count && status == RT_OK; i++)
        status = rt_film_write(film, pictures[i], NULL, error);
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

/* ---- What is left ---------------------------------------------------------------------------- */

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

/* The files of a job, to be compared. */
enum { file_count = picture_count + 1 };
typedef rt_bytes files[file_count];

static const char *file_name(size_t i)
{
    return i < picture_count ? pictures[i] : "out.rtp";
}

static void files_read(files out)
{
    rt_error error;
    memset(out, 0, sizeof(files));
    for (size_t i = 0; i < file_count; i++)
        if (access(file_name(i), F_OK) == 0)
            expect_ok(rt_file_read(&out[i], file_name(i), 1 << 26, &error), &error);
}

static void files_free(files in)
{
    for (size_t i = 0; i < file_count; i++)
        rt_bytes_free(&in[i]);
}

static int is_same(const rt_bytes *a, const rt_bytes *b)
{
    return a->size == b->size && (a->size == 0 || memcmp(a->data, b->data, a->size) == 0);
}

/* Puts something else where the files will be. */
static void files_spoil(void)
{
    for (size_t i = 0; i < file_count; i++) {
        unlink(file_name(i));
        scratch_write(file_name(i), "old");
    }
}

/* Each file is whole, old or new; and new where the job succeeded. */
static void files_check(const files right, int is_done, const char *what, long n)
{
    static const rt_bytes old = {(uint8_t *)"old", 3, 3, NULL};
    files now;
    files_read(now);
    for (size_t i = 0; i < file_count; i++) {
        int is_new = is_same(&now[i], &right[i]);
        if (right[i].size > 0 && (is_done ? !is_new : !is_new && !is_same(&now[i], &old)))
            fail_msg("%s, call %ld (%s): %s is wrong", what, n, fault_fired(), file_name(i));
    }
    files_free(now);
}

/* ---- Tests ----------------------------------------------------------------------------------- */

typedef struct tally {
    long calls, errors, survived;
} tally;

/* Makes the n-th call fail, and looks at what comes of it. */
static int inject(const job *job, rt_device *device, const files right, long n, int for_good,
                  tally *sum)
{
    rt_error error;
    memset(&error, 0, sizeof error);
    files_spoil();
    int descriptors = entries("/proc/self/fd"), names = entries(".");
    long blocks = fault_live();
    fault_arm(n, for_good);
    rt_status status = work(job, device, &error);
    fault_disarm();
    if (!fault_fired())
        return 0;
    files_check(right, status == RT_OK, job->name, n);
    if (status != RT_OK && (error.status != status || !error.message[0]))
        fail_msg("%s, call %ld (%s): status %d without a message", job->name, n, fault_fired(),
                 status);
    if (fault_live() != blocks || entries("/proc/self/fd") != descriptors)
        fail_msg("%s, call %ld (%s): %ld blocks and %d descriptors more than before (status %d)",
                 job->name, n, fault_fired(), fault_live() - blocks,
                 entries("/proc/self/fd") - descriptors, status);
    if (!for_good && entries(".") != names)
        fail_msg("%s, call %ld (%s): a file is left behind", job->name, n, fault_fired());
    sum->calls++;
    sum->errors += status != RT_OK;
    sum->survived += status == RT_OK;
    return 1;
}

/* All calls of a job, or every so manyth. */
static void inject_all(const job *job, rt_device *device, long step, tally *sum)
{
    rt_error error;
    files right;
    files_spoil();
    expect_ok(work(job, device, &error), &error);
    files_read(right);
    fault_arm(0, 0);
    expect_ok(work(job, device, &error), &error);
    assert_true(fault_disarm() > 50);
    files_check(right, 1, job->name, 0);
    for (int for_good = 0; for_good < 2; for_good++)
        for (long n = 1 + for_good * step / 2; inject(job, device, right, n, for_good, sum);
             n += step)
            ;
    files_free(right);
}

static long step(long quick)
{
    return getenv("RT_TEST_LONG") ? 1 : quick;
}

static void each_call_of_a_render(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof jobs / sizeof *jobs; i++) {
        tally sum = {0, 0, 0};
        if (getenv("RT_FAULT_JOB") && !strstr(jobs[i].name, getenv("RT_FAULT_JOB")))
            continue;
        inject_all(&jobs[i], test_device(), step(61), &sum);
        print_message("%s: %ld calls failed: %ld errors, %ld right pictures\n", jobs[i].name,
                      sum.calls, sum.errors, sum.survived);
        assert_true(sum.errors > 0);
    }
}

/* And of opening a device and building programs, which takes longer. */
static void each_call_of_a_run_that_opens_its_device(void **state)
{
    (void)state;
    tally sum = {0, 0, 0};
    inject_all(&jobs[0], NULL, step(211), &sum);
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
    tally sum = {0, 0, 0};
    const char *given = getenv("POCL_CACHE_DIR");
    char *cache = given ? strdup(given) : NULL;
    setenv("POCL_CACHE_DIR", "kernels", 1);
    for (int for_good = 0; for_good < 2; for_good++)
        for (long n = 1;; n += step(9)) {
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

/* Files that the jobs read. */
static int enter(void **state)
{
    static const char *const names[] = {"a.png", "a.exr", "a.pfm", "a.ppm"};
    const float rgb[12] = {0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 0.7f, 0.3f, 0.2f, 0.5f, 0.1f, 0.4f, 0.6f};
    rt_image *image = NULL;
    if (scratch_enter(state) != 0 || rt_image_from_rgb(&image, rgb, 2, 2, NULL) != RT_OK)
        return -1;
    int code = 0;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (rt_image_write(image, names[i], NULL, NULL) != RT_OK)
            code = -1;
    rt_image_destroy(image);
    scratch_write("a.obj", "v -2 3 1\nv 2 3 1\nv 0 4 2\nv 0 3 3\nf 1 2 3\nf 1 3 4\nf 2 4 3\n");
    scratch_write("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                           "property float y\nproperty float z\nelement face 1\n"
                           "property list uchar int vertex_indices\nend_header\n"
                           "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    scratch_write("a.off", "OFF\n3 1 0\n0 0 1\n-1 0 1\n0 1 1\n3 0 1 2\n");
    scratch_write("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 2\n"
                           "vertex 1 2 2\nvertex 0 2 2\nendloop\nendfacet\nendsolid a\n");
    scratch_write("materials.rts", "texture picture { file \"a.ppm\" }\n"
                                   "material paper { kd_texture picture }\n"
                                   "material glass { kt 1  ior 1.5  fresnel dielectric }\n");
    return code;
}

int main(void)
{
    /* The first opening comes before any other, as a child would inherit what that leaves. */
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(each_call_of_the_first_opening, enter, scratch_leave),
        cmocka_unit_test_setup_teardown(each_call_of_a_render, enter, scratch_leave),
        cmocka_unit_test_setup_teardown(each_call_of_a_run_that_opens_its_device, enter,
                                        scratch_leave),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
