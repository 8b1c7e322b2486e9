/* kernel_source.h - the OpenCL sources that are embedded in the library. */
#ifndef RT_LIB_DEVICE_KERNEL_SOURCE_H
#define RT_LIB_DEVICE_KERNEL_SOURCE_H

#include <stddef.h>
#include <stdint.h>

/* A part of a source file. */
typedef struct rt_kernel_piece {
    const unsigned char *text;
    size_t length;
} rt_kernel_piece;

/* One OpenCL program: pieces in the order of its text, in which all includes are inlined. */
typedef struct rt_kernel_source {
    const char *name; /* the .cl file's name without extension */
    const rt_kernel_piece *pieces;
    const uint16_t *order; /* [count], of pieces */
    size_t count;
    size_t length; /* of the text, bytes */
} rt_kernel_source;

/* The library's programs; the last entry has a NULL name. Generated from kernels/ by the build. */
extern const rt_kernel_source rt_kernel_sources[];

/* The entry of this name in such a table, or the last one. */
const rt_kernel_source *rt_kernel_source_find(const rt_kernel_source *sources, const char *name);

#endif
