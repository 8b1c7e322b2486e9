/* sink.h - where the bytes of one of our binary files go, with the checksum that ends it. */
#ifndef RT_LIB_BASE_SINK_H
#define RT_LIB_BASE_SINK_H

#include "base/checksum.h"

/* Memory for the whole file or, where that is NULL, what a descriptor is open for. */
typedef struct rt_sink {
    uint8_t *to;
    int fd;
    rt_checksum sum; /* of all so far */
} rt_sink;

rt_sink rt_sink_begin(uint8_t *to, int fd);

/* Each returns 0, or the errno of what failed. */
int rt_sink_put(rt_sink *sink, const uint8_t *bytes, size_t size);

/* Puts the checksum. */
int rt_sink_end(rt_sink *sink);

#endif
