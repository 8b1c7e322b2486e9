/* Whole files: what is written arrives, and what fails leaves nothing behind. */
#define _GNU_SOURCE /* getresuid */
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/claim.h"
#include "base/file.h"
#include "lib/image/scratch.h"

static rt_status replace(const char *path, const char *text, rt_error *error)
{
    rt_bytes bytes = {0};
    assert_int_equal(rt_bytes_put(&bytes, 0, text, strlen(text), NULL), RT_OK);
    rt_status status = rt_file_replace(path, &bytes, error);
    rt_bytes_free(&bytes);
    return status;
}

static void expect_failure(const char *path, int code)
{
    rt_error error = {0};
    assert_int_equal(replace(path, "text", &error), RT_ERROR_OUTPUT);
    assert_int_equal(error.status, RT_ERROR_OUTPUT);
    assert_non_null(strstr(error.message, path));
    assert_non_null(strstr(error.message, strerror(code)));
}

static mode_t mode_of(const char *path)
{
    struct stat status;
    assert_int_equal(stat(path, &status), 0);
    return status.st_mode & 07777;
}

static void a_gap_in_the_bytes_is_zero(void **state)
{
    (void)state;
    rt_bytes bytes = {0};
    assert_int_equal(rt_bytes_put(&bytes, 3, "ab", 2, NULL), RT_OK);
    assert_int_equal(rt_bytes_put(&bytes, 1, "c", 1, NULL), RT_OK);
    assert_int_equal(bytes.size, 5);
    assert_memory_equal(bytes.data, "\0c\0ab", 5);
    assert_int_equal(rt_bytes_put(&bytes, UINT64_MAX, "a", 1, NULL), RT_ERROR_MEMORY);
    assert_int_equal(bytes.size, 5);
    rt_bytes_free(&bytes);
    assert_null(bytes.data);
}

static void a_new_file_holds_the_bytes(void **state)
{
    (void)state;
    assert_int_equal(replace("new", "some text", NULL), RT_OK);
    scratch_expect("new", "some text");
    assert_int_equal(replace("./new", "", NULL), RT_OK);
    scratch_expect("new", "");
    assert_int_equal(scratch_count(), 1);
}

static void a_new_file_follows_the_umask(void **state)
{
    (void)state;
    mode_t old = umask(027);
    assert_int_equal(replace("new", "text", NULL), RT_OK);
    umask(old);
    assert_int_equal(mode_of("new"), 0640);
}

static void a_replaced_file_keeps_its_permissions(void **state)
{
    (void)state;
    scratch_write("old", "old");
    assert_int_equal(chmod("old", 0604), 0);
    assert_int_equal(replace("old", "new", NULL), RT_OK);
    scratch_expect("old", "new");
    assert_int_equal(mode_of("old"), 0604);
}

static void a_symbolic_link_stays(void **state)
{
    (void)state;
    struct stat status;
    scratch_write("target", "old");
    assert_int_equal(symlink("target", "link"), 0);
    assert_int_equal(replace("link", "new", NULL), RT_OK);
    scratch_expect("target", "new");
    assert_int_equal(lstat("link", &status), 0);
    assert_true(S_ISLNK(status.st_mode));
}

static void a_symbolic_link_to_nothing_gets_its_target(void **state)
{
    (void)state;
    struct stat status;
    assert_int_equal(symlink("./target", "link"), 0);
    assert_int_equal(symlink("missing/target", "lost"), 0);
    assert_int_equal(rt_file_write("link", "new", 3, NULL), RT_OK);
    scratch_expect("target", "new");
    assert_int_equal(lstat("link", &status), 0);
    assert_true(S_ISLNK(status.st_mode));
    expect_failure("lost", ENOENT);
}

static void the_longest_name_works(void **state)
{
    (void)state;
    char name[256];
    memset(name, 'n', 255);
    name[255] = '\0';
    assert_int_equal(replace(name, "text", NULL), RT_OK);
    scratch_expect(name, "text");
}

static void a_stale_temporary_file_does_not_matter(void **state)
{
    (void)state;
    char name[64];
    snprintf(name, sizeof name, ".rt-%ld-0.tmp", (long)getpid());
    scratch_write(name, "another's");
    assert_int_equal(replace("new", "text", NULL), RT_OK);
    scratch_expect("new", "text");
    scratch_expect(name, "another's");
}

/* As a killed run leaves it: made, claimed, and not removed. */
static void leave_temporary_file(int wait_for)
{
    char path[PATH_MAX], byte;
    int fd;
    if (rt_claim_new(&fd, path, sizeof path, "", ".rt-", ".tmp", 0666) != 0)
        _exit(1);
    if (read(wait_for, &byte, 1) != 1)
        _exit(1);
    _exit(0);
}

