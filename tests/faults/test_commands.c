/*
 * test_commands.c - rtc's commands, in which each call for memory, to files and to OpenCL fails in
 * turn, from the parsing of their line on: each ends as it should, or with an error that says what
 * is wrong; all is freed, and the files that were there are whole.
 *
 * The whole takes minutes; `make check-faults` runs it, by RT_TEST_LONG=1. Without that every so
 * manyth call fails. RT_FAULT_JOB picks commands by a part of their line.
 */
#define _XOPEN_SOURCE 700

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "faults/fault.h"
#include "faults/inject.h"
#include "faults/scene_files.h"
#include "lib/image/scratch.h"
#include "support.h"
#include "tools/interrupt.h"
#include "tools/message.h"
#include "tools/small_scene.h"
#include "tools/status.h"

/* tools/rtc.c under another name. */
int rtc_main(int argc, char **argv);

/* ---- Stand-ins ------------------------------------------------------------------------------- */

/* One device for all commands. */
static rt_device *device;
rt_status __real_rt_device_open(rt_device **out, const rt_device_options *options, rt_error *error);
rt_status __wrap_rt_device_open(rt_device **out, const rt_device_options *options, rt_error *error);
rt_status __wrap_rt_device_open(rt_device **out, const rt_device_options *options, rt_error *error)
{
    if (!device)
        return __real_rt_device_open(out, options, error);
    *out = device;
    return RT_OK;
}

void __real_rt_device_close(rt_device *closed);
void __wrap_rt_device_close(rt_device *closed);
void __wrap_rt_device_close(rt_device *closed)
{
    if (closed != device)
        __real_rt_device_close(closed);
}

void __wrap_untrusted_close_inherited(void);
void __wrap_untrusted_close_inherited(void)
{
    /* What this process has open is the test's own. */
}

/* The signals of a test are its own. */
void __wrap_interrupt_catch(int in_json, int quiet);
void __wrap_interrupt_catch(int in_json, int quiet)
{
    (void)in_json;
    (void)quiet;
}

/* ---- A command ------------------------------------------------------------------------------- */

enum { WORDS_MAX = 32, SAID_MAX = 1 << 20 };

typedef struct command {
    const char *line; /* words with a space between */
    const char *const *outputs;
    int is_timed; /* it prints times, which differ */
} command;

static const char *const nothing[] = {NULL};
static const char *const picture[] = {"out.png", NULL};
static const char *const pictures[] = {"out.exr", "out.png", "out.ppm", "out.pfm", NULL};
static const char *const map[] = {"out.rtp", NULL};
static const char *const points[] = {"out.ply", NULL};

static const command commands[] = {
    {"rtc check s.rts", nothing, 0},
    {"rtc check s.rts p.rts wrong.rts --json", nothing, 0},
    {"rtc check wrong.rts --memory 10M", nothing, 0},
    {"rtc check - --quiet", nothing, 0},
    {"rtc photons info m.rtp n.rtp", nothing, 0},
    {"rtc photons info m.rtp --json", nothing, 0},
    {"rtc photons merge m.rtp n.rtp --out out.rtp", map, 0},
    {"rtc photons merge n.rtp m.rtp --out out.rtp --memory 100M --quiet", map, 0},
    {"rtc photons diff m.rtp n.rtp", nothing, 0},
    {"rtc photons diff m.rtp m.rtp --json", nothing, 0},
    {"rtc photons export m.rtp --out out.ply", points, 0},
    {"rtc photons p.rts --photons 200 --seed 3 --part 2/3 --out out.rtp --quiet", map, 0},
    {"rtc compare a.exr a.png --blocks --block 2 --out out.png --max-rmse 1", picture, 0},
    {"rtc compare a.exr a.pfm a.ppm --json --min-ssim 0.5 --max-flip 0", nothing, 0},
    {"rtc compare l.exr l.exr --layer normal --max-bias 0.1 --tolerance 0.1", nothing, 0},
    {"rtc mesh torus --triangles 100 --out out.ply", points, 0},
    {"rtc mesh terrain --triangles 50 --out=out.ply", points, 0},
    {"rtc p.rts --spp 1 --out out.exr --out out.png --out out.ppm --out out.pfm --aov --json",
     pictures, 1},
    {"rtc p.rts --mode direct --spp 1 --exposure 1 --tonemap aces --stats --verbose --out out.png",
     picture, 1},
    {"rtc p.rts --mode photon --photon-map m.rtp --k 10 --spp 1 --out out.png --progress plain",
     picture, 1},
    {"rtc p.rts --mode photon --photons 100 --light-shares 1,2 --passes 2 --out out.png --quiet",
     picture, 1},
    {"rtc p.rts --spp many --out out.gif --no-such", nothing, 0},
    {"rtc p.rts --spp 1 --filter gaus --exposure 1e9", nothing, 0},
    {"rtc chekc p.rts", nothing, 0},
    {"rtc photons mrege m.rtp", nothing, 0},
    {"rtc help photons", nothing, 0},
    {"rtc help compare", nothing, 0},
    {"rtc --help", nothing, 0},
    {"rtc --version", nothing, 0},
    {"rtc devices", nothing, 0},
    {"rtc doctor", nothing, 1},
};

