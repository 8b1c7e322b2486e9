/*
 * test_untrusted.c - --untrusted: scenes that reach out of their folder are refused, and what a
 * process may still do afterwards. The second part is skipped where the system has no Landlock.
 */
#define _GNU_SOURCE

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/mount.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <sys/xattr.h>
#include <time.h>
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
    scratch_write("colour.ppm", "P6\n1 1\n255\nabc");
    scratch_write("in/painted.ply",
                  "ply\nformat ascii 1.0\ncomment TextureFile ../colour.ppm\nelement vertex 3\n"
                  "property float x\nproperty float y\nproperty float z\nelement face 1\n"
                  "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n"
                  "3 0 1 2\n");
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

/* Whether this system can give up rights, by its own word; otherwise the test is skipped. */
static void need_landlock(void)
{
    if (has_landlock())
        return;
    print_message("this system has no Landlock of version 2\n");
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
        "material m { kd 1 }\nmodel { file \"painted.ply\"  material m }\n",
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
        run dump = run_rtc("in/a.rts --untrusted --dump");
        expect_status(&dump, STATUS_INPUT);
        expect_err(&dump, "lies outside of the scene's folder");
        run_free(&dump);
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

/* The scene itself may be a link; what comes from stdin lies in no folder. */
static void a_scene_that_leads_elsewhere_is_refused(void **state)
{
    static const char text[] = "include \"in/part.rts\"\n";
    static const char *const lines[] = {"check in/link.rts --untrusted", "in/link.rts --untrusted",
                                        "in/link.rts --dump --untrusted",
                                        "photons in/link.rts --untrusted --out out/a.rtp",
                                        "import in/link.obj --untrusted --out out/a.rts"};
    (void)state;
    need_landlock();
    assert_int_equal(symlink("../secret.rts", "in/link.obj"), 0);
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        run run = run_rtc("%s", lines[i]);
        expect_status(&run, STATUS_INPUT);
        expect_err(&run, "leads to no file in its folder");
        run_free(&run);
    }
    run run = run_rtc_input(text, strlen(text), "check - --untrusted");
    expect_status(&run, STATUS_INPUT);
    expect_err(&run, "lies outside of the scene's folder");
    run_free(&run);
    run = run_rtc_input("film { width 4 }", 16, "check - --untrusted");
    expect_status(&run, STATUS_DONE);
    run_free(&run);
}

