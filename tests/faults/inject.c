/* inject.c - failure injection into a piece of work. */
#define _XOPEN_SOURCE 700

#include "faults/inject.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/file.h"
#include "faults/fault.h"
#include "lib/image/scratch.h"
#include "support.h"

enum { OUTPUTS_MAX = 8, OUTPUT_BYTES_MAX = 1 << 26 };

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

/* ---- Files ----------------------------------------------------------------------------------- */

/* The outputs of a task, to be compared. */
typedef rt_bytes files[OUTPUTS_MAX];

static void files_read(files out, const inject_task *task)
{
    rt_error error;
    memset(out, 0, sizeof(files));
    for (size_t i = 0; task->outputs[i]; i++) {
        assert_true(i < OUTPUTS_MAX);
        if (access(task->outputs[i], F_OK) == 0)
            expect_ok(rt_file_read(&out[i], task->outputs[i], OUTPUT_BYTES_MAX, &error), &error);
    }
}

static void files_free(files in)
{
    for (size_t i = 0; i < OUTPUTS_MAX; i++)
        rt_bytes_free(&in[i]);
}

static int is_same(const rt_bytes *a, const rt_bytes *b)
{
    return a->size == b->size && (a->size == 0 || memcmp(a->data, b->data, a->size) == 0);
}

/* Puts something else where the files will be. */
static void files_spoil(const inject_task *task)
{
    for (size_t i = 0; task->outputs[i]; i++) {
        unlink(task->outputs[i]);
        scratch_write(task->outputs[i], "old");
    }
}

/* Each file is whole, old or new; and new where the task was done. */
static void files_check(const inject_task *task, const files right, int is_done, long n)
{
    static const rt_bytes old = {(uint8_t *)"old", 3, 3, NULL};
    files now;
    files_read(now, task);
    for (size_t i = 0; task->outputs[i]; i++) {
        int is_new = is_same(&now[i], &right[i]);
        if (is_done ? !is_new : !is_new && !is_same(&now[i], &old))
            fail_msg("%s, call %ld (%s): %s is wrong", task->name, n, fault_fired(),
                     task->outputs[i]);
    }
    files_free(now);
}

/* ---- Failures -------------------------------------------------------------------------------- */

/* Makes the n-th call fail, and looks at what comes of it. Whether there is such a call. */
static int inject(const inject_task *task, const files right, long n, int for_good,
                  inject_tally *tally)
{
    files_spoil(task);
    int descriptors = entries("/proc/self/fd"), names = entries(".");
    long blocks = fault_live();
    fault_arm(n, for_good);
    inject_end end = task->work(task->data);
    fault_disarm();
    if (!fault_fired())
        return 0;
    if (end == INJECT_WRONG)
        fail_msg("%s, call %ld (%s): a wrong result, or no word of what is wrong", task->name, n,
                 fault_fired());
    files_check(task, right, end == INJECT_DONE, n);
    if (fault_live() != blocks || entries("/proc/self/fd") != descriptors)
        fail_msg("%s, call %ld (%s): %ld blocks and %d descriptors more than before", task->name, n,
                 fault_fired(), fault_live() - blocks, entries("/proc/self/fd") - descriptors);
    if (!for_good && entries(".") != names)
        fail_msg("%s, call %ld (%s): a file is left behind", task->name, n, fault_fired());
    tally->calls++;
    tally->errors += end == INJECT_ERROR;
    tally->survived += end == INJECT_DONE;
    return 1;
}

void inject_all(const inject_task *task, long step, inject_tally *tally)
{
    files right;
    files_spoil(task);
    if (task->work(task->data) != INJECT_DONE)
        fail_msg("%s fails by itself", task->name);
    files_read(right, task);
    fault_arm(0, 0);
    assert_int_equal(task->work(task->data), INJECT_DONE);
    assert_true(fault_disarm() > 0);
    files_check(task, right, 1, 0);
    for (int for_good = 0; for_good < 2; for_good++)
        for (long n = 1 + for_good * step / 2; inject(task, right, n, for_good, tally); n += step)
            ;
    files_free(right);
}

long inject_step(long quick)
{
    return getenv("RT_TEST_LONG") ? 1 : quick;
}
