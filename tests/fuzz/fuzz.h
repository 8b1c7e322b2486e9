/*
 * fuzz.h - what the targets of fuzzing share.
 *
 * A target feeds bytes to one reader of the library and checks what the reader promises of any
 * bytes: a clean answer, within time and memory, and a value that can be relied on. It is one file,
 * and one row in targets.h. Two programs run it: libfuzzer.c searches for inputs, guided by
 * coverage; test_fuzz.c replays the seeds and what was found.
 */
#ifndef RT_TESTS_FUZZ_FUZZ_H
#define RT_TESTS_FUZZ_FUZZ_H

#include <stddef.h>
#include <stdint.h>

#include "base/bytes.h"
#include "base/frame.h"

/* ---- Inputs -------------------------------------------------------------------------------- */

/* Bytes, one after another: the seeds of a target, or the words of its dictionary. */
typedef struct fuzz_inputs {
    rt_bytes *items; /* [count] */
    size_t count;
} fuzz_inputs;

/* Adds a copy of the bytes, or of a text without its closing zero. */
void fuzz_add(fuzz_inputs *inputs, const void *data, size_t size);
void fuzz_add_text(fuzz_inputs *inputs, const char *text);
void fuzz_inputs_free(fuzz_inputs *inputs);

/* Appends to an input under construction; whole numbers and floats little-endian, or big-endian. */
void fuzz_put(rt_bytes *bytes, const void *data, size_t size);
void fuzz_put_text(rt_bytes *bytes, const char *text);
void fuzz_put_number(rt_bytes *bytes, uint64_t value, int size, int is_big);
void fuzz_put_float(rt_bytes *bytes, float value, int is_big);

/* ---- Targets ------------------------------------------------------------------------------- */

typedef struct fuzz_target {
    const char *name;
    /* the files whose edges are counted for it, as patterns of the shell; those that several
     * targets share stand in that which reaches most of them */
    const char *sources;
    /* reads the bytes and checks the promises; returns whether they were accepted */
    int (*run)(const uint8_t *data, size_t size);
    void (*seed)(fuzz_inputs *seeds);
    /* words of its format that stand in tables of the program; NULL: those of its sources */
    void (*words)(fuzz_inputs *words);
    /* makes the files that inputs may name, in the current directory; NULL: none */
    void (*begin)(void);
    /*
     * changes an input in place, keeping its checksums, counts or sizes right most of the time;
     * returns its new size, at most `room`. NULL: fuzz_mutate_bytes
     */
    size_t (*mutate)(uint8_t *data, size_t size, size_t room, uint32_t seed);
    size_t size_max; /* of an input */
    unsigned tries;  /* of blind mutation in test_fuzz.c: about a second of them */
} fuzz_target;

/* ---- Promises ------------------------------------------------------------------------------ */

/* Ends the program, after saying which promise is broken and where, unless it holds. */
#define FUZZ_EXPECT(holds) ((holds) ? (void)0 : fuzz_fail(__FILE__, __LINE__, #holds))
void fuzz_fail(const char *file, int line, const char *what);
/* The input that is being read; fuzz_fail prints it, as drivers replace libFuzzer's handlers. */
void fuzz_input_is(const uint8_t *data, size_t size);

/* Checks a text for people: at least one character, one line, no control character. */
void fuzz_expect_line(const char *text);

/*
 * Checks the answer of a reader. *out, which the caller sets to fuzz_untouched before, is written
 * on success alone; an error has its status, RT_ERROR_INPUT, and a message. Returns whether the
 * input was accepted.
 */
int fuzz_expect_answer(rt_status status, const rt_error *error, const void *out);
extern void *const fuzz_untouched;

void fuzz_expect_finite(const float *values, size_t count);

/* ---- Files --------------------------------------------------------------------------------- */

/* Makes a directory for the files of a target and enters it. */
void fuzz_enter_scratch(void);

/* Replaces a file of the current directory. */
void fuzz_write(const char *name, const void *data, size_t size);

/* Writes seed `number` of a target as a file, for the targets whose inputs name files. */
void fuzz_write_seed(const fuzz_target *target, size_t number, const char *name);

/* ---- Mutation ------------------------------------------------------------------------------ */

/* The general mutations: libFuzzer's, or blind ones in test_fuzz.c. */
size_t fuzz_mutate_bytes(uint8_t *data, size_t size, size_t room);

/* A sequence of random numbers, for mutators; below(limit) is from 0 to limit - 1. */
typedef struct fuzz_random {
    uint64_t state;
} fuzz_random;
fuzz_random fuzz_random_begin(uint32_t seed);
uint32_t fuzz_random_below(fuzz_random *random, uint32_t limit);

/*
 * Replaces `gone` bytes at `at` by others. Returns the new size; the old one, and changes nothing,
 * where the result has no room.
 */
size_t fuzz_splice(uint8_t *data, size_t size, size_t room, size_t at, size_t gone,
                   const void *with, size_t with_size);

/* Little-endian numbers of 1 to 8 bytes. */
uint64_t fuzz_get(const uint8_t *at, int size);
void fuzz_set(uint8_t *at, uint64_t value, int size);

/*
 * Gives a file of this kind, where it is long enough, the start that it must have, its size and a
 * sound checksum.
 */
void fuzz_seal(uint8_t *data, size_t size, const rt_frame *frame);

#endif