/* What an import reads, a scene of the stranger names; it writes into the folder of the outputs. */
static void an_import_reads_in_its_folder(void **state)
{
    (void)state;
    need_landlock();
    scratch_write("outside.mtl", "newmtl m\n");
    scratch_write("in/a.obj", "mtllib ../outside.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    expect_rtc(STATUS_DONE, "import in/a.obj --out out/a.rts");
    run run = run_rtc("import in/a.obj --untrusted --out out/b.rts");
    expect_status(&run, STATUS_DONE);
    expect_err(&run, "or outside of the scene's folder: the library of materials is left out");
    run_free(&run);
    scratch_write("in/a.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
    expect_rtc(STATUS_DONE, "import in/a.obj --untrusted --out out/b.rts");
    expect_rtc(STATUS_DONE, "import in/a.obj --untrusted --out out/a.rts"); /* over the first */
    expect_same_files("out/a_files/mesh_1.ply", "out/b_files/mesh_1.ply");
}

/* A scene of another program is taken apart in the folder of the picture, and nothing stays. */
static void a_foreign_scene_is_read_in_its_folder(void **state)
{
    (void)state;
    need_landlock();
    scratch_write("outside.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
    scratch_write("in/b.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
    scratch_write("in/a.xml",
                  "<scene><shape type=\"obj\"><string name=\"filename\" value=\"b.obj\"/></shape>"
                  "<shape type=\"obj\"><string name=\"filename\" value=\"../outside.obj\"/>"
                  "</shape></scene>");
    assert_int_equal(mkdir("made", 0777), 0);
    run run = run_rtc("in/a.xml --untrusted --spp 1 --width 4 --height 4 --out made/a.pfm");
    expect_status(&run, STATUS_DONE);
    expect_err(&run, "'../outside.obj' is not there, or outside of the scene's folder");
    run_free(&run);
    assert_int_equal(unlink("made/a.pfm"), 0);
    assert_int_equal(rmdir("made"), 0);
    run = run_rtc("check in/a.xml --untrusted");
    expect_status(&run, STATUS_USAGE);
    expect_err(&run, "rtc import in/a.xml --untrusted --out NAME.rts");
    run_free(&run);
}

/* Pipes would be waited for without end. */
static void pipes_are_refused(void **state)
{
    static const struct {
        const char *line;
        int status;
    } tries[] = {
        {"check in/pipe --untrusted", STATUS_INPUT},
        {"in/pipe --untrusted --out out/a.png", STATUS_INPUT},
        {"--resume in/pipe --untrusted --out out/a.png", STATUS_INPUT},
        {"in/a.rts --photon-map in/pipe --mode photon --untrusted --out out/a.png", STATUS_INPUT},
        {"import in/pipe --untrusted --out out/a.rts", STATUS_INPUT},
        {"in/a.rts --untrusted --spp 1 --out out/pipe.png", STATUS_OUTPUT},
    };
    (void)state;
    need_landlock();
    scratch_write("in/a.rts", small_scene);
    assert_int_equal(mkfifo("in/pipe", 0600) | mkfifo("out/pipe.png", 0600), 0);
    for (size_t i = 0; i < sizeof tries / sizeof *tries; i++) {
        run run = run_rtc("%s", tries[i].line);
        expect_status(&run, tries[i].status);
        expect_err(&run, "is not a regular file");
        run_free(&run);
    }
}

/* What is to be overwritten may be looked at, where it is work. */
static void other_work_is_not_overwritten(void **state)
{
    static const struct {
        const char *line;
        int status;
    } tries[] = {
        {"in/a.rts --spp 1 --quiet --out out/a.rtpart", STATUS_DONE},
        {"in/b.rts --spp 1 --quiet --untrusted --out out/a.rtpart", STATUS_USAGE},
        {"photons in/a.rts --photons 100 --quiet --out out/a.rtp", STATUS_DONE},
        {"photons in/b.rts --photons 100 --quiet --untrusted --out out/a.rtp", STATUS_USAGE}};
    (void)state;
    need_landlock();
    need_cpu();
    scratch_write("in/a.rts", small_scene);
    scratch_write("in/b.rts", small_scene);
    FILE *file = fopen("in/b.rts", "a");
    assert_non_null(file);
    assert_true(fputs("light point { position 0 1 0  intensity 3 }\n", file) > 0);
    fclose(file);
    for (size_t i = 0; i < sizeof tries / sizeof *tries; i++) {
        run run = run_rtc("%s", tries[i].line);
        expect_status(&run, tries[i].status);
        run_free(&run);
    }
}

/* Before the picture is rendered, which could not be written. */
static void outputs_that_lead_elsewhere_are_refused(void **state)
{
    (void)state;
    need_landlock();
    scratch_write("in/a.rts", small_scene);
    scratch_write("victim.png", "precious");
    assert_int_equal(symlink("../victim.png", "out/a.png") | symlink("../none.png", "out/b.png"),
                     0);
    for (int i = 0; i < 2; i++) {
        run run = run_rtc("in/a.rts --untrusted --spp 1 --out out/%c.png", i + 'a');
        expect_status(&run, STATUS_OUTPUT);
        expect_err(&run, "leads to no file in its folder");
        run_free(&run);
    }
    unlink("victim.png");
}

static void photons_are_emitted_and_gone_on_with(void **state)
{
    (void)state;
    need_landlock();
    need_cpu();
    scratch_write("in/a.rts", small_scene);
    static const char *const lines[] = {
        "photons in/a.rts --untrusted --photons 1000 --quiet --out out/a.rtp",
        "photons in/a.rts --untrusted --photons 2000 --resume out/a.rtp --quiet --out out/b.rtp",
        "in/a.rts --untrusted --mode photon --photon-map out/b.rtp --spp 1 --quiet --out out/b.pfm",
        "in/a.rts --untrusted --dump"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        run run = run_rtc("%s", lines[i]);
        expect_status(&run, STATUS_DONE);
        run_free(&run);
    }
}

/* ---- What is left to a process --------------------------------------------------------------- */

static void *do_nothing(void *data)
{
    return data;
}

static int can_open(const char *path, int how)
{
    int fd = open(path, how, 0600);
    if (fd >= 0)
        close(fd);
    return fd >= 0;
}

/* Whether a system call is refused. */
static int is_refused(long result)
{
    return result == -1 && errno == EPERM;
}

/* Calls that reach beyond the process, or past Landlock. */
static int try_calls(void)
{
    struct rlimit limit;
    struct stat info;
    if (!is_refused(kill(getppid(), 0)) || !is_refused(kill(-1, 0)) || kill(getpid(), 0) != 0)
        return 20;
    if (!is_refused(truncate("out/old", 0)) || !is_refused(chmod("in/a.rts", 0777)) ||
        !is_refused(setxattr("out/old", "user.a", "a", 1, 0)))
        return 21;
    if (!is_refused(syscall(SYS_clone, CLONE_NEWUSER | SIGCHLD, NULL, NULL, NULL, 0)) ||
        !is_refused(unshare(CLONE_NEWNS)) || !is_refused(mount("a", "b", "c", 0, NULL)))
        return 22;
    if (!is_refused(prlimit(getppid(), RLIMIT_CPU, NULL, &limit)) ||
        !is_refused(ptrace(PTRACE_ATTACH, getppid(), NULL, NULL)) ||
        !is_refused(ioctl(STDIN_FILENO, TIOCSTI, "a")))
        return 23;
    if (!is_refused(syscall(SYS_io_uring_setup, 1, &info)) ||
        !is_refused(syscall(SYS_keyctl, 0, 0, 0, 0, 0)) ||
        !is_refused(syscall(SYS_bpf, 0, NULL, 0)) || !is_refused(shmget(IPC_PRIVATE, 1, 0600)))
        return 24;
    /* One of those that came later: fchmodat2. */
    if (syscall(452, AT_FDCWD, "in/a.rts", 0777, 0) == 0 || errno != ENOSYS)
        return 27;
    /* Only an open file may be marked as used now, as kernels that are kept are. */
    const struct timespec past[2] = {{0, 0}, {0, 0}};
    const int file = open("in/a.rts", O_RDONLY);
    if (!is_refused(utimensat(AT_FDCWD, "in/a.rts", NULL, 0)) || futimens(file, NULL) != 0 ||
        !is_refused(futimens(file, past)))
        return 29;
    int ends[2];
    if (pipe(ends) != 0 || !is_refused(fcntl(ends[0], F_SETOWN, getppid())) ||
        fcntl(ends[0], F_SETFL, O_NONBLOCK) != 0)
        return 28;
    /* What is needed goes on: a thread, a child. */
    pthread_t thread;
    if (pthread_create(&thread, NULL, do_nothing, NULL) != 0 || pthread_join(thread, NULL) != 0)
        return 25;
    int status;
    pid_t child = fork();
    if (child == 0)
        _exit(3);
    if (child < 0 || waitpid(child, &status, 0) != child || WEXITSTATUS(status) != 3)
        return 26;
    return 0;
}

/* Gives up rights and tries what they were for. Returns which try went wrong, from 1, or 0. */
static int try_all(void)
{
    static const char *const outputs[] = {"out/a.exr"};
    const untrusted_needs needs = {.scene = "in/a.rts", .outputs = outputs, .output_count = 1};
    /* One that is lower already stays. */
    struct rlimit limit = {60, RLIM_INFINITY};
    if (getrlimit(RLIMIT_CPU, &limit) != 0)
        return 99;
    limit.rlim_cur = 60;
    if (setrlimit(RLIMIT_CPU, &limit) != 0 || untrusted_confine(&needs) != STATUS_DONE)
        return 100;
    if (!can_open("in/a.rts", O_RDONLY) || !can_open("out/new", O_WRONLY | O_CREAT))
        return 1;
    if (can_open("/etc/passwd", O_RDONLY) || can_open("secret.rts", O_RDONLY) ||
        can_open("in/link.rts", O_RDONLY) || can_open("out/old", O_RDONLY))
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
    if (getrlimit(RLIMIT_CPU, &limit) != 0 || limit.rlim_cur != 60 ||
        getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur != (rlim_t)4 << 30)
        return 6;
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur != (rlim_t)6 << 30)
        return 7;
#endif
    return try_calls();
}

static void rights_are_gone(void **state)
{
    int status;
    (void)state;
    need_landlock();
    scratch_write("in/a.rts", small_scene);
    scratch_write("out/old", "of another");
    fflush(NULL);
    pid_t child = fork();
    assert_int_not_equal(child, -1);
    if (child == 0)
        _exit(try_all());
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
}

/* Waits until a file is there. */
static void wait_for(const running *job, const char *path)
{
    for (int waits = 0; waits < 6000 && access(path, F_OK) != 0 && kill(job->pid, 0) == 0; waits++)
        nanosleep(&(struct timespec){0, 10000000}, NULL);
    expect_file(path);
}

/* Each thread has to give up its rights, also that which waits for signals. */
static void no_thread_keeps_its_rights(void **state)
{
    char folder[64], path[128], said[4096] = "", text[4096];
    (void)state;
    need_landlock();
    need_cpu();
    scratch_write("in/a.rts", small_scene);
    running job = start_rtc("in/a.rts --untrusted --spp 10000000 --checkpoint out/a.rtpart "
                            "--every 0 --out out/a.pfm");
    wait_for(&job, "out/a.rtpart");
    snprintf(folder, sizeof folder, "/proc/%ld/task", (long)job.pid);
    DIR *tasks = opendir(folder);
    int count = 0, confined = 0;
    for (const struct dirent *entry; tasks && (entry = readdir(tasks)) != NULL;) {
        if (entry->d_name[0] == '.')
            continue;
        snprintf(path, sizeof path, "%s/%.20s/status", folder, entry->d_name);
        FILE *file = fopen(path, "r");
        if (!file)
            continue;
        const size_t length = fread(text, 1, sizeof text - 1, file);
        text[length] = '\0';
        fclose(file);
        if (length == 0) /* it has ended */
            continue;
        count++;
        confined += strstr(text, "NoNewPrivs:\t1") && strstr(text, "Seccomp:\t2");
    }
    if (tasks)
        closedir(tasks);
    kill(job.pid, SIGKILL);
    running_finish(&job, said, sizeof said);
    assert_true(count > 1);
    assert_int_equal(confined, count);
}

/* The system tells a process each second that its CPU time is up, before it kills it. */
static void what_is_there_is_written_when_cpu_time_is_up(void **state)
{
    char said[4096] = "";
    struct rlimit limit;
    (void)state;
    need_cpu();
    scratch_write("in/a.rts", small_scene);
    /* Writing takes more than a second. */
    running job = start_rtc("in/a.rts --spp 10000000 --width 800 --height 800 --every 0 "
                            "--checkpoint out/a.rtpart --out out/a.pfm %s",
                            "--out out/1.png --out out/2.png --out out/3.png --out out/4.png "
                            "--out out/5.png --out out/6.png --out out/7.png --out out/8.png");
    wait_for(&job, "out/a.rtpart");
    assert_int_equal(prlimit(job.pid, RLIMIT_CPU, NULL, &limit), 0);
    limit.rlim_cur = 1; /* which is over */
    assert_int_equal(prlimit(job.pid, RLIMIT_CPU, &limit, NULL), 0);
    assert_int_equal(running_finish(&job, said, sizeof said), STATUS_INTERRUPTED);
    expect_file("out/a.pfm");
    expect_file("out/8.png");
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
    /* Few, of a long text each. */
    enum { LONG = 1 << 20 };
    static const char begin[] = "repeat i from 1 to 9000000 {\n#";
    char *text = malloc(sizeof begin + LONG + 8);
    assert_non_null(text);
    strcpy(text, begin);
    memset(text + sizeof begin - 1, 'x', LONG);
    strcpy(text + sizeof begin - 1 + LONG, "\n}\n");
    scratch_write("in/a.rts", text);
    free(text);
    run = run_rtc("check in/a.rts --untrusted");
    expect_status(&run, STATUS_INPUT);
    expect_err(&run, "more than 2 GiB of text");
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
        TEST(a_scene_that_leads_elsewhere_is_refused),
        TEST(an_import_reads_in_its_folder),
        TEST(a_foreign_scene_is_read_in_its_folder),
        TEST(pipes_are_refused),
        TEST(other_work_is_not_overwritten),
        TEST(outputs_that_lead_elsewhere_are_refused),
        TEST(photons_are_emitted_and_gone_on_with),
        TEST(rights_are_gone),
        TEST(no_thread_keeps_its_rights),
        TEST(what_is_there_is_written_when_cpu_time_is_up),
        TEST(a_scene_that_repeats_without_end_is_refused),
        TEST(a_scene_that_fills_memory_is_refused),
    };
    return spawn_find_rtc() == 0 ? cmocka_run_group_tests(tests, NULL, NULL) : 1;
}
