/*
 * photon_pack.cl - brings the photons of a batch of paths together, one path behind the other: each
 * work-item copies those of one path.
 */
#include "entry.h"
#include "types.h"

/*
 * Paths `first` to before `end`; places: [paths of the batch + 1], where the photons of a path
 * would begin if all of the batch were packed; slots: as photon_emit fills them, `row` paths a row.
 */
KERNEL photon_pack(uint first, uint end, uint row, global const uint *places,
                   global const rt_photon *slots, global rt_photon *packed)
{
    const uint path = first + (uint)get_global_id(0);
    if (path >= end)
        return;
    const uint begin = places[path], count = places[path + 1u] - begin;
    packed += begin - places[first];
    for (uint i = 0u; i < count; i++)
        packed[i] = slots[(size_t)i * row + path];
}
