/*
 * photon_order.h - photons in the order of a space-filling curve.
 */
#ifndef RT_LIB_PHOTON_PHOTON_ORDER_H
#define RT_LIB_PHOTON_PHOTON_ORDER_H

#include "photon/photon_list.h"

/*
 * Sorts the photons of a list, at most 2^28, along Hilbert's curve, finest where most of them are: the order is
 * written to `items` [count], an index in the low 28 bits of each. `spare` [count] is scratch memory. The sort is
 * stable, so the result does not depend on the number of threads. Fails only for want of memory.
 */
rt_status rt_photon_order(uint64_t *items, uint64_t *spare, const rt_photon_list *list, uint32_t threads,
                          rt_error *error);

#define RT_PHOTON_ORDER_INDEX 0x0fffffffu

#endif