static void temporary_files_of_ended_processes_are_removed(void **state)
{
    (void)state;
    int pipes[2], status;
    char name[64];
    assert_int_equal(pipe(pipes), 0);
    fflush(NULL);
    pid_t child = fork();
    assert_int_not_equal(child, -1);
    if (child == 0)
        leave_temporary_file(pipes[0]);
    snprintf(name, sizeof name, ".rt-%ld-0.tmp", (long)child);
    const struct timespec nap = {0, 10000000};
    while (access(name, F_OK) != 0)
        nanosleep(&nap, NULL);
    nanosleep(&nap, NULL); /* it claims the file at once */
    /* It lives, and so does its file. */
    assert_int_equal(replace("new", "text", NULL), RT_OK);
    assert_int_equal(access(name, F_OK), 0);
    assert_int_equal(write(pipes[1], "x", 1), 1);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
    scratch_write(".rt-1-x.tmp", "a user's own");
    assert_int_equal(replace("new", "text", NULL), RT_OK);
    assert_int_not_equal(access(name, F_OK), 0);
    scratch_expect(".rt-1-x.tmp", "a user's own");
    close(pipes[0]);
    close(pipes[1]);
}

/* The one writer cleans its folder, the other writes in the same way and does not look. */
static void the_next_of_many_files_does_not_clean(void **state)
{
    (void)state;
    scratch_write(".rt-1-0.tmp", "left");
    scratch_write("old", "old");
    assert_int_equal(chmod("old", 0640), 0);
    assert_int_equal(symlink("old", "link"), 0);
    assert_int_equal(rt_file_write_another("link", "new", 3, NULL), RT_OK);
    scratch_expect("old", "new");
    struct stat info;
    assert_true(stat("old", &info) == 0 && (info.st_mode & 0777) == 0640);
    scratch_expect(".rt-1-0.tmp", "left");
    assert_int_equal(rt_file_write("next", "", 0, NULL), RT_OK);
    assert_int_equal(scratch_count(), 3);
}

/* Runs once in place of what the library calls next, as another process could come in between. */
static void (*in_rename)(void), (*in_geteuid)(void);

static void run_once(void (**what)(void))
{
    void (*now)(void) = *what;
    *what = NULL;
    if (now)
        now();
}

int rename(const char *from, const char *to)
{
    run_once(&in_rename);
    return renameat(AT_FDCWD, from, AT_FDCWD, to);
}

uid_t geteuid(void)
{
    uid_t real, effective, saved;
    run_once(&in_geteuid);
    return getresuid(&real, &effective, &saved) == 0 ? effective : (uid_t)-1;
}

/* Cleans up in another process. */
static void clean(void)
{
    int status;
    fflush(NULL);
    pid_t child = fork();
    assert_int_not_equal(child, -1);
    if (child == 0) {
        rt_claim_clean("", ".rt-", ".tmp", NULL);
        _exit(0);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
}

static void a_file_is_claimed_until_it_has_its_name(void **state)
{
    (void)state;
    in_rename = clean;
    assert_int_equal(replace("new", "text", NULL), RT_OK);
    assert_null(in_rename);
    scratch_expect("new", "text");
}

/* The next save of a process has the name that the one before had. */
static void save_again(void)
{
    assert_int_equal(rename(".rt-1-0.tmp", "saved"), 0);
    scratch_write(".rt-1-0.tmp", "next");
}

static void a_new_file_of_an_old_name_is_not_removed(void **state)
{
    (void)state;
    scratch_write(".rt-1-0.tmp", "first");
    in_geteuid = save_again;
    rt_claim_clean("", ".rt-", ".tmp", NULL);
    assert_null(in_geteuid);
    scratch_expect("saved", "first");
    scratch_expect(".rt-1-0.tmp", "next");
}

static void impossible_places_are_named(void **state)
{
    (void)state;
    assert_int_equal(mkdir("directory", 0700), 0);
    scratch_write("file", "text");
    expect_failure("missing/new", ENOENT);
    expect_failure("file/new", ENOTDIR);
    expect_failure("directory", EISDIR);
    expect_failure("", ENOENT);
    assert_int_equal(scratch_count(), 2);
}

static void an_unwritable_directory_is_left_alone(void **state)
{
    (void)state;
    assert_int_equal(mkdir("closed", 0500), 0);
    scratch_drop_rights();
    expect_failure("closed/new", EACCES);
    scratch_take_rights();
    assert_int_equal(access("closed/new", F_OK), -1);
}

/* Its folder cannot be opened, and so not be synchronised. */
static void a_directory_that_cannot_be_read_is_written_into(void **state)
{
    (void)state;
    assert_int_equal(mkdir("drop", 0333), 0);
    assert_int_equal(chmod("drop", 0333), 0);
    scratch_drop_rights();
    assert_int_equal(replace("drop/new", "text", NULL), RT_OK);
    scratch_take_rights();
    scratch_expect("drop/new", "text");
    assert_int_equal(unlink("drop/new"), 0);
}

static void a_full_device_is_an_error(void **state)
{
    (void)state;
    struct stat status;
    scratch_drop_rights();
    expect_failure("/dev/full", ENOSPC);
    assert_int_equal(stat("/dev/full", &status), 0);
    assert_true(S_ISCHR(status.st_mode));
}

static void a_device_is_written_in_place(void **state)
{
    (void)state;
    struct stat status;
    scratch_drop_rights();
    assert_int_equal(replace("/dev/null", "text", NULL), RT_OK);
    assert_int_equal(stat("/dev/null", &status), 0);
    assert_true(S_ISCHR(status.st_mode));
}

static void a_write_that_stops_midway_leaves_the_old_file(void **state)
{
    (void)state;
    struct rlimit old, small;
    rt_error error = {0};
    rt_bytes bytes = {0};
    char block[4096] = {0};
    for (int i = 0; i < 64; i++)
        assert_int_equal(rt_bytes_put(&bytes, bytes.size, block, sizeof block, NULL), RT_OK);
    scratch_write("picture", "old");

    /* Past the limit a write fails with EFBIG, as it does with ENOSPC on a full disk. */
    void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &old), 0);
    small = old;
    small.rlim_cur = 10000;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    rt_status of_old = rt_file_replace("picture", &bytes, &error);
    rt_status of_new = rt_file_replace("another", &bytes, NULL);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &old), 0);
    signal(SIGXFSZ, handler);

    rt_bytes_free(&bytes);
    assert_int_equal(of_old, RT_ERROR_OUTPUT);
    assert_int_equal(of_new, RT_ERROR_OUTPUT);
    assert_non_null(strstr(error.message, "picture"));
    assert_non_null(strstr(error.message, strerror(EFBIG)));
    scratch_expect("picture", "old");
    assert_int_equal(scratch_count(), 1);
}

