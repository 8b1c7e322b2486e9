/* crc32.h - the checksum of IEEE 802.3, PNG and zlib: polynomial 0x04c11db7, reflected. */
#ifndef RT_LIB_BASE_CRC32_H
#define RT_LIB_BASE_CRC32_H

#include <stddef.h>
#include <stdint.h>

uint32_t rt_crc32(const void *data, size_t size);

/* The checksum of what has `sum`, 0 for nothing, followed by these bytes. */
uint32_t rt_crc32_add(uint32_t sum, const void *data, size_t size);

#endif
