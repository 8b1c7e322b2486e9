/* bytes.h - a growing array of bytes: the content of a file, in memory. */
#ifndef RT_LIB_BASE_BYTES_H
#define RT_LIB_BASE_BYTES_H

#include <stddef.h>
#include <stdint.h>

#include "base/memory.h"

/* The owner under which they count. */
extern const char rt_bytes_owner[];

/* All zero is the empty array. */
typedef struct rt_bytes {
    uint8_t *data;
    size_t size, capacity;
    rt_memory *memory; /* that the capacity counts in; NULL: none */
} rt_bytes;

/*
 * Writes count bytes at offset, growing the array as needed; a gap before offset is zero.
 * Fails with RT_ERROR_MEMORY and then leaves the array as it was.
 */
rt_status rt_bytes_put(rt_bytes *bytes, uint64_t offset, const void *source, size_t count,
                       rt_error *error);

/* Frees the content; the array is all zero afterwards. */
void rt_bytes_free(rt_bytes *bytes);

#endif
