/*
 * test_film_files.c - checkpoints, parts and films of rtc: the image has the bytes of a render at
 * once, and what cannot be is refused by name.
 */
#define _XOPEN_SOURCE 700 /* setenv */

#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "expect.h"
#include "lib/image/scratch.h"
#include "rt.h"
#include "small_scene.h"
#include "spawn.h"
#include "tools/status.h"

static int enter(void **state)
{
    if (scratch_enter(state) != 0)
        return -1;
    scratch_write("s.rts", small_scene);
    return 0;
}

/* Runs rtc and expects a status. */
#define RTC(expected, ...)                                                                         \
    do {                                                                                           \
        run done_ = run_rtc(__VA_ARGS__);                                                          \
        expect_status(&done_, expected);                                                           \
        run_free(&done_);                                                                          \
    } while (0)

static const char *const modes[] = {"--mode path --spp 5 --aov", "--mode path --spp 19 --variance",
                                    "--mode normals --spp 3",
                                    "--mode photon --photons 2000 --k 20 --photon-layers --spp 2",
                                    "--mode photon --photons 700 --passes 6"};

static void parts_merge_to_the_bytes_of_one_render(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) {
        RTC(STATUS_DONE, "s.rts %s --seed 4 --quiet --out whole.exr", modes[i]);
        for (int part = 1; part <= 3; part++) {
            char name[32];
            snprintf(name, sizeof name, "p%d.rtpart", part);
            unlink(name);
            RTC(STATUS_DONE, "s.rts %s --seed 4 --quiet --part %d/3 --out p%d.rtpart", modes[i],
                part, part);
        }
        unlink("two.rtpart");
        RTC(STATUS_DONE, "merge p3.rtpart p1.rtpart --out two.rtpart --quiet");
        RTC(STATUS_DONE, "merge p2.rtpart two.rtpart --out merged.exr --out merged.png --quiet");
        expect_same_files("whole.exr", "merged.exr");
    }
}

static void what_is_missing_double_or_foreign_is_named(void **state)
{
    (void)state;
    RTC(STATUS_DONE, "s.rts --spp 4 --quiet --part 1/3");
    RTC(STATUS_DONE, "JOB_COMPLETION_INDEX=1 JOB_COMPLETIONS=3 rtc s.rts --spp 4 --part auto "
                     "--quiet");
    expect_file("s.1of3.rtpart");
    expect_file("s.2of3.rtpart");
    run missing = run_rtc("merge s.1of3.rtpart s.2of3.rtpart --out x.exr");
    expect_status(&missing, STATUS_INPUT);
    expect_err(&missing, "missing, whole or in part, of parts 1 to 3: 3");
    run_free(&missing);
    expect_no_file("x.exr");
    RTC(STATUS_DONE, "merge s.1of3.rtpart s.2of3.rtpart --incomplete --out x.exr");
    run twice = run_rtc("merge s.1of3.rtpart s.1of3.rtpart --out x.exr");
    expect_status(&twice, STATUS_USAGE);
    expect_err(&twice, "s.1of3.rtpart is given twice");
    run_free(&twice);
    RTC(STATUS_DONE, "merge s.1of3.rtpart s.2of3.rtpart --quiet --out joined.rtpart");
    run again = run_rtc("merge joined.rtpart s.2of3.rtpart --out x.exr");
    expect_status(&again, STATUS_INPUT);
    expect_err(&again, "both hold some of the same samples");
    expect_err(&again, "hint: `rtc info FILM...` tells what films hold");
    run_free(&again);
    RTC(STATUS_DONE, "s.rts --spp 5 --quiet --part 2/3 --out five.rtpart");
    run other = run_rtc("merge s.1of3.rtpart five.rtpart --out x.exr");
    expect_status(&other, STATUS_INPUT);
    expect_err(&other, "spp is 4 in one film and 5 in the other");
    run_free(&other);
    run image = run_rtc("s.rts --part 1/3 --out x.png");
    expect_status(&image, STATUS_USAGE);
    expect_err(&image, "goes to a film called NAME.rtpart");
    run_free(&image);
    run none = run_rtc("s.rts --part 4/3");
    expect_status(&none, STATUS_USAGE);
    expect_err(&none, "there is no part 4 of 3");
    run_free(&none);
    run nowhere = run_rtc("s.rts --part auto");
    expect_status(&nowhere, STATUS_USAGE);
    expect_err(&nowhere, "no job of Slurm");
    run_free(&nowhere);
}

