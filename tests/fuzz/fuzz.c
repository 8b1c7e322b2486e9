/* fuzz.c - inputs, promises, files and random numbers of the targets. */
#include "fuzz/fuzz.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/checksum.h"

/* ---- Inputs -------------------------------------------------------------------------------- */

void fuzz_put(rt_bytes *bytes, const void *data, size_t size)
{
    FUZZ_EXPECT(rt_bytes_put(bytes, bytes->size, data, size, NULL) == RT_OK);
}

void fuzz_put_text(rt_bytes *bytes, const char *text)
{
    fuzz_put(bytes, text, strlen(text));
}

void fuzz_put_number(rt_bytes *bytes, uint64_t value, int size, int is_big)
{
    for (int i = 0; i < size; i++) {
        uint8_t byte = (uint8_t)(value >> 8 * (is_big ? size - 1 - i : i));
        fuzz_put(bytes, &byte, 1);
    }
}

void fuzz_put_float(rt_bytes *bytes, float value, int is_big)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    fuzz_put_number(bytes, bits, 4, is_big);
}

void fuzz_add(fuzz_inputs *inputs, const void *data, size_t size)
{
    rt_bytes *items = realloc(inputs->items, (inputs->count + 1) * sizeof *items);
    FUZZ_EXPECT(items != NULL);
    inputs->items = items;
    items[inputs->count] = (rt_bytes){0};
    fuzz_put(&items[inputs->count++], data, size);
}

void fuzz_add_text(fuzz_inputs *inputs, const char *text)
{
    fuzz_add(inputs, text, strlen(text));
}

void fuzz_inputs_free(fuzz_inputs *inputs)
{
    for (size_t i = 0; i < inputs->count; i++)
        rt_bytes_free(&inputs->items[i]);
    free(inputs->items);
    *inputs = (fuzz_inputs){0};
}

/* ---- Promises ------------------------------------------------------------------------------ */

static char untouched;
void *const fuzz_untouched = &untouched;

static const uint8_t *input;
static size_t input_size;

void fuzz_input_is(const uint8_t *data, size_t size)
{
    input = data;
    input_size = size;
}

void fuzz_fail(const char *file, int line, const char *what)
{
    fprintf(stderr, "%s:%d: broken promise: %s\n", file, line, what);
    if (input_size > 0)
        fprintf(stderr, "by the input, in hexadecimal digits:");
    for (size_t i = 0; i < input_size; i++)
        fprintf(stderr, "%s%02x", i % 32 ? "" : "\n", input[i]);
    fprintf(stderr, "\n");
    fflush(stderr);
    abort();
}

void fuzz_expect_line(const char *text)
{
    FUZZ_EXPECT(text[0] != '\0');
    for (; *text; text++)
        FUZZ_EXPECT(*text != '\n' && *text != '\r');
}

int fuzz_expect_answer(rt_status status, const rt_error *error, const void *out)
{
    if (status == RT_OK) {
        FUZZ_EXPECT(out != fuzz_untouched && out != NULL);
        return 1;
    }
    FUZZ_EXPECT(out == fuzz_untouched);
    FUZZ_EXPECT(status == RT_ERROR_INPUT);
    FUZZ_EXPECT(error->status == status);
    fuzz_expect_line(error->message);
    return 0;
}

void fuzz_expect_finite(const float *values, size_t count)
{
    for (size_t i = 0; i < count; i++)
        FUZZ_EXPECT(isfinite(values[i]));
}

/* ---- Files --------------------------------------------------------------------------------- */

void fuzz_enter_scratch(void)
{
    const char *base = getenv("TMPDIR");
    char path[4096];
    snprintf(path, sizeof path, "%s/rt-fuzz-XXXXXX", base && base[0] ? base : "/tmp");
    FUZZ_EXPECT(mkdtemp(path) != NULL);
    FUZZ_EXPECT(chdir(path) == 0);
}

void fuzz_write(const char *name, const void *data, size_t size)
{
    FILE *file = fopen(name, "wb");
    FUZZ_EXPECT(file != NULL);
    FUZZ_EXPECT(size == 0 || fwrite(data, 1, size, file) == size);
    FUZZ_EXPECT(fclose(file) == 0);
}

void fuzz_write_seed(const fuzz_target *target, size_t number, const char *name)
{
    fuzz_inputs seeds = {0};
    target->seed(&seeds);
    FUZZ_EXPECT(number < seeds.count);
    fuzz_write(name, seeds.items[number].data, seeds.items[number].size);
    fuzz_inputs_free(&seeds);
}

/* ---- Mutation ------------------------------------------------------------------------------ */

fuzz_random fuzz_random_begin(uint32_t seed)
{
    return (fuzz_random){seed + UINT64_C(0x9e3779b97f4a7c15)};
}

/* Vigna's splitmix64. */
uint32_t fuzz_random_below(fuzz_random *random, uint32_t limit)
{
    uint64_t z = random->state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return (uint32_t)(((z ^ (z >> 31)) >> 32) * limit >> 32);
}

size_t fuzz_splice(uint8_t *data, size_t size, size_t room, size_t at, size_t gone,
                   const void *with, size_t with_size)
{
    if (size - gone + with_size > room)
        return size;
    memmove(data + at + with_size, data + at + gone, size - at - gone);
    if (with_size)
        memcpy(data + at, with, with_size);
    return size - gone + with_size;
}

uint64_t fuzz_get(const uint8_t *at, int size)
{
    uint64_t value = 0;
    for (int i = 0; i < size; i++)
        value |= (uint64_t)at[i] << 8 * i;
    return value;
}

void fuzz_set(uint8_t *at, uint64_t value, int size)
{
    for (int i = 0; i < size; i++)
        at[i] = (uint8_t)(value >> 8 * i);
}

void fuzz_seal(uint8_t *data, size_t size, const rt_frame *frame)
{
    rt_writer start = {data};
    if (size < (size_t)frame->header + RT_FRAME_CHECKSUM)
        return;
    rt_frame_put(&start, frame, size);
    fuzz_set(data + size - RT_FRAME_CHECKSUM, rt_checksum_of(data, size - RT_FRAME_CHECKSUM), 8);
}
