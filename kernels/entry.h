/*
 * entry.h - how a kernel begins.
 *
 * Kernels work in vectors of eight by themselves. A runtime that would lay several work-items side
 * by side in one vector is told so: where rays diverge it gains nothing, and takes several
 * times as long to compile.
 */
#ifndef RT_ENTRY_H
#define RT_ENTRY_H

#define KERNEL kernel __attribute__((vec_type_hint(float8))) void

#endif
