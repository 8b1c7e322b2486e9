/*
 * entry.h - KERNEL, the declaration of an entry point.
 *
 * Kernels are written in vectors of eight. The hint keeps a runtime from vectorising across
 * work-items as well, which gains nothing where rays diverge and takes several times as long to
 * compile.
 */
#ifndef RT_ENTRY_H
#define RT_ENTRY_H

#define KERNEL kernel __attribute__((vec_type_hint(float8))) void

#endif
