/*
 * checksum.h - the checksum of large files, as fast as memory is read: 64 bits in which any damage
 * within one word of eight bytes makes a difference for certain, and any other one with a chance of
 * 1 in 2^64 to stay unseen.
 *
 * The words of the data, little-endian, go to four lanes in turn, those behind the end being zero:
 *
 *   lane = (lane xor word) * K, rotated left by 29,    K = 9e3779b97f4a7c15
 *
 * each beginning with its number. The sum begins with the number of bytes; for each lane
 *
 *   sum = (sum xor lane) * K,   sum = sum xor (sum >> 32)
 *
 * Each step is a bijection of what goes in, all else being the same.
 */
#ifndef RT_LIB_BASE_CHECKSUM_H
#define RT_LIB_BASE_CHECKSUM_H

#include <stddef.h>
#include <stdint.h>

enum { RT_CHECKSUM_LANES = 4 };

/* The data so far. */
typedef struct rt_checksum {
    uint64_t lanes[RT_CHECKSUM_LANES], bytes;
    uint8_t held[8 * RT_CHECKSUM_LANES]; /* the last ones, until there is a word for each lane */
} rt_checksum;

rt_checksum rt_checksum_begin(void);
void rt_checksum_add(rt_checksum *sum, const void *data, size_t size);
uint64_t rt_checksum_end(const rt_checksum *sum);

/* That of all data at once. */
uint64_t rt_checksum_of(const void *data, size_t size);

#endif
