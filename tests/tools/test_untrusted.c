/*
 * test_untrusted.c - --untrusted: scenes that reach out of their folder are refused, and what a
 * process may still do afterwards. The second part is skipped where the system has no Landlock.
 */
#define _GNU_SOURCE

#include <errno.h>
#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "device/work_folder.h"
#include "expect.h"
#include "lib/image/scratch.h"
#include "small_scene.h"
#include "spawn.h"
#include "tools/status.h"
#include "tools/untrusted.h"

/* A folder "in" for the scene, another, "out", and a secret beside them. */
static int enter(void **state)
{
    if (scratch_enter(state) != 0 || mkdir("in", 0755) != 0 || mkdir("out", 0755) != 0)
        return -1;
    scratch_write("secret.rts", "material secret { kd 0.5 }\n");
    scratch_write("in/part.rts", "material white { kd 0.7 }\n");
    return symlink("../secret.rts", "in/link.rts") | symlink("..", "in/up") |
           symlink("part.rts", "in/inside.rts");
}

static int leave(void **state)
{
    rt_folder_remove("in");
    rt_folder_remove("out");
    rt_folder_remove("kernels");
    return scratch_leave(state);
}

/* Whether this system can give up rights; otherwise the test counts as skipped. */
static void need_landlock(void)
{
    scratch_write("in/empty.rts", "");
    run run = run_rtc("check in/empty.rts --untrusted");
    int lacks = run.status == STATUS_DEVICE;
    if (lacks)
        print_message("%s", run.err);
    run_free(&run);
    if (lacks)
        skip();
}

/* The files of other devices stay closed to an untrusted run. */
static void need_cpu(void)
{
    if (device_is_cpu())
        return;
    print_message("an untrusted run opens a CPU device alone\n");
    skip();
}

static void files_outside_of_the_folder_are_refused(void **state)
{
    static const char *const texts[] = {
        "include \"../secret.rts\"\n",
        "include \"/etc/passwd\"\n",
        "include \"link.rts\"\n",
        "include \"up/secret.rts\"\n",
        "include \"up/in/../secret.rts\"\n",
        "include \"../missing.rts\"\n",
        "texture t { file \"/etc/passwd\" }\n",
        "texture t { file \"up/a.png\" }\n",
        "material m { kd 1 }\nmodel { file \"../a.ply\"  material m }\n",
        "light environment { file \"/etc/passwd\" }\n",
    };
    (void)state;
    need_landlock();
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        scratch_write("in/a.rts", texts[i]);
        run check = run_rtc("check in/a.rts --untrusted");
        expect_status(&check, STATUS_INPUT);
        expect_err(&check, "lies outside of the scene's folder");
        expect_no_err(&check, "root:");
        run_free(&check);
        run render = run_rtc("in/a.rts --untrusted --out out/a.pfm");
        expect_status(&render, STATUS_INPUT);
        run_free(&render);
        unlink("in/a.rts");
    }
    expect_no_file("out/a.pfm");
}

static void files_in_the_folder_are_read(void **state)
{
    (void)state;
    need_landlock();
    need_cpu();
    scratch_write("in/colour.ppm", "P6\n1 1\n255\nabc");
    scratch_write("in/a.rts", "include \"inside.rts\"\ntexture t { file \"colour.ppm\" }\n"
                              "material painted { kd_texture t }\n"
                              "camera { eye 0 1.5 -5  look_at 0 0.8 0  fov 45 }\n"
                              "film { width 8  height 8 }\n"
                              "sphere { centre 0 1 0  radius 1  material painted }\n"
                              "quad { corner -1 4 -1  edge1 2 0 0  edge2 0 0 2  material white  "
                              "radiance 8 }\n");
    run run = run_rtc("in/a.rts --untrusted --spp 1 --out out/a.pfm");
    expect_status(&run, 0);
    run_free(&run);
    expect_file("out/a.pfm");
    /* Also where the driver has everything to compile. */
    run = run_rtc("POCL_CACHE_DIR=kernels rtc in/a.rts --untrusted --mode normals --spp 1 "
                  "--out out/b.pfm");
    expect_status(&run, 0);
    expect_err(&run, "compiled kernels are not kept");
    run_free(&run);
    expect_file("out/b.pfm");
}

