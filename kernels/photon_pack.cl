/*
 * photon_pack.cl - brings the photons of a batch of paths together, one path behind the other.
 */
#include "entry.h"
#include "types.h"

/* How many photons each path stored; 0 behind the last, for the end of its photons. */
KERNEL photon_counts(uint paths, global const rt_path_account *accounts, global uint *counts)
{
    const uint path = item_number();
    if (path <= paths)
        counts[path] = path < paths ? accounts[path].photons : 0u;
}

/*
 * Each work-item copies the photons of one path, of paths `first` to before `end`. places: [paths
 * of the batch + 1], where the photons of a path would begin if all of the batch were packed;
 * slots: as photon_emit fills them, `row` paths a row. The photons go to packed from `at` on.
 */
KERNEL photon_pack(uint first, uint end, uint row, global const uint *places,
                   global const rt_photon *slots, uint at, global rt_photon *packed)
{
    const uint path = first + item_number();
    if (path >= end)
        return;
    const uint begin = places[path], count = places[path + 1u] - begin;
    packed += (size_t)at + (begin - places[first]);
    for (uint i = 0u; i < count; i++)
        packed[i] = slots[(size_t)i * row + path];
}
