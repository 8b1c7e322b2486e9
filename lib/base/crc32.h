/* crc32.h - the checksum of IEEE 802.3, PNG and zlib: polynomial 0x04c11db7, reflected. */
#ifndef RT_LIB_BASE_CRC32_H
#define RT_LIB_BASE_CRC32_H

#include <stddef.h>
#include <stdint.h>

uint32_t rt_crc32(const void *data, size_t size);

#endif
