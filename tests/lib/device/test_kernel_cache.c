/*
 * test_kernel_cache.c - compiled kernels between runs: kept, shared, damaged, and without a place
 * to keep them. The cache belongs to a process, so each run is one.
 */
#define _XOPEN_SOURCE 700

#include <dirent.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "../image/scratch.h"
#include "base/bytes.h"
#include "base/file.h"
#include "device/kernel_cache.h"
#include "device/kernel_store.h"
#include "device/work_folder.h"
#include "support.h"

/* ---- A run ----------------------------------------------------------------------------------- */

enum { items = 64, crowd = 3, threads = 8 }; /* items: as in the kernel */

static const char source_text[] =
    "__kernel void answer(__global uint *out)\n"
    "{ uint i = get_global_id(0); if (i < 64) out[i] = 3 * i + 1; }\n";
static const rt_kernel_piece piece = {(const unsigned char *)source_text, sizeof source_text - 1};
static const uint16_t order[] = {0};
static const rt_kernel_source sources[] = {{"answer", &piece, order, 1, sizeof source_text - 1},
                                           {NULL, NULL, NULL, 0, 0}};

/* Warnings of a run go into this file of the scratch directory. */
static void on_warning(void *user, const char *line)
{
    (void)user;
    FILE *file = fopen("warnings", "a");
    if (file) {
        fprintf(file, "%s\n", line);
        fclose(file);
    }
}

/* Of the runs that begin; a driver compiles for each by itself. */
static uint32_t work_group;

/* Opens a device, compiles the kernel and runs it. Returns the exit status of the run. */
static int answer(void)
{
    const rt_hooks hooks = {.warning = on_warning};
    const rt_device_options options = {.work_group = work_group};
    rt_device *device = NULL;
    cl_kernel kernel = NULL;
    cl_mem out = NULL;
    rt_error error;
    uint32_t values[items] = {0};
    int is_right = rt_device_open(&device, &options, &error) == RT_OK &&
                   rt_device_kernel_from(device, &kernel, sources, "answer", "answer", &hooks,
                                         &error) == RT_OK &&
                   rt_buffer_create(device, &out, CL_MEM_READ_WRITE, sizeof values, NULL,
                                    "the answer", &error) == RT_OK;
    if (is_right) {
        rt_arg args[] = {RT_ARG(out)};
        is_right = rt_kernel_args(kernel, args, 1, &error) == RT_OK &&
                   rt_launch(device, kernel, items, &error) == RT_OK &&
                   rt_device_finish(device, &error) == RT_OK &&
                   rt_buffer_read(device, out, 0, sizeof values, values, &error) == RT_OK;
    }
    rt_kernel_cache_tell(&hooks);
    for (uint32_t i = 0; i < items && is_right; i++)
        is_right = values[i] == 3 * i + 1;
    if (!is_right)
        on_warning(NULL, error.message);
    rt_buffer_release(device, out);
    rt_kernel_release(kernel);
    rt_device_close(device);
    return is_right ? 0 : error.status == RT_ERROR_DEVICE ? 3 : 1;
}

/* Leak checkers look at a process as it ends, with rights that a test may have given up. */
static int checked(int status)
{
#if defined(__SANITIZE_ADDRESS__)
    if (seteuid(getuid()) != 0)
        abort();
#endif
    return status;
}

/* Starts a process that calls work and ends as it returns. */
static pid_t begin(int (*work)(void))
{
    fflush(NULL);
    pid_t child = fork();
    assert_int_not_equal(child, -1);
    if (child == 0)
        exit(checked(work()));
    return child;
}