/* What a run printed and how it ended. */
typedef struct said {
    int status;
    size_t sizes[2];
    char texts[2][SAID_MAX]; /* stdout and stderr */
} said;

static void take_text(said *out, int i, FILE *file)
{
    fflush(file);
    rewind(file);
    out->sizes[i] = fread(out->texts[i], 1, SAID_MAX - 1, file);
    out->texts[i][out->sizes[i]] = '\0';
    fclose(file);
}

/* A stream that holds a text, by calls that do not fail here. */
static FILE *make_stream(const char *text)
{
    FILE *file = tmpfile();
    if (!file || fputs(text, file) < 0)
        abort(); /* in a child too, which must not go on with other tests */
    rewind(file);
    return file;
}

static int split(char *words[WORDS_MAX + 1], char *line)
{
    int count = 0;
    char *rest;
    for (char *word = strtok_r(line, " ", &rest); word && count < WORDS_MAX;
         word = strtok_r(NULL, " ", &rest))
        words[count++] = word;
    words[count] = NULL;
    return count;
}

/* Runs a line. Failures are counted until it ends. */
static void run_line(said *out, const char *line)
{
    FILE *const real[3] = {stdin, stdout, stderr};
    char copy[512], *words[WORDS_MAX + 1];
    snprintf(copy, sizeof copy, "%s", line);
    int count = split(words, copy);
    stdin = make_stream(small_scene);
    FILE *text = stdout = make_stream(""), *messages = stderr = make_stream("");
    message_as_json(0);
    out->status = rtc_main(count, words);
    fault_disarm();
    fclose(stdin);
    stdin = real[0];
    stdout = real[1];
    stderr = real[2];
    take_text(out, 0, text);
    take_text(out, 1, messages);
}

static said right, now;

static int is_right(const command *c)
{
    return now.status == right.status &&
           (c->is_timed || (now.sizes[0] == right.sizes[0] &&
                            memcmp(now.texts[0], right.texts[0], now.sizes[0]) == 0));
}

static inject_end run(const void *data)
{
    const command *c = data;
    run_line(&now, c->line);
    if (is_right(c))
        return INJECT_DONE;
    if (strstr(now.texts[0], "does not answer")) /* one of the devices, in the list of them */
        return INJECT_ERROR;
    int is_told = strstr(now.texts[1], "error") != NULL || strstr(now.texts[0], "FAIL") != NULL;
    if (now.status > STATUS_DONE && now.status <= STATUS_OUTPUT && is_told)
        return INJECT_ERROR;
    print_message("%s: status %d\n%s%s", c->line, now.status, now.texts[0], now.texts[1]);
    return INJECT_WRONG;
}

/* ---- Tests ----------------------------------------------------------------------------------- */

