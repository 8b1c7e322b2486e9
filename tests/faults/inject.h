/*
 * inject.h - makes each call of a piece of work fail in turn: the work ends as it should or says
 * what is wrong, all is freed, and each file that it writes is whole, the old one or the new.
 */
#ifndef RT_TESTS_INJECT_H
#define RT_TESTS_INJECT_H

#include "base/bytes.h"

/* How a piece of work ended. */
typedef enum inject_end {
    INJECT_DONE,  /* as it should */
    INJECT_ERROR, /* with an error that says what is wrong */
    INJECT_WRONG  /* with an error that does not, or with a wrong result */
} inject_end;

/* A piece of work, which may be done many times over. */
typedef struct inject_task {
    const char *name;
    inject_end (*work)(const void *data);
    const void *data;
    const char *const *outputs; /* the files that it may write, up to a NULL */
} inject_task;

typedef struct inject_tally {
    long calls, errors, survived;
} inject_tally;

/*
 * Fails each call of a task, or every `step`th: alone, and with all that follow. Adds to *tally.
 * Fails the test where something is not as it should be.
 */
void inject_all(const inject_task *task, long step, inject_tally *tally);

/* 1 where RT_TEST_LONG is set, else `quick`. */
long inject_step(long quick);

#endif