/* The engines' own variables. */
static void parts_are_those_of_the_job(void **state)
{
    static const struct {
        const char *set, *file;
    } jobs[] = {
        {"SLURM_ARRAY_TASK_ID=2 SLURM_ARRAY_TASK_MIN=0 SLURM_ARRAY_TASK_MAX=3 "
         "SLURM_ARRAY_TASK_COUNT=4",
         "s.3of4.rtpart"},
        {"SLURM_ARRAY_TASK_ID=2 SLURM_ARRAY_TASK_COUNT=5 SLURM_PROCID=0 SLURM_NTASKS=1",
         "s.2of5.rtpart"},
        {"OMPI_COMM_WORLD_RANK=0 OMPI_COMM_WORLD_SIZE=6", "s.1of6.rtpart"},
        {"PMI_RANK=6 PMI_SIZE=7", "s.7of7.rtpart"},
        {"SLURM_PROCID=1 SLURM_NTASKS=8", "s.2of8.rtpart"},
        {"SLURM_ARRAY_TASK_ID=5 SLURM_ARRAY_TASK_MIN=1 SLURM_ARRAY_TASK_MAX=18 "
         "SLURM_ARRAY_TASK_STEP=2 SLURM_ARRAY_TASK_COUNT=9",
         "s.3of9.rtpart"},
    };
    /* Of arrays of some tasks, the number of all parts is not known. */
    static const char *const again[] = {
        "SLURM_ARRAY_TASK_ID=3 SLURM_ARRAY_TASK_MIN=3 SLURM_ARRAY_TASK_MAX=3 "
        "SLURM_ARRAY_TASK_COUNT=1",
        "SLURM_ARRAY_TASK_ID=7 SLURM_ARRAY_TASK_MIN=5 SLURM_ARRAY_TASK_MAX=8 "
        "SLURM_ARRAY_TASK_COUNT=4",
        "SLURM_ARRAY_TASK_ID=4 SLURM_ARRAY_TASK_MIN=1 SLURM_ARRAY_TASK_MAX=9 "
        "SLURM_ARRAY_TASK_COUNT=4",
    };
    (void)state;
    for (size_t i = 0; i < sizeof jobs / sizeof *jobs; i++) {
        RTC(STATUS_DONE, "%s rtc s.rts --mode normals --spp 1 --quiet --part auto", jobs[i].set);
        expect_file(jobs[i].file);
    }
    for (size_t i = 0; i < sizeof again / sizeof *again; i++) {
        run refused = run_rtc("%s rtc s.rts --mode normals --spp 1 --part auto", again[i]);
        expect_status(&refused, STATUS_USAGE);
        expect_err(&refused, "the number of parts is not known");
        expect_err(&refused, "--part I/N");
        run_free(&refused);
    }
}