static void a_long_path_keeps_the_cause_in_the_message(void **state)
{
    (void)state;
    char path[900];
    rt_error error = {0};
    memset(path, 'p', sizeof path - 1);
    path[sizeof path - 1] = '\0';
    assert_int_equal(replace(path, "text", &error), RT_ERROR_OUTPUT);
    assert_non_null(strstr(error.message, strerror(ENAMETOOLONG)));
}

static void reading_gives_the_whole_file(void **state)
{
    (void)state;
    rt_bytes bytes = {0};
    scratch_write("file", "some text");
    assert_int_equal(rt_file_read(&bytes, "file", 9, NULL), RT_OK);
    assert_int_equal(bytes.size, 9);
    assert_memory_equal(bytes.data, "some text", 9);
    rt_bytes_free(&bytes);
}

static void reading_fails_with_path_and_cause(void **state)
{
    (void)state;
    rt_bytes bytes = {0};
    rt_error error = {0};
    scratch_write("file", "some text");
    assert_int_equal(rt_file_read(&bytes, "file", 8, &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "larger than 8 bytes"));
    assert_int_equal(rt_file_read(&bytes, "missing", 8, &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "missing"));
    assert_non_null(strstr(error.message, strerror(ENOENT)));
    assert_int_equal(rt_file_read(&bytes, ".", 8, &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, strerror(EISDIR)));
    assert_int_equal(rt_file_read(&bytes, "/dev/zero", 1 << 20, NULL), RT_ERROR_INPUT);
    assert_null(bytes.data);
}

#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, scratch_enter, scratch_leave)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_gap_in_the_bytes_is_zero),
        IN_SCRATCH(a_new_file_holds_the_bytes),
        IN_SCRATCH(a_new_file_follows_the_umask),
        IN_SCRATCH(a_replaced_file_keeps_its_permissions),
        IN_SCRATCH(a_symbolic_link_stays),
        IN_SCRATCH(a_symbolic_link_to_nothing_gets_its_target),
        IN_SCRATCH(the_longest_name_works),
        IN_SCRATCH(a_stale_temporary_file_does_not_matter),
        IN_SCRATCH(temporary_files_of_ended_processes_are_removed),
        IN_SCRATCH(the_next_of_many_files_does_not_clean),
        IN_SCRATCH(a_file_is_claimed_until_it_has_its_name),
        IN_SCRATCH(a_new_file_of_an_old_name_is_not_removed),
        IN_SCRATCH(impossible_places_are_named),
        IN_SCRATCH(an_unwritable_directory_is_left_alone),
        IN_SCRATCH(a_directory_that_cannot_be_read_is_written_into),
        IN_SCRATCH(a_full_device_is_an_error),
        IN_SCRATCH(a_device_is_written_in_place),
        IN_SCRATCH(a_write_that_stops_midway_leaves_the_old_file),
        IN_SCRATCH(a_long_path_keeps_the_cause_in_the_message),
        IN_SCRATCH(reading_gives_the_whole_file),
        IN_SCRATCH(reading_fails_with_path_and_cause),
    };
    return cmocka_run_group_tests_name("lib/base/file", tests, NULL, NULL);
}