/* The exit status of a run, or 128 + the signal that ended it. */
static int end(pid_t child)
{
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

static int run(void)
{
    unlink("warnings");
    return end(begin(answer));
}

/* Checks what the last run warned of; NULL: nothing. */
static void expect_warning(const char *part)
{
    rt_bytes said = {0};
    rt_error error;
    if (access("warnings", F_OK) != 0) {
        if (part)
            fail_msg("no warning; expected '%s'", part);
        return;
    }
    expect_ok(rt_file_read(&said, "warnings", 1 << 16, &error), &error);
    expect_ok(rt_bytes_put(&said, said.size, "", 1, &error), &error);
    if (!part || !strstr((const char *)said.data, part))
        fail_msg("warned '%s' instead of '%s'", (const char *)said.data, part ? part : "nothing");
    rt_bytes_free(&said);
}

/* The only file in "cache", a stored program; work folders are gone. */
static const char *stored(void)
{
    static char path[RT_PATH_MAX];
    struct dirent *entry;
    int count = 0;
    DIR *folder = opendir("cache");
    assert_non_null(folder);
    while ((entry = readdir(folder)))
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0) {
            snprintf(path, sizeof path, "cache/%s", entry->d_name);
            count++;
        }
    closedir(folder);
    assert_int_equal(count, 1);
    assert_string_equal(path + strlen(path) - strlen(RT_STORED_SUFFIX), RT_STORED_SUFFIX);
    return path;
}

/* Whether the first device is PoCL's; asked in a process, as the cache belongs to one. */
static int ask_platform(void)
{
    rt_device_info *devices = NULL;
    size_t count = 0;
    setenv("POCL_CACHE_DIR", "asked", 1);
    int is_pocl = rt_devices_list(&devices, &count, NULL) == RT_OK && count > 0 &&
                  strcmp(devices[0].platform, "Portable Computing Language") == 0;
    rt_devices_free(devices);
    return is_pocl ? 0 : 1;
}

/* What is stored are the files of PoCL's cache; other drivers keep what they compile themselves. */
static void skip_unless_pocl(void)
{
    int is_pocl = end(begin(ask_platform)) == 0;
    rt_folder_remove("asked");
    if (is_pocl)
        return;
    print_message("only PoCL's kernels are stored\n");
    skip();
}

static ino_t stored_inode(void)
{
    struct stat info;
    assert_int_equal(stat(stored(), &info), 0);
    return info.st_ino;
}

static int enter(void **state)
{
    int code = scratch_enter(state);
    setenv("POCL_CACHE_DIR", "cache", 1);
    return code;
}

static int leave(void **state)
{
    static const char *const folders[] = {"cache", "from", "work"};
    for (size_t i = 0; i < sizeof folders / sizeof *folders; i++)
        rt_folder_remove(folders[i]);
    return scratch_leave(state);
}

/* What the first test stored, for those that begin with a stored program. */
static rt_bytes kept;
static char kept_path[RT_PATH_MAX];

static void keep_stored(void)
{
    rt_error error;
    rt_bytes_free(&kept);
    snprintf(kept_path, sizeof kept_path, "%s", stored());
    expect_ok(rt_file_read(&kept, kept_path, 1 << 26, &error), &error);
}

static void begin_with_stored(void)
{
    rt_error error;
    if (kept.size == 0) {
        assert_int_equal(run(), 0);
        return;
    }
    assert_int_equal(mkdir("cache", 0755), 0);
    expect_ok(rt_file_replace(kept_path, &kept, &error), &error);
}

static int free_stored(void **state)
{
    (void)state;
    rt_bytes_free(&kept);
    return 0;
}

/* ---- Tests ----------------------------------------------------------------------------------- */

static void a_second_run_takes_what_the_first_compiled(void **state)
{
    (void)state;
    skip_unless_pocl();
    assert_int_equal(run(), 0);
    expect_warning(NULL);
    ino_t first = stored_inode();
    assert_int_equal(run(), 0);
    expect_warning(NULL);
    /* What is fetched is not stored again. */
    assert_int_equal(stored_inode(), first);
    keep_stored();
}

/* As an answer, with folders in the work folder that builds which failed have left. */
static int answer_beside_others(void)
{
    char work[RT_PATH_MAX], kept_in[RT_PATH_MAX], path[RT_PATH_MAX + 32];
    const rt_bytes no_bitcode = {(uint8_t *)"none", 4, 4, NULL};
    rt_error error;
    if (rt_device_folders(work, kept_in, sizeof work, &error) != RT_OK)
        return 1;
    for (char letter = 'A'; letter <= 'P'; letter++) {
        snprintf(path, sizeof path, "%s/%cA/LEFT", work, letter);
        if (rt_folder_make(path) != 0)
            return 1;
        strcat(path, "/program.bc");
        if (rt_file_replace(path, &no_bitcode, &error) != RT_OK)
            return 1;
    }
    return answer();
}

