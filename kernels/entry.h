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

/* The name of an entry point, and of its program, which another program may include. */
#ifdef RT_DISPERSION
#define ENTRY(name) name##_dispersive
#elif defined(RT_PLAIN)
#define ENTRY(name) name##_plain
#else
#define ENTRY(name) name
#endif

/*
 * From 0. There are more numbers than items were asked for; those of a work-group are consecutive.
 *
 * Of all work-groups of a launch (rt_launch), as many are needed as the offset of the second
 * dimension says. They lie evenly among all, in order: group g of G is the one after the g n / G
 * before it, rounded down, where that makes one more. The others have the number that follows.
 */
static inline uint item_number(void)
{
    const ulong groups = (ulong)get_num_groups(0) * get_num_groups(1) * get_num_groups(2);
    const ulong row = get_group_id(2) * get_num_groups(1) + get_group_id(1);
    const ulong group = row * get_num_groups(0) + get_group_id(0), needed = get_global_offset(1);
    const ulong before = group * needed / groups;
    const bool is_needed = (group + 1) * needed / groups > before;
    return (uint)((is_needed ? before : needed) * get_local_size(0) + get_local_id(0));
}

#endif