static void a_checkpoint_is_gone_on_with_by_its_name_alone(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) {
        RTC(STATUS_DONE, "s.rts %s --quiet --out whole.exr", modes[i]);
        /* The first part of a whole stands for a render that was stopped. */
        RTC(STATUS_DONE, "s.rts %s --quiet --part 2/3 --out c.rtpart", modes[i]);
        unlink("done.rtpart");
        RTC(STATUS_DONE, "s.rts --resume c.rtpart --part 1/1 --quiet --out done.rtpart --out "
                         "done.exr");
        RTC(STATUS_DONE, "merge done.rtpart --out merged.exr --quiet");
        expect_same_files("whole.exr", "done.exr");
        expect_same_files("whole.exr", "merged.exr");
        /* The film of a part is only read. */
        run part = run_rtc("info c.rtpart --json");
        expect_out(&part, "\"part\":2,\"parts\":3");
        run_free(&part);
        unlink("c.rtpart");
    }
    RTC(STATUS_DONE, "s.rts --spp 6 --quiet --out whole.exr");
    RTC(STATUS_DONE, "s.rts --spp 4 --checkpoint c.rtpart --every 0 --quiet --out a.exr");
    run over = run_rtc("s.rts --spp 4 --checkpoint c.rtpart --out a.exr");
    expect_status(&over, STATUS_USAGE);
    expect_err(&over, "the file is there already");
    expect_err(&over, "rtc --resume c.rtpart");
    run_free(&over);
    unlink("a.exr");
    RTC(STATUS_DONE, "--resume c.rtpart --spp 6 --quiet");
    expect_same_files("whole.exr", "a.exr");
    run info = run_rtc("info c.rtpart");
    expect_status(&info, STATUS_DONE);
    expect_out(&info, "done: 100 %");
    expect_out(&info, "spp: 6");
    run_free(&info);
    run other = run_rtc("--resume c.rtpart --seed 9");
    expect_status(&other, STATUS_USAGE);
    expect_err(&other, "seed is 9, and 0 in the film to be continued");
    run_free(&other);
    run less = run_rtc("--resume c.rtpart --spp 3");
    expect_status(&less, STATUS_USAGE);
    run_free(&less);
    scratch_write("s.rts", "camera { eye 0 0 -5  look_at 0 0 0 }\n");
    run changed = run_rtc("--resume c.rtpart");
    expect_status(&changed, STATUS_INPUT);
    expect_err(&changed,
               "c.rtpart does not fit s.rts: the film is of another scene, or of this one "
               "before it was changed");
    run_free(&changed);
    scratch_write("s.rts", small_scene);
}

static void what_does_not_fit_a_film_is_named(void **state)
{
    static const struct {
        const char *options, *said;
    } others[] = {
        {"p.rtpart --width 9", "--width: width is 9, and "},
        {"p.rtpart --mode normals", "--mode: mode is normals, and path in the film"},
        {"q.rtpart --passes 2", "--passes: the film has pass 3 already: they cannot be fewer"},
    };
    (void)state;
    RTC(STATUS_DONE, "s.rts --spp 2 --variance --quiet --out p.rtpart");
    RTC(STATUS_DONE, "s.rts --mode photon --photons 700 --passes 3 --quiet --out q.rtpart");
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        run run = run_rtc("--resume %s", others[i].options);
        expect_status(&run, STATUS_USAGE);
        expect_err(&run, others[i].said);
        run_free(&run);
    }
}

/* A film is not lost to a render of something else; the same work may be done again. */
static void a_film_of_other_work_is_not_overwritten(void **state)
{
    static const struct {
        const char *options, *why;
    } others[] = {
        {"--spp 4 --part 1/3", "it is part 2 of 3"},
        {"--spp 4 --part 2/4", "it is part 2 of 3"},
        {"--spp 4", "it is part 2 of 3"},
        {"--spp 5 --part 2/3", "spp is 5 in one film and 4 in the other"},
        {"--spp 4 --part 2/3 --seed 2", "seed is 2 in one film and 0 in the other"},
    };
    (void)state;
    unlink("o.rtpart");
    unlink("two.rtpart");
    RTC(STATUS_DONE, "s.rts --spp 4 --part 2/3 --quiet --out o.rtpart");
    RTC(STATUS_DONE, "s.rts --spp 4 --part 2/3 --quiet --out kept.rtpart");
    RTC(STATUS_DONE, "merge o.rtpart --out before.pfm --incomplete --quiet");
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        run refused = run_rtc("s.rts %s --out o.rtpart", others[i].options);
        expect_status(&refused, STATUS_USAGE);
        expect_err(&refused, "--out o.rtpart: the film that is there is of other work");
        expect_err(&refused, others[i].why);
        run_free(&refused);
    }
    RTC(STATUS_DONE, "merge o.rtpart --out after.pfm --incomplete --quiet");
    expect_same_files("before.pfm", "after.pfm");
    RTC(STATUS_DONE, "s.rts --spp 4 --part 2/3 --quiet --out o.rtpart");
    RTC(STATUS_DONE, "--resume o.rtpart --spp 6 --quiet --out o.rtpart");
    RTC(STATUS_DONE, "s.rts --spp 4 --part 1/3 --quiet --out 1.rtpart");
    RTC(STATUS_DONE, "merge kept.rtpart 1.rtpart --out two.rtpart --quiet");
    run two = run_rtc("s.rts --spp 4 --part 2/3 --out two.rtpart");
    expect_status(&two, STATUS_USAGE);
    expect_err(&two, "it has other parts too");
    run_free(&two);
    /* What is no whole film any more holds no work. */
    scratch_write("o.rtpart", "half a film");
    RTC(STATUS_DONE, "s.rts --spp 4 --part 1/3 --quiet --out o.rtpart");
}

