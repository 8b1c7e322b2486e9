/* frame_damage.h - files in a frame (base/frame.h), damaged in every way that each must refuse. */
#ifndef RT_TESTS_BASE_FRAME_DAMAGE_H
#define RT_TESTS_BASE_FRAME_DAMAGE_H

#include "base/bytes.h"

/* Decodes the bytes and expects to be refused with this reason. */
typedef void frame_refused(const uint8_t *data, size_t size, const char *reason);

/* Cut short at each byte, a bit turned in each, and a tail added; `what` is in every reason. */
void frame_damage(const rt_bytes *file, const char *what, frame_refused *expect_refused);

/* A number in the file that a checksum made anew hides. */
typedef struct frame_lie {
    size_t at;
    uint64_t value;
    int bytes;
    const char *reason;
} frame_lie;

/* Each lie alone, with a sound checksum. */
void frame_tell_lies(const rt_bytes *file, const frame_lie *lies, size_t count,
                     frame_refused *expect_refused);

/* Makes the checksum anew. */
void frame_seal(rt_bytes *file);

#endif