static void what_a_failed_build_left_is_not_taken_for_a_program(void **state)
{
    (void)state;
    skip_unless_pocl();
    assert_int_equal(end(begin(answer_beside_others)), 0);
    expect_warning(NULL);
    ino_t first = stored_inode();
    assert_int_equal(run(), 0);
    expect_warning(NULL);
    assert_int_equal(stored_inode(), first);
}

/* Some bytes in the middle. */
static void damage(void)
{
    rt_bytes bytes = {0};
    rt_error error;
    const char *path = stored();
    expect_ok(rt_file_read(&bytes, path, 1 << 26, &error), &error);
    memset(bytes.data + bytes.size / 2, 0x5a, 64);
    expect_ok(rt_file_replace(path, &bytes, &error), &error);
    rt_bytes_free(&bytes);
}

/* Other damage is read by every_damaged_byte_is_seen. */
static void a_damaged_program_is_dropped_and_compiled_again(void **state)
{
    (void)state;
    skip_unless_pocl();
    begin_with_stored();
    damage();
    assert_int_equal(run(), 0);
    expect_warning("are damaged; they are compiled again");
    expect_warning(stored()); /* its name */
    assert_int_equal(run(), 0);
    expect_warning(NULL);
}

static void every_damaged_byte_is_seen(void **state)
{
    (void)state;
    rt_bytes bytes = {0};
    rt_error error;
    char folder[RT_STORED_FOLDER_MAX];
    size_t files;
    assert_int_equal(mkdir("from", 0700) | mkdir("from/a", 0700) | mkdir("from/a/b", 0700), 0);
    assert_int_equal(mkdir("work", 0700), 0);
    scratch_write("from/a/b/program.bc", "the program");
    scratch_write("from/a/b/kernel.so", "the kernel, and more of it");
    scratch_write("from/a/b/aside.temp", "not yet whole");
    expect_ok(rt_stored_write("stored", 42, "from", "a/b", &error), &error);
    expect_ok(rt_stored_read(folder, &files, "stored", 42, "work", &error), &error);
    assert_string_equal(folder, "a/b");
    assert_int_equal(files, 2);
    scratch_expect("work/a/b/program.bc", "the program");
    scratch_expect("work/a/b/kernel.so", "the kernel, and more of it");
    assert_int_equal(access("work/a/b/aside.temp", F_OK), -1);
    rt_folder_remove("work/a");

    expect_ok(rt_file_read(&bytes, "stored", 1 << 20, &error), &error);
    size_t whole = bytes.size;
    for (size_t i = 0; i < 2 * whole; i++) {
        uint8_t *at = &bytes.data[i % whole], old = *at;
        if (i < whole)
            *at ^= (uint8_t)(1 << (i % 8));
        else
            bytes.size = i - whole;
        FILE *file = fopen("damaged", "wb");
        assert_non_null(file);
        assert_int_equal(fwrite(bytes.data, 1, bytes.size, file), bytes.size);
        assert_int_equal(fclose(file), 0);
        assert_int_equal(rt_stored_read(folder, &files, "damaged", 42, "work", &error),
                         RT_ERROR_INPUT);
        assert_int_equal(access("work/a/b", F_OK), -1);
        *at = old;
        bytes.size = whole;
    }
    /* Nor is one taken for another program's. */
    assert_int_equal(rt_stored_read(folder, &files, "stored", 43, "work", &error), RT_ERROR_INPUT);
    rt_bytes_free(&bytes);
}

