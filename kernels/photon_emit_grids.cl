/*
 * photon_emit_grids.cl - as photon_emit_media.cl, of scenes where the density of a medium lies on a
 * grid.
 */
#define RT_GRIDS
#include "entry.h"
#include "photon/media_light_path.h"

KERNEL ENTRY(photon_emit_grids)(const rt_params params, global const rt_scene_header *header,
                                global const rt_light_share *shares, global rt_photon *slots,
                                global rt_path_account *accounts)
{
    emit_item(&params, header, shares, slots, accounts);
}