static void each_call_of_a_command(void **state)
{
    inject_tally all = {0, 0, 0};
    (void)state;
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
        const inject_task task = {commands[i].line, run, &commands[i], commands[i].outputs};
        inject_tally sum = {0, 0, 0};
        if (getenv("RT_FAULT_JOB") && !strstr(commands[i].line, getenv("RT_FAULT_JOB")))
            continue;
        /* What an earlier command wrote may be kept from this one. */
        for (size_t o = 0; commands[i].outputs[o]; o++)
            unlink(commands[i].outputs[o]);
        run_line(&right, commands[i].line);
        inject_all(&task, inject_step(11), &sum);
        print_message("%s (%d): %ld calls failed: %ld errors, %ld right results\n",
                      commands[i].line, right.status, sum.calls, sum.errors, sum.survived);
        all.calls += sum.calls;
        all.errors += sum.errors;
        all.survived += sum.survived;
    }
    print_message("all commands: %ld calls failed: %ld errors, %ld right results\n", all.calls,
                  all.errors, all.survived);
    assert_true(all.errors > 0);
}

/* Ends with 0: no such call; 1: an error; 2: confined; 3: done without, or no word of why not. */
static int run_untrusted(long n, int for_good)
{
    fault_arm(n, for_good);
    run_line(&now, "rtc check s.rts --untrusted");
    if (!fault_fired())
        return 0;
    if (now.status != STATUS_DONE)
        return strstr(now.texts[1], "error") ? 1 : 3;
    int file = open("/etc/passwd", O_RDONLY);
    if (file < 0)
        return 2;
    close(file);
    return 3;
}

/* A process that was to give up rights never goes on with them. */
static void each_call_of_a_confinement(void **state)
{
    inject_tally sum = {0, 0, 0};
    int outcome = 1;
    (void)state;
    for (int for_good = 0; for_good < 2; for_good++)
        for (long n = 1; outcome; n += inject_step(3)) {
            int status;
            fflush(NULL);
            pid_t child = fork();
            assert_int_not_equal(child, -1);
            if (child == 0)
                _exit(run_untrusted(n, for_good));
            assert_int_equal(waitpid(child, &status, 0), child);
            outcome = WIFEXITED(status) ? WEXITSTATUS(status) : 3;
            if (outcome == 3)
                fail_msg("call %ld of a confinement: status %d", n, status);
            sum.calls += outcome != 0;
            sum.errors += outcome == 1;
            sum.survived += outcome == 2;
        }
    print_message("a confinement: %ld calls failed: %ld errors, %ld confined\n", sum.calls,
                  sum.errors, sum.survived);
    assert_true(sum.errors > 0);
}

/* ---- Files ----------------------------------------------------------------------------------- */

static void make(const char *line)
{
    run_line(&now, line);
    if (now.status != STATUS_DONE)
        fail_msg("%s: status %d\n%s", line, now.status, now.texts[1]);
}

static int enter(void **state)
{
    if (scene_files_enter(state) != 0)
        return -1;
    scratch_write("s.rts", SCENE_OF_FILES "film { width 4  height 4 }\n");
    scratch_write("p.rts", "include \"materials.rts\"\n"
                           "camera { eye 0 1.5 -5  look_at 0 0.8 0  fov 45 }\n"
                           "film { width 4  height 4 }\n"
                           "quad { corner -4 0 -4  edge1 0 0 8  edge2 8 0 0  material paper }\n"
                           "sphere { centre 1 1 0  radius 0.9  material glass }\n"
                           "light point { position -2 3 -2  intensity 5 }\n"
                           "light point { position 2 3 -2  power 5 }\n");
    scratch_write("wrong.rts", "material m { kd 2 }\n\tsphere { radius }\nlet a = \n"
                               "texture t { file \"none.png\" }\ncamera { eye 0 0 0 look }\n");
    return 0;
}

static int enter_with_device(void **state)
{
    rt_error error;
    if (enter(state) != 0)
        return -1;
    expect_ok(__real_rt_device_open(&device, NULL, &error), &error);
    make("rtc photons p.rts --photons 200 --part 1/2 --out m.rtp");
    make("rtc photons p.rts --photons 200 --part 2/2 --out n.rtp");
    make("rtc p.rts --spp 1 --aov --out l.exr");
    return 0;
}

static int leave_with_device(void **state)
{
    __real_rt_device_close(device);
    device = NULL;
    return scratch_leave(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(each_call_of_a_confinement, enter, scratch_leave),
        cmocka_unit_test_setup_teardown(each_call_of_a_command, enter_with_device,
                                        leave_with_device),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