/* It may be read another time, by this process or by others. */
static void what_cannot_be_read_stays(void **state)
{
    struct rlimit before, none = {0, 0};
    char folder[RT_STORED_FOLDER_MAX];
    size_t files;
    rt_error error;
    (void)state;
    assert_int_equal(mkdir("from", 0700) | mkdir("from/a", 0700) | mkdir("work", 0700), 0);
    scratch_write("from/a/program.bc", "the program");
    expect_ok(rt_stored_write("stored", 42, "from", "a", &error), &error);
    assert_int_equal(getrlimit(RLIMIT_NOFILE, &before), 0);
    none.rlim_max = before.rlim_max;
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &none), 0);
    const rt_status status = rt_stored_read(folder, &files, "stored", 42, "work", &error);
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &before), 0);
    assert_int_equal(status, RT_ERROR_INPUT);
    assert_int_equal(access("stored", F_OK), 0);
    /* Nor what cannot be unpacked. */
    scratch_write("no_folder", "");
    assert_int_equal(rt_stored_read(folder, &files, "stored", 42, "no_folder", &error),
                     RT_ERROR_OUTPUT);
    expect_ok(rt_stored_read(folder, &files, "stored", 42, "work", &error), &error);
    scratch_expect("work/a/program.bc", "the program");
    scratch_write("stored", "no program");
    assert_int_equal(rt_stored_read(folder, &files, "stored", 42, "work", &error), RT_ERROR_INPUT);
    assert_int_not_equal(access("stored", F_OK), 0);
}

/* Fetches the stored program, with no descriptor to open it by. */
static int fetch_in_vain(void)
{
    const rt_hooks hooks = {.warning = on_warning};
    char work[RT_PATH_MAX], kept_in[RT_PATH_MAX];
    struct rlimit before, none = {0, 0};
    rt_error error;
    const char *at = strstr(kept_path, "answer-");
    if (!at || rt_device_folders(work, kept_in, sizeof work, &error) != RT_OK ||
        getrlimit(RLIMIT_NOFILE, &before) != 0)
        return 1;
    none.rlim_max = before.rlim_max;
    setrlimit(RLIMIT_NOFILE, &none);
    rt_kernel_cache_fetch(strtoull(at + strlen("answer-"), NULL, 16), "answer");
    setrlimit(RLIMIT_NOFILE, &before);
    rt_kernel_cache_tell(&hooks);
    return 0;
}

static void a_program_that_cannot_be_read_is_kept(void **state)
{
    (void)state;
    skip_unless_pocl();
    begin_with_stored();
    keep_stored();
    const ino_t first = stored_inode();
    assert_int_equal(end(begin(fetch_in_vain)), 0);
    expect_warning("they are compiled again");
    assert_int_equal(stored_inode(), first);
}

/* Where another process has stored the program since, for a work-group of its own. */
static void a_writer_keeps_what_others_stored(void **state)
{
    (void)state;
    rt_error error;
    char folder[RT_STORED_FOLDER_MAX];
    size_t files;
    assert_int_equal(mkdir("from", 0700) | mkdir("from/a", 0700) | mkdir("work", 0700), 0);
    scratch_write("from/a/program.bc", "the program");
    scratch_write("from/a/8.so", "for groups of 8");
    expect_ok(rt_stored_write("stored", 42, "from", "a", &error), &error);
    assert_int_equal(unlink("from/a/8.so"), 0);
    scratch_write("from/a/program.bc", "the program once more");
    scratch_write("from/a/16.so", "for groups of 16");
    expect_ok(rt_stored_write("stored", 42, "from", "a", &error), &error);
    expect_ok(rt_stored_read(folder, &files, "stored", 42, "work", &error), &error);
    assert_int_equal(files, 3);
    scratch_expect("work/a/program.bc", "the program");
    scratch_expect("work/a/8.so", "for groups of 8");
    scratch_expect("work/a/16.so", "for groups of 16");
    rt_folder_remove("work/a");
    /* The folder keeps its first name, where the driver took another one for the same program. */
    assert_int_equal(rename("from/a", "from/b"), 0);
    scratch_write("from/b/32.so", "for groups of 32");
    expect_ok(rt_stored_write("stored", 42, "from", "b", &error), &error);
    expect_ok(rt_stored_read(folder, &files, "stored", 42, "work", &error), &error);
    assert_string_equal(folder, "a");
    assert_int_equal(files, 4);
    scratch_expect("work/a/32.so", "for groups of 32");
    /* Nothing of another program, nor of what is damaged. */
    expect_ok(rt_stored_write("stored", 43, "from", "b", &error), &error);
    expect_ok(rt_stored_read(folder, &files, "stored", 43, "work", &error), &error);
    assert_string_equal(folder, "b");
    assert_int_equal(files, 3);
    scratch_write("stored", "no program");
    expect_ok(rt_stored_write("stored", 43, "from", "b", &error), &error);
    expect_ok(rt_stored_read(folder, &files, "stored", 43, "work", &error), &error);
    assert_int_equal(files, 3);
}