/* Fails to write over a file, which keeps its bytes. */
static void expect_kept(const char *file, const char *why, const char *line)
{
    RTC(STATUS_DONE, "merge %s --out before.pfm --incomplete --quiet", file);
    run refused = run_rtc("%s --out %s", line, file);
    expect_status(&refused, STATUS_USAGE);
    expect_err(&refused, "the film that is there is of other work");
    expect_err(&refused, why);
    run_free(&refused);
    RTC(STATUS_DONE, "merge %s --out after.pfm --incomplete --quiet", file);
    expect_same_files("before.pfm", "after.pfm");
}

/* Nor to a merge of films that lack some of its samples. */
static void a_film_is_not_overwritten_by_a_merge_without_it(void **state)
{
    (void)state;
    for (int part = 1; part <= 3; part++)
        RTC(STATUS_DONE, "s.rts --spp 4 --part %d/3 --quiet --out m%d.rtpart", part, part);
    RTC(STATUS_DONE, "s.rts --spp 4 --part 3/3 --seed 2 --quiet --out seed.rtpart");
    unlink("sum.rtpart");
    expect_kept("m3.rtpart", "it has other parts too", "merge m1.rtpart m2.rtpart");
    expect_kept("seed.rtpart", "seed is", "merge m1.rtpart m2.rtpart m3.rtpart");
    /* What has all that is there may take its place. */
    RTC(STATUS_DONE, "merge m1.rtpart m2.rtpart --quiet --out sum.rtpart");
    RTC(STATUS_DONE, "merge m2.rtpart m1.rtpart --quiet --out sum.rtpart");
    RTC(STATUS_DONE, "merge m1.rtpart m2.rtpart m3.rtpart --quiet --out sum.rtpart");
    expect_kept("sum.rtpart", "it has other parts too", "merge m1.rtpart m2.rtpart");
    scratch_write("sum.rtpart", "half a film");
    RTC(STATUS_DONE, "merge m1.rtpart m2.rtpart --quiet --out sum.rtpart");
}

/* Two processes do not write one checkpoint; what a killed one left is taken over. */
static void a_checkpoint_is_of_one_process(void **state)
{
    char pid[32], said[4096];
    (void)state;
    running first = start_rtc("s.rts --spp 10000000 --checkpoint l.rtpart --every 0 --out l.exr");
    for (int waits = 0; waits < 3000 && access("l.rtpart", F_OK) != 0; waits++)
        nanosleep(&(struct timespec){0, 10000000}, NULL);
    snprintf(pid, sizeof pid, "process %ld", (long)first.pid);
    assert_int_equal(symlink("l.rtpart", "link.rtpart"), 0);
    static const char *const lines[] = {"--resume l.rtpart", "--resume ./link.rtpart",
                                        "s.rts --spp 2 --resume l.rtpart --checkpoint l.rtpart"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        run second = run_rtc("%s", lines[i]);
        expect_status(&second, STATUS_OUTPUT);
        expect_err(&second, "is the checkpoint of a run that goes on");
        expect_err(&second, pid);
        run_free(&second);
    }
    /* To look at it is no harm. */
    RTC(STATUS_DONE, "info l.rtpart");
    kill(first.pid, SIGKILL);
    assert_int_equal(running_finish(&first, said, sizeof said), 128 + SIGKILL);
    expect_file("l.rtpart.rtlock");
    RTC(STATUS_DONE, "--resume l.rtpart --time 1e-6 --quiet");
    expect_no_file("l.rtpart.rtlock");
    expect_no_file("./link.rtpart.rtlock");
}

