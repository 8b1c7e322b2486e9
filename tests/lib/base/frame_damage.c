/* frame_damage.c - damaged and lying copies of a file in a frame. */
#include "lib/base/frame_damage.h"

#include <string.h>

#include "base/checksum.h"
#include "base/frame.h"
#include "support.h"

static void put(uint8_t *at, uint64_t value, int bytes)
{
    for (int i = 0; i < bytes; i++)
        at[i] = (uint8_t)(value >> (8 * i));
}

void frame_seal(rt_bytes *file)
{
    uint8_t *end = file->data + file->size - RT_FRAME_CHECKSUM;
    put(end, rt_checksum_of(file->data, file->size - RT_FRAME_CHECKSUM), RT_FRAME_CHECKSUM);
}

static rt_bytes copy_of(const rt_bytes *file)
{
    rt_bytes copy = {0};
    rt_error error;
    expect_ok(rt_bytes_put(&copy, 0, file->data, file->size, &error), &error);
    return copy;
}

void frame_damage(const rt_bytes *file, const char *what, frame_refused *expect_refused)
{
    rt_bytes copy = copy_of(file);
    rt_error error;
    for (size_t at = 0; at < copy.size; at++) {
        expect_refused(copy.data, at, what);
        copy.data[at] ^= (uint8_t)(1 << (at % 8));
        expect_refused(copy.data, copy.size, what);
        copy.data[at] ^= (uint8_t)(1 << (at % 8));
    }
    expect_ok(rt_bytes_put(&copy, copy.size, "tail", 4, &error), &error);
    expect_refused(copy.data, copy.size, "bytes instead of");
    rt_bytes_free(&copy);
}

void frame_tell_lies(const rt_bytes *file, const frame_lie *lies, size_t count,
                     frame_refused *expect_refused)
{
    for (size_t i = 0; i < count; i++) {
        rt_bytes copy = copy_of(file);
        put(copy.data + lies[i].at, lies[i].value, lies[i].bytes);
        frame_seal(&copy);
        expect_refused(copy.data, copy.size, lies[i].reason);
        rt_bytes_free(&copy);
    }
}
