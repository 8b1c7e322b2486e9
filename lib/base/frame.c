/* frame.c - the start and the end of binary files. */
#include "base/frame.h"

#include "base/checksum.h"
#include "base/error.h"

void rt_frame_put(rt_writer *w, const rt_frame *frame, uint64_t size)
{
    memcpy(w->at, frame->magic, sizeof frame->magic);
    w->at += sizeof frame->magic;
    rt_put32(w, frame->version);
    rt_put32(w, frame->header);
    rt_put64(w, size);
}

rt_status rt_frame_size(uint64_t *out, const rt_frame *frame, const uint8_t *start, size_t size,
                        const char *name, rt_error *error)
{
    if (size < sizeof frame->magic || memcmp(start, frame->magic, sizeof frame->magic) != 0)
        return rt_fail(error, RT_ERROR_INPUT, "%.350s: this is no %s", name, frame->what);
    rt_reader r = {start + sizeof frame->magic};
    if (size < frame->header)
        return rt_fail(error, RT_ERROR_INPUT, "%.350s: the %s is cut short in its header", name,
                       frame->what);
    const uint32_t version = rt_get32(&r), header = rt_get32(&r);
    if (version != frame->version || header != frame->header)
        return rt_fail(error, RT_ERROR_INPUT,
                       "%.350s: a %s of version %u with a header of %u bytes; known is version %u "
                       "with %u: %s",
                       name, frame->what, version, header, frame->version, frame->header,
                       frame->again);
    *out = rt_get64(&r);
    return RT_OK;
}

rt_status rt_frame_check(const rt_frame *frame, const uint8_t *data, size_t size, const char *name,
                         rt_error *error)
{
    uint64_t told;
    rt_status status = rt_frame_size(&told, frame, data, size, name, error);
    if (status != RT_OK)
        return status;
    if (told != size)
        return rt_fail(error, RT_ERROR_INPUT,
                       "%.350s: the %s has %zu bytes instead of the %llu it was written with", name,
                       frame->what, size, (unsigned long long)told);
    if (size < (size_t)frame->header + RT_FRAME_CHECKSUM)
        return rt_fail(error, RT_ERROR_INPUT, "%.350s: the %s is cut short", name, frame->what);
    rt_reader r = {data + size - RT_FRAME_CHECKSUM};
    if (rt_get64(&r) != rt_checksum_of(data, size - RT_FRAME_CHECKSUM))
        return rt_fail(error, RT_ERROR_INPUT,
                       "%.350s: the %s is damaged: its checksum does not fit", name, frame->what);
    return RT_OK;
}