/* One that was killed may take a moment to end. */
static void a_checkpoint_of_a_process_that_ends_is_waited_for(void **state)
{
    char said[4096];
    (void)state;
    running first =
        start_rtc("s.rts --spp 10000000 --checkpoint ending.rtpart --every 0 --out ending.exr");
    for (int waits = 0; waits < 3000 && access("ending.rtpart", F_OK) != 0; waits++)
        nanosleep(&(struct timespec){0, 10000000}, NULL);
    kill(first.pid, SIGSTOP);
    const pid_t killer = fork();
    if (killer == 0) {
        nanosleep(&(struct timespec){0, 300000000}, NULL);
        kill(first.pid, SIGKILL);
        _exit(0);
    }
    RTC(STATUS_DONE, "--resume ending.rtpart --time 1e-6 --quiet");
    assert_int_equal(running_finish(&first, said, sizeof said), 128 + SIGKILL);
    waitpid(killer, NULL, 0);
}

/* --time is for one sitting: that of the beginning stays, and what comes later is not kept. */
static void a_time_given_to_a_sitting_is_not_kept(void **state)
{
    (void)state;
    RTC(STATUS_DONE, "s.rts --spp 64 --quiet --out whole.pfm");
    RTC(STATUS_DONE, "s.rts --spp 1 --checkpoint t.rtpart --quiet --out t.pfm");
    RTC(STATUS_DONE, "--resume t.rtpart --spp 64 --time 1e-6 --quiet");
    expect_different_files("whole.pfm", "t.pfm");
    RTC(STATUS_DONE, "--resume t.rtpart --quiet");
    expect_same_files("whole.pfm", "t.pfm");
    /* The time of the beginning stays, also where one sitting had none. */
    RTC(STATUS_DONE, "s.rts --spp 64 --time 1e-6 --checkpoint u.rtpart --quiet --out u.pfm");
    expect_different_files("whole.pfm", "u.pfm");
    RTC(STATUS_DONE, "--resume u.rtpart --time 0 --quiet");
    expect_same_files("whole.pfm", "u.pfm");
    RTC(STATUS_DONE, "--resume u.rtpart --spp 4096 --quiet");
    run info = run_rtc("info u.rtpart");
    if (strstr(info.out, "done: 100 %"))
        fail_msg("the time of the beginning is lost");
    run_free(&info);
}

/* Without --spp, a time alone ends a render: nothing is known of its end. */
static void a_render_without_end_tells_its_samples(void **state)
{
    (void)state;
    RTC(STATUS_DONE, "s.rts --spp 64 --quiet --out whole.pfm");
    RTC(STATUS_DONE, "s.rts --time 1e-6 --checkpoint e.rtpart --quiet --out e.pfm");
    run info = run_rtc("info e.rtpart");
    expect_out(&info, " samples a pixel, of as many as --time or --target-error");
    if (strstr(info.out, "time to come"))
        fail_msg("a time to come: %s", info.out);
    run_free(&info);
    run json = run_rtc("info e.rtpart --json");
    expect_out(&json, "\"done\":null,\"samples_done\":");
    expect_out(&json, "\"rest_seconds\":-1");
    run_free(&json);
    /* It is not bound to have no end. */
    RTC(STATUS_DONE, "--resume e.rtpart --spp 64 --time 0 --quiet");
    expect_same_files("whole.pfm", "e.pfm");
}

/* The time that passes, not its sum over devices. */
static void devices_that_share_a_picture_take_the_time_that_passes(void **state)
{
    static const char words[] = "rendered in ";
    (void)state;
    setenv("POCL_DEVICES", "basic basic basic basic", 1);
    run all = run_rtc("s.rts --device all --time 1 --threads 1 --out d.exr");
    unsetenv("POCL_DEVICES");
    expect_status(&all, STATUS_DONE);
    const char *said = strstr(all.err, words);
    assert_non_null(said);
    const double seconds = strtod(said + strlen(words), NULL);
    if (device_is_cpu() && !(seconds >= 0.9 && seconds < 3))
        fail_msg("four devices that render for a second: %s", said);
    run_free(&all);
}

