/* blind.c - mutations without a guide, for programs that are built without libFuzzer. */
#include "fuzz/blind.h"

#include <string.h>

static fuzz_random random_numbers;
static const fuzz_inputs *known_words;

void fuzz_blind_begin(uint32_t seed, const fuzz_inputs *words)
{
    random_numbers = fuzz_random_begin(seed);
    known_words = words;
}

static uint32_t below(uint32_t limit)
{
    return fuzz_random_below(&random_numbers, limit);
}

/* What breaks readers: numbers at the edges of types, ends of lines, brackets. */
static const char *const edges[] = {
    "-1",    "0",  "255", "65536", "4294967295", "4294967296", "2147483648", "1e39", "nan",
    "1e-50", "\n", "\r",  " ",     "/",          "#",          "{",          "}",    "\""};

static size_t put_word(uint8_t *data, size_t size, size_t room, size_t at, size_t gone)
{
    size_t edge_count = sizeof edges / sizeof *edges;
    size_t count = edge_count + (known_words ? known_words->count : 0);
    size_t i = below((uint32_t)count);
    if (i < edge_count)
        return fuzz_splice(data, size, room, at, gone, edges[i], strlen(edges[i]));
    const rt_bytes *word = &known_words->items[i - edge_count];
    return fuzz_splice(data, size, room, at, gone, word->data, word->size);
}

/* A little-endian number at the edge of its type. */
static size_t put_number(uint8_t *data, size_t size, size_t room, size_t at)
{
    static const uint64_t numbers[] = {0,          1,          0x7f,       0x80,
                                       0xff,       0x7fffffff, 0x80000000, 0xffffffff,
                                       UINT64_MAX, 0x7f800000, 0x7fc00000};
    uint8_t bytes[8];
    size_t length = (size_t)1 << below(4);
    fuzz_set(bytes, numbers[below(sizeof numbers / sizeof *numbers)], 8);
    if (length > size - at)
        length = size - at;
    return fuzz_splice(data, size, room, at, length, bytes, length);
}

size_t fuzz_mutate_bytes(uint8_t *data, size_t size, size_t room)
{
    uint8_t byte = (uint8_t)below(256);
    size_t at = below((uint32_t)size + 1), left = size - at;
    size_t length = below(left < 16 ? (uint32_t)left + 1 : 17);
    switch (below(8)) {
    case 0:
        if (left)
            data[at] ^= (uint8_t)(1u << below(8));
        return size;
    case 1:
        return fuzz_splice(data, size, room, at, left > 0, &byte, 1);
    case 2:
        return fuzz_splice(data, size, room, at, length, "", 0);
    case 3:
        return put_word(data, size, room, at, 0);
    case 4:
        return put_word(data, size, room, at, length);
    case 5:
        return put_number(data, size, room, at);
    case 6: {
        uint8_t copy[16];
        size_t from = below((uint32_t)size + 1), count = size - from < 16 ? size - from : 16;
        memcpy(copy, data + from, count);
        return fuzz_splice(data, size, room, at, 0, copy, count);
    }
    default:
        return below(8) ? size : at;
    }
}
