/* photon_list.h - photons in memory of the host or of a device, in the order of their paths. */
#ifndef RT_LIB_PHOTON_PHOTON_LIST_H
#define RT_LIB_PHOTON_PHOTON_LIST_H

#include <stddef.h>

#include "device/device.h"
#include "rt.h"
#include "types.h"

/*
 * Photons in the order of their paths, and along each path in the order of its bounces, so
 * that order and content do not depend on how the work was shared out. All zero is empty.
 */
typedef struct rt_photon_list {
    rt_photon *photons; /* [count] */
    size_t count, capacity;
    uint64_t emitted;  /* photon paths */
    uint64_t rejected; /* photons left out because they were not finite or too far out */
    rt_memory *memory; /* that the capacity counts in; NULL: none */
    cl_mem buffer; /* where they lie on the device, rt_photon [capacity]; photons is NULL then */
    rt_device *device; /* that the buffer is of */
} rt_photon_list;

/* Makes room for so many photons more. */
rt_status rt_photon_list_reserve(rt_photon_list *list, size_t more, rt_error *error);

/*
 * The same on a device, for a list that is empty or lies there. Fails with RT_ERROR_MEMORY, and
 * leaves the list as it is, where the device has no room.
 */
rt_status rt_photon_list_reserve_on(rt_photon_list *list, rt_device *device, size_t more,
                                    rt_error *error);

/* Copies a list that lies on a device to the host, into an empty one. */
rt_status rt_photon_list_read(rt_photon_list *out, const rt_photon_list *list, rt_error *error);

/* Moves a list that lies on a device to the host. */
rt_status rt_photon_list_fetch(rt_photon_list *list, rt_error *error);

/*
 * Appends the photons of path_count more paths: path i stored accounts[i].photons of them, of which
 * the j-th lies at slots[j * row + i], and left out accounts[i].rejected. Works on so many threads.
 */
rt_status rt_photon_list_append(rt_photon_list *list, const rt_photon *slots, size_t row,
                                const rt_path_account *accounts, size_t path_count,
                                uint32_t threads, rt_error *error);

/* Whether all numbers of a photon are finite. */
int rt_photon_is_finite(const rt_photon *photon);

/* Whether a vector is of unit length, to half a percent. */
int rt_is_unit(const float v[3]);

/* Empties the list but keeps its memory. */
void rt_photon_list_reset(rt_photon_list *list);

/* Frees what the list holds and empties it; what it counts in stays. */
void rt_photon_list_clear(rt_photon_list *list);

#endif