/* Launches grow while devices share a picture; PoCL 3.1 bears that of launches of one width. */
static void devices_run_a_kernel_at_once(void **state)
{
    static const char line[] = "s.rts --width 256 --height 256 --spp 16 --threads 1 --quiet";
    (void)state;
    RTC(STATUS_DONE, "%s --out one.pfm", line);
    setenv("POCL_DEVICES", "basic basic", 1);
    run both = run_rtc("%s --device all --out both.pfm", line);
    unsetenv("POCL_DEVICES");
    expect_status(&both, STATUS_DONE);
    run_free(&both);
    expect_same_files("one.pfm", "both.pfm");
}

/* From anywhere: the names in a film are meant from where it was begun, those given from here. */
static void a_render_is_gone_on_with_from_another_folder(void **state)
{
    static const char *const made[] = {"job/s.rts", "job/whole.exr", "job/a.exr", "job/c.rtpart"};
    (void)state;
    assert_int_equal(mkdir("job", 0700), 0);
    scratch_write("job/s.rts", small_scene);
    assert_int_equal(chdir("job"), 0);
    RTC(STATUS_DONE, "s.rts --spp 7 --quiet --out whole.exr");
    RTC(STATUS_DONE, "s.rts --spp 2 --checkpoint c.rtpart --quiet --out a.exr");
    assert_int_equal(chdir(".."), 0);
    unlink("s.rts");
    unlink("a.exr");
    RTC(STATUS_DONE, "--resume job/c.rtpart --spp 7 --quiet");
    expect_same_files("job/whole.exr", "job/a.exr");
    expect_no_file("a.exr");
    RTC(STATUS_DONE, "--resume job/c.rtpart --quiet --out here.exr");
    expect_same_files("job/whole.exr", "here.exr");
    /* A folder that was moved is entered by its user. */
    assert_int_equal(rename("job", "moved"), 0);
    assert_int_equal(chdir("moved"), 0);
    unlink("a.exr");
    RTC(STATUS_DONE, "--resume c.rtpart --quiet --out a.exr");
    expect_same_files("whole.exr", "a.exr");
    assert_int_equal(chdir(".."), 0);
    assert_int_equal(rename("moved", "job"), 0);
    for (size_t i = 0; i < sizeof made / sizeof *made; i++)
        assert_int_equal(unlink(made[i]), 0);
    assert_int_equal(rmdir("job"), 0);
    scratch_write("s.rts", small_scene);
}

/* A stranger's film does not choose what is read. */
static void an_untrusted_film_names_no_file_elsewhere(void **state)
{
    (void)state;
    assert_int_equal(mkdir("in", 0700), 0);
    assert_int_equal(chdir("in"), 0);
    RTC(STATUS_DONE, "../s.rts --spp 1 --checkpoint c.rtpart --quiet --out a.exr");
    run outside = run_rtc("--resume c.rtpart --untrusted --out b.exr");
    expect_status(&outside, has_landlock() ? STATUS_INPUT : STATUS_DEVICE);
    if (has_landlock())
        expect_err(&outside, "the film names the scene ../s.rts, outside of this folder");
    run_free(&outside);
    unlink("c.rtpart");
    if (has_landlock()) { /* also by a link */
        assert_int_equal(symlink("..", "up"), 0);
        RTC(STATUS_DONE, "up/s.rts --spp 1 --checkpoint c.rtpart --quiet --out a.exr");
        outside = run_rtc("--resume c.rtpart --untrusted --out b.exr");
        expect_status(&outside, STATUS_INPUT);
        expect_err(&outside, "the film names the scene up/s.rts, outside of this folder");
        run_free(&outside);
        unlink("c.rtpart");
        unlink("up");
    }
    unlink("a.exr");
    assert_int_equal(chdir(".."), 0);
    assert_int_equal(rmdir("in"), 0);
}

