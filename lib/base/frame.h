/*
 * frame.h - what surrounds the content of our binary files: eight bytes that name the kind, u32
 * version, u32 size of the header, u64 size of the whole file; at the end the u64 checksum of all
 * before (base/checksum.h).
 */
#ifndef RT_LIB_BASE_FRAME_H
#define RT_LIB_BASE_FRAME_H

#include "base/wire.h"
#include "rt.h"

enum { RT_FRAME_START = 24, RT_FRAME_CHECKSUM = 8 };

/* A kind of file. */
typedef struct rt_frame {
    uint8_t magic[8];
    uint32_t version, header; /* size of the header in bytes, RT_FRAME_START included */
    const char *what;         /* "photon map" */
    const char *again;        /* what to do with one of another version: "emit it anew" */
} rt_frame;

/* Writes the first RT_FRAME_START bytes of a file of this size. */
void rt_frame_put(rt_writer *w, const rt_frame *frame, uint64_t size);

/*
 * The size of the whole file that its first `size` bytes tell. Fails with RT_ERROR_INPUT, with the
 * file's name, when it is of another kind or version.
 */
rt_status rt_frame_size(uint64_t *out, const rt_frame *frame, const uint8_t *start, size_t size,
                        const char *name, rt_error *error);

/* Checks kind, version, size and checksum of a whole file; fails likewise. */
rt_status rt_frame_check(const rt_frame *frame, const uint8_t *data, size_t size, const char *name,
                         rt_error *error);

#endif