static void a_place_that_cannot_be_written_is_told(void **state)
{
    (void)state;
    skip_unless_pocl();
    scratch_write("cache", "no folder");
    assert_int_equal(run(), 0);
    expect_warning("compiled kernels are not kept: cache: Not a directory");
    unlink("cache");
    begin_with_stored();
    const char *path = stored();
    assert_int_equal(chmod(path, 0444) | chmod("cache", 0555) | chmod(".", 0777), 0);
    scratch_drop_rights();
    assert_int_equal(run(), 0); /* what is there is read */
    expect_warning(NULL);
    scratch_take_rights();
    assert_int_equal(chmod("cache", 0755) | unlink(path) | chmod("cache", 0555), 0);
    unlink("warnings");
    scratch_drop_rights();
    assert_int_equal(run(), 0);
    scratch_take_rights();
    expect_warning("/cache/answer-");
    assert_int_equal(chmod("cache", 0755), 0);
}

static int answer_without_room(void)
{
    const struct rlimit small = {1 << 16, 1 << 16};
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    return answer();
}

/* The stored program in "cache" while a run has its work folder there, too; 0: there is none. */
static ino_t stored_beside_work(void)
{
    char path[RT_PATH_MAX];
    struct dirent *entry;
    struct stat info = {0};
    DIR *folder = opendir("cache");
    while (folder && (entry = readdir(folder)))
        if (strstr(entry->d_name, RT_STORED_SUFFIX) &&
            snprintf(path, sizeof path, "cache/%s", entry->d_name) < RT_PATH_MAX)
            stat(path, &info);
    if (folder)
        closedir(folder);
    return info.st_ino;
}

/* Compiles a program of two kernels ahead, and notes whether both were stored at once. */
static int compile_ahead(void)
{
    const rt_hooks hooks = {.warning = on_warning};
    rt_device *device = NULL;
    rt_error error;
    const int is_right = rt_device_open(&device, NULL, &error) == RT_OK &&
                         rt_device_compile(device, "prefix_sum", &hooks, &error) == RT_OK;
    const ino_t before = stored_beside_work();
    rt_device_close(device);
    if (is_right && before > 0 && before == stored_beside_work())
        scratch_write("all_stored", "");
    return is_right ? 0 : 1;
}

static void kernels_compiled_ahead_are_stored_one_by_one(void **state)
{
    (void)state;
    skip_unless_pocl();
    assert_int_equal(end(begin(compile_ahead)), 0);
    expect_warning(NULL);
    assert_int_equal(access("all_stored", F_OK), 0);
}

static void kernels_compiled_ahead_and_not_kept_are_told(void **state)
{
    (void)state;
    skip_unless_pocl();
    scratch_write("cache", "no folder");
    assert_int_equal(end(begin(compile_ahead)), 0);
    expect_warning("compiled kernels are not kept: cache: Not a directory");
}

static void no_room_anywhere_is_a_device_error(void **state)
{
    (void)state;
    unlink("warnings");
    assert_int_equal(end(begin(answer_without_room)), 3);
    expect_warning("/cache (File too large), ");
    expect_warning("/tmp (File too large)");
    expect_warning("; TMPDIR may name another");
}

/* Many runs at once, all of which have the right answer. */
static void run_crowd(int (*work)(void), int count, uint32_t (*group)(int i))
{
    pid_t runs[crowd];
    for (int i = 0; i < count; i++) {
        work_group = group(i);
        runs[i] = begin(work);
    }
    for (int i = 0; i < count; i++)
        assert_int_equal(end(runs[i]), 0);
    work_group = 0;
}

