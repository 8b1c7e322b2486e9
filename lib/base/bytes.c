/* bytes.c - appends to a growing array of bytes. */
#include "base/bytes.h"

#include <stdlib.h>
#include <string.h>

const char rt_bytes_owner[] = "a file";

static rt_status reserve(rt_bytes *bytes, size_t capacity, rt_error *error)
{
    if (capacity <= bytes->capacity)
        return RT_OK;
    /* Grow by at least a half, so that appending stays linear in time. */
    size_t grown = bytes->capacity + bytes->capacity / 2;
    if (grown < capacity || rt_memory_foresee(bytes->memory, (double)(grown - bytes->capacity),
                                              rt_bytes_owner, NULL) != RT_OK)
        grown = capacity;
    rt_status status =
        rt_memory_retake(bytes->memory, bytes->capacity, grown, rt_bytes_owner, error);
    if (status != RT_OK)
        return status;
    uint8_t *data = realloc(bytes->data, grown);
    if (!data) {
        rt_memory_give(bytes->memory, grown - bytes->capacity, rt_bytes_owner);
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory: %zu bytes for a file", grown);
    }
    bytes->data = data;
    bytes->capacity = grown;
    return RT_OK;
}

rt_status rt_bytes_put(rt_bytes *bytes, uint64_t offset, const void *source, size_t count,
                       rt_error *error)
{
    if (offset > SIZE_MAX / 2 || count > SIZE_MAX / 2)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory: a file of more than %zu bytes",
                       SIZE_MAX / 2);
    if (count == 0)
        return RT_OK;
    size_t end = (size_t)offset + count;
    rt_status status = reserve(bytes, end, error);
    if (status != RT_OK)
        return status;
    if (offset > bytes->size)
        memset(bytes->data + bytes->size, 0, (size_t)offset - bytes->size);
    memcpy(bytes->data + offset, source, count);
    if (end > bytes->size)
        bytes->size = end;
    return RT_OK;
}

void rt_bytes_free(rt_bytes *bytes)
{
    free(bytes->data);
    rt_memory_give(bytes->memory, bytes->capacity, rt_bytes_owner);
    memset(bytes, 0, sizeof *bytes);
}