static void constants_that_are_set_belong_to_the_film(void **state)
{
    static const char text[] = "let size = 1\nlet tint = 0.5\n"
                               "camera { eye 0 1 -4  look_at 0 0 0 }\nfilm { width 16 height 12 }\n"
                               "material m { kd tint }\n"
                               "sphere { centre 0 0 0  radius size  material m }\n"
                               "light point { position 0 3 -3  intensity 30 }\n";
    static const char same[] = "let size = 0.5\nlet tint = 0.25\n";
    char *other = malloc(sizeof text + sizeof same);
    (void)state;
    scratch_write("let.rts", text);
    strcpy(other, same);
    strcat(other, strchr(strchr(text, '\n') + 1, '\n') + 1);
    scratch_write("other.rts", other);
    free(other);
    RTC(STATUS_DONE, "other.rts --spp 4 --quiet --out other.pfm");
    RTC(STATUS_DONE, "let.rts --set size=9 --set size=0.5 --set tint=0.25 --spp 2 --quiet "
                     "--out let.pfm --checkpoint let.rtpart");
    RTC(STATUS_DONE, "--resume let.rtpart --spp 4 --quiet");
    expect_same_files("let.pfm", "other.pfm");
    RTC(STATUS_DONE, "check let.rts --set size=0.5");
    RTC(STATUS_INPUT, "--resume let.rtpart --set size=2 --spp 8");
    run unknown = run_rtc("let.rts --set sise=1");
    expect_err(&unknown, "--set:1:5: error: the scene has no constant 'sise'");
    expect_status(&unknown, STATUS_INPUT);
    expect_err(&unknown, "the scene has no constant 'sise'");
    expect_err(&unknown, "did you mean 'size'?");
    run_free(&unknown);
}

/* A photon map that the film names may lie here, wherever the scene is. */
static void an_untrusted_film_finds_its_photon_map(void **state)
{
    (void)state;
    assert_int_equal(mkdir("in", 0700), 0);
    scratch_write("in/s.rts", small_scene);
    RTC(STATUS_DONE, "photons in/s.rts --photons 100 --quiet --out m.rtp");
    RTC(STATUS_DONE, "in/s.rts --mode photon --photon-map m.rtp --spp 1 --quiet --out m.rtpart");
    run run = run_rtc("in/s.rts --resume m.rtpart --spp 2 --untrusted --quiet --out m.pfm");
    if (device_is_cpu())
        expect_status(&run, has_landlock() ? STATUS_DONE : STATUS_DEVICE);
    run_free(&run);
    unlink("in/s.rts");
    rmdir("in");
}

/* What a film says of outputs is not done for a stranger. */
static void an_untrusted_film_names_no_outputs(void **state)
{
    (void)state;
    RTC(STATUS_DONE, "s.rts --spp 2 --quiet --out victim.png --checkpoint v.rtpart");
    scratch_write("victim.png", "precious");
    run done = run_rtc("--resume v.rtpart --untrusted --quiet --out mine.png");
    if (has_landlock() && device_is_cpu()) {
        expect_status(&done, STATUS_DONE);
        expect_file("mine.png");
    }
    run_free(&done);
    run none = run_rtc("--resume v.rtpart --untrusted --quiet");
    expect_status(&none, STATUS_USAGE);
    expect_err(&none, "--out");
    run_free(&none);
    scratch_write("precious.txt", "precious");
    expect_same_files("victim.png", "precious.txt");
}

/* Saves a film of s.rts with this note. */
static void save_with_note(const char *path, const char *note)
{
    rt_scene *scene = NULL;
    rt_device *device = NULL;
    rt_renderer *renderer = NULL;
    rt_film *film = NULL;
    rt_error error;
    const rt_render_options options = {
        .width = 8, .height = 8, .spp = 1, .part = 1, .parts = 1, .note = note};
    assert_int_equal(rt_scene_load(&scene, "s.rts", NULL, &error), RT_OK);
    assert_int_equal(rt_device_open(&device, NULL, &error), RT_OK);
    assert_int_equal(rt_renderer_create(&renderer, scene, device, NULL, &error), RT_OK);
    assert_int_equal(rt_render(&film, renderer, &options, &error), RT_OK);
    assert_int_equal(rt_film_save(film, path, &error), RT_OK);
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
    rt_device_close(device);
    rt_scene_destroy(scene);
}

