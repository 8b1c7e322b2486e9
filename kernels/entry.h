/*
 * entry.h - KERNEL, the declaration of an entry point.
 *
 * Kernels are written in vectors of eight. The hint keeps a runtime from vectorising across
 * work-items as well, which gains nothing where rays diverge and takes several times as long to
 * compile.
 *
 * A kernel whose arguments are all zero, its buffers too, does nothing but write to their first
 * 4096 bytes: it is launched so to be compiled (lib/device/compile.c). A count may come to divide
 * only where it is not zero.
 */
#ifndef RT_ENTRY_H
#define RT_ENTRY_H

#define KERNEL kernel __attribute__((vec_type_hint(float8))) void

#endif
