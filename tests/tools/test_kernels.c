/*
 * test_kernels.c - kernels compiled ahead of a render, and by several processes at once: the cache
 * then holds what one process would have stored, and pictures have the same bytes.
 */
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include <dirent.h>

#include "device/work_folder.h"
#include "expect.h"
#include "lib/image/scratch.h"
#include "small_scene.h"
#include "spawn.h"

#define PHOTONS "a.rts --mode photon --photons 1000 --spp 1 --threads 2"

/* How many programs a cache holds, of these names alone. */
static int count_stored(const char *cache, const char *const *names, int count)
{
    int found = 0;
    struct dirent *entry;
    DIR *folder = opendir(cache);
    assert_non_null(folder);
    while ((entry = readdir(folder))) {
        int is_named = 0;
        if (entry->d_name[0] == '.')
            continue;
        for (int i = 0; i < count; i++) {
            const size_t length = strlen(names[i]);
            is_named |=
                strncmp(entry->d_name, names[i], length) == 0 && entry->d_name[length] == '-';
        }
        if (!is_named)
            fail_msg("%s holds %s", cache, entry->d_name);
        found++;
    }
    closedir(folder);
    return found;
}

/* Drivers that keep their own caches leave nothing to test. */
static int driver_leaves_the_cache_to_us(void)
{
    run run = run_rtc("devices");
    const int is_pocl = strstr(run.out, "Portable Computing Language") != NULL;
    run_free(&run);
    return is_pocl;
}

static void programs_are_compiled_ahead(void **state)
{
    static const char *const names[] = {"photon_emit_plain", "gather_neighbours"};
    (void)state;
    if (!driver_leaves_the_cache_to_us())
        skip();
    run run =
        run_rtc("POCL_CACHE_DIR=cold rtc kernels photon_emit_plain gather_neighbours --verbose");
    expect_status(&run, 0);
    expect_err(&run, "program gather_neighbours built in");
    assert_int_equal(count_stored("cold", names, 2), 2);
    run_free(&run);
}

static void a_program_that_is_none_is_named(void **state)
{
    (void)state;
    run run = run_rtc("kernels photon_flim");
    expect_status(&run, 2);
    expect_err(&run, "there is no kernel program 'photon_flim'");
    run_free(&run);
}

/*
 * A first render ends well, with two programs that the test before compiled ahead. How far it is
 * shows once it takes a while.
 */
static void programs_of_a_render_are_compiled_at_once(void **state)
{
    static const char *const names[] = {"photon_emit_plain", "photon_camera_plain", "photon_film",
                                        "gather_neighbours"};
    (void)state;
    if (!driver_leaves_the_cache_to_us())
        skip();
    scratch_write("a.rts", small_scene);
    run cold = run_rtc("POCL_CACHE_DIR=cold rtc " PHOTONS " --gather flann --verbose --out a.pfm");
    expect_status(&cold, 0);
    expect_err(&cold, "of 2 programs compiled");
    expect_no_err(&cold, "compile   0 %");
    assert_int_equal(count_stored("cold", names, 4), 4);
    run warm = run_rtc("POCL_CACHE_DIR=cold rtc " PHOTONS " --gather flann --out b.pfm");
    expect_status(&warm, 0);
    expect_no_err(&warm, "programs compiled");
    expect_same_files("a.pfm", "b.pfm");
    run_free(&cold);
    run_free(&warm);
}

/* Takes a program out of a cache. */
static void forget(const char *cache, const char *name)
{
    const size_t length = strlen(name);
    struct dirent *entry;
    char path[512];
    DIR *folder = opendir(cache);
    while (folder && (entry = readdir(folder)))
        if (strncmp(entry->d_name, name, length) == 0 && entry->d_name[length] == '-') {
            snprintf(path, sizeof path, "%s/%s", cache, entry->d_name);
            assert_int_equal(remove(path), 0);
        }
    if (folder)
        closedir(folder);
}

/* Of the cache that the test before left, without two of its programs. */
static void an_interrupt_ends_what_compiles(void **state)
{
    static char said[1 << 16];
    (void)state;
    if (!driver_leaves_the_cache_to_us())
        skip();
    scratch_write("a.rts", small_scene);
    forget("cold", "photon_film");
    forget("cold", "gather_neighbours");
    running running =
        start_rtc("POCL_CACHE_DIR=cold rtc " PHOTONS " --gather flann --progress json --out c.pfm");
    assert_int_equal(running_wait_for(&running, "\"compile\"", said, sizeof said), 0);
    assert_int_equal(kill(running.pid, SIGINT), 0);
    assert_int_equal(running_finish(&running, said, sizeof said), 130);
    expect_no_file("c.pfm");
    rt_folder_remove("cold");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(programs_are_compiled_ahead),
        cmocka_unit_test(a_program_that_is_none_is_named),
        cmocka_unit_test(programs_of_a_render_are_compiled_at_once),
        cmocka_unit_test(an_interrupt_ends_what_compiles),
    };
    return spawn_find_rtc() == 0 ? cmocka_run_group_tests(tests, scratch_enter, scratch_leave) : 1;
}