/* ---- What is left to a process --------------------------------------------------------------- */

static int can_open(const char *path, int how)
{
    int fd = open(path, how, 0600);
    if (fd >= 0)
        close(fd);
    return fd >= 0;
}

/* Gives up rights and tries what they were for. Returns which try went wrong, from 1, or 0. */
static int try_all(void)
{
    static const char *const outputs[] = {"out/a.exr"};
    const untrusted_needs needs = {"in/a.rts", NULL, outputs, 1, 0};
    struct rlimit limit;
    if (untrusted_confine(&needs) != STATUS_DONE)
        return 100;
    if (!can_open("in/a.rts", O_RDONLY) || !can_open("out/new", O_WRONLY | O_CREAT))
        return 1;
    if (can_open("/etc/passwd", O_RDONLY) || can_open("secret.rts", O_RDONLY) ||
        can_open("in/link.rts", O_RDONLY))
        return 2;
    if (can_open("in/new", O_WRONLY | O_CREAT) || can_open("in/a.rts", O_WRONLY) ||
        can_open("/tmp/librt-untrusted", O_WRONLY | O_CREAT))
        return 3;
    if (unlink("in/a.rts") == 0 || rename("out/new", "new") == 0 || mkdir("more", 0700) == 0)
        return 4;
    int connection = socket(AF_INET, SOCK_STREAM, 0);
    if (connection >= 0)
        close(connection);
    if (connection >= 0 || errno != EPERM)
        return 5;
    if (getrlimit(RLIMIT_CPU, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY ||
        getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return 6;
    return 0;
}

static void rights_are_gone(void **state)
{
    int status;
    (void)state;
    need_landlock();
    scratch_write("in/a.rts", small_scene);
    fflush(NULL);
    pid_t child = fork();
    assert_int_not_equal(child, -1);
    if (child == 0)
        _exit(try_all());
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
}

/* By the number of iterations: what shapes need of memory is tested below. */
static void a_scene_that_repeats_without_end_is_refused(void **state)
{
    (void)state;
    need_landlock();
    scratch_write("in/a.rts", "material m { kd 1 }\n"
                              "repeat i from 1 to 9000000 { repeat j from 1 to 9000000 { } }\n");
    run run = run_rtc("check in/a.rts --untrusted");
    expect_status(&run, STATUS_INPUT);
    expect_err(&run, "iterations");
    run_free(&run);
}

/* Millions of shapes in a few lines, and a film of many GiB. */
static void a_scene_that_fills_memory_is_refused(void **state)
{
    (void)state;
    need_landlock();
    need_cpu();
    scratch_write("in/a.rts", "material m { kd 1 }\n"
                              "repeat i from 1 to 2000000 {\n"
                              "sphere { centre i 0 0  radius 1  material m } }\n");
    run run = run_rtc("check in/a.rts --untrusted --memory 100M");
    expect_status(&run, STATUS_DEVICE);
    expect_err(&run, "100 MiB");
    run_free(&run);
    scratch_write("in/a.rts",
                  "camera { eye 0 0 -1  look_at 0 0 0  fov 40 }\n"
                  "film { width 16384  height 16384 }\n"
                  "material m { kd 1 }\nsphere { centre 0 0 0  radius 1  material m }\n");
    run = run_rtc("in/a.rts --untrusted --spp 1 --aov --out out/a.exr");
    expect_status(&run, STATUS_DEVICE);
    expect_err(&run, "4 GiB");
    run_free(&run);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, enter, leave)
    const struct CMUnitTest tests[] = {
        TEST(files_outside_of_the_folder_are_refused),
        TEST(files_in_the_folder_are_read),
        TEST(rights_are_gone),
        TEST(a_scene_that_repeats_without_end_is_refused),
        TEST(a_scene_that_fills_memory_is_refused),
    };
    return spawn_find_rtc() == 0 ? cmocka_run_group_tests(tests, NULL, NULL) : 1;
}
