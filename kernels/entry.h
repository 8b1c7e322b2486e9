/*
 * entry.h - KERNEL, the declaration of an entry point, and the number of its work-item.
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

/* From 0; items lie in rows and layers (rt_launch), and there are more than were asked for. */
static inline uint item_number(void)
{
    const size_t row = get_global_id(2) * get_global_size(1) + get_global_id(1);
    return (uint)(row * get_global_size(0) + get_global_id(0));
}

#endif
