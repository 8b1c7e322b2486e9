/*
 * The targets of fuzzing without a fuzzer: seeds, what was found once, and blind mutations of both,
 * the same in each run. An input that breaks a promise is left in build/fuzz-TARGET.
 */
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "fuzz/blind.h"
#include "fuzz/findings.h"
#include "fuzz/targets.h"
#include "lib/image/scratch.h"

enum { room = 8192, edits_max = 4, seconds_max = 2 };

/* The input being read, for on_abort. */
static const uint8_t *current;
static size_t current_size;
static char left_at[4096];

/* Keeps the input that broke a promise. */
static void on_abort(int number)
{
    FILE *file = fopen(left_at, "wb");
    if (file) {
        fwrite(current, 1, current_size, file);
        fclose(file);
        fprintf(stderr, "the input is in %s\n", left_at);
    }
    signal(number, SIG_DFL);
    raise(number);
}

/* Runs a copy of exactly that size, so that a memory checker sees a read past its end. */
static int run(const fuzz_target *target, const uint8_t *data, size_t size)
{
    uint8_t *copy = malloc(size ? size : 1);
    assert_non_null(copy);
    if (size)
        memcpy(copy, data, size);
    current = copy;
    current_size = size;
    int is_good = target->run(copy, size);
    free(copy);
    return is_good;
}

static void replay(const fuzz_target *target, const fuzz_inputs *inputs)
{
    for (size_t i = 0; i < inputs->count; i++)
        run(target, inputs->items[i].data, inputs->items[i].size);
}

static void mutate(const fuzz_target *target, const fuzz_inputs *seeds, const fuzz_inputs *words)
{
    static uint8_t data[room];
    fuzz_random random = fuzz_random_begin(1);
    unsigned accepted = 0, done = 0;
    clock_t start = clock();
    fuzz_blind_begin(2, words);
    for (; done < target->tries && clock() - start < seconds_max * CLOCKS_PER_SEC; done++) {
        const rt_bytes *from = &seeds->items[fuzz_random_below(&random, (uint32_t)seeds->count)];
        size_t size = from->size;
        memcpy(data, from->data, size);
        for (uint32_t n = 1 + fuzz_random_below(&random, edits_max); n > 0; n--)
            size = target->mutate
                       ? target->mutate(data, size, room, fuzz_random_below(&random, UINT32_MAX))
                       : fuzz_mutate_bytes(data, size, room);
        accepted += run(target, data, size) != 0;
    }
    /* Both happen: the seeds are sound, and the mutations do harm. */
    if (getenv("RT_FUZZ_VERBOSE"))
        fprintf(stderr, "%s: %u of %u accepted, %.2f s\n", target->name, accepted, done,
                (double)(clock() - start) / CLOCKS_PER_SEC);
    assert_true(accepted > 0);
    assert_true(accepted < done);
}

static void try_target(void **state)
{
    const fuzz_target *target = fuzz_find(*state);
    fuzz_inputs seeds = {0}, findings = {0}, words = {0};
    void *scratch = NULL;
    char top[4000];
    assert_non_null(target);
    assert_non_null(getcwd(top, sizeof top));
    snprintf(left_at, sizeof left_at, "%s/build/fuzz-%s", top, target->name);
    target->seed(&seeds);
    fuzz_findings_read(&findings, target->name);
    if (target->words)
        target->words(&words);
    assert_int_equal(scratch_enter(&scratch), 0);
    if (target->begin)
        target->begin();
    replay(target, &seeds);
    replay(target, &findings);
    mutate(target, &seeds, &words);
    assert_int_equal(scratch_leave(&scratch), 0);
    fuzz_inputs_free(&words);
    fuzz_inputs_free(&findings);
    fuzz_inputs_free(&seeds);
}

#define FUZZ_TEST(name) {"fuzz_" #name, try_target, NULL, NULL, #name},

int main(void)
{
    static const struct CMUnitTest tests[] = {FUZZ_TARGETS(FUZZ_TEST)};
    signal(SIGABRT, on_abort);
    /* In memory, where there is such a folder: a file is written for each input. */
    if (access("/dev/shm", W_OK) == 0)
        setenv("TMPDIR", "/dev/shm", 0);
    return cmocka_run_group_tests_name("fuzz", tests, NULL, NULL);
}