/* A film is data: it loads no library, opens no connection and begins no program. */
static void a_film_gives_what_belongs_to_its_picture_alone(void **state)
{
    static const char *const lines[] = {"given denoiser ./evil.so", "given denoise 1",
                                        "given preview tev:localhost:1", "given profile p.json",
                                        "given resume other.rtpart"};
    char note[128];
    (void)state;
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        snprintf(note, sizeof note, "scene s.rts\n%s\n", lines[i]);
        save_with_note("evil.rtpart", note);
        run run = run_rtc("--resume evil.rtpart --out mine.pfm");
        expect_status(&run, STATUS_INPUT);
        expect_err(&run, "which is no part of a picture");
        run_free(&run);
        unlink("evil.rtpart");
    }
    expect_no_file("mine.pfm");
    char *many = malloc(40 * 10001);
    assert_non_null(many);
    size_t used = 0;
    for (int i = 0; i < 10001; i++)
        used += (size_t)sprintf(many + used, "given set a%d=1\n", i);
    save_with_note("many.rtpart", many);
    free(many);
    run refused = run_rtc("--resume many.rtpart --out mine.pfm");
    expect_status(&refused, STATUS_INPUT);
    expect_err(&refused, "the note of the film has more than 10000 lines");
    run_free(&refused);
    save_with_note("good.rtpart",
                   "scene s.rts\ngiven width 8\ngiven height 8\ngiven spp 1\ngiven exposure 2\n");
    RTC(STATUS_DONE, "--resume good.rtpart --quiet --out mine.pfm");
}

/* Another program's lock file is not for us to remove. */
static void a_lock_that_holds_something_stays(void **state)
{
    (void)state;
    scratch_write("text.rtpart", "no film at all, but a line of text that is long enough\n");
    scratch_write("text.rtpart.rtlock", "mine");
    RTC(STATUS_INPUT, "--resume text.rtpart");
    scratch_write("mine.txt", "mine");
    expect_same_files("text.rtpart.rtlock", "mine.txt");
}

static void no_film_is_refused_with_its_name(void **state)
{
    (void)state;
    scratch_write("text.rtpart", "no film at all, but a line of text that is long enough\n");
    static const char *const commands[] = {"info text.rtpart", "merge text.rtpart --out x.exr",
                                           "--resume text.rtpart"};
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
        run none = run_rtc("%s", commands[i]);
        expect_status(&none, STATUS_INPUT);
        expect_err(&none, "text.rtpart: this is no film file");
        run_free(&none);
    }
    run map = run_rtc("s.rts --checkpoint x.exr");
    expect_status(&map, STATUS_USAGE);
    expect_err(&map, "NAME.rtpart");
    run_free(&map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_merge_to_the_bytes_of_one_render),
        cmocka_unit_test(what_is_missing_double_or_foreign_is_named),
        cmocka_unit_test(parts_are_those_of_the_job),
        cmocka_unit_test(a_checkpoint_is_gone_on_with_by_its_name_alone),
        cmocka_unit_test(what_does_not_fit_a_film_is_named),
        cmocka_unit_test(a_film_of_other_work_is_not_overwritten),
        cmocka_unit_test(a_film_is_not_overwritten_by_a_merge_without_it),
        cmocka_unit_test(a_checkpoint_is_of_one_process),
        cmocka_unit_test(a_checkpoint_of_a_process_that_ends_is_waited_for),
        cmocka_unit_test(a_time_given_to_a_sitting_is_not_kept),
        cmocka_unit_test(a_render_without_end_tells_its_samples),
        cmocka_unit_test(devices_that_share_a_picture_take_the_time_that_passes),
        cmocka_unit_test(devices_run_a_kernel_at_once),
        cmocka_unit_test(a_render_is_gone_on_with_from_another_folder),
        cmocka_unit_test(constants_that_are_set_belong_to_the_film),
        cmocka_unit_test(an_untrusted_film_finds_its_photon_map),
        cmocka_unit_test(an_untrusted_film_names_no_outputs),
        cmocka_unit_test(an_untrusted_film_names_no_file_elsewhere),
        cmocka_unit_test(a_film_gives_what_belongs_to_its_picture_alone),
        cmocka_unit_test(a_lock_that_holds_something_stays),
        cmocka_unit_test(no_film_is_refused_with_its_name),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests(tests, enter, scratch_leave);
}