static uint32_t the_usual(int i)
{
    (void)i;
    return 0;
}

static uint32_t one_of_two(int i)
{
    return i % 2 ? 4 : 8;
}

static void a_crowd_shares_a_cold_and_a_damaged_cache(void **state)
{
    (void)state;
    skip_unless_pocl();
    run_crowd(answer, crowd, the_usual);
    stored();
    damage();
    run_crowd(answer, 2, the_usual);
    stored();
    unlink("warnings");
    assert_int_equal(run(), 0);
    expect_warning(NULL);
}

static void a_crowd_keeps_kernels_of_all_work_groups(void **state)
{
    (void)state;
    skip_unless_pocl();
    run_crowd(answer, 2, one_of_two);
    ino_t first = stored_inode();
    for (int i = 0; i < 2; i++) {
        work_group = one_of_two(i);
        assert_int_equal(run(), 0);
        expect_warning(NULL);
        assert_int_equal(stored_inode(), first);
    }
    work_group = 0;
}

static int answer_and_die(void)
{
    rt_device *device;
    rt_error error;
    if (rt_device_open(&device, NULL, &error) == RT_OK)
        raise(SIGKILL);
    return 1;
}

static void a_killed_run_leaves_nothing_behind_for_long(void **state)
{
    (void)state;
    skip_unless_pocl();
    begin_with_stored();
    assert_int_equal(end(begin(answer_and_die)), 128 + SIGKILL);
    DIR *folder = opendir("cache");
    assert_non_null(folder);
    int count = 0;
    while (readdir(folder))
        count++;
    closedir(folder);
    assert_int_equal(count, 5); /* ".", "..", the program, its work folder and the claim */
    assert_int_equal(run(), 0);
    stored();
}

static void *open_and_close(void *failed)
{
    rt_device *device;
    rt_error error;
    for (int i = 0; i < 3; i++) {
        if (rt_device_open(&device, NULL, &error) != RT_OK)
            *(int *)failed = 1;
        else
            rt_device_close(device);
    }
    return NULL;
}

static int open_in_threads(void)
{
    pthread_t started[threads];
    int failed[threads] = {0}, all = 0;
    for (int i = 0; i < threads; i++)
        if (pthread_create(&started[i], NULL, open_and_close, &failed[i]) != 0)
            return 2;
    for (int i = 0; i < threads; i++) {
        pthread_join(started[i], NULL);
        all |= failed[i];
    }
    return all;
}

/* PoCL crashes where several threads start it. */
static void threads_may_open_the_first_device_at_once(void **state)
{
    (void)state;
    for (int i = 0; i < 5; i++)
        assert_int_equal(end(begin(open_in_threads)), 0);
}

int main(void)
{
#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, enter, leave)
    const struct CMUnitTest tests[] = {
        IN_SCRATCH(a_second_run_takes_what_the_first_compiled),
        IN_SCRATCH(what_a_failed_build_left_is_not_taken_for_a_program),
        IN_SCRATCH(a_damaged_program_is_dropped_and_compiled_again),
        IN_SCRATCH(every_damaged_byte_is_seen),
        IN_SCRATCH(what_cannot_be_read_stays),
        IN_SCRATCH(a_program_that_cannot_be_read_is_kept),
        IN_SCRATCH(a_writer_keeps_what_others_stored),
        IN_SCRATCH(a_place_that_cannot_be_written_is_told),
        IN_SCRATCH(kernels_compiled_ahead_are_stored_one_by_one),
        IN_SCRATCH(kernels_compiled_ahead_and_not_kept_are_told),
        IN_SCRATCH(no_room_anywhere_is_a_device_error),
        IN_SCRATCH(a_crowd_shares_a_cold_and_a_damaged_cache),
        IN_SCRATCH(a_crowd_keeps_kernels_of_all_work_groups),
        IN_SCRATCH(a_killed_run_leaves_nothing_behind_for_long),
        IN_SCRATCH(threads_may_open_the_first_device_at_once),
    };
    return cmocka_run_group_tests(tests, NULL, free_stored);
}
