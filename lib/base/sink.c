/* sink.c - puts bytes into memory or into a file. */
#include "base/sink.h"

#include <string.h>

#include "base/file.h"
#include "base/frame.h"

rt_sink rt_sink_begin(uint8_t *to, int fd)
{
    return (rt_sink){to, fd, rt_checksum_begin()};
}

int rt_sink_put(rt_sink *sink, const uint8_t *bytes, size_t size)
{
    rt_checksum_add(&sink->sum, bytes, size);
    if (!sink->to)
        return rt_file_put(sink->fd, bytes, size);
    memcpy(sink->to, bytes, size);
    sink->to += size;
    return 0;
}

int rt_sink_end(rt_sink *sink)
{
    uint8_t end[RT_FRAME_CHECKSUM];
    rt_put64(&(rt_writer){end}, rt_checksum_end(&sink->sum));
    return rt_sink_put(sink, end, sizeof end);
}
